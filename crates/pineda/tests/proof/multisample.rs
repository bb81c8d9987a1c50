//! Multisampling: each sample is what a picture of the moved scene shows, and a pixel what its samples are on average.

use crate::scene::{CutOut, Layer, random_state};
use pineda::*;
use pineda_oracle::cases::{Case, Family, Random, Space as CaseSpace};
use pineda_oracle::covered_exactly_once;
use pineda_proof::{Drawing, Probe, ProbeVertex, Renderers, draw_case_with_samples};

const WIDTH: u32 = 45;
const HEIGHT: u32 = 38;

const SEVERAL: [Samples; 4] = [Samples::Two, Samples::Four, Samples::Eight, Samples::Sixteen];

fn draw(renderer: &mut Renderer, layers: &[Layer], samples: Samples) -> Drawing {
    let mut pass = Pass::new();
    layers.iter().for_each(|layer| layer.draw(&mut pass));
    Drawing::of_samples(renderer, &pass, WIDTH, HEIGHT, samples).expect("a valid pass")
}

/// The layers on a raster that is moved so that a sample lies where pixels' centres do: exact, as long as positions have room for it.
pub(crate) fn moved(layers: &[Layer], [x, y]: [u8; 2]) -> Vec<Layer> {
    let mut layers = layers.to_vec();
    for vertex in layers.iter_mut().flat_map(|layer| &mut layer.vertices) {
        vertex.position[0] -= (f32::from(x) - 8.0) / 16.0;
        vertex.position[1] -= (f32::from(y) - 8.0) / 16.0;
    }
    layers
}

/// Makes positions multiples of 1/256, so that what [`moved`] takes off them is exact.
pub(crate) fn snap(layer: &mut Layer) {
    for vertex in &mut layer.vertices {
        vertex.position[0] = (vertex.position[0] * 256.0).round() / 256.0;
        vertex.position[1] = (vertex.position[1] * 256.0).round() / 256.0;
    }
}

/// Layers with positions that are multiples of 1/256.
fn layers(random: &mut Random, count: usize, triangles: usize) -> Vec<Layer> {
    let mut layer = |_| {
        let mut layer = Layer::random(random, WIDTH, HEIGHT, triangles);
        layer.state = random_state(random);
        snap(&mut layer);
        layer
    };
    (0..count).map(&mut layer).collect()
}

#[test]
fn every_sample_is_covered_as_the_oracle_says() {
    let mut renderers = Renderers::default();
    let count = if cfg!(debug_assertions) { 1200 } else { 6_000 };
    for (n, seed) in (0..count).enumerate() {
        let case = Case::from_seed(seed);
        if case.space != CaseSpace::Raster {
            continue;
        }
        let samples = SEVERAL[n / Family::ALL.len() % 4];
        let (renderer, order) = (renderers.nth(seed), seed as usize % 6);
        let drawing = draw_case_with_samples(renderer, &case, order, DrawState::default(), samples).expect("valid");
        for (k, &position) in samples.positions().iter().enumerate() {
            let hits = drawing.sample(k).hits;
            assert_eq!(hits, case.hits_at(position), "{samples:?}, sample {k}\n{case}");
            if !case.outline.is_empty() {
                covered_exactly_once(&hits, &case.region_at(position), case.width)
                    .unwrap_or_else(|problem| panic!("{samples:?}, sample {k}: {problem}\n{case}"));
            }
        }
    }
}

#[test]
fn shaded_by_sample_a_pixel_is_as_many_pictures_of_the_moved_scene() {
    let mut renderers = Renderers::default();
    for seed in 0..if cfg!(debug_assertions) { 40 } else { 160 } {
        let mut random = Random::new(seed);
        let mut layers = layers(&mut random, 3, 30);
        for layer in &mut layers {
            layer.state.sampling = Sampling::Sample;
            layer.discards = random.one_in(3);
            layer.state.depth_bias.slope = random.pick(&[0.0, 1.5]);
        }
        let samples = SEVERAL[seed as usize % 4];
        let drawing = draw(renderers.nth(seed), &layers, samples);
        for (k, &position) in samples.positions().iter().enumerate() {
            let picture = draw(renderers.nth(seed / 3), &moved(&layers, position), Samples::One);
            let difference = picture.difference(&drawing.sample(k));
            assert_eq!(difference, None, "seed {seed}: {samples:?}, sample {k}");
        }
    }
}

