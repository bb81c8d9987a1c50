//! Depth: formats, the viewport's range, bias, clamping instead of clipping. References are scalar, in f64, on planes that f32 holds exactly.

use crate::common::{HEIGHT, Layer, PIXELS, WIDTH, passes, settings};
use crate::depths::Depths;
use pineda::*;
use pineda_oracle::cases::{Random, orders};
use pineda_oracle::{coverage, snap};
use pineda_proof::{Drawing, Probe, ProbeVertex};

/// A buffer of any format, whatever it may hold.
fn random_depths(random: &mut Random) -> Depths {
    match random.between(0, 2) {
        0 => Depths::Float((0..PIXELS).map(|_| depth(random)).collect()),
        1 => Depths::Unorm24((0..PIXELS).map(|_| random.bits() as u32 & 0xff_ffff).collect()),
        _ => Depths::Unorm16((0..PIXELS).map(|_| random.bits() as u16).collect()),
    }
}

/// One of a few, so that equal ones are common, or any.
fn depth(random: &mut Random) -> f32 {
    if random.one_in(2) { random.between(0, 8) as f32 / 8.0 } else { random.unit() }
}

/// Every comparison on every format, deferred and in order, after loading and after clearing: a triangle a pixel, flat in depth.
#[test]
fn depths_are_compared_as_they_are_stored() {
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let mut start = random_depths(&mut random);
        let clear = random.one_in(2).then(|| depth(&mut random));
        let layers: Vec<Layer> = (0..4)
            .map(|_| {
                let (min_depth, max_depth) = random.pick(&[(0.0, 1.0), (0.25, 0.75), (1.0, 0.0), (0.5, 0.5)]);
                let viewport = Viewport { min_depth, max_depth, ..Viewport::whole(WIDTH, HEIGHT) };
                let depth_state = DepthState { compare: random.pick(&Compare::ALL), write: random.one_in(2) };
                let blend = random.pick(&[Blend::OPAQUE, Blend::ADD]);
                let color_mask = random.pick(&[ColorMask::ALL, ColorMask::ALL, ColorMask::NONE]);
                let state = DrawState {
                    depth: depth_state,
                    viewport: Some(viewport),
                    blend,
                    color_mask,
                    ..DrawState::default()
                };
                let mut layer = Layer::new(state, || ([1.0, 0.0, 0.0, random.unit()], depth(&mut random), true));
                layer.discards = random.one_in(4);
                layer
            })
            .collect();
        let given = start.clone();
        let mut wanted_color = vec![[0.0f32; 4]; PIXELS];
        for (at, color) in wanted_color.iter_mut().enumerate() {
            if let Some(z) = clear {
                start.set(at, start.format().stored(z));
            }
            for layer in &layers {
                let state = &layer.state;
                let Some(Viewport { min_depth, max_depth, .. }) = state.viewport else { continue };
                let z = layer.depths[at] * (max_depth - min_depth) + min_depth;
                let z = start.format().stored(z);
                let there = start.get(at);
                if !passes(state.depth.compare, z, there) || (layer.discards && layer.colors[at][3] < 0.25) {
                    continue;
                }
                if state.depth.write {
                    start.set(at, z);
                }
                if state.color_mask == ColorMask::ALL {
                    let sum = |k: usize| layer.colors[at][k] + color[k];
                    let is_added = state.blend == Blend::ADD;
                    *color = if is_added { [0, 1, 2, 3].map(sum) } else { layer.colors[at] };
                }
            }
        }
        for settings in settings(seed) {
            let (mut color, mut depths) = (vec![[0.0; 4]; PIXELS], given.clone());
            let mut pass = Pass::new();
            pass.clear_depth = clear;
            layers.iter().for_each(|layer| layer.draw(&mut pass));
            let color_buffer = ColorBuffer::Rgba32F(&mut color);
            let mut target = Target { color: color_buffer, depth: depths.buffer(), ..Target::new(WIDTH, HEIGHT) };
            Renderer::new(settings.clone()).expect("available").render(&pass, &mut target).expect("valid");
            let states: Vec<_> = layers.iter().map(|l| (l.state, l.discards)).collect();
            for at in 0..PIXELS {
                let (found, wanted) = ((color[at], depths.get(at)), (wanted_color[at], start.get(at)));
                assert_eq!(found, wanted, "scene {seed}, pixel {at}, {settings:?}, cleared to {clear:?}, {states:#?}");
            }
        }
    }
}

