//! The project's own commands: `cargo xtask test`, `prove`, `ulp`, `asm`, `compare`, `conformance`, `fidelity`.
//!
//! They are programs rather than shell scripts so that they run wherever Rust does.

mod asm;
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
    /// Draws the same scenes with pineda, lavapipe, SwiftShader and euc, and compares times and pictures
    #[command(disable_help_flag = true)]
    Compare(Forwarded),
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
        Task::Compare(Forwarded { arguments }) => run::compare(&arguments),
        Task::Conformance(Forwarded { arguments }) => run::conformance(&arguments),
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
