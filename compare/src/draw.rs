//! One renderer, one scene, this process: warm up, then time frames.

use crate::cli::Draw;
use crate::machine;
use crate::measure::{median, minimum};
use crate::picture;
use crate::scene::Scene;
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Frames before the clock starts: shaders compile in the first, memory is touched and caches and branch predictors settle in the others.
const WARM_UP_FRAMES: u32 = 3;
/// A time limit does not leave fewer timed frames than this.
const FEWEST_FRAMES: u32 = 5;

/// What the process measured.
#[derive(Debug, Deserialize, Serialize)]
pub(crate) struct Report {
    pub(crate) version: String,
    pub(crate) frames_ms: Vec<f64>,
    /// Processor time a frame, all threads together, on average; where the system says it.
    pub(crate) cpu_ms: Option<f64>,
}

pub(crate) fn draw(arguments: &Draw) -> Result<()> {
    let scene = Scene::new(arguments.scene);
    let mut backend = arguments.peer.load(&scene, arguments.threads)?;
    for _ in 0..WARM_UP_FRAMES {
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
        picture::write(path, &backend.picture())?;
    }
    let report = Report { version: backend.version(), frames_ms, cpu_ms };
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
            Ok(())
        }
    }
}
