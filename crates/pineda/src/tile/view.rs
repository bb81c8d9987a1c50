//! Where a tile lies, and how its blocks are numbered.

use crate::geometry::raster_space::SUBPIXEL_BITS;
use crate::raster::reach::PixelRect;
use crate::raster::samples::Samples;
use crate::wide::{Simd, f32x16, i32x16, u32x16};

/// A tile's place in the picture and the shape of its buffers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileView {
    /// Its first pixel.
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// Its side in pixels.
    pub(crate) side: i32,
    /// Blocks from one row to the next, borders included.
    pub(crate) stride: usize,
    /// Blocks of the tile with its border: a plane of one sample of each pixel.
    pub(crate) plane_blocks: usize,
    pub(crate) samples: Samples,
}

impl TileView {
    pub(crate) fn new(column: u32, row: u32, log2: u32, samples: Samples) -> Self {
        let side = 1 << log2;
        let stride = side as usize / 4 + 2;
        Self { x: column as i32 * side, y: row as i32 * side, side, stride, plane_blocks: stride * stride, samples }
    }

    /// Blocks of all samples.
    pub(crate) fn block_count(&self) -> usize {
        self.plane_blocks * self.samples.count()
    }

    /// The number of the first block of a sample's plane.
    #[inline(always)]
    pub(crate) fn plane(&self, sample: usize) -> usize {
        sample * self.plane_blocks
    }

    /// The sample that a block is of.
    #[inline(always)]
    pub(crate) fn sample_of(&self, block: usize) -> usize {
        block / self.plane_blocks
    }

    /// The number of block (x, y) in the plane of sample 0, where (0, 0) is the tile's first and -1 is the border's.
    #[inline(always)]
    pub(crate) fn block(&self, x: i32, y: i32) -> usize {
        (y + 1) as usize * self.stride + (x + 1) as usize
    }

    /// The number that the picture's first block would have, as far from this tile's as it is; wrapped around.
    #[inline(always)]
    pub(crate) fn first_block(&self) -> usize {
        let (x, y) = ((self.x >> 2) as usize, (self.y >> 2) as usize);
        (self.stride + 1).wrapping_sub(y * self.stride + x)
    }

    /// Whether a block belongs to the border, where nothing counts.
    #[inline(always)]
    pub(crate) fn is_border(&self, block: usize) -> bool {
        let block = block % self.plane_blocks;
        let (x, y) = (block % self.stride, block / self.stride);
        x == 0 || y == 0 || x == self.stride - 1 || y == self.stride - 1
    }

    /// The first pixel of a block.
    #[inline(always)]
    pub(crate) fn pixel_of(&self, block: usize) -> (i32, i32) {
        let block = block % self.plane_blocks;
        let (x, y) = ((block % self.stride) as i32 - 1, (block / self.stride) as i32 - 1);
        (self.x + 4 * x, self.y + 4 * y)
    }

    /// The first pixels of sixteen blocks of a tile with one sample a pixel.
    #[inline(always)]
    pub(crate) fn pixels_of<S: Simd>(&self, blocks: u32x16<S>) -> (i32x16<S>, i32x16<S>) {
        // A tile has fewer than 2^9 blocks, in rows of less than 2^5: a product with the inverse, rounded up, exceeds 2^16 times the quotient by less than 2^9, and so its fraction
        // by less than 1 / stride.
        let stride = self.stride as u32;
        let rows = (blocks * ((1 << 16) / stride + 1)) >> 16;
        let columns = blocks.bitcast::<i32x16<S>>() - rows.bitcast::<i32x16<S>>() * stride as i32;
        ((columns << 2) + (self.x - 4), (rows.bitcast::<i32x16<S>>() << 2) + (self.y - 4))
    }
}

/// Where the fragments of a block lie, in subpixels from its first pixel's centre.
#[derive(Clone, Copy)]
pub(crate) struct Positions<S: Simd> {
    pub(crate) x: i32x16<S>,
    pub(crate) y: i32x16<S>,
}

impl<S: Simd> Positions<S> {
    /// Pixels' centres, or, if they are moved, by so much off them.
    #[inline(always)]
    pub(crate) fn new(s: S, lanes: &BlockLanes<S>, moved: Option<&[[i32; 16]; 2]>) -> Self {
        let mut this = Self { x: lanes.column << SUBPIXEL_BITS, y: lanes.row << SUBPIXEL_BITS };
        if let Some([x, y]) = moved {
            this.x = this.x + i32x16::simd_from(s, *x);
            this.y = this.y + i32x16::simd_from(s, *y);
        }
        this
    }
}

/// The columns and rows of a block's samples, lane by lane: lane 4 j + i is sample (i, j).
#[derive(Clone, Copy)]
pub(crate) struct BlockLanes<S: Simd> {
    pub(crate) column: i32x16<S>,
    pub(crate) row: i32x16<S>,
    pub(crate) x: f32x16<S>,
    pub(crate) y: f32x16<S>,
}

impl<S: Simd> BlockLanes<S> {
    #[inline(always)]
    pub(crate) fn new(s: S) -> Self {
        let column = i32x16::simd_from(s, [0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3]);
        let row = i32x16::simd_from(s, [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3]);
        Self { column, row, x: column.to_float(), y: row.to_float() }
    }

    /// Negative for the samples of the block at pixel (x, y) that are negative in `outside`, or beyond a rectangle.
    ///
    /// Numbers, not masks: with AVX2, masks that come out of a branch are packed into half of a register and unpacked again, a fifth of the coverage kernels' instructions.
    #[inline(always)]
    pub(crate) fn outside(&self, rect: &PixelRect, x: i32, y: i32, outside: i32x16<S>) -> i32x16<S> {
        let columns = (self.column + (x - rect.x0)) | (-self.column + (rect.x1 - 1 - x));
        let rows = (self.row + (y - rect.y0)) | (-self.row + (rect.y1 - 1 - y));
        outside | columns | rows
    }
}
