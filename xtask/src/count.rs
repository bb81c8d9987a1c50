//! `cargo xtask count`: how many instructions a frame takes, against what is on record.
//!
//! Times say how fast a machine is today; numbers of instructions are the same on every run. valgrind counts them, and shows programs a processor with AVX2: AVX-512's way is not in the record.

use crate::run::{cargo, root, run};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The scenes that are counted; those that take seconds under valgrind.
const SCENES: [&str; 8] =
    ["fill_front_to_back", "fill_back_to_front", "blend", "micro", "medium", "msaa", "depth_only", "textured"];
/// Of the frames whose instructions are counted. What a process does besides is in two runs alike.
const FRAMES: [u32; 2] = [1, 3];
/// By how much a frame may grow unnoticed.
const ALLOWED_GROWTH: f64 = 0.03;

/// Counts all scenes and compares them with the record, or writes it anew.
///
/// # Errors
/// valgrind is not there; a scene takes over 3 % more instructions than the record says.
pub(crate) fn count(write_record: bool) -> Result<(), String> {
    let program = build()?;
    let path = root().join("docs/instructions.txt");
    let record = if write_record { BTreeMap::new() } else { read(&path)? };
    let (mut lines, mut grown) = (String::new(), Vec::new());
    for scene in SCENES {
        let [few, many] = FRAMES.map(|frames| instructions(&program, scene, frames));
        let a_frame = many?.saturating_sub(few?) / u64::from(FRAMES[1] - FRAMES[0]);
        lines += &format!("{scene} {a_frame}\n");
        match record.get(scene) {
            Some(&before) => {
                let growth = a_frame as f64 / before as f64 - 1.0;
                println!("{scene:20} {a_frame:>13} instructions a frame, {:+.2} %", 100.0 * growth);
                if growth > ALLOWED_GROWTH {
                    grown.push(scene);
                }
            }
            None => println!("{scene:20} {a_frame:>13} instructions a frame"),
        }
    }
    if write_record {
        std::fs::write(&path, lines).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    if grown.is_empty() {
        return Ok(());
    }
    Err(format!(
        "more instructions than on record: {}\nIf that is worth it, say why in the commit that writes the record anew: cargo xtask count --record",
        grown.join(", ")
    ))
}

/// The program that draws the scenes of `compare/`, with this repository's rasterizer only.
fn build() -> Result<PathBuf, String> {
    let folder = root().join("compare");
    let target = folder.join("target/count");
    run(cargo()
        .current_dir(&folder)
        .args(["build", "--quiet", "--release", "--no-default-features", "--features", "pineda", "--target-dir"])
        .arg(&target))?;
    Ok(target.join("release").join(format!("pineda-compare{}", std::env::consts::EXE_SUFFIX)))
}

/// Scenes and their numbers, a line each.
fn read(path: &Path) -> Result<BTreeMap<String, u64>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    text.lines()
        .map(|line| {
            let (scene, number) =
                line.split_once(' ').ok_or_else(|| format!("{}: what is {line:?}?", path.display()))?;
            let number = number.parse().map_err(|error| format!("{}: {line:?}: {error}", path.display()))?;
            Ok((scene.to_owned(), number))
        })
        .collect()
}

/// All instructions of a process that draws so many frames with one thread.
fn instructions(program: &Path, scene: &str, frames: u32) -> Result<u64, String> {
    let output = Command::new("valgrind")
        .args(["--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"])
        .arg(program)
        .args(["draw", "--peer", "pineda", "--scene", scene, "--threads", "1", "--warm-up", "1"])
        .args(["--frames", &frames.to_string()])
        .output()
        .map_err(|error| format!("`valgrind` cannot be started ({error}); Debian: apt-get install valgrind"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    let total = said.lines().find_map(|line| line.split_once("I   refs:").or_else(|| line.split_once("I refs:")));
    total
        .and_then(|(_, number)| number.trim().replace(',', "").parse().ok())
        .ok_or_else(|| format!("valgrind did not count {scene}:\n{said}"))
}
