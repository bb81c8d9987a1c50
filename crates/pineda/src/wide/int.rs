//! Integers.

use super::float::f32x16;
use super::level::Simd;
use super::mask::{Words, mask32x16};
use super::plain;
use fearless_simd::prelude::*;

vector! {
    /// Sixteen `i32`.
    pub struct i32x16: [i32; 16]
}
vector! {
    /// Sixteen `u32`.
    pub(crate) struct u32x16: [u32; 16]
}
vector! {
    /// Eight `i64`.
    pub(crate) struct i64x8: [i64; 8]
}
vector! {
    /// Eight `u32`.
    pub(crate) struct u32x8: [u32; 8]
}
vector! {
    /// Four `u32`.
    pub(crate) struct u32x4: [u32; 4]
}

splat! { i32x16: i32; u32x16: u32; }
load! { i32x16: i32, i32x8; u32x16: u32, u32x8; }
from_array! { i64x8: [i64; 8]; u32x8: [u32; 8]; u32x4: [u32; 4]; }
store_slice! { i32x16: i32; u32x16: u32; }
words! { i32x16 }
words! { u32x16 }
compress! { i32x16 u32x16 }

operators! { i32x16, 16:
    Add::add = |a, b| a.wrapping_add(b);
    Sub::sub = |a, b| a.wrapping_sub(b);
    BitAnd::bitand = |a, b| a & b;
    BitOr::bitor = |a, b| a | b;
    BitXor::bitxor = |a, b| a ^ b;
}
operators! { i32x16, 16, S::MULTIPLIES => Mul::mul = |a, b| a.wrapping_mul(b); }
// By as many bits as the other vector says, lane by lane; below 32.
operators! { i32x16, 16, S::SHIFTS_EACH => Shl::shl = |a, b| a.wrapping_shl(b as u32); }
operators! { u32x16, 16:
    Add::add = |a, b| a.wrapping_add(b);
    Sub::sub = |a, b| a.wrapping_sub(b);
    BitAnd::bitand = |a, b| a & b;
    BitOr::bitor = |a, b| a | b;
}
operators! { u32x16, 16, S::MULTIPLIES => Mul::mul = |a, b| a.wrapping_mul(b); }
operators! { i64x8, 8: Sub::sub = |a, b| a.wrapping_sub(b); }
scalar_operators! { i32x16, i32: Add::add Sub::sub Mul::mul BitAnd::bitand BitOr::bitor BitXor::bitxor }
scalar_operators! { u32x16, u32: Add::add Sub::sub Mul::mul BitAnd::bitand BitOr::bitor }
unary_operators! { i32x16, 16: Neg::neg = |a| a.wrapping_neg(); }
shifts! { i32x16 }
shifts! { u32x16 }

methods! { i32x16, 16:
    /// The smaller of the two.
    min = |a, b| if a < b { a } else { b };
    /// The larger of the two.
    max = |a, b| if a > b { a } else { b };
}

methods! { u32x16, 16:
    /// The larger of the two.
    max = |a, b| if a > b { a } else { b };
}

comparisons! { i32x16, 16, mask32x16, i32:
    simd_lt = <;
    simd_le = <=;
    simd_gt = >;
    simd_ge = >=;
    simd_eq = ==;
}
comparisons! { u32x16, 16, mask32x16, i32:
    simd_lt = <;
    simd_gt = >;
    simd_ge = >=;
    simd_eq = ==;
}

impl<S: Simd> i32x16<S> {
    /// The nearest `f32`, ties to even.
    #[inline(always)]
    pub(crate) fn to_float(self) -> f32x16<S> {
        by_level!(
            {
                let a = self.lanes();
                f32x16::simd_from(self.token(), each_lane!(16, |a| a as f32))
            },
            f32x16(fearless_simd::f32x16::float_from(self.0))
        )
    }

    /// The whole products of the first and of the last eight lanes.
    #[inline(always)]
    pub(crate) fn widening_mul(self, other: Self) -> (i64x8<S>, i64x8<S>) {
        by_level!(
            {
                let ((a, b), (c, d)) = (plain::halves(self.lanes()), plain::halves(other.lanes()));
                let simd = self.token();
                (
                    i64x8::simd_from(simd, each_lane!(8, |a, c| i64::from(a) * i64::from(c))),
                    i64x8::simd_from(simd, each_lane!(8, |b, d| i64::from(b) * i64::from(d))),
                )
            },
            {
                let (low, high) = self.0.widening_mul(other.0);
                (i64x8(low), i64x8(high))
            }
        )
    }
}

impl<S: Simd> u32x16<S> {
    /// The lanes of both in turn: those of the first halves, and those of the second halves.
    #[inline(always)]
    pub(crate) fn interleave(self, other: Self) -> (Self, Self) {
        by_level!(
            {
                let (low, high) = plain::interleave(self.lanes(), other.lanes());
                (Self::simd_from(self.token(), low), Self::simd_from(self.token(), high))
            },
            {
                let (low, high) = self.0.interleave(other.0);
                (Self(low), Self(high))
            }
        )
    }

