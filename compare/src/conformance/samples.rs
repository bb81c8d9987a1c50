//! Four samples a pixel: which of them belong to which triangle, line or point, by sample masks and by alpha, too; depth for each of them; and their averages.
//!
//! Coverage of a sample is coverage of the pixel's centre by the shape moved the other way, so that [`shapes`](super::shapes) and the oracle need no rules of their own for it. WebGPU has no other numbers
//! of samples than 1 and 4, and neither has lavapipe.

use super::Bench;
use super::blending::{decode, encode, half_step, stored};
use super::coverage::{list_shapes, strip_shapes};
use super::depth::{Sloped, add, position, runs, sloped};
use super::shapes::{Shape, compare_samples, rectangle};
use super::sheet::{Colors, DepthFormat, Draw, Interpolation, Sampled, Sheet, Vertex, clip_position};
use super::strokes::{JUST_WIDE, is_rectangle, list_or_strip, stroke_shapes};
use super::tally::{Row, Tally};
use anyhow::Result;
use pineda::{Compare, DepthState, DrawState, PrimitiveTopology, f16_to_f32, f32_to_f16};
use pineda_oracle::cases::Random;
use pineda_oracle::{Point, covers};

/// Pixels to each side of the sheets in which each pixel is a case.
const SIDE: u32 = 256;

/// The oracle's cases moved so that what lay on pixels' centres lies on samples; with sample masks.
pub(crate) fn lists(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let to_sample = |random: &mut Random| random.pick(Sampled::FourTimes.offsets());
    let shapes = list_shapes(bench, [10_000, 5_000, 1_000, 250, 60, 16, 4], to_sample);
    compare_samples(bench, Sampled::FourTimes, masked(shapes), tally, |_, _, _, _| None)
}

/// Strips, some of whose corners lie on samples; with sample masks.
pub(crate) fn strips(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = masked(on_samples(strip_shapes(bench, 8_000), 0));
    compare_samples(bench, Sampled::FourTimes, shapes, tally, |_, _, _, _| None)
}

/// Squares around points of the grid, some of them samples.
pub(crate) fn points(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = on_samples(stroke_shapes(bench, 8_000, |_| PrimitiveTopology::PointList, 1.0), 1);
    compare_samples(bench, Sampled::FourTimes, masked(shapes), tally, |_, _, _, _| None)
}

/// Lines as rectangles, some from sample to sample.
pub(crate) fn lines(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let shapes = on_samples(stroke_shapes(bench, 8_000, list_or_strip, JUST_WIDE), 1);
    compare_samples(bench, Sampled::FourTimes, shapes, tally, |shape, moved, pixel, theirs| {
        if is_rectangle(moved, pixel, theirs) {
            Some(Row::LineCorners)
        } else {
            lacks_first_lines(shape, moved, pixel, theirs).then_some(Row::LineBounds)
        }
    })
}

/// Whether these are the colours without some of the lines whose rectangles begin within the pixel's column or row: `moved` without them.
fn lacks_first_lines(shape: &Shape, moved: &Shape, pixel: [u32; 2], colors: [u8; 4]) -> bool {
    let is_first = |&[a, b]: &[usize; 2]| {
        let rectangle = rectangle([shape.corners[a], shape.corners[b]], shape.state.line_width);
        [0, 1].iter().any(|&axis| {
            let start = rectangle.iter().map(|corner| corner[axis]).min();
            start.is_some_and(|start| start.rem_euclid(256) > 0 && start.div_euclid(256) == i64::from(pixel[axis]))
        })
    };
    let lines = moved.lines();
    let first: Vec<usize> = (0..lines.len()).filter(|&k| is_first(&lines[k])).collect();
    let mut others = moved.clone();
    others.state.topology = PrimitiveTopology::LineList;
    (0..1u32 << first.len()).any(|kept| {
        let is_kept = |k: &usize| first.iter().position(|line| line == k).is_none_or(|at| kept >> at & 1 == 1);
        let kept = (0..lines.len()).filter(is_kept);
        others.indices = kept.flat_map(|k| lines[k]).map(|k| k as u32).collect();
        others.expected(pixel) == colors
    })
}

