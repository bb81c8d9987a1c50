//! The width that a piece of code runs at: one fragment, or a packet of sixteen.
//!
//! Everything in `pineda` that touches many pixels is written once, generic over `L: Lanes`. With [`Scalar`] it is
//! ordinary `f32` code: the reference. With [`Packet`] each number is sixteen numbers in vector registers, at the
//! SIMD level that the token `S` stands for. Both give the same bits, lane for lane, on every platform; a conformance
//! suite (`lanes/conformance.rs`) holds each level to that, operation by operation.
//!
//! Three rules make the promise possible, and three more keep it fast:
//!
//! * only IEEE 754's correctly rounded operations: `+ - * /`, square root, comparison. No fused multiply-add, no
//!   reciprocal estimates;
//! * minimum and maximum are a comparison and a select, because the instructions treat NaN and -0 differently;
//! * conversions to integers saturate as Rust's `as` does, because the instructions differ out of range;
//! * every function is `#[inline(always)]`: a function that is not inlined is compiled without the SIMD level's
//!   instructions, and one such call made a kernel six times slower in a trial. Long ones are functions all the same, by
//!   way of [`Lanes::apart`], which keeps the level (`#[shader(apart)]`);
//! * no closures and no iterator chains in lane code, for the same reason;
//! * a packet is always sixteen lanes, whatever the registers' size, so that the packing of pixels never depends on
//!   the machine.

mod dual;
mod packet;
mod scalar;

#[cfg(test)]
pub(crate) mod conformance;

use core::fmt::Debug;

pub use dual::{Dual, DualF};
pub use packet::Packet;
pub use scalar::Scalar;

pub(crate) mod sealed {
    /// Keeps [`Lanes`](super::Lanes) to the two widths whose bits are proved equal.
    pub trait Sealed {}
}

