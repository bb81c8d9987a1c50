//! Setup: sixteen triangles at a time, from snapped vertices to records in bins.
//!
//! For each triangle, in the lanes: its box of samples, its signed area, culling, the canonical order of its vertices, its depth's
//! plane, and, by its size, its coverage mask (small) or its edge functions (mid). Then, one after the other in submission order, its
//! record and its bins. The edge function here is
//!
//! ```text
//! E_ab(p) = (b.x - a.x)(p.y - a.y) - (b.y - a.y)(p.x - a.x)
//! ```
//!
//! for vertices in clockwise order on the picture: positive inside (Pineda 1988; his has the other sign, for the other winding).

use super::bins::{BinEntry, Kind, Share, TileGrid, bin, bin_large};
use super::corners::{Corners, Sixteen};
use super::depth_bias::Bias;
use super::record::{LargeTriangle, MID_EXTENT, MidTriangle, SMALL_EXTENT, SampleBox, SmallTriangle, plane_bits};
use super::samples::{Sample, SampleSet};
use super::top_left::is_top_left;
use super::triangle_id::{CLIPPED_CLOCKWISE, CLIPPED_COUNTER_CLOCKWISE, ORDER_BITS, TriangleId};
use crate::geometry::clip::{ClipTriangle, Clipped, clip};
use crate::geometry::project::{Projection, outcode};
use crate::geometry::raster_space::{HALF_PIXEL, OFF_RASTER, SUBPIXEL_BITS, SUBPIXELS, ScreenVertex};
use crate::transpose::{transpose8, transpose16};
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};

/// A rectangle of pixels: left and top inside, right and bottom outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PixelRect {
    pub(crate) x0: i32,
    pub(crate) y0: i32,
    pub(crate) x1: i32,
    pub(crate) y1: i32,
}

/// What setup must know of a run's draw.
#[derive(Clone, Copy)]
pub(crate) struct SetupState<'a> {
    pub(crate) grid: TileGrid,
    /// No sample outside is covered.
    pub(crate) rect: PixelRect,
    pub(crate) samples: SampleSet,
    pub(crate) cull_clockwise: bool,
    pub(crate) cull_counter_clockwise: bool,
    pub(crate) bias: Option<Bias>,
    /// Whether degenerate and culled triangles are counted.
    pub(crate) counts: bool,
    /// Whether two triangles, the halves of a rectangle, have one number.
    pub(crate) numbered_in_pairs: bool,
    pub(crate) projection: &'a Projection,
    /// Runs a draw's vertex stage again, for a triangle that needs clipping: its vertices by their places.
    pub(crate) vertices: &'a (dyn Fn([usize; 3]) -> ClipTriangle + Sync),
}

/// Sets up triangles `range` of a run; `first_number` is the number of the run's triangle 0 in the batch.
#[inline(always)]
pub(crate) fn setup<S: Simd>(
    s: S,
    state: &SetupState<'_>,
    corners: &Corners<'_>,
    screen: &[ScreenVertex],
    range: std::ops::Range<usize>,
    first_number: usize,
    share: &mut Share,
) {
    let mut t = range.start;
    share.statistics.triangles += range.len() as u64;
    while t < range.end {
        let count = (range.end - t).min(16);
        let triangles = Sixteen::load(s, corners, screen, t, count);
        let mut ids = lane_numbers(s, 1 << ORDER_BITS) + TriangleId::first(first_number + t) as i32;
        if state.numbered_in_pairs {
            let numbers = (lane_numbers(s, 1) + t as i32) >> 1;
            ids = (numbers << ORDER_BITS) + TriangleId::first(first_number) as i32;
        }
        let mut todo = (1u64 << count) - 1;
        let mut off = off_raster(s, &triangles) & todo;
        // Mostly once. A triangle that needs care is taken between those before and those after it.
        while todo != 0 {
            let next = off.trailing_zeros();
            let before = todo & !u64::MAX.checked_shl(next).unwrap_or(0);
            if before != 0 {
                emit(s, state, &triangles, ids, None, before, share);
            }
            todo &= !before;
            if off != 0 {
                let triangle = t + next as usize;
                careful(s, state, corners.of(triangle), screen, first_number + triangle, share);
                todo &= todo - 1;
                off &= off - 1;
            }
        }
        t += 16;
    }
}

