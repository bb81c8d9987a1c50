//! The command line, declared.

mod info;
mod raster;
mod render;

pub(crate) use info::InfoArguments;
pub(crate) use raster::{RasterArguments, Show};
pub(crate) use render::{CameraArguments, FileArguments, Frame, Lights, RenderArguments, Shading, Switch, ToneMapping};

use crate::failure::Failure;
use clap::{Args, Parser, Subcommand};
use pineda::{Renderer, Settings, Simd};

/// Draws triangles and 3D models on the CPU, every pixel exact, the same on every machine.
#[derive(Debug, Parser)]
#[command(name = "pineda", version, about, after_help = EXAMPLES, propagate_version = true, disable_help_subcommand = true)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) how: How,
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "\
Examples:
  pineda render -o picture.png                  the demo scene
  pineda render model.glb -o model.png          a model: OBJ, STL, PLY, 3MF, glTF, GLB
  pineda render models/*.glb --out-dir small --size 256x256
  pineda info model.glb                         what is in it
  pineda raster -o triangle.ppm                 the tutorials' triangle
  pineda completions bash > ~/.local/share/bash-completion/completions/pineda

`pineda render --help` and so on say more.
Exit codes: 0 done, 1 a file or the machine is at fault, 2 bad usage. A file is written whole or not at all.";

/// How to draw; changes no pixel.
#[derive(Args, Debug)]
#[command(next_help_heading = "How to draw (changes no pixel)")]
pub(crate) struct How {
    /// Threads to draw with [default: one per core]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// Vector instructions to use: auto, scalar, sse2, sse4.2, avx2, avx512 or neon
    #[arg(long, global = true, value_name = "LEVEL", default_value = "auto", hide_default_value = true)]
    simd: Simd,
}

impl How {
    /// With all threads.
    pub(crate) fn renderer(&self) -> Result<Renderer, Failure> {
        self.renderer_with(self.threads.map_or(0, usize::from))
    }

    /// With this many threads.
    pub(crate) fn renderer_with(&self, threads: usize) -> Result<Renderer, Failure> {
        Ok(Renderer::new(Settings { simd: self.simd, threads, ..Settings::default() })?)
    }

    /// How many threads there are to draw with.
    pub(crate) fn threads(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from).min(256);
        self.threads.map_or_else(cores, usize::from)
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Render(Box<RenderArguments>),
    Info(InfoArguments),
    Raster(RasterArguments),
    /// Prints a script that makes a shell complete pineda's commands and options
    ///
    /// For bash: pineda completions bash > ~/.local/share/bash-completion/completions/pineda
    Completions {
        /// Whose
        shell: clap_complete::Shell,
    },
    /// Prints the manual page of pineda, or of one of its commands
    ///
    /// To read it: pineda man render | man -l -
    Man {
        /// render, info, raster, completions or man; without one, pineda itself
        command: Option<String>,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_declared_consistently() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }
}
