//! Hashes of integers: random numbers that depend on nothing but where one is.
//!
//! One number by Wellons' `lowbias32` ("Prospecting for hash functions", 2018); two to four at once by PCG2D, 3D and 4D (Jarzynski and Olano 2020, "Hash functions for
//! GPU rendering", JCGT 9(3)), whose outputs are as many. Multiplications, additions, shifts: the same bits everywhere.

use crate::lanes::Lanes;
use crate::math::{Real, Uint};

/// PCG's multiplier and increment (Numerical Recipes' generator).
const MULTIPLIER: u32 = 1_664_525;
const INCREMENT: u32 = 1_013_904_223;

/// A random number from one number; different numbers give different ones.
///
/// ```
/// use pineda::{noise, Scalar, Uint};
/// assert_eq!(noise::hash1(Uint::<Scalar>::from(1)), Uint::from(0x6889_90c0));
/// ```
#[inline(always)]
pub fn hash1<L: Lanes>(x: Uint<L>) -> Uint<L> {
    let x = (x ^ (x >> 16)) * 0x7feb_352d_u32;
    let x = (x ^ (x >> 15)) * 0x846c_a68b_u32;
    x ^ (x >> 16)
}

/// Two random numbers from two; different pairs give different ones.
#[inline(always)]
pub fn hash2<L: Lanes>(v: [Uint<L>; 2]) -> [Uint<L>; 2] {
    let [x, y] = v;
    let (mut x, mut y) = (x * MULTIPLIER + INCREMENT, y * MULTIPLIER + INCREMENT);
    let mut round = 0;
    while round < 2 {
        x = x + y * MULTIPLIER;
        y = y + x * MULTIPLIER;
        (x, y) = (x ^ (x >> 16), y ^ (y >> 16));
        round += 1;
    }
    [x, y]
}

/// Three random numbers from three; different triples give different ones.
#[inline(always)]
pub fn hash3<L: Lanes>(v: [Uint<L>; 3]) -> [Uint<L>; 3] {
    let [x, y, z] = v;
    let (x, y, z) = (x * MULTIPLIER + INCREMENT, y * MULTIPLIER + INCREMENT, z * MULTIPLIER + INCREMENT);
    let x = x + y * z;
    let y = y + z * x;
    let z = z + x * y;
    let (x, y, z) = (x ^ (x >> 16), y ^ (y >> 16), z ^ (z >> 16));
    let x = x + y * z;
    let y = y + z * x;
    [x, y, z + x * y]
}

/// Four random numbers from four; different quadruples give different ones.
#[inline(always)]
pub fn hash4<L: Lanes>(v: [Uint<L>; 4]) -> [Uint<L>; 4] {
    let [x, y, z, w] = v;
    let (x, y) = (x * MULTIPLIER + INCREMENT, y * MULTIPLIER + INCREMENT);
    let (z, w) = (z * MULTIPLIER + INCREMENT, w * MULTIPLIER + INCREMENT);
    let x = x + y * w;
    let y = y + z * x;
    let z = z + x * y;
    let w = w + y * z;
    let (x, y, z, w) = (x ^ (x >> 16), y ^ (y >> 16), z ^ (z >> 16), w ^ (w >> 16));
    let x = x + y * w;
    let y = y + z * x;
    let z = z + x * y;
    [x, y, z, w + y * z]
}

impl<L: Lanes> Uint<L> {
    /// From 0 up to, but not, 1: the upper 24 bits as a fraction, so that a random number becomes a random float.
    #[inline(always)]
    pub fn to_unit(self) -> Real<L> {
        (self >> 8).to_int().to_real() * (1.0 / 16_777_216.0)
    }

    /// The float with these bits.
    #[inline(always)]
    pub fn bits_to_real(self) -> Real<L> {
        Real(L::bits_f(self.0))
    }
}

impl<L: Lanes> Real<L> {
    /// The bits of the float, to be hashed, for example. 0 and -0 differ; all NaNs are one here, for what a computed one holds depends on
    /// the platform.
    #[inline(always)]
    pub fn to_bits(self) -> Uint<L> {
        self.is_nan().select(Uint::new(self.lanes(), f32::NAN.to_bits()), Uint(L::f_bits(self.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;
    use crate::lanes::conformance::conformance;

    fn numbers<const N: usize>(found: [Uint<Scalar>; N]) -> [u32; N] {
        found.map(u32::from)
    }

    /// The definitions in the paper's words, in plain Rust.
    fn pcg3d(v: [u32; 3]) -> [u32; 3] {
        let mut v = v.map(|x| x.wrapping_mul(1664525).wrapping_add(1013904223));
        for round in 0..2 {
            for (a, b, c) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
                v[a] = v[a].wrapping_add(v[b].wrapping_mul(v[c]));
            }
            if round == 0 {
                v = v.map(|x| x ^ (x >> 16));
            }
        }
        v
    }

    #[test]
    fn hashes_are_those_of_their_papers() {
        for (x, y, z) in [(0, 0, 0), (1, 2, 3), (u32::MAX, 7, 0x8000_0000)] {
            assert_eq!(numbers(hash3([x, y, z].map(Uint::<Scalar>::from))), pcg3d([x, y, z]));
        }
        assert_eq!(u32::from(hash1(Uint::<Scalar>::from(0))), 0);
    }

    #[test]
    fn every_bit_turns_half_of_the_others() {
        /// The first output, of as many of the numbers as the hash takes.
        type Hash = fn([u32; 4]) -> u32;
        let hashes: [Hash; 4] = [
            |[x, ..]| hash1(Uint::<Scalar>::from(x)).into(),
            |[x, y, ..]| hash2([x, y].map(Uint::<Scalar>::from))[0].into(),
            |[x, y, z, _]| hash3([x, y, z].map(Uint::<Scalar>::from))[0].into(),
            |v| hash4(v.map(Uint::<Scalar>::from))[0].into(),
        ];
        for (last, hash) in hashes.into_iter().enumerate() {
            for (input, bit) in (0..=last).flat_map(|input| (0..16).map(move |bit| (input, bit))) {
                let turned = (0..512).map(|n| {
                    let v = [n, n * 7, n ^ 0x155, n / 3];
                    let mut changed = v;
                    changed[input] ^= 1 << bit;
                    (hash(v) ^ hash(changed)).count_ones()
                });
                let part = turned.sum::<u32>() as f32 / (512.0 * 32.0);
                assert!((0.4..0.6).contains(&part), "bit {bit} of number {input} of {last} turns {part}");
            }
        }
    }

    #[test]
    fn hashes_have_the_same_bits_at_every_level() {
        conformance! {
            check_in_shaders &crate::lanes::conformance::pairs();
            int hash1<L>(lanes, a, b) = hash1(Uint::<L>(a)).0;
            int hash2<L>(lanes, a, b) = hash2([Uint::<L>(a), Uint(b)])[1].0;
            int hash3<L>(lanes, a, b) = hash3([Uint::<L>(a), Uint(b), Uint(a) + 3])[2].0;
            int hash4<L>(lanes, a, b) = hash4([Uint::<L>(a), Uint(b), Uint(a) + 3, Uint(b) ^ 7])[3].0;
            float to_unit<L>(lanes, a, b) = Uint::<L>(L::f_bits(a)).to_unit().0;
            to_int to_bits<L>(lanes, a, b) = Real::<L>(L::sub(a, b)).to_bits().0;
        }
        assert_eq!(f32::from(Uint::<Scalar>::from(u32::MAX).to_unit()), 0.999_999_94);
    }
}
