//! One lane: plain `f32`, the reference that every SIMD level is compared with.

use super::{Lanes, sealed::Sealed};

/// One lane: ordinary `f32` code.
///
/// The default width of [`Real`](crate::Real), [`Vec3`](crate::Vec3) and the rest, so that `Vec3` alone is a plain
/// vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scalar;

impl Sealed for Scalar {}

impl Lanes for Scalar {
    type F = f32;
    type M = bool;
    type I = i32;
    type D = f64;

    const N: usize = 1;

    #[inline(always)]
    fn of(_: f32) -> Self {
        Self
    }
    #[inline(always)]
    fn of_mask(_: bool) -> Self {
        Self
    }
    #[inline(always)]
    fn of_double(_: f64) -> Self {
        Self
    }

    #[inline(always)]
    fn apart<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }

    #[inline(always)]
    fn splat(self, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn load(self, a: &[f32]) -> f32 {
        a[0]
    }
    #[inline(always)]
    fn store(a: f32, out: &mut [f32]) {
        out[0] = a;
    }
    #[inline(always)]
    fn iota(self) -> f32 {
        0.0
    }

    #[inline(always)]
    fn add(a: f32, b: f32) -> f32 {
        a + b
    }
    #[inline(always)]
    fn sub(a: f32, b: f32) -> f32 {
        a - b
    }
    #[inline(always)]
    fn mul(a: f32, b: f32) -> f32 {
        a * b
    }
    #[inline(always)]
    fn div(a: f32, b: f32) -> f32 {
        a / b
    }
    #[inline(always)]
    fn neg(a: f32) -> f32 {
        -a
    }
    #[inline(always)]
    fn abs(a: f32) -> f32 {
        a.abs()
    }
    #[inline(always)]
    fn sqrt(a: f32) -> f32 {
        a.sqrt()
    }
    #[inline(always)]
    fn floor(a: f32) -> f32 {
        a.floor()
    }

    #[inline(always)]
    fn double(self, x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn widen(a: f32) -> f64 {
        f64::from(a)
    }
    #[inline(always)]
    fn narrow(a: f64) -> f32 {
        a as f32
    }
    #[inline(always)]
    fn dadd(a: f64, b: f64) -> f64 {
        a + b
    }
    #[inline(always)]
    fn dsub(a: f64, b: f64) -> f64 {
        a - b
    }
    #[inline(always)]
    fn dmul(a: f64, b: f64) -> f64 {
        a * b
    }
    #[inline(always)]
    fn ddiv(a: f64, b: f64) -> f64 {
        a / b
    }
    #[inline(always)]
    fn dsqrt(a: f64) -> f64 {
        a.sqrt()
    }

    #[inline(always)]
    fn lt(a: f32, b: f32) -> bool {
        a < b
    }
    #[inline(always)]
    fn le(a: f32, b: f32) -> bool {
        a <= b
    }
    #[inline(always)]
    fn eq(a: f32, b: f32) -> bool {
        a == b
    }
    #[inline(always)]
    fn select(m: bool, a: f32, b: f32) -> f32 {
        if m { a } else { b }
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> bool {
        bits & 1 != 0
    }
    #[inline(always)]
    fn mask_bits(m: bool) -> u32 {
        u32::from(m)
    }
    #[inline(always)]
    fn and(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn or(a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn xor(a: bool, b: bool) -> bool {
        a ^ b
    }
    #[inline(always)]
    fn not(a: bool) -> bool {
        !a
    }
    #[inline(always)]
    fn any(a: bool) -> bool {
        a
    }

    #[inline(always)]
    fn int(self, x: i32) -> i32 {
        x
    }
    #[inline(always)]
    fn load_int(self, a: &[i32]) -> i32 {
        a[0]
    }
    #[inline(always)]
    fn store_int(a: i32, out: &mut [i32]) {
        out[0] = a;
    }
    #[inline(always)]
    fn iadd(a: i32, b: i32) -> i32 {
        a.wrapping_add(b)
    }
    #[inline(always)]
    fn isub(a: i32, b: i32) -> i32 {
        a.wrapping_sub(b)
    }
    #[inline(always)]
    fn imul(a: i32, b: i32) -> i32 {
        a.wrapping_mul(b)
    }
    #[inline(always)]
    fn iand(a: i32, b: i32) -> i32 {
        a & b
    }
    #[inline(always)]
    fn ior(a: i32, b: i32) -> i32 {
        a | b
    }
    #[inline(always)]
    fn ixor(a: i32, b: i32) -> i32 {
        a ^ b
    }
    #[inline(always)]
    fn ishl(a: i32, bits: u32) -> i32 {
        a << bits
    }
    #[inline(always)]
    fn ishr(a: i32, bits: u32) -> i32 {
        a >> bits
    }
    #[inline(always)]
    fn ieq(a: i32, b: i32) -> bool {
        a == b
    }
    #[inline(always)]
    fn ilt(a: i32, b: i32) -> bool {
        a < b
    }
    #[inline(always)]
    fn iselect(m: bool, a: i32, b: i32) -> i32 {
        if m { a } else { b }
    }

    #[inline(always)]
    fn to_i(a: f32) -> i32 {
        a as i32
    }
    #[inline(always)]
    fn to_f(a: i32) -> f32 {
        a as f32
    }
    #[inline(always)]
    fn f_bits(a: f32) -> i32 {
        a.to_bits().cast_signed()
    }
    #[inline(always)]
    fn bits_f(a: i32) -> f32 {
        f32::from_bits(a.cast_unsigned())
    }

    #[inline(always)]
    fn gather(table: &[u32], i: i32) -> i32 {
        if table.is_empty() {
            return 0;
        }
        table[(i.max(0) as usize).min(table.len() - 1)].cast_signed()
    }

    #[inline(always)]
    fn halves_of_pairs(self, pairs: &[u64]) -> (i32, i32) {
        (pairs[0] as i32, (pairs[0] >> 32) as i32)
    }
}
