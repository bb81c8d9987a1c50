//! What all vector types have, as macros: the declaration, operators, comparisons.

/// Declares a vector type: the newtype, its making from numbers, arrays and slices, and its storing.
macro_rules! vector {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident: [$lane:ty; $count:literal]) => {
        $(#[$attribute])*
        #[expect(non_camel_case_types, reason = "named as a number is")]
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        $visibility struct $name<S: Simd>(pub(super) fearless_simd::$name<S>);

        impl<S: Simd> $name<S> {
            /// From an array, lane by lane, or one number for all lanes.
            #[inline(always)]
            pub(crate) fn simd_from(simd: S, value: impl SimdInto<Self, S>) -> Self {
                value.simd_into(simd)
            }

            /// The permission to use the level's instructions.
            #[inline(always)]
            pub(crate) fn token(self) -> S {
                self.0.simd
            }

            #[inline(always)]
            pub(super) fn lanes(self) -> [$lane; $count] {
                self.0.into()
            }
        }

        impl<S: Simd> SimdFrom<$lane, S> for $name<S> {
            #[inline(always)]
            fn simd_from(simd: S, value: $lane) -> Self {
                by_level!(
                    Self(fearless_simd::$name::simd_from(simd, [value; $count])),
                    Self(fearless_simd::$name::splat(simd, value))
                )
            }
        }

        impl<S: Simd> From<$name<S>> for [$lane; $count] {
            #[inline(always)]
            fn from(vector: $name<S>) -> Self {
                vector.lanes()
            }
        }
    };
}

/// The value in every lane.
macro_rules! splat {
    ($($name:ident: $lane:ty;)+) => {$(
        impl<S: Simd> $name<S> {
            /// The value in every lane.
            #[inline(always)]
            pub(crate) fn splat(simd: S, value: $lane) -> Self {
                Self::simd_from(simd, value)
            }
        }
    )+};
}

/// Making vectors from arrays.
macro_rules! from_array {
    ($($name:ident: [$lane:ty; $count:literal];)+) => {$(
        impl<S: Simd> SimdFrom<[$lane; $count], S> for $name<S> {
            #[inline(always)]
            fn simd_from(simd: S, lanes: [$lane; $count]) -> Self {
                Self(fearless_simd::$name::simd_from(simd, lanes))
            }
        }
    )+};
}

/// Making packets from arrays, and from slices, which panics if the length is not the number of lanes.
///
/// Of two registers, each is loaded by itself: loaded whole, a packet that is only passed on is an array to the compiler, and goes through memory wherever it goes.
macro_rules! load {
    ($($name:ident: $lane:ty, $half:ident;)+) => {$(
        impl<S: Simd> $name<S> {
            /// Loads a slice. Panics if its length is not the number of lanes.
            #[inline(always)]
            pub(crate) fn from_slice(simd: S, lanes: &[$lane]) -> Self {
                if S::HAS_HALVES {
                    let (low, high) = lanes.split_at(8);
                    let low = fearless_simd::$half::from_slice(simd, low);
                    return Self(low.combine(fearless_simd::$half::from_slice(simd, high)));
                }
                Self(fearless_simd::$name::from_slice(simd, lanes))
            }
        }

        impl<S: Simd> SimdFrom<[$lane; 16], S> for $name<S> {
            #[inline(always)]
            fn simd_from(simd: S, lanes: [$lane; 16]) -> Self {
                if S::HAS_HALVES { Self::from_slice(simd, &lanes) } else { Self(fearless_simd::$name::simd_from(simd, lanes)) }
            }
        }
    )+};
}

/// Stores to slices. Panics if the length is not the number of lanes.
macro_rules! store_slice {
    ($($name:ident: $lane:ty;)+) => {$(
        impl<S: Simd> $name<S> {
            /// Stores to a slice. Panics if its length is not the number of lanes.
            #[inline(always)]
            pub(crate) fn store_slice(self, lanes: &mut [$lane]) {
                self.0.store_slice(lanes);
            }
        }
    )+};
}

/// Operators between vectors: the trait, its method, and what it does for one lane. Where not every level with vectors has an instruction: which ones do.
macro_rules! operators {
    ($name:ident, $count:literal: $($operator:tt)+) => {
        operators! { $name, $count, !S::IS_PLAIN => $($operator)+ }
    };
    ($name:ident, $count:literal, $has_vector:expr =>
        $($trait:ident::$method:ident = |$a:ident, $b:ident| $value:expr;)+
    ) => {$(
        impl<S: Simd> core::ops::$trait for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                by_level!(
                    $has_vector,
                    {
                        let ($a, $b) = (self.lanes(), other.lanes());
                        Self::simd_from(self.token(), each_lane!($count, |$a, $b| $value))
                    },
                    Self(core::ops::$trait::$method(self.0, other.0))
                )
            }
        }
    )+};
}

