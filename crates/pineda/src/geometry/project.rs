//! From the shader's positions to the raster: perspective division, viewport transform, snapping.
//!
//! ```text
//! x_raster = x / w * width / 2 + x_centre          in f64, then to the nearest 1/256 pixel, ties to even
//! y_raster = -y / w * height / 2 + y_centre
//! z_raster = z / w * (max_depth - min_depth) + min_depth
//! ```
//!
//! f64 costs nothing that one can measure here and rounds right for vertices far outside the picture.

use super::exact::determinant_is_zero;
use super::raster_space::{GUARD_BAND, OFF_RASTER, SUBPIXELS, ScreenVertex};
use crate::pass::{Space, Viewport};
use crate::transpose::{columns4, each_of_sixteen};
use crate::wide::{Simd, dispatch, f32x16, f64x8, i32x16, i64x8, mask32x16, u32x4, u32x16};
use fearless_simd::Level;

/// The planes that a vertex can lie outside of, one bit each; what [`ScreenVertex::outcode`] holds.
pub(crate) mod outcode {
    pub(crate) const NEAR: u32 = 1;
    pub(crate) const FAR: u32 = 2;
    pub(crate) const LEFT: u32 = 4;
    pub(crate) const RIGHT: u32 = 8;
    pub(crate) const TOP: u32 = 16;
    pub(crate) const BOTTOM: u32 = 32;
    /// A coordinate or a clip distance is NaN or infinite.
    pub(crate) const NON_FINITE: u32 = 64;
    /// The first of the shader's own planes; the others follow.
    pub(crate) const FIRST_OWN: u32 = 128;
}

/// A vertex whose 1 / w is larger than this or smaller than its reciprocal goes the careful way: times an edge function, of up to 2^49,
/// and three of them summed, it could leave the range of f32.
const LARGEST_INV_W: f32 = 18_446_744_073_709_551_616.0; // 2^64

/// The largest |z / w| of a triangle that is not clipped by depth: with larger ones its plane could leave the range of f32.
const LARGEST_DEPTH: f32 = LARGEST_INV_W;

/// Maps positions of a [`Space`] to the raster.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    /// Subpixels per unit of x / w and y / w, and where 0 falls.
    scale: [f64; 2],
    offset: [f64; 2],
    min_depth: f32,
    depth_range: f32,
    space: Space,
    /// Whether depths before the near plane and beyond the far one are clamped, sample by sample, instead of being clipped.
    clamps_depth: bool,
}

/// A position before the perspective division, scaled so that x / w and y / w are subpixels: the clipper's space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Homogeneous {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) z: f64,
    pub(crate) w: f64,
}

impl Projection {
    pub(crate) fn new(space: Space, viewport: &Viewport) -> Self {
        let (half_width, half_height) = (f64::from(viewport.width) * 0.5, f64::from(viewport.height) * 0.5);
        let subpixels = f64::from(SUBPIXELS);
        let (scale, offset) = match space {
            Space::Clip => (
                [half_width * subpixels, -half_height * subpixels],
                [(f64::from(viewport.x) + half_width) * subpixels, (f64::from(viewport.y) + half_height) * subpixels],
            ),
            Space::Raster => ([subpixels; 2], [0.0; 2]),
        };
        let (min_depth, depth_range) = (viewport.min_depth, viewport.max_depth - viewport.min_depth);
        Self { scale, offset, min_depth, depth_range, space, clamps_depth: false }
    }

    /// The same, with depths clamped instead of clipped or not.
    pub(crate) fn with_depth_clamp(self, clamps_depth: bool) -> Self {
        Self { clamps_depth, ..self }
    }

    /// By how much the depth grows from z / w = 0 to 1.
    pub(crate) fn depth_range(&self) -> f32 {
        self.depth_range
    }

    /// The z / w of a corner that clipping left, which a rounding error may have moved out of bounds.
    pub(crate) fn bounded_depth(&self, z: f32) -> f32 {
        if self.clamps_depth { z.clamp(-LARGEST_DEPTH, LARGEST_DEPTH) } else { z.clamp(0.0, 1.0) }
    }

