//! What setup leaves of a triangle: three kinds of records, by the size of its box.
//!
//! Records are rows of 32-bit words, so that setup can build sixteen at once and turn them round with shuffles. All of
//! them hold the depth's plane, anchored at the first vertex in canonical order: `z = (z0 + dz_dx fx) + dz_dy fy`, where fx and fy
//! are the sample's distances from that vertex in pixels. Each is of one sample of the pixels: see [`super::samples`].

use super::depth_bias::Bias;
use crate::geometry::raster_space::SUBPIXELS;

/// The largest width and height, in pixels, of a small triangle's box of samples.
pub(crate) const SMALL_EXTENT: i32 = 4;

/// The largest extent of a mid-sized triangle in subpixels. Its edge functions fit i32 anywhere in its box of 4 x 4 blocks:
/// 2 * 31,744 * (31,744 + 3 * 256 + 255) + 1 < 2^31.
pub(crate) const MID_EXTENT: i32 = 124 * 256;
const _: () = assert!(2 * MID_EXTENT as i64 * (MID_EXTENT as i64 + 1023) < i32::MAX as i64);

/// A triangle whose samples lie within 4 x 4 pixels, with its coverage.
///
/// Words: id; block x (16 bits), block y (12), plane (4); coverage of the left two blocks (16 bits each, upper block in the low half); of the right two;
/// z0; dz/dx; dz/dy; distance of the first block's first sample from the anchor, x and y (i16 subpixels each).
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct SmallTriangle(pub(crate) [u32; 8]);

/// A triangle of up to [`MID_EXTENT`], with its edge functions.
///
/// Words: id; first and last sample column (u16 each); rows; z0; dz/dx; dz/dy; distance of the first block's first sample from the
/// anchor, x; y (i32 subpixels); the three edge functions there, over 256, rounded down; their steps a pixel right and down (i16 each),
/// one word an edge; the plane; one unused.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct MidTriangle(pub(crate) [u32; 16]);

/// Any other triangle, with its vertices.
///
/// Words: id; first and last sample column (u16 each); rows; z0; dz/dx; dz/dy; the vertices in canonical order, x and y each;
/// a bit for each edge that is a top or left edge; the second and third vertex's depths; the plane.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct LargeTriangle(pub(crate) [u32; 16]);

/// Where a small record has its sample's plane.
const PLANE_SHIFT: u32 = 28;

/// A plane's number, for the word of a small record that holds its block.
pub(crate) fn plane_bits(plane: u32) -> i32 {
    (plane << PLANE_SHIFT) as i32
}

impl SmallTriangle {
    /// Its first block, across and down, and its sample's plane.
    #[inline(always)]
    pub(crate) fn place(&self) -> (usize, usize, usize) {
        let at = self.0[1] as usize;
        (at & 0xffff, at >> 16 & 0xfff, at >> PLANE_SHIFT)
    }
}

/// First and last sample column and row: words 1 and 2 of mid and large records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SampleBox {
    pub(crate) x0: i32,
    pub(crate) x1: i32,
    pub(crate) y0: i32,
    pub(crate) y1: i32,
}

impl SampleBox {
    #[inline(always)]
    pub(crate) fn unpack(columns: u32, rows: u32) -> Self {
        Self {
            x0: (columns & 0xffff) as i32,
            x1: (columns >> 16) as i32,
            y0: (rows & 0xffff) as i32,
            y1: (rows >> 16) as i32,
        }
    }
}

/// A depth's plane over the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DepthPlane {
    pub(crate) z0: f32,
    pub(crate) dz_dx: f32,
    pub(crate) dz_dy: f32,
}

impl DepthPlane {
    #[inline(always)]
    pub(crate) fn unpack(words: &[u32; 16]) -> Self {
        Self { z0: f32::from_bits(words[3]), dz_dx: f32::from_bits(words[4]), dz_dy: f32::from_bits(words[5]) }
    }
}

impl LargeTriangle {
    /// Replaces the depth's plane by one computed in f64: over thousands of pixels, f32 would lose a sliver's slope.
    pub(crate) fn with_precise_plane(mut self) -> Self {
        let [(x0, y0), (x1, y1), (x2, y2)] = [self.vertex(0), self.vertex(1), self.vertex(2)];
        let (ax, ay, bx, by) = ((x1 - x0) as f64, (y1 - y0) as f64, (x2 - x0) as f64, (y2 - y0) as f64);
        let depth = |word: usize| f64::from(f32::from_bits(self.0[word]));
        let (dz1, dz2) = (depth(13) - depth(3), depth(14) - depth(3));
        // Products of differences are exact in f64, and so is the area.
        let scale = f64::from(SUBPIXELS) / (ax * by - bx * ay);
        self.0[4] = (((dz1 * by - dz2 * ay) * scale) as f32).to_bits();
        self.0[5] = (((dz2 * ax - dz1 * bx) * scale) as f32).to_bits();
        self
    }

    /// Moves the depth's plane: by the offset of the triangle that this one was clipped from, or its own.
    pub(crate) fn with_bias(mut self, bias: &Bias, offset_of_whole: Option<f32>) -> Self {
        let [z0, dz_dx, dz_dy] = [3, 4, 5].map(|word| f32::from_bits(self.0[word]));
        let depths = [3, 13, 14].map(|word| f32::from_bits(self.0[word]));
        let offset = offset_of_whole.unwrap_or_else(|| bias.offset(&depths, dz_dx, dz_dy));
        self.0[3] = (z0 + offset).to_bits();
        self
    }

    /// Vertex `k` in canonical order, in subpixels.
    #[inline(always)]
    pub(crate) fn vertex(&self, k: usize) -> (i64, i64) {
        (i64::from(self.0[6 + 2 * k] as i32), i64::from(self.0[7 + 2 * k] as i32))
    }
}