/// The first vertex's attributes, whatever the place.
struct Flat;

varyings! {
    struct FlatColor {
        #[flat]
        color: Rgba,
    }
}

#[shader]
impl Shader for Flat {
    type Vertex = ProbeVertex;
    type Varyings<L: Lanes> = FlatColor<L>;
    const DISCARDS: bool = true;
    fn vertex(&self, v: &ProbeVertex) -> (Vec4, FlatColor) {
        let ([r, g], [b, a]) = (v.smooth, v.linear);
        (v.position.into(), FlatColor { color: [r, g, b, a].into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        f.discard(f.color.r.lt(-0.75));
        f.color
    }
}

#[test]
fn what_is_flat_does_not_depend_on_where_fragments_are_shaded() {
    let mut renderers = Renderers::default();
    for seed in 0..if cfg!(debug_assertions) { 40 } else { 160 } {
        let mut random = Random::new(seed ^ 0xf1a7);
        let mut layers = layers(&mut random, 3, 25);
        for layer in &mut layers {
            let operations = [StencilOperation::Keep, StencilOperation::IncrementWrap, StencilOperation::Invert];
            let face = StencilFace {
                compare: random.pick(&Compare::ALL),
                reference: random.between(0, 3) as u8,
                fail: random.pick(&operations),
                depth_fail: random.pick(&operations),
                pass: random.pick(&operations),
                ..StencilFace::default()
            };
            layer.state.stencil = random.one_in(3).then_some(StencilState { front: face, back: face });
            layer.state.sample_mask = if random.one_in(3) { random.bits() as u32 } else { u32::MAX };
        }
        let samples = SEVERAL[seed as usize % 4];
        let mut drawn = |layers: &[Layer], sampling: Sampling, samples: Samples, only: u32| {
            let mut pass = Pass::new();
            for layer in layers {
                let mesh = Mesh { vertices: &layer.vertices, indices: Indices::Sequential };
                let state = DrawState { sampling, ..layer.state };
                // Of one sample, the mask is that sample's bit.
                let mask = if samples == Samples::One { state.sample_mask >> only & 1 } else { state.sample_mask };
                pass.draw(&Flat, mesh, DrawState { sample_mask: mask, ..state });
            }
            Drawing::of_samples(renderers.nth(random.bits()), &pass, WIDTH, HEIGHT, samples).expect("a valid pass")
        };
        let by_sample = drawn(&layers, Sampling::Sample, samples, 0);
        for sampling in [Sampling::Centroid, Sampling::Center] {
            let difference = by_sample.difference(&drawn(&layers, sampling, samples, 0));
            assert_eq!(difference, None, "seed {seed}: {samples:?}, {sampling:?}");
        }
        for (k, &position) in samples.positions().iter().enumerate() {
            let picture = drawn(&moved(&layers, position), Sampling::Centroid, Samples::One, k as u32);
            assert_eq!(picture.difference(&by_sample.sample(k)), None, "seed {seed}: {samples:?}, sample {k}");
        }
    }
}

/// Where the triangle of each sample is shaded by the rule, found from pictures of that triangle alone: at the pixel's centre if it covers that, else at the lowest
/// sample that it covers.
#[test]
fn a_pixel_is_shaded_at_its_centre_or_at_the_lowest_sample_that_is_covered() {
    let mut renderers = Renderers::default();
    let renderer = renderers.nth(5);
    for seed in 0..if cfg!(debug_assertions) { 6 } else { 20 } {
        let mut random = Random::new(seed ^ 0xce27);
        let mut layers = layers(&mut random, 1, 12);
        let layer = &mut layers[0];
        layer.state = DrawState { space: Space::Raster, ..DrawState::default() };
        if random.one_in(2) {
            // Some of what is nearer than the near plane is clipped.
            layer.vertices.iter_mut().for_each(|vertex| vertex.position[2] -= 0.25);
        }
        let samples = SEVERAL[seed as usize % 4];
        let drawing = draw(renderer, &layers, samples);
        let positions: Vec<[u8; 2]> = [[8, 8]].iter().chain(samples.positions()).copied().collect();
        let triangles = layers[0].vertices.len() / 3;
        let mut alone = |triangle: usize, position: [u8; 2]| {
            let vertices = layers[0].vertices[3 * triangle..3 * triangle + 3].to_vec();
            draw(renderer, &moved(&[Layer { vertices, ..layers[0].clone() }], position), Samples::One)
        };
        let pictures: Vec<Vec<Drawing>> =
            (0..triangles).map(|t| positions.iter().map(|&position| alone(t, position)).collect()).collect();
        for (at, &triangle) in drawing.triangle_ids.iter().enumerate() {
            if triangle == NO_ID {
                continue;
            }
            let pixel = at % (WIDTH * HEIGHT) as usize;
            let places = &pictures[triangle as usize];
            let shaded = places.iter().find(|picture| picture.hits[pixel] != 0).expect("it covers this sample");
            let (found, wanted) = (drawing.color[at], shaded.color[pixel]);
            // What is clipped is interpolated in f64, which rounds differently in another place.
            let is_clipped = layers[0].vertices[3 * triangle as usize..][..3].iter().any(|v| v.position[2] < 0.0);
            let tolerance = if is_clipped { 1e-6 } else { 0.0 };
            let is_right = found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() <= tolerance);
            assert!(is_right, "seed {seed}, pixel {pixel}: {found:?}, not {wanted:?}");
        }
    }
}

#[test]
fn several_flushes_of_samples_are_the_same_bits_as_one() {
    for seed in 0..if cfg!(debug_assertions) { 3 } else { 4 } {
        let mut random = Random::new(seed ^ 0xf105);
        // More than fit the least memory that a batch is made for.
        let mut layers = layers(&mut random, 4, [2000, 1400, 800, 400][seed as usize % 4]);
        for layer in &mut layers {
            layer.discards = random.one_in(3);
            layer.state.sampling = random.pick(&[Sampling::Centroid, Sampling::Center, Sampling::Sample]);
            if random.one_in(2) {
                layer.state =
                    DrawState { space: Space::Raster, sampling: layer.state.sampling, ..DrawState::default() };
            }
        }
        let samples = SEVERAL[seed as usize % 4];
        let drawn = |memory: usize, threads: usize, tile: TileSize| {
            let settings = Settings { memory, threads, tile, ..Settings::default() };
            draw(&mut Renderer::new(settings).expect("the best level"), &layers, samples)
        };
        let whole = drawn(1 << 30, 1, TileSize::T64);
        assert_eq!(whole.statistics.flushes, 1);
        for (threads, tile) in [(1, TileSize::T64), (2, TileSize::T16)] {
            let parts = drawn(0, threads, tile);
            assert!(parts.statistics.flushes > 1);
            assert_eq!(whole.difference(&parts), None, "seed {seed}, {threads} threads, {tile:?}");
        }
    }
}

/// Depths that fragments see do not depend on what of their triangle is visible, nor on flushes.
#[test]
fn the_depth_that_a_fragment_sees_is_its_triangles_where_it_is_shaded() {
    struct Depth;
    #[shader]
    impl Shader for Depth {
        type Vertex = [f32; 4];
        type Varyings<L: Lanes> = Vec2<L>;
        fn vertex(&self, &position: &[f32; 4]) -> (Vec4, Vec2) {
            (position.into(), Vec2::from([position[0], position[1]]))
        }
        fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
            let Vec2 { x, y } = f.varyings();
            Rgba { r: x, g: y, b: f.z(), a: f.splat(1.0) }
        }
    }
    // On one side of a square depth is x / 16, on the other the same.
    let plane = |[x, y]: [f32; 2]| [x, y, x / 16.0, 1.0];
    let triangles = [[1.3, 0.0], [16.0, 2.0], [3.0, 15.7], [16.0, 2.0], [14.2, 16.0], [3.0, 15.7]].map(plane);
    let mut pass = Pass::new();
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    pass.draw(&Depth, Mesh { vertices: &triangles, indices: Indices::Sequential }, state);
    let mut pixels = vec![[0.0; 4]; 4 * 256];
    let mut target = Target { samples: Samples::Four, color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(16, 16) };
    Renderer::new(Settings::default()).expect("the best level").render(&pass, &mut target).expect("valid");
    let mut moved = 0;
    for (at, &[x, _, z, a]) in pixels.iter().enumerate().filter(|(_, pixel)| pixel[3] != 0.0) {
        assert!((z * 16.0 - x).abs() < 1e-5, "{at}: depth {z} at {x}, alpha {a}");
        moved += usize::from(x.fract() != 0.5);
    }
    assert!(moved > 20, "some are shaded off the centre");
}

