//! Setup: sixteen triangles at a time, from snapped vertices to records in bins.
//!
//! For each triangle, in the lanes: its box of samples, its signed area, culling, the canonical order of its vertices, its depth's
//! plane, and, by its size, its coverage mask (small) or its edge functions (mid). Then, one after the other in submission order, its
//! record and its bins.

use super::bins::{BinEntry, Kind, Share, TileGrid, bin_large};
use super::canonical_order::CanonicalOrder;
use super::corners::{Corners, Sixteen};
use super::depth_bias::Bias;
use super::edge::area_x2;
use super::make_records::{Facts, large_records, mid_records, small_records};
use super::reach::{PixelRect, Pixels, Reach};
use super::record::{LargeTriangle, MidTriangle, SMALL_EXTENT, SmallTriangle};
use super::samples::SampleSet;
use super::tile_boxes::TileBoxes;
use super::triangle_id::{CLIPPED_CLOCKWISE, CLIPPED_COUNTER_CLOCKWISE, ORDER_BITS, TriangleId};
use crate::geometry::clip::{ClipTriangle, Clipped, clip};
use crate::geometry::project::{Projection, outcode};
use crate::geometry::raster_space::{OFF_RASTER, SUBPIXELS, ScreenVertex};
use crate::wide::{Simd, f32x16, i32x16, mask32x16};

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
    s.apart(
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
    let vertices = [screen[places[0]], screen[places[1]], screen[places[2]]];
    let codes = [vertices[0].outcode(), vertices[1].outcode(), vertices[2].outcode()];
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
    let reach = Reach::of(triangles.x, triangles.y);
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

    let order = CanonicalOrder::of(triangles.x, triangles.y, counter_clockwise);
    let x = order.apply(triangles.x);
    let y = order.apply(triangles.y);
    let [z0, z1, z2] = triangles.z;
    let z = order.apply([z0.bitcast(), z1.bitcast(), z2.bitcast()]);
    let mut z: [f32x16<S>; 3] = [z[0].bitcast(), z[1].bitcast(), z[2].bitcast()];
    let ids = if clipped.is_some() { ids } else { ids + order.code(s) };

    let (ax, ay, bx, by) = (x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]);
    // The depth's plane, in 1/pixel. All differences are exact in f32.
    let scale = f32x16::splat(s, SUBPIXELS as f32) / area.abs();
    let (dz1, dz2) = (z[1] - z[0], z[2] - z[0]);
    let dz_dx = (dz1 * by.to_float() - dz2 * ay.to_float()) * scale;
    let dz_dy = (dz2 * ax.to_float() - dz1 * bx.to_float()) * scale;

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
    let tiles = TileBoxes::of(&state.grid, &facts.pixels);
    if live_lanes == small_lanes {
        // Where triangles are small, mostly: no room is made for records of the other kinds.
        while small_lanes != 0 {
            let lane = small_lanes.trailing_zeros() as usize & 15;
            small_lanes &= small_lanes - 1;
            push_small(share, &state.grid, &tiles, lane, small_rows[lane]);
        }
        return;
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
    let mut rest = live_lanes;
    while rest != 0 {
        let lane = rest.trailing_zeros() as usize & 15;
        let bit = 1 << lane;
        rest &= rest - 1;
        if small_lanes & bit != 0 {
            push_small(share, &state.grid, &tiles, lane, small_rows[lane]);
        } else if mid_lanes & bit != 0 {
            let entry = BinEntry::new(Kind::Mid, share.mid.len());
            share.mid.push(MidTriangle(mid_rows[lane]));
            tiles.enter(&mut share.bins, &state.grid, lane, entry);
        } else {
            let entry = BinEntry::new(Kind::Large, share.large.len());
            let record = LargeTriangle(large_rows[lane]).with_precise_plane();
            let record = state.bias.map_or(record, |bias| record.with_bias(&bias, clipped));
            share.large.push(record);
            bin_large(&mut share.bins, &state.grid, tiles.of_lane(lane), entry, &record);
        }
    }
}

#[inline(always)]
fn push_small(share: &mut Share, grid: &TileGrid, tiles: &TileBoxes, lane: usize, record: [u32; 8]) {
    let entry = BinEntry::new(Kind::Small, share.small.len());
    share.small.push(SmallTriangle(record));
    tiles.enter(&mut share.bins, grid, lane, entry);
}