/// The lanes with a vertex that is not on the raster.
#[inline(always)]
fn off_raster<S: Simd>(s: S, t: &Sixteen<S>) -> u64 {
    let off = i32x16::splat(s, OFF_RASTER);
    (t.x[0].simd_eq(off) | t.x[1].simd_eq(off) | t.x[2].simd_eq(off)).to_bitmask()
}

#[inline(always)]
fn lane_numbers<S: Simd>(s: S, step: i32) -> i32x16<S> {
    i32x16::simd_from(s, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]) * step
}

/// A triangle with a vertex off the raster: dropped, or clipped and set up.
#[inline(never)]
fn careful<S: Simd>(
    s: S,
    state: &SetupState<'_>,
    places: [usize; 3],
    screen: &[ScreenVertex],
    number: usize,
    share: &mut Share,
) {
    let Some((clipped, offset)) = clipped(state, places, screen, share) else { return };
    s.vectorize(
        #[inline(always)]
        || emit_clipped(s, state, &clipped, offset, number, share),
    );
}

/// What is left of a triangle with a vertex off the raster, and the offset of its depths. `None` if it is dropped or culled, or if nothing is left of it; which is
/// counted.
pub(crate) fn clipped(
    state: &SetupState<'_>,
    places: [usize; 3],
    screen: &[ScreenVertex],
    share: &mut Share,
) -> Option<(Clipped, f32)> {
    let vertices = places.map(|k| screen[k]);
    let codes = vertices.map(ScreenVertex::outcode);
    if (codes[0] | codes[1] | codes[2]) & outcode::NON_FINITE != 0 {
        share.statistics.non_finite += 1;
        return None;
    }
    if codes[0] & codes[1] & codes[2] != 0 {
        share.statistics.outside += 1;
        return None;
    }
    share.statistics.clipped += 1;
    let triangle = (state.vertices)(places);
    let Some(clipped) = clip(state.projection, &triangle, vertices) else {
        share.degenerate += u64::from(state.counts);
        return None;
    };
    if if clipped.is_clockwise { state.cull_clockwise } else { state.cull_counter_clockwise } {
        share.culled += u64::from(state.counts);
        return None;
    }
    let offset = state.bias.map_or(0.0, |bias| {
        let depths: Vec<f32> = clipped.triangles().as_flattened().iter().map(|v| v.z()).collect();
        bias.offset_of_clipped(state.projection, triangle.positions, &depths)
    });
    Some((clipped, offset))
}

#[inline(always)]
fn emit_clipped<S: Simd>(
    s: S,
    state: &SetupState<'_>,
    clipped: &Clipped,
    offset: f32,
    number: usize,
    share: &mut Share,
) {
    let code = if clipped.is_clockwise { CLIPPED_CLOCKWISE } else { CLIPPED_COUNTER_CLOCKWISE };
    let id = i32x16::splat(s, (TriangleId::first(number) | code) as i32);
    let triangles = Sixteen::from_triangles(s, clipped.triangles());
    emit(s, state, &triangles, id, Some(offset), (1 << clipped.triangles().len()) - 1, share);
}

