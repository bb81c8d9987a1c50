//! Where a draw may draw: scissor rectangles, and viewports that lie anywhere or upside down.

use crate::common::{HEIGHT, WIDTH, settings};
use pineda::*;
use pineda_oracle::cases::Random;
use pineda_proof::{Drawing, Probe, ProbeVertex};

fn drawn(settings: &Settings, vertices: &[ProbeVertex], state: DrawState) -> Drawing {
    let mut pass = Pass::new();
    pass.clear_color = Some([9.0; 4]);
    pass.draw(&Probe, Mesh { vertices, indices: Indices::Sequential }, state);
    let mut renderer = Renderer::new(settings.clone()).expect("available");
    Drawing::of(&mut renderer, &pass, WIDTH, HEIGHT).expect("valid")
}

/// Triangles of all sizes, in clip space, some of them beyond the near and the far plane.
fn triangles(random: &mut Random) -> Vec<ProbeVertex> {
    let mut vertices = Vec::new();
    for _ in 0..12 {
        let (size, w) = (random.pick(&[0.05, 0.3, 2.0, 500.0]), random.magnitude(-2, 2));
        let middle = [random.real(-1.0, 1.0), random.real(-1.0, 1.0)];
        for _ in 0..3 {
            let [x, y] = middle.map(|v| (v + random.real(-size, size)) * w);
            let position = [x, y, random.real(-0.2, 1.2) * w, w];
            let mut pair = || [random.unit(), random.unit()];
            vertices.push(ProbeVertex { position, smooth: pair(), linear: pair() });
        }
    }
    vertices
}

fn viewport(random: &mut Random) -> Viewport {
    Viewport {
        x: random.real(-30.0, 30.0),
        y: random.real(-20.0, 20.0),
        width: random.real(0.5, 70.0),
        height: random.real(0.5, 40.0),
        min_depth: random.pick(&[0.0, 0.25, 1.0]),
        max_depth: random.pick(&[1.0, 0.5, 0.0]),
    }
}

#[test]
fn a_scissor_rectangle_leaves_what_is_inside() {
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let vertices = triangles(&mut random);
        let state = DrawState { viewport: random.one_in(2).then(|| viewport(&mut random)), ..DrawState::default() };
        let scissor = Scissor {
            x: random.pick(&[i32::MIN, -7, 0, 3, 16, 37, i32::MAX]),
            y: random.pick(&[i32::MIN, -2, 0, 1, 9, 13, i32::MAX]),
            width: random.pick(&[0, 1, 11, 30, u32::MAX]),
            height: random.pick(&[0, 1, 6, 14, u32::MAX]),
        };
        let columns = i64::from(scissor.x)..i64::from(scissor.x) + i64::from(scissor.width);
        let rows = i64::from(scissor.y)..i64::from(scissor.y) + i64::from(scissor.height);
        for settings in settings(seed) {
            let mut wanted = drawn(&settings, &vertices, state);
            let found = drawn(&settings, &vertices, DrawState { scissor: Some(scissor), ..state });
            for at in 0..wanted.hits.len() {
                let (i, j) = (at as i64 % i64::from(WIDTH), at as i64 / i64::from(WIDTH));
                if !columns.contains(&i) || !rows.contains(&j) {
                    (wanted.color[at], wanted.depth[at], wanted.hits[at]) = ([9.0; 4], 1.0, 0);
                    (wanted.triangle_ids[at], wanted.draw_ids[at], wanted.instance_ids[at]) = (NO_ID, NO_ID, NO_ID);
                    wanted.barycentrics[at] = [0.0; 3];
                }
            }
            assert_eq!(found.difference(&wanted), None, "scene {seed}, {scissor:?}, {settings:?}");
        }
    }
}

/// Upside down twice is upright: a negative height with every y negated is the same picture to the bit, windings included.
#[test]
fn a_negative_height_turns_the_picture_upside_down() {
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let vertices = triangles(&mut random);
        let mirrored: Vec<ProbeVertex> = vertices
            .iter()
            .map(|v| {
                let [x, y, z, w] = v.position;
                ProbeVertex { position: [x, -y, z, w], ..*v }
            })
            .collect();
        // So that y + height is exact.
        let quarter = |v: f32| (v * 4.0).round() / 4.0;
        let mut upright = viewport(&mut random);
        (upright.y, upright.height) = (quarter(upright.y), quarter(upright.height));
        let flipped = Viewport { y: upright.y + upright.height, height: -upright.height, ..upright };
        let cull = random.pick(&[Cull::None, Cull::Front, Cull::Back]);
        let state = |viewport| DrawState { viewport: Some(viewport), cull, ..DrawState::default() };
        for settings in settings(seed) {
            let wanted = drawn(&settings, &vertices, state(upright));
            let found = drawn(&settings, &mirrored, state(flipped));
            assert_eq!(found.difference(&wanted), None, "scene {seed}, {flipped:?}, {settings:?}");
        }
    }
}

/// In raster space, where y points down already, only the rectangle counts.
#[test]
fn in_raster_space_the_sign_of_the_height_makes_no_difference() {
    let vertex = |x: f32, y: f32| ProbeVertex { position: [x, y, 0.5, 1.0], ..ProbeVertex::default() };
    let vertices = [vertex(-5.0, -5.0), vertex(60.0, 2.0), vertex(3.0, 40.0)];
    let upright = Viewport { x: 4.0, y: 3.0, width: 20.0, height: 7.0, min_depth: 0.0, max_depth: 1.0 };
    let flipped = Viewport { y: 10.0, height: -7.0, ..upright };
    let state = |viewport| DrawState { space: Space::Raster, viewport: Some(viewport), ..DrawState::default() };
    let [a, b] = [upright, flipped].map(|viewport| drawn(&Settings::default(), &vertices, state(viewport)));
    assert_eq!(a.difference(&b), None);
    assert!(a.hits.contains(&1));
}
