//! Which triangles pixels with one sample show: block by block, in packets that are shaded together.

use crate::pass::plan::Batch;
use crate::raster::triangle_id::TriangleId;
use crate::tile::Tile;
use crate::tile::view::TileView;
use crate::wide::{Simd, u32x16};

/// The samples of a block that show triangles of one draw.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VisiblePacket {
    /// The run that these triangles belong to.
    pub(crate) run: u32,
    pub(crate) block: u32,
    pub(crate) mask: u32,
    /// The triangle, if all of them show the same; or 0.
    pub(crate) id: u32,
    /// The block's first pixel.
    pub(crate) x: i32,
    pub(crate) y: i32,
}

/// The blocks with something visible, and of which run; a block that shows several runs comes several times.
#[inline(always)]
pub(crate) fn collect_visible<S: Simd>(
    s: S,
    batch: &Batch<'_>,
    tile: &Tile,
    view: &TileView,
    out: &mut Vec<VisiblePacket>,
) {
    let blocks = view.side / 4;
    out.reserve((blocks * blocks) as usize);
    // The last packet, which tells of which run its triangle is.
    let mut last = VisiblePacket { run: 0, block: 0, mask: 0, id: 0, x: 0, y: 0 };
    let mut by = 0;
    while by < blocks {
        let mut bx = 0;
        while bx < blocks {
            let (block, x, y) = (view.block(bx, by), view.x + 4 * bx, view.y + 4 * by);
            bx += 1;
            let ids = u32x16::simd_from(s, tile.id[block]);
            if last.id != 0 && ids.simd_eq(last.id).to_bitmask() == 0xffff {
                out.push(VisiblePacket { block: block as u32, mask: 0xffff, x, y, ..last });
                continue;
            }
            let mut rest = ids.simd_gt(0).to_bitmask() as u32;
            while rest != 0 {
                let first = tile.id[block][rest.trailing_zeros() as usize & 15];
                let mut run = 0;
                let mut mask = rest;
                if batch.runs.len() > 1 {
                    run = batch.run_of(TriangleId(first).number());
                    let last = batch.runs[run].first_number + batch.runs[run].triangles;
                    let first = TriangleId::first(batch.runs[run].first_number);
                    mask &= (ids.simd_ge(first) & ids.simd_lt(TriangleId::first(last))).to_bitmask() as u32;
                }
                let is_one = mask & !(ids.simd_eq(first).to_bitmask() as u32) == 0;
                let id = if is_one { first } else { 0 };
                last = VisiblePacket { run: run as u32, block: block as u32, mask, id, x, y };
                out.push(last);
                rest &= !mask;
            }
        }
        by += 1;
    }
}