/// Large triangles over each other with every comparison: what is known of a window's depths must hide nothing that would be seen.
#[test]
fn what_is_hidden_is_hidden_under_every_comparison() {
    for seed in 0..150 {
        let mut random = Random::new(seed);
        let (width, height) = (150, 90);
        let layers: Vec<(Vec<ProbeVertex>, DrawState)> = (0..5)
            .map(|_| {
                let compare =
                    random.pick(&[Compare::Less, Compare::LessEqual, Compare::Greater, Compare::GreaterEqual]);
                let compare = if random.one_in(4) { random.pick(&Compare::ALL) } else { compare };
                let z = random.between(0, 8) as f32 / 8.0;
                let mut vertices = Vec::new();
                for _ in 0..random.between(1, 6) {
                    let step = random.pick(&[0.0, 0.125, 0.5]);
                    let at = [random.real(-50.0, 200.0), random.real(-50.0, 140.0)];
                    for _ in 0..3 {
                        let [x, y] = at.map(|v| v + random.real(-250.0, 250.0));
                        let z = (z + random.pick(&[-step, 0.0, step])).clamp(0.0, 1.0);
                        vertices.push(ProbeVertex { position: [x, y, z, 1.0], ..ProbeVertex::default() });
                    }
                }
                let depth = DepthState { compare, write: true };
                let bias = DepthBias { constant: random.pick(&[0.0, 0.0, 2e6, -2e6]), ..DepthBias::NONE };
                (vertices, DrawState { space: Space::Raster, depth, depth_bias: bias, ..DrawState::default() })
            })
            .collect();
        for unorm in [false, true] {
            let draw = |settings: Settings, apart: bool| {
                let (mut floats, mut codes) = (vec![0.0; width * height], vec![0; width * height]);
                let mut ids = vec![0; width * height];
                let mut renderer = Renderer::new(settings).expect("available");
                let mut pass = Pass::new();
                pass.clear_depth = Some(0.5);
                let mut last = vec![(NO_ID, NO_ID); width * height];
                let mut draw = |pass: &Pass<'_>, mark: u32| {
                    let depth = if unorm { DepthBuffer::D16(&mut codes) } else { DepthBuffer::D32F(&mut floats) };
                    let target = Target::new(width as u32, height as u32);
                    let mut target = Target { depth, triangle_ids: Some(&mut ids), ..target };
                    renderer.render(pass, &mut target).expect("valid");
                    for (last, &id) in last.iter_mut().zip(ids.iter()).filter(|(_, id)| **id != NO_ID) {
                        *last = (mark, id);
                    }
                };
                if apart {
                    // A pass for each triangle: nothing is known of what is there, and nothing is hidden by it.
                    draw(&pass, 0);
                    for (vertices, state) in &layers {
                        for (k, corners) in vertices.chunks(3).enumerate() {
                            let mut pass = Pass::new();
                            pass.clear_depth = None;
                            pass.draw(&Probe, Mesh { vertices: corners, indices: Indices::Sequential }, *state);
                            draw(&pass, k as u32);
                        }
                    }
                    last.iter_mut().filter(|last| last.1 != NO_ID).for_each(|last| last.1 = last.0);
                } else {
                    for (vertices, state) in &layers {
                        pass.draw(&Probe, Mesh { vertices, indices: Indices::Sequential }, *state);
                    }
                    draw(&pass, 0);
                }
                let ids: Vec<u32> = last.into_iter().map(|last| last.1).collect();
                (floats.iter().map(|z| z.to_bits()).collect::<Vec<u32>>(), codes, ids)
            };
            let wanted = draw(Settings { simd: Simd::Scalar, threads: 1, ..Settings::default() }, true);
            for settings in settings(seed) {
                assert!(draw(settings.clone(), false) == wanted, "scene {seed}, {settings:?}, unorm: {unorm}");
            }
        }
    }
}

