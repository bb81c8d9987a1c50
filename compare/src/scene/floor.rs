//! `floor`: two triangles that reach to the horizon, texels from larger than pixels to a hundredth of one.

use super::{FULL_HD, Scene, Shading, State, Texture, Vertex, matrix};

const EYE_DISTANCE: f32 = 1.0;
const FOV_Y: f32 = 60.0 * std::f32::consts::PI / 180.0;
const EYE_HEIGHT: f32 = 1.0;
const FAR: f32 = 400.0;

pub(super) fn floor() -> Scene {
    let corner = |x: f32, away: f32| Vertex {
        position: [x * FAR, -EYE_HEIGHT, -away],
        normal: [0.0, 1.0, 0.0],
        // Turned a little, so that no texture axis is a picture axis.
        color: [0.25 * (0.9 * x * FAR + 0.3 * away), 0.25 * (0.9 * away - 0.3 * x * FAR), 0.0],
    };
    let vertices = vec![corner(-1.0, 0.0), corner(1.0, 0.0), corner(1.0, FAR), corner(-1.0, FAR)];
    let clip_from_world = matrix::camera_on_z(EYE_DISTANCE, FOV_Y, FULL_HD, 0.1, 1000.0);
    let plain = Scene::plain(vertices, vec![0, 1, 2, 0, 2, 3], clip_from_world, State::default(), Shading::Floor);
    Scene { textures: vec![Texture::bricks(7)], ..plain }
}
