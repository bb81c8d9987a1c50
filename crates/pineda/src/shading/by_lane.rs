//! Packets of many triangles: each lane loads vertices of its own.

use super::barycentric::{Both, Corner3};
use super::centroid::centroid_offsets_of_vertices;
use super::distinct::{Distinct, Fragments};
use super::packet::{BATCH, PacketBatch, PacketRows, VaryingLayout};
use super::run::{RECORD_HEADER, RunView, record_rows};
use super::weights::of_lanes;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::raster::triangle_id::ORDER_BITS;
use crate::tile::view::{BlockLanes, Positions};
use crate::transpose::columns4;
use crate::wide::{Simd, f32x16, i32x16, u32x4, u32x16};

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

    /// Row `r` of the records of each lane's vertex `corner`, in canonical order: four words, lane by lane.
    #[inline(always)]
    fn row<S: Simd>(&self, s: S, run: &RunView<'_>, corner: usize, r: usize) -> [u32x16<S>; 4] {
        let at = &self.rows[corner];
        columns4(four(s, run, at, r, 0), four(s, run, at, r, 4), four(s, run, at, r, 8), four(s, run, at, r, 12))
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

#[inline(always)]
fn four<S: Simd>(s: S, run: &RunView<'_>, at: &[u32; 16], r: usize, lane: usize) -> u32x16<S> {
    let a = load(s, run, at[lane] as usize + r);
    let b = load(s, run, at[lane + 1] as usize + r);
    let c = load(s, run, at[lane + 2] as usize + r);
    let d = load(s, run, at[lane + 3] as usize + r);
    a.combine(b).combine(c.combine(d))
}

#[inline(always)]
fn load<S: Simd>(s: S, run: &RunView<'_>, at: usize) -> u32x4<S> {
    u32x4::simd_from(s, run.records[at])
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
    // The first row of each record holds x, y, 1 / w and the first varying.
    let [mut a, mut b, mut c] = rows_of_three(s, run, vertices, 0);
    let at = Positions::new(s, lanes, fragments.moved);
    let x = at.x + (fragments.x * SUBPIXELS + HALF_PIXEL);
    let y = at.y + (fragments.y * SUBPIXELS + HALF_PIXEL);
    let mut vx = [a[0].bitcast::<i32x16<S>>() - x, b[0].bitcast::<i32x16<S>>() - x, c[0].bitcast::<i32x16<S>>() - x];
    let mut vy = [a[1].bitcast::<i32x16<S>>() - y, b[1].bitcast::<i32x16<S>>() - y, c[1].bitcast::<i32x16<S>>() - y];
    if fragments.border != 0 {
        let [ox, oy] = centroid_offsets_of_vertices(s, vx, vy, fragments.border, fragments.samples);
        (vx, vy) = ([vx[0] - ox, vx[1] - ox, vx[2] - ox], [vy[0] - oy, vy[1] - oy, vy[2] - oy]);
    }
    let weights = of_lanes::<S, FULL>(vx, vy, [a[2].bitcast(), b[2].bitcast(), c[2].bitcast()]);
    let both = Both::new::<FULL>(s, &weights, layout);
    let mut r = 0;
    while r < record_rows(varyings) {
        if r != 0 {
            [a, b, c] = rows_of_three(s, run, vertices, r);
        }
        let mut i = 0;
        while i < 4 {
            // Words before the varyings, or behind the last.
            let k = (4 * r + i).wrapping_sub(RECORD_HEADER);
            if k < varyings {
                let f0: f32x16<S> = a[i].bitcast();
                let corner = Corner3 { f0, d1: b[i].bitcast::<f32x16<S>>() - f0, d2: c[i].bitcast::<f32x16<S>>() - f0 };
                both.set::<FULL>(layout, rows, k, corner);
            }
            i += 1;
        }
        r += 1;
    }
    if layout.depth {
        *rows.z = weights.depth(s, vertices.depths(s, run)).into();
    }
}

/// Row `r` of the records of all three vertices.
#[inline(always)]
fn rows_of_three<S: Simd>(s: S, run: &RunView<'_>, vertices: &ByLane, r: usize) -> [[u32x16<S>; 4]; 3] {
    [vertices.row(s, run, 0, r), vertices.row(s, run, 1, r), vertices.row(s, run, 2, r)]
}
