//! Depth test, blending and discarding against a naive renderer that draws one triangle after the other, pixel by pixel.

use crate::scene::{Layer, random_state};
use pineda::*;
use pineda_oracle::cases::Random;
use pineda_oracle::{coverage, snap};
use pineda_proof::{Drawing, ProbeVertex, Renderers};

/// What a target holds, the slow way.
struct Naive {
    color: Vec<[f32; 4]>,
    depth: Vec<f32>,
    ids: Vec<(u32, u32)>,
}

impl Naive {
    /// Draws layers in order. Coverage comes from the oracle; depth and colour of a triangle are what it has when it is drawn alone.
    fn draw(layers: &[Layer], width: u32, height: u32) -> Self {
        let pixels = (width * height) as usize;
        let mut this =
            Self { color: vec![[0.0; 4]; pixels], depth: vec![1.0; pixels], ids: vec![(NO_ID, NO_ID); pixels] };
        let mut renderer =
            Renderer::new(Settings { simd: Simd::Scalar, threads: 1, ..Settings::default() }).expect("always there");
        for (draw, layer) in layers.iter().enumerate() {
            for (number, corners) in layer.vertices.chunks_exact(3).enumerate() {
                let alone = alone(&mut renderer, corners, width, height);
                let snapped = [0, 1, 2].map(|k| [0, 1].map(|axis| snap(corners[k].position[axis].into()).unwrap_or(0)));
                for (at, covered) in coverage(snapped, width, height).into_iter().enumerate() {
                    assert_eq!(alone.hits[at], u32::from(covered));
                    if covered {
                        this.fragment(layer, at, alone.color[at], alone.depth[at], (draw as u32, number as u32));
                    }
                }
            }
        }
        this
    }

    fn fragment(&mut self, layer: &Layer, at: usize, source: [f32; 4], z: f32, id: (u32, u32)) {
        let there = self.depth[at];
        let passes = match layer.state.depth.compare {
            Compare::Never => false,
            Compare::Less => z < there,
            Compare::Equal => z == there,
            Compare::LessEqual => z <= there,
            Compare::Greater => z > there,
            Compare::NotEqual => z != there,
            Compare::GreaterEqual => z >= there,
            Compare::Always => true,
        };
        if !passes || (layer.discards && source[0] < 0.0) {
            return;
        }
        let [r, g, b, a] = source;
        let over = |source: [f32; 4]| [0, 1, 2, 3].map(|k| source[k] + self.color[at][k] * (1.0 - a));
        self.color[at] = if layer.state.blend == Blend::OPAQUE {
            source
        } else if layer.state.blend == Blend::ALPHA {
            over([r * a, g * a, b * a, a])
        } else {
            assert_eq!(layer.state.blend, Blend::PREMULTIPLIED);
            over(source)
        };
        if layer.state.depth.write {
            self.depth[at] = z;
        }
        self.ids[at] = id;
    }
}

fn alone(renderer: &mut Renderer, corners: &[ProbeVertex], width: u32, height: u32) -> Drawing {
    let depth = DepthState { compare: Compare::Always, write: true };
    let state = DrawState { space: Space::Raster, depth, ..DrawState::default() };
    let layer = Layer { vertices: corners.to_vec(), state, discards: false };
    let mut pass = Pass::new();
    layer.draw(&mut pass);
    Drawing::of(renderer, &pass, width, height).expect("valid")
}

/// Draws layers as one pass and compares everything with the naive renderer.
fn check(renderer: &mut Renderer, layers: &[Layer], width: u32, height: u32, what: &str) {
    let mut pass = Pass::new();
    layers.iter().for_each(|layer| layer.draw(&mut pass));
    let drawing = Drawing::of(renderer, &pass, width, height).expect("valid");
    let naive = Naive::draw(layers, width, height);
    for at in 0..naive.depth.len() {
        let found = (
            (drawing.draw_ids[at], drawing.triangle_ids[at]),
            drawing.depth[at].to_bits(),
            drawing.color[at].map(f32::to_bits),
        );
        let wanted = (naive.ids[at], naive.depth[at].to_bits(), naive.color[at].map(f32::to_bits));
        let (x, y) = (at % width as usize, at / width as usize);
        assert_eq!(
            found, wanted,
            "{what}: pixel ({x}, {y}), {:?} {:?} against {:?} {:?}",
            drawing.depth[at], drawing.color[at], naive.depth[at], naive.color[at]
        );
    }
}

