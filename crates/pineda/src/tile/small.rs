//! Small triangles: setup has their coverage; what is left is the depth.

use super::sink::Sink;
use super::view::{BlockLanes, TileView};
use crate::geometry::raster_space::SUBPIXELS;
use crate::raster::record::SmallTriangle;
use crate::wide::{Simd, f32x16, mask32x16};

/// Hands over the samples of a small triangle: those of one block mostly, of four at the most.
#[inline(always)]
pub(crate) fn small<S: Simd, K: Sink<S>>(
    s: S,
    t: &SmallTriangle,
    view: &TileView,
    lanes: &BlockLanes<S>,
    sink: &mut K,
) {
    let [id, _, left, right, z0, dz_dx, dz_dy, anchor] = t.0;
    let (x, y, plane) = t.place();
    let block = view.plane(plane) + view.block(x - (view.x >> 2), y - (view.y >> 2));
    // Integer sums and a power of two: all exact.
    let fx: f32x16<S> = ((lanes.column << 8) + i32::from(anchor as i16)).to_float();
    let fy: f32x16<S> = ((lanes.row << 8) + (anchor as i32 >> 16)).to_float();
    let (fx, fy) = (fx * (1.0 / SUBPIXELS as f32), fy * (1.0 / SUBPIXELS as f32));
    let (z0, dz_dx, dz_dy) = (f32::from_bits(z0), f32::from_bits(dz_dx), f32::from_bits(dz_dy));
    let z_left = fx * dz_dx + z0;
    let z_upper = fy * dz_dy;
    if left & 0xffff != 0 {
        sink.samples(s, block, mask32x16::from_bitmask(s, u64::from(left & 0xffff)), z_left + z_upper, id);
    }
    if left >> 16 != 0 {
        let z_lower = (fy + 4.0) * dz_dy;
        sink.samples(s, block + view.stride, mask32x16::from_bitmask(s, u64::from(left >> 16)), z_left + z_lower, id);
    }
    if right != 0 {
        let z_right = (fx + 4.0) * dz_dx + z0;
        if right & 0xffff != 0 {
            let inside = mask32x16::from_bitmask(s, u64::from(right & 0xffff));
            sink.samples(s, block + 1, inside, z_right + z_upper, id);
        }
        if right >> 16 != 0 {
            let z_lower = (fy + 4.0) * dz_dy;
            let inside = mask32x16::from_bitmask(s, u64::from(right >> 16));
            sink.samples(s, block + view.stride + 1, inside, z_right + z_lower, id);
        }
    }
}
