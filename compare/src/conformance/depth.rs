//! Depth: the test and what it leaves, values on slopes, bias, clamping.
//!
//! Flat triangles at dyadic depths have no rounding in them: pictures must be the same, and depths, too, but that Vulkan leaves the rounding to unorm codes open ("Conversion From
//! Floating-Point to Normalized Fixed-Point": either of the two nearest codes). On slopes a depth is a plane evaluated in f32, for which Vulkan asks no exactness;
//! [`Sloped::tolerance`] is what evaluating it from the picture's corner can lose.

use super::Bench;
use super::sheet::{DepthFormat, Draw, Interpolation, Sheet, Vertex, clip_position};
use super::tally::{Row, Tally};
use anyhow::Result;
use pineda::{Blend, Compare, DepthBias, DepthState, DrawState, Viewport};
use pineda_oracle::Point;
use pineda_oracle::cases::Random;

const SIDE: u32 = 1024;
const FORMATS: [DepthFormat; 3] = [DepthFormat::Float32, DepthFormat::Unorm24, DepthFormat::Unorm16];

/// Every comparison, with writing and without, on every format: six triangles on top of each other in each cell, flat at dyadic depths.
pub(crate) fn tests(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    const CELL: u32 = 32;
    const LAYERS: usize = 6;
    for (format, seed) in runs(bench) {
        let mut random = Random::new(seed);
        let mut sheet = Sheet::new(SIDE);
        sheet.depth = format;
        for _ in 0..LAYERS {
            let first = sheet.draws.len();
            for origin in cells(SIDE, CELL) {
                let (min_depth, max_depth) = random.pick(&[(0.0, 1.0), (0.0, 1.0), (0.25, 0.75), (0.5, 0.5)]);
                let state = DrawState {
                    depth: DepthState { compare: random.pick(&Compare::ALL), write: random.one_in(2) },
                    blend: random.pick(&[Blend::ADD, Blend::OPAQUE]),
                    viewport: Some(Viewport { min_depth, max_depth, ..sheet.viewport() }),
                    ..DrawState::DEFAULT
                };
                let z = random.between(0, 8) as f32 / 8.0;
                let corners = [0; 3].map(|_| point(&mut random, origin, CELL));
                let color = [0; 4].map(|_| random.between(1, 40) as f32 / 255.0);
                let vertices = corners.map(|p| Vertex { position: clip_position(&sheet.viewport(), p, z, 1.0), color });
                add(&mut sheet, first, state, &vertices);
            }
        }
        tally.cases += u64::from(SIDE / CELL).pow(2);
        let [ours, theirs] = bench.draw(&sheet)?;
        let allowed = if format.steps().is_some() { 1 } else { 0 };
        for at in 0..sheet.pixels() {
            tally.pixels += 1;
            let (our_color, their_color) = (ours.colors.codes()[at], theirs.colors.codes()[at]);
            tally.drawn += u64::from(our_color != [0; 4]);
            let difference = ours.depth[at].abs_diff(theirs.depth[at]);
            if our_color != their_color || difference > allowed {
                tally.differs(None, || {
                    format!(
                        "seed {seed}, {format:?}, pixel {:?}: pineda {our_color:?} at depth {:?}, lavapipe {their_color:?} at {:?}",
                        position(&sheet, at),
                        format.decoded(ours.depth[at]),
                        format.decoded(theirs.depth[at])
                    )
                });
            } else {
                tally.allow(f64::from(difference));
            }
        }
    }
    Ok(())
}

/// Depths on slopes.
pub(crate) fn slopes(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    for (format, seed) in runs(bench) {
        let triangles = sloped(seed, format, |random| random.unit(), |_| DrawState::DEFAULT);
        compare(bench, format, &triangles, tally)?;
    }
    Ok(())
}

/// Bias by a constant, by the slope, both, clamped.
pub(crate) fn bias(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    for (format, seed) in runs(bench) {
        let mut random = Random::new(seed);
        let biases: Vec<DepthBias> = (0..48)
            .map(|_| {
                // As steps of 24 bits; fewer of the larger steps of 16.
                let constant = random.sign() * random.pick(&[0.0, 1.0, 7.0, 1000.0, 50_000.0]);
                let constant = if format == DepthFormat::Unorm16 { (constant / 256.0).round() } else { constant };
                let slope = random.sign() * random.pick(&[0.0, 0.25, 1.0, 3.7]);
                let clamp = random.pick(&[0.0, 0.0, 0.001, -0.001]);
                DepthBias { constant, slope, clamp }
            })
            .collect();
        let state = |random: &mut Random| DrawState { depth_bias: random.pick(&biases), ..DrawState::DEFAULT };
        let triangles = sloped(seed, format, |random| 0.1 + 0.8 * random.unit(), state);
        compare(bench, format, &triangles, tally)?;
    }
    Ok(())
}

