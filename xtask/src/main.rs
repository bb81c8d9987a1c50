//! The project's own commands: `cargo xtask test`, `prove`, `ulp`, `asm`, `count`, `compare`, `scaling`, `conformance`, `fidelity`.
//!
//! They are programs rather than shell scripts so that they run wherever Rust does.

mod asm;
mod count;
mod run;
mod test;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// The project's own commands.
#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Every test and check; what CI runs
    Test {
        /// Only the steps whose name contains this
        #[arg(long)]
        only: Option<String>,
    },
    /// Judges random cases by the exact oracle: --cases N, --seed S, --threads T
    #[command(disable_help_flag = true)]
    Prove(Forwarded),
    /// Compares shaders' functions with the true values, for every float (docs/math.md): --only NAME, --pairs N, --stride N
    #[command(disable_help_flag = true)]
    Ulp(Forwarded),
    /// Checks the kernels' machine code: no calls to lane operations, no scalar leftovers
    Asm,
    /// Counts the instructions of a frame of each scene (valgrind) and compares them with docs/instructions.txt: more than 3 % more fail
    Count {
        /// Write the record anew
        #[arg(long)]
        record: bool,
    },
    /// Draws the same scenes with pineda, lavapipe, llvmpipe, SwiftShader, euc and Embree, as far as they are installed, and compares times and pictures. Debian has lavapipe in
    /// `mesa-vulkan-drivers`, llvmpipe in `libegl-mesa0`, SwiftShader in `chromium`, Embree in `libembree-dev`
    #[command(disable_help_flag = true)]
    Compare(Forwarded),
    /// Shows how time and memory grow, from a thousand triangles to ten million and from 256 x 256 pixels to 8192 x 8192
    #[command(disable_help_flag = true)]
    Scaling(Forwarded),
    /// Draws thousands of cases with pineda and with lavapipe, and compares them pixel for pixel (docs/conformance.md)
    #[command(disable_help_flag = true)]
    Conformance(Forwarded),
    /// Draws models with pineda and with three.js in Chromium, and compares them pixel for pixel (docs/fidelity.md): --only NAME, --size N
    #[command(disable_help_flag = true)]
    Fidelity(Forwarded),
}

/// Arguments for the program that does the work.
#[derive(clap::Args)]
struct Forwarded {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
}

fn main() -> ExitCode {
    let result = match Arguments::parse().task {
        Task::Test { only } => test::test(only.as_deref()),
        Task::Prove(Forwarded { arguments }) => run::prove(&arguments),
        Task::Ulp(Forwarded { arguments }) => run::ulp(&arguments),
        Task::Asm => asm::asm(),
        Task::Count { record } => count::count(record),
        Task::Compare(Forwarded { arguments }) => run::compare(&arguments),
        Task::Scaling(Forwarded { arguments }) => run::of_comparison("scaling", &arguments),
        Task::Conformance(Forwarded { arguments }) => run::of_comparison("conformance", &arguments),
        Task::Fidelity(Forwarded { arguments }) => run::fidelity(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}
