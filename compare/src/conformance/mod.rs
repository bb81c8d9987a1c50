//! `cargo xtask conformance`: the same cases drawn with `pineda` and with lavapipe, pixel for pixel. docs/conformance.md says what is compared, how exactly, and which differences
//! are known.
//!
//! | file | what |
//! | --- | --- |
//! | `sheet.rs` | what both renderers are given and what comes back |
//! | `ours.rs`, `theirs.rs` | a sheet drawn with `pineda`, with a Vulkan driver |
//! | `states.rs` | `pineda`'s states in WebGPU's words |
//! | `shapes.rs` | shapes packed into sheets, compared, and judged by the oracle where they differ |
//! | the others | a group of cases each |

mod blending;
mod coverage;
mod depth;
mod interpolation;
mod lookups;
mod ours;
mod reference;
mod samples;
mod shapes;
mod sheet;
mod states;
mod stencil;
mod strokes;
mod tally;
mod textures;
mod theirs;

use crate::cli::Conformance;
use crate::launch;
use anyhow::{Context, Result, bail, ensure};
use pineda::{Renderer, Settings};
use sheet::{Picture, Sheet};
use std::process::Command;
use std::time::Instant;
use tally::Tally;
use theirs::Theirs;

/// A group's name, and what draws and compares its cases.
type Group = (&'static str, fn(&mut Bench, &mut Tally) -> Result<()>);

const GROUPS: &[Group] = &[
    ("coverage of lists", coverage::lists),
    ("coverage of strips", coverage::strips),
    ("snapping", coverage::snapping),
    ("viewports, scissor", coverage::windows),
    ("across the border", coverage::border),
    ("points", strokes::points),
    ("lines, rectangular", strokes::rectangular_lines),
    ("lines, diamond exit", strokes::thin_lines),
    ("depth tests", depth::tests),
    ("depth on slopes", depth::slopes),
    ("depth bias", depth::bias),
    ("depth clamp", depth::clamp),
    ("stencil", stencil::stencil),
    ("blending, 8 bits", blending::unorm8),
    ("blending, sRGB", blending::srgb8),
    ("blending, f16", blending::float16),
    ("blending, f32", blending::float32),
    ("interpolation", interpolation::interpolation),
    ("samples of lists", samples::lists),
    ("samples of strips", samples::strips),
    ("samples of points", samples::points),
    ("samples of lines", samples::lines),
    ("samples by alpha", samples::alpha_to_coverage),
    ("samples' depths", samples::depth),
    ("averages, 8 bits", samples::unorm8),
    ("averages, sRGB", samples::srgb8),
    ("averages, f16", samples::float16),
    ("textures, nearest", textures::nearest),
    ("textures, linear", textures::linear),
    ("textures, trilinear", textures::trilinear),
    ("textures, cubes", textures::cubes),
    ("textures, compared", textures::comparisons),
    ("detail of gradients", textures::gradients),
    ("detail of surfaces", textures::surfaces),
];

/// Both renderers, and which cases to draw.
pub(crate) struct Bench {
    ours: Renderer,
    theirs: Theirs,
    seed: u64,
    times: u64,
}

impl Bench {
    /// The sheet drawn by `pineda` and by the driver.
    fn draw(&mut self, sheet: &Sheet) -> Result<[Picture; 2]> {
        Ok([ours::draw(&mut self.ours, sheet)?, self.theirs.draw(sheet)?])
    }
}

/// Draws, compares and prints the table; false if there is a difference that nobody has explained.
pub(crate) fn conformance(arguments: &Conformance) -> Result<bool> {
    if !arguments.driver_is_chosen {
        return with_driver(arguments);
    }
    let theirs = Theirs::new().context("it needs `apt-get install mesa-vulkan-drivers libvulkan1`")?;
    println!("{}", theirs.version());
    ensure!(
        theirs.version().starts_with("llvmpipe"),
        "this driver is not lavapipe: what is known of its differences is not true of it"
    );
    let mut bench =
        Bench { ours: Renderer::new(Settings::default())?, theirs, seed: arguments.seed, times: arguments.times };
    let wanted = |name: &str| arguments.only.as_deref().is_none_or(|only| name.contains(only));
    let groups: Vec<_> = GROUPS.iter().filter(|(name, _)| wanted(name)).collect();
    ensure!(!groups.is_empty(), "no group has such a name");
    println!("{:20}{}", "", Tally::HEADINGS);
    let mut total = Tally::default();
    for (name, group) in groups {
        let start = Instant::now();
        let mut tally = Tally::default();
        group(&mut bench, &mut tally)?;
        println!("{name:20}{tally}   {:.0?}", start.elapsed());
        total.add(tally, name);
    }
    println!("{:20}{total}", "together");
    for (row, example) in &total.examples {
        if row.is_none() || arguments.examples {
            println!("\n{example}");
        }
    }
    Ok(total.unexplained == 0)
}

/// Starts this program again where the environment names lavapipe as the only driver: that is how the Vulkan loader is told.
fn with_driver(arguments: &Conformance) -> Result<bool> {
    let driver = match launch::find_lavapipe(arguments.lavapipe.as_deref()) {
        Ok(driver) => driver,
        Err(advice) => bail!("there is no lavapipe to compare with: {advice}"),
    };
    let program = std::env::current_exe().context("cannot find this program")?;
    let mut command = Command::new(program);
    command.args(std::env::args_os().skip(1)).arg("--driver-is-chosen");
    launch::choose_driver(&mut command, &driver);
    // Mesa complains without it, though nothing is put there.
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        command.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    }
    Ok(command.status().context("cannot start this program")?.success())
}
