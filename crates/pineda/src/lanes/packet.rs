//! Sixteen lanes at one SIMD level, by way of `fearless_simd`.

use super::{Lanes, plain, sealed::Sealed};
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::Level;
use fearless_simd::{f32x16, i32x16, mask32x16, prelude::*};

/// Sixteen lanes, at the SIMD level that the token `S` stands for.
///
/// At every level it is sixteen: one AVX-512 register, two of AVX2, four of SSE, NEON or WebAssembly, or plain
/// arrays with `fearless_simd`'s `Fallback`.
#[derive(Clone, Copy, Debug)]
pub struct Packet<S: Simd>(pub S);

const IOTA: [f32; 16] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];

/// `plain` where there are no vector instructions, `vector` elsewhere. The level is known when this is compiled, so only
/// one of the two is left.
macro_rules! by_level {
    ($simd:expr, $plain:expr, $vector:expr) => {
        if $simd.level().is_fallback() { $plain } else { $vector }
    };
}

impl<S: Simd> Sealed for Packet<S> {}

impl<S: Simd> Lanes for Packet<S> {
    type F = f32x16<S>;
    type M = mask32x16<S>;
    type I = i32x16<S>;

    const N: usize = 16;

    #[inline(always)]
    fn of(a: f32x16<S>) -> Self {
        Self(a.simd)
    }
    #[inline(always)]
    fn of_mask(m: mask32x16<S>) -> Self {
        Self(m.token())
    }

    #[inline(always)]
    fn splat(self, x: f32) -> f32x16<S> {
        f32x16::splat(self.0, x)
    }
    #[inline(always)]
    fn load(self, a: &[f32]) -> f32x16<S> {
        f32x16::from_slice(self.0, &a[..16])
    }
    #[inline(always)]
    fn store(a: f32x16<S>, out: &mut [f32]) {
        a.store_slice(&mut out[..16]);
    }
    #[inline(always)]
    fn iota(self) -> f32x16<S> {
        f32x16::simd_from(self.0, IOTA)
    }