    /// The depth of a vertex whose z / w is `z`.
    pub(crate) fn depth(&self, z: f32) -> f32 {
        z * self.depth_range + self.min_depth
    }

    /// The position for the clipper. Exact for raster space; one rounding to f64 an operation for clip space.
    pub(crate) fn homogeneous(&self, position: [f32; 4]) -> Homogeneous {
        let [x, y, z, w] = position;
        let [x, y, z, w] = [f64::from(x), f64::from(y), f64::from(z), f64::from(w)];
        // In raster space x, y and z are divided by w already.
        let (x, y, z) = match self.space {
            Space::Clip => (x, y, z),
            Space::Raster => (x * w, y * w, z * w),
        };
        Homogeneous { x: x * self.scale[0] + w * self.offset[0], y: y * self.scale[1] + w * self.offset[1], z, w }
    }

    /// Whether a triangle's plane goes through the eye, exactly.
    pub(crate) fn is_edge_on(&self, positions: [[f32; 4]; 3]) -> bool {
        match self.space {
            Space::Clip => determinant_is_zero(positions.map(|[x, y, _, w]| [x, y, w])),
            Space::Raster => {
                positions.iter().any(|p| p[3] == 0.0) || determinant_is_zero(positions.map(|[x, y, ..]| [x, y, 1.0]))
            }
        }
    }

    /// Why a vertex is off the raster: the half-spaces that it lies outside of. Several at once, or `NON_FINITE` alone.
    fn outcode(&self, position: [f32; 4]) -> u32 {
        use outcode::*;
        if !position.iter().all(|v| v.is_finite()) {
            return NON_FINITE;
        }
        let p = self.homogeneous(position);
        let band = f64::from(GUARD_BAND) * p.w;
        let clips = !self.clamps_depth;
        let outside = [(clips && p.z < 0.0, NEAR), (clips && p.z > p.w, FAR), (p.x < -band, LEFT), (p.x > band, RIGHT)];
        let outside = outside.into_iter().chain([(p.y < -band, TOP), (p.y > band, BOTTOM)]);
        outside.fold(0, |code, (is_outside, plane)| if is_outside { code | plane } else { code })
    }

    /// Projects sixteen positions.
    #[inline(never)]
    pub(crate) fn project(&self, level: Level, positions: &[[f32; 4]; 16], out: &mut [ScreenVertex; 16]) {
        dispatch!(level, s => self.project_at(s, positions, out));
    }

