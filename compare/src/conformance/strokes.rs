//! Points and lines, one pixel large: which pixels belong to them, and which of them came last.
//!
//! Through WebGPU lavapipe draws every line as Vulkan's default asks of a driver with strict lines: as a rectangle one pixel wide. That is what `pineda` does with lines
//! that are wider than a pixel, if by ever so little; one of width 1 it draws by diamond exit. Both are compared.

use super::Bench;
use super::coverage::point;
use super::shapes::{Shape, compare};
use super::tally::{Row, Tally};
use anyhow::Result;
use pineda::{Cull, PrimitiveTopology};
use pineda_oracle::Point;
use pineda_oracle::cases::Random;

const CELL: u32 = 32;
/// The next f32 after 1.
const JUST_WIDE: f32 = 1.0 + f32::EPSILON;

/// Squares around points of the grid.
pub(crate) fn points(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = shapes(bench, |_| PrimitiveTopology::PointList, 1.0);
    compare(bench, shapes, tally, |_, _, _| None)
}

/// Lists and strips of lines, as rectangles.
pub(crate) fn rectangular_lines(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = shapes(bench, list_or_strip, JUST_WIDE);
    compare(bench, shapes, tally, |shape, pixel, theirs| is_rectangle(shape, pixel, theirs).then_some(Row::LineCorners))
}

/// The same by diamond exit; lavapipe draws rectangles.
pub(crate) fn thin_lines(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = shapes(bench, list_or_strip, 1.0);
    compare(bench, shapes, tally, |shape, pixel, theirs| is_rectangle(shape, pixel, theirs).then_some(Row::ThinLines))
}

/// Whether these are the colours of lines that are rectangles, the corners of which are computed to a few roundings of f32.
fn is_rectangle(shape: &Shape, pixel: [u32; 2], colors: [u8; 4]) -> bool {
    let mut wide = shape.clone();
    [-3, 1, 3].into_iter().any(|roundings| {
        wide.state.line_width = 1.0 + roundings as f32 * f32::EPSILON;
        colors == wide.expected(pixel)
    })
}

fn list_or_strip(random: &mut Random) -> PrimitiveTopology {
    random.pick(&[PrimitiveTopology::LineList, PrimitiveTopology::LineStrip])
}

/// Cells with a few vertices each, the squares and rectangles around which do not reach the cell's border.
fn shapes(bench: &Bench, topology: impl Fn(&mut Random) -> PrimitiveTopology, line_width: f32) -> Vec<Shape> {
    let shape = |seed: u64| {
        let mut random = Random::new(seed);
        let mut corners: Vec<Point> = Vec::new();
        let count = 2 * random.between(1, 6);
        for _ in 0..count {
            let inside = point(&mut random, CELL - 2).map(|x| x + 256);
            // Upright, level, or at 45 degrees from the one before, one time in three.
            let last = corners.last().copied().unwrap_or(inside);
            corners.push(match random.between(0, 8) {
                0 => [last[0], inside[1]],
                1 => [inside[0], last[1]],
                2 => [last[0] + inside[1] - last[1], inside[1]],
                _ => inside,
            });
        }
        corners.iter_mut().flatten().for_each(|x| *x = (*x).clamp(256, 256 * (i64::from(CELL) - 1)));
        let mut shape = Shape::new(seed, CELL, corners, (0..count as u32).collect(), &mut random);
        shape.state.cull = Cull::None;
        (shape.state.topology, shape.state.line_width) = (topology(&mut random), line_width);
        shape
    };
    (bench.seed..).take(16_000 * bench.times as usize).map(shape).collect()
}
