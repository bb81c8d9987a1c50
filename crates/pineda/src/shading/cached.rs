//! Triangles made ready for interpolation, kept while a tile shows them.
//!
//! A triangle of thirty pixels shows in about nine packets. What each of them needs of it is put together once: its vertices in canonical
//! order, by how much the varyings differ, its edge functions.

use super::packet::VaryingLayout;
use super::run::{RECORD_HEADER, RunView, record_rows};
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::raster::triangle_id::{ORDER_BITS, TriangleId};
use bytemuck::{must_cast, must_cast_slice};

/// Triangles that are kept at a time; a power of two. Tiles of 64 x 64 pixels seldom show more, but for triangles that are too small to be kept.
const SLOTS: usize = 512;

/// Rows of a triangle before its varyings.
pub(crate) const TRIANGLE_HEADER: usize = 3;

/// Rows of four words for each of some triangles of a run:
///
/// - what the edge function of vertex 1 gains a subpixel right and a subpixel down, its value at the centre of pixel (0, 0), and the sum of all
///   three edge functions, which is the same everywhere: twice the triangle's area;
/// - the same of vertex 2;
/// - 1 / w of the vertices;
/// - of each varying, its value at vertex 0, and by how much those at vertex 1 and 2 exceed it;
/// - the same of the depth, if it is interpolated.
///
/// Edge functions wrap around in 32 bits. A triangle whose area makes that matter in a pixel that it touches is not kept.
#[derive(Debug)]
pub(crate) struct TriangleCache {
    /// The number of the run's first triangle in the batch, which tells runs apart.
    run: Option<usize>,
    /// The triangle in each slot; its complement if it cannot be kept, which is no triangle's id (memory ends before there are as many). 0 is none.
    ids: [u32; SLOTS],
    rows: Vec<[u32; 4]>,
    each: usize,
    varyings: usize,
    depth: bool,
}

impl TriangleCache {
    pub(crate) fn new() -> Self {
        Self { run: None, ids: [0; SLOTS], rows: Vec::new(), each: 0, varyings: 0, depth: false }
    }

    /// Another batch comes.
    pub(crate) fn forget(&mut self) {
        self.run = None;
    }

    /// From here on, triangles are of a run with so many varyings.
    #[inline(always)]
    pub(crate) fn start(&mut self, run: &RunView<'_>, layout: &VaryingLayout) {
        if self.run == Some(run.first_number) {
            return;
        }
        self.run = Some(run.first_number);
        self.ids = [0; SLOTS];
        (self.varyings, self.depth) = (layout.interpolation.len(), layout.depth);
        self.each = TRIANGLE_HEADER + self.varyings + usize::from(self.depth);
        if self.rows.len() < SLOTS * self.each {
            self.rows.resize(SLOTS * self.each, [0; 4]);
        }
    }

    /// Makes a triangle ready, unless it is, or cannot be kept.
    #[inline(always)]
    pub(crate) fn prepare(&mut self, run: &RunView<'_>, id: u32) {
        let there = self.ids[slot(id)];
        if there != id && there != !id {
            self.fill(run, id);
        }
    }

    /// Whether a triangle is ready.
    #[inline(always)]
    pub(crate) fn holds(&self, id: u32) -> bool {
        self.ids[slot(id)] == id
    }

    /// The rows of a triangle that is ready.
    #[inline(always)]
    pub(crate) fn rows(&self, id: u32) -> &[[u32; 4]] {
        let first = slot(id) * self.each;
        &self.rows[first..first + self.each]
    }

    #[inline(never)]
    fn fill(&mut self, run: &RunView<'_>, id: u32) {
        let first = slot(id) * self.each;
        let (header, varyings) = self.rows[first..first + self.each].split_at_mut(TRIANGLE_HEADER);
        let (varyings, depth) = varyings.split_at_mut(self.varyings);
        let each = record_rows(self.varyings);
        let places @ [a, b, c] = run.canonical_places(TriangleId(id));
        if let [row] = depth {
            let [z0, d1, d2] = run.vertex_depths(places);
            *row = must_cast([z0, d1, d2, 0.0]);
        }
        let record = |place: usize| -> &[u32] { must_cast_slice(&run.records[place * each..(place + 1) * each]) };
        let (a, f0) = record(a).split_at(RECORD_HEADER);
        let (b, f1) = record(b).split_at(RECORD_HEADER);
        let (c, f2) = record(c).split_at(RECORD_HEADER);
        let (x, y) = ([a[0] as i32, b[0] as i32, c[0] as i32], [a[1] as i32, b[1] as i32, c[1] as i32]);
        let wide = |from: i32, to: i32| i64::from(to) - i64::from(from);
        let area = wide(x[0], x[1]) * wide(y[0], y[2]) - wide(x[0], x[2]) * wide(y[0], y[1]);
        let span = |v: [i32; 3]| i64::from(v[0].max(v[1]).max(v[2]) - v[0].min(v[1]).min(v[2]));
        let beyond = (span(x) + span(y)) * i64::from(SUBPIXELS);
        let Some(area) = i32::try_from(area + beyond).ok().and(i32::try_from(area).ok()) else {
            self.ids[slot(id)] = !id;
            return;
        };
        header[0] = edge([x[2], y[2]], [x[0], y[0]], area);
        header[1] = edge([x[0], y[0]], [x[1], y[1]], area);
        header[2] = [a[2], b[2], c[2], 0];
        let count = varyings.len();
        let (f0, f1, f2) = (&f0[..count], &f1[..count], &f2[..count]);
        for (k, row) in varyings.iter_mut().enumerate() {
            let first = f32::from_bits(f0[k]);
            *row = must_cast([first, f32::from_bits(f1[k]) - first, f32::from_bits(f2[k]) - first, 0.0]);
        }
        self.ids[slot(id)] = id;
    }
}

/// Of the edge from p to q, in subpixels: what its edge function gains a subpixel right, a subpixel down, its value at the centre of pixel (0, 0);
/// and the sum.
fn edge(p: [i32; 2], q: [i32; 2], sum: i32) -> [u32; 4] {
    let (right, down) = (p[1] - q[1], q[0] - p[0]);
    let (px, py, qx, qy) = (p[0] - HALF_PIXEL, p[1] - HALF_PIXEL, q[0] - HALF_PIXEL, q[1] - HALF_PIXEL);
    let first = px.wrapping_mul(qy).wrapping_sub(qx.wrapping_mul(py));
    [right as u32, down as u32, first as u32, sum as u32]
}

#[inline(always)]
fn slot(id: u32) -> usize {
    (id >> ORDER_BITS) as usize & (SLOTS - 1)
}
