//! `fill`: 16 layers, each two triangles over the whole picture, so that coverage, depth and colour writes are all that counts.

use super::{Scene, Shading, State, Vertex, matrix};

const LAYERS: u32 = 16;
/// Depth from one layer to the next.
const SPACING: f32 = 0.05;
/// How much farther a layer's right edge is than its left one: less than the spacing, so that layers never cross.
const TILT: f32 = 0.02;

/// The order of submission.
#[derive(Clone, Copy)]
pub(super) enum Order {
    /// Every layer after the first fails its depth test.
    FrontToBack,
    /// Every layer passes and overwrites the one before.
    BackToFront,
}

pub(super) fn layers(order: Order) -> Scene {
    with_state(order, State::default())
}

/// The farthest first.
pub(super) fn translucent_layers() -> Scene {
    with_state(Order::BackToFront, State { blends: true, ..State::default() })
}

fn with_state(order: Order, state: State) -> Scene {
    let mut vertices = Vec::new();
    let mut indices = Vec::new();
    for step in 0..LAYERS {
        let layer = match order {
            Order::FrontToBack => step,
            Order::BackToFront => LAYERS - 1 - step,
        };
        let first = vertices.len() as u32;
        vertices.extend([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| corner(layer, x, y)));
        indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
    Scene::plain(vertices, indices, matrix::IDENTITY, state, Shading::Gouraud)
}

fn corner(layer: u32, x: f32, y: f32) -> Vertex {
    let nearness = 1.0 - layer as f32 / LAYERS as f32;
    Vertex {
        position: [x, y, 0.1 + SPACING * layer as f32 + TILT * (0.5 + 0.5 * x)],
        normal: [0.0, 0.0, 1.0],
        color: [0.5 + 0.5 * x, 0.5 + 0.5 * y, nearness],
    }
}
