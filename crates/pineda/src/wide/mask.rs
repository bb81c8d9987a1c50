//! Masks: a yes or no for each lane.

use super::level::Simd;
use super::plain;
use fearless_simd::prelude::*;

/// A type of sixteen 32-bit lanes.
pub(crate) trait Words<S: Simd>: Copy {
    /// The vector with these bits.
    fn from_bits(bits: fearless_simd::u32x16<S>) -> Self;
    /// `yes` in the mask's lanes, `no` in the others.
    fn choose(mask: mask32x16<S>, yes: Self, no: Self) -> Self;
}

macro_rules! mask {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident: [$lane:ty; $count:literal]) => {
        $(#[$attribute])*
        #[expect(non_camel_case_types, reason = "named as a number is")]
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        $visibility struct $name<S: Simd>(pub(super) fearless_simd::$name<S>);

        impl<S: Simd> $name<S> {
            /// -1 where the mask holds, 0 elsewhere.
            #[inline(always)]
            pub(super) fn lanes(self) -> [$lane; $count] {
                self.0.into()
            }

            /// From -1 and 0.
            #[inline(always)]
            pub(super) fn from_lanes(simd: S, lanes: [$lane; $count]) -> Self {
                Self(fearless_simd::$name::simd_from(simd, lanes))
            }

            /// A bit for each lane, the first lane's the lowest.
            #[inline(always)]
            pub(crate) fn to_bitmask(self) -> u64 {
                by_level!(
                    {
                        let lanes = self.lanes();
                        let mut bits = 0;
                        let mut k = 0;
                        while k < $count {
                            bits |= u64::from(lanes[k] != 0) << k;
                            k += 1;
                        }
                        bits
                    },
                    self.0.to_bitmask()
                )
            }
        }
    };
}

mask! {
    /// A yes or no for each of sixteen 32-bit lanes.
    pub struct mask32x16: [i32; 16]
}
mask! {
    /// A yes or no for each of eight 64-bit lanes.
    pub(crate) struct mask64x8: [i64; 8]
}

impl<S: Simd> mask32x16<S> {
    /// The permission to use the level's instructions.
    #[inline(always)]
    pub(crate) fn token(self) -> S {
        self.0.token()
    }

    /// The same for every lane.
    #[inline(always)]
    pub(crate) fn splat(simd: S, value: bool) -> Self {
        by_level!(Self::from_lanes(simd, [-i32::from(value); 16]), Self(fearless_simd::mask32x16::splat(simd, value)))
    }

    /// From a bit for each lane, the first lane's the lowest; higher ones are ignored.
    #[inline(always)]
    pub(crate) fn from_bitmask(simd: S, bits: u64) -> Self {
        by_level!(
            {
                let mut lanes = [0; 16];
                let mut k = 0;
                while k < 16 {
                    lanes[k] = -i32::from(bits >> k & 1 != 0);
                    k += 1;
                }
                Self::from_lanes(simd, lanes)
            },
            Self(fearless_simd::mask32x16::from_bitmask(simd, bits))
        )
    }

    /// `yes` in the mask's lanes, `no` in the others.
    #[inline(always)]
    pub(crate) fn select<V: Words<S>>(self, yes: V, no: V) -> V {
        V::choose(self, yes, no)
    }

    /// Whether it holds for any lane.
    #[inline(always)]
    pub(crate) fn any_true(self) -> bool {
        by_level!(
            {
                let lanes = self.lanes();
                let mut any = 0;
                let mut k = 0;
                while k < 16 {
                    any |= lanes[k];
                    k += 1;
                }
                any != 0
            },
            self.0.any_true()
        )
    }

    /// Whether it holds for no lane.
    #[inline(always)]
    pub(crate) fn all_false(self) -> bool {
        by_level!(!self.any_true(), self.0.all_false())
    }
}

macro_rules! mask_operators {
    ($($trait:ident::$method:ident = |$a:ident, $b:ident| $value:expr;)+) => {$(
        impl<S: Simd> core::ops::$trait for mask32x16<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                by_level!(
                    {
                        let ($a, $b) = (self.lanes(), other.lanes());
                        Self::from_lanes(self.token(), each_lane!(16, |$a, $b| $value))
                    },
                    Self(core::ops::$trait::$method(self.0, other.0))
                )
            }
        }
    )+};
}

mask_operators! {
    BitAnd::bitand = |a, b| a & b;
    BitOr::bitor = |a, b| a | b;
    BitXor::bitxor = |a, b| a ^ b;
}

impl<S: Simd> core::ops::Not for mask32x16<S> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        by_level!(
            {
                let a = self.lanes();
                Self::from_lanes(self.token(), each_lane!(16, |a| !a))
            },
            Self(!self.0)
        )
    }
}
