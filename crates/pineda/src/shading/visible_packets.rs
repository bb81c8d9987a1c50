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
    let mut by = 0;
    while by < blocks {
        let mut bx = 0;
        while bx < blocks {
            let block = view.block(bx, by);
            let ids = u32x16::simd_from(s, tile.id[block]);
            let mut rest = ids.simd_gt(0).to_bitmask() as u32;
            while rest != 0 {
                let mut run = 0;
                let mut mask = rest;
                if batch.runs.len() > 1 {
                    let id = TriangleId(tile.id[block][rest.trailing_zeros() as usize & 15]);
                    run = batch.run_of(id.number());
                    let last = batch.runs[run].first_number + batch.runs[run].triangles;
                    let first = TriangleId::first(batch.runs[run].first_number);
                    mask &= (ids.simd_ge(first) & ids.simd_lt(TriangleId::first(last))).to_bitmask() as u32;
                }
                let (x, y) = (view.x + 4 * bx, view.y + 4 * by);
                out.push(VisiblePacket { run: run as u32, block: block as u32, mask, x, y });
                rest &= !mask;
            }
            bx += 1;
        }
        by += 1;
    }
}
