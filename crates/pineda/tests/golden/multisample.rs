//! Golden scenes of multisampled targets.

use crate::looks::Gouraud;
use crate::scenes::{Layer, Look, RASTER};
use crate::shapes::{Shape, rectangle, soup};
use crate::strokes;
use pineda::*;

/// Thin wedges around a point: the whole number of samples can be counted along their borders.
pub(crate) fn pinwheel() -> Vec<Layer> {
    let colors = [[1.0, 0.55, 0.1, 1.0], [0.95, 0.95, 0.9, 1.0], [0.2, 0.6, 0.9, 1.0]];
    let mut shape = Shape::default();
    for k in 0..18 {
        let angle = |turn: f32| (k as f32 + turn) / 18.0 * core::f32::consts::TAU;
        let corner = |turn: f32, radius: f32| {
            let (sin, cos) = (libm::sinf(angle(turn)), libm::cosf(angle(turn)));
            crate::looks::Vertex {
                position: [60.3 + radius * cos, 45.2 + radius * sin, 0.5, 1.0],
                color: colors[k % 3],
                ..Default::default()
            }
        };
        let first = shape.vertices.len() as u32;
        shape.vertices.extend([corner(0.0, 3.0), corner(0.1, 43.0), corner(0.55, 39.0)]);
        shape.indices.extend([first, first + 1, first + 2]);
    }
    vec![gouraud(shape, RASTER)]
}

/// The same triangles three times, in colours that extrapolation drives beyond what their vertices have: shaded at the lowest sample that they cover, at pixels' centres, and
/// once a sample. Above as they are, below half transparent.
pub(crate) fn samplings() -> Vec<Layer> {
    let mut layers = Vec::new();
    for (column, sampling) in [Sampling::Centroid, Sampling::Center, Sampling::Sample].into_iter().enumerate() {
        for (row, blend) in [Blend::OPAQUE, Blend::ADD].into_iter().enumerate() {
            let mut shape = soup(41, 24, 9.0, [36.0, 40.0]);
            for (k, vertex) in shape.vertices.iter_mut().enumerate() {
                vertex.position[0] += 3.0 + 40.0 * column as f32;
                vertex.position[1] += 3.0 + 44.0 * row as f32;
                vertex.position[3] = 1.0;
                // Steep: from one channel to the next within few pixels.
                vertex.color = [[1.0, 0.0, 0.0, 0.5], [0.0, 1.0, 0.0, 0.5], [0.0, 0.0, 1.0, 0.5]][k % 3];
            }
            let depth = if row == 0 { DepthState::default() } else { DepthState::OFF };
            layers.push(gouraud(shape, DrawState { sampling, blend, depth, ..RASTER }));
        }
    }
    layers
}

/// Above, a rectangle for each of eight masks, with one more sample each; below, alpha from 0 to 1 as coverage, before a wall and without.
pub(crate) fn masks() -> Vec<Layer> {
    let mut layers = Vec::new();
    for k in 0..8 {
        let left = 3.0 + 14.5 * k as f32;
        let shape = rectangle([left, 4.0, left + 11.0, 34.0], 0.5, [[1.0, 0.8, 0.3, 1.0]; 4]);
        layers.push(gouraud(shape, DrawState { sample_mask: (2 << k) - 1, ..RASTER }));
    }
    let wall = rectangle([3.0, 62.0, 117.0, 86.0], 0.75, [[0.1, 0.3, 0.6, 1.0]; 4]);
    layers.push(gouraud(wall, RASTER));
    let ([clear, white], to_coverage) =
        ([[1.0, 1.0, 1.0, 0.0], [1.0; 4]], DrawState { alpha_to_coverage: true, ..RASTER });
    layers.push(gouraud(rectangle([3.0, 40.0, 117.0, 80.0], 0.5, [clear, white, white, clear]), to_coverage));
    layers
}

/// Lines and points of the same scenes as elsewhere, in a picture of their size.
pub(crate) fn strokes() -> Vec<Layer> {
    strokes::wide_and_smooth_lines().into_iter().chain(strokes::points()).collect()
}

fn gouraud(shape: Shape, state: DrawState) -> Layer {
    Layer { shape, look: Look::Gouraud(Gouraud { camera: Mat4::IDENTITY }), state }
}
