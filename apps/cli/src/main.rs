//! `pineda` on the command line: parse, call, encode.

mod arguments;
mod failure;
mod heat;
mod info;
mod output;
mod panorama;
mod picture;
mod raster;
mod render;
mod shell;
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
    let how = &arguments.how;
    match &arguments.command {
        Command::Render(arguments) => render::run(arguments, how),
        Command::Info(arguments) => info::run(arguments),
        Command::Raster(arguments) => raster::run(arguments, &mut how.renderer()?),
        Command::Completions { shell } => shell::completions(*shell),
        Command::Man { command } => shell::man(command.as_deref()),
    }
}