/// Sets up those of sixteen triangles on the raster that `lanes` has bits for. `ids` hold order code 0, unless the triangles are
/// parts of a clipped one: then `clipped` is the offset of their depths.
#[inline(always)]
fn emit<S: Simd>(
    s: S,
    state: &SetupState<'_>,
    triangles: &Sixteen<S>,
    ids: i32x16<S>,
    clipped: Option<f32>,
    lanes: u64,
    share: &mut Share,
) {
    let Sixteen { x: [x0, x1, x2], y: [y0, y1, y2], z } = *triangles;
    let reach = Reach {
        min_x: x0.min(x1).min(x2),
        max_x: x0.max(x1).max(x2),
        min_y: y0.min(y1).min(y2),
        max_y: y0.max(y1).max(y2),
    };
    let asked = mask32x16::from_bitmask(s, lanes);
    let mut live = asked;
    if state.samples.samples.is_one() {
        // Before anything else: most of the smallest triangles miss all samples.
        live = live & reach.pixels(&state.rect, [0, 0]).has_any();
    }

    let is_large = reach.is_large();
    let counts = state.counts && clipped.is_none();
    let area = area_x2(s, triangles, is_large & if counts { asked } else { live });
    let counter_clockwise = area.simd_lt(0.0);
    let degenerate = area.simd_eq(0.0);
    if counts {
        let facing = (mask32x16::splat(s, state.cull_clockwise) & !counter_clockwise)
            | (mask32x16::splat(s, state.cull_counter_clockwise) & counter_clockwise);
        share.degenerate += u64::from((asked & degenerate).to_bitmask().count_ones());
        share.culled += u64::from((asked & facing & !degenerate).to_bitmask().count_ones());
    }
    live = live & !degenerate;
    if clipped.is_none() {
        if state.cull_clockwise {
            live = live & counter_clockwise;
        }
        if state.cull_counter_clockwise {
            live = live & !counter_clockwise;
        }
    }
    if live.all_false() {
        return;
    }

    let first_is_1 = before(y1, x1, y0, x0) & !before(y2, x2, y1, x1);
    let first_is_2 = before(y2, x2, y0, x0) & before(y2, x2, y1, x1);
    let order = CanonicalOrder { first_is_1, first_is_2, counter_clockwise };
    let x = order.apply(triangles.x);
    let y = order.apply(triangles.y);
    let z = order.apply([z[0].bitcast(), z[1].bitcast(), z[2].bitcast()]);
    let mut z: [f32x16<S>; 3] = [z[0].bitcast(), z[1].bitcast(), z[2].bitcast()];
    let ids = if clipped.is_some() { ids } else { ids + order.code(s) };

    let (ax, ay, bx, by) = (x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]);
    // The depth's plane, in 1/pixel. All differences are exact in f32.
    let scale = f32x16::splat(s, SUBPIXELS as f32) / area.abs();
    let (dz1, dz2) = (z[1] - z[0], z[2] - z[0]);
    let dz_dx = (dz1 * float(by) - dz2 * float(ay)) * scale;
    let dz_dy = (dz2 * float(ax) - dz1 * float(bx)) * scale;

    if let Some(bias) = state.bias {
        // A large triangle's plane comes later.
        let offset = match clipped {
            Some(offset) => f32x16::splat(s, offset),
            None => bias.offsets(s, z, dz_dx, dz_dy),
        };
        z[0] = is_large.select(z[0], z[0] + offset);
    }
    let mut rest = state.samples.mask;
    while let Some(sample) = state.samples.take(&mut rest) {
        let facts = Facts::new(ids, x, y, z, dz_dx, dz_dy, reach.pixels(&state.rect, sample.offset), sample);
        emit_sample(s, state, &facts, is_large, clipped, live & facts.pixels.has_any(), share);
    }
}

/// What the vertices of sixteen triangles reach, in subpixels.
#[derive(Clone, Copy)]
struct Reach<S: Simd> {
    min_x: i32x16<S>,
    max_x: i32x16<S>,
    min_y: i32x16<S>,
    max_y: i32x16<S>,
}

/// The first and the last pixel, across and down, whose sample a triangle may cover.
#[derive(Clone, Copy)]
struct Pixels<S: Simd> {
    column0: i32x16<S>,
    column1: i32x16<S>,
    row0: i32x16<S>,
    row1: i32x16<S>,
}

impl<S: Simd> Reach<S> {
    #[inline(always)]
    fn is_large(&self) -> mask32x16<S> {
        (self.max_x - self.min_x).simd_gt(MID_EXTENT) | (self.max_y - self.min_y).simd_gt(MID_EXTENT)
    }

    /// The first sample at or after the left border, the last before the right one: no sample on a right or a bottom border is covered, for
    /// such a border is no top or left edge.
    #[inline(always)]
    fn pixels(&self, rect: &PixelRect, [ox, oy]: [i32; 2]) -> Pixels<S> {
        Pixels {
            column0: ((self.min_x + (HALF_PIXEL - 1 - ox)) >> SUBPIXEL_BITS).max(rect.x0),
            column1: ((self.max_x - (HALF_PIXEL + 1 + ox)) >> SUBPIXEL_BITS).min(rect.x1 - 1),
            row0: ((self.min_y + (HALF_PIXEL - 1 - oy)) >> SUBPIXEL_BITS).max(rect.y0),
            row1: ((self.max_y - (HALF_PIXEL + 1 + oy)) >> SUBPIXEL_BITS).min(rect.y1 - 1),
        }
    }
}