    #[inline(always)]
    fn project_at<S: Simd>(&self, s: S, positions: &[[f32; 4]; 16], out: &mut [ScreenVertex; 16]) {
        let [x, y, z, w] = columns(s, positions);
        let raster = self.space == Space::Raster;
        let zero = f32x16::splat(s, 0.0);
        let one = f32x16::splat(s, 1.0);
        let (z, z_far) = if raster { (z, one) } else { (z, w) };
        let mut in_view = w.simd_gt(zero) & z.simd_ge(zero) & z.simd_le(z_far);
        let inv_w = one / w;
        let z = if raster { z } else { z / w };
        if self.clamps_depth {
            in_view = w.simd_gt(zero) & z.abs().simd_le(LARGEST_DEPTH);
        }
        let z = z * self.depth_range + self.min_depth;

        let divisor = if raster { one } else { w };
        let (w_low, w_high) = divisor.widen();
        let one = f64x8::splat(s, 1.0);
        let (r_low, r_high) = (one / w_low, one / w_high);
        let (x_low, x_high) = x.widen();
        let (y_low, y_high) = y.widen();
        let (x_low, x_low_ok) = snap(s, x_low * r_low * self.scale[0] + self.offset[0]);
        let (x_high, x_high_ok) = snap(s, x_high * r_high * self.scale[0] + self.offset[0]);
        let (y_low, y_low_ok) = snap(s, y_low * r_low * self.scale[1] + self.offset[1]);
        let (y_high, y_high_ok) = snap(s, y_high * r_high * self.scale[1] + self.offset[1]);
        let in_band = mask32x16::from_bitmask(s, x_low_ok & y_low_ok | (x_high_ok & y_high_ok) << 8);
        let (x, y): (i32x16<S>, i32x16<S>) = (x_low.narrow(x_high), y_low.narrow(y_high));

        let in_view = in_view & inv_w.simd_ge(1.0 / LARGEST_INV_W) & inv_w.simd_le(LARGEST_INV_W);
        let on_raster = in_view & in_band;
        let x = on_raster.select(x, i32x16::splat(s, OFF_RASTER));
        let (xz_low, xz_high) = x.bitcast::<u32x16<S>>().interleave(z.bitcast::<u32x16<S>>());
        let (yw_low, yw_high) = y.bitcast::<u32x16<S>>().interleave(inv_w.bitcast::<u32x16<S>>());
        let (r0, r1) = xz_low.interleave(yw_low);
        let (r2, r3) = xz_high.interleave(yw_high);
        let rows: [[u32; 16]; 4] = [r0.into(), r1.into(), r2.into(), r3.into()];
        let vertices: &[[u32; 4]; 16] = bytemuck::cast_ref(&rows);
        let mut k = 0;
        while k < 16 {
            out[k] = ScreenVertex(vertices[k]);
            k += 1;
        }
        let mut off = !on_raster.to_bitmask() & 0xffff;
        while off != 0 {
            let k = off.trailing_zeros() as usize & 15;
            off &= off - 1;
            out[k] = self.off_raster(positions[k]);
        }
    }

    /// Takes vertices off the raster that lie outside of the shader's own planes.
    #[inline(always)]
    pub(crate) fn clip(&self, position: [f32; 4], distances: &[f32], vertex: &mut ScreenVertex) {
        let mut code = 0;
        for (k, distance) in distances.iter().enumerate() {
            if !distance.is_finite() {
                code = outcode::NON_FINITE;
                break;
            }
            code |= u32::from(*distance < 0.0) * (outcode::FIRST_OWN << k);
        }
        if code != 0 {
            let other = self.outcode(position);
            let code = if (code | other) & outcode::NON_FINITE != 0 { outcode::NON_FINITE } else { code | other };
            *vertex = ScreenVertex([OFF_RASTER as u32, code, 0, 0]);
        }
    }

    #[cold]
    #[inline(never)]
    fn off_raster(&self, position: [f32; 4]) -> ScreenVertex {
        ScreenVertex([OFF_RASTER as u32, self.outcode(position), 0, 0])
    }
}

/// The x, y, z and w of sixteen positions.
#[inline(always)]
fn columns<S: Simd>(s: S, positions: &[[f32; 4]; 16]) -> [f32x16<S>; 4] {
    let rows: &[[u32; 4]; 16] = bytemuck::cast_ref(positions);
    let [x, y, z, w] = columns4(each_of_sixteen!(|k| u32x4::simd_from(s, rows[k])));
    [x.bitcast(), y.bitcast(), z.bitcast(), w.bitcast()]
}

/// Rounds to the nearest integer, ties to even, and says which lanes lie within the guard band.
///
/// Adding 1.5 * 2^52 leaves no bits for a fraction: the sum's low bits are the rounded integer in two's complement.
#[inline(always)]
fn snap<S: Simd>(s: S, subpixels: f64x8<S>) -> (i64x8<S>, u64) {
    const MAGIC: f64 = 6_755_399_441_055_744.0;
    let shifted = subpixels + MAGIC;
    let rounded = shifted - MAGIC;
    // False for NaN. Beyond 2^51 the trick does not round, but the comparison is still right.
    let in_band = rounded.abs().simd_le(f64x8::splat(s, f64::from(GUARD_BAND)));
    (shifted.bitcast(), in_band.to_bitmask())
}
