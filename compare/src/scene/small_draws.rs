//! `small_draws`: balls of 96 triangles, each a draw with a matrix of its own and other fixed functions than the draw before.

use super::{Draw, Scene, Shading, State, Vertex, matrix};

const COLUMNS: u32 = 50;
const ROWS: u32 = 40;
const MERIDIANS: u32 = 8;
/// Rings of vertices between the poles.
const RINGS: u32 = 6;
/// In columns: neighbours overlap.
const RADIUS: f32 = 0.8;

pub(super) fn balls() -> Scene {
    let (vertices, indices) = ball();
    let (count, repeated) = (indices.len() as u32, COLUMNS * ROWS);
    let draws = (0..repeated).map(|number| Draw {
        indices: number * count..(number + 1) * count,
        clip_from_world: place(number),
        state: State { culls_back_faces: number % 2 == 0, blends: number % 3 == 0, passes_equal: number % 5 < 2 },
    });
    let draws = draws.collect();
    let indices = indices.repeat(repeated as usize);
    Scene { draws, ..Scene::plain(vertices, indices, matrix::IDENTITY, State::default(), Shading::Gouraud) }
}

/// Where a ball is: columns from the left, rows from the bottom, depths all over.
fn place(number: u32) -> matrix::Matrix {
    let (column, row) = (number % COLUMNS, number / COLUMNS);
    let (scale_x, scale_y) = (RADIUS * 2.0 / COLUMNS as f32, RADIUS * 2.0 / ROWS as f32);
    let at = |k: u32, count: u32| 2.0 * (k as f32 + 0.5) / count as f32 - 1.0;
    let depth = 0.1 + 0.8 * (number as f32 * 0.618_034).fract();
    [
        [scale_x, 0.0, 0.0, at(column, COLUMNS)],
        [0.0, scale_y, 0.0, at(row, ROWS)],
        // Towards the eye is nearer.
        [0.0, 0.0, -0.05, depth],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

/// A sphere of radius 1: a pole, rings from it to the other, and that one.
fn ball() -> (Vec<Vertex>, Vec<u32>) {
    let vertex = |normal: [f32; 3]| Vertex { position: normal, normal, color: normal.map(|axis| 0.5 + 0.5 * axis) };
    let mut vertices = vec![vertex([0.0, 1.0, 0.0])];
    for ring in 1..=RINGS {
        let (sin, cos) = libm::sincosf(std::f32::consts::PI * ring as f32 / (RINGS + 1) as f32);
        for meridian in 0..MERIDIANS {
            let (east, north) = libm::sincosf(std::f32::consts::TAU * meridian as f32 / MERIDIANS as f32);
            vertices.push(vertex([sin * east, cos, sin * north]));
        }
    }
    vertices.push(vertex([0.0, -1.0, 0.0]));
    let at = |ring: u32, meridian: u32| 1 + ring * MERIDIANS + meridian % MERIDIANS;
    let last = vertices.len() as u32 - 1;
    let mut indices = Vec::new();
    for meridian in 0..MERIDIANS {
        indices.extend([0, at(0, meridian), at(0, meridian + 1)]);
        for ring in 0..RINGS - 1 {
            let [a, b] = [at(ring, meridian), at(ring, meridian + 1)];
            let [c, d] = [at(ring + 1, meridian), at(ring + 1, meridian + 1)];
            indices.extend([a, c, d, a, d, b]);
        }
        indices.extend([last, at(RINGS - 1, meridian + 1), at(RINGS - 1, meridian)]);
    }
    (vertices, indices)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn front_faces_look_outwards() {
        let (vertices, indices) = ball();
        for triangle in indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|corner| vertices[triangle[corner] as usize].position);
            let edge = |to: [f32; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
            let (u, v) = (edge(b), edge(c));
            let face = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let middle: [f32; 3] = std::array::from_fn(|axis| a[axis] + b[axis] + c[axis]);
            assert!((0..3).map(|axis| face[axis] * middle[axis]).sum::<f32>() > 0.0);
        }
    }
}