/// Many scenes, each with a renderer of other settings.
fn check_all(what: &str, scenes: u64, make: impl Fn(&mut Random, u32, u32) -> Vec<Layer>) {
    let mut renderers = Renderers::default();
    for seed in 0..scenes {
        let mut random = Random::new(seed);
        let (width, height) = (random.between(1, 90) as u32, random.between(1, 70) as u32);
        let layers = make(&mut random, width, height);
        check(renderers.nth(random.bits()), &layers, width, height, &format!("{what}, scene {seed}"));
    }
}

#[test]
fn nearest_wins_and_the_first_of_equals() {
    check_all("less", 400, |random, width, height| vec![Layer::random(random, width, height, 24)]);
}

#[test]
fn every_comparison_is_the_naive_one() {
    check_all("comparisons", 800, |random, width, height| {
        let count = random.between(1, 3);
        let layer = |random: &mut Random| {
            let mut layer = Layer::random(random, width, height, 10);
            layer.state.depth.compare = random.pick(&Compare::ALL);
            layer
        };
        (0..count).map(|_| layer(random)).collect()
    });
}

#[test]
fn any_mixture_of_states_is_drawn_in_submission_order() {
    check_all("mixtures", 800, |random, width, height| {
        let count = random.between(1, 5);
        let layer = |random: &mut Random| {
            let triangles = random.between(1, 8) as usize;
            let (mut layer, state) = (Layer::random(random, width, height, triangles), random_state(random));
            layer.state = state;
            layer.discards = random.one_in(3);
            layer
        };
        (0..count).map(|_| layer(random)).collect()
    });
}

/// A window, a whole tile even, may be known to hold nothing beyond some depth; what lies exactly there, give or take a rounding of
/// its plane, must not be left out because of it. Slivers' planes round the most.
#[test]
fn what_is_hidden_does_not_depend_on_tiles() {
    check_all("slivers on a wall", 400, |random, width, height| {
        let wall = random.pick(&[0.25, 0.3, 0.5, 0.7]);
        let vertex = |x: f32, y: f32, z: f32| ProbeVertex { position: [x, y, z, 1.0], ..ProbeVertex::default() };
        let mut layer = Layer::random(random, width, height, 0);
        layer.vertices.extend([vertex(-9.0, -9.0, wall), vertex(500.0, -9.0, wall), vertex(-9.0, 500.0, wall)]);
        for _ in 0..60 {
            let start = [random.real(-9.0, 100.0), random.real(-9.0, 100.0)];
            let size = random.pick(&[40.0, 300.0]);
            let step = [random.real(-size, size), random.real(-size, size)];
            for t in [0.0, 1.0, 2.0] {
                let [x, y] = [0, 1].map(|axis| start[axis] + t * step[axis] + random.real(-0.5, 0.5));
                let z = if random.one_in(3) { wall } else { random.real(wall, 1.0) };
                layer.vertices.push(vertex(x, y, z));
            }
        }
        vec![layer]
    });
}

/// All samples on the edge between the two corners that touch the wall are as far away as the wall; rounded, they are a little nearer, and so
/// they are to be seen, however much of a tile is known to hold nothing beyond the wall.
#[test]
fn an_edge_that_rounds_to_before_the_wall_is_seen() {
    let vertex = |x: f32, y: f32, z: f32| ProbeVertex { position: [x, y, z, 1.0], ..ProbeVertex::default() };
    let wall = [vertex(-500.0, -500.0, 0.3), vertex(900.0, -500.0, 0.3), vertex(-500.0, 900.0, 0.3)];
    let leaning = [vertex(-99.5, -99.5, 0.3), vertex(160.5, 160.5, 0.3), vertex(89.253_91, -155.394_53, 0.792_367_46)];
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    let layer = Layer { vertices: [wall, leaning].concat(), state, discards: false };
    let mut renderers = Renderers::default();
    for setting in 0..renderers.count() {
        check(renderers.nth(setting), std::slice::from_ref(&layer), 64, 64, &format!("setting {setting}"));
    }
}