/// The same between a vector and one number.
macro_rules! scalar_operators {
    ($name:ident, $lane:ty: $($trait:ident::$method:ident)+) => {$(
        impl<S: Simd> core::ops::$trait<$lane> for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: $lane) -> Self {
                core::ops::$trait::$method(self, Self::simd_from(self.token(), other))
            }
        }
    )+};
}

/// Operators on one vector.
macro_rules! unary_operators {
    ($name:ident, $count:literal: $($trait:ident::$method:ident = |$a:ident| $value:expr;)+) => {$(
        impl<S: Simd> core::ops::$trait for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self) -> Self {
                by_level!(
                    {
                        let $a = self.lanes();
                        Self::simd_from(self.token(), each_lane!($count, |$a| $value))
                    },
                    Self(core::ops::$trait::$method(self.0))
                )
            }
        }
    )+};
}

/// Shifts of all lanes by the same number of bits, below 32. A right shift of signed numbers fills with the sign.
macro_rules! shifts {
    ($name:ident) => {
        impl<S: Simd> core::ops::Shl<u32> for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn shl(self, bits: u32) -> Self {
                by_level!(
                    {
                        let a = self.lanes();
                        Self::simd_from(self.token(), each_lane!(16, |a| a.wrapping_shl(bits)))
                    },
                    Self(self.0 << bits)
                )
            }
        }

        impl<S: Simd> core::ops::Shr<u32> for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn shr(self, bits: u32) -> Self {
                by_level!(
                    {
                        let a = self.lanes();
                        Self::simd_from(self.token(), each_lane!(16, |a| a.wrapping_shr(bits)))
                    },
                    Self(self.0 >> bits)
                )
            }
        }
    };
}

/// Methods of one vector and another, or one number for all lanes.
macro_rules! methods {
    ($name:ident, $count:literal: $($(#[$doc:meta])* $method:ident = |$a:ident, $b:ident| $value:expr;)+) => {
        impl<S: Simd> $name<S> {$(
            $(#[$doc])*
            #[inline(always)]
            pub(crate) fn $method(self, other: impl SimdInto<Self, S>) -> Self {
                let other: Self = other.simd_into(self.token());
                by_level!(
                    {
                        let ($a, $b) = (self.lanes(), other.lanes());
                        Self::simd_from(self.token(), each_lane!($count, |$a, $b| $value))
                    },
                    Self(self.0.$method(other.0))
                )
            }
        )+}
    };
}

/// Comparisons with another vector or one number. False for NaN.
macro_rules! comparisons {
    ($name:ident, $count:literal, $mask:ident, $word:ty: $($method:ident = $operator:tt;)+) => {
        impl<S: Simd> $name<S> {$(
            #[doc = concat!("The lanes where `self ", stringify!($operator), " other`.")]
            #[inline(always)]
            pub(crate) fn $method(self, other: impl SimdInto<Self, S>) -> $mask<S> {
                let other: Self = other.simd_into(self.token());
                by_level!(
                    {
                        let (a, b) = (self.lanes(), other.lanes());
                        // A mask's lanes are -1 and 0.
                        $mask::from_lanes(self.token(), each_lane!($count, |a, b| -<$word>::from(a $operator b)))
                    },
                    $mask(self.0.$method(other.0))
                )
            }
        )+}
    };
}

/// What types of sixteen 32-bit lanes have in common: they can be cast, compressed, and selected by a mask.
macro_rules! words {
    ($name:ident) => {
        impl<S: Simd> $name<S> {
            /// The same bits as another type of sixteen 32-bit lanes.
            #[inline(always)]
            pub(crate) fn bitcast<U: Words<S>>(self) -> U {
                U::from_bits(self.0.bitcast())
            }
        }

        impl<S: Simd> Words<S> for $name<S> {
            #[inline(always)]
            fn from_bits(bits: fearless_simd::u32x16<S>) -> Self {
                Self(bits.bitcast())
            }

            #[inline(always)]
            fn choose(mask: mask32x16<S>, yes: Self, no: Self) -> Self {
                by_level!(
                    {
                        let simd = yes.token();
                        let (mask, yes, no) = (mask.lanes(), yes.lanes(), no.lanes());
                        Self::simd_from(simd, each_lane!(16, |mask, yes, no| if mask != 0 { yes } else { no }))
                    },
                    Self(mask.0.select(yes.0, no.0))
                )
            }
        }
    };
}

/// The lanes that a mask names, moved to the front.
macro_rules! compress {
    ($($name:ident)+) => {$(
        impl<S: Simd> $name<S> {
            /// The lanes that the mask names, in order, from the first place on. What the places behind them hold depends on
            /// the level.
            #[inline(always)]
            pub(crate) fn compress(self, mask: mask32x16<S>) -> Self {
                by_level!(
                    Self::simd_from(self.token(), plain::compress(self.lanes(), mask.lanes())),
                    Self(self.0.compress(mask.0))
                )
            }
        }
    )+};
}
