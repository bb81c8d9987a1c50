//! `cargo xtask test`: every test and check, one after the other.

use crate::asm::asm;
use crate::run::{cargo, root, run};
use std::path::PathBuf;
use std::time::Instant;

/// A step's name, and what it does.
type Step = (&'static str, fn() -> Result<(), String>);

/// Quick ones first; those that share a build next to each other.
const STEPS: [Step; 9] = [
    ("format", || run(cargo().args(["fmt", "--all", "--check"]))),
    ("lints", || run(cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))),
    // Examples are not built: `example_pictures` and `tutorials` have all of them but their last five lines, which write the file.
    ("tests with overflow checks", || run(cargo().args(["test", "--workspace", "--lib", "--bins", "--tests"]))),
    ("documented examples", || run(cargo().args(["test", "--workspace", "--doc"]))),
    ("the same bits and the oracle's pixels in release", || {
        run(cargo().args(["test", "--release", "--package", "pineda", "--test", "golden", "--test", "proof"]))
    }),
    ("the README's first command", || {
        let picture = scratch()?.join("picture.png");
        run(cargo().args(["run", "--quiet", "--release", "--", "render", "-o"]).arg(picture))
    }),
    ("the README's example", || {
        let manifest = root().join("Cargo.toml");
        run(cargo()
            .current_dir(scratch()?)
            .args(["run", "--quiet", "--release", "--package", "pineda", "--example", "raster2d", "--manifest-path"])
            .arg(manifest))
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

/// A folder for what the checks write.
fn scratch() -> Result<PathBuf, String> {
    let folder = root().join("target/xtask");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(folder)
}
