//! Large triangles: the tile, then windows of 16 x 16 samples, then blocks of 4 x 4, then samples.
//!
//! At each step an edge function is looked at where it is largest and where it is smallest: nowhere inside, and the piece is left out;
//! everywhere inside, and the edge is forgotten (its steps become 0). In a window, the sixteen blocks are the lanes; in
//! a block, the sixteen samples are (Abrash 2009, "Rasterization on Larrabee").

use super::sink::{DepthRange, Sink, Window};
use super::view::{BlockLanes, TileView};
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXEL_BITS, SUBPIXELS};
use crate::raster::reach::PixelRect;
use crate::raster::record::{DepthPlane, LargeTriangle, SampleBox};
use crate::wide::{Simd, f32x16, i32x16, mask32x16};

/// The side of a window in blocks, and in samples.
const WINDOW_BLOCKS: i32 = 4;
const WINDOW: i32 = 16;

/// Whether a window's samples are all farther is asked before so many of its blocks are drawn: the answer takes about as long as drawing three.
/// (`slivers` took 1.5 times as many instructions when it was asked always, and when windows were gone through one by one.)
const LOOK_FIRST: u32 = 3;

/// An edge function over 256, with the fill rule, as a function of the sample's column and row counted from some first sample.
/// Within a tile that the edge crosses, all of its values fit i32: see [`crate::geometry::raster_space`].
#[derive(Clone, Copy)]
struct Edge {
    first: i32,
    step_x: i32,
    step_y: i32,
}

impl Edge {
    /// An edge that everything is inside of.
    const PASSED: Self = Self { first: 0, step_x: 0, step_y: 0 };

    #[inline(always)]
    fn at(&self, column: i32, row: i32) -> i32 {
        self.first + self.step_x * column + self.step_y * row
    }

    /// The largest of a square's samples, the first of which is where the edge begins.
    #[inline(always)]
    fn largest(&self, side: i32) -> i32 {
        self.first + (self.step_x.max(0) + self.step_y.max(0)) * (side - 1)
    }
}

/// The three edges over `columns` x `rows` samples from raster point (x, y) on; `None` if no sample there can be inside.
#[inline(always)]
fn edges(t: &LargeTriangle, x: i32, y: i32, columns: i32, rows: i32) -> Option<[Edge; 3]> {
    let mut edges = [Edge::PASSED; 3];
    let mut k = 0;
    while k < 3 {
        let (a, b) = (t.vertex(k), t.vertex((k + 1) % 3));
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let bias = i64::from(t.0[12] >> k & 1) - 1;
        let first = (dx * (i64::from(y) - a.1) - dy * (i64::from(x) - a.0) + bias) >> SUBPIXEL_BITS;
        let (across, down) = (-dy * i64::from(columns - 1), dx * i64::from(rows - 1));
        if first + across.max(0) + down.max(0) < 0 {
            return None;
        }
        if first + across.min(0) + down.min(0) < 0 {
            debug_assert!(i32::try_from(first).is_ok(), "the edge crosses the tile");
            edges[k] = Edge { first: first as i32, step_x: -dy as i32, step_y: dx as i32 };
        }
        k += 1;
    }
    Some(edges)
}