/// Depths before the near plane and beyond the far one, clamped to the viewport's range.
pub(crate) fn clamp(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    if !bench.theirs.has_depth_clamp() {
        return Ok(());
    }
    for (format, seed) in runs(bench) {
        let state = |random: &mut Random| {
            let (min_depth, max_depth) = random.pick(&[(0.0, 1.0), (0.25, 0.75)]);
            let viewport = Viewport { min_depth, max_depth, ..Viewport::whole(SIDE, SIDE) };
            DrawState { depth_clamp: true, viewport: Some(viewport), ..DrawState::DEFAULT }
        };
        let triangles = sloped(seed, format, |random| random.real(-1.0, 2.0), state);
        compare(bench, format, &triangles, tally)?;
    }
    Ok(())
}

/// A triangle whose depth is a plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sloped {
    corners: [Point; 3],
    /// z / w.
    z: [f32; 3],
    w: [f32; 3],
    pub(crate) state: DrawState,
}

/// A triangle in each cell of a sheet; a quarter of them are flat.
pub(crate) fn sloped(
    seed: u64,
    format: DepthFormat,
    depth: impl Fn(&mut Random) -> f32,
    state: impl Fn(&mut Random) -> DrawState,
) -> Vec<Sloped> {
    const CELL: u32 = 32;
    let mut random = Random::new(seed ^ (format as u64) << 40);
    let triangle = |origin| {
        let random = &mut random;
        let corners = loop {
            let corners = [0; 3].map(|_| point(random, origin, CELL));
            if is_fat(corners) {
                break corners;
            }
        };
        let flat = depth(random);
        let z = if random.one_in(4) { [flat; 3] } else { [0; 3].map(|_| depth(random)) };
        let w = if random.one_in(2) { [1.0; 3] } else { [0; 3].map(|_| random.pick(&[0.5, 1.0, 2.0, 4.0])) };
        let depth = DepthState { compare: Compare::Always, write: true };
        Sloped { corners, z, w, state: DrawState { depth, ..state(random) } }
    };
    cells(SIDE, CELL).map(triangle).collect()
}

/// Whether no corner is nearer than a pixel to the edge opposite: then no attribute changes by more than its range from pixel to pixel.
pub(crate) fn is_fat([a, b, c]: [Point; 3]) -> bool {
    let side = |a: Point, b: Point| ((a[0] - b[0]).pow(2) + (a[1] - b[1]).pow(2)) as f64;
    let area_x2 = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs() as f64;
    area_x2 >= 256.0 * side(a, b).max(side(b, c)).max(side(c, a)).sqrt()
}

impl Sloped {
    pub(crate) fn vertices(&self, viewport: &Viewport, color: [f32; 4]) -> [Vertex; 3] {
        let position = |k: usize| clip_position(viewport, self.corners[k], self.z[k], self.w[k]);
        [0, 1, 2].map(|k| Vertex { position: position(k), color })
    }

    /// Its plane: depth at the picture's corner, and by how much it grows per pixel.
    fn plane(&self) -> [f64; 3] {
        let range =
            self.state.viewport.map_or([0.0, 1.0], |viewport| [viewport.min_depth, viewport.max_depth]).map(f64::from);
        let [a, b, c] = self.corners.map(|corner| corner.map(|x| x as f64 / 256.0));
        let [z, z_b, z_c] = self.z.map(|z| range[0] + f64::from(z) * (range[1] - range[0]));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        let x = ((z_b - z) * (c[1] - a[1]) - (z_c - z) * (b[1] - a[1])) / area;
        let y = ((z_c - z) * (b[0] - a[0]) - (z_b - z) * (c[0] - a[0])) / area;
        [z - x * a[0] - y * a[1], x, y]
    }

    /// Vulkan's bias (1.4, "Depth Bias Computation") with a unit of so many steps of a unorm format; of f32 it is 2^(e - 23).
    fn offset(&self, format: DepthFormat, [_, x, y]: [f64; 3], steps_a_unit: f64) -> f64 {
        let DepthBias { constant, slope, clamp } = self.state.depth_bias;
        let largest = self.z.iter().fold(0.0f32, |a, z| a.max(z.abs()));
        let ulp = f64::from(f32::from_bits(largest.to_bits() & 0x7f80_0000)) / 8_388_608.0;
        let unit = format.steps().map_or(ulp, |steps| steps_a_unit / f64::from(steps));
        let offset = f64::from(constant) * unit + f64::from(slope) * x.abs().max(y.abs());
        let clamp = f64::from(clamp);
        if clamp > 0.0 {
            offset.min(clamp)
        } else if clamp < 0.0 {
            offset.max(clamp)
        } else {
            offset
        }
    }

    /// What is exact for a place in the picture.
    pub(crate) fn exact(&self, format: DepthFormat, [x, y]: [f64; 2], steps_a_unit: f64) -> f64 {
        let plane @ [z, dz_dx, dz_dy] = self.plane();
        let range =
            self.state.viewport.map_or([0.0, 1.0], |viewport| [viewport.min_depth, viewport.max_depth]).map(f64::from);
        (z + dz_dx * x + dz_dy * y + self.offset(format, plane, steps_a_unit)).clamp(range[0], range[1])
    }

