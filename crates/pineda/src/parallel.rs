//! Work for several threads, without `unsafe`: jobs own the `&mut` pieces that they write to.

use std::sync::{Mutex, PoisonError};

/// Runs all jobs, each with one of the workers' states; the calling thread works, too. Where the system grants no more threads, fewer do the
/// work.
pub(crate) fn for_each<J: Send, W: Send>(
    workers: &mut [W],
    jobs: impl ExactSizeIterator<Item = J> + Send,
    run: impl Fn(&mut W, J) + Sync,
) {
    let Some((own, others)) = workers.split_first_mut() else { return };
    let spare = others.len().min(jobs.len().saturating_sub(1));
    let queue = Mutex::new(jobs);
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work = |worker: &mut W| {
        while let Some(job) = next() {
            run(worker, job);
        }
    };
    if spare == 0 {
        return work(own);
    }
    std::thread::scope(|scope| {
        for worker in &mut others[..spare] {
            let work = &work;
            // An error means that there is no thread to be had: the others do its share.
            let _ = std::thread::Builder::new().spawn_scoped(scope, move || work(worker));
        }
        work(own);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_job_is_done_once() {
        for threads in [1, 2, 7] {
            let mut done = vec![0; 1000];
            let mut workers = vec![0; threads];
            for_each(&mut workers, done.iter_mut(), |count, slot| {
                *slot += 1;
                *count += 1;
            });
            assert!(done.iter().all(|&n| n == 1));
            assert_eq!(workers.iter().sum::<i32>(), 1000);
        }
    }
}
