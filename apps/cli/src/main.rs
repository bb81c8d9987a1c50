//! `pineda` on the command line: parse, call, encode.

mod arguments;
mod failure;
mod output;
mod picture;
mod raster;
mod render;
mod srgb;
mod values;

use arguments::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    // Exits by itself on bad usage (2) and after --help (0).
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // Nobody is left to tell if standard error is closed.
            let _ = write!(std::io::stderr(), "{failure}");
            failure.exit_code()
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut renderer = arguments.how.renderer()?;
    match &arguments.command {
        Command::Raster(arguments) => raster::run(arguments, &mut renderer),
        Command::Render(arguments) => render::run(arguments, &mut renderer),
    }
}
