//! Whole numbers per lane.

#![allow(clippy::suspicious_arithmetic_impl, reason = "shifts are by the lowest five bits")]

use super::{Bool, Real, Select, Splat, ToLanes};
use crate::lanes::{Dual, Lanes, Scalar};
use crate::shading::{Interpolation, Varyings};
use core::convert::identity;
use core::ops::{Add, BitAnd, BitOr, BitXor, Mul, Not, Shl, Shr, Sub};

/// One `i32` per lane.
///
/// `+ - *` wrap around; they, `& | ^` and the comparisons take another `Int<L>` or a plain `i32`. `<<` and `>>` shift all lanes by the same number
/// of bits, of which the lowest five count. As a varying it is always flat.
///
/// ```
/// use pineda::*;
/// let x = Int::<Scalar>::from(-7);
/// assert_eq!(i32::from((x >> 1) * 3), -12);
/// ```
pub struct Int<L: Lanes = Scalar>(pub(crate) L::I);

/// One `u32` per lane: ids, packed colours, hashes.
///
/// `+ - *` wrap around; they, `& | ^` and the comparisons take another `Uint<L>` or a plain `u32`. `<<` and `>>` shift all lanes by the same
/// number of bits, of which the lowest five count. As a varying it is always flat.
///
/// ```
/// use pineda::*;
/// #[shader]
/// fn hash<L: Lanes>(x: Uint<L>) -> Uint<L> {
///     let x = (x ^ (x >> 16)) * 0x7feb_352d;
///     x ^ (x >> 15)
/// }
/// assert_eq!(u32::from(hash(Uint::<Scalar>::from(1))), 0x7feb_cafb);
/// ```
pub struct Uint<L: Lanes = Scalar>(pub(crate) L::I);

