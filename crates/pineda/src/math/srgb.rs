//! The sRGB curve (IEC 61966-2-1) of numbers in lanes.
//!
//! A power function behind a straight piece: in `f64`, as in `power.rs`, because the sum that belongs to it would make the errors of
//! a rounded power larger. Targets and textures in sRGB formats need none of this, for they encode and decode by themselves, and exactly.

use super::exponential::ROUND;
use super::power::{exp2_of_double, log2_of_product};
use super::{Real, Rgba, Vec3};
use crate::lanes::Lanes;
use crate::shader;

impl<L: Lanes> Real<L> {
    /// From linear light to the sRGB curve, to 0.51 ULP. 0 stays 0 and 1 stays 1;
    /// above 1 the curve goes on, and so does its straight piece below 0.
    ///
    /// ```
    /// use pineda::*;
    /// let middle = Real::<Scalar>::from(0.5).linear_to_srgb();
    /// assert_eq!(f32::from(middle), 0.735_357);
    /// assert_eq!(f32::from(middle.srgb_to_linear()), 0.5);
    /// ```
    #[shader(apart)]
    pub fn linear_to_srgb(self) -> Self {
        let (exponent, x) = self.split();
        let (shifted, power) = exp2_of_double(log2_of_product(exponent, x, x.double()) * (1.0 / 2.4));
        let power = power * Self::new(self.lanes(), 1.0).times_power_of_two(shifted).double();
        let curved = (power * 1.055 - 0.055).round();
        let curved = self.lt(f32::INFINITY).select(curved, self);
        let is_straight = self.le(0.003_130_8);
        let slope = is_straight.select(12.92, (curved + 0.055) / (self * 2.4));
        is_straight.select((self.double() * 12.92).round(), curved).with_slope(self, slope)
    }

    /// From the sRGB curve to linear light, to 0.51 ULP. 0 stays 0 and 1 stays 1; above 1 the curve goes on, and so does its straight
    /// piece below 0.
    #[shader(apart)]
    pub fn srgb_to_linear(self) -> Self {
        // From here on the power is infinite.
        let base = (self.min(1e20).double() + 0.055) / 1.055;
        let near = base.round();
        let (exponent, x) = near.split();
        // What rounding took away, brought to the size of x.
        let scale = Self::new(self.lanes(), 1.0).times_power_of_two(ROUND - exponent);
        let exact = x.double() + (base - near.double()) * scale.double();
        let t = log2_of_product(exponent, x, exact) * 2.4;
        let (shifted, power) = exp2_of_double(t);
        let curved = power.round().times_power_of_two(shifted);
        let curved = t.round().in_range(-126.0, 129.0, curved.or_flushed());
        let curved = self.lt(1e20).select(curved, self + f32::INFINITY);
        let is_straight = self.le(0.040_45);
        let slope = is_straight.select(1.0 / 12.92, curved * 2.4 / (self + 0.055));
        is_straight.select((self.double() * (1.0 / 12.92)).round(), curved).with_slope(self, slope)
    }
}

macro_rules! colors {
    ($($color:ident: $($field:ident)+, $($same:ident)?;)+) => {$(
        impl<L: Lanes> $color<L> {
            /// [`Real::linear_to_srgb`] of red, green and blue.
            #[inline(always)]
            pub fn linear_to_srgb(self) -> Self {
                Self { $($field: self.$field.linear_to_srgb(),)+ $($same: self.$same)? }
            }

            /// [`Real::srgb_to_linear`] of red, green and blue.
            #[inline(always)]
            pub fn srgb_to_linear(self) -> Self {
                Self { $($field: self.$field.srgb_to_linear(),)+ $($same: self.$same)? }
            }

            /// How bright a colour in linear light is: 0.2126 red + 0.7152 green + 0.0722 blue (ITU-R BT.709).
            #[inline(always)]
            pub fn luminance(self) -> Real<L> {
                let [red, green, blue] = [$(self.$field),+];
                red * 0.2126 + green * 0.7152 + blue * 0.0722
            }
        }
    )+};
}

colors! {
    Vec3: x y z,;
    Rgba: r g b, a;
}
