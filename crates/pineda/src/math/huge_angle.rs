//! Angles of many turns: the exact remainder, however large the angle (Payne and Hanek 1983, "Radian reduction for trigonometric
//! functions"; Ng 1992, "Good to the last bit").
//!
//! A float is a whole number of 24 bits times a power of two. Of its product with 2/π only what is left of whole turns counts, so the bits of 2/π that
//! make whole turns can be left out before it is multiplied: a window of 128 bits of 2/π, two of them above the point, times the 24 bits, modulo
//! 2^128. The nearest float to a multiple of a quarter turn is 2^-31 quarters away from it; the product is right to 2^-102.

use core::f64::consts::FRAC_PI_2;

/// A whole zero, and the 256 bits of 2/π after the point.
const TWO_OVER_PI: [u32; 9] =
    [0, 0xa2f9_836e, 0x4e44_1529, 0xfc27_57d1, 0xf534_ddc0, 0xdb62_9599, 0x3c43_9041, 0xfe51_63ab, 0xdebb_c561];

/// Quadrants and the angles from their middles, in radians: each the sum of two floats.
pub(super) struct Reduced {
    pub(super) quadrants: [i32; 16],
    pub(super) high: [f32; 16],
    pub(super) low: [f32; 16],
}

/// Angles must be 0, or at least 2^18 and finite; for others it is junk. Not inlined: hardly a picture ever comes here.
#[cold]
#[inline(never)]
pub(super) fn reduce(angles: [f32; 16]) -> Reduced {
    let mut reduced = Reduced { quadrants: [0; 16], high: [0.0; 16], low: [0.0; 16] };
    for (lane, angle) in angles.into_iter().enumerate() {
        if angle > 0.0 {
            let (quadrant, x) = remainder(angle);
            reduced.quadrants[lane] = quadrant;
            reduced.high[lane] = x as f32;
            reduced.low[lane] = (x - f64::from(reduced.high[lane])) as f32;
        }
    }
    reduced
}

fn remainder(angle: f32) -> (i32, f64) {
    let bits = angle.to_bits();
    let mantissa = u128::from(bits & 0x007f_ffff | 0x0080_0000);
    // The bit of weight 2^w stands at 31 - w. The angle is mantissa * 2^exponent, so a bit of 2/π of weight 2^(1 - exponent) is a half turn; that of 30 + exponent
    // comes first. The exponent is the field less 150, and may be negative.
    let first = (bits >> 23) as usize - 120;
    let (word, shift) = (first / 32, first % 32);
    let part = |k: usize| u128::from(TWO_OVER_PI[word + k]);
    let four = part(0) << 96 | part(1) << 64 | part(2) << 32 | part(3);
    let window = four << shift | part(4) << shift >> 32;
    let product = window.wrapping_mul(mantissa);
    let quadrant = product.wrapping_add(1 << 125) >> 126;
    let rest = product.wrapping_sub(quadrant << 126).cast_signed();
    (quadrant as i32, rest as f64 * (FRAC_PI_2 / (1_u128 << 126) as f64))
}