impl<S: Simd> Pixels<S> {
    #[inline(always)]
    fn has_any(&self) -> mask32x16<S> {
        self.column0.simd_le(self.column1) & self.row0.simd_le(self.row1)
    }
}

/// Leaves the records of those of sixteen triangles that may cover a sample of some pixel: one sample of each pixel, always the same.
#[inline(always)]
fn emit_sample<S: Simd>(
    s: S,
    state: &SetupState<'_>,
    facts: &Facts<S>,
    is_large: mask32x16<S>,
    clipped: Option<f32>,
    live: mask32x16<S>,
    share: &mut Share,
) {
    let Pixels { column0, column1, row0, row1 } = facts.pixels;
    let (columns, rows) = (column1 - column0, row1 - row0);
    let is_small = columns.simd_lt(SMALL_EXTENT) & rows.simd_lt(SMALL_EXTENT) & live & !is_large;
    let mut small_rows = [[0; 8]; 16];
    let mut live_lanes = live.to_bitmask();
    let large_lanes = (is_large & live).to_bitmask();
    let mut small_lanes = is_small.to_bitmask();
    if small_lanes != 0 {
        let covering = small_records(s, facts, &mut small_rows);
        // Most of the smallest triangles lie between samples.
        live_lanes &= !small_lanes | covering;
        small_lanes &= covering;
    }
    let mid_lanes = live_lanes & !small_lanes & !large_lanes;
    let mut mid_rows = [[0; 16]; 16];
    if mid_lanes != 0 {
        mid_records(s, facts, &mut mid_rows);
    }
    let mut large_rows = [[0; 16]; 16];
    if large_lanes != 0 {
        large_records(s, facts, &mut large_rows);
    }

    let log2 = state.grid.log2;
    let tile_x0: [i32; 16] = (column0 >> log2).into();
    let tile_x1: [i32; 16] = (column1 >> log2).into();
    let tile_y0: [i32; 16] = (row0 >> log2).into();
    let tile_y1: [i32; 16] = (row1 >> log2).into();
    let mut rest = live_lanes;
    while rest != 0 {
        let lane = rest.trailing_zeros() as usize & 15;
        let bit = 1 << lane;
        rest &= rest - 1;
        let tiles = SampleBox { x0: tile_x0[lane], x1: tile_x1[lane], y0: tile_y0[lane], y1: tile_y1[lane] };
        if small_lanes & bit != 0 {
            let entry = BinEntry::new(Kind::Small, share.small.len());
            share.small.push(SmallTriangle(small_rows[lane]));
            bin(&mut share.bins, &state.grid, tiles, entry);
        } else if mid_lanes & bit != 0 {
            let entry = BinEntry::new(Kind::Mid, share.mid.len());
            share.mid.push(MidTriangle(mid_rows[lane]));
            bin(&mut share.bins, &state.grid, tiles, entry);
        } else {
            let entry = BinEntry::new(Kind::Large, share.large.len());
            let record = LargeTriangle(large_rows[lane]).with_precise_plane();
            let record = state.bias.map_or(record, |bias| record.with_bias(&bias, clipped));
            share.large.push(record);
            bin_large(&mut share.bins, &state.grid, tiles, entry, &record);
        }
    }
}

/// What is known of sixteen triangles when their records are made: vertices in canonical order, depth's plane, box of samples.
#[derive(Clone, Copy)]
struct Facts<S: Simd> {
    ids: i32x16<S>,
    x: [i32x16<S>; 3],
    y: [i32x16<S>; 3],
    z: [f32x16<S>; 3],
    dz_dx: f32x16<S>,
    dz_dy: f32x16<S>,
    pixels: Pixels<S>,
    edges: [Edge<S>; 3],
    plane: u32,
}

