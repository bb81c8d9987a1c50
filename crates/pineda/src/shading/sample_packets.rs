//! Which triangles multisampled pixels show: block by block, in packets that are shaded together.

use crate::pass::plan::Batch;
use crate::raster::triangle_id::TriangleId;
use crate::tile::Tile;
use crate::tile::view::TileView;
use crate::wide::{Simd, mask32x16, u32x16};

/// The fragments of one draw in a block.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct SamplePacket {
    /// The triangle of each lane.
    pub(crate) ids: [u32; 16],
    /// The run that these triangles belong to.
    pub(crate) run: u32,
    /// The first sample's block; or that of the only sample that they are of.
    pub(crate) block: u32,
    pub(crate) mask: u32,
    /// Lanes whose triangle all of the pixel's samples show.
    pub(crate) inner: u32,
    /// Whether these are the pixels' first triangles.
    pub(crate) is_first: bool,
}

impl SamplePacket {
    /// How many samples show these fragments.
    pub(crate) fn samples(&self, tile: &Tile, view: &TileView) -> u64 {
        let planes = (0..view.samples.count()).map(|sample| &tile.id[self.block as usize + view.plane(sample)]);
        let shows = |ids: &[u32; 16], lane: usize| self.mask >> lane & 1 != 0 && ids[lane] == self.ids[lane];
        planes.map(|ids| (0..16).filter(|&lane| shows(ids, lane)).count() as u64).sum()
    }
}

/// The blocks with something visible: a packet holds the first triangle of each pixel, the next packet of the block a second one, and so on.
#[inline(always)]
pub(crate) fn collect_visible<S: Simd>(
    s: S,
    batch: &Batch<'_>,
    is_by_sample: &dyn Fn(usize) -> bool,
    tile: &Tile,
    view: &TileView,
    out: &mut Vec<SamplePacket>,
) {
    let (blocks, samples) = (view.side / 4, view.samples.count());
    let mut by = 0;
    while by < blocks {
        let mut bx = 0;
        while bx < blocks {
            let block = view.block(bx, by);
            bx += 1;
            let first = u32x16::simd_from(s, tile.id[block]);
            let mut rest = [0; 16];
            let mut same = mask32x16::splat(s, true);
            let mut sample = 0;
            while sample < samples {
                let ids = u32x16::simd_from(s, tile.id[block + view.plane(sample)]);
                same = same & ids.simd_eq(first);
                rest[sample & 15] = ids.simd_gt(0).to_bitmask() as u32;
                sample += 1;
            }
            let inner = same.to_bitmask() as u32 & rest[0];
            let mut is_first = true;
            loop {
                let (mut ids, mut mask) = (u32x16::splat(s, 0), 0);
                let mut sample = 0;
                while sample < samples {
                    let new = rest[sample & 15] & !mask;
                    if new != 0 {
                        let own = u32x16::simd_from(s, tile.id[block + view.plane(sample)]);
                        ids = mask32x16::from_bitmask(s, u64::from(new)).select(own, ids);
                        mask |= new;
                    }
                    sample += 1;
                }
                if mask == 0 {
                    break;
                }
                let mut sample = 0;
                while sample < samples {
                    let own = u32x16::simd_from(s, tile.id[block + view.plane(sample)]);
                    rest[sample & 15] &= !(own.simd_eq(ids).to_bitmask() as u32);
                    sample += 1;
                }
                let packet = SamplePacket { ids: ids.into(), run: 0, block: block as u32, mask, inner, is_first };
                by_run(s, batch, is_by_sample, tile, view, &packet, out);
                is_first = false;
            }
        }
        by += 1;
    }
}

/// Adds a packet for each run that the lanes show; or one for each sample.
#[inline(always)]
fn by_run<S: Simd>(
    s: S,
    batch: &Batch<'_>,
    is_by_sample: &dyn Fn(usize) -> bool,
    tile: &Tile,
    view: &TileView,
    all: &SamplePacket,
    out: &mut Vec<SamplePacket>,
) {
    let ids = u32x16::simd_from(s, all.ids);
    let mut rest = all.mask;
    while rest != 0 {
        let (mut run, mut mask) = (0, rest);
        if batch.runs.len() > 1 {
            run = batch.run_of(TriangleId(all.ids[rest.trailing_zeros() as usize & 15]).number());
            let last = batch.runs[run].first_number + batch.runs[run].triangles;
            let first = TriangleId::first(batch.runs[run].first_number);
            mask &= (ids.simd_ge(first) & ids.simd_lt(TriangleId::first(last))).to_bitmask() as u32;
        }
        rest &= !mask;
        let packet = SamplePacket { run: run as u32, mask, ..*all };
        if !is_by_sample(run) {
            out.push(packet);
            continue;
        }
        let mut sample = 0;
        while sample < view.samples.count() {
            let block = all.block + view.plane(sample) as u32;
            let mask = u32x16::simd_from(s, tile.id[block as usize]).simd_eq(ids).to_bitmask() as u32 & mask;
            if mask != 0 {
                out.push(SamplePacket { block, mask, ..packet });
            }
            sample += 1;
        }
    }
}