#[test]
fn a_pixel_is_the_average_of_its_samples() {
    let mut renderers = Renderers::default();
    for (seed, samples) in (0..if cfg!(debug_assertions) { 8 } else { 40 }).zip(SEVERAL.into_iter().cycle()) {
        let mut random = Random::new(seed ^ 0xa4e2);
        let layers = layers(&mut random, 2, 40);
        let mut pass = Pass::new();
        layers.iter().for_each(|layer| layer.draw(&mut pass));
        let (pixels, count) = ((WIDTH * HEIGHT) as usize, samples.count());
        let (mut all, mut one) = (vec![[0.0f32; 4]; pixels * count], vec![[0.0f32; 4]; pixels]);
        let (mut all_bytes, mut one_byte) = (vec![[0u8; 4]; pixels * count], vec![[0u8; 4]; pixels]);
        let (mut depths, mut depth) = (vec![0.0; pixels * count], vec![0.0; pixels]);
        let renderer = renderers.nth(seed);
        let mut draw = |color: ColorBuffer<'_>, depth: &mut [f32]| {
            let depth = DepthBuffer::D32F(depth);
            renderer.render(&pass, &mut Target { samples, color, depth, ..Target::new(WIDTH, HEIGHT) }).expect("valid");
        };
        draw(ColorBuffer::Rgba32F(&mut all), &mut depths);
        draw(ColorBuffer::Rgba32F(&mut one), &mut depth);
        draw(ColorBuffer::Rgba8Srgb(&mut all_bytes), &mut depths);
        draw(ColorBuffer::Rgba8Srgb(&mut one_byte), &mut depth);
        assert_eq!(depth, depths[..pixels], "sample 0's depth");
        let linear = |code: u8| {
            let c = f64::from(code) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        let encoded = |x: f64| 255.0 * if x <= 0.003_130_8 { x * 12.92 } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        for pixel in 0..pixels {
            for channel in 0..4 {
                let of = |sample: usize| all[sample * pixels + pixel][channel];
                // By twos: exact where all samples are the same.
                let mut sums: Vec<f32> = (0..count).map(of).collect();
                while sums.len() > 1 {
                    sums = sums.chunks(2).map(|two| two[0] + two[1]).collect();
                }
                assert_eq!(one[pixel][channel], sums[0] * (1.0 / count as f32));
                let code = |sample: usize| all_bytes[sample * pixels + pixel][channel];
                let average =
                    |decoded: &dyn Fn(u8) -> f64| (0..count).map(|s| decoded(code(s))).sum::<f64>() / count as f64;
                let exact = if channel == 3 {
                    average(&|code| f64::from(code))
                } else {
                    encoded(average(&|code| linear(code)))
                };
                let found = f64::from(one_byte[pixel][channel]);
                assert!((found - exact).abs() <= 0.501, "{found} for {exact}");
            }
        }
    }
}

