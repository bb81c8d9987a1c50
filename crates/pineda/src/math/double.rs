//! An `f64` per lane: what the functions of this module compute with where an `f32` would lose the last bit.
//!
//! A sum or product in `f64` costs two of `f32`, and is 2^29 times as exact. Where an algorithm in `f32` needs pairs of numbers for its
//! result to be right to the last place, this is quicker, and reads better.

use super::Real;
use crate::lanes::Lanes;
use core::ops::{Add, Div, Mul, Sub};

/// A double per lane. Plain `f64` stand on the right of every operator.
pub(super) struct Double<L: Lanes>(L::D);

impl<L: Lanes> Double<L> {
    /// The nearest `f32`.
    #[inline(always)]
    pub(super) fn round(self) -> Real<L> {
        Real(L::narrow(self.0))
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Self(L::dsqrt(self.0))
    }

    #[inline(always)]
    fn lanes(self) -> L {
        L::of_double(self.0)
    }
}

impl<L: Lanes> Real<L> {
    /// The same number as a double.
    #[inline(always)]
    pub(super) fn double(self) -> Double<L> {
        Double(L::widen(self.0))
    }
}

impl<L: Lanes> Clone for Double<L> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<L: Lanes> Copy for Double<L> {}

macro_rules! operators {
    ($($operator:ident $function:ident $lanes:ident)+) => {$(
        impl<L: Lanes> $operator for Double<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: Self) -> Self {
                Self(L::$lanes(self.0, b.0))
            }
        }
        impl<L: Lanes> $operator<f64> for Double<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: f64) -> Self {
                Self(L::$lanes(self.0, self.lanes().double(b)))
            }
        }
    )+};
}

operators!(Add add dadd Sub sub dsub Mul mul dmul Div div ddiv);

/// c0 + x (c1 + x (c2 + ...)) of a double, rounded after every step.
macro_rules! polynomial {
    ($x:expr; $last:expr) => { $last };
    ($x:expr; $next:expr, $last:expr) => { $x * $last + $next };
    ($x:expr; $next:expr, $($rest:expr),+) => { polynomial!($x; $($rest),+) * $x + $next };
}
pub(super) use polynomial;
