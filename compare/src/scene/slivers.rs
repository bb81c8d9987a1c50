//! `slivers`: needles half a pixel wide on average and as long as the screen, in all directions, so that boxes around triangles are of no use.

use super::{FULL_HD, Scene, Shading, State, Vertex, matrix};

const NEEDLES: u32 = 4000;
/// Of the broad end, in pixels.
const WIDTH: f32 = 1.0;
/// How far needles reach from the middle of each, in clip space.
const REACH: f32 = 0.9;

pub(super) fn needles() -> Scene {
    let [width, height] = FULL_HD.map(|pixels| pixels as f32);
    let mut vertices = Vec::with_capacity(3 * NEEDLES as usize);
    for needle in 0..NEEDLES {
        let part = needle as f32 / NEEDLES as f32;
        // Directions go round once; middles and depths follow two other sequences (golden ratio, and its square root's cousin).
        let (sin, cos) = libm::sincosf(std::f32::consts::TAU * part);
        let middle = [0.618_034, 0.754_877_7].map(|step: f32| 0.2 * (needle as f32 * step).fract() - 0.1);
        let depth = 0.1 + 0.8 * (needle as f32 * 0.569_840_3).fract();
        let across = [-sin * WIDTH / width, cos * WIDTH / height];
        let color = [part, 1.0 - part, (8.0 * part).fract()];
        let corner = |along: f32, side: f32| Vertex {
            position: [middle[0] + along * cos + side * across[0], middle[1] + along * sin + side * across[1], depth],
            normal: [0.0, 0.0, 1.0],
            color,
        };
        vertices.extend([corner(-REACH, -1.0), corner(REACH, 0.0), corner(-REACH, 1.0)]);
    }
    let indices = (0..3 * NEEDLES).collect();
    Scene::plain(vertices, indices, matrix::IDENTITY, State::default(), Shading::Gouraud)
}