/// Gives half of the shapes a mask.
fn masked(mut shapes: Vec<Shape>) -> Vec<Shape> {
    for shape in &mut shapes {
        let mut random = Random::new(shape.seed.rotate_left(32));
        shape.state.sample_mask = random.pick(&[u32::MAX, u32::MAX, u32::MAX, u32::MAX, 0b0001, 0b0110, 0b1011, 0]);
    }
    shapes
}

/// Moves one corner of three to a sample of its pixel, so many pixels from the cell's border at least.
fn on_samples(mut shapes: Vec<Shape>, border: i64) -> Vec<Shape> {
    for shape in &mut shapes {
        let mut random = Random::new(shape.seed.rotate_left(32));
        let last = i64::from(shape.cell) - 1 - border;
        for corner in &mut shape.corners {
            let offset = random.pick(Sampled::FourTimes.offsets());
            if random.one_in(3) {
                *corner = [0, 1].map(|axis| 256 * (corner[axis] / 256).clamp(border, last) + 128 + offset[axis]);
            }
        }
    }
    shapes
}

/// In each pixel a square, or a triangle, with an alpha that says how many of its samples are covered; with sample masks.
pub(crate) fn alpha_to_coverage(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    for seed in bench.seed..bench.seed + 4 * bench.times {
        let mut random = Random::new(seed);
        let mut sheet = Sheet::sampled(SIDE, Sampled::FourTimes);
        let mut cases: Vec<(Vec<[Point; 3]>, f32, u32)> = Vec::new();
        for at in 0..sheet.pixels() {
            let pixel = position(&sheet, at);
            let triangles = if random.one_in(2) { square(pixel).to_vec() } else { vec![triangle(&mut random, pixel)] };
            let alpha = match random.between(0, 3) {
                // Where either renderer takes the next sample, and beside that.
                0 => random.between(-1, 9) as f32 / 8.0,
                1 => random.between(1, 8) as f32 / 8.0 - random.pick(&[1.0, -1.0]) * f32::EPSILON / 8.0,
                2 => random.between(0, 255) as f32 / 255.0,
                _ => random.real(-0.5, 1.5),
            };
            let sample_mask = random.pick(&[u32::MAX, u32::MAX, 0b1100, 0b0111]);
            let state = DrawState { alpha_to_coverage: true, sample_mask, ..plain() };
            let color = [1.0, random.unit(), random.unit(), alpha];
            triangles.iter().for_each(|corners| add(&mut sheet, 0, state, &vertices_of(*corners, color)));
            cases.push((triangles, alpha, sample_mask));
        }
        tally.cases += cases.len() as u64;
        let [ours, theirs] = bench.draw(&sheet)?;
        for (sample, &offset) in sheet.samples.offsets().iter().enumerate() {
            for (at, (triangles, alpha, mask)) in cases.iter().enumerate() {
                tally.pixels += 1;
                let pixel = position(&sheet, at).map(i64::from);
                let at = at + sample * sheet.pixels();
                let (our, their) = (ours.colors.codes()[at], theirs.colors.codes()[at]);
                tally.drawn += u64::from(our != [0; 4]);
                if our != their {
                    let is_inside = triangles.iter().any(|&triangle| covers(seen_from(offset, triangle), pixel))
                        && mask >> sample & 1 == 1;
                    let covered = [our, their].map(|color| color != [0; 4]);
                    // To the nearest number of samples, and to the one above; both begin with sample 0.
                    let by_rounding = 4.0 * alpha >= sample as f32 + 0.5;
                    let by_any_more = *alpha > sample as f32 / 4.0;
                    let is_explained = covered == [is_inside && by_rounding, is_inside && by_any_more];
                    tally.differs(is_explained.then_some(Row::AlphaToCoverage), || {
                        format!("seed {seed}, pixel {pixel:?}, sample {sample}: pineda {our:?}, lavapipe {their:?}; alpha {alpha:?}, mask {mask:#06b}, {triangles:?}")
                    });
                }
            }
        }
    }
    Ok(())
}