macro_rules! integers {
    ($($name:ident $plain:ident $to_i:path, $from_i:path;)+) => {$(
        impl<L: Lanes> $name<L> {
            /// `x` in every lane. Inside a fragment stage [`Frag::splat`](crate::Frag::splat) is shorter.
            #[inline(always)]
            pub fn new(lanes: L, x: $plain) -> Self {
                Self(lanes.int($to_i(x)))
            }

            /// The width of this number.
            #[inline(always)]
            pub fn lanes(self) -> L {
                L::of(L::bits_f(self.0))
            }

            /// `self == b`.
            #[inline(always)]
            pub fn eq(self, b: impl ToLanes<L, Self>) -> Bool<L> {
                Bool(L::ieq(self.0, b.to_lanes(self.lanes()).0))
            }

            /// `self != b`.
            #[inline(always)]
            pub fn ne(self, b: impl ToLanes<L, Self>) -> Bool<L> {
                !self.eq(b)
            }

            /// `self < b`.
            #[inline(always)]
            pub fn lt(self, b: impl ToLanes<L, Self>) -> Bool<L> {
                Self::is_less(self, b.to_lanes(self.lanes()))
            }

            /// `self <= b`.
            #[inline(always)]
            pub fn le(self, b: impl ToLanes<L, Self>) -> Bool<L> {
                !Self::is_less(b.to_lanes(self.lanes()), self)
            }

            /// `self > b`.
            #[inline(always)]
            pub fn gt(self, b: impl ToLanes<L, Self>) -> Bool<L> {
                Self::is_less(b.to_lanes(self.lanes()), self)
            }

            /// `self >= b`.
            #[inline(always)]
            pub fn ge(self, b: impl ToLanes<L, Self>) -> Bool<L> {
                !Self::is_less(self, b.to_lanes(self.lanes()))
            }
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
                self.0.fmt(f)
            }
        }

        impl Default for $name<Scalar> {
            fn default() -> Self {
                Self(0)
            }
        }
        impl PartialEq for $name<Scalar> {
            fn eq(&self, b: &Self) -> bool {
                self.0 == b.0
            }
        }
        impl From<$plain> for $name<Scalar> {
            #[inline(always)]
            fn from(x: $plain) -> Self {
                Self($to_i(x))
            }
        }
        impl From<$name<Scalar>> for $plain {
            #[inline(always)]
            fn from(x: $name<Scalar>) -> Self {
                $from_i(x.0)
            }
        }

        impl<L: Lanes> ToLanes<L, Self> for $name<L> {
            #[inline(always)]
            fn to_lanes(self, _: L) -> Self {
                self
            }
        }
        impl<L: Lanes> ToLanes<L, $name<L>> for $plain {
            #[inline(always)]
            fn to_lanes(self, lanes: L) -> $name<L> {
                $name::new(lanes, self)
            }
        }
        impl<L: Lanes> Splat<L> for $plain {
            type Output = $name<L>;
            #[inline(always)]
            fn splat(self, lanes: L) -> $name<L> {
                $name::new(lanes, self)
            }
        }

        impl<L: Lanes, B: ToLanes<L, Self>> Select<L, B> for $name<L> {
            type Output = Self;
            #[inline(always)]
            fn select(m: Bool<L>, a: Self, b: B) -> Self {
                Self(L::iselect(m.0, a.0, b.to_lanes(L::of_mask(m.0)).0))
            }
        }
        impl<L: Lanes> Select<L, $name<L>> for $plain {
            type Output = $name<L>;
            #[inline(always)]
            fn select(m: Bool<L>, a: Self, b: $name<L>) -> $name<L> {
                $name(L::iselect(m.0, L::of_mask(m.0).int($to_i(a)), b.0))
            }
        }

        integers!(@ $name $plain: Add add iadd, Sub sub isub, Mul mul imul, BitAnd bitand iand, BitOr bitor ior, BitXor bitxor ixor);

        impl<L: Lanes> Not for $name<L> {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                self ^ $plain::MIN ^ $plain::MAX
            }
        }

        impl<L: Lanes> Shl<u32> for $name<L> {
            type Output = Self;
            #[inline(always)]
            fn shl(self, bits: u32) -> Self {
                Self(L::ishl(self.0, bits & 31))
            }
        }

        /// The provoking vertex's value, bit by bit.
        impl<L: Lanes> Varyings<L> for $name<L> {
            type At<M: Lanes> = $name<M>;
            const LEN: usize = 1;
            const INTERPOLATION: &'static [Interpolation] = &[Interpolation::Flat];
            #[inline(always)]
            fn read(lanes: L, rows: &[f32]) -> Self {
                Self(lanes.load_int(bytemuck::must_cast_slice(rows)))
            }
            #[inline(always)]
            fn write(self, rows: &mut [f32]) {
                L::store_int(self.0, bytemuck::must_cast_slice_mut(rows));
            }
            #[inline(always)]
            fn with_derivatives(self, _: Self, _: Self) -> $name<Dual<L>> {
                $name(self.0)
            }
        }
    )+};
    (@ $name:ident $plain:ident: $($operator:ident $function:ident $lanes:ident),+) => {$(
        impl<L: Lanes, B: ToLanes<L, Self>> $operator<B> for $name<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: B) -> Self {
                Self(L::$lanes(self.0, b.to_lanes(self.lanes()).0))
            }
        }
        impl<L: Lanes> $operator<$name<L>> for $plain {
            type Output = $name<L>;
            #[inline(always)]
            fn $function(self, b: $name<L>) -> $name<L> {
                $name(L::$lanes(b.lanes().int($name::<Scalar>::from(self).0), b.0))
            }
        }
    )+};
}

integers! {
    Int i32 identity, identity;
    Uint u32 u32::cast_signed, i32::cast_unsigned;
}

impl<L: Lanes> Int<L> {
    #[inline(always)]
    fn is_less(a: Self, b: Self) -> Bool<L> {
        Bool(L::ilt(a.0, b.0))
    }

