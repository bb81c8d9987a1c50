//! Derivatives of expressions where fragments are shaded elsewhere than at pixels' centres, and where they come in order.

use crate::multisample::{moved, snap};
use crate::scene::{Layer, random_state};
use pineda::*;
use pineda_oracle::cases::Random;
use pineda_proof::{Drawing, ProbeVertex, Renderers};

const WIDTH: u32 = 71;
const HEIGHT: u32 = 50;

const SEVERAL: [Samples; 4] = [Samples::Two, Samples::Four, Samples::Eight, Samples::Sixteen];

/// Shows derivatives; everything with perspective.
struct Plain;

/// The same with coordinates of which some are linear on the screen, and discarding.
struct Mixed;

varyings! {
    struct Coordinates {
        smooth: Vec2,
        #[noperspective]
        linear: Vec2,
    }
}

/// An expression, its derivatives, and those of another one.
#[shader]
fn shown<L: Lanes>(smooth: Vec2<Dual<L>>, linear: Vec2<Dual<L>>) -> Rgba<L> {
    let product = smooth.x * linear.x + smooth.y / (linear.y * linear.y + 1.0);
    Rgba { r: product.dx(), g: product.dy(), b: smooth.length().fwidth(), a: product.value().abs().min(1.0) }
}

#[shader]
impl Shader for Plain {
    type Vertex = ProbeVertex;
    type Varyings<L: Lanes> = Vec4<L>;
    const DERIVATIVES: bool = true;
    fn vertex(&self, v: &ProbeVertex) -> (Vec4, Vec4) {
        let ([x, y], [z, w]) = (v.smooth, v.linear);
        (v.position.into(), [x, y, z, w].into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Vec4 { x, y, z, w } = f.dual();
        shown(Vec2::new(x, y), Vec2::new(z, w))
    }
}

#[shader]
impl Shader for Mixed {
    type Vertex = ProbeVertex;
    type Varyings<L: Lanes> = Coordinates<L>;
    const DERIVATIVES: bool = true;
    const DISCARDS: bool = true;
    fn vertex(&self, v: &ProbeVertex) -> (Vec4, Coordinates) {
        (v.position.into(), Coordinates { smooth: v.smooth.into(), linear: v.linear.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Coordinates { smooth, linear } = f.dual();
        f.discard(linear.y.value().lt(-0.7));
        shown(smooth, linear)
    }
}

/// A layer that discards is drawn with the mixed one.
fn draw(renderer: &mut Renderer, layers: &[Layer], samples: Samples) -> Drawing {
    let mut pass = Pass::new();
    pass.clear_color = Some([0.0; 4]);
    for layer in layers {
        let mesh = Mesh { vertices: &layer.vertices, indices: Indices::Sequential };
        if layer.discards {
            pass.draw(&Mixed, mesh, layer.state);
        } else {
            pass.draw(&Plain, mesh, layer.state);
        }
    }
    Drawing::of_samples(renderer, &pass, WIDTH, HEIGHT, samples).expect("a valid pass")
}

fn layer(random: &mut Random, triangles: usize) -> Layer {
    let mut layer = Layer::random(random, WIDTH, HEIGHT, triangles);
    layer.state = random_state(random);
    layer.discards = random.one_in(3);
    snap(&mut layer);
    layer
}

#[test]
fn derivatives_of_samples_are_those_of_the_moved_scene() {
    let mut renderers = Renderers::default();
    for seed in 0..if cfg!(debug_assertions) { 24 } else { 120 } {
        let mut random = Random::new(seed ^ 0x7e57);
        let mut layers: Vec<Layer> = (0..3).map(|_| layer(&mut random, 25)).collect();
        layers.iter_mut().for_each(|layer| layer.state.sampling = Sampling::Sample);
        let samples = SEVERAL[seed as usize % 4];
        let drawing = draw(renderers.nth(seed), &layers, samples);
        for (k, &position) in samples.positions().iter().enumerate() {
            let picture = draw(renderers.nth(seed / 3), &moved(&layers, position), Samples::One);
            assert_eq!(picture.difference(&drawing.sample(k)), None, "seed {seed}: {samples:?}, sample {k}");
        }
    }
}

#[test]
fn derivatives_are_those_of_the_place_where_a_fragment_is_shaded() {
    let mut renderers = Renderers::default();
    for seed in 0..if cfg!(debug_assertions) { 6 } else { 24 } {
        let mut random = Random::new(seed ^ 0xce27);
        let mut layer = layer(&mut random, 10);
        let sampling = random.pick(&[Sampling::Centroid, Sampling::Center]);
        layer.state = DrawState { space: Space::Raster, sampling, ..DrawState::default() };
        let samples = SEVERAL[seed as usize % 4];
        let renderer = renderers.nth(seed);
        // What is shaded in order goes other ways.
        let ordered = DrawState { depth: DepthState { compare: Compare::Always, write: false }, ..layer.state };
        for state in [layer.state, ordered] {
            layer.state = state;
            let drawing = draw(renderer, &[layer.clone()], samples);
            let positions: Vec<[u8; 2]> = [[8, 8]].iter().chain(samples.positions()).copied().collect();
            let mut alone = |triangle: usize, position: [u8; 2]| {
                let vertices = layer.vertices[3 * triangle..3 * triangle + 3].to_vec();
                draw(renderer, &moved(&[Layer { vertices, ..layer.clone() }], position), Samples::One)
            };
            let pictures: Vec<Vec<Drawing>> =
                (0..10).map(|t| positions.iter().map(|&position| alone(t, position)).collect()).collect();
            for (at, &triangle) in drawing.triangle_ids.iter().enumerate().filter(|(_, id)| **id != NO_ID) {
                let pixel = at % (WIDTH * HEIGHT) as usize;
                let places = &pictures[triangle as usize];
                let place = match sampling {
                    // Extrapolated, it has no picture that shows it.
                    Sampling::Center if places[0].hits[pixel] == 0 => continue,
                    Sampling::Center => &places[0],
                    _ => places.iter().find(|picture| picture.hits[pixel] != 0).expect("it covers this sample"),
                };
                let (found, wanted) = (drawing.color[at].map(f32::to_bits), place.color[pixel].map(f32::to_bits));
                assert_eq!(found, wanted, "seed {seed}: {samples:?}, {sampling:?}, pixel {pixel}");
            }
        }
    }
}

/// Drawn in order and added, or as what is visible and added afterwards.
#[test]
fn derivatives_of_layers_in_order_are_those_of_each_alone() {
    let mut renderers = Renderers::default();
    for seed in 0..if cfg!(debug_assertions) { 12 } else { 60 } {
        let mut random = Random::new(seed ^ 0xb1e4);
        let mut all = layer(&mut random, 8);
        let samples = random.pick(&[Samples::One, Samples::Four]);
        let alone = DrawState {
            space: Space::Raster,
            sampling: random.pick(&[Sampling::Centroid, Sampling::Center, Sampling::Sample]),
            depth: DepthState { compare: Compare::LessEqual, write: true },
            ..DrawState::default()
        };
        let mut sum = vec![[0.0f32; 4]; WIDTH as usize * HEIGHT as usize * samples.count()];
        for vertices in all.vertices.chunks(3) {
            let one = Layer { vertices: vertices.to_vec(), state: alone, ..all };
            let drawing = draw(renderers.nth(random.bits()), &[one], samples);
            for (sum, color) in sum.iter_mut().zip(&drawing.color) {
                *sum = [0, 1, 2, 3].map(|k| color[k] + sum[k]);
            }
        }
        all.state = DrawState { blend: Blend::ADD, depth: DepthState::OFF, ..alone };
        let drawing = draw(renderers.nth(seed), &[all], samples);
        for (at, (found, wanted)) in drawing.color.iter().zip(&sum).enumerate() {
            let is_same = found.map(f32::to_bits) == wanted.map(f32::to_bits);
            assert!(is_same, "seed {seed}, {samples:?}, sample {at}: {found:?}, not {wanted:?}");
        }
    }
}
