//! Many models, several at a time.
//!
//! A worker takes the next model, reads, draws and writes it, and only then the next one: so no more models are in memory than there are workers. With as many models as threads or more, each worker draws with
//! one thread: that is the quickest, for then threads never wait for each other. With fewer, they share the threads.

use super::names::Job;
use super::progress::Progress;
use super::report::Outcome;
use crate::arguments::How;
use crate::failure::Failure;
use pineda::Renderer;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What becomes of each job, in their order. `most` workers at the most.
pub(crate) fn run(
    jobs: &[Job],
    how: &How,
    most: Option<usize>,
    progress: &Progress,
    draw: impl Fn(&Job, &mut Renderer) -> Outcome + Sync,
) -> Result<Vec<Outcome>, Failure> {
    let threads = how.threads();
    let workers = most.unwrap_or(threads).min(jobs.len()).max(1);
    let each = (threads / workers).max(1);
    // What is wrong with how to draw is found before anything is drawn.
    let mut renderers: Vec<Renderer> = (0..workers).map(|_| how.renderer_with(each)).collect::<Result<_, _>>()?;
    let next = AtomicUsize::new(0);
    let failed = AtomicUsize::new(0);
    let outcomes: Vec<Mutex<Option<Outcome>>> = jobs.iter().map(|_| Mutex::new(None)).collect();
    let work = |renderer: &mut Renderer| {
        while let Some(number) = take(&next, jobs.len()) {
            let outcome = whole(|| draw(&jobs[number], renderer));
            if matches!(outcome, Outcome::Failed(_)) {
                failed.fetch_add(1, Ordering::Relaxed);
            }
            *outcomes[number].lock().unwrap_or_else(|poisoned| poisoned.into_inner()) = Some(outcome);
            progress.step(failed.load(Ordering::Relaxed));
        }
    };
    match &mut renderers[..] {
        [renderer] => work(renderer),
        renderers => std::thread::scope(|scope| {
            for renderer in renderers {
                scope.spawn(|| work(renderer));
            }
        }),
    }
    progress.finish();
    let outcome = |outcome: Mutex<Option<Outcome>>| {
        let outcome = outcome.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        outcome.unwrap_or_else(|| Outcome::Failed(Failure::data("the model was not drawn")))
    };
    Ok(outcomes.into_iter().map(outcome).collect())
}

fn take(next: &AtomicUsize, count: usize) -> Option<usize> {
    let number = next.fetch_add(1, Ordering::Relaxed);
    (number < count).then_some(number)
}

/// A bug that one model shows must not stop ten thousand others.
fn whole(draw: impl FnOnce() -> Outcome) -> Outcome {
    catch_unwind(AssertUnwindSafe(draw)).unwrap_or_else(|_| {
        Outcome::Failed(Failure::data("pineda has a bug that this model shows").help("report it, with the model"))
    })
}