    /// The same bits without a sign.
    #[inline(always)]
    pub fn to_uint(self) -> Uint<L> {
        Uint(self.0)
    }

    /// The nearest float, halves to even.
    #[inline(always)]
    pub fn to_real(self) -> Real<L> {
        Real(L::to_f(self.0))
    }
}

impl<L: Lanes> Uint<L> {
    #[inline(always)]
    fn is_less(a: Self, b: Self) -> Bool<L> {
        let (a, b) = (a ^ (1 << 31), b ^ (1 << 31));
        Bool(L::ilt(a.0, b.0))
    }

    /// The same bits with a sign.
    #[inline(always)]
    pub fn to_int(self) -> Int<L> {
        Int(self.0)
    }

    /// The nearest float, halves to even.
    #[inline(always)]
    pub fn to_real(self) -> Real<L> {
        // Both halves and the product are exact; the sum is rounded once.
        (self >> 16).to_int().to_real() * 65_536.0 + (self & 0xffff).to_int().to_real()
    }
}

impl<L: Lanes> Shr<u32> for Int<L> {
    type Output = Self;
    /// Fills with the sign.
    #[inline(always)]
    fn shr(self, bits: u32) -> Self {
        Self(L::ishr(self.0, bits & 31))
    }
}

impl<L: Lanes> Shr<u32> for Uint<L> {
    type Output = Self;
    /// Fills with zeros.
    #[inline(always)]
    fn shr(self, bits: u32) -> Self {
        Self(L::ishr(self.0, bits & 31)) & (u32::MAX >> (bits & 31))
    }
}

impl<L: Lanes> Real<L> {
    /// Towards zero, as Rust's `as i32`: 0 of NaN, and the nearest that there is of what does not fit.
    #[inline(always)]
    pub fn to_int(self) -> Int<L> {
        Int(L::to_i(self.0))
    }

