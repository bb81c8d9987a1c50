//! `cargo xtask ulp`: every float through every function of shaders.

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use pineda_proof::ulp::{FUNCTIONS, FUNCTIONS_2, Worst};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Compares the functions of shaders with the true values: those of one number for all 2^32 floats, those of two for random ones.
#[derive(Parser)]
#[command(name = "cargo xtask ulp")]
struct Arguments {
    /// Only the functions whose name contains this
    #[arg(long)]
    only: Option<String>,
    /// Every how many floats are tried
    #[arg(long, default_value_t = 1)]
    stride: usize,
    /// How many pairs are tried
    #[arg(long, default_value_t = 100_000_000)]
    pairs: u64,
    /// The first pair's number; the others follow
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// How many at a time; 0: as many as there are cores
    #[arg(long, default_value_t = 0)]
    threads: usize,
}

/// Floats that a thread takes at a time.
const CHUNK: u64 = 1 << 22;

fn main() -> ExitCode {
    let Arguments { only, stride, pairs, seed, threads } = Arguments::parse();
    let threads = match threads {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        n => n,
    };
    let is_asked_for = |name: &str| only.as_ref().is_none_or(|only| name.contains(only.as_str()));
    let mut is_well = true;
    println!("| function | tried | largest error in ULP | stated | at | nearest float |");
    println!("| --- | ---: | ---: | ---: | --- | ---: |");
    let mut report = |name: &str, admitted: f64, arguments: usize, worst: Worst| {
        let at = worst.at.map(|x| format!("{x:e}"))[..arguments].join(", ");
        let nearest = 100.0 - 100.0 * worst.not_nearest as f64 / worst.tried as f64;
        println!("| `{name}` | {} | {:.4} | {admitted} | {at} | {nearest:.4} % |", worst.tried, worst.ulps);
        is_well &= worst.ulps <= admitted;
    };
    for function in FUNCTIONS.iter().filter(|function| is_asked_for(function.name)) {
        let worst = share(function.name, 1 << 32, threads, |first, count| function.worst(first, count, stride));
        report(function.name, function.admitted, 1, worst);
    }
    for function in FUNCTIONS_2.iter().filter(|function| is_asked_for(function.name)) {
        let worst = share(function.name, pairs, threads, |first, count| function.worst(seed + first, count));
        report(function.name, function.admitted, 2, worst);
    }
    if is_well { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// All numbers below `count`, a chunk at a time over the threads.
fn share(name: &str, count: u64, threads: usize, work: impl Fn(u64, u64) -> Worst + Sync) -> Worst {
    let style = ProgressStyle::with_template("{msg:>16} {bar:40} {percent} %, {eta} to go");
    let bar = ProgressBar::new(count).with_style(style.expect("a template that indicatif reads"));
    bar.set_message(name.to_owned());
    let (next, total) = (AtomicU64::new(0), Mutex::new(Worst::default()));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let mut mine = Worst::default();
                loop {
                    let first = next.fetch_add(CHUNK, Ordering::Relaxed);
                    if first >= count {
                        break;
                    }
                    let chunk = CHUNK.min(count - first);
                    mine = mine.and(work(first, chunk));
                    bar.inc(chunk);
                }
                let mut total = total.lock().expect("no thread panics");
                *total = total.and(mine);
            });
        }
    });
    bar.finish_and_clear();
    total.into_inner().expect("no thread panics")
}
