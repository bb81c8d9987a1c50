//! Viewports: where they put the picture, and what they leave alone.

use pineda::*;
use pineda_oracle::cases::Random;
use pineda_oracle::hits;
use pineda_proof::{Drawing, Probe, ProbeVertex, Renderers, every_setting};

const WIDTH: u32 = 83;
const HEIGHT: u32 = 61;

fn drawn(renderer: &mut Renderer, vertices: &[ProbeVertex], state: DrawState) -> Drawing {
    let mut pass = Pass::new();
    pass.clear_color = Some([9.0; 4]);
    pass.draw(&Probe, Mesh { vertices, indices: Indices::Sequential }, state);
    Drawing::of(renderer, &pass, WIDTH, HEIGHT).expect("valid")
}

fn triangle(random: &mut Random) -> Vec<ProbeVertex> {
    let mut vertex = || ProbeVertex {
        position: [random.real(-1.5, 1.5), random.real(-1.5, 1.5), random.unit(), 1.0],
        smooth: [random.unit(), random.unit()],
        linear: [random.unit(), random.unit()],
    };
    vec![vertex(), vertex(), vertex()]
}

/// Whole pixels, also beyond the target's borders: the same picture as without a viewport, moved, and cut off at the viewport's rectangle.
#[test]
fn a_viewport_moves_and_bounds_the_picture() {
    let mut renderers = Renderers::default();
    for seed in 0..600 {
        let mut random = Random::new(seed);
        let vertices = triangle(&mut random);
        let (x, y) = (random.between(-20, 70), random.between(-20, 50));
        let (width, height) = (random.between(1, 60), random.between(1, 60));
        let viewport = Viewport {
            x: x as f32,
            y: y as f32,
            width: width as f32,
            height: height as f32,
            min_depth: 0.25,
            max_depth: 0.75,
        };
        let renderer = renderers.nth(random.bits());
        let drawing = drawn(renderer, &vertices, DrawState { viewport: Some(viewport), ..DrawState::default() });
        // All products are exact in f64 but for x and y themselves: where snapping is sure, the oracle knows the pixels.
        let corners = [0, 1, 2].map(|k| {
            let [px, py, ..] = vertices[k].position.map(f64::from);
            let (px, py) = ((px + 1.0) / 2.0 * width as f64 + x as f64, (1.0 - py) / 2.0 * height as f64 + y as f64);
            [px, py].map(|v| (v * 256.0).round_ties_even() as i64)
        });
        let covered = hits(&[corners], WIDTH, HEIGHT);
        for (at, count) in covered.into_iter().enumerate() {
            let (i, j) = (at as i64 % i64::from(WIDTH), at as i64 / i64::from(WIDTH));
            let inside = (x..x + width).contains(&i) && (y..y + height).contains(&j);
            let wanted = if inside { count } else { 0 };
            assert_eq!(drawing.hits[at], wanted, "seed {seed}: pixel ({i}, {j}) of {viewport:?}");
            if wanted == 0 {
                assert_eq!((drawing.color[at], drawing.depth[at]), ([9.0; 4], 1.0), "seed {seed}: untouched");
            } else {
                assert!((0.25 - 1e-6..=0.75 + 1e-6).contains(&drawing.depth[at]), "seed {seed}");
            }
        }
    }
}

/// In raster space a viewport only bounds, wherever its corners are, and whatever becomes of triangles on the way.
#[test]
fn a_viewport_cuts_triangles_of_every_size_alike() {
    let mut renderers = Renderers::default();
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let size = random.pick(&[2.0, 9.0, 50.0, 4000.0]);
        let mut vertices = Vec::new();
        for _ in 0..if size < 10.0 { 400 } else { 12 } {
            let middle = [random.real(0.0, 83.0), random.real(0.0, 61.0)];
            for _ in 0..3 {
                let [x, y] = middle.map(|v| v + random.real(-size, size));
                vertices.push(ProbeVertex { position: [x, y, random.unit(), 1.0], ..ProbeVertex::default() });
            }
        }
        let viewport = Viewport {
            x: random.real(-10.0, 60.0),
            y: random.real(-10.0, 40.0),
            width: random.real(1.0, 60.0),
            height: random.real(1.0, 60.0),
            min_depth: 0.0,
            max_depth: 1.0,
        };
        let renderer = renderers.nth(random.bits());
        let state = DrawState { space: Space::Raster, ..DrawState::default() };
        let whole = drawn(renderer, &vertices, state);
        let part = drawn(renderer, &vertices, DrawState { viewport: Some(viewport), ..state });
        let side = |start: f32, size: f32| start.round_ties_even() as i64..(start + size).round_ties_even() as i64;
        let (columns, rows) = (side(viewport.x, viewport.width), side(viewport.y, viewport.height));
        for at in 0..whole.hits.len() {
            let (i, j) = (at as i64 % i64::from(WIDTH), at as i64 / i64::from(WIDTH));
            if columns.contains(&i) && rows.contains(&j) {
                assert_eq!(part.hits[at], whole.hits[at], "seed {seed}: pixel ({i}, {j}) of {viewport:?}");
                assert_eq!(part.color[at].map(f32::to_bits), whole.color[at].map(f32::to_bits));
                assert_eq!((part.depth[at], part.triangle_ids[at]), (whole.depth[at], whole.triangle_ids[at]));
            } else {
                let empty = (0, [9.0; 4], 1.0, NO_ID);
                let found = (part.hits[at], part.color[at], part.depth[at], part.triangle_ids[at]);
                assert_eq!(found, empty, "seed {seed}: pixel ({i}, {j}) is outside {viewport:?}");
            }
        }
    }
    assert!(every_setting().len() >= 9);
}
