//! `micro`: a sheet of jittered quads over the whole picture, twice as many across as down: 1000 x 500 are a million triangles of 2.07 pixels on average.

use super::{Scene, Shading, State, Vertex, matrix};

pub(super) const TRIANGLES: u32 = 1_000_000;
/// How far a vertex strays from its place in the grid, in cells. Below 0.5 / sqrt(2) no triangle can turn over.
const JITTER: f32 = 0.3;

/// About so many triangles: four times a square number.
pub(super) fn sheet(triangles: u32) -> Scene {
    let rows = (triangles / 4).isqrt().max(1);
    let sheet = Sheet { columns: 2 * rows, rows };
    let mut vertices = Vec::with_capacity(((sheet.columns + 1) * (rows + 1)) as usize);
    for row in 0..=rows {
        for column in 0..=sheet.columns {
            vertices.push(sheet.knot(column, row));
        }
    }
    let mut indices = Vec::with_capacity((6 * sheet.columns * rows) as usize);
    for row in 0..rows {
        for column in 0..sheet.columns {
            let here = row * (sheet.columns + 1) + column;
            let above = here + sheet.columns + 1;
            indices.extend([here, here + 1, above + 1, here, above + 1, above]);
        }
    }
    Scene::plain(vertices, indices, matrix::IDENTITY, State::default(), Shading::Gouraud)
}

struct Sheet {
    columns: u32,
    rows: u32,
}

impl Sheet {
    fn knot(&self, column: u32, row: u32) -> Vertex {
        let Self { columns, rows } = *self;
        let noise = hash(row * (columns + 1) + column);
        // The border stays where it is, so that the sheet covers every pixel.
        let inner_x = if column == 0 || column == columns { 0.0 } else { JITTER };
        let inner_y = if row == 0 || row == rows { 0.0 } else { JITTER };
        let x = 2.0 * (column as f32 + inner_x * signed(noise)) / columns as f32 - 1.0;
        let y = 2.0 * (row as f32 + inner_y * signed(noise >> 11)) / rows as f32 - 1.0;
        let wave = libm::sinf(5.0 * x) * libm::cosf(4.0 * y);
        let grain = 0.1 * signed(noise >> 22);
        Vertex {
            position: [x, y, 0.5 + 0.3 * wave],
            normal: [0.0, 0.0, 1.0],
            color: [0.5 + 0.4 * x + grain, 0.5 + 0.4 * y + grain, 0.5 - 0.4 * wave + grain],
        }
    }
}

/// The low ten bits as a number in -1..1.
fn signed(bits: u32) -> f32 {
    (bits & 1023) as f32 / 512.0 - 1.0
}

/// A permutation of the 32-bit integers that scatters neighbours (Chris Wellons, "Prospecting for Hash Functions": lowbias32).
fn hash(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}