/// Right triangles with legs of a power of two: their slopes are exact, and so is all that follows.
struct Dyadic {
    corners: [[f64; 3]; 3],
    slopes: [f64; 2],
}

impl Dyadic {
    fn random(random: &mut Random, low: i64, high: i64) -> Self {
        let corner = [random.between(-20, 40) as f64, random.between(-20, 20) as f64];
        let leg = |random: &mut Random| 2f64.powi(random.between(0, 9) as i32) * f64::from(random.sign());
        let legs = [leg(random), leg(random)];
        let [z, zx, zy] = [0; 3].map(|_| random.between(low, high) as f64 / 256.0);
        let [x, y] = corner;
        Self {
            corners: [[x, y, z], [x + legs[0], y, zx], [x, y + legs[1], zy]],
            slopes: [(zx - z) / legs[0], (zy - z) / legs[1]],
        }
    }

    fn depth(&self, x: f64, y: f64) -> f64 {
        let [cx, cy, z] = self.corners[0];
        z + self.slopes[0] * (x - cx) + self.slopes[1] * (y - cy)
    }

    fn covered(&self) -> Vec<bool> {
        let snapped = self.corners.map(|[x, y, _]| [snap(x).expect("near"), snap(y).expect("near")]);
        coverage(snapped, WIDTH, HEIGHT)
    }

    fn vertices(&self, order: usize) -> Vec<ProbeVertex> {
        let vertex = |k: u32| {
            let [x, y, z] = self.corners[k as usize].map(|v| v as f32);
            ProbeVertex { position: [x, y, z, 1.0], ..ProbeVertex::default() }
        };
        orders([0, 1, 2])[order].map(vertex).to_vec()
    }
}

/// Draws triangles to depth buffers of f32 that start at 1, with comparison Always.
fn drawn(settings: &Settings, vertices: &[ProbeVertex], state: DrawState) -> Drawing {
    let depth = DepthState { compare: Compare::Always, write: true };
    let mut pass = Pass::new();
    pass.draw(&Probe, Mesh { vertices, indices: Indices::Sequential }, DrawState { depth, ..state });
    Drawing::of(&mut Renderer::new(settings.clone()).expect("available"), &pass, WIDTH, HEIGHT).expect("valid")
}

/// Where a sample is that a buffer's element stands for.
fn centre(at: usize) -> (f64, f64) {
    ((at % WIDTH as usize) as f64 + 0.5, (at / WIDTH as usize) as f64 + 0.5)
}

#[test]
fn bias_is_the_formula() {
    for seed in 0..600 {
        let mut random = Random::new(seed);
        let triangle = Dyadic::random(&mut random, 64, 192);
        // Whole multiples of 2^10 units are few enough bits for every sum to be exact.
        let bias = DepthBias {
            constant: random.between(-64, 64) as f32 * 32_768.0,
            slope: random.between(-8, 8) as f32 / 4.0,
            clamp: random.pick(&[0.0, 0.0, 0.125, -0.0625]),
        };
        let largest = triangle.corners.iter().map(|c| c[2]).fold(0.0, f64::max);
        let unit = 2f64.powi(largest.log2().floor() as i32 - 23);
        let steepest = triangle.slopes[0].abs().max(triangle.slopes[1].abs());
        let offset = f64::from(bias.constant) * unit + f64::from(bias.slope) * steepest;
        let offset = match bias.clamp {
            clamp if clamp > 0.0 => offset.min(clamp.into()),
            clamp if clamp < 0.0 => offset.max(clamp.into()),
            _ => offset,
        };
        let covered = triangle.covered();
        let order = random.between(0, 5) as usize;
        for settings in settings(seed) {
            let state = DrawState { space: Space::Raster, depth_bias: bias, ..DrawState::default() };
            let drawing = drawn(&settings, &triangle.vertices(order), state);
            for at in (0..PIXELS).filter(|&at| covered[at]) {
                let (x, y) = centre(at);
                let wanted = (triangle.depth(x, y) + offset).clamp(0.0, 1.0);
                assert_eq!(f64::from(drawing.depth[at]), wanted, "seed {seed}, pixel {at}, {bias:?}, {settings:?}");
            }
        }
    }
}

