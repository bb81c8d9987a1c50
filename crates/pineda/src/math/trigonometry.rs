//! Sine and cosine, from polynomials of our own: the same bits everywhere, as in `exponential.rs`.
//!
//! The angle is brought to within an eighth of a turn of 0 by subtracting a multiple of a quarter turn (Cody and
//! Waite: the quarter turn comes in four parts, of which the first three have so few bits that their multiples are
//! exact), and the quadrant says which polynomial, and with which sign. The fits: `tools/minimax.py`.

#![expect(
    clippy::excessive_precision,
    reason = "the parts of pi / 2 are written with the digits that their derivation gave"
)]

use super::Real;
use super::exponential::{ROUND, horner};
use crate::lanes::Lanes;
use core::f32::consts::FRAC_2_PI;

/// π/2 in four parts: down to 2^-10, to 2^-21, to 2^-32, and 24 bits more.
const QUARTER: [f32; 4] = [1.570_312_5, 4.835_128_8e-4, 3.138_557_1e-7, 6.077_100_6e-11];

/// Angles beyond are taken for 0: there, neighbouring floats are so far apart that no digit of a sine is left to a
/// shader, and the number of quarter turns must fit the low bits of [`ROUND`].
const LARGEST: f32 = 1_048_576.0; // 2^20

impl<L: Lanes> Real<L> {
    /// The sine of `self` radians, to 2.5 ULP within ±8192. Beyond, the error grows as the spacing of the angles does, and
    /// beyond ±2^20 the result is 0. It is always from -1 to 1; NaN for infinities and NaN.
    #[inline(always)]
    pub fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// The cosine of `self` radians: as exact as [`sin`](Self::sin); beyond ±2^20 the result is 1.
    #[inline(always)]
    pub fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// Sine and cosine of `self` radians, for the price of one and a half.
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        let lanes = self.lanes();
        // An infinity times 0 is NaN.
        let angle = self.abs().le(LARGEST).select(self, self * 0.0);
        let shifted = angle * FRAC_2_PI + ROUND;
        let quarters = shifted - ROUND;
        let x =
            ((angle - quarters * QUARTER[0]) - quarters * QUARTER[1]) - quarters * QUARTER[2] - quarters * QUARTER[3];

        let z = x * x;
        let sin = x + x * z * horner!(z; -0.166_666_55, 0.008_332_178, -0.000_195_172_98);
        let cos = (1.0 - 0.5 * z) + z * z * horner!(z; 0.041_666_646, -0.001_388_731_6, 2.443_315_7e-5);

        let quadrant = L::f_bits(shifted.0);
        let odd = L::ieq(L::iand(quadrant, lanes.int(1)), lanes.int(1));
        let (first, second) = (L::select(odd, cos.0, sin.0), L::select(odd, sin.0, cos.0));
        // Quadrants 2 and 3 turn the sine's sign, 1 and 2 the cosine's: bit 1 of the quadrant, and of the next one.
        let sign = lanes.int(i32::MIN);
        let sin_sign = L::iand(L::ishl(quadrant, 30), sign);
        let cos_sign = L::iand(L::ishl(L::iadd(quadrant, lanes.int(1)), 30), sign);
        let sin = Self(L::bits_f(L::ixor(L::f_bits(first), sin_sign)));
        let cos = Self(L::bits_f(L::ixor(L::f_bits(second), cos_sign)));
        (sin.with_slope(self, cos), cos.with_slope(self, -sin))
    }
}
