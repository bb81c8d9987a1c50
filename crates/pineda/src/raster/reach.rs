//! Boxes: which pixels a triangle may cover.

use super::record::MID_EXTENT;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXEL_BITS};
use crate::wide::{Simd, i32x16, mask32x16};

/// A rectangle of pixels: left and top inside, right and bottom outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PixelRect {
    pub(crate) x0: i32,
    pub(crate) y0: i32,
    pub(crate) x1: i32,
    pub(crate) y1: i32,
}

/// What the vertices of sixteen triangles reach, in subpixels.
#[derive(Clone, Copy)]
pub(super) struct Reach<S: Simd> {
    min_x: i32x16<S>,
    max_x: i32x16<S>,
    min_y: i32x16<S>,
    max_y: i32x16<S>,
}

/// The first and the last pixel, across and down, whose sample a triangle may cover.
#[derive(Clone, Copy)]
pub(super) struct Pixels<S: Simd> {
    pub(super) column0: i32x16<S>,
    pub(super) column1: i32x16<S>,
    pub(super) row0: i32x16<S>,
    pub(super) row1: i32x16<S>,
}

impl<S: Simd> Reach<S> {
    #[inline(always)]
    pub(super) fn of([x0, x1, x2]: [i32x16<S>; 3], [y0, y1, y2]: [i32x16<S>; 3]) -> Self {
        Self {
            min_x: x0.min(x1).min(x2),
            max_x: x0.max(x1).max(x2),
            min_y: y0.min(y1).min(y2),
            max_y: y0.max(y1).max(y2),
        }
    }

    #[inline(always)]
    pub(super) fn is_large(&self) -> mask32x16<S> {
        (self.max_x - self.min_x).simd_gt(MID_EXTENT) | (self.max_y - self.min_y).simd_gt(MID_EXTENT)
    }

    /// The first sample at or after the left border, the last before the right one: no sample on a right or a bottom border is covered, for
    /// such a border is no top or left edge.
    #[inline(always)]
    pub(super) fn pixels(&self, rect: &PixelRect, [ox, oy]: [i32; 2]) -> Pixels<S> {
        Pixels {
            column0: ((self.min_x + (HALF_PIXEL - 1 - ox)) >> SUBPIXEL_BITS).max(rect.x0),
            column1: ((self.max_x - (HALF_PIXEL + 1 + ox)) >> SUBPIXEL_BITS).min(rect.x1 - 1),
            row0: ((self.min_y + (HALF_PIXEL - 1 - oy)) >> SUBPIXEL_BITS).max(rect.y0),
            row1: ((self.max_y - (HALF_PIXEL + 1 + oy)) >> SUBPIXEL_BITS).min(rect.y1 - 1),
        }
    }
}

impl<S: Simd> Pixels<S> {
    #[inline(always)]
    pub(super) fn has_any(&self) -> mask32x16<S> {
        self.column0.simd_le(self.column1) & self.row0.simd_le(self.row1)
    }
}
