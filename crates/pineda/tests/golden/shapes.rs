//! Meshes built in code, from arithmetic and `libm` only: the same bits on every machine.

use crate::looks::Vertex;
use core::f32::consts::TAU;
use libm::{cosf, sinf};
use pineda_oracle::cases::Random;

/// Triangles as vertices and indices.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shape {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) indices: Vec<u32>,
}

/// Triangles of about `size` pixels all over a picture, in raster space; w varies from corner to corner, alpha too.
pub(crate) fn soup(seed: u64, count: usize, size: f32, [width, height]: [f32; 2]) -> Shape {
    let mut random = Random::new(seed);
    let mut shape = Shape::default();
    for _ in 0..count {
        let middle = [random.real(0.0, width), random.real(0.0, height)];
        for _ in 0..3 {
            let [x, y] = middle.map(|v| v + random.real(-size, size));
            let color = [random.unit(), random.unit(), random.unit(), random.unit()];
            let position = [x, y, random.unit(), random.magnitude(-2, 2)];
            shape.vertices.push(Vertex { position, color, ..Vertex::default() });
        }
    }
    shape.indices = (0..shape.vertices.len() as u32).collect();
    shape
}

/// Needles: a hundred pixels long, a fraction of one wide.
pub(crate) fn slivers(seed: u64, count: usize, [width, height]: [f32; 2]) -> Shape {
    let mut random = Random::new(seed);
    let mut shape = soup(seed, count, 0.5, [width, height]);
    for corners in shape.vertices.chunks_exact_mut(3) {
        let step = [random.real(-90.0, 90.0), random.real(-90.0, 90.0)];
        for (t, corner) in [-1.0, 0.0, 1.0].into_iter().zip(corners) {
            corner.position[0] += t * step[0];
            corner.position[1] += t * step[1];
        }
    }
    shape
}

/// A tube along a trefoil knot, `along` x `around` squares.
pub(crate) fn knot(along: u32, around: u32) -> Shape {
    let centre = |t: f32| {
        let r = 2.0 + cosf(3.0 * t);
        [r * cosf(2.0 * t), r * sinf(2.0 * t), sinf(3.0 * t)]
    };
    let mut shape = Shape::default();
    for i in 0..=along {
        let t = i as f32 / along as f32 * TAU;
        let (here, next) = (centre(t), centre(t + 0.01));
        let forward = unit([0, 1, 2].map(|k| next[k] - here[k]));
        let side = unit(cross(forward, [0.0, 0.0, 1.0]));
        let up = cross(side, forward);
        for j in 0..=around {
            let a = j as f32 / around as f32 * TAU;
            let normal = [0, 1, 2].map(|k| side[k] * cosf(a) + up[k] * sinf(a));
            let [x, y, z] = [0, 1, 2].map(|k| here[k] + 0.6 * normal[k]);
            let color = [0.5 + 0.5 * sinf(t), 0.5 + 0.4 * sinf(t + 2.1), 0.5 + 0.5 * sinf(t + 4.2), 1.0];
            shape.vertices.push(Vertex { position: [x, y, z, 1.0], normal, color });
        }
    }
    shape.indices = grid_indices(along, around);
    shape
}

/// A flat square from (-size, 0, -size) to (size, 0, size), coloured like a chessboard with a gradient.
pub(crate) fn ground(size: f32, squares: u32) -> Shape {
    let mut shape = Shape::default();
    for i in 0..=squares {
        for j in 0..=squares {
            let [u, v] = [i, j].map(|k| k as f32 / squares as f32);
            let light = if (i + j) % 2 == 0 { 0.9 } else { 0.2 };
            let position = [(2.0 * u - 1.0) * size, 0.0, (2.0 * v - 1.0) * size, 1.0];
            shape.vertices.push(Vertex { position, normal: [0.0, 1.0, 0.0], color: [u, v, light, 1.0] });
        }
    }
    shape.indices = grid_indices(squares, squares);
    shape
}

/// A rectangle in raster space, its colours at the corners: top left, top right, bottom right, bottom left.
pub(crate) fn rectangle([x0, y0, x1, y1]: [f32; 4], z: f32, colors: [[f32; 4]; 4]) -> Shape {
    let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    let vertex =
        |k: usize| Vertex { position: [corners[k][0], corners[k][1], z, 1.0], color: colors[k], ..Vertex::default() };
    Shape { vertices: (0..4).map(vertex).collect(), indices: vec![0, 1, 2, 0, 2, 3] }
}

fn grid_indices(rows: u32, columns: u32) -> Vec<u32> {
    let mut indices = Vec::new();
    for i in 0..rows {
        for j in 0..columns {
            let a = i * (columns + 1) + j;
            let b = a + columns + 1;
            indices.extend([a, a + 1, b + 1, a, b + 1, b]);
        }
    }
    indices
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}