#[test]
fn alpha_covers_as_many_samples() {
    for samples in Samples::ALL {
        let count = samples.count();
        for step in 0..=2 * count {
            let alpha = step as f32 / (2 * count) as f32;
            let mut pass = Pass::new();
            let state = DrawState { alpha_to_coverage: true, space: Space::Raster, ..DrawState::default() };
            pass.draw_with(
                Mesh { vertices: &[[-9.0, -9.0], [-9.0, 99.0], [99.0, -9.0]], indices: Indices::Sequential },
                state,
                |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), ()),
                move |f| Rgba::from(f.splat([1.0, 1.0, 1.0, alpha])),
            );
            let (mut pixels, mut depth) = (vec![[0.0; 4]; 20 * count], vec![0.0; 20 * count]);
            let color = ColorBuffer::Rgba32F(&mut pixels);
            let mut target = Target { samples, color, depth: DepthBuffer::D32F(&mut depth), ..Target::new(5, 4) };
            Renderer::new(Settings::default()).expect("the best level").render(&pass, &mut target).expect("valid");
            for sample in 0..count {
                // Half a sample counts as one.
                let is_covered = sample < step.div_ceil(2);
                let wanted = if is_covered { ([1.0, 1.0, 1.0, alpha], 0.5) } else { ([0.0; 4], 1.0) };
                assert_eq!((pixels[20 * sample + 7], depth[20 * sample + 7]), wanted, "{samples:?}, {alpha}, {sample}");
            }
        }
    }
}

