//! Records of sixteen triangles at a time: small ones with their coverage, mid-sized ones with their edge functions, large ones with their vertices.

use super::edge::{Edge, pack};
use super::reach::Pixels;
use super::record::plane_bits;
use super::samples::Sample;
use crate::geometry::raster_space::HALF_PIXEL;
use crate::transpose::{transpose8, transpose16};
use crate::wide::{Simd, f32x16, i32x16, u32x16};

/// What is known of sixteen triangles when their records are made: vertices in canonical order, depth's plane, box of samples.
#[derive(Clone, Copy)]
pub(super) struct Facts<S: Simd> {
    ids: i32x16<S>,
    x: [i32x16<S>; 3],
    y: [i32x16<S>; 3],
    z: [f32x16<S>; 3],
    dz_dx: f32x16<S>,
    dz_dy: f32x16<S>,
    pub(super) pixels: Pixels<S>,
    edges: [Edge<S>; 3],
    plane: u32,
}

impl<S: Simd> Facts<S> {
    /// Of triangles on a raster that is moved, so that the sample lies where the pixel's centre would.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one call, inlined")]
    pub(super) fn new(
        ids: i32x16<S>,
        x: [i32x16<S>; 3],
        y: [i32x16<S>; 3],
        z: [f32x16<S>; 3],
        dz_dx: f32x16<S>,
        dz_dy: f32x16<S>,
        pixels: Pixels<S>,
        Sample { plane, offset: [ox, oy] }: Sample,
    ) -> Self {
        let x = [x[0] - ox, x[1] - ox, x[2] - ox];
        let y = [y[0] - oy, y[1] - oy, y[2] - oy];
        let edge = |a: usize, b: usize| Edge { x: x[a], y: y[a], dx: x[b] - x[a], dy: y[b] - y[a] };
        Self { ids, x, y, z, dz_dx, dz_dy, pixels, edges: [edge(0, 1), edge(1, 2), edge(2, 0)], plane }
    }

    /// The first sample of the box's first block.
    #[inline(always)]
    fn first_sample(&self) -> (i32x16<S>, i32x16<S>) {
        (((self.pixels.column0 >> 2) << 10) + HALF_PIXEL, ((self.pixels.row0 >> 2) << 10) + HALF_PIXEL)
    }

    /// The words that mid and large records begin with.
    #[inline(always)]
    fn head(&self) -> [u32x16<S>; 6] {
        [
            self.ids.bitcast(),
            (self.pixels.column0 | (self.pixels.column1 << 16)).bitcast(),
            (self.pixels.row0 | (self.pixels.row1 << 16)).bitcast(),
            self.z[0].bitcast(),
            self.dz_dx.bitcast(),
            self.dz_dy.bitcast(),
        ]
    }
}

/// The records of small triangles, and the lanes of those that cover a sample.
///
/// This and its two siblings are functions of their own so that the compiler gets them in digestible pieces: in one piece, the level without vector
/// instructions took it two minutes.
#[inline(never)]
pub(super) fn small_records<S: Simd>(s: S, facts: &Facts<S>, out: &mut [[u32; 8]; 16]) -> u64 {
    s.apart(
        #[inline(always)]
        || {
            let coverage = small_coverage(s, facts);
            let (left, right) = block_masks(s, coverage, facts.pixels.column0 & 3, facts.pixels.row0 & 3);
            let (first_x, first_y) = facts.first_sample();
            *out = transpose8([
                facts.ids.bitcast(),
                ((facts.pixels.column0 >> 2) | ((facts.pixels.row0 >> 2) << 16) | plane_bits(facts.plane)).bitcast(),
                left.bitcast(),
                right.bitcast(),
                facts.z[0].bitcast(),
                facts.dz_dx.bitcast(),
                facts.dz_dy.bitcast(),
                pack(first_x - facts.x[0], first_y - facts.y[0]),
            ]);
            (!coverage.simd_eq(0)).to_bitmask()
        },
    )
}

