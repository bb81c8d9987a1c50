//! Which tiles triangles may touch, by their boxes, of sixteen triangles at once.

use super::bins::{BinEntry, TileGrid, bin};
use super::reach::Pixels;
use super::record::SampleBox;
use crate::wide::Simd;

/// The tiles that sixteen triangles may touch.
pub(super) struct TileBoxes {
    x0: [i32; 16],
    x1: [i32; 16],
    y0: [i32; 16],
    y1: [i32; 16],
    /// The number of each one's first tile.
    first: [i32; 16],
    /// A bit for each that has no other.
    single: u64,
}

impl TileBoxes {
    #[inline(always)]
    pub(super) fn of<S: Simd>(grid: &TileGrid, pixels: &Pixels<S>) -> Self {
        let (x0, x1) = (pixels.column0 >> grid.log2, pixels.column1 >> grid.log2);
        let (y0, y1) = (pixels.row0 >> grid.log2, pixels.row1 >> grid.log2);
        Self {
            x0: x0.into(),
            x1: x1.into(),
            y0: y0.into(),
            y1: y1.into(),
            first: (y0 * grid.columns as i32 + x0).into(),
            single: (x0.simd_eq(x1) & y0.simd_eq(y1)).to_bitmask(),
        }
    }

    #[inline(always)]
    pub(super) fn of_lane(&self, lane: usize) -> SampleBox {
        SampleBox { x0: self.x0[lane], x1: self.x1[lane], y0: self.y0[lane], y1: self.y1[lane] }
    }

    /// Enters the record of a triangle into every tile that it may touch: mostly one, which takes half as many instructions by itself.
    #[inline(always)]
    pub(super) fn enter(&self, bins: &mut [Vec<BinEntry>], grid: &TileGrid, lane: usize, entry: BinEntry) {
        if self.single >> lane & 1 != 0 {
            bins[self.first[lane] as usize].push(entry);
        } else {
            bin(bins, grid, self.of_lane(lane), entry);
        }
    }
}
