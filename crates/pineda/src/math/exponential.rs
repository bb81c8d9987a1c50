//! Exponentials, the natural logarithm and the inverse square root, from polynomials of our own.
//!
//! The standard library's functions differ in their last bits from platform to platform, and have no lanes. These use
//! additions, multiplications, comparisons and integer operations only, in a fixed order, so all lanes of all levels on
//! all platforms agree. Each takes the number apart into a power of two, which the exponent bits hold, and a rest
//! near 1 (or 0), for which a polynomial does. The polynomials are minimax fits: `tools/minimax.py` prints them.
//!
//! Results that would be subnormal (below 2^-126 = 1.2e-38) are 0 here: they are invisible, and slow on some processors.
//! Subnormal arguments are taken for what they are. `math/accuracy.rs` tests what each function states.

#![expect(clippy::excessive_precision, reason = "coefficients are written with the digits that their derivation gave")]

use super::Real;
use crate::lanes::Lanes;
use crate::shader;
use core::f32::consts::{LN_2, LOG2_E};

/// c0 + x (c1 + x (c2 + ...)), rounded after every step.
macro_rules! horner {
    ($x:expr; $c:expr) => { $c };
    ($x:expr; $c:expr, $($rest:expr),+) => { $c + $x * horner!($x; $($rest),+) };
}

/// Added to a number below 2^22, it pushes the fraction off the mantissa's end: the sum is rounded to a whole number,
/// ties to even, which sits in the low bits. Subtracted again, it leaves that whole number.
pub(super) const ROUND: f32 = 12_582_912.0; // 1.5 * 2^23

/// ln 2 in two parts. The first has 9 bits, so that its product with any exponent is exact.
const LN_2_HIGH: f32 = 0.693_359_375;
const LN_2_LOW: f32 = -2.121_944_4e-4;

impl<L: Lanes> Real<L> {
    /// 2 to the power of `self`, to 0.8 ULP, and exact for whole numbers. 0 below -126, infinity from 128 on.
    #[shader(apart)]
    pub fn exp2(self) -> Self {
        let shifted = self + ROUND;
        let power = (self - (shifted - ROUND)).exp2_of_fraction();
        let power = self.in_range(-126.0, 128.0, power.times_power_of_two(shifted));
        power.with_slope(self, power * LN_2)
    }

    /// 2 to the power of `self`, which must be within 1/2 of 0.
    ///
    /// 1 + x ln 2 is the bulk of it. Its product is exact, for both factors have twelve bits, and what its sum loses joins the smaller terms
    /// (Dekker 1971, "A floating-point technique for extending the available precision").
    #[inline(always)]
    pub(super) fn exp2_of_fraction(self) -> Self {
        const TWELVE_BITS: i32 = 0xffff_f000_u32.cast_signed();
        let high = Self(L::bits_f(L::iand(L::f_bits(self.0), self.lanes().int(TWELVE_BITS))));
        let low = self - high;
        let bulk = high * LN_2_HIGH;
        let sum = 1.0 + bulk;
        let lost = (1.0 - sum) + bulk;
        let small = self
            * horner!(self; LN_2_LOW, 0.240_226_48, 0.055_503_324, 0.009_618_437, 0.001_339_887_4, 0.000_153_533_56);
        sum + (lost + (low * LN_2_HIGH + small))
    }

    /// e to the power of `self`, to 1 ULP. 0 below -87.33654, infinity above 88.72283.
    #[shader(apart)]
    pub fn exp(self) -> Self {
        let shifted = self * LOG2_E + ROUND;
        let exponent = shifted - ROUND;
        let x = (self - exponent * LN_2_HIGH) - exponent * LN_2_LOW;
        let power =
            1.0 + (x + x * x * horner!(x; 0.499_999_94, 0.166_665_21, 0.041_668_39, 0.008_368_71, 0.001_381_462_2));
        let power = self.in_range(-87.336_54, 88.722_84, power.times_power_of_two(shifted));
        power.with_slope(self, power)
    }

    /// The natural logarithm, to 1 ULP. -infinity of 0 (and -0), NaN below 0.
    #[shader(apart)]
    pub fn log(self) -> Self {
        let (exponent, x) = self.split();
        let squared = x * x;
        let p = horner!(
            x; 0.333_333_3, -0.250_008_2, 0.200_012_28, -0.166_233_6, 0.142_017_35, -0.131_601_33, 0.127_617_02,
            -0.076_347_68
        );
        let tail = x * squared * p + exponent * LN_2_LOW - 0.5 * squared;
        self.logarithm_in_range((x + tail) + exponent * LN_2_HIGH).with_slope(self, 1.0 / self)
    }

