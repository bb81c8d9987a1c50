//! `depth_only`: a city of boxes seen from its border, 201,600 triangles of occluders.

use super::{FULL_HD, Output, Scene, Shading, State, Vertex, matrix};

const STREETS_ACROSS: u32 = 150;
const STREETS_AWAY: u32 = 112;
const EYE_DISTANCE: f32 = 6.0;
const FOV_Y: f32 = 50.0 * std::f32::consts::PI / 180.0;
const EYE_HEIGHT: f32 = 2.5;

pub(super) fn occluders() -> Scene {
    let mut vertices = Vec::new();
    let mut indices = Vec::new();
    for away in 0..STREETS_AWAY {
        for across in 0..STREETS_ACROSS {
            let first = vertices.len() as u32;
            vertices.extend((0..8).map(|corner| house(across, away, corner)));
            // Corners are numbered by bits: x, y, z.
            for [a, b, c, d] in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
                indices.extend([a, b, c, a, c, d].map(|corner| first + corner));
            }
        }
    }
    let clip_from_world = matrix::camera_on_z(EYE_DISTANCE, FOV_Y, FULL_HD, 1.0, 200.0);
    let both_sides = State::default();
    Scene { output: Output::Depth, ..Scene::plain(vertices, indices, clip_from_world, both_sides, Shading::Gouraud) }
}

fn house(across: u32, away: u32, corner: u32) -> Vertex {
    let noise = (across * 7919 + away * 104_729).wrapping_mul(0x9e37_79b1) >> 22;
    let height = 0.4 + 3.0 * noise as f32 / 1024.0;
    let at = |bit: u32, low: f32, high: f32| if corner >> bit & 1 == 0 { low } else { high };
    let (left, back) = (across as f32 - 0.5 * STREETS_ACROSS as f32, -(away as f32) - 1.0);
    Vertex {
        position: [at(0, left, left + 0.7), at(1, 0.0, height) - EYE_HEIGHT, at(2, back, back + 0.7)],
        normal: [0.0, 1.0, 0.0],
        color: [1.0; 3],
    }
}
