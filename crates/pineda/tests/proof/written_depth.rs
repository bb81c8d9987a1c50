//! A shader that writes the depth that its fragments have anyway draws what one does that writes none.

use crate::multisample::snap;
use crate::scene::{Layer, random_state};
use pineda::*;
use pineda_oracle::cases::Random;
use pineda_proof::{Drawing, Probe, ProbeVertex, Probed};

const WIDTH: u32 = 61;
const HEIGHT: u32 = 47;

/// [`Probe`], which writes its depth back.
struct WritesItBack;

/// [`Probe`], which might write a depth, but does not.
struct WritesNone;

macro_rules! probes {
    ($shader:ident, |$f:ident| {$($first:stmt;)?}) => {
        #[shader]
        impl Shader for $shader {
            type Vertex = ProbeVertex;
            type Varyings<L: Lanes> = Probed<L>;
            const WRITES_DEPTH: bool = true;
            fn vertex(&self, v: &ProbeVertex) -> (Vec4, Probed) {
                Probe.vertex(v)
            }
            fn fragment<L: Lanes>(&self, $f: &mut Fragment<L, Self>) -> Rgba<L> {
                $($first;)?
                let (Vec2 { x: r, y: g }, Vec2 { x: b, y: a }) = ($f.smooth, $f.linear);
                Rgba { r, g, b, a }
            }
        }
    };
}

probes!(WritesItBack, |f| {
    f.set_depth(f.z());
});
probes!(WritesNone, |f| {});

/// Once, shaded by sample, fragments of the second half of a line were told depths of the first half.
///
/// Once a pixel where it has one sample, once a sample where it has several: then what a fragment sees is what is tested, depth bias and all.
#[test]
fn a_triangles_own_depth_written_back_changes_no_bit() {
    for seed in 0..if cfg!(debug_assertions) { 60 } else { 200 } {
        let mut random = Random::new(seed);
        let layers: Vec<Layer> = (0..4)
            .map(|_| {
                let mut layer = Layer::random(&mut random, WIDTH, HEIGHT, 25);
                layer.state = random_state(&mut random);
                layer.state.sampling = Sampling::Sample;
                layer.state.depth_bias.slope = random.pick(&[0.0, 1.5]);
                layer.state.color_mask = random.pick(&[ColorMask::ALL, ColorMask::ALL, ColorMask::NONE]);
                layer.state.polygon_mode = random.pick(&[PolygonMode::Fill, PolygonMode::Fill, PolygonMode::Line]);
                snap(&mut layer);
                layer
            })
            .collect();
        let samples = random.pick(&[Samples::One, Samples::Two, Samples::Four]);
        let drawn = |which: u32, memory: usize, threads: usize| {
            let mut pass = Pass::new();
            for (k, layer) in layers.iter().enumerate() {
                let mesh = Mesh { vertices: &layer.vertices[..], indices: Indices::Sequential };
                match if k % 2 == 0 { which } else { which / 3 } {
                    0 => pass.draw(&Probe, mesh, layer.state),
                    1 => pass.draw(&WritesItBack, mesh, layer.state),
                    _ => pass.draw(&WritesNone, mesh, layer.state),
                };
            }
            let settings = Settings { memory, threads, ..Settings::default() };
            let mut renderer = Renderer::new(settings).expect("the best level");
            Drawing::of_samples(&mut renderer, &pass, WIDTH, HEIGHT, samples).expect("valid")
        };
        let plain = drawn(0, 1 << 29, 1);
        for which in [1, 4, 5, 8] {
            assert_eq!(plain.difference(&drawn(which, 1 << 29, 2)), None, "seed {seed}, {samples:?}, shaders {which}");
        }
    }
}

/// Shaded once a pixel, all samples that a fragment covers have its depth; and it makes no difference in how many flushes a pass is drawn.
#[test]
fn flushes_and_tiles_change_no_bit() {
    for seed in 0..2 {
        let mut random = Random::new(seed ^ 0xdee9);
        let layers: Vec<Layer> = (0..3)
            .map(|_| {
                let mut layer = Layer::random(&mut random, WIDTH, HEIGHT, 2500);
                layer.state = random_state(&mut random);
                layer
            })
            .collect();
        for samples in [Samples::One, Samples::Four] {
            let drawn = |memory: usize, threads: usize, tile: TileSize| {
                let mut pass = Pass::new();
                for layer in &layers {
                    let mesh = Mesh { vertices: &layer.vertices[..], indices: Indices::Sequential };
                    pass.draw(&WritesItBack, mesh, layer.state);
                }
                let settings = Settings { memory, threads, tile, ..Settings::default() };
                let mut renderer = Renderer::new(settings).expect("the best level");
                Drawing::of_samples(&mut renderer, &pass, WIDTH, HEIGHT, samples).expect("valid")
            };
            let whole = drawn(1 << 30, 1, TileSize::T64);
            let parts = drawn(0, 2, TileSize::T16);
            assert!(whole.statistics.flushes == 1 && parts.statistics.flushes > 1);
            assert_eq!(whole.difference(&parts), None, "seed {seed}, {samples:?}");
        }
    }
}
