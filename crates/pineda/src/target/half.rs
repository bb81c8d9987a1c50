//! 16-bit floats (IEEE 754 binary16): to the nearest, ties to even, and back exactly.
//!
//! The bits of a half are those of an f32 with 13 bits of mantissa less and another bias of the exponent (Giesen 2012, "Float->half variants"). Adding
//! half of what is cut off, and one more where the last bit that stays is odd, rounds; a carry goes into the exponent, as it should. Halves below
//! 2^-14 are multiples of 2^-24, which is what an f32 in 1/2 to 1 is a multiple of, too: there one IEEE 754 addition of 1/2 rounds, and subtracting 2^-14
//! undoes what reading them as normal numbers did. No instruction for halves is used: kinds of processors differ in what they make of NaN.

use crate::wide::{Simd, f32x16, u32x16};

/// The exponents' biases, 127 and 15, apart.
pub(crate) const REBIAS: u32 = (127 - 15) << 23;
/// 2^-14, the smallest normal half, as an f32.
pub(crate) const SMALLEST_NORMAL: u32 = (127 - 14) << 23;
/// 65520, from which on the nearest half is infinity: half way from the largest to what would come next.
const OVERFLOW: u32 = 0x477f_f000;
const F32_INFINITY: u32 = 0x7f80_0000;
const INFINITY: u32 = 0x7c00;
/// What every NaN becomes.
const NAN: u32 = 0x7e00;
/// The shifted exponent of infinities and NaN.
pub(crate) const SPECIAL: u32 = 31 << 23;

/// The bits of the 16-bit float (IEEE 754 binary16) that is nearest to `x`, halves to even: what the formats `R16F`, `Rg16F` and `Rgba16F` of
/// [`ColorBuffer`](crate::ColorBuffer) store.
///
/// From 65520 on it is infinity. Every NaN becomes 0x7e00.
///
/// ```
/// use pineda::{f16_to_f32, f32_to_f16};
/// assert_eq!(f32_to_f16(1.0), 0x3c00);
/// assert_eq!(f32_to_f16(1e6), 0x7c00);
/// assert_eq!(f16_to_f32(f32_to_f16(0.1)), 0.099975586);
/// ```
#[must_use]
pub fn f32_to_f16(x: f32) -> u16 {
    let bits = x.to_bits();
    let (sign, size) = (bits >> 16 & 0x8000, bits & 0x7fff_ffff);
    let half = match size {
        0..SMALLEST_NORMAL => (f32::from_bits(size) + 0.5).to_bits() - 0.5f32.to_bits(),
        SMALLEST_NORMAL..OVERFLOW => (size - REBIAS + 0xfff + (size >> 13 & 1)) >> 13,
        OVERFLOW..=F32_INFINITY => INFINITY,
        _ => return NAN as u16,
    };
    (half | sign) as u16
}

/// The number that a 16-bit float stands for, exactly; see [`f32_to_f16`].
#[must_use]
pub fn f16_to_f32(bits: u16) -> f32 {
    let bits = u32::from(bits);
    let (sign, size) = ((bits & 0x8000) << 16, (bits & 0x7fff) << 13);
    let float = match size {
        0..0x80_0000 => (f32::from_bits(size + SMALLEST_NORMAL) - f32::from_bits(SMALLEST_NORMAL)).to_bits(),
        0x80_0000..SPECIAL => size + REBIAS,
        _ => size + 2 * REBIAS,
    };
    f32::from_bits(float | sign)
}

/// [`f32_to_f16`] in the lanes.
#[inline(always)]
pub(crate) fn to_half<S: Simd>(s: S, x: f32x16<S>) -> u32x16<S> {
    let constant = |bits: u32| u32x16::splat(s, bits);
    let bits: u32x16<S> = x.bitcast();
    let (sign, size) = ((bits >> 16) & 0x8000, bits & 0x7fff_ffff);
    let small = (size.bitcast::<f32x16<S>>() + 0.5).bitcast::<u32x16<S>>() - 0.5f32.to_bits();
    let normal = (((size - REBIAS) + 0xfff) + ((size >> 13) & 1)) >> 13;
    let half = size.simd_lt(SMALLEST_NORMAL).select(small, normal);
    let half = size.simd_ge(OVERFLOW).select(constant(INFINITY), half) | sign;
    size.simd_gt(F32_INFINITY).select(constant(NAN), half)
}