/// Triangles that go through each other: for each sample the nearest one, and its depth there.
pub(crate) fn depth(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    const SIDE: u32 = 1024;
    const CELL: u32 = 32;
    const LAYERS: usize = 4;
    for (format, seed) in runs(bench) {
        let mut sheet = Sheet::sampled(SIDE, Sampled::FourTimes);
        sheet.depth = format;
        let viewport = sheet.viewport();
        let mut layers = Vec::new();
        for layer in 0..LAYERS {
            let comparison = |random: &mut Random| random.pick(&[Compare::Less, Compare::LessEqual]);
            let state = |random: &mut Random| DrawState {
                depth: DepthState { compare: comparison(random), write: true },
                ..DrawState::DEFAULT
            };
            let triangles = sloped(seed << 8 | layer as u64, format, |random| random.unit(), state);
            let first = sheet.draws.len();
            for triangle in &triangles {
                // Red says which triangle it is.
                let color = [(layer + 1) as f32 / 255.0, 1.0, 1.0, 1.0];
                add(&mut sheet, first, triangle.state, &triangle.vertices(&viewport, color));
            }
            tally.cases += triangles.len() as u64;
            layers.push(triangles);
        }
        let [ours, theirs] = bench.draw(&sheet)?;
        for (sample, &offset) in sheet.samples.offsets().iter().enumerate() {
            for at in 0..sheet.pixels() {
                tally.pixels += 1;
                let pixel @ [x, y] = position(&sheet, at);
                let cell = (y / CELL * (SIDE / CELL) + x / CELL) as usize;
                let at = at + sample * sheet.pixels();
                let [our, their] = [&ours, &theirs].map(|picture| {
                    let triangle = layers.get(usize::from(picture.colors.codes()[at][0]).wrapping_sub(1));
                    Shown { triangle: triangle.map(|layer| &layer[cell]), depth: format.decoded(picture.depth[at]) }
                });
                tally.drawn += u64::from(our.triangle.is_some());
                let place = [0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 + offset[axis] as f64 / 256.0);
                let error = our.difference(&their, format, place);
                if error > 1.0 {
                    tally.differs(None, || {
                        format!("seed {seed}, {format:?}, pixel {pixel:?}, sample {sample}: pineda {our:?}, lavapipe {their:?}; {error} of the tolerance")
                    });
                } else {
                    tally.allow(error);
                }
            }
        }
    }
    Ok(())
}

/// What a sample shows.
#[derive(Debug)]
struct Shown<'a> {
    triangle: Option<&'a Sloped>,
    depth: f64,
}

impl Shown<'_> {
    /// As a part of what is allowed: depths as on slopes; and where two triangles are as near to each other as both depths' tolerances together, either may be in front.
    fn difference(&self, other: &Self, format: DepthFormat, place: [f64; 2]) -> f64 {
        match [self.triangle, other.triangle] {
            [None, None] if self.depth == other.depth => 0.0,
            [None, _] | [_, None] => f64::INFINITY,
            [Some(our), Some(their)] => {
                let tolerances = [our, their].map(|triangle| triangle.tolerance(format, place));
                if std::ptr::eq(our, their) {
                    return (self.depth - other.depth).abs() / tolerances[0];
                }
                let exact = [our, their].map(|triangle| triangle.exact(format, place, 1.0));
                let errors = [(self.depth - exact[0]) / tolerances[0], (other.depth - exact[1]) / tolerances[1]];
                let gap = (exact[0] - exact[1]).abs() / (tolerances[0] + tolerances[1]);
                errors.iter().fold(gap, |largest, error| largest.max(error.abs()))
            }
        }
    }
}

/// Averages of linear codes.
pub(crate) fn unorm8(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    averages(bench, tally, Colors::Unorm8)
}

/// Averages of sRGB codes, in linear light.
pub(crate) fn srgb8(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    averages(bench, tally, Colors::Srgb8)
}

/// Averages of halves.
pub(crate) fn float16(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    let format = |pixels: Vec<[u8; 4]>| Colors::Float16(vec![[0; 4]; pixels.len()]);
    averages(bench, tally, format)
}