/// Hands over the samples of a large triangle that lie in a tile.
#[inline(always)]
pub(crate) fn large<S: Simd, K: Sink<S>>(
    s: S,
    t: &LargeTriangle,
    view: &TileView,
    rect: Option<&PixelRect>,
    lanes: &BlockLanes<S>,
    sink: &mut K,
) {
    let plane = DepthPlane::unpack(&t.0);
    let (ax, ay) = t.vertex(0);
    // Distances of a sample from the anchor, in pixels: exact.
    let distance = |first: i32, anchor: i64| (first * SUBPIXELS + HALF_PIXEL - anchor as i32) as f32 / SUBPIXELS as f32;
    let sample = t.0[15] as usize;
    let first_block = view.plane(sample);
    if sink.hides_tile(s, sample, depth_range(&plane, distance(view.x, ax), distance(view.y, ay), view.side)) {
        return;
    }
    let samples = SampleBox::unpack(t.0[1], t.0[2]);
    let (x0, y0) = ((samples.x0 - view.x).max(0), (samples.y0 - view.y).max(0));
    let (x1, y1) = ((samples.x1 - view.x).min(view.side - 1), (samples.y1 - view.y).min(view.side - 1));
    let (wx0, wy0, wx1, wy1) = (x0 / WINDOW, y0 / WINDOW, x1 / WINDOW, y1 / WINDOW);
    let (px, py) = ((view.x + wx0 * WINDOW) * SUBPIXELS + HALF_PIXEL, (view.y + wy0 * WINDOW) * SUBPIXELS + HALF_PIXEL);
    let Some(edges) = edges(t, px, py, (wx1 - wx0 + 1) * WINDOW, (wy1 - wy0 + 1) * WINDOW) else { return };
    let is_inside_all = edges.iter().all(|e| e.step_x == 0 && e.step_y == 0);

    let (fx0, fy0) = (distance(view.x + wx0 * WINDOW, ax), distance(view.y + wy0 * WINDOW, ay));
    let blocks = BlockEdges::new(s, lanes, &edges);

    let mut windows = blocks.touched_windows(s, &edges) & blocks_within(wx0, wy0, wx0, wy0, wx1, wy1);
    while windows != 0 {
        let k = windows.trailing_zeros() as i32;
        windows &= windows - 1;
        let (wx, wy) = (wx0 + (k & 3), wy0 + (k >> 2));
        let (column, row) = ((k & 3) * WINDOW, (k >> 2) * WINDOW);
        let (fx, fy) = (fx0 + column as f32, fy0 + row as f32);
        let window = Window { sample, number: (wy * (view.side / WINDOW) + wx) as usize };
        let depths = depth_range(&plane, fx, fy, WINDOW);
        if sink.hides_window(window, depths) {
            continue;
        }
        let (wx_px, wy_px) = (wx * WINDOW, wy * WINDOW);
        let block = first_block + view.block(wx_px / 4, wy_px / 4);
        let is_whole =
            is_inside_all && x0 <= wx_px && x1 >= wx_px + WINDOW - 1 && y0 <= wy_px && y1 >= wy_px + WINDOW - 1;
        if is_whole {
            // In front of everything, as a layer over others is: no comparison, and nothing to be kept (6 % fewer instructions of full layers drawn back to front).
            if S::HAS_SHORTCUTS && sink.lets_all_pass(s, block, view.stride, depths) {
                whole_window::<S, K, true>(s, t.0[0], &plane, block, view.stride, fx, fy, lanes, sink);
            } else {
                whole_window::<S, K, false>(s, t.0[0], &plane, block, view.stride, fx, fy, lanes, sink);
            }
            sink.covered_window(window, depths);
            continue;
        }
        let mut candidates = blocks.touched(s, &edges, column, row);
        candidates &= blocks_within(wx_px / 4, wy_px / 4, x0 >> 2, y0 >> 2, x1 >> 2, y1 >> 2);
        if candidates.count_ones() >= LOOK_FIRST && sink.hides_blocks(s, block, view.stride, depths) {
            continue;
        }
        let window_edges = blocks.rows(&edges, column, row);
        while candidates != 0 {
            let k = candidates.trailing_zeros() as usize & 15;
            candidates &= candidates - 1;
            let (bx, by) = ((k & 3) as i32, (k >> 2) as i32);
            let mut outside = blocks.outside(&window_edges, k);
            if let Some(rect) = rect {
                outside = lanes.outside(rect, view.x + wx_px + 4 * bx, view.y + wy_px + 4 * by, outside);
            }
            let z = depths_at(lanes, &plane, fx + (4 * bx) as f32, fy + (4 * by) as f32);
            sink.samples(s, block + by as usize * view.stride + bx as usize, outside.simd_ge(0), z, t.0[0]);
        }
    }
}

/// The edge functions in the lanes: over a block's samples, and over a window's blocks.
#[derive(Clone, Copy)]
struct BlockEdges<S: Simd> {
    /// By how much a sample's edge function exceeds the one of its block's first sample.
    samples: [i32x16<S>; 3],
    /// By how much the largest edge function in a block exceeds the one of its window's first sample.
    largest: [i32x16<S>; 3],
}

impl<S: Simd> BlockEdges<S> {
    #[inline(always)]
    fn new(s: S, lanes: &BlockLanes<S>, edges: &[Edge; 3]) -> Self {
        let mut samples = [i32x16::splat(s, 0); 3];
        let mut largest = samples;
        let mut k = 0;
        while k < 3 {
            samples[k] = lanes.column * edges[k].step_x + lanes.row * edges[k].step_y;
            largest[k] = (samples[k] << 2) + (edges[k].step_x.max(0) * 3 + edges[k].step_y.max(0) * 3);
            k += 1;
        }
        Self { samples, largest }
    }

    /// A bit for each of sixteen windows, four in a row from where the edges begin, that may have a sample inside all edges taken one by one. What is beyond the tile may have any bit.
    #[inline(always)]
    fn touched_windows(&self, _: S, edges: &[Edge; 3]) -> u64 {
        let [a, b, c] = [edges[0].largest(WINDOW), edges[1].largest(WINDOW), edges[2].largest(WINDOW)];
        (((self.samples[0] << 4) + a) | ((self.samples[1] << 4) + b) | ((self.samples[2] << 4) + c))
            .simd_ge(0)
            .to_bitmask()
    }

