//! Floats.

use super::int::{i32x16, i64x8};
use super::level::Simd;
use super::mask::{Words, mask32x16, mask64x8};
use super::plain;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::Level;
use fearless_simd::prelude::*;

vector! {
    /// Sixteen `f32`.
    pub struct f32x16: [f32; 16]
}
vector! {
    /// Eight `f64`.
    pub(crate) struct f64x8: [f64; 8]
}

splat! { f32x16: f32; f64x8: f64; }
load! { f32x16: f32, f32x8; }
from_array! { f64x8: [f64; 8]; }
store_slice! { f32x16: f32; }
words! { f32x16 }
compress! { f32x16 }

operators! { f32x16, 16:
    Add::add = |a, b| a + b;
    Sub::sub = |a, b| a - b;
    Mul::mul = |a, b| a * b;
    Div::div = |a, b| a / b;
}
operators! { f64x8, 8:
    Add::add = |a, b| a + b;
    Sub::sub = |a, b| a - b;
    Mul::mul = |a, b| a * b;
    Div::div = |a, b| a / b;
}
scalar_operators! { f32x16, f32: Add::add Sub::sub Mul::mul }
scalar_operators! { f64x8, f64: Add::add Sub::sub Mul::mul }
unary_operators! { f32x16, 16: Neg::neg = |a| -a; }

comparisons! { f32x16, 16, mask32x16, i32:
    simd_lt = <;
    simd_le = <=;
    simd_gt = >;
    simd_ge = >=;
    simd_eq = ==;
}
comparisons! { f64x8, 8, mask64x8, i64: simd_le = <=; }

macro_rules! functions {
    ($name:ident, $count:literal: $($(#[$doc:meta])* $method:ident;)+) => {
        impl<S: Simd> $name<S> {$(
            $(#[$doc])*
            #[inline(always)]
            pub(crate) fn $method(self) -> Self {
                by_level!(
                    {
                        let a = self.lanes();
                        Self::simd_from(self.token(), each_lane!($count, |a| a.$method()))
                    },
                    Self(self.0.$method())
                )
            }
        )+}
    };
}

functions! { f32x16, 16:
    /// The absolute value.
    abs;
    /// The square root, correctly rounded.
    sqrt;
}
functions! { f64x8, 8:
    /// The absolute value.
    abs;
    /// The square root, correctly rounded.
    sqrt;
}

/// Sixteen `f64`: one for each lane of a packet.
#[expect(non_camel_case_types, reason = "named as a number is")]
#[derive(Clone, Copy, Debug)]
pub struct f64x16<S: Simd> {
    low: f64x8<S>,
    high: f64x8<S>,
}

macro_rules! halves {
    ($($trait:ident::$method:ident)+) => {$(
        impl<S: Simd> core::ops::$trait for f64x16<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { low: self.low.$method(other.low), high: self.high.$method(other.high) }
            }
        }
    )+};
}

halves! { Add::add Sub::sub Mul::mul Div::div }

impl<S: Simd> f64x16<S> {
    /// The permission to use the level's instructions.
    #[inline(always)]
    pub(crate) fn token(self) -> S {
        self.low.token()
    }

    /// The value in every lane.
    #[inline(always)]
    pub(crate) fn splat(simd: S, value: f64) -> Self {
        let half = f64x8::splat(simd, value);
        Self { low: half, high: half }
    }

    /// The square root, correctly rounded.
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        Self { low: self.low.sqrt(), high: self.high.sqrt() }
    }

    /// The nearest `f32` of each lane, ties to even.
    #[inline(always)]
    pub(crate) fn narrow(self) -> f32x16<S> {
        self.low.narrow(self.high)
    }

    /// The same numbers.
    #[inline(always)]
    pub(crate) fn from_f32(lanes: f32x16<S>) -> Self {
        let (low, high) = lanes.widen();
        Self { low, high }
    }
}

