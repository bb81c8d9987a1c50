//! Depth bias: by how much a triangle's depths are moved.
//!
//! ```text
//! offset = constant * unit + slope * max(|dz/dx|, |dz/dy|)       then clamped
//! unit   = 2^(exponent(max |z| in the triangle) - 23)            for f32; the step from code to code for unorm formats
//! ```
//!
//! (Vulkan 1.4, "Depth Bias"; D3D11.3, 15.10.) The slopes are those of the plane that the samples' depths come from, so the vertices' order and winding change
//! nothing. A clipped triangle has one offset for all of its parts: its slopes are those of the whole triangle, its largest depth is the one
//! that is left.

use crate::geometry::clip::canonical_positions;
use crate::geometry::project::Projection;
use crate::geometry::raster_space::SUBPIXELS;
use crate::pass::DepthBias;
use crate::target::depth::DepthFormat;
use crate::wide::{Simd, f32x16, i32x16};

const EXPONENT: i32 = 0x7f80_0000;
/// The exponent of 0 counts as that of the smallest normal number, 2^-126.
const LEAST_EXPONENT: i32 = 0x0080_0000;
/// 2^-23.
const ULP: f32 = f32::EPSILON;

/// A draw's bias on a target's format.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bias {
    constant: f32,
    slope: f32,
    clamp: f32,
    /// Of unorm formats.
    unit: Option<f32>,
}

impl Bias {
    /// `None` if nothing is moved.
    pub(crate) fn new(bias: &DepthBias, format: DepthFormat) -> Option<Self> {
        let DepthBias { constant, slope, clamp } = *bias;
        (constant != 0.0 || slope != 0.0).then_some(Self { constant, slope, clamp, unit: format.step() })
    }

    /// The offset of a triangle with these depths at its corners and these slopes a pixel.
    pub(crate) fn offset(&self, depths: &[f32], dz_dx: f32, dz_dy: f32) -> f32 {
        let largest = depths.iter().map(|z| z.to_bits() as i32 & i32::MAX).max().unwrap_or(0);
        let exponent = (largest & EXPONENT).max(LEAST_EXPONENT);
        let unit = self.unit.unwrap_or(f32::from_bits(exponent as u32) * ULP);
        let (x, y) = (dz_dx.abs(), dz_dy.abs());
        let steepest = if x > y { x } else { y };
        let offset = self.constant * unit + self.slope * steepest;
        let offset = if self.clamp > 0.0 && offset > self.clamp { self.clamp } else { offset };
        let offset = if self.clamp < 0.0 && offset < self.clamp { self.clamp } else { offset };
        // What came out of infinities.
        if offset.is_nan() { 0.0 } else { offset }
    }

    /// The same for sixteen triangles.
    #[inline(always)]
    pub(crate) fn offsets<S: Simd>(&self, s: S, z: [f32x16<S>; 3], dz_dx: f32x16<S>, dz_dy: f32x16<S>) -> f32x16<S> {
        let bits = |z: f32x16<S>| z.bitcast::<i32x16<S>>() & i32::MAX;
        let largest = bits(z[0]).max(bits(z[1])).max(bits(z[2]));
        let exponent = (largest & EXPONENT).max(LEAST_EXPONENT);
        let unit = match self.unit {
            Some(unit) => f32x16::splat(s, unit),
            None => exponent.bitcast::<f32x16<S>>() * ULP,
        };
        let (x, y) = (dz_dx.abs(), dz_dy.abs());
        let steepest = x.max(y);
        let mut offset = unit * self.constant + steepest * self.slope;
        let clamp = f32x16::splat(s, self.clamp);
        if self.clamp > 0.0 {
            offset = clamp.min(offset);
        }
        if self.clamp < 0.0 {
            offset = clamp.max(offset);
        }
        offset.simd_eq(offset).select(offset, f32x16::splat(s, 0.0))
    }

    /// The offset of a clipped triangle: from its own positions, and from the depths at the corners of what is left of it.
    pub(crate) fn offset_of_clipped(&self, projection: &Projection, positions: [[f32; 4]; 3], depths: &[f32]) -> f32 {
        // z / w = a x / w + b y / w + c, by Cramer's rule.
        let ([p, q, r], _) = canonical_positions(projection, positions);
        let determinant = |p: [f64; 3], q: [f64; 3], r: [f64; 3]| {
            p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0])
        };
        let whole = determinant([p.x, p.y, p.w], [q.x, q.y, q.w], [r.x, r.y, r.w]);
        let across = determinant([p.z, p.y, p.w], [q.z, q.y, q.w], [r.z, r.y, r.w]);
        let down = determinant([p.x, p.z, p.w], [q.x, q.z, q.w], [r.x, r.z, r.w]);
        let slope = |numerator: f64| {
            let slope = numerator / whole * f64::from(SUBPIXELS) * f64::from(projection.depth_range());
            slope as f32
        };
        self.offset(depths, slope(across), slope(down))
    }
}
