//! Samples as fragment stages know them: which one is shaded, which ones are covered, and which ones are taken away.

use crate::multisample::snap;
use crate::scene::{Layer, random_state};
use pineda::*;
use pineda_oracle::cases::Random;
use pineda_proof::{Drawing, Probe, ProbeVertex, Probed};

const SIZE: [u32; 2] = [45, 38];
const PIXELS: usize = 45 * 38;

const SEVERAL: [Samples; 4] = [Samples::Two, Samples::Four, Samples::Eight, Samples::Sixteen];

/// Shows the mask, the triangle's number, and 1.
struct Masks;

/// The same, of a shader that may discard.
struct MasksWithHoles;

/// Shows the mask, the triangle's number, and the sample's.
struct MasksAndIndices;

macro_rules! masks {
    ($shader:ident, $index:literal, $discards:literal, |$f:ident| $third:expr) => {
        #[shader]
        impl Shader for $shader {
            type Vertex = [f32; 4];
            type Varyings<L: Lanes> = ();
            const SAMPLE_MASK: bool = true;
            const SAMPLE_INDEX: bool = $index;
            const DISCARDS: bool = $discards;
            const IDS: bool = true;
            fn vertex(&self, &position: &[f32; 4]) -> (Vec4, ()) {
                (position.into(), ())
            }
            fn fragment<L: Lanes>(&self, $f: &mut Fragment<L, Self>) -> RgbaU<L> {
                let one = Uint::new($f.lanes(), 1);
                let third = $third;
                RgbaU { r: $f.sample_mask(), g: $f.triangle_id() + one, b: third, a: $f.draw_id() }
            }
        }
    };
}

masks!(Masks, false, false, |f| Uint::new(f.lanes(), 1));
masks!(MasksWithHoles, false, true, |f| {
    f.discard((f.x() * 0.37).fract().lt(0.25));
    Uint::new(f.lanes(), 1)
});
masks!(MasksAndIndices, true, false, |f| f.sample_index());

/// In clip space: some of it behind the eye, some across the near plane.
fn soup(random: &mut Random, corners: usize) -> Vec<[f32; 4]> {
    let mut number = |low: i64, high: i64| random.between(low, high) as f32 / 64.0;
    (0..corners).map(|_| [number(-96, 96), number(-96, 96), number(-16, 64), number(-8, 96)]).collect()
}

const KINDS: [(PrimitiveTopology, PolygonMode, Conservative, usize); 6] = [
    (PrimitiveTopology::TriangleList, PolygonMode::Fill, Conservative::Off, 3),
    (PrimitiveTopology::TriangleList, PolygonMode::Fill, Conservative::Overestimate, 3),
    (PrimitiveTopology::TriangleList, PolygonMode::Line, Conservative::Off, 3),
    (PrimitiveTopology::LineList, PolygonMode::Fill, Conservative::Off, 2),
    (PrimitiveTopology::PointList, PolygonMode::Fill, Conservative::Off, 1),
    (PrimitiveTopology::TriangleList, PolygonMode::Fill, Conservative::Off, 3),
];

/// What each primitive covers, alone: a mask of each pixel. Of a triangle drawn as three lines, whatever any of them covers.
fn covered(mesh: &[[f32; 4]], state: DrawState, each: usize, samples: Samples) -> Vec<Vec<u32>> {
    let state = DrawState { sampling: Sampling::Center, ..state };
    let alone = |corners: &[[f32; 4]]| {
        let mut pass = Pass::new();
        let mesh = Mesh { vertices: corners, indices: Indices::Sequential };
        pass.draw_with(mesh, state, |&p| (Vec4::from(p), ()), |f| Rgba::gray(f.z()));
        let mut hits = vec![0; PIXELS * samples.count()];
        let mut target = Target { samples, hits: Some(&mut hits), ..Target::new(SIZE[0], SIZE[1]) };
        Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("valid");
        let covers = |at: usize, sample: usize| u32::from(hits[sample * PIXELS + at] > 0) << sample;
        (0..PIXELS).map(|at| (0..samples.count()).map(|sample| covers(at, sample)).sum()).collect()
    };
    mesh.chunks(each).map(alone).collect()
}

