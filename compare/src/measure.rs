//! The comparison: rounds in which every renderer has its turn at every scene, so that a noisy minute hits all of them alike.

use crate::backend::Peer;
use crate::chart;
use crate::cli::Compare;
use crate::launch::{self, Found, Turn};
use crate::machine::{self, Machine};
use crate::picture;
use crate::scene::SceneName;
use crate::table;
use anyhow::{Context, Result, ensure};
use clap::ValueEnum;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Pictures of which more than this part differs show different things.
const ALIKE: f64 = 0.01;

/// Every frame of one renderer at one scene with one number of threads.
#[derive(Debug, Serialize)]
pub(crate) struct Measurement {
    pub(crate) peer: Peer,
    pub(crate) scene: SceneName,
    /// As used: never more than the renderer can make use of.
    pub(crate) threads: usize,
    pub(crate) version: String,
    /// Milliseconds a frame, round by round.
    pub(crate) rounds_ms: Vec<Vec<f64>>,
    /// Processor time a frame, all threads together, round by round.
    pub(crate) rounds_cpu_ms: Vec<f64>,
    /// The most memory that a process has had, in MiB.
    pub(crate) peak_mib: Option<f64>,
}

impl Measurement {
    /// The median of the rounds' medians.
    pub(crate) fn median_ms(&self) -> f64 {
        median(&self.rounds_ms.iter().map(|frames| median(frames)).collect::<Vec<_>>())
    }

    /// The median of the rounds' processor times.
    pub(crate) fn cpu_ms(&self) -> Option<f64> {
        (!self.rounds_cpu_ms.is_empty()).then(|| median(&self.rounds_cpu_ms))
    }

    /// The fastest frame of all.
    pub(crate) fn minimum_ms(&self) -> f64 {
        minimum(&self.rounds_ms.concat())
    }
}

/// How far one renderer's picture is from the reference's.
#[derive(Debug, Serialize)]
pub(crate) struct Likeness {
    pub(crate) peer: Peer,
    pub(crate) reference: Peer,
    pub(crate) scene: SceneName,
    /// Part of the pixels that differ by more than two codes.
    pub(crate) differing: f64,
}

impl Likeness {
    pub(crate) fn is_alike(&self) -> bool {
        let allowed = match self.scene {
            // How anisotropic lookups are laid out is each driver's own affair.
            SceneName::Floor => 0.25,
            // SwiftShader keeps four bits of a vertex's fraction of a pixel, the others eight: thin needles go another way.
            SceneName::Slivers => 0.05,
            _ => ALIKE,
        };
        self.differing < allowed
    }
}

/// All that a comparison found out.
#[derive(Debug, Serialize)]
pub(crate) struct Results {
    pub(crate) machine: Machine,
    pub(crate) rounds: u32,
    /// By number of threads: GB/s that a plain loop writes.
    pub(crate) write_bandwidths: Vec<(usize, f64)>,
    pub(crate) measurements: Vec<Measurement>,
    pub(crate) likenesses: Vec<Likeness>,
}

/// Measures, prints the table and writes what was asked for; false if a renderer failed or drew something else than the others.
pub(crate) fn compare(arguments: &Compare) -> Result<bool> {
    ensure!(!arguments.threads.contains(&0), "--threads wants at least 1");
    let scratch = Scratch::new()?;
    let machine = Machine::this();
    let renderers = find_all(arguments);
    ensure!(!renderers.is_empty(), "none of the renderers is on this machine");
    let pictures = arguments.pictures.as_deref().unwrap_or(&scratch.0);
    std::fs::create_dir_all(pictures).with_context(|| format!("cannot make the folder {}", pictures.display()))?;
    // The processes that draw run in another folder.
    let pictures = std::path::absolute(pictures)?;

    let scenes = or_all(&arguments.scenes);
    let thread_counts = thread_counts(arguments, machine.cores);
    let mut measurements = plan(&renderers, &scenes, &thread_counts);
    let write_bandwidths = thread_counts.iter().map(|&threads| (threads, machine::write_bandwidth(threads))).collect();
    let mut failures = Vec::new();
    for round in 1..=arguments.rounds {
        for measurement in &mut measurements {
            let Some(found) = renderers.iter().find(|found| found.peer == measurement.peer) else { continue };
            let (peer, scene, threads) = (measurement.peer.as_str(), measurement.scene.as_str(), measurement.threads);
            eprint!("\r\x1b[Kround {round} of {}: {scene}, {peer}, threads {threads}", arguments.rounds);
            let picture = picture_path(&pictures, measurement.scene, measurement.peer);
            let turn = Turn {
                found,
                scene: measurement.scene,
                threads,
                cores: machine.cores,
                frames: arguments.frames,
                seconds: arguments.seconds,
                picture: (round == 1).then_some(&picture),
                scratch: &scratch.0,
            };
            match turn.run() {
                Ok(report) => {
                    measurement.version = match &found.package {
                        Some(package) => format!("{}, {package}", report.version),
                        None => report.version,
                    };
                    measurement.rounds_ms.push(report.frames_ms);
                    measurement.rounds_cpu_ms.extend(report.cpu_ms);
                    measurement.peak_mib = report.peak_mib.into_iter().chain(measurement.peak_mib).reduce(f64::max);
                }
                Err(error) => failures.push(format!("{peer} failed at {scene} with {threads} threads: {error:#}")),
            }
        }
    }
    eprint!("\r\x1b[K");
    measurements.retain(|measurement| !measurement.rounds_ms.is_empty());
    let likenesses = compare_pictures(&measurements, &scenes, &pictures)?;
    let results = Results { machine, rounds: arguments.rounds, write_bandwidths, measurements, likenesses };
    table::print(&results);
    std::fs::create_dir_all(&arguments.out_dir)
        .with_context(|| format!("cannot make the folder {}", arguments.out_dir.display()))?;
    for (name, contents) in [("times.json", serde_json::to_string(&results)?), ("chart.svg", chart::svg(&results))] {
        let path = arguments.out_dir.join(name);
        std::fs::write(&path, contents).with_context(|| format!("cannot write {}", path.display()))?;
        println!("written: {}", path.display());
    }
    for failure in &failures {
        eprintln!("{failure}");
    }
    Ok(failures.is_empty() && results.likenesses.iter().all(Likeness::is_alike))
}

