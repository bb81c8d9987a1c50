//! Passes cut in pieces, by little memory or by the user, are the same bits as whole ones.

use crate::scene::{Layer, random_state};
use pineda::*;
use pineda_oracle::cases::Random;
use pineda_proof::Drawing;

const WIDTH: u32 = 150;
const HEIGHT: u32 = 90;

fn layers(seed: u64, count: usize, triangles: usize) -> Vec<Layer> {
    let mut random = Random::new(seed);
    let layer = |_| {
        let mut layer = Layer::random(&mut random, WIDTH, HEIGHT, triangles);
        if random.one_in(2) {
            layer.state = random_state(&mut random);
            layer.discards = random.one_in(3);
        }
        layer
    };
    (0..count).map(layer).collect()
}

fn drawn(settings: Settings, layers: &[Layer]) -> Drawing {
    let mut pass = Pass::new();
    layers.iter().for_each(|layer| layer.draw(&mut pass));
    let mut renderer = Renderer::new(settings).expect("an available level");
    Drawing::of(&mut renderer, &pass, WIDTH, HEIGHT).expect("valid")
}

#[test]
fn several_flushes_are_the_same_bits_as_one() {
    for seed in 0..4 {
        // 56 bytes a triangle and three vertices of 48: a megabyte is full after about 4,000.
        let layers = layers(seed, 3, 3_000);
        let whole = drawn(Settings { threads: 2, ..Settings::default() }, &layers);
        assert_eq!(whole.statistics.flushes, 1);
        for (threads, tile) in [(1, TileSize::T64), (2, TileSize::T32), (7, TileSize::T16)] {
            let parts = drawn(Settings { memory: 0, threads, tile, ..Settings::default() }, &layers);
            assert!(parts.statistics.flushes > 1, "{:?}", parts.statistics);
            assert_eq!(whole.difference(&parts), None, "seed {seed}, {threads} threads, {tile:?}");
        }
    }
}

#[test]
fn indexed_meshes_are_cut_like_others() {
    // Indices all over the buffer: no stretch of triangles has vertices that stand close together.
    let mut random = Random::new(7);
    let layer = Layer::random(&mut random, WIDTH, HEIGHT, 4_000);
    let count = layer.vertices.len() as u64;
    let indices: Vec<u32> = (0..3 * 9_000).map(|_| (random.bits() % count) as u32).collect();
    let draw = |memory: usize| {
        let mut pass = Pass::new();
        let mesh = Mesh { vertices: &layer.vertices, indices: Indices::U32(&indices) };
        pass.draw(&pineda_proof::Probe, mesh, layer.state);
        let mut renderer = Renderer::new(Settings { memory, ..Settings::default() }).expect("the best level");
        Drawing::of(&mut renderer, &pass, WIDTH, HEIGHT).expect("valid")
    };
    let (whole, parts) = (draw(512 << 20), draw(0));
    assert!(whole.statistics.flushes == 1 && parts.statistics.flushes > 1);
    assert_eq!(whole.difference(&parts), None);
}

#[test]
fn a_pass_split_in_two_is_the_same_picture() {
    for seed in 0..40 {
        let layers = layers(100 + seed, 4, 30);
        let whole = drawn(Settings::default(), &layers);
        let mut renderer = Renderer::new(Settings::default()).expect("the best level");
        let (mut first, mut second) = (Pass::new(), Pass::new());
        (second.clear_color, second.clear_depth) = (None, None);
        layers[..2].iter().for_each(|layer| layer.draw(&mut first));
        layers[2..].iter().for_each(|layer| layer.draw(&mut second));
        let mut parts = Drawing::of(&mut renderer, &first, WIDTH, HEIGHT).expect("valid");
        let hits = parts.hits.clone();
        parts.draw_over(&mut renderer, &second).expect("valid");
        // Ids and hits are the second pass's alone; colour and depth go on.
        assert!(parts.hits.iter().zip(hits).map(|(b, a)| a + b).eq(whole.hits.iter().copied()), "seed {seed}");
        let bits = |drawing: &Drawing| -> Vec<u32> {
            let color = drawing.color.iter().flatten().map(|v| v.to_bits());
            color.chain(drawing.depth.iter().map(|v| v.to_bits())).collect()
        };
        assert!(bits(&parts) == bits(&whole), "seed {seed}");
    }
}

#[test]
fn an_empty_pass_clears() {
    let mut renderer = Renderer::new(Settings::default()).expect("the best level");
    let mut pass = Pass::new();
    pass.clear_color = Some([0.25, -1.0, 2.0, 0.5]);
    pass.clear_depth = Some(f32::NAN);
    let drawing = Drawing::of(&mut renderer, &pass, 5, 3).expect("valid");
    assert_eq!(drawing.color, [[0.25, -1.0, 2.0, 0.5]; 15]);
    assert_eq!((drawing.depth, drawing.hits, drawing.triangle_ids), (vec![0.0; 15], vec![0; 15], vec![NO_ID; 15]));
}

#[test]
fn a_renderer_forgets_what_it_drew() {
    // Large, then small, then large again, with and without depth and colour.
    let mut renderer = Renderer::new(Settings { threads: 2, ..Settings::default() }).expect("the best level");
    let layers = layers(9, 2, 600);
    let fresh = drawn(Settings::default(), &layers);
    let mut pass = Pass::new();
    layers.iter().for_each(|layer| layer.draw(&mut pass));
    for (width, height) in [(3, 900), (1, 1), (700, 2)] {
        Drawing::of(&mut renderer, &pass, width, height).expect("valid");
        renderer.render(&pass, &mut Target::new(width, height)).expect("valid");
        let again = Drawing::of(&mut renderer, &pass, WIDTH, HEIGHT).expect("valid");
        assert_eq!(fresh.difference(&again), None);
    }
}

#[test]
fn tiles_without_triangles_leave_what_others_would() {
    // A depth buffer of the caller's may hold anything; what it is read as does not depend on where tiles end.
    let given = [-1.0, f32::NAN, 0.25, 2.0];
    let corner = [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]];
    let [small, middle, large] = TileSize::ALL.map(|tile| {
        let mut pixels = vec![[7; 4]; 80 * 80];
        let mut depth: Vec<f32> = given.into_iter().cycle().take(80 * 80).collect();
        let mut ids = vec![9; 80 * 80];
        let mut pass = Pass::new();
        (pass.clear_color, pass.clear_depth) = (None, None);
        pass.draw_with(
            Mesh { vertices: &corner, indices: Indices::Sequential },
            DrawState { space: Space::Raster, ..DrawState::default() },
            |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), Real::from(1.0)),
            |f| Rgba::gray(f.varyings()),
        );
        let mut target = Target {
            color: ColorBuffer::Rgba8(&mut pixels),
            depth: DepthBuffer::D32F(&mut depth),
            triangle_ids: Some(&mut ids),
            ..Target::new(80, 80)
        };
        let mut renderer = Renderer::new(Settings { tile, ..Settings::default() }).expect("available");
        renderer.render(&pass, &mut target).expect("valid");
        assert_eq!((pixels[79 * 80 + 79], ids[79 * 80 + 79]), ([7; 4], NO_ID));
        assert_eq!(depth[79 * 80..79 * 80 + 4], [0.0, 0.0, 0.25, 1.0]);
        (pixels, depth, ids)
    });
    assert!(small == large && middle == large);
}