/// How many fragments a piece of code handles at once, and the operations on that many numbers.
///
/// It is a type parameter of shaders and of the numbers in them ([`Real`](crate::Real), [`Vec3`](crate::Vec3), ...);
/// a shader never calls the functions below itself, but uses the methods and operators of those numbers.
///
/// The trait is sealed: [`Scalar`] (one lane) and [`Packet`] (sixteen lanes) implement it, and [`Dual`] of either, whose numbers know their derivatives. Lanes are
/// numbered from 0.
/// A value of the implementing type is the permission to use the instructions of its SIMD level.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a lane width",
    note = "write `fn name<L: Lanes>(...)` and use `Real<L>`, `Vec3<L>`, ... inside; `L` is `Scalar` or `Packet<_>`"
)]
pub trait Lanes: sealed::Sealed + Copy + Debug + Send + Sync + 'static {
    /// One `f32` per lane.
    type F: Copy + Debug + Send + Sync + 'static;
    /// One yes or no per lane.
    type M: Copy + Debug + Send + Sync + 'static;
    /// One `i32` per lane.
    type I: Copy + Debug + Send + Sync + 'static;

    /// One `f64` per lane, for the inner steps of functions: twice the work of an `f32`.
    type D: Copy + Debug + Send + Sync + 'static;

    /// The number of lanes: 1 or 16.
    const N: usize;

    /// The width that `a` was made at.
    fn of(a: Self::F) -> Self;
    /// The width that `m` was made at.
    fn of_mask(m: Self::M) -> Self;
    /// The width that `a` was made at.
    fn of_double(a: Self::D) -> Self;

    /// What the closure returns, from a function of its own that is compiled with the level's instructions: for what is too long to be inlined wherever it is used.
    fn apart<R>(self, f: impl FnOnce() -> R) -> R;

    /// `x` in every lane.
    fn splat(self, x: f32) -> Self::F;
    /// The first [`N`](Self::N) numbers of `a`. Panics if there are fewer.
    fn load(self, a: &[f32]) -> Self::F;
    /// Writes the lanes to the first [`N`](Self::N) places of `out`. Panics if there are fewer.
    fn store(a: Self::F, out: &mut [f32]);
    /// 0, 1, 2, ...: each lane's own number.
    fn iota(self) -> Self::F;

    /// `a + b`.
    fn add(a: Self::F, b: Self::F) -> Self::F;
    /// `a - b`.
    fn sub(a: Self::F, b: Self::F) -> Self::F;
    /// `a * b`.
    fn mul(a: Self::F, b: Self::F) -> Self::F;
    /// `a / b`, correctly rounded.
    fn div(a: Self::F, b: Self::F) -> Self::F;
    /// `-a`: the sign bit flipped, of NaN and zero too.
    fn neg(a: Self::F) -> Self::F;
    /// `|a|`: the sign bit cleared, of NaN and zero too.
    fn abs(a: Self::F) -> Self::F;
    /// The square root, correctly rounded; NaN below zero, and -0 of -0.
    fn sqrt(a: Self::F) -> Self::F;
    /// The largest whole number that is not above `a`; -0, infinities and NaN stay.
    fn floor(a: Self::F) -> Self::F;

    /// `x` in every lane.
    fn double(self, x: f64) -> Self::D;
    /// The same numbers as `f64`.
    fn widen(a: Self::F) -> Self::D;
    /// The nearest `f32` of each lane, ties to even.
    fn narrow(a: Self::D) -> Self::F;
    /// `a + b`.
    fn dadd(a: Self::D, b: Self::D) -> Self::D;
    /// `a - b`.
    fn dsub(a: Self::D, b: Self::D) -> Self::D;
    /// `a * b`.
    fn dmul(a: Self::D, b: Self::D) -> Self::D;
    /// `a / b`, correctly rounded.
    fn ddiv(a: Self::D, b: Self::D) -> Self::D;
    /// The square root, correctly rounded; NaN below zero.
    fn dsqrt(a: Self::D) -> Self::D;

    /// `a < b`; false where either is NaN.
    fn lt(a: Self::F, b: Self::F) -> Self::M;
    /// `a <= b`; false where either is NaN.
    fn le(a: Self::F, b: Self::F) -> Self::M;
    /// `a == b`; false where either is NaN, and true for 0 and -0.
    fn eq(a: Self::F, b: Self::F) -> Self::M;
    /// `a` where `m` is set, `b` elsewhere; never a mixture of their bits.
    fn select(m: Self::M, a: Self::F, b: Self::F) -> Self::F;

    /// `a` where it is larger, `b` elsewhere: also where either is NaN, or both are zeros.
    #[inline(always)]
    fn max(a: Self::F, b: Self::F) -> Self::F {
        Self::select(Self::lt(b, a), a, b)
    }
    /// `a` where it is smaller, `b` elsewhere: also where either is NaN, or both are zeros.
    #[inline(always)]
    fn min(a: Self::F, b: Self::F) -> Self::F {
        Self::select(Self::lt(a, b), a, b)
    }

    /// The mask whose lane `i` is bit `i` of `bits`; bits from [`N`](Self::N) up are ignored.
    fn mask(self, bits: u32) -> Self::M;
    /// Bit `i` is lane `i`; bits from [`N`](Self::N) up are 0.
    fn mask_bits(m: Self::M) -> u32;
    /// Both.
    fn and(a: Self::M, b: Self::M) -> Self::M;
    /// Either.
    fn or(a: Self::M, b: Self::M) -> Self::M;
    /// One, not both.
    fn xor(a: Self::M, b: Self::M) -> Self::M;
    /// The other lanes.
    fn not(a: Self::M) -> Self::M;
    /// Whether any lane is set.
    fn any(a: Self::M) -> bool;

    /// `x` in every lane.
    fn int(self, x: i32) -> Self::I;
    /// The first [`N`](Self::N) integers of `a`. Panics if there are fewer.
    fn load_int(self, a: &[i32]) -> Self::I;
    /// Writes the lanes to the first [`N`](Self::N) places of `out`. Panics if there are fewer.
    fn store_int(a: Self::I, out: &mut [i32]);
    /// `a + b`, wrapping.
    fn iadd(a: Self::I, b: Self::I) -> Self::I;
    /// `a - b`, wrapping.
    fn isub(a: Self::I, b: Self::I) -> Self::I;
    /// `a * b`, wrapping.
    fn imul(a: Self::I, b: Self::I) -> Self::I;
    /// `a & b`, bit by bit.
    fn iand(a: Self::I, b: Self::I) -> Self::I;
    /// `a | b`, bit by bit.
    fn ior(a: Self::I, b: Self::I) -> Self::I;
    /// `a ^ b`, bit by bit.
    fn ixor(a: Self::I, b: Self::I) -> Self::I;
    /// `a << bits`; `bits` must be at most 31.
    fn ishl(a: Self::I, bits: u32) -> Self::I;
    /// `a >> bits`, filling with the sign; `bits` must be at most 31.
    fn ishr(a: Self::I, bits: u32) -> Self::I;
    /// `a == b`.
    fn ieq(a: Self::I, b: Self::I) -> Self::M;
    /// `a < b`, signed.
    fn ilt(a: Self::I, b: Self::I) -> Self::M;
    /// `a` where `m` is set, `b` elsewhere.
    fn iselect(m: Self::M, a: Self::I, b: Self::I) -> Self::I;

    /// Towards zero, as Rust's `as i32`: NaN gives 0, and what does not fit gives `i32::MIN` or `i32::MAX`.
    fn to_i(a: Self::F) -> Self::I;
    /// The nearest float, ties to even.
    fn to_f(a: Self::I) -> Self::F;
    /// The bits of the float. The sign and payload of a *computed* NaN differ between platforms: never let them reach
    /// a pixel.
    fn f_bits(a: Self::F) -> Self::I;
    /// The float with these bits.
    fn bits_f(a: Self::I) -> Self::F;
    /// `value`, a function of `x` whose derivative there is `slope`: for functions that are computed by way of bits, which know of no derivatives. But for
    /// [`Dual`] it is `value` as it is.
    #[inline(always)]
    fn chain(value: Self::F, x: Self::F, slope: Self::F) -> Self::F {
        let _ = (x, slope);
        value
    }

    /// The same of a function of two numbers.
    #[inline(always)]
    fn chain2(value: Self::F, x: [Self::F; 2], slopes: [Self::F; 2]) -> Self::F {
        let _ = (x, slopes);
        value
    }

    /// `table[i]` per lane, with each index clamped to the table: below 0 gives the first entry, past the end the
    /// last. 0 from an empty table.
    fn gather(table: &[u32], i: Self::I) -> Self::I;
    /// The low and the high words of the first [`N`](Self::N) of `pairs`. Panics if there are fewer.
    fn halves_of_pairs(self, pairs: &[u64]) -> (Self::I, Self::I);
}