impl<S: Simd> Facts<S> {
    /// Of triangles on a raster that is moved, so that the sample lies where the pixel's centre would.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one call, inlined")]
    fn new(
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
fn small_records<S: Simd>(s: S, facts: &Facts<S>, out: &mut [[u32; 8]; 16]) -> u64 {
    s.vectorize(
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
fn mid_records<S: Simd>(s: S, facts: &Facts<S>, out: &mut [[u32; 16]; 16]) {
    s.vectorize(
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
fn large_records<S: Simd>(s: S, facts: &Facts<S>, out: &mut [[u32; 16]; 16]) {
    s.vectorize(
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

/// Twice the signed area, rounded once to f32, which keeps its sign and whether it is 0. i32 holds it for all but large triangles.
#[inline(always)]
fn area_x2<S: Simd>(s: S, t: &Sixteen<S>, large: mask32x16<S>) -> f32x16<S> {
    let (ax, ay) = (t.x[1] - t.x[0], t.y[1] - t.y[0]);
    let (bx, by) = (t.x[2] - t.x[0], t.y[2] - t.y[0]);
    let area: f32x16<S> = float(ax * by - bx * ay);
    if large.all_false() {
        return area;
    }
    let (p_low, p_high) = ax.widening_mul(by);
    let (q_low, q_high) = bx.widening_mul(ay);
    let low: [i64; 8] = (p_low - q_low).into();
    let high: [i64; 8] = (p_high - q_high).into();
    let mut exact = [0.0; 16];
    let mut k = 0;
    while k < 8 {
        exact[k] = low[k] as f32;
        exact[k + 8] = high[k] as f32;
        k += 1;
    }
    large.select(f32x16::simd_from(s, exact), area)
}

/// Whether (ya, xa) comes before (yb, xb).
#[inline(always)]
fn before<S: Simd>(ya: i32x16<S>, xa: i32x16<S>, yb: i32x16<S>, xb: i32x16<S>) -> mask32x16<S> {
    ya.simd_lt(yb) | (ya.simd_eq(yb) & xa.simd_lt(xb))
}

/// The permutation that brings vertices into canonical order; see [`TriangleId`].
#[derive(Clone, Copy)]
struct CanonicalOrder<S: Simd> {
    first_is_1: mask32x16<S>,
    first_is_2: mask32x16<S>,
    counter_clockwise: mask32x16<S>,
}

impl<S: Simd> CanonicalOrder<S> {
    #[inline(always)]
    fn apply(&self, [a, b, c]: [i32x16<S>; 3]) -> [i32x16<S>; 3] {
        let first = self.first_is_1.select(b, self.first_is_2.select(c, a));
        let second = self.first_is_1.select(c, self.first_is_2.select(a, b));
        let third = self.first_is_1.select(a, self.first_is_2.select(b, c));
        [first, self.counter_clockwise.select(third, second), self.counter_clockwise.select(second, third)]
    }

    #[inline(always)]
    fn code(&self, s: S) -> i32x16<S> {
        let none = i32x16::splat(s, 0);
        self.first_is_1.select(i32x16::splat(s, 1), none)
            + self.first_is_2.select(i32x16::splat(s, 2), none)
            + self.counter_clockwise.select(i32x16::splat(s, 3), none)
    }
}

/// An edge of each of sixteen triangles in canonical order: where it starts, and how far it goes.
#[derive(Clone, Copy)]
struct Edge<S: Simd> {
    x: i32x16<S>,
    y: i32x16<S>,
    dx: i32x16<S>,
    dy: i32x16<S>,
}

impl<S: Simd> Edge<S> {
    #[inline(always)]
    fn is_top_left(&self) -> mask32x16<S> {
        is_top_left(self.dx, self.dy)
    }

    /// The edge function with the fill rule at a sample, over 256, rounded down. Not negative where the sample is inside. From sample
    /// to sample the edge function changes by multiples of 256, so that nothing is lost. Fits i32 for triangles up to [`MID_EXTENT`].
    #[inline(always)]
    fn at(&self, x: i32x16<S>, y: i32x16<S>) -> i32x16<S> {
        let e = self.dx * (y - self.y) - self.dy * (x - self.x);
        self.is_top_left().select(e, e - 1) >> SUBPIXEL_BITS
    }

    /// What [`Self::at`] gains a pixel right, and a pixel down, as two i16.
    #[inline(always)]
    fn steps(&self) -> u32x16<S> {
        pack(-self.dy, self.dx)
    }
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

/// Two i16 in a word.
#[inline(always)]
fn pack<S: Simd>(low: i32x16<S>, high: i32x16<S>) -> u32x16<S> {
    ((low & 0xffff) | (high << 16)).bitcast()
}

#[inline(always)]
fn float<S: Simd>(v: i32x16<S>) -> f32x16<S> {
    v.to_float()
}