    #[inline(always)]
    fn add(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::add(a, b), a + b)
    }
    #[inline(always)]
    fn sub(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::sub(a, b), a - b)
    }
    #[inline(always)]
    fn mul(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::mul(a, b), a * b)
    }
    #[inline(always)]
    fn div(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::div(a, b), a / b)
    }
    #[inline(always)]
    fn neg(a: f32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::neg(a), -a)
    }
    #[inline(always)]
    fn abs(a: f32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::abs(a), a.abs())
    }
    #[inline(always)]
    fn sqrt(a: f32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::sqrt(a), a.sqrt())
    }
    #[inline(always)]
    fn floor(a: f32x16<S>) -> f32x16<S> {
        // SSE2 has no instruction for it, and sixteen calls of the C library's function take ten times as long as this.
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if matches!(a.simd.level(), Level::Sse2(_)) {
            return floor_by_conversion(a);
        }
        by_level!(a.simd, plain::floor(a), a.floor())
    }

    #[inline(always)]
    fn lt(a: f32x16<S>, b: f32x16<S>) -> mask32x16<S> {
        by_level!(a.simd, plain::lt(a, b), a.simd_lt(b))
    }
    #[inline(always)]
    fn le(a: f32x16<S>, b: f32x16<S>) -> mask32x16<S> {
        by_level!(a.simd, plain::le(a, b), a.simd_le(b))
    }
    #[inline(always)]
    fn eq(a: f32x16<S>, b: f32x16<S>) -> mask32x16<S> {
        by_level!(a.simd, plain::eq(a, b), a.simd_eq(b))
    }
    #[inline(always)]
    fn select(m: mask32x16<S>, a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::select(m, a, b), m.select(a, b))
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> mask32x16<S> {
        mask32x16::from_bitmask(self.0, u64::from(bits))
    }
    #[inline(always)]
    fn mask_bits(m: mask32x16<S>) -> u32 {
        m.to_bitmask() as u32
    }
    #[inline(always)]
    fn and(a: mask32x16<S>, b: mask32x16<S>) -> mask32x16<S> {
        by_level!(a.token(), plain::and(a, b), a & b)
    }
    #[inline(always)]
    fn or(a: mask32x16<S>, b: mask32x16<S>) -> mask32x16<S> {
        by_level!(a.token(), plain::or(a, b), a | b)
    }
    #[inline(always)]
    fn xor(a: mask32x16<S>, b: mask32x16<S>) -> mask32x16<S> {
        by_level!(a.token(), plain::xor(a, b), a ^ b)
    }
    #[inline(always)]
    fn not(a: mask32x16<S>) -> mask32x16<S> {
        by_level!(a.token(), plain::not(a), !a)
    }
    #[inline(always)]
    fn any(a: mask32x16<S>) -> bool {
        a.any_true()
    }

    #[inline(always)]
    fn int(self, x: i32) -> i32x16<S> {
        i32x16::splat(self.0, x)
    }
    #[inline(always)]
    fn load_int(self, a: &[i32]) -> i32x16<S> {
        i32x16::from_slice(self.0, &a[..16])
    }
    #[inline(always)]
    fn store_int(a: i32x16<S>, out: &mut [i32]) {
        a.store_slice(&mut out[..16]);
    }
    #[inline(always)]
    fn iadd(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        by_level!(a.simd, plain::iadd(a, b), a + b)
    }
    #[inline(always)]
    fn isub(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        by_level!(a.simd, plain::isub(a, b), a - b)
    }
    #[inline(always)]
    fn imul(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        by_level!(a.simd, plain::imul(a, b), a * b)
    }
    #[inline(always)]
    fn iand(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        by_level!(a.simd, plain::iand(a, b), a & b)
    }
    #[inline(always)]
    fn ior(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        by_level!(a.simd, plain::ior(a, b), a | b)
    }
    #[inline(always)]
    fn ixor(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        by_level!(a.simd, plain::ixor(a, b), a ^ b)
    }
    #[inline(always)]
    fn ishl(a: i32x16<S>, bits: u32) -> i32x16<S> {
        by_level!(a.simd, plain::ishl(a, bits), a << bits)
    }
    #[inline(always)]
    fn ishr(a: i32x16<S>, bits: u32) -> i32x16<S> {
        by_level!(a.simd, plain::ishr(a, bits), a >> bits)
    }
    #[inline(always)]
    fn ieq(a: i32x16<S>, b: i32x16<S>) -> mask32x16<S> {
        by_level!(a.simd, plain::ieq(a, b), a.simd_eq(b))
    }
    #[inline(always)]
    fn ilt(a: i32x16<S>, b: i32x16<S>) -> mask32x16<S> {
        by_level!(a.simd, plain::ilt(a, b), a.simd_lt(b))
    }
    #[inline(always)]
    fn iselect(m: mask32x16<S>, a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        by_level!(a.simd, plain::iselect(m, a, b), m.select(a, b))
    }

    #[inline(always)]
    fn to_i(a: f32x16<S>) -> i32x16<S> {
        // The plain conversion gives i32::MIN on x86 and a saturated value elsewhere; the precise one is `as i32`.
        by_level!(a.simd, plain::to_i(a), i32x16::truncate_from_precise(a))
    }
    #[inline(always)]
    fn to_f(a: i32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::to_f(a), f32x16::float_from(a))
    }
    #[inline(always)]
    fn f_bits(a: f32x16<S>) -> i32x16<S> {
        by_level!(a.simd, plain::f_bits(a), a.bitcast())
    }
    #[inline(always)]
    fn bits_f(a: i32x16<S>) -> f32x16<S> {
        by_level!(a.simd, plain::bits_f(a), a.bitcast())
    }

    #[inline(always)]
    fn gather(table: &[u32], i: i32x16<S>) -> i32x16<S> {
        // No level of `fearless_simd` has a gather, so the lanes go through memory: one scalar load each.
        let mut lanes = [0; 16];
        i.store_array(&mut lanes);
        let mut k = 0;
        while k < 16 {
            lanes[k] =
                if table.is_empty() { 0 } else { table[(lanes[k].max(0) as usize).min(table.len() - 1)].cast_signed() };
            k += 1;
        }
        i32x16::simd_from(i.simd, lanes)
    }
}

/// The floor by way of integers, for levels without an instruction for it.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
#[inline(always)]
fn floor_by_conversion<S: Simd>(a: f32x16<S>) -> f32x16<S> {
    // From 2^23 on every float is whole, and stays; so does NaN, which is not below. What the conversion makes of
    // numbers that do not fit is therefore never seen.
    let has_fraction = a.abs().simd_lt(8_388_608.0);
    let truncated = f32x16::float_from(i32x16::truncate_from(a));
    let one_too_high = a.simd_lt(truncated);
    let floor = truncated - one_too_high.select(f32x16::splat(a.simd, 1.0), f32x16::splat(a.simd, 0.0));
    // Only for -0 does this change a thing: anything else of negative sign has a negative floor already.
    let sign = a.bitcast::<i32x16<S>>() & i32::MIN;
    has_fraction.select((floor.bitcast::<i32x16<S>>() | sign).bitcast(), a)
}
