//! One renderer, one scene, this process: warm up, then time frames.

use crate::cli::Draw;
use crate::machine;
use crate::measure::{median, minimum};
use crate::picture;
use crate::scene::{Scene, SceneName};
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// A time limit does not leave fewer timed frames than this.
const FEWEST_FRAMES: u32 = 5;

/// What the process measured.
#[derive(Debug, Deserialize, Serialize)]
pub(crate) struct Report {
    pub(crate) version: String,
    pub(crate) frames_ms: Vec<f64>,
    /// Processor time a frame, all threads together, on average; where the system says it.
    pub(crate) cpu_ms: Option<f64>,
    /// The most memory that the process has had, where the system says it.
    pub(crate) peak_mib: Option<f64>,
    /// What the scene's vertices and indices take of that.
    pub(crate) scene_mib: f64,
}

pub(crate) fn draw(arguments: &Draw) -> Result<()> {
    let scene = match (arguments.scene, arguments.side) {
        (SceneName::Micro, _) => Scene::of_triangles(arguments.triangles),
        (SceneName::Medium, Some(side)) => Scene::of_pixels(side),
        (name, _) => Scene::new(name),
    };
    let mut backend = arguments.peer.load(&scene, arguments.threads)?;
    // Shaders compile in the first, memory is touched and caches and branch predictors settle in the others.
    for _ in 0..arguments.warm_up {
        backend.draw()?;
    }
    let mut frames_ms = Vec::with_capacity(arguments.frames as usize);
    let start = Instant::now();
    let cpu_start = machine::process_cpu_ms();
    for frame in 0..arguments.frames {
        if frame >= FEWEST_FRAMES && start.elapsed().as_secs_f64() > arguments.seconds {
            break;
        }
        let frame_start = Instant::now();
        backend.draw()?;
        frames_ms.push(1e3 * frame_start.elapsed().as_secs_f64());
    }
    let cpu_ms = cpu_start.zip(machine::process_cpu_ms());
    let cpu_ms = cpu_ms.map(|(start, end)| (end - start) / frames_ms.len() as f64);
    if let Some(path) = &arguments.picture {
        picture::write(path, scene.size, &backend.picture())?;
    }
    let report =
        Report { version: backend.version(), frames_ms, cpu_ms, peak_mib: machine::peak_mib(), scene_mib: scene.mib() };
    match &arguments.report {
        Some(path) => {
            let json = serde_json::to_vec(&report)?;
            std::fs::write(path, json).with_context(|| format!("cannot write {}", path.display()))
        }
        None => {
            println!("{}", report.version);
            let (frames, median, least) =
                (report.frames_ms.len(), median(&report.frames_ms), minimum(&report.frames_ms));
            println!("{}: {frames} frames, median {median:.3} ms, fastest {least:.3} ms", arguments.scene.as_str());
            if let Some(cpu_ms) = report.cpu_ms {
                println!("processor time {cpu_ms:.3} ms a frame, all threads together");
            }
            if let Some(peak_mib) = report.peak_mib {
                println!("at most {peak_mib:.0} MiB of memory");
            }
            Ok(())
        }
    }
}