impl<S: Simd> f32x16<S> {
    /// The larger of the two, and `other` where either is NaN or both are zeros: `self > other ? self : other`.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        if S::MAX_COMPARES { Self(self.0.max(other.0)) } else { self.simd_gt(other).select(self, other) }
    }

    /// The smaller of the two, and `other` where either is NaN or both are zeros: `self < other ? self : other`.
    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        if S::MAX_COMPARES { Self(self.0.min(other.0)) } else { self.simd_lt(other).select(self, other) }
    }

    /// The largest whole number that is not larger.
    #[inline(always)]
    pub(crate) fn floor(self) -> Self {
        // SSE2 has no instruction for it, and sixteen calls of the C library's function take ten times as long as this.
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if matches!(self.token().level(), Level::Sse2(_)) {
            return self.floor_by_conversion();
        }
        by_level!(
            {
                let a = self.lanes();
                Self::simd_from(self.token(), each_lane!(16, |a| a.floor()))
            },
            Self(self.0.floor())
        )
    }

    /// The floor by way of integers, for levels without an instruction for it.
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    #[inline(always)]
    fn floor_by_conversion(self) -> Self {
        // From 2^23 on every float is whole, and stays; so does NaN, which is not below. What the conversion makes of
        // numbers that do not fit is therefore never seen.
        let has_fraction = self.abs().simd_lt(8_388_608.0);
        let truncated = self.to_int().to_float();
        let one_too_high = self.simd_lt(truncated);
        let simd = self.token();
        let floor = truncated - one_too_high.select(Self::splat(simd, 1.0), Self::splat(simd, 0.0));
        // Only for -0 does this change a thing: anything else of negative sign has a negative floor already.
        let sign = self.bitcast::<i32x16<S>>() & i32::MIN;
        has_fraction.select((floor.bitcast::<i32x16<S>>() | sign).bitcast(), self)
    }

    /// Rounds towards zero. What becomes of NaN and of numbers that `i32` does not hold depends on the level.
    #[inline(always)]
    pub(crate) fn to_int(self) -> i32x16<S> {
        by_level!(self.to_int_precise(), i32x16(fearless_simd::i32x16::truncate_from(self.0)))
    }

    /// `as i32`: rounds towards zero, saturates, and makes 0 of NaN.
    #[inline(always)]
    pub(crate) fn to_int_precise(self) -> i32x16<S> {
        by_level!(
            {
                let a = self.lanes();
                i32x16::simd_from(self.token(), each_lane!(16, |a| a as i32))
            },
            i32x16(fearless_simd::i32x16::truncate_from_precise(self.0))
        )
    }

    /// The first and the last eight lanes, exactly.
    #[inline(always)]
    pub(crate) fn widen(self) -> (f64x8<S>, f64x8<S>) {
        by_level!(
            {
                let (low, high) = plain::halves(self.lanes());
                let simd = self.token();
                (
                    f64x8::simd_from(simd, each_lane!(8, |low| f64::from(low))),
                    f64x8::simd_from(simd, each_lane!(8, |high| f64::from(high))),
                )
            },
            {
                let (low, high) = self.0.widen();
                (f64x8(low), f64x8(high))
            }
        )
    }
}

impl<S: Simd> f64x8<S> {
    /// Its lanes and then those of `high`, rounded to the nearest `f32`, ties to even.
    #[inline(always)]
    pub(crate) fn narrow(self, high: Self) -> f32x16<S> {
        by_level!(
            {
                let (a, b) = (self.lanes(), high.lanes());
                let lanes: [f32; 16] = plain::combine(each_lane!(8, |a| a as f32), each_lane!(8, |b| b as f32));
                f32x16::simd_from(self.token(), lanes)
            },
            f32x16(self.0.narrow(high.0))
        )
    }

    /// The same bits as integers.
    #[inline(always)]
    pub(crate) fn bitcast(self) -> i64x8<S> {
        i64x8(self.0.bitcast())
    }
}