#[test]
fn units_of_unorm_formats_are_their_steps() {
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let (constant, z) = (random.between(-300, 300) as f32, random.real(0.01, 0.99));
        let state = DrawState { depth_bias: DepthBias { constant, ..DepthBias::NONE }, ..DrawState::default() };
        let layer = Layer::new(state, || ([0.0; 4], z, true));
        let mut pass = Pass::new();
        layer.draw(&mut pass);
        let (mut d16, mut d24) = (vec![0; PIXELS], vec![0; PIXELS]);
        for settings in settings(seed) {
            let mut renderer = Renderer::new(settings).expect("available");
            let target = || Target::new(WIDTH, HEIGHT);
            renderer.render(&pass, &mut Target { depth: DepthBuffer::D16(&mut d16), ..target() }).expect("valid");
            renderer.render(&pass, &mut Target { depth: DepthBuffer::D24(&mut d24), ..target() }).expect("valid");
            let code = |steps: f64| (f64::from(z) * steps + f64::from(constant)).clamp(0.0, steps);
            // Beside a half, the rounding of the sum decides.
            assert!(d16.iter().all(|&found| (f64::from(found) - code(65_535.0)).abs() < 0.51), "{constant} {z}");
            assert!(d24.iter().all(|&found| (f64::from(found) - code(16_777_215.0)).abs() <= 1.0), "{constant} {z}");
        }
    }
}

/// Bias and clamping on triangles of all sizes, clipped ones among them: neither rotation nor winding changes a bit.
#[test]
fn no_order_of_the_vertices_changes_a_bit() {
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let size = random.pick(&[2.0, 20.0, 300.0, 90_000.0]);
        let corners = [0; 3].map(|_| {
            let w = if random.one_in(4) { random.real(-2.0, 2.0) } else { 1.0 };
            [random.real(-1.0, 1.0) * size / 20.0, random.real(-1.0, 1.0) * size / 20.0, random.real(-0.5, 1.5), w]
        });
        let vertex = |position| ProbeVertex { position, ..ProbeVertex::default() };
        let bias = DepthBias { constant: random.real(-1e6, 1e6), slope: random.real(-3.0, 3.0), clamp: 0.0 };
        let depth_clamp = random.one_in(2);
        let mut reference: Option<Vec<f32>> = None;
        for (order, settings) in orders([0, 1, 2]).into_iter().zip(settings(seed).cycle_six()) {
            let vertices = order.map(|k| vertex(corners[k as usize])).to_vec();
            let state = DrawState { depth_bias: bias, depth_clamp, ..DrawState::default() };
            let found = drawn(&settings, &vertices, state).depth;
            let reference = reference.get_or_insert_with(|| found.clone());
            assert!(found == *reference, "seed {seed}, order {order:?}, {settings:?}");
        }
    }
}

trait CycleSix: Iterator<Item = Settings> + Sized {
    fn cycle_six(self) -> impl Iterator<Item = Settings> {
        self.collect::<Vec<_>>().into_iter().cycle().take(6)
    }
}

impl<I: Iterator<Item = Settings>> CycleSix for I {}

/// A triangle that the near plane and the guard band cut into several has one bias, that of its own plane.
#[test]
fn a_clipped_triangle_has_one_bias() {
    let mut parts = 0;
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let triangle = Dyadic::random(&mut random, -300, 500);
        let state = DrawState { space: Space::Raster, ..DrawState::default() };
        let settings: Vec<Settings> = settings(seed).collect();
        let plain = drawn(&settings[0], &triangle.vertices(0), state);
        if plain.statistics.clipped == 0 || plain.hits.iter().all(|&hits| hits == 0) {
            continue;
        }
        parts += 1;
        let slope = random.between(-8, 8) as f32 / 64.0;
        let offset = f64::from(slope) * triangle.slopes[0].abs().max(triangle.slopes[1].abs());
        let depth_bias = DepthBias { slope, ..DepthBias::NONE };
        for settings in settings {
            let biased = drawn(&settings, &triangle.vertices(seed as usize % 6), DrawState { depth_bias, ..state });
            let is_within = |at: &usize| plain.hits[*at] > 0 && plain.depth[*at] > 0.0 && plain.depth[*at] < 1.0;
            for at in (0..PIXELS).filter(is_within) {
                // Two sums are rounded; a bias of each part's own, from its snapped corners, would be off by far more.
                let wanted = (f64::from(plain.depth[at]) + offset).clamp(0.0, 1.0);
                let error = (f64::from(biased.depth[at]) - wanted).abs();
                assert!(error < 1e-5, "seed {seed}, pixel {at}: {error}, {slope} {:?}", triangle.slopes);
            }
        }
    }
    assert!(parts > 30, "{parts} were clipped");
}

