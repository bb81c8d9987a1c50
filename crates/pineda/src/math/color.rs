//! The colour that a fragment stage returns.

use super::vector::components;
use super::{Real, ToLanes, Vec3, Vec4};
use crate::lanes::{Lanes, Scalar};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A colour per lane: red, green and blue in linear light, and alpha, 0 (invisible) to 1 (opaque).
///
/// Values beyond 0 to 1 are kept by float targets and clamped by 8-bit ones. Whether the colour is multiplied by its
/// alpha is the draw's blend mode's business.
pub struct Rgba<L: Lanes = Scalar> {
    /// Red, linear.
    pub r: Real<L>,
    /// Green, linear.
    pub g: Real<L>,
    /// Blue, linear.
    pub b: Real<L>,
    /// Alpha, linear; 1 is opaque.
    pub a: Real<L>,
}

components!(Rgba 4: r g b a);

impl<L: Lanes> Rgba<L> {
    /// `rgb` with alpha 1.
    #[inline(always)]
    pub fn opaque(rgb: Vec3<L>) -> Self {
        Self::new(rgb, 1.0)
    }

    /// `rgb` with alpha `a`.
    #[inline(always)]
    pub fn new(rgb: Vec3<L>, a: impl ToLanes<L, Real<L>>) -> Self {
        Self { r: rgb.x, g: rgb.y, b: rgb.z, a: a.to_lanes(rgb.lanes()) }
    }

    /// An opaque grey.
    #[inline(always)]
    pub fn gray(value: Real<L>) -> Self {
        Self { r: value, g: value, b: value, a: Real::new(value.lanes(), 1.0) }
    }

    /// Red, green and blue as a vector.
    #[inline(always)]
    pub fn rgb(self) -> Vec3<L> {
        Vec3 { x: self.r, y: self.g, z: self.b }
    }

    /// Red, green and blue multiplied by alpha, as [`Blend::PREMULTIPLIED`](crate::Blend::PREMULTIPLIED) wants it.
    #[inline(always)]
    pub fn premultiplied(self) -> Self {
        Self { r: self.r * self.a, g: self.g * self.a, b: self.b * self.a, a: self.a }
    }
}

impl<L: Lanes> From<Vec4<L>> for Rgba<L> {
    #[inline(always)]
    fn from(v: Vec4<L>) -> Self {
        Self { r: v.x, g: v.y, b: v.z, a: v.w }
    }
}
impl<L: Lanes> From<Rgba<L>> for Vec4<L> {
    #[inline(always)]
    fn from(c: Rgba<L>) -> Self {
        Self { x: c.r, y: c.g, z: c.b, w: c.a }
    }
}