/// [`f16_to_f32`] of the low halves of the lanes.
#[inline(always)]
pub(crate) fn from_half<S: Simd>(s: S, bits: u32x16<S>) -> f32x16<S> {
    let (sign, size) = ((bits & 0x8000) << 16, (bits & 0x7fff) << 13);
    let smallest = f32x16::splat(s, f32::from_bits(SMALLEST_NORMAL));
    let small = (size + SMALLEST_NORMAL).bitcast::<f32x16<S>>() - smallest;
    let other = size + size.simd_ge(SPECIAL).select(u32x16::splat(s, 2 * REBIAS), u32x16::splat(s, REBIAS));
    (size.simd_lt(0x80_0000).select(small.bitcast(), other) | sign).bitcast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::conformance::levels;
    use crate::wide::dispatch;

    fn by_the_crate(x: f32) -> u16 {
        if x.is_nan() { 0x7e00 } else { half::f16::from_f32(x).to_bits() }
    }

    /// Every half, what lies half-way to the next, both as near as f32 can tell, and floats of all sizes.
    fn floats() -> Vec<f32> {
        let mut floats = vec![f32::MAX, f32::MIN, f32::MIN_POSITIVE, 1e-45, 65_519.99, 65_520.0, 65_536.0, 2e-8, 3e-8];
        for bits in 0..=u16::MAX {
            let here = half::f16::from_bits(bits).to_f32();
            let next = half::f16::from_bits(bits.wrapping_add(1)).to_f32();
            for x in [here, (here + next) / 2.0] {
                floats.extend([x, f32::from_bits(x.to_bits() ^ 1), f32::from_bits(x.to_bits().wrapping_sub(1))]);
            }
        }
        let mut bits = 1u32;
        for _ in 0..1 << 18 {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            floats.push(f32::from_bits(bits ^ bits >> 15));
            // Of the sizes that halves have.
            floats.push(f32::from_bits((bits & 0x8fff_ffff) + 0x3280_0000));
        }
        floats.resize(floats.len().next_multiple_of(16), 1.0);
        floats
    }

    #[test]
    fn numbers_are_converted_as_ieee_754_has_it() {
        for x in floats() {
            assert_eq!(f32_to_f16(x), by_the_crate(x), "{x:?} {:08x}", x.to_bits());
        }
        for bits in 0..=u16::MAX {
            let (found, wanted) = (f16_to_f32(bits), half::f16::from_bits(bits).to_f32());
            assert!(found.to_bits() == wanted.to_bits() || (found.is_nan() && wanted.is_nan()), "{bits:04x}");
            assert_eq!(f32_to_f16(found), if wanted.is_nan() { 0x7e00 } else { bits });
        }
    }

    #[test]
    fn lanes_convert_as_numbers_do() {
        let floats = floats();
        for level in levels() {
            for x in floats.as_chunks::<16>().0 {
                let mut found = [0; 16];
                dispatch!(level, s => to_half(s, f32x16::simd_from(s, *x)).store_slice(&mut found));
                assert_eq!(found, x.map(|x| f32_to_f16(x).into()), "{x:?}");
            }
            for first in (0..=u16::MAX).step_by(16) {
                let bits = std::array::from_fn(|k| u32::from(first) + k as u32);
                let mut found = [0.0; 16];
                dispatch!(level, s => from_half(s, u32x16::simd_from(s, bits)).store_slice(&mut found));
                assert_eq!(found.map(f32::to_bits), bits.map(|bits| f16_to_f32(bits as u16).to_bits()), "{first:04x}");
            }
        }
    }
}