    /// A bit for each of a window's blocks that has a sample inside all edges, taken one by one.
    #[inline(always)]
    fn touched(&self, _: S, edges: &[Edge; 3], column: i32, row: i32) -> u64 {
        let [a, b, c] = [edges[0].at(column, row), edges[1].at(column, row), edges[2].at(column, row)];
        ((self.largest[0] + a) | (self.largest[1] + b) | (self.largest[2] + c)).simd_ge(0).to_bitmask()
    }

    /// The edge functions at the first sample of each of a window's blocks.
    #[inline(always)]
    fn rows(&self, edges: &[Edge; 3], column: i32, row: i32) -> [[i32; 16]; 3] {
        [
            ((self.samples[0] << 2) + edges[0].at(column, row)).into(),
            ((self.samples[1] << 2) + edges[1].at(column, row)).into(),
            ((self.samples[2] << 2) + edges[2].at(column, row)).into(),
        ]
    }

    /// Negative for the samples of block `k` that are outside.
    #[inline(always)]
    fn outside(&self, rows: &[[i32; 16]; 3], k: usize) -> i32x16<S> {
        (self.samples[0] + rows[0][k]) | (self.samples[1] + rows[1][k]) | (self.samples[2] + rows[2][k])
    }
}

/// The nearest and the farthest depth of a square of samples, before clamping. Rounding is monotone: no sample's depth, computed by the same
/// operations, lies outside.
#[inline(always)]
fn depth_range(plane: &DepthPlane, fx: f32, fy: f32, side: i32) -> DepthRange {
    let last = (side - 1) as f32;
    let (left, right) = (fx * plane.dz_dx + plane.z0, (fx + last) * plane.dz_dx + plane.z0);
    let (top, bottom) = (fy * plane.dz_dy, (fy + last) * plane.dz_dy);
    DepthRange { nearest: left.min(right) + top.min(bottom), farthest: left.max(right) + top.max(bottom) }
}

#[inline(always)]
fn depths_at<S: Simd>(lanes: &BlockLanes<S>, plane: &DepthPlane, fx: f32, fy: f32) -> f32x16<S> {
    ((lanes.x + fx) * plane.dz_dx + plane.z0) + (lanes.y + fy) * plane.dz_dy
}

/// All sixteen blocks of a window, with the terms of its columns and rows computed once; if `PASSING`, all samples are sure to pass.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
fn whole_window<S: Simd, K: Sink<S>, const PASSING: bool>(
    s: S,
    id: u32,
    plane: &DepthPlane,
    first_block: usize,
    stride: usize,
    fx: f32,
    fy: f32,
    lanes: &BlockLanes<S>,
    sink: &mut K,
) {
    let x = lanes.x + fx;
    let columns = [
        x * plane.dz_dx + plane.z0,
        (x + 4.0) * plane.dz_dx + plane.z0,
        (x + 8.0) * plane.dz_dx + plane.z0,
        (x + 12.0) * plane.dz_dx + plane.z0,
    ];
    let mut block = first_block;
    let mut k = 0;
    while k < 4 {
        let row = (lanes.y + (fy + (4 * k) as f32)) * plane.dz_dy;
        one_of_window::<S, K, PASSING>(s, block, columns[0] + row, id, sink);
        one_of_window::<S, K, PASSING>(s, block + 1, columns[1] + row, id, sink);
        one_of_window::<S, K, PASSING>(s, block + 2, columns[2] + row, id, sink);
        one_of_window::<S, K, PASSING>(s, block + 3, columns[3] + row, id, sink);
        block += stride;
        k += 1;
    }
}

#[inline(always)]
fn one_of_window<S: Simd, K: Sink<S>, const PASSING: bool>(s: S, block: usize, z: f32x16<S>, id: u32, sink: &mut K) {
    if PASSING {
        sink.passing(s, block, z, id);
    } else {
        sink.samples(s, block, mask32x16::splat(s, true), z, id);
    }
}

/// A bit for each block of the window from block (bx, by) on that lies within (x0, y0) to (x1, y1), in blocks, both inclusive.
#[inline(always)]
pub(crate) fn blocks_within(bx: i32, by: i32, x0: i32, y0: i32, x1: i32, y1: i32) -> u64 {
    let (left, right) = ((x0 - bx).max(0), (x1 - bx).min(WINDOW_BLOCKS - 1));
    let (top, bottom) = ((y0 - by).max(0), (y1 - by).min(WINDOW_BLOCKS - 1));
    let columns = ((2u64 << right) - 1) & !((1u64 << left) - 1);
    let rows = ((0x10u64 << (4 * bottom)) - 1) & !((1u64 << (4 * top)) - 1);
    (columns * 0x1111) & rows
}
