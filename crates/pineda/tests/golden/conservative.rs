//! Scenes of conservative rasterization.

use crate::looks::{Gouraud, Vertex};
use crate::scenes::{Layer, Look, RASTER};
use crate::shapes::Shape;
use core::f32::consts::TAU;
use libm::{cosf, sinf};
use pineda::*;

/// Pixels of a column, and of the picture.
const COLUMN: f32 = 56.0;
pub(crate) const SIZE: [u32; 2] = [3 * 56, 72];

/// Three columns of the same triangles: all that they touch, ordinary ones, all that they cover whole. Each adds its colour to a pixel, so that one sees where neighbours overlap
/// and where there is a gap.
pub(crate) fn three_columns() -> Vec<Layer> {
    let modes = [Conservative::Overestimate, Conservative::Off, Conservative::Underestimate];
    let mut layers = Vec::new();
    for (k, conservative) in modes.into_iter().enumerate() {
        let x = k as f32 * COLUMN;
        let state = DrawState { conservative, blend: Blend::ADD, depth: DepthState::OFF, ..RASTER };
        layers.push(layer(near_plane(), DrawState { space: Space::Clip, viewport: Some(viewport(x)), ..state }));
        let on_raster = [fan(), needles(), specks(), steps()].concat();
        layers.push(layer(
            on_raster.into_iter().map(|([px, py], color)| vertex([x + px, py, 0.5, 1.0], color)).collect(),
            state,
        ));
    }
    layers
}

fn layer(vertices: Vec<Vertex>, state: DrawState) -> Layer {
    let indices = (0..vertices.len() as u32).collect();
    Layer { shape: Shape { vertices, indices }, look: Look::Gouraud(Gouraud { camera: Mat4::IDENTITY }), state }
}

type Corner = ([f32; 2], [f32; 3]);

fn vertex(position: [f32; 4], [r, g, b]: [f32; 3]) -> Vertex {
    Vertex { position, normal: [0.0; 3], color: [r, g, b, 1.0] }
}

/// Triangles around a middle: each has its neighbours' edges.
fn fan() -> Vec<Corner> {
    let rim = |k: u8| {
        let angle = (f32::from(k % 9) + 0.3) / 9.0 * TAU;
        let radius = if k.is_multiple_of(2) { 15.0 } else { 12.5 };
        [19.3 + radius * cosf(angle), 17.6 + radius * sinf(angle)]
    };
    let colors = [[0.5, 0.15, 0.1], [0.1, 0.45, 0.15], [0.15, 0.2, 0.55]];
    (0..9u8).flat_map(|k| [[19.3, 17.6], rim(k), rim(k + 1)].map(|p| (p, colors[usize::from(k) % 3]))).collect()
}

/// Thinner than a pixel.
fn needles() -> Vec<Corner> {
    let ends = [([38.2, 3.4], [53.7, 6.9]), ([38.2, 9.8], [53.1, 20.3]), ([38.5, 15.5], [44.2, 33.0])];
    ends.into_iter().flat_map(|(a, [x, y])| [a, [x, y], [x, y + 0.4]].map(|p| (p, [0.6, 0.5, 0.2]))).collect()
}

/// Smaller than a pixel: within one, over a border, over a corner, with a corner on a corner.
fn specks() -> Vec<Corner> {
    let places = [[49.3, 24.3], [52.8, 24.3], [49.8, 28.8], [53.0, 29.0]];
    let corners = places.into_iter().flat_map(|[x, y]| [[x, y], [x + 0.45, y + 0.1], [x + 0.2, y + 0.5]]);
    corners.map(|p| (p, [0.2, 0.6, 0.7])).collect()
}

/// Squares of whole pixels, cut along their diagonals: a pixel's border is no gap.
fn steps() -> Vec<Corner> {
    let square = |k: u8| {
        let (x, y, side) = (3.0 + 12.0 * f32::from(k), 36.0, 3.0 + 2.0 * f32::from(k));
        let [a, b, c, d] = [[x, y], [x + side, y], [x + side, y + side], [x, y + side]];
        [
            (a, [0.5, 0.2, 0.4]),
            (b, [0.5, 0.2, 0.4]),
            (c, [0.5, 0.2, 0.4]),
            (a, [0.2, 0.4, 0.3]),
            (c, [0.2, 0.4, 0.3]),
            (d, [0.2, 0.4, 0.3]),
        ]
    };
    (0..4).flat_map(square).collect()
}

fn viewport(x: f32) -> Viewport {
    Viewport { x: x + 2.0, y: 49.0, width: COLUMN - 4.0, height: 21.0, ..Viewport::whole(1, 1) }
}

/// Two that go on behind the eye, and share the edge there.
fn near_plane() -> Vec<Vertex> {
    let at = |x: f32, y: f32, w: f32| [x, y, w - 0.5, w];
    let [a, b, c, d] = [at(0.0, 0.8, 1.0), at(0.95, -0.3, 1.0), at(0.2, -5.0, -1.0), at(-0.95, -0.1, 1.0)];
    let half = |corners: [[f32; 4]; 3], color| corners.map(|p| vertex(p, color));
    [half([a, b, c], [0.5, 0.35, 0.1]), half([a, c, d], [0.1, 0.3, 0.5])].concat()
}