#[inline(never)]
pub(super) fn mid_records<S: Simd>(s: S, facts: &Facts<S>, out: &mut [[u32; 16]; 16]) {
    s.apart(
        #[inline(always)]
        || {
            let [id, columns, rows, z0, dz_dx, dz_dy] = facts.head();
            let (x, y) = facts.first_sample();
            *out = transpose16([
                id,
                columns,
                rows,
                z0,
                dz_dx,
                dz_dy,
                (x - facts.x[0]).bitcast(),
                (y - facts.y[0]).bitcast(),
                facts.edges[0].at(x, y).bitcast(),
                facts.edges[1].at(x, y).bitcast(),
                facts.edges[2].at(x, y).bitcast(),
                facts.edges[0].steps(),
                facts.edges[1].steps(),
                facts.edges[2].steps(),
                u32x16::splat(s, facts.plane),
                u32x16::splat(s, 0),
            ]);
        },
    );
}

#[inline(never)]
pub(super) fn large_records<S: Simd>(s: S, facts: &Facts<S>, out: &mut [[u32; 16]; 16]) {
    s.apart(
        #[inline(always)]
        || {
            let [id, columns, rows, z0, dz_dx, dz_dy] = facts.head();
            let (one, none) = (i32x16::splat(s, 1), i32x16::splat(s, 0));
            let rule = facts.edges[0].is_top_left().select(one, none)
                | facts.edges[1].is_top_left().select(one << 1, none)
                | facts.edges[2].is_top_left().select(one << 2, none);
            *out = transpose16([
                id,
                columns,
                rows,
                z0,
                dz_dx,
                dz_dy,
                facts.x[0].bitcast(),
                facts.y[0].bitcast(),
                facts.x[1].bitcast(),
                facts.y[1].bitcast(),
                facts.x[2].bitcast(),
                facts.y[2].bitcast(),
                rule.bitcast(),
                facts.z[1].bitcast(),
                facts.z[2].bitcast(),
                u32x16::splat(s, facts.plane),
            ]);
        },
    );
}

/// Coverage of the 4 x 4 samples from (column0, row0) on: bit 4 j + i is sample (i, j).
#[inline(always)]
fn small_coverage<S: Simd>(s: S, facts: &Facts<S>) -> i32x16<S> {
    let (edges, Pixels { column0, column1, row0, row1 }) = (&facts.edges, facts.pixels);
    let (columns, rows) = (column1 - column0, row1 - row0);
    let (x, y) = ((column0 << 8) + HALF_PIXEL, (row0 << 8) + HALF_PIXEL);
    let [mut e0, mut e1, mut e2] = [edges[0].at(x, y), edges[1].at(x, y), edges[2].at(x, y)];
    let mut outside = i32x16::splat(s, 0);
    let mut j = 0;
    while j < 4 {
        let (mut f0, mut f1, mut f2) = (e0, e1, e2);
        let mut i = 0;
        while i < 4 {
            let sign: u32x16<S> = (f0 | f1 | f2).bitcast();
            outside = outside | ((sign >> 31).bitcast::<i32x16<S>>() << (4 * j + i));
            f0 = f0 - edges[0].dy;
            f1 = f1 - edges[1].dy;
            f2 = f2 - edges[2].dy;
            i += 1;
        }
        e0 = e0 + edges[0].dx;
        e1 = e1 + edges[1].dx;
        e2 = e2 + edges[2].dx;
        j += 1;
    }
    // Samples of the 4 x 4 that lie beyond the box are inside only where the box was cut at the picture's border.
    let two = i32x16::splat(s, 2);
    let in_columns = ((two << columns.max(0).min(3)) - 1) * 0x1111;
    let in_rows = (i32x16::splat(s, 16) << (rows.max(0).min(3) << 2)) - 1;
    (outside ^ 0xffff) & in_columns & in_rows
}

/// Distributes 4 x 4 samples at (x, y), 0 to 3, within a 2 x 2 group of blocks: the masks of the left two and of the right two.
#[inline(always)]
fn block_masks<S: Simd>(s: S, coverage: i32x16<S>, x: i32x16<S>, y: i32x16<S>) -> (i32x16<S>, i32x16<S>) {
    let (mut left, mut right) = (i32x16::splat(s, 0), i32x16::splat(s, 0));
    let mut row = 0;
    while row < 4 {
        let wide = ((coverage >> (4 * row)) & 15) << x;
        left = left | ((wide & 15) << (4 * row));
        right = right | ((wide >> 4) << (4 * row));
        row += 1;
    }
    (left << (y << 2), right << (y << 2))
}
