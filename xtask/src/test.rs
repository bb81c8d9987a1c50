//! `cargo xtask test`: every test and check, one after the other.

use crate::asm::asm;
use crate::run::{cargo, root, run};
use std::path::PathBuf;
use std::time::Instant;

/// A step's name, and what it does.
type Step = (&'static str, fn() -> Result<(), String>);

/// Quick ones first; those that share a build next to each other.
const STEPS: [Step; 8] = [
    ("format", || run(cargo().args(["fmt", "--all", "--check"]))),
    ("lints", || run(cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))),
    ("tests with overflow checks, and documented examples", || run(cargo().args(["test", "--workspace"]))),
    ("the same bits and the oracle's pixels in release", || {
        run(cargo().args(["test", "--release", "--package", "pineda", "--test", "*"]))
    }),
    ("examples", examples),
    ("the README's first command", || {
        let picture = scratch()?.join("picture.png");
        run(cargo().args(["run", "--quiet", "--release", "--", "render", "-o"]).arg(picture))
    }),
    ("documentation", || run(cargo().args(["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))),
    ("asm", asm),
];

/// Runs the steps whose name contains `only`; stops at the first that fails.
pub(crate) fn test(only: Option<&str>) -> Result<(), String> {
    let start = Instant::now();
    let steps = STEPS.iter().filter(|(name, _)| only.is_none_or(|only| name.contains(only)));
    for (name, step) in steps {
        println!("\n=== {name} ===");
        let start = Instant::now();
        step().map_err(|problem| format!("{problem}\n\nfailed: {name}\nagain:  cargo xtask test --only '{name}'"))?;
        println!("=== {name}: {} s ===", start.elapsed().as_secs());
    }
    println!("\nall is well, after {} s", start.elapsed().as_secs());
    Ok(())
}

/// Every example of the library draws what it promises, in a folder where it may write.
fn examples() -> Result<(), String> {
    let folder = root().join("crates/pineda/examples");
    let files = std::fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut names: Vec<String> = files
        .flatten()
        .filter(|file| file.path().extension().is_some_and(|extension| extension == "rs"))
        .filter_map(|file| Some(file.path().file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    let scratch = scratch()?;
    for name in names {
        println!("{name}");
        let manifest = root().join("Cargo.toml");
        run(cargo()
            .current_dir(&scratch)
            // Not in release: the tests have built them already.
            .args(["run", "--quiet", "--package", "pineda", "--example", &name, "--manifest-path"])
            .arg(manifest))
        .map_err(|problem| format!("{problem}\nin the example `{name}`"))?;
    }
    Ok(())
}

/// A folder for what the checks write.
fn scratch() -> Result<PathBuf, String> {
    let folder = root().join("target/xtask");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(folder)
}
