//! Draws the same scenes with `pineda` and its peers on this machine, in turn, and prints how long each took. See README.md.

mod backend;
mod chart;
mod cli;
#[cfg(all(feature = "pineda", feature = "vulkan"))]
mod conformance;
#[cfg(feature = "vulkan")]
mod device;
mod draw;
mod launch;
mod machine;
mod measure;
mod picture;
mod scaling;
mod scene;
mod table;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    let outcome = match arguments.command {
        Some(cli::Command::Draw(draw)) => draw::draw(&draw).map(|()| true),
        Some(cli::Command::Scaling(arguments)) => scaling::scaling(&arguments).map(|()| true),
        #[cfg(all(feature = "pineda", feature = "vulkan"))]
        Some(cli::Command::Conformance(arguments)) => conformance::conformance(&arguments),
        None => measure::compare(&arguments.compare),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