    /// Towards zero, as Rust's `as u32`: 0 of NaN and below 0, `u32::MAX` of what is too large.
    #[inline(always)]
    pub fn to_uint(self) -> Uint<L> {
        const HALF: f32 = 2_147_483_648.0;
        let upper = ((self - HALF).to_int().to_uint()) ^ (1 << 31);
        let lower = self.max(0.0).to_int().to_uint();
        self.ge(2.0 * HALF).select(u32::MAX, self.ge(HALF).select(upper, lower))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Packet;
    use crate::lanes::conformance::shader_levels;
    use crate::wide::dispatch_shader;

    const NUMBERS: [u32; 16] = [
        0,
        1,
        2,
        3,
        31,
        65_535,
        65_536,
        16_777_217,
        0x7fff_ffff,
        0x8000_0000,
        0x8000_0001,
        0xfedc_ba98,
        u32::MAX,
        77,
        0xffff_ff7f,
        0x0100_0081,
    ];

    #[inline(always)]
    fn uint<L: Lanes>(lanes: L, numbers: &[u32]) -> Uint<L> {
        Uint(lanes.load_int(bytemuck::must_cast_slice(numbers)))
    }

    /// Everything that can be done with two numbers, as numbers.
    #[inline(always)]
    fn all<L: Lanes>(lanes: L, a: &[u32], b: &[u32]) -> Vec<Vec<u32>> {
        let (a, b) = (uint(lanes, a), uint(lanes, b));
        let (i, j) = (a.to_int(), b.to_int());
        let yes = |mask: Bool<L>| mask.select(uint(lanes, &[1; 16]), 0);
        let float = |x: Real<L>| Uint(L::f_bits(x.0));
        let results = [
            a + b,
            a - b,
            a * b,
            a & b,
            a | b,
            a ^ b,
            !a,
            a << 5,
            a >> 5,
            7 - a,
            yes(a.lt(b)),
            yes(a.le(b)),
            yes(a.gt(b)),
            yes(a.ge(b)),
            yes(a.eq(b)),
            yes(a.ne(b)),
            (i + j).to_uint(),
            (i - j).to_uint(),
            (i * j).to_uint(),
            (i & j).to_uint(),
            (i | j).to_uint(),
            (i ^ j).to_uint(),
            (!i).to_uint(),
            (i << 5).to_uint(),
            (i >> 5).to_uint(),
            (7 - i).to_uint(),
            yes(i.lt(j)),
            yes(i.le(j)),
            yes(i.gt(j)),
            yes(i.ge(j)),
            yes(i.eq(j)),
            yes(i.ne(j)),
            float(a.to_real()),
            float(i.to_real()),
            Real(L::bits_f(a.0)).to_uint(),
            Real(L::bits_f(a.0)).to_int().to_uint(),
            a.to_real().to_uint(),
            i.to_real().to_int().to_uint(),
        ];
        let numbers = |x: Uint<L>| {
            let mut row = vec![0; L::N];
            L::store_int(x.0, &mut row);
            row.into_iter().map(i32::cast_unsigned).collect()
        };
        results.map(numbers).into()
    }

    /// The same by plain Rust.
    fn plain(a: u32, b: u32) -> Vec<u32> {
        let (i, j, yes) = (a as i32, b as i32, u32::from);
        let float = f32::from_bits(a);
        vec![
            a.wrapping_add(b),
            a.wrapping_sub(b),
            a.wrapping_mul(b),
            a & b,
            a | b,
            a ^ b,
            !a,
            a << 5,
            a >> 5,
            7u32.wrapping_sub(a),
            yes(a < b),
            yes(a <= b),
            yes(a > b),
            yes(a >= b),
            yes(a == b),
            yes(a != b),
            a.wrapping_add(b),
            a.wrapping_sub(b),
            a.wrapping_mul(b),
            a & b,
            a | b,
            a ^ b,
            !a,
            (i << 5) as u32,
            (i >> 5) as u32,
            7i32.wrapping_sub(i) as u32,
            yes(i < j),
            yes(i <= j),
            yes(i > j),
            yes(i >= j),
            yes(i == j),
            yes(i != j),
            (a as f32).to_bits(),
            (i as f32).to_bits(),
            float as u32,
            float as i32 as u32,
            a as f32 as u32,
            i as f32 as i32 as u32,
        ]
    }

    #[test]
    fn numbers_in_lanes_are_those_of_rust() {
        let floats = [0.0, -0.0, -1.5, 0.99, 1.0, 2.5e9, 2_147_483_648.0, 4_294_967_040.0, 4_294_967_296.0, f32::NAN];
        let mut numbers = NUMBERS.to_vec();
        numbers.extend(floats.map(f32::to_bits));
        numbers.extend(
            [f32::INFINITY, f32::NEG_INFINITY, 2_147_483_520.0, 1e-40, -2_147_483_648.0, 3e38].map(f32::to_bits),
        );
        for shift in 0..numbers.len() {
            let b: Vec<u32> = numbers.iter().cycle().skip(shift).take(numbers.len()).copied().collect();
            for (a, b) in numbers.chunks(16).zip(b.chunks(16)) {
                let wanted: Vec<Vec<u32>> = a.iter().zip(b).map(|(&a, &b)| plain(a, b)).collect();
                for lane in 0..16 {
                    let found = all(Scalar, &a[lane..=lane], &b[lane..=lane]);
                    let found: Vec<u32> = found.into_iter().map(|row| row[0]).collect();
                    assert_eq!(found, wanted[lane], "{} {}", a[lane], b[lane]);
                }
                for level in shader_levels() {
                    let found = dispatch_shader!(level, simd => all(Packet(simd), a, b));
                    for (k, row) in found.iter().enumerate() {
                        let wanted: Vec<u32> = wanted.iter().map(|all| all[k]).collect();
                        assert_eq!(*row, wanted, "{level:?}, operation {k}");
                    }
                }
            }
        }
    }
}
