//! Small triangles: setup has their coverage; what is left is the depth.

use super::sink::Sink;
use super::view::{BlockLanes, TileView};
use crate::geometry::raster_space::SUBPIXELS;
use crate::raster::bins::BinEntry;
use crate::raster::record::SmallTriangle;
use crate::wide::{Simd, f32x16, mask32x16};

/// So many records are fetched one right after the other, before any of them is used. A bin's records lie apart, and what is done with one takes so many instructions that the processor
/// reaches the next few only while it waits for memory (`micro`: 1.04).
const AT_ONCE: usize = 32;

/// Hands over the samples of small triangles, one after the other: those of one block mostly, of four at the most.
///
/// A function of its own, because among those of other kinds there are too few registers for what stays the same from one triangle to the next (a quarter fewer instructions for the coverage of `micro`).
#[inline(never)]
pub(crate) fn small<S: Simd, K: Sink<S>>(
    s: S,
    triangles: &[SmallTriangle],
    entries: &[BinEntry],
    view: &TileView,
    sink: &mut K,
) {
    s.apart(
        #[inline(always)]
        || {
            let lanes = BlockLanes::new(s);
            let (stride, first_block) = (view.stride, view.first_block());
            let mut near = [SmallTriangle([0; 8]); AT_ONCE];
            for some in entries.chunks(AT_ONCE) {
                let mut i = 0;
                while i < some.len() {
                    near[i] = triangles[some[i].index()];
                    i += 1;
                }
                i = 0;
                while i < some.len() {
                    let t = &near[i];
                    let (x, y, plane) = t.place();
                    let block = first_block.wrapping_add(x + y * stride) + view.plane(plane);
                    one(s, t, block, stride, &lanes, sink);
                    i += 1;
                }
            }
        },
    );
}

#[inline(always)]
fn one<S: Simd, K: Sink<S>>(s: S, t: &SmallTriangle, block: usize, stride: usize, lanes: &BlockLanes<S>, sink: &mut K) {
    let [id, _, left, right, z0, dz_dx, dz_dy, anchor] = t.0;
    // Sixteen bits of subpixels and a pixel's number below four: all exact.
    let (anchor_x, anchor_y) = (f32::from(anchor as i16), f32::from((anchor >> 16) as i16));
    let (fx, fy) = (lanes.x + anchor_x * (1.0 / SUBPIXELS as f32), lanes.y + anchor_y * (1.0 / SUBPIXELS as f32));
    let (z0, dz_dx, dz_dy) = (f32::from_bits(z0), f32::from_bits(dz_dx), f32::from_bits(dz_dy));
    let z_left = fx * dz_dx + z0;
    let z_upper = fy * dz_dy;
    if left & 0xffff != 0 {
        sink.samples(s, block, mask32x16::from_bitmask(s, u64::from(left & 0xffff)), z_left + z_upper, id);
    }
    if left >> 16 != 0 {
        let z_lower = (fy + 4.0) * dz_dy;
        sink.samples(s, block + stride, mask32x16::from_bitmask(s, u64::from(left >> 16)), z_left + z_lower, id);
    }
    if right != 0 {
        let z_right: f32x16<S> = (fx + 4.0) * dz_dx + z0;
        if right & 0xffff != 0 {
            let inside = mask32x16::from_bitmask(s, u64::from(right & 0xffff));
            sink.samples(s, block + 1, inside, z_right + z_upper, id);
        }
        if right >> 16 != 0 {
            let z_lower = (fy + 4.0) * dz_dy;
            let inside = mask32x16::from_bitmask(s, u64::from(right >> 16));
            sink.samples(s, block + stride + 1, inside, z_right + z_lower, id);
        }
    }
}