/// Nothing is clipped by depth: coverage is the oracle's, and depth is the plane's, clamped to the viewport's range.
#[test]
fn depth_is_clamped_instead_of_clipped() {
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let triangle = Dyadic::random(&mut random, -512, 768);
        let covered = triangle.covered();
        let (min_depth, max_depth) = random.pick(&[(0.0, 1.0), (0.25, 0.75), (1.0, 0.5)]);
        let viewport = Viewport { min_depth, max_depth, ..Viewport::whole(WIDTH, HEIGHT) };
        let state =
            DrawState { space: Space::Raster, viewport: Some(viewport), depth_clamp: true, ..DrawState::default() };
        for settings in settings(seed) {
            let drawing = drawn(&settings, &triangle.vertices(seed as usize % 6), state);
            assert_eq!(drawing.statistics.clipped, 0);
            for (at, &is_covered) in covered.iter().enumerate() {
                let (x, y) = centre(at);
                let range = [f64::from(min_depth), f64::from(max_depth)];
                let z = triangle.depth(x, y) * (range[1] - range[0]) + range[0];
                let z = z.clamp(range[0].min(range[1]), range[0].max(range[1]));
                let wanted = if is_covered { (1, z) } else { (0, 1.0) };
                assert_eq!(
                    (drawing.hits[at], f64::from(drawing.depth[at])),
                    wanted,
                    "seed {seed}, pixel {at}, {settings:?}"
                );
            }
        }
    }
}

/// What lies behind the eye is clipped even so, and two triangles that share an edge still leave no crack and no double hit.
#[test]
fn clamped_meshes_have_no_cracks() {
    for seed in 0..300 {
        let mut random = Random::new(seed);
        // A plane through the view volume, its corners anywhere, some of them behind the eye.
        let mut axis =
            || [random.real(-3.0, 3.0), random.real(-3.0, 3.0), random.real(-4.0, 4.0), random.real(-2.0, 2.0)];
        let (u, v) = (axis(), axis());
        let vertex = |i: usize, j: usize| {
            let [s, t] = [i, j].map(|k| k as f32 - 1.0);
            let position = [0, 1, 2, 3].map(|k| u[k] * s + v[k] * t + [0.1, -0.2, 0.4, 1.0][k]);
            ProbeVertex { position, ..ProbeVertex::default() }
        };
        let corners = [[0, 0], [0, 1], [1, 0], [1, 0], [0, 1], [1, 1]];
        let quads = (0..4).map(|k| [k % 2, k / 2]);
        let vertices: Vec<ProbeVertex> = quads.flat_map(|[i, j]| corners.map(|[a, b]| vertex(i + a, j + b))).collect();
        let state = DrawState { depth_clamp: true, ..DrawState::default() };
        for settings in settings(seed) {
            let drawing = drawn(&settings, &vertices, state);
            assert!(drawing.hits.iter().all(|&hits| hits <= 1), "seed {seed}, {settings:?}");
        }
    }
}

#[test]
fn a_bias_that_is_not_finite_is_an_error() {
    let none = DepthBias::NONE;
    let wrong = [
        (DepthBias { constant: f32::NAN, ..none }, "constant"),
        (DepthBias { slope: f32::INFINITY, ..none }, "slope"),
        (DepthBias { clamp: f32::NEG_INFINITY, ..none }, "clamp"),
    ];
    for (depth_bias, field) in wrong {
        let layer = Layer::new(DrawState { depth_bias, ..DrawState::default() }, || ([0.0; 4], 0.5, true));
        let mut pass = Pass::new();
        layer.draw(&mut pass);
        let error = Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut Target::new(8, 8)));
        assert_eq!(error, Err(Error::DepthBias { draw: 0, field }));
    }
}
