//! Packets of many triangles: each lane loads vertices of its own.

use super::barycentric::{Both, Corner3};
use super::centroid::centroid_offsets_of_vertices;
use super::distinct::{Distinct, Fragments};
use super::packet::{BATCH, PacketBatch, PacketRows, VaryingLayout};
use super::run::{RECORD_HEADER, RecordRow, RunView, record_rows};
use super::weights::of_lanes;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::raster::triangle_id::ORDER_BITS;
use crate::tile::view::{BlockLanes, Positions};
use crate::transpose::{columns4, each_of_sixteen};
use crate::wide::{Simd, Words, f32x16, i32x16, u32x4, u32x16};

/// A triangle for each lane: the places of its three vertices, in canonical order; and the first rows of their records.
struct ByLane {
    places: [[u32; 16]; 3],
    rows: [[u32; 16]; 3],
}

impl ByLane {
    #[inline(always)]
    fn new<S: Simd>(s: S, run: &RunView<'_>, each: usize, ids: &[u32; 16]) -> Self {
        let ids = u32x16::simd_from(s, *ids);
        let [a, b, c] = run.corners.of_each(s, (ids >> ORDER_BITS) - (run.first_number as u32 + 1));
        let code: i32x16<S> = (ids & ((1 << ORDER_BITS) - 1)).bitcast();
        let (first_is_1, first_is_2) = (code.simd_eq(1) | code.simd_eq(4), code.simd_eq(2) | code.simd_eq(5));
        let counter_clockwise = code.simd_ge(3);
        let second = first_is_1.select(c, first_is_2.select(a, b));
        let third = first_is_1.select(a, first_is_2.select(b, c));
        let first = first_is_1.select(b, first_is_2.select(c, a));
        let (second, third) = (counter_clockwise.select(third, second), counter_clockwise.select(second, third));
        let each = each as u32;
        Self {
            places: [first.into(), second.into(), third.into()],
            rows: [(first * each).into(), (second * each).into(), (third * each).into()],
        }
    }

    /// Row `r` of the records of each lane's three vertices, in canonical order: eight words, lane by lane.
    ///
    /// If `is_half`, only the first four are needed, and loaded.
    #[inline(always)]
    fn load<S: Simd>(&self, s: S, run: &RunView<'_>, r: usize, is_half: bool, corners: &mut [[[u32; 16]; 8]; 3]) {
        let ([a, b, c], records) = (corners, &run.records[r..]);
        let load = if is_half { load_rows::<S, true> } else { load_rows::<S, false> };
        load(s, records, &self.rows[0], a);
        load(s, records, &self.rows[1], b);
        load(s, records, &self.rows[2], c);
    }

    /// The depths of each lane's vertices.
    #[inline(always)]
    fn depths<S: Simd>(&self, s: S, run: &RunView<'_>) -> Corner3<S> {
        let mut depths = [[0.0; 16]; 3];
        let mut lane = 0;
        while lane < 16 {
            let places = [self.places[0][lane] as usize, self.places[1][lane] as usize, self.places[2][lane] as usize];
            [depths[0][lane], depths[1][lane], depths[2][lane]] = run.vertex_depths(places);
            lane += 1;
        }
        let [f0, d1, d2] = depths;
        Corner3 { f0: f32x16::simd_from(s, f0), d1: f32x16::simd_from(s, d1), d2: f32x16::simd_from(s, d2) }
    }
}

/// Packets whose lanes each load vertices of their own; with derivatives if `FULL`.
#[inline(always)]
pub(crate) fn by_lane<S: Simd, const FULL: bool>(
    s: S,
    run: &RunView<'_>,
    layout: &VaryingLayout,
    batch: &mut PacketBatch,
    distinct: &[Distinct; BATCH],
    list: &[u8],
) {
    let lanes = BlockLanes::new(s);
    let mut i = 0;
    while i < list.len() {
        let k = list[i] as usize;
        let (fragments, mut rows) = batch.packet(k);
        lane_by_lane::<S, FULL>(s, run, layout, &fragments, &distinct[k & (BATCH - 1)], &lanes, &mut rows);
        i += 1;
    }
}

