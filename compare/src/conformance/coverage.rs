//! Coverage: which pixels belong to which triangle, and which of them came last.

use super::Bench;
use super::shapes::{SMALLEST_CELL, Shape, compare};
use super::tally::{Row, Tally};
use anyhow::Result;
use pineda::{PrimitiveTopology, Scissor, Viewport};
use pineda_oracle::Point;
use pineda_oracle::cases::{Case, Random, Space};

/// Pixels by which a cut moves an edge, where the cut's end is snapped: half of 1/256 in x and in y.
const SHIFT: f64 = std::f64::consts::SQRT_2 / 512.0;

/// The oracle's cases in raster space that fit a sheet: slivers, shared edges, meshes, edges and corners on pixel centres, with culling.
pub(crate) fn lists(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    // How many there may be of each size of cell, from 32 to 2048 pixels: of large ones fewer, for a sheet holds fewer.
    let mut room = [40_000, 20_000, 4_000, 1_000, 250, 60, 16].map(|count| count * bench.times);
    let mut shapes = Vec::new();
    for seed in (bench.seed..).take(1_000_000 * bench.times as usize) {
        if let Some(shape) = shape_of_case(&Case::from_seed(seed)) {
            let room = &mut room[(shape.cell / SMALLEST_CELL).ilog2() as usize];
            if *room > 0 {
                *room -= 1;
                shapes.push(shape);
            }
        }
        if room == [0; 7] {
            break;
        }
    }
    compare(bench, shapes, tally, |_, _, _| None)
}

/// Strips, many in a draw: a walk from point to point, back and forth, on the spot. The first vertex of each triangle provokes.
pub(crate) fn strips(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = (bench.seed..).take(24_000 * bench.times as usize).map(|seed| {
        let mut random = Random::new(seed);
        let cell = random.pick(&[32, 64]);
        let mut corners: Vec<Point> = Vec::new();
        for _ in 0..random.between(3, 24) {
            let corner = point(&mut random, cell);
            corners.push(if random.one_in(8) { corners.last().copied().unwrap_or(corner) } else { corner });
        }
        let indices = (0..corners.len() as u32).collect();
        let mut shape = Shape::new(seed, cell, corners, indices, &mut random);
        shape.state.topology = PrimitiveTopology::TriangleStrip;
        shape
    });
    let shapes = shapes.collect();
    compare(bench, shapes, tally, |_, _, _| None)
}

/// Triangles whose corners are given in 1/4096 pixel: snapped to the nearest 1/256, ties to even. Small ones, and edges near centres, so that a corner snapped otherwise shows.
pub(crate) fn snapping(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = (bench.seed..).take(20_000 * bench.times as usize).map(|seed| {
        let mut random = Random::new(seed);
        let cell = 32;
        let given: Vec<[i64; 2]> = (0..9)
            .map(|_| {
                [0; 2].map(|_| {
                    let near_centre = 4096 * random.between(0, i64::from(cell) - 1) + 2048 + random.between(-40, 40);
                    let any = random.between(16, 4096 * i64::from(cell) - 16);
                    // Half way between two points of the grid, one time in two.
                    let x = random.pick(&[near_centre, any]);
                    if random.one_in(2) { x / 16 * 16 + 8 } else { x }
                })
            })
            .collect();
        let corners = given.iter().map(|point| point.map(nearest_even)).collect();
        let mut shape = Shape::new(seed, cell, corners, (0..9).collect(), &mut random);
        let beside = |(given, corner): (&[i64; 2], &Point)| [0, 1].map(|axis| given[axis] - 16 * corner[axis]);
        shape.besides = given.iter().zip(&shape.corners).map(beside).collect();
        shape
    });
    let shapes = shapes.collect();
    compare(bench, shapes, tally, |_, _, _| None)
}

/// From 1/4096 pixel, not negative, to 1/256.
fn nearest_even(x: i64) -> i64 {
    let (below, beside) = (x / 16, x % 16);
    if beside > 8 || (beside == 8 && below % 2 == 1) { below + 1 } else { below }
}

