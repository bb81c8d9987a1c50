//! Colours of whole numbers, for targets that hold such.

use super::{Int, Splat, ToLanes, Uint};
use crate::lanes::{Dual, Lanes, Scalar};
use crate::shading::{Interpolation, Varyings};

macro_rules! colors {
    ($($(#[$doc:meta])* $name:ident $number:ident $plain:ident;)+) => {$(
        $(#[$doc])*
        pub struct $name<L: Lanes = Scalar> {
            /// Red.
            pub r: $number<L>,
            /// Green.
            pub g: $number<L>,
            /// Blue.
            pub b: $number<L>,
            /// Alpha.
            pub a: $number<L>,
        }

        impl<L: Lanes> Clone for $name<L> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }
        impl<L: Lanes> Copy for $name<L> {}

        impl<L: Lanes> core::fmt::Debug for $name<L> {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_list().entries([self.r, self.g, self.b, self.a]).finish()
            }
        }

        impl<L: Lanes> ToLanes<L, $name<L>> for [$plain; 4] {
            #[inline(always)]
            fn to_lanes(self, lanes: L) -> $name<L> {
                let [r, g, b, a] = self;
                $name {
                    r: $number::new(lanes, r),
                    g: $number::new(lanes, g),
                    b: $number::new(lanes, b),
                    a: $number::new(lanes, a),
                }
            }
        }
        impl<L: Lanes> Splat<L> for [$plain; 4] {
            type Output = $name<L>;
            #[inline(always)]
            fn splat(self, lanes: L) -> $name<L> {
                self.to_lanes(lanes)
            }
        }
        impl From<[$plain; 4]> for $name<Scalar> {
            #[inline(always)]
            fn from(a: [$plain; 4]) -> Self {
                a.to_lanes(Scalar)
            }
        }

        impl<L: Lanes> Varyings<L> for $name<L> {
            type At<M: Lanes> = $name<M>;
            const LEN: usize = 4;
            const INTERPOLATION: &'static [Interpolation] = &[Interpolation::Flat; 4];
            #[inline(always)]
            fn read(lanes: L, rows: &[f32]) -> Self {
                Self {
                    r: $number::read(lanes, rows),
                    g: $number::read(lanes, &rows[L::N..]),
                    b: $number::read(lanes, &rows[2 * L::N..]),
                    a: $number::read(lanes, &rows[3 * L::N..]),
                }
            }
            #[inline(always)]
            fn write(self, rows: &mut [f32]) {
                self.r.write(rows);
                self.g.write(&mut rows[L::N..]);
                self.b.write(&mut rows[2 * L::N..]);
                self.a.write(&mut rows[3 * L::N..]);
            }
            #[inline(always)]
            fn with_derivatives(self, dx: Self, dy: Self) -> $name<Dual<L>> {
                $name {
                    r: self.r.with_derivatives(dx.r, dy.r),
                    g: self.g.with_derivatives(dx.g, dy.g),
                    b: self.b.with_derivatives(dx.b, dy.b),
                    a: self.a.with_derivatives(dx.a, dy.a),
                }
            }
        }
    )+};
}

colors! {
    /// Four unsigned integers per lane, for the format [`Rgba32U`](crate::ColorBuffer::Rgba32U) and its like.
    ///
    /// ```
    /// use pineda::*;
    /// let codes = RgbaU::<Scalar>::from([1, 2, 3, u32::MAX]);
    /// assert_eq!(u32::from(codes.a), u32::MAX);
    /// ```
    RgbaU Uint u32;
    /// Four signed integers per lane, for the format [`Rgba32I`](crate::ColorBuffer::Rgba32I) and its like.
    ///
    /// ```
    /// use pineda::*;
    /// let codes = RgbaI::<Scalar>::from([1, 2, 3, i32::MIN]);
    /// assert_eq!(i32::from(codes.a), i32::MIN);
    /// ```
    RgbaI Int i32;
}