/// In each pixel a square for each sample, with a mask that leaves no other and a colour that the format has; some samples of a pixel have the same colour.
fn averages(bench: &mut Bench, tally: &mut Tally, format: impl Fn(Vec<[u8; 4]>) -> Colors) -> Result<()> {
    for seed in bench.seed..bench.seed + 4 * bench.times {
        let mut random = Random::new(seed);
        let mut sheet = Sheet::sampled(SIDE, Sampled::Averaged);
        sheet.colors = format(vec![[0; 4]; sheet.pixels()]);
        let colors: Vec<[[f32; 4]; 4]> = (0..sheet.pixels())
            .map(|_| {
                let colors = [0; 4].map(|_| [0, 1, 2, 3].map(|k| channel(&mut random, &sheet.colors, k)));
                let repeats = random.pick(&[[0, 1, 2, 3], [0, 1, 2, 3], [0, 0, 1, 1], [0, 1, 0, 0], [0, 0, 0, 0]]);
                repeats.map(|k: usize| colors[k])
            })
            .collect();
        for (sample, sample_mask) in [1, 2, 4, 8].into_iter().enumerate() {
            let square = |at: usize| {
                let color = colors[at][sample];
                square(position(&sheet, at)).into_iter().flat_map(move |corners| vertices_of(corners, color))
            };
            let vertices = (0..sheet.pixels()).flat_map(square).collect();
            let state = DrawState { sample_mask, ..plain() };
            sheet.draws.push(Draw { vertices, indices: None, interpolation: Interpolation::Flat, state });
        }
        tally.cases += colors.len() as u64;
        let [ours, theirs] = bench.draw(&sheet)?;
        for (at, samples) in colors.iter().enumerate() {
            tally.pixels += 1;
            tally.drawn += 1;
            for k in 0..4 {
                let values = samples.map(|color| f64::from(color[k]));
                let [our, their] = [&ours, &theirs].map(|picture| stored(&picture.colors, at)[k]);
                let exact = encoded(&sheet.colors, k, values.iter().sum::<f64>() / 4.0);
                // Three sums in f32. And one code; of halves from one to the next.
                let rounding = values.iter().map(|x| x.abs()).sum::<f64>() * 3.0 / 4.0 / 16_777_216.0;
                let step = if matches!(sheet.colors, Colors::Float16(_)) { half_step(exact) } else { 1.0 };
                let difference = (our - their).abs() / (step + rounding);
                // `pineda`'s is the nearest.
                if difference > 1.0 || (our - exact).abs() > 0.501 * step + rounding {
                    tally.differs(None, || {
                        format!("seed {seed}, pixel {:?}, channel {k}: pineda {our}, lavapipe {their}, exact {exact}; samples {values:?}", position(&sheet, at))
                    });
                } else {
                    tally.allow(difference);
                }
            }
        }
    }
    Ok(())
}

/// A channel of a sample's colour, which the format stores without rounding it to another one.
fn channel(random: &mut Random, format: &Colors, k: usize) -> f32 {
    let code = f64::from(random.bits() as u8);
    match format {
        Colors::Srgb8(_) if k < 3 => decode(code) as f32,
        Colors::Unorm8(_) | Colors::Srgb8(_) => (code / 255.0) as f32,
        // Sums stay below 65504.
        Colors::Float16(_) | Colors::Float32(_) => f16_to_f32(f32_to_f16(random.sign() * random.magnitude(-10, 13))),
    }
}

/// What is stored of a value: codes with their fractions, or numbers.
fn encoded(format: &Colors, k: usize, value: f64) -> f64 {
    match format {
        Colors::Srgb8(_) if k < 3 => encode(value),
        Colors::Unorm8(_) | Colors::Srgb8(_) => 255.0 * value,
        Colors::Float16(_) | Colors::Float32(_) => value,
    }
}

/// A state without a depth test.
fn plain() -> DrawState {
    DrawState { depth: DepthState::OFF, ..DrawState::DEFAULT }
}

/// A whole pixel.
fn square(pixel: [u32; 2]) -> [[Point; 3]; 2] {
    let [x, y] = pixel.map(|x| 256 * i64::from(x));
    let [a, b, c, d] = [[x, y], [x, y + 256], [x + 256, y + 256], [x + 256, y]];
    [[a, b, c], [a, c, d]]
}

/// A part of a pixel.
fn triangle(random: &mut Random, pixel: [u32; 2]) -> [Point; 3] {
    [0; 3].map(|_| pixel.map(|x| 256 * i64::from(x) + random.between(0, 256)))
}

fn vertices_of(corners: [Point; 3], color: [f32; 4]) -> [Vertex; 3] {
    let viewport = pineda::Viewport::whole(SIDE, SIDE);
    corners.map(|corner| Vertex { position: clip_position(&viewport, corner, 0.5, 1.0), color })
}

/// A triangle for which the pixel's centre is what a sample so far off it is for this one.
fn seen_from([x, y]: Point, triangle: [Point; 3]) -> [Point; 3] {
    triangle.map(|corner| [corner[0] - x, corner[1] - y])
}
