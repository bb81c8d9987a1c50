//! The integer grid that everything exact stands on.
//!
//! Raster space has x right and y down, in pixels, and pixel (i, j) has its centre at (i + 1/2, j + 1/2). Positions are
//! snapped to 1/256 pixel, so that a coordinate is an integer number of *subpixels*, and stays within the guard band.
//! From these two numbers all bit ranges follow:
//!
//! | value | range | proof |
//! | --- | --- | --- |
//! | coordinate | +-2^23 subpixels | the guard band: 32,768 pixels to each side of the target's corner |
//! | difference of two | +-2^24 | exact in f32, too |
//! | edge function | +-2^49 | two products of two differences; exact in i64, and in f64 |
//! | its step a pixel, over 256 | +-2^24 | a difference |
//! | edge function over 256, within a 64-pixel tile that the edge crosses | below 2^31 | 63 (2^24 + 2^24) = 2^31 - 2^25 |
//!
//! The last line is what sets the width of the guard band: one bit more would not fit the lanes' 32-bit integers.

/// Subpixel bits of a snapped coordinate (D3D11.3, 3.4.1).
pub(crate) const SUBPIXEL_BITS: u32 = 8;

/// Subpixels in a pixel.
pub(crate) const SUBPIXELS: i32 = 1 << SUBPIXEL_BITS;

/// From a pixel's corner to its centre.
pub(crate) const HALF_PIXEL: i32 = SUBPIXELS / 2;

/// The largest absolute value of a snapped coordinate, in subpixels.
pub(crate) const GUARD_BAND: i32 = 1 << 23;

const _: () = assert!(63 * (2 * GUARD_BAND as i64 + 2 * GUARD_BAND as i64) <= i32::MAX as i64);

/// A vertex on the raster: x and y in subpixels, depth, and 1 / w, as four 32-bit words that load as one vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(transparent)]
pub(crate) struct ScreenVertex(pub(crate) [u32; 4]);

/// Stands where x would, for a vertex that is not on the raster: it lies outside the view volume or the guard band, or is not finite.
pub(crate) const OFF_RASTER: i32 = i32::MIN;

impl ScreenVertex {
    pub(crate) fn new(x: i32, y: i32, z: f32, inv_w: f32) -> Self {
        Self([x as u32, y as u32, z.to_bits(), inv_w.to_bits()])
    }

    pub(crate) fn x(self) -> i32 {
        self.0[0] as i32
    }

    pub(crate) fn y(self) -> i32 {
        self.0[1] as i32
    }

    /// x and y.
    pub(crate) fn place(self) -> [i32; 2] {
        [self.x(), self.y()]
    }

    pub(crate) fn z(self) -> f32 {
        f32::from_bits(self.0[2])
    }

    pub(crate) fn is_off_raster(self) -> bool {
        self.x() == OFF_RASTER
    }

    /// Of a vertex off the raster: which planes it lies outside of.
    pub(crate) fn outcode(self) -> u32 {
        if self.is_off_raster() { self.0[1] } else { 0 }
    }
}