    /// The even lanes of one, then of the other.
    #[inline(always)]
    pub(crate) fn unzip_low(self, other: Self) -> Self {
        by_level!(
            Self::simd_from(self.token(), plain::every_second(self.lanes(), other.lanes(), 0)),
            Self(self.0.unzip_low(other.0))
        )
    }

    /// The odd lanes of one, then of the other.
    #[inline(always)]
    pub(crate) fn unzip_high(self, other: Self) -> Self {
        by_level!(
            Self::simd_from(self.token(), plain::every_second(self.lanes(), other.lanes(), 1)),
            Self(self.0.unzip_high(other.0))
        )
    }
}

impl<S: Simd> u32x16<S> {
    /// Lane `lane`, as [`pick`](Self::pick) takes it: the places of its bytes.
    #[inline(always)]
    pub(crate) const fn place(lane: u32) -> u32 {
        lane * 0x0404_0404 + 0x0302_0100
    }

    /// For each lane, that one of these lanes whose [`place`](Self::place) is given.
    #[inline(always)]
    pub(crate) fn pick(self, places: Self) -> Self {
        by_level!(
            {
                let (a, places) = (self.lanes(), places.lanes());
                Self::simd_from(self.token(), each_lane!(16, |places| a[(places as usize / 4) & 15]))
            },
            Self(self.0.swizzle_dyn(places.0.bitcast::<fearless_simd::u8x64<S>>()))
        )
    }

    /// The same four lanes, four times.
    #[inline(always)]
    pub(crate) fn repeat(four: u32x4<S>) -> Self {
        let eight = four.combine(four);
        eight.combine(eight)
    }

    /// For each lane, that one of the four lanes it is among whose [`place`](Self::place), from 0 to 3, is given.
    #[inline(always)]
    pub(crate) fn pick_in_fours(self, places: Self) -> Self {
        by_level!(
            {
                let (mut lanes, places) = (self.lanes(), places.lanes());
                let mut k = 0;
                while k < 16 {
                    lanes[k] = self.lanes()[(k & 12) | (places[k] as usize / 4) & 3];
                    k += 1;
                }
                Self::simd_from(self.token(), lanes)
            },
            Self(self.0.swizzle_dyn_within_blocks(places.0.bitcast::<fearless_simd::u8x64<S>>()))
        )
    }
}

impl<S: Simd> u32x4<S> {
    /// The lanes of both in turn.
    #[inline(always)]
    fn interleave(self, other: Self) -> (Self, Self) {
        by_level!(
            {
                let (a, b) = (self.lanes(), other.lanes());
                let four = |lanes: [u32; 4]| Self::simd_from(self.token(), lanes);
                (four([a[0], b[0], a[1], b[1]]), four([a[2], b[2], a[3], b[3]]))
            },
            {
                let (low, high) = self.0.interleave(other.0);
                (Self(low), Self(high))
            }
        )
    }
}

impl<S: Simd> u32x8<S> {
    /// The lanes of both in turn, four by four: of the first halves, then of the second. With AVX2 one instruction for each result, where across halves it is two.
    ///
    /// Only where the level [has halves](Simd::HAS_HALVES).
    #[inline(always)]
    fn interleave(self, other: Self) -> (Self, Self) {
        let (first, second) = self.0.interleave(other.0);
        let ((a, b), (c, d)) = (first.split(), second.split());
        (Self(a.combine(c)), Self(b.combine(d)))
    }
}

macro_rules! transpose {
    ($($name:ident)+) => {$(
        impl<S: Simd> $name<S> {
            /// Rows of four words to columns.
            #[inline(always)]
            pub(crate) fn transpose([a, b, c, d]: [Self; 4]) -> [Self; 4] {
                let ((ac, ac_high), (bd, bd_high)) = (a.interleave(c), b.interleave(d));
                let ((first, second), (third, fourth)) = (ac.interleave(bd), ac_high.interleave(bd_high));
                [first, second, third, fourth]
            }
        }
    )+};
}

transpose! { u32x4 u32x8 }

impl<S: Simd> i64x8<S> {
    /// The low words of its lanes and then of those of `high`.
    #[inline(always)]
    pub(crate) fn narrow(self, high: Self) -> i32x16<S> {
        by_level!(
            {
                let (a, b) = (self.lanes(), high.lanes());
                let lanes: [i32; 16] = plain::combine(each_lane!(8, |a| a as i32), each_lane!(8, |b| b as i32));
                i32x16::simd_from(self.token(), lanes)
            },
            i32x16(self.0.narrow(high.0))
        )
    }
}

macro_rules! combine {
    ($($half:ident => $whole:ident;)+) => {$(
        impl<S: Simd> $half<S> {
            /// Its lanes and then those of `high`.
            #[inline(always)]
            pub(crate) fn combine(self, high: Self) -> $whole<S> {
                by_level!(
                    $whole::simd_from(self.token(), plain::combine(self.lanes(), high.lanes())),
                    $whole(self.0.combine(high.0))
                )
            }
        }
    )+};
}

combine! { u32x4 => u32x8; u32x8 => u32x16; }