    /// By how much two right answers can differ there: a plane set up and evaluated in f32 from the picture's corner, as drivers do it, sums terms that are as large as the plane
    /// is steep and the pixel far away. Eight roundings of the terms' sizes for slopes (four differences and products, a quotient, a sum) and the evaluation (two products
    /// and sums); two for the offset, whose slope has an error of its own. And one code of unorm formats.
    pub(crate) fn tolerance(&self, format: DepthFormat, [x, y]: [f64; 2]) -> f64 {
        let plane @ [z, dz_dx, dz_dy] = self.plane();
        let sizes = z.abs() + dz_dx.abs() * x + dz_dy.abs() * y + 1.0;
        let offset = self.offset(format, plane, 2.0).abs();
        (8.0 * sizes + 10.0 * offset) / 16_777_216.0 + format.steps().map_or(0.0, |steps| 1.0 / f64::from(steps))
    }
}

/// Draws triangles, one to a cell, and compares depths.
fn compare(bench: &mut Bench, format: DepthFormat, triangles: &[Sloped], tally: &mut Tally) -> Result<()> {
    let mut sheet = Sheet::new(SIDE);
    sheet.depth = format;
    for triangle in triangles {
        let viewport = triangle.state.viewport.unwrap_or(sheet.viewport());
        add(&mut sheet, 0, triangle.state, &triangle.vertices(&viewport, [1.0; 4]));
    }
    let [ours, theirs] = bench.draw(&sheet)?;
    tally.cases += triangles.len() as u64;
    let columns = (triangles.len() as f64).sqrt() as u32;
    for at in 0..sheet.pixels() {
        tally.pixels += 1;
        let pixel @ [x, y] = position(&sheet, at);
        let cell = SIDE / columns;
        let triangle = &triangles[(y / cell * columns + x / cell) as usize];
        let [is_ours, is_theirs] = [&ours, &theirs].map(|picture| picture.colors.codes()[at] != [0; 4]);
        tally.drawn += u64::from(is_ours);
        let [our_depth, their_depth] = [&ours, &theirs].map(|picture| format.decoded(picture.depth[at]));
        let centre = pixel.map(|x| f64::from(x) + 0.5);
        let tolerance = triangle.tolerance(format, centre);
        let error = if is_ours { (our_depth - their_depth).abs() / tolerance } else { 0.0 };
        if is_ours != is_theirs || error > 1.0 || (!is_ours && our_depth != their_depth) {
            let exact = triangle.exact(format, centre, 1.0);
            let doubled = triangle.exact(format, centre, 2.0);
            let is_doubled = format.steps().is_some() && triangle.state.depth_bias.constant != 0.0;
            let is_explained = is_doubled
                && (is_ours && is_theirs)
                && (our_depth - exact).abs() <= tolerance
                && (their_depth - doubled).abs() <= tolerance;
            tally.differs(is_explained.then_some(Row::BiasUnit), || {
                format!("{format:?}, pixel {pixel:?}: pineda {our_depth}, lavapipe {their_depth}, exact {exact}; {error} of the tolerance; {triangle:?}")
            });
        } else {
            tally.allow(error);
        }
    }
    Ok(())
}

/// Adds a triangle to the first draw that has its state, `first` or later.
pub(crate) fn add(sheet: &mut Sheet, first: usize, state: DrawState, vertices: &[Vertex]) {
    match sheet.draws[first..].iter_mut().find(|draw| draw.state == state) {
        Some(draw) => draw.vertices.extend(vertices),
        None => {
            let interpolation = Interpolation::Flat;
            sheet.draws.push(Draw { vertices: vertices.to_vec(), indices: None, interpolation, state });
        }
    }
}

/// Each format with a few seeds.
pub(crate) fn runs(bench: &Bench) -> Vec<(DepthFormat, u64)> {
    let seeds = bench.seed..bench.seed + 4 * bench.times;
    FORMATS.into_iter().flat_map(|format| seeds.clone().map(move |seed| (format, seed))).collect()
}

/// The corners of a sheet's cells, in pixels, row by row.
pub(crate) fn cells(side: u32, cell: u32) -> impl Iterator<Item = [u32; 2]> {
    (0..side / cell).flat_map(move |y| (0..side / cell).map(move |x| [x * cell, y * cell]))
}

/// A point in a cell, on the subpixel grid of the sheet.
pub(crate) fn point(random: &mut Random, origin: [u32; 2], cell: u32) -> Point {
    origin.map(|start| 256 * i64::from(start) + random.between(0, 256 * i64::from(cell)))
}

/// The pixel at a place in a sheet.
pub(crate) fn position(sheet: &Sheet, at: usize) -> [u32; 2] {
    [at as u32 % sheet.side, at as u32 / sheet.side]
}