    /// [`log`](Self::log) by its mathematical name.
    #[inline(always)]
    pub fn ln(self) -> Self {
        self.log()
    }

    /// 1 over the square root, to 1.5 ULP, in a fifth of the time that the square root and the division take. Infinity of 0 and of what is subnormal, 0 of
    /// infinity, NaN below 0.
    #[inline(always)]
    pub fn inverse_sqrt(self) -> Self {
        let above = self.eq(f32::INFINITY).select(0.0, self.inverse_sqrt_of_normal());
        let below = self.lt(0.0).select(f32::NAN, f32::INFINITY);
        self.lt(f32::MIN_POSITIVE).select(below, above)
    }

    /// [`inverse_sqrt`](Self::inverse_sqrt) of a normal number; NaN of NaN, junk of anything else.
    ///
    /// Halving the bits halves the exponent: a first guess. Two steps of Newton's with constants that make the largest error smallest
    /// (Kadlec 2010, "Improving the fast inverse square root") leave 4e-7; the third adds what is missing, so that its own rounding hardly counts.
    #[inline(always)]
    pub(super) fn inverse_sqrt_of_normal(self) -> Self {
        let lanes = self.lanes();
        let guess = Self(L::bits_f(L::isub(lanes.int(0x5f1f_fff9), L::ishr(L::f_bits(self.0), 1))));
        let y = (guess * 0.703_952_25) * (2.389_244_6 - (self * guess) * guess);
        // Halving y is exact; half of a number near the smallest normal one is not.
        let y = y * (1.500_000_3 - (self * (0.5 * y)) * y);
        let y = y + y * (0.5 - (self * (0.5 * y)) * y);
        y.with_slope(self, -0.5 * y * y * y)
    }

    /// `self`, which must be from 1/2 to 2, times 2 to the power of the whole number in the low bits of `shifted`, which
    /// is [`ROUND`] plus that number. Junk where the product is not a normal number.
    #[inline(always)]
    pub(super) fn times_power_of_two(self, shifted: Self) -> Self {
        // Adding to the exponent field multiplies. The shift leaves nothing of the bits of `ROUND`.
        Self(L::bits_f(L::iadd(L::f_bits(self.0), L::ishl(L::f_bits(shifted.0), 23))))
    }

    /// `value` where `self` is from `low` on and below `high`; 0 below, infinity above, NaN for NaN.
    #[inline(always)]
    pub(super) fn in_range(self, low: f32, high: f32, value: Self) -> Self {
        // NaN is not below `high`, and stays NaN when infinity is added.
        let not_above = self.lt(high).select(value, self + f32::INFINITY);
        self.lt(low).select(0.0, not_above)
    }

    /// `self` = 2^exponent (1 + x) with 1 + x from √½ to √2; junk unless `self` is positive and finite.
    #[inline(always)]
    pub(crate) fn split(self) -> (Self, Self) {
        /// The bits of √½: subtracted, they make the exponent field step there instead of at 1.
        const SQRT_HALF: i32 = 0x3f35_04f3;
        const EXPONENT_FIELD: i32 = 0xff80_0000_u32.cast_signed();
        let lanes = self.lanes();
        let subnormal = self.lt(f32::MIN_POSITIVE);
        let normal = subnormal.select(self * 8_388_608.0, self); // 2^23
        let bits = L::f_bits(normal.0);
        let steps = L::isub(bits, lanes.int(SQRT_HALF));
        let exponent = Self(L::to_f(L::ishr(steps, 23))) + subnormal.select(-23.0, 0.0);
        let mantissa = Self(L::bits_f(L::isub(bits, L::iand(steps, lanes.int(EXPONENT_FIELD)))));
        (exponent, mantissa - 1.0)
    }

    /// `value` where `self` is positive and finite, and a logarithm's other values elsewhere.
    #[inline(always)]
    pub(crate) fn logarithm_in_range(self, value: Self) -> Self {
        let below_infinity = self.lt(f32::INFINITY).select(value, self);
        self.le(0.0).select(self.lt(0.0).select(f32::NAN, f32::NEG_INFINITY), below_infinity)
    }
}
