//! Mid-sized triangles: blocks of several triangles go through one worklist.
//!
//! Phase A takes a triangle, window by window, and appends the blocks that no edge rules out to the worklist: their edge functions and
//! distances, packed by `compress`. Phase B is one flat loop over the worklist. Most of these triangles have a handful
//! of blocks; the loop over all of them is predicted far better than a short loop each.

use super::large::blocks_within;
use super::sink::Sink;
use super::view::{BlockLanes, TileView};
use crate::geometry::raster_space::SUBPIXELS;
use crate::raster::reach::PixelRect;
use crate::raster::record::{DepthPlane, MidTriangle, SampleBox};
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};

/// The worklist is flushed when it holds more blocks than this.
const FULL: usize = 240;
/// A triangle appends at most the blocks of a 64-pixel tile; a vector is stored from the last place on.
const CAPACITY: usize = FULL + 256 + 16;
/// Triangles whose blocks wait at a time.
const TRIANGLES: usize = 128;

/// What phase B needs of a triangle.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
struct Waiting {
    /// By how much a sample's edge function exceeds the one of its block's first sample.
    samples: [[i32; 16]; 3],
    z0: f32,
    dz_dx: f32,
    dz_dy: f32,
    id: u32,
}

/// Blocks that wait for phase B, field by field.
#[derive(Debug)]
pub(crate) struct Worklist {
    blocks: usize,
    triangles: usize,
    place: Box<[u32; CAPACITY]>,
    triangle: Box<[u32; CAPACITY]>,
    /// Edge functions at the block's first sample.
    edges: Box<[[i32; CAPACITY]; 3]>,
    /// Distances of the block's first sample from the anchor, in pixels.
    fx: Box<[f32; CAPACITY]>,
    fy: Box<[f32; CAPACITY]>,
    waiting: Vec<Waiting>,
}

impl Default for Worklist {
    fn default() -> Self {
        Self {
            blocks: 0,
            triangles: 0,
            place: Box::new([0; CAPACITY]),
            triangle: Box::new([0; CAPACITY]),
            edges: Box::new([[0; CAPACITY]; 3]),
            fx: Box::new([0.0; CAPACITY]),
            fy: Box::new([0.0; CAPACITY]),
            waiting: vec![Waiting::default(); TRIANGLES],
        }
    }
}