/// Corners in pixels, with a number each that is interpolated.
type Corners = [([f32; 2], f32); 3];

/// Draws triangles side by side: a number and a triangle's number for each pixel.
fn side_by_side(simd: Simd, triangles: &[Corners], width: u32, height: u32) -> (Vec<[f32; 4]>, Vec<u32>) {
    let pixels = (width * height) as usize;
    let (mut color, mut ids) = (vec![[0.0; 4]; pixels], vec![NO_ID; pixels]);
    let mesh = Mesh { vertices: triangles.as_flattened(), indices: Indices::Sequential };
    let mut pass = Pass::new();
    pass.draw_with(
        mesh,
        DrawState { space: Space::Raster, ..DrawState::default() },
        |&([x, y], value)| (Vec4::from([x, y, 0.5, 1.0 + value]), Vec3::from([value, 2.0 * value, 1.0 - value])),
        |f| Rgba::opaque(f.varyings()),
    );
    let mut target =
        Target { color: ColorBuffer::Rgba32F(&mut color), triangle_ids: Some(&mut ids), ..Target::new(width, height) };
    Renderer::new(Settings { simd, ..Settings::default() })
        .and_then(|mut r| r.render(&pass, &mut target))
        .expect("valid");
    (color, ids)
}

/// Interpolation keeps triangles in 512 places, by number: those that are 512 apart and show in one block drive each other out.
#[test]
fn triangles_that_share_a_place_in_the_cache_are_not_taken_for_each_other() {
    let center = ([10.3, 9.7], 0.25);
    let rim = [[8.1, 8.2], [11.9, 8.3], [11.8, 11.9], [8.2, 11.7]].map(|p| (p, p[0] * 0.1));
    let fan = [0, 1, 2, 3].map(|k| [center, rim[k], rim[(k + 1) % 4]]);
    let (expected, fan_ids) = side_by_side(Simd::Scalar, &fan, 20, 20);
    let mut apart = vec![[center; 3]; 3 * 512 + 1];
    for (k, triangle) in fan.into_iter().enumerate() {
        apart[512 * k] = triangle;
    }
    for simd in [Simd::Scalar, Simd::Auto] {
        let (color, ids) = side_by_side(simd, &apart, 20, 20);
        assert_eq!(color, expected);
        let numbers: Vec<u32> = fan_ids.iter().map(|&id| if id == NO_ID { id } else { 512 * id }).collect();
        assert_eq!(ids, numbers);
        assert!((0..4).all(|k| ids.contains(&(512 * k))));
    }
}

/// Of large triangles, edge functions do not fit 32 bits where they cover; they meet small ones in many blocks.
#[test]
fn large_triangles_beside_small_ones_are_interpolated_as_when_alone() {
    let (width, height) = (420, 300);
    let large = [([1.25, 2.5], 0.5), ([417.0, 150.5], 0.75), ([3.5, 297.75], 1.0)];
    let mut triangles = vec![large];
    for k in 0..40u16 {
        let y = 7.0 * f32::from(k);
        triangles.push([large[1], ([419.0, y], 0.1), ([419.0, y + 7.0], 0.9)]);
        triangles.push([([2.0 + y, 1.0], 0.2), ([9.0 + y, 1.5], 0.6), ([5.0 + y, 3.0 + 0.36 * y], 0.3)]);
    }
    let (color, ids) = side_by_side(Simd::Auto, &triangles, width, height);
    for (number, &triangle) in triangles.iter().enumerate() {
        let (alone, _) = side_by_side(Simd::Scalar, &[triangle], width, height);
        for at in (0..ids.len()).filter(|&at| ids[at] == number as u32) {
            assert_eq!(color[at], alone[at], "triangle {number}, pixel {at}");
        }
    }
}
