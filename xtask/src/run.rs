//! Running cargo, and the programs that do a task's work.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The repository.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask is a folder of the repository").to_path_buf()
}

/// The cargo that runs this.
pub(crate) fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    command
}

/// Runs a command to its end.
///
/// # Errors
/// The command cannot be started, or fails; it has said why itself.
pub(crate) fn run(command: &mut Command) -> Result<(), String> {
    let name = command.get_program().to_string_lossy().into_owned();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{name}` failed ({status})")),
        Err(error) => Err(format!("`{name}` cannot be started: {error}")),
    }
}

/// `cargo xtask prove`.
pub(crate) fn prove(arguments: &[String]) -> Result<(), String> {
    proof("prove", arguments)
}

/// `cargo xtask ulp`.
pub(crate) fn ulp(arguments: &[String]) -> Result<(), String> {
    proof("ulp", arguments)
}

/// A program of the crate that proves.
fn proof(program: &str, arguments: &[String]) -> Result<(), String> {
    run(cargo()
        .args(["run", "--quiet", "--release", "--package", "pineda-proof", "--bin", program, "--"])
        .args(arguments))
}

/// `cargo xtask conformance` and `scaling`: parts of the program that compares times, for that has drivers and scenes already.
pub(crate) fn of_comparison(command: &str, arguments: &[String]) -> Result<(), String> {
    let mut cargo = cargo();
    cargo.current_dir(root().join("compare")).env_remove("CARGO_TARGET_DIR");
    run(cargo.args(["run", "--quiet", "--release", "--", command]).args(arguments))
}

/// `cargo xtask compare`: a workspace of its own, whose dependencies are no part of this one. euc has its program twice, for it is the only one
/// that must be built for this machine to show what it can do.
pub(crate) fn compare(arguments: &[String]) -> Result<(), String> {
    let folder = root().join("compare");
    let cargo = || {
        let mut cargo = cargo();
        cargo.current_dir(&folder).env_remove("CARGO_TARGET_DIR");
        cargo
    };
    let native = folder.join("target/native");
    run(cargo()
        .args(["build", "--release", "--no-default-features", "--target-dir"])
        .arg(&native)
        .env("RUSTFLAGS", "-C target-cpu=native"))?;
    let native = native.join("release").join(format!("pineda-compare{}", std::env::consts::EXE_SUFFIX));
    let mut program = cargo();
    program.args(["run", "--release"]);
    if has_embree() {
        program.args(["--features", "embree"]);
    }
    run(program.args(["--", "--native"]).arg(native).args(arguments)).map_err(|problem| {
        format!(
            "{problem}\nThe peers: `apt-get install mesa-vulkan-drivers libvulkan1` for lavapipe, `libegl-mesa0 libegl1` for llvmpipe, `chromium` for \
             SwiftShader's library, `libembree-dev` for Embree; euc is a crate. {}/README.md says where they are looked for.",
            folder.display()
        )
    })
}

/// `cargo xtask fidelity`: a script for Node, because three.js runs in a browser.
pub(crate) fn fidelity(arguments: &[String]) -> Result<(), String> {
    run(cargo().args(["build", "--quiet", "--release", "--package", "pineda-cli"]))?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), Into::into);
    let binary = target.join("release").join(format!("pineda{}", std::env::consts::EXE_SUFFIX));
    let folder = root().join("fidelity");
    let compare = || {
        if !folder.join("node_modules").is_dir() {
            run(Command::new("npm").args(["ci", "--no-audit", "--no-fund"]).current_dir(&folder))?;
        }
        run(Command::new("node").args(["--test", "fidelity/judge.test.mjs"]).current_dir(root()))?;
        run(Command::new("node")
            .arg("fidelity/compare.mjs")
            .arg("--pineda")
            .arg(&binary)
            .args(arguments)
            .current_dir(root()))
    };
    compare().map_err(|problem| {
        format!("{problem}\nIt needs Node with npm, and Chromium: `apt-get install nodejs npm chromium`. See fidelity/README.md.")
    })
}

/// Whether Embree 3 is where a linker finds it.
fn has_embree() -> bool {
    let arch = std::env::consts::ARCH;
    [format!("/usr/lib/{arch}-linux-gnu"), "/usr/lib64".to_owned(), "/usr/lib".to_owned(), "/usr/local/lib".to_owned()]
        .iter()
        .any(|folder| Path::new(folder).join("libembree3.so").is_file())
}
