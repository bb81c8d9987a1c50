//! The command line.

use crate::backend::Peer;
use crate::scene::SceneName;
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

#[derive(Debug, Parser)]
#[command(name = "pineda-compare", about, args_conflicts_with_subcommands = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    #[command(flatten)]
    pub(crate) compare: Compare,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Draw one scene with one renderer in this process: what the comparison starts for every measurement, and a thing to profile
    Draw(Draw),
    /// How time and memory grow with the number of triangles and of pixels
    Scaling(Scaling),
    /// Draw thousands of cases with pineda and with lavapipe and compare them pixel for pixel; docs/conformance.md says what and how
    #[cfg(all(feature = "pineda", feature = "vulkan"))]
    Conformance(Conformance),
}

/// `cargo xtask conformance`.
#[cfg(all(feature = "pineda", feature = "vulkan"))]
#[derive(Args, Debug)]
pub(crate) struct Conformance {
    /// Only the groups whose name contains this
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Option<String>,
    /// Where random cases begin
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// How many times as many cases
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) times: u64,
    /// Show an example of each explained difference, too
    #[arg(long)]
    pub(crate) examples: bool,
    /// lavapipe's driver file (default: where Debian, Fedora and Arch put it)
    #[arg(long, value_name = "ICD.json")]
    pub(crate) lavapipe: Option<PathBuf>,
    /// The environment names the driver: what the command starts itself with, once it has found it
    #[arg(long, hide = true)]
    pub(crate) driver_is_chosen: bool,
}

#[derive(Args, Debug)]
pub(crate) struct Compare {
    /// Draw only this scene (repeatable; default: all)
    #[arg(long = "scene", value_name = "SCENE")]
    pub(crate) scenes: Vec<SceneName>,
    /// Draw only with this renderer (repeatable; default: all)
    #[arg(long = "peer", value_name = "PEER")]
    pub(crate) peers: Vec<Peer>,
    /// Number of threads (repeatable; default: all of the machine's, then one)
    #[arg(long = "threads", value_name = "N")]
    pub(crate) threads: Vec<usize>,
    /// How often each renderer has its turn, each time in a fresh process
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) rounds: u32,
    /// Seconds of timed frames per turn
    #[arg(long, default_value_t = 1.0)]
    pub(crate) seconds: f64,
    /// Timed frames per turn at most; five are drawn however long they take
    #[arg(long, default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) frames: u32,
    /// Write each renderer's picture of each scene to this folder as PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) pictures: Option<PathBuf>,
    /// Where the chart (chart.svg) and every frame's time (times.json) are written
    #[arg(long, value_name = "DIR", default_value = "target/comparison")]
    pub(crate) out_dir: PathBuf,
    /// This program built with -C target-cpu=native, to draw euc's pictures with
    #[arg(long, value_name = "PROGRAM")]
    pub(crate) native: Option<PathBuf>,
    /// lavapipe's driver file (default: where Debian, Fedora and Arch put it)
    #[arg(long, value_name = "ICD.json")]
    pub(crate) lavapipe: Option<PathBuf>,
    /// SwiftShader's driver file (default: beside Chromium or Chrome)
    #[arg(long, value_name = "ICD.json")]
    pub(crate) swiftshader: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub(crate) struct Scaling {
    /// Number of threads (default: all of the machine's)
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Where the plot (scaling.svg) is written
    #[arg(long, value_name = "DIR", default_value = "target/comparison")]
    pub(crate) out_dir: PathBuf,
}

#[derive(Args, Debug)]
pub(crate) struct Draw {
    #[arg(long)]
    pub(crate) peer: Peer,
    #[arg(long)]
    pub(crate) scene: SceneName,
    /// About so many triangles; for `micro`
    #[arg(long, default_value_t = 1_000_000, hide_default_value = true, value_parser = clap::value_parser!(u32).range(4..=50_000_000))]
    pub(crate) triangles: u32,
    /// A square picture of so many pixels each way; for `medium`
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(1..=16_384))]
    pub(crate) side: Option<u32>,
    /// Threads for renderers that take their number as a setting (0: all cores)
    #[arg(long, default_value_t = 0)]
    pub(crate) threads: usize,
    /// Frames before the clock starts
    #[arg(long, default_value_t = 3)]
    pub(crate) warm_up: u32,
    /// Timed frames at most
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) frames: u32,
    /// Stop after this many seconds, but not before five frames
    #[arg(long, default_value_t = f64::INFINITY, hide_default_value = true)]
    pub(crate) seconds: f64,
    /// Write the last frame to this file as PNG
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,
    /// Write version and times to this file as JSON and print nothing
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
}