#[test]
fn lines_and_points_cover_samples_as_their_rectangles_do() {
    let mut renderers = Renderers::default();
    for seed in 0..if cfg!(debug_assertions) { 12 } else { 100 } {
        let mut random = Random::new(seed ^ 0x11e5);
        let mut layers = layers(&mut random, 1, 8);
        let state = &mut layers[0].state;
        *state = DrawState { space: Space::Raster, sampling: Sampling::Sample, ..DrawState::default() };
        state.topology = random.pick(&[PrimitiveTopology::LineStrip, PrimitiveTopology::PointList]);
        state.line_width = random.real(1.5, 6.0);
        state.point_size = random.real(0.5, 30.0);
        let samples = SEVERAL[seed as usize % 4];
        let drawing = draw(renderers.nth(seed), &layers, samples);
        for (k, &position) in samples.positions().iter().enumerate() {
            let picture = draw(renderers.nth(seed + 1), &moved(&layers, position), Samples::One);
            assert_eq!(picture.hits, drawing.sample(k).hits, "seed {seed}: {samples:?}, sample {k}");
            assert_eq!(picture.depth, drawing.sample(k).depth, "seed {seed}: {samples:?}, sample {k}");
        }
        // Shaded once a pixel, they are drawn, too, and cover the same.
        layers[0].state.sampling = Sampling::Centroid;
        assert_eq!(draw(renderers.nth(seed + 2), &layers, samples).hits, drawing.hits);
    }
}

/// A thin line is a rectangle of its own width: no diamonds where there are several samples.
#[test]
fn a_thin_line_is_a_rectangle_where_pixels_have_samples() {
    let line = [[2.0f32, 3.0], [10.0, 3.0]];
    let mut pass = Pass::new();
    let state = DrawState { topology: PrimitiveTopology::LineList, space: Space::Raster, ..DrawState::default() };
    pass.draw_with(
        Mesh { vertices: &line, indices: Indices::Sequential },
        state,
        |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
        |f| Rgba::gray(f.splat(1.0)),
    );
    let mut pixels = vec![[0.0; 4]; 12 * 6];
    let mut target =
        Target { samples: Samples::Sixteen, color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(12, 6) };
    Renderer::new(Settings::default()).expect("the best level").render(&pass, &mut target).expect("valid");
    let column: Vec<f32> = (0..6).map(|row| pixels[12 * row + 5][0]).collect();
    assert_eq!(column, [0.0, 0.0, 0.5, 0.5, 0.0, 0.0], "from 2.5 to 3.5");
}

#[test]
fn a_second_pass_goes_on_with_the_samples_of_the_first() {
    let mut renderers = Renderers::default();
    for seed in 0..if cfg!(debug_assertions) { 10 } else { 60 } {
        let mut random = Random::new(seed ^ 0x10ad);
        let layers = layers(&mut random, 4, 25);
        let samples = SEVERAL[seed as usize % 4];
        let whole = draw(renderers.nth(seed), &layers, samples);
        let (mut first, mut second) = (Pass::new(), Pass::new());
        (second.clear_color, second.clear_depth) = (None, None);
        layers[..2].iter().for_each(|layer| layer.draw(&mut first));
        layers[2..].iter().for_each(|layer| layer.draw(&mut second));
        let renderer = renderers.nth(seed + 1);
        let mut parts = Drawing::of_samples(renderer, &first, WIDTH, HEIGHT, samples).expect("valid");
        parts.draw_over(renderer, &second).expect("valid");
        assert_eq!(bits(&whole.color), bits(&parts.color), "seed {seed}");
        assert_eq!(whole.depth, parts.depth, "seed {seed}");
    }
}

fn bits(colors: &[[f32; 4]]) -> Vec<u32> {
    colors.as_flattened().iter().map(|x| x.to_bits()).collect()
}

