//! `cargo xtask prove`: as many cases as one has patience for.

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use pineda_proof::{Judge, Tally};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Judges random cases by the exact oracle, each pixel of each, over all SIMD levels, thread counts and tile sizes.
#[derive(Parser)]
#[command(name = "cargo xtask prove")]
struct Arguments {
    /// How many cases
    #[arg(long, default_value_t = 1_000_000)]
    cases: u64,
    /// The first case's number; the others follow
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Cases judged at a time; 0: as many as there are cores
    #[arg(long, default_value_t = 0)]
    threads: usize,
}

/// Cases that a thread takes at a time.
const CHUNK: u64 = 256;

fn main() -> ExitCode {
    let Arguments { cases, seed, threads } = Arguments::parse();
    let threads = match threads {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        n => n,
    };
    let style = ProgressStyle::with_template("{bar:40} {human_pos} of {human_len} cases, {per_sec}, {eta} to go");
    let bar = ProgressBar::new(cases).with_style(style.expect("a template that indicatif reads"));
    let (next, failed) = (AtomicU64::new(0), AtomicBool::new(false));
    let (total, problems) = (Mutex::new(Tally::default()), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let mut judge = Judge::default();
                loop {
                    let first = next.fetch_add(CHUNK, Ordering::Relaxed);
                    if first >= cases || failed.load(Ordering::Relaxed) {
                        break;
                    }
                    let last = cases.min(first + CHUNK);
                    let problem = (first..last).find_map(|n| judge.judge(seed + n).err());
                    bar.inc(last - first);
                    if let Some(problem) = problem {
                        failed.store(true, Ordering::Relaxed);
                        problems.lock().expect("no thread panics").push(problem);
                    }
                }
                total.lock().expect("no thread panics").add(judge.tally());
            });
        }
    });
    bar.finish_and_clear();
    println!("{}", total.into_inner().expect("no thread panics"));
    for problem in &problems.into_inner().expect("no thread panics") {
        eprintln!("{problem}");
    }
    if failed.into_inner() { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