/// Whatever of a triangle is visible, its fragment is told all samples that it covers, but for those that the draw masks; shaded by sample, that one.
#[test]
fn fragments_know_the_samples_that_they_cover() {
    let mut drawn = std::collections::BTreeSet::new();
    for seed in 0..if cfg!(debug_assertions) { 6 } else { 16 } {
        let mut random = Random::new(seed);
        let samples = SEVERAL[seed as usize % 4];
        let mut meshes = Vec::new();
        for (k, (topology, polygon_mode, conservative, each)) in KINDS.into_iter().enumerate() {
            let state = DrawState {
                topology,
                polygon_mode,
                conservative,
                line_width: 2.5,
                point_size: 5.0,
                sample_mask: random.pick(&[u32::MAX, u32::MAX, 0b0110]),
                sampling: if k == 5 { Sampling::Sample } else { random.pick(&[Sampling::Centroid, Sampling::Center]) },
                ..DrawState::default()
            };
            let mesh = soup(&mut random, 10 * each);
            let masks = covered(&mesh, state, each, samples);
            meshes.push((mesh, state, masks));
        }
        let mut seen = Vec::new();
        for (threads, tile) in [(1, TileSize::T64), (3, TileSize::T16)] {
            let mut pass = Pass::new();
            for (k, (mesh, state, _)) in meshes.iter().enumerate() {
                let mesh = Mesh { vertices: &mesh[..], indices: Indices::Sequential };
                match k {
                    5 => pass.draw(&MasksAndIndices, mesh, *state),
                    1 | 3 => pass.draw(&MasksWithHoles, mesh, *state),
                    _ => pass.draw(&Masks, mesh, *state),
                };
            }
            let mut colors = vec![[0; 4]; PIXELS * samples.count()];
            let mut target =
                Target { samples, color: ColorBuffer::Rgba32U(&mut colors), ..Target::new(SIZE[0], SIZE[1]) };
            let settings = Settings { threads, tile, ..Settings::default() };
            Renderer::new(settings).and_then(|mut r| r.render(&pass, &mut target)).expect("valid");
            for (at, &[mask, number, third, draw]) in colors.iter().enumerate().filter(|(_, color)| color[1] > 0) {
                let (sample, pixel) = (at / PIXELS, at % PIXELS);
                let all = meshes[draw as usize].2[number as usize - 1][pixel];
                let say = || {
                    format!("seed {seed}, {samples:?}, sample {sample}, pixel {pixel}, draw {draw}, number {number}")
                };
                assert!(mask >> sample & 1 == 1, "{}", say());
                match draw {
                    5 => assert_eq!((mask, third), (1 << sample, sample as u32), "{}", say()),
                    // Of three lines, one.
                    2 => assert_eq!(mask & !all, 0, "{}", say()),
                    _ => assert_eq!(mask, all, "{}", say()),
                }
            }
            seen.push(colors);
        }
        assert!(seen[0] == seen[1], "seed {seed}: tiles change masks");
        drawn.extend(seen[0].iter().filter(|c| c[1] > 0).map(|c| c[3]));
    }
    // One picture's draws may hide each other.
    assert_eq!(drawn.len(), KINDS.len(), "every kind of draw is seen");
}

/// Where pixels have one sample, all that is covered has the mask 1 and the number 0, whatever the draw says.
#[test]
fn a_pixel_with_one_sample_has_sample_0() {
    let mut random = Random::new(9);
    let mesh = soup(&mut random, 60);
    for sampling in [Sampling::Centroid, Sampling::Center, Sampling::Sample] {
        for depth in [DepthState::default(), DepthState::OFF] {
            let state = DrawState { sampling, depth, ..DrawState::default() };
            let mut pass = Pass::new();
            pass.draw(&MasksAndIndices, Mesh { vertices: &mesh[..], indices: Indices::Sequential }, state);
            let mut colors = vec![[7; 4]; PIXELS];
            let mut target = Target { color: ColorBuffer::Rgba32U(&mut colors), ..Target::new(SIZE[0], SIZE[1]) };
            Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("valid");
            assert!(colors.iter().all(|&[mask, number, index, _]| (mask, index) == (u32::from(number > 0), 0)));
            assert!(colors.iter().any(|color| color[0] == 1));
        }
    }
}

/// [`Probe`], which takes samples away.
struct Writes {
    mask: u32,
}