/// A pixel of one value is one of as many samples of that value.
#[test]
fn what_is_loaded_goes_to_all_samples() {
    let (mut pixels, mut depth): (Vec<[u8; 4]>, Vec<f32>) = (
        (0..256u32).map(|k| k.wrapping_mul(0x0101_0307).to_le_bytes()).collect(),
        (0..256).map(|k| k as f32 / 256.0).collect(),
    );
    let (before, depth_before) = (pixels.clone(), depth.clone());
    let layer = [[0.0f32, 0.0, 1.0, 1.0], [0.0, 32.0, 1.0, 1.0], [32.0, 0.0, 1.0, 1.0]]
        .map(|position| ProbeVertex { position, ..ProbeVertex::default() });
    let mut pass = Pass::new();
    (pass.clear_color, pass.clear_depth) = (None, None);
    // Something in each tile, hidden behind all.
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    pass.draw(&CutOut, Mesh { vertices: &layer, indices: Indices::Sequential }, state);
    pass.draw(&Probe, Mesh { vertices: &layer, indices: Indices::Sequential }, state);
    let mut target = Target {
        samples: Samples::Eight,
        color: ColorBuffer::Rgba8Srgb(&mut pixels),
        depth: DepthBuffer::D32F(&mut depth),
        ..Target::new(16, 16)
    };
    Renderer::new(Settings::default()).expect("the best level").render(&pass, &mut target).expect("valid");
    assert_eq!((pixels, depth), (before, depth_before));
}

#[test]
fn a_buffer_has_an_element_for_each_pixel_or_for_each_sample() {
    let mut renderer = Renderer::new(Settings::default()).expect("the best level");
    for (length, is_right) in [(64, true), (256, true), (128, false), (65, false), (0, false)] {
        let mut hits = vec![0; length];
        let mut target = Target { samples: Samples::Four, hits: Some(&mut hits), ..Target::new(8, 8) };
        let found = renderer.render(&Pass::new(), &mut target).map(drop);
        let error = Error::BufferLength { buffer: "hits", length, expected: 64, width: 8, height: 8, samples: 4 };
        assert_eq!(found, if is_right { Ok(()) } else { Err(error) });
    }
}

/// Counted once a pixel and triangle, however many samples show it; samples one by one.
#[test]
fn fragments_are_counted_once_a_pixel() {
    let square = [[1.0f32, 1.0], [1.0, 5.0], [5.0, 1.0], [5.0, 1.0], [1.0, 5.0], [5.0, 5.0]];
    for (sampling, shaded) in [(Sampling::Centroid, 16 + 4), (Sampling::Center, 16 + 4), (Sampling::Sample, 16 * 4)] {
        for blend in [Blend::OPAQUE, Blend::ALPHA] {
            let mut pass = Pass::new();
            pass.draw_with(
                Mesh { vertices: &square, indices: Indices::Sequential },
                DrawState { sampling, blend, space: Space::Raster, ..DrawState::default() },
                |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
                |f| Rgba::gray(f.splat(1.0)),
            );
            let mut pixels = vec![[0; 4]; 8 * 8];
            let mut target =
                Target { samples: Samples::Four, color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(8, 8) };
            let draws = Renderer::new(Settings::default()).expect("the best level").render_counted(&pass, &mut target);
            let draw = draws.expect("valid")[0];
            // The diagonal goes through four pixels, each of which both triangles share.
            let counted = (draw.fragments_shaded, draw.samples_passed, draw.samples_written);
            assert_eq!(counted, (shaded, 64, 64), "{sampling:?}");
        }
    }
}

/// What is touched, or covered whole, is a pixel: all of its samples, shaded at its centre.
#[test]
fn conservative_triangles_cover_all_samples_of_a_pixel() {
    let mut renderers = Renderers::default();
    for seed in 0..if cfg!(debug_assertions) { 20 } else { 200 } {
        let mut random = Random::new(seed ^ 0xc025);
        let mut layers = layers(&mut random, 1, 1);
        let conservative = random.pick(&[Conservative::Overestimate, Conservative::Underestimate]);
        layers[0].state = DrawState { conservative, space: Space::Raster, ..DrawState::default() };
        let samples = SEVERAL[seed as usize % 4];
        let picture = draw(renderers.nth(seed), &layers, Samples::One);
        let drawing = draw(renderers.nth(seed + 1), &layers, samples);
        for sample in 0..samples.count() {
            let of_sample = drawing.sample(sample);
            assert_eq!(of_sample.hits, picture.hits, "seed {seed}");
            // Each sample is tested at its own depth, which may lie beyond the range's end where the centre's does not.
            for (at, &id) in of_sample.triangle_ids.iter().enumerate().filter(|(_, id)| **id != NO_ID) {
                if picture.triangle_ids[at] == id {
                    let colors = [of_sample.color[at], picture.color[at]].map(|color| color.map(f32::to_bits));
                    assert_eq!(colors[0], colors[1], "seed {seed}, pixel {at}");
                }
            }
        }
    }
}