/// Phase A for one triangle; flushes when the worklist is full.
#[inline(always)]
pub(crate) fn mid<S: Simd, K: Sink<S>>(
    s: S,
    t: &MidTriangle,
    view: &TileView,
    rect: Option<&PixelRect>,
    lanes: &BlockLanes<S>,
    work: &mut Worklist,
    sink: &mut K,
) {
    let samples = SampleBox::unpack(t.0[1], t.0[2]);
    // In blocks: the triangle's first, the tile's first, and the part of the box that lies in the tile.
    let (first_x, first_y) = (samples.x0 >> 2, samples.y0 >> 2);
    let (tile_x, tile_y) = (view.x >> 2, view.y >> 2);
    let (x0, y0) = ((first_x - tile_x).max(0), (first_y - tile_y).max(0));
    let x1 = (samples.x1 - view.x).min(view.side - 1) >> 2;
    let y1 = (samples.y1 - view.y).min(view.side - 1) >> 2;
    let (column, row) = ((x0 + tile_x - first_x) * 4, (y0 + tile_y - first_y) * 4);

    let steps = [steps(t.0[11]), steps(t.0[12]), steps(t.0[13])];
    let DepthPlane { z0, dz_dx, dz_dy } = DepthPlane::unpack(&t.0);
    let mut waiting = Waiting { samples: [[0; 16]; 3], z0, dz_dx, dz_dy, id: t.0[0] };
    // Over the blocks of the first window: edge functions at their first samples, and by how much they grow at most from there.
    let mut edges = [i32x16::splat(s, 0); 3];
    let mut growth = [0; 3];
    let mut k = 0;
    while k < 3 {
        let (step_x, step_y) = steps[k];
        let samples = lanes.column * step_x + lanes.row * step_y;
        waiting.samples[k] = samples.into();
        edges[k] = (samples << 2) + (t.0[8 + k] as i32 + step_x * column + step_y * row);
        growth[k] = step_x.max(0) * 3 + step_y.max(0) * 3;
        k += 1;
    }
    let number = work.triangles & (TRIANGLES - 1);
    work.waiting[number] = waiting;
    work.triangles = number + 1;
    let number = u32x16::splat(s, number as u32);

    let distance = |word: usize, pixels: i32| (t.0[word] as i32 + pixels * SUBPIXELS) as f32 / SUBPIXELS as f32;
    let fx = lanes.x * 4.0 + distance(6, column);
    let fy = lanes.y * 4.0 + distance(7, row);
    let place: u32x16<S> = (lanes.column + lanes.row * view.stride as i32).bitcast();
    let place = place + view.plane(t.0[14] as usize) as u32;

    let mut at = work.blocks;
    let mut by = y0;
    while by <= y1 {
        let dy = (by - y0) * 4;
        let mut bx = x0;
        while bx <= x1 {
            let dx = (bx - x0) * 4;
            let e0 = edges[0] + (steps[0].0 * dx + steps[0].1 * dy);
            let e1 = edges[1] + (steps[1].0 * dx + steps[1].1 * dy);
            let e2 = edges[2] + (steps[2].0 * dx + steps[2].1 * dy);
            let touched = ((e0 + growth[0]) | (e1 + growth[1]) | (e2 + growth[2])).simd_ge(0);
            let touched = touched & mask32x16::from_bitmask(s, blocks_within(bx, by, x0, y0, x1, y1));
            let here = at & 511;
            number.store_slice(&mut work.triangle[here..here + 16]);
            (place + view.block(bx, by) as u32).compress(touched).store_slice(&mut work.place[here..here + 16]);
            e0.compress(touched).store_slice(&mut work.edges[0][here..here + 16]);
            e1.compress(touched).store_slice(&mut work.edges[1][here..here + 16]);
            e2.compress(touched).store_slice(&mut work.edges[2][here..here + 16]);
            (fx + dx as f32).compress(touched).store_slice(&mut work.fx[here..here + 16]);
            (fy + dy as f32).compress(touched).store_slice(&mut work.fy[here..here + 16]);
            at += touched.to_bitmask().count_ones() as usize;
            bx += 4;
        }
        by += 4;
    }
    work.blocks = at;
    if at > FULL || work.triangles == TRIANGLES {
        flush(s, view, rect, lanes, work, sink);
    }
}

/// Phase B: all waiting blocks, in order.
#[inline(always)]
pub(crate) fn flush<S: Simd, K: Sink<S>>(
    s: S,
    view: &TileView,
    rect: Option<&PixelRect>,
    lanes: &BlockLanes<S>,
    work: &mut Worklist,
    sink: &mut K,
) {
    let mut i = 0;
    let count = work.blocks.min(CAPACITY);
    while i < count {
        let t = &work.waiting[work.triangle[i] as usize & (TRIANGLES - 1)];
        let e0 = i32x16::simd_from(s, t.samples[0]) + work.edges[0][i];
        let e1 = i32x16::simd_from(s, t.samples[1]) + work.edges[1][i];
        let e2 = i32x16::simd_from(s, t.samples[2]) + work.edges[2][i];
        let mut outside = e0 | e1 | e2;
        let block = work.place[i] as usize;
        if let Some(rect) = rect {
            let (x, y) = view.pixel_of(block);
            outside = lanes.outside(rect, x, y, outside);
        }
        let z: f32x16<S> = ((lanes.x + work.fx[i]) * t.dz_dx + t.z0) + (lanes.y + work.fy[i]) * t.dz_dy;
        sink.samples(s, block, outside.simd_ge(0), z, t.id);
        i += 1;
    }
    work.blocks = 0;
    work.triangles = 0;
}

/// What an edge function over 256 gains a pixel right, and a pixel down.
#[inline(always)]
fn steps(packed: u32) -> (i32, i32) {
    (i32::from(packed as i16), packed as i32 >> 16)
}