#[shader]
impl Shader for Writes {
    type Vertex = ProbeVertex;
    type Varyings<L: Lanes> = Probed<L>;
    const WRITES_SAMPLE_MASK: bool = true;
    fn vertex(&self, v: &ProbeVertex) -> (Vec4, Probed) {
        Probe.vertex(v)
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        if self.mask != u32::MAX {
            f.set_sample_mask(self.mask);
        }
        let (Vec2 { x: r, y: g }, Vec2 { x: b, y: a }) = (f.smooth, f.linear);
        Rgba { r, g, b, a }
    }
}

/// A mask that the shader writes takes away what the same mask of the draw's takes away; of stencil, depth, blending and counting, too.
#[test]
fn a_written_mask_is_the_draws_mask() {
    for seed in 0..if cfg!(debug_assertions) { 40 } else { 120 } {
        let mut random = Random::new(seed);
        let samples = random.pick(&[Samples::One, Samples::Two, Samples::Four, Samples::Eight]);
        let layers: Vec<(Layer, u32)> = (0..3)
            .map(|_| {
                let mut layer = Layer::random(&mut random, SIZE[0], SIZE[1], 20);
                layer.state = random_state(&mut random);
                layer.state.sampling = random.pick(&[Sampling::Centroid, Sampling::Center, Sampling::Sample]);
                layer.state.alpha_to_coverage = random.one_in(4);
                let counts = StencilFace {
                    depth_fail: StencilOperation::Invert,
                    pass: StencilOperation::IncrementWrap,
                    ..StencilFace::IGNORE
                };
                layer.state.stencil = random.one_in(2).then(|| StencilState::both(counts));
                snap(&mut layer);
                (layer, random.pick(&[u32::MAX, 0, 0b0101, 0b0010, 0xf1]))
            })
            .collect();
        let drawn = |by_shader: bool| {
            let shaders: Vec<Writes> = layers.iter().map(|&(_, mask)| Writes { mask }).collect();
            let mut pass = Pass::new();
            for ((layer, mask), shader) in layers.iter().zip(&shaders) {
                let mesh = Mesh { vertices: &layer.vertices[..], indices: Indices::Sequential };
                if by_shader {
                    pass.draw(shader, mesh, layer.state);
                } else {
                    pass.draw(&Probe, mesh, DrawState { sample_mask: *mask, ..layer.state });
                }
            }
            let mut renderer = Renderer::new(Settings::default()).expect("the best level");
            let mut drawing = Drawing::of_samples(&mut renderer, &pass, SIZE[0], SIZE[1], samples).expect("valid");
            let mut stencil = vec![0; PIXELS * samples.count()];
            let mut target = Target { samples, stencil: Some(&mut stencil), ..Target::new(SIZE[0], SIZE[1]) };
            let counts = renderer.render_counted(&pass, &mut target).expect("valid");
            // All that is covered is a hit, whatever the shader takes away.
            drawing.hits.fill(0);
            (drawing, stencil, counts.iter().map(|draw| draw.samples_passed).collect::<Vec<_>>())
        };
        let ((by_state, state_stencil, state_counts), (by_shader, stencil, counts)) = (drawn(false), drawn(true));
        assert_eq!(by_state.difference(&by_shader), None, "seed {seed}, {samples:?}");
        assert!(state_stencil == stencil, "seed {seed}, {samples:?}: stencil");
        assert_eq!(state_counts, counts, "seed {seed}, {samples:?}");
    }
}

#[test]
fn to_ask_for_a_sample_where_there_is_none_is_an_error() {
    let mesh = Mesh { vertices: &[[0.0, 0.0, 0.5, 1.0]; 3], indices: Indices::Sequential };
    for (samples, sampling, is_wrong) in [
        (Samples::One, Sampling::Center, false),
        (Samples::Two, Sampling::Sample, false),
        (Samples::Two, Sampling::Centroid, true),
        (Samples::Sixteen, Sampling::Center, true),
    ] {
        let mut pass = Pass::new();
        pass.draw(&Masks, mesh, DrawState::default());
        pass.draw(&MasksAndIndices, mesh, DrawState { sampling, ..DrawState::default() });
        let mut hits = vec![7; samples.count()];
        let mut target = Target { samples, hits: Some(&mut hits), ..Target::new(1, 1) };
        let found = Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).map(drop);
        assert_eq!(found, if is_wrong { Err(Error::SampleIndex { draw: 1 }) } else { Ok(()) });
        assert_eq!(hits.contains(&7), is_wrong, "with an error nothing is drawn");
    }
}