/// Scissor rectangles, and viewports anywhere in the picture, some upside down, with triangles that stay inside of the viewport.
pub(crate) fn windows(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = (bench.seed..).take(6_000 * bench.times as usize).map(|seed| {
        let mut random = Random::new(seed);
        let cell = 64;
        let [width, height] = [0; 2].map(|_| random.pick(&[16, 32, 64]));
        // Where the viewport begins: whole pixels, or any point of the grid.
        let start = [width, height].map(|size| {
            let start = random.between(0, 256 * (cell - size));
            if random.one_in(2) { start / 256 * 256 } else { start }
        });
        let inside = |random: &mut Random, axis: usize, size: i64| start[axis] + random.between(0, 256 * size);
        let corners: Vec<Point> =
            (0..9).map(|_| [inside(&mut random, 0, width), inside(&mut random, 1, height)]).collect();
        let mut shape = Shape::new(seed, cell as u32, corners, (0..9).collect(), &mut random);
        if !random.one_in(4) {
            let mut viewport = viewport([start[0] as f32 / 256.0, start[1] as f32 / 256.0], [width, height]);
            if random.one_in(2) {
                (viewport.y, viewport.height) = (viewport.y + viewport.height, -viewport.height);
            }
            shape.state.viewport = Some(viewport);
        }
        if !random.one_in(4) {
            let [(x, width), (y, height)] = [0; 2].map(|_| {
                let start = random.between(0, cell);
                (start as i32, random.between(0, cell - start) as u32)
            });
            shape.state.scissor = Some(Scissor { x, y, width, height });
        }
        shape
    });
    let shapes = shapes.collect();
    compare(bench, shapes, tally, |_, _, _| None)
}

/// Triangles across the border of a viewport: what a guard band saves `pineda` from clipping.
pub(crate) fn border(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = (bench.seed..).take(6_000 * bench.times as usize).map(|seed| {
        let mut random = Random::new(seed);
        let cell = 64;
        let reach = 256 * random.pick(&[16, 256, 4096]);
        let corners = (0..3).map(|_| [0; 2].map(|_| random.between(-reach, 256 * i64::from(cell) + reach))).collect();
        let mut shape = Shape::new(seed, cell, corners, vec![0, 1, 2], &mut random);
        shape.state.viewport = Some(viewport([0.0; 2], [64; 2]));
        shape
    });
    let shapes = shapes.collect();
    let near = |shape: &Shape, pixel| shape.edge_distance(pixel) <= SHIFT;
    compare(bench, shapes, tally, |shape, pixel, _| near(shape, pixel).then_some(Row::Border))
}

fn viewport([x, y]: [f32; 2], [width, height]: [i64; 2]) -> Viewport {
    Viewport { x, y, width: width as f32, height: height as f32, min_depth: 0.0, max_depth: 1.0 }
}

/// A case moved by whole pixels into the smallest cell that holds it.
fn shape_of_case(case: &Case) -> Option<Shape> {
    if case.space != Space::Raster || case.dropped() > 0 {
        return None;
    }
    let snapped = case.snapped();
    let corners: Vec<Point> = snapped.into_iter().flatten().collect();
    let bound = |axis: usize| {
        let values = || corners.iter().map(|corner| corner[axis]);
        Some((values().min()?.div_euclid(256), values().max()?.div_euclid(256) + 1))
    };
    let (across, down) = (bound(0)?, bound(1)?);
    let size = (across.1 - across.0).max(down.1 - down.0);
    let cell = u32::try_from(size).ok()?.next_power_of_two().max(SMALLEST_CELL);
    if cell > 2048 {
        return None;
    }
    let moved = corners.iter().map(|&[x, y]| [x - 256 * across.0, y - 256 * down.0]).collect();
    let indices = (0..corners.len() as u32).collect();
    Some(Shape::new(case.seed, cell, moved, indices, &mut Random::new(!case.seed)))
}

/// A point of a cell: the centre of a pixel, its corner, or any.
pub(crate) fn point(random: &mut Random, cell: u32) -> Point {
    let kind = random.between(0, 3);
    [0; 2].map(|_| match kind {
        0 => 256 * random.between(0, i64::from(cell) - 1) + 128,
        1 => 256 * random.between(0, i64::from(cell)),
        _ => random.between(0, 256 * i64::from(cell)),
    })
}