#[inline(always)]
fn lane_by_lane<S: Simd, const FULL: bool>(
    s: S,
    run: &RunView<'_>,
    layout: &VaryingLayout,
    fragments: &Fragments<'_>,
    distinct: &Distinct,
    lanes: &BlockLanes<S>,
    rows: &mut PacketRows<'_>,
) {
    let varyings = layout.interpolation.len();
    let vertices = &ByLane::new(s, run, record_rows(varyings), &distinct.lanes);
    // The first row of each record holds x, y, 1 / w and the first varyings.
    let mut corners = [[[0; 16]; 8]; 3];
    vertices.load(s, run, 0, varyings <= 4 - RECORD_HEADER, &mut corners);
    let at = Positions::new(s, lanes, fragments.moved);
    let x = at.x + (fragments.x * SUBPIXELS + HALF_PIXEL);
    let y = at.y + (fragments.y * SUBPIXELS + HALF_PIXEL);
    let [x0, x1, x2]: [i32x16<S>; 3] = word(s, &corners, 0);
    let [y0, y1, y2]: [i32x16<S>; 3] = word(s, &corners, 1);
    let (mut vx, mut vy) = ([x0 - x, x1 - x, x2 - x], [y0 - y, y1 - y, y2 - y]);
    if fragments.border != 0 {
        let [ox, oy] = centroid_offsets_of_vertices(s, vx, vy, fragments.border, fragments.samples);
        (vx, vy) = ([vx[0] - ox, vx[1] - ox, vx[2] - ox], [vy[0] - oy, vy[1] - oy, vy[2] - oy]);
    }
    let weights = of_lanes::<S, FULL>(vx, vy, word(s, &corners, 2));
    let both = Both::new::<FULL>(s, &weights, layout);
    let mut r = 0;
    while r < record_rows(varyings) {
        if r != 0 {
            vertices.load(s, run, r, RECORD_HEADER + varyings <= 8 * r + 4, &mut corners);
        }
        let mut i = 0;
        while i < 8 {
            // Words before the varyings, or behind the last.
            let k = (8 * r + i).wrapping_sub(RECORD_HEADER);
            if k < varyings {
                let [f0, f1, f2]: [f32x16<S>; 3] = word(s, &corners, i);
                both.set::<FULL>(layout, rows, k, Corner3 { f0, d1: f1 - f0, d2: f2 - f0 });
            }
            i += 1;
        }
        r += 1;
    }
    if layout.depth {
        *rows.z = weights.depth(s, vertices.depths(s, run)).into();
    }
}

/// Word `i` of the rows of all three vertices.
#[inline(always)]
fn word<S: Simd, W: Words<S>>(s: S, corners: &[[[u32; 16]; 8]; 3], i: usize) -> [W; 3] {
    [
        u32x16::from_slice(s, &corners[0][i]).bitcast(),
        u32x16::from_slice(s, &corners[1][i]).bitcast(),
        u32x16::from_slice(s, &corners[2][i]).bitcast(),
    ]
}

/// Loads the rows that `at` names: eight words, lane by lane; if `HALF`, the first four, and they stand for the others.
///
/// A function of its own, so that no more indices are at hand at once than there are registers for. Among other code the compiler finds all 48 of a packet first, and puts them and
/// most of what they load into memory.
#[inline(never)]
fn load_rows<S: Simd, const HALF: bool>(s: S, rows: &[RecordRow], at: &[u32; 16], out: &mut [[u32; 16]; 8]) {
    s.apart(
        #[inline(always)]
        || {
            // A minimum instead of a comparison and a branch: what is loaded first need not wait until the last index is judged.
            let row = |lane: usize| rows[(at[lane] as usize).min(rows.len() - 1)].as_chunks::<4>().0;
            let [a, b, c, d] = columns4(each_of_sixteen!(|lane| u32x4::simd_from(s, row(lane)[0])));
            let [mut e, mut f, mut g, mut h] = [a, b, c, d];
            if !HALF {
                [e, f, g, h] = columns4(each_of_sixteen!(|lane| u32x4::simd_from(s, row(lane)[1])));
            }
            *out = [a.into(), b.into(), c.into(), d.into(), e.into(), f.into(), g.into(), h.into()];
        },
    );
}
