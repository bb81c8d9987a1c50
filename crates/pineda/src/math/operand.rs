//! What may stand where a lane number or a lane vector is expected.

use super::{Real, Rgba, Vec2, Vec3, Vec4};
use crate::lanes::{Lanes, Scalar};

/// What may stand where a `T` at width `L` is expected: a `T`; a plain `f32` or array, the same for all lanes; or, where
/// `T` is a vector, a number for all its components.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be used where `{T}` is expected",
    label = "neither `{T}` nor a plain value that can be spread over its lanes",
    note = "a number is `f32` or `Real<L>`, a vector `[f32; N]` or `VecN<L>`; doubles want `as f32`, integers too"
)]
pub trait ToLanes<L: Lanes, T>: Copy {
    /// The value at the width of `lanes`.
    fn to_lanes(self, lanes: L) -> T;
}

impl<L: Lanes> ToLanes<L, Self> for Real<L> {
    #[inline(always)]
    fn to_lanes(self, _: L) -> Self {
        self
    }
}

impl<L: Lanes> ToLanes<L, Real<L>> for f32 {
    #[inline(always)]
    fn to_lanes(self, lanes: L) -> Real<L> {
        Real(lanes.splat(self))
    }
}

/// A plain number or array that becomes a lane type of its own: `f32` a [`Real`], `[f32; 3]` a [`Vec3`], ...
pub trait Splat<L: Lanes>: Copy {
    /// The lane type.
    type Output;
    /// The same value in every lane.
    fn splat(self, lanes: L) -> Self::Output;
}

impl<L: Lanes> Splat<L> for f32 {
    type Output = Real<L>;
    #[inline(always)]
    fn splat(self, lanes: L) -> Real<L> {
        Real(lanes.splat(self))
    }
}

macro_rules! vector_operands {
    ($vector:ident $n:literal: $($field:ident)+) => {
        impl<L: Lanes> ToLanes<L, Self> for $vector<L> {
            #[inline(always)]
            fn to_lanes(self, _: L) -> Self {
                self
            }
        }
        impl<L: Lanes> ToLanes<L, $vector<L>> for [f32; $n] {
            #[inline(always)]
            fn to_lanes(self, lanes: L) -> $vector<L> {
                let [$($field),+] = self;
                $vector { $($field: Real(lanes.splat($field))),+ }
            }
        }
        impl<L: Lanes> ToLanes<L, $vector<L>> for Real<L> {
            #[inline(always)]
            fn to_lanes(self, _: L) -> $vector<L> {
                $vector { $($field: self),+ }
            }
        }
        impl<L: Lanes> ToLanes<L, $vector<L>> for f32 {
            #[inline(always)]
            fn to_lanes(self, lanes: L) -> $vector<L> {
                let x = Real(lanes.splat(self));
                $vector { $($field: x),+ }
            }
        }
        impl From<[f32; $n]> for $vector<Scalar> {
            #[inline(always)]
            fn from(a: [f32; $n]) -> Self {
                a.to_lanes(Scalar)
            }
        }
        impl From<$vector<Scalar>> for [f32; $n] {
            #[inline(always)]
            fn from(v: $vector<Scalar>) -> Self {
                [$(v.$field.0),+]
            }
        }
    };
}

vector_operands!(Vec2 2: x y);
vector_operands!(Vec3 3: x y z);
vector_operands!(Vec4 4: x y z w);
vector_operands!(Rgba 4: r g b a);

macro_rules! splat_array {
    ($($vector:ident $n:literal),+) => {$(
        impl<L: Lanes> Splat<L> for [f32; $n] {
            type Output = $vector<L>;
            #[inline(always)]
            fn splat(self, lanes: L) -> $vector<L> {
                self.to_lanes(lanes)
            }
        }
    )+};
}

splat_array!(Vec2 2, Vec3 3, Vec4 4);