/// The middle value, or the mean of the two middle ones.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len().is_multiple_of(2) { 0.5 * (sorted[middle - 1] + sorted[middle]) } else { sorted[middle] }
}

/// The least value.
pub(crate) fn minimum(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn find_all(arguments: &Compare) -> Vec<Found> {
    let mut renderers = Vec::new();
    for peer in or_all(&arguments.peers) {
        match launch::find(peer, arguments) {
            Ok(found) => renderers.push(found),
            Err(advice) => eprintln!("{} is left out: {advice}", peer.as_str()),
        }
    }
    renderers
}

fn or_all<T: ValueEnum>(chosen: &[T]) -> Vec<T> {
    if chosen.is_empty() { T::value_variants().to_vec() } else { chosen.to_vec() }
}

fn thread_counts(arguments: &Compare, cores: usize) -> Vec<usize> {
    let mut counts = if arguments.threads.is_empty() { vec![cores, 1] } else { arguments.threads.clone() };
    counts.dedup();
    counts
}

/// The turns of a round, in order: renderers alternate at each scene.
fn plan(renderers: &[Found], scenes: &[SceneName], thread_counts: &[usize]) -> Vec<Measurement> {
    let mut measurements: Vec<Measurement> = Vec::new();
    for &scene in scenes {
        for &asked in thread_counts {
            for peer in renderers.iter().map(|found| found.peer).filter(|peer| peer.draws(scene)) {
                let threads = peer.useful_threads(asked);
                let planned =
                    |earlier: &Measurement| (earlier.peer, earlier.scene, earlier.threads) == (peer, scene, threads);
                if !measurements.iter().any(planned) {
                    measurements.push(Measurement {
                        peer,
                        scene,
                        threads,
                        version: String::new(),
                        rounds_ms: Vec::new(),
                        rounds_cpu_ms: Vec::new(),
                        peak_mib: None,
                    });
                }
            }
        }
    }
    measurements
}

/// Each scene's first renderer is the reference for the others.
fn compare_pictures(measurements: &[Measurement], scenes: &[SceneName], pictures: &Path) -> Result<Vec<Likeness>> {
    let mut likenesses = Vec::new();
    for &scene in scenes {
        let mut peers: Vec<Peer> = measurements.iter().filter(|one| one.scene == scene).map(|one| one.peer).collect();
        peers.sort_unstable();
        peers.dedup();
        let Some((&reference, others)) = peers.split_first() else { continue };
        let expected = picture::read(&picture_path(pictures, scene, reference))?;
        for &peer in others {
            let differing = picture::difference(&expected, &picture::read(&picture_path(pictures, scene, peer))?);
            likenesses.push(Likeness { peer, reference, scene, differing });
        }
    }
    Ok(likenesses)
}

fn picture_path(folder: &Path, scene: SceneName, peer: Peer) -> PathBuf {
    folder.join(format!("{}-{}.png", scene.as_str(), peer.as_str()))
}

/// A folder of this process's own, gone when the comparison is over.
struct Scratch(PathBuf);

impl Scratch {
    fn new() -> Result<Self> {
        let folder = std::env::temp_dir().join(format!("pineda-compare-{}", std::process::id()));
        std::fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
        Ok(Self(folder))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What is left behind lies in the system's folder for temporary files.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_of_odd_and_even_counts() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 3.0, 2.0]), 2.5);
    }
}
