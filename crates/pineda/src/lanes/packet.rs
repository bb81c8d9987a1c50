//! Sixteen lanes at one SIMD level, by way of `fearless_simd`: the operations are those of [`crate::wide`].

use super::{Lanes, sealed::Sealed};
use crate::wide::{Simd, f32x16, f64x16, i32x16, mask32x16, u32x16};

/// Sixteen lanes, at the SIMD level that the token `S` stands for.
///
/// At every level it is sixteen: one AVX-512 register, two of AVX2, four of SSE, NEON or WebAssembly, or plain
/// arrays where there are no vector instructions.
#[derive(Clone, Copy, Debug)]
pub struct Packet<S: Simd>(pub S);

const IOTA: [f32; 16] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];

impl<S: Simd> Sealed for Packet<S> {}

impl<S: Simd> Lanes for Packet<S> {
    type F = f32x16<S>;
    type M = mask32x16<S>;
    type I = i32x16<S>;
    type D = f64x16<S>;

    const N: usize = 16;

    #[inline(always)]
    fn of(a: f32x16<S>) -> Self {
        Self(a.token())
    }
    #[inline(always)]
    fn of_mask(m: mask32x16<S>) -> Self {
        Self(m.token())
    }
    #[inline(always)]
    fn of_double(a: f64x16<S>) -> Self {
        Self(a.token())
    }

    // `vectorize` is `#[inline]`: called by itself, it would be compiled again in each codegen unit that looks a texture up.
    #[inline(never)]
    fn apart<R>(self, f: impl FnOnce() -> R) -> R {
        self.0.vectorize(f)
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
        a + b
    }
    #[inline(always)]
    fn sub(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        a - b
    }
    #[inline(always)]
    fn mul(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        a * b
    }
    #[inline(always)]
    fn div(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        a / b
    }
    #[inline(always)]
    fn neg(a: f32x16<S>) -> f32x16<S> {
        -a
    }
    #[inline(always)]
    fn abs(a: f32x16<S>) -> f32x16<S> {
        a.abs()
    }
    #[inline(always)]
    fn sqrt(a: f32x16<S>) -> f32x16<S> {
        a.sqrt()
    }
    #[inline(always)]
    fn floor(a: f32x16<S>) -> f32x16<S> {
        a.floor()
    }

    #[inline(always)]
    fn double(self, x: f64) -> f64x16<S> {
        f64x16::splat(self.0, x)
    }
    #[inline(always)]
    fn widen(a: f32x16<S>) -> f64x16<S> {
        f64x16::from_f32(a)
    }
    #[inline(always)]
    fn narrow(a: f64x16<S>) -> f32x16<S> {
        a.narrow()
    }
    #[inline(always)]
    fn dadd(a: f64x16<S>, b: f64x16<S>) -> f64x16<S> {
        a + b
    }
    #[inline(always)]
    fn dsub(a: f64x16<S>, b: f64x16<S>) -> f64x16<S> {
        a - b
    }
    #[inline(always)]
    fn dmul(a: f64x16<S>, b: f64x16<S>) -> f64x16<S> {
        a * b
    }
    #[inline(always)]
    fn ddiv(a: f64x16<S>, b: f64x16<S>) -> f64x16<S> {
        a / b
    }
    #[inline(always)]
    fn dsqrt(a: f64x16<S>) -> f64x16<S> {
        a.sqrt()
    }

    #[inline(always)]
    fn lt(a: f32x16<S>, b: f32x16<S>) -> mask32x16<S> {
        a.simd_lt(b)
    }
    #[inline(always)]
    fn le(a: f32x16<S>, b: f32x16<S>) -> mask32x16<S> {
        a.simd_le(b)
    }
    #[inline(always)]
    fn eq(a: f32x16<S>, b: f32x16<S>) -> mask32x16<S> {
        a.simd_eq(b)
    }
    #[inline(always)]
    fn select(m: mask32x16<S>, a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        m.select(a, b)
    }

    #[inline(always)]
    fn max(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        a.max(b)
    }
    #[inline(always)]
    fn min(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
        a.min(b)
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
        a & b
    }
    #[inline(always)]
    fn or(a: mask32x16<S>, b: mask32x16<S>) -> mask32x16<S> {
        a | b
    }
    #[inline(always)]
    fn xor(a: mask32x16<S>, b: mask32x16<S>) -> mask32x16<S> {
        a ^ b
    }
    #[inline(always)]
    fn not(a: mask32x16<S>) -> mask32x16<S> {
        !a
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
        a + b
    }
    #[inline(always)]
    fn isub(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        a - b
    }
    #[inline(always)]
    fn imul(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        a * b
    }
    #[inline(always)]
    fn iand(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        a & b
    }
    #[inline(always)]
    fn ior(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        a | b
    }
    #[inline(always)]
    fn ixor(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        a ^ b
    }
    #[inline(always)]
    fn ishl(a: i32x16<S>, bits: u32) -> i32x16<S> {
        a << bits
    }
    #[inline(always)]
    fn ishr(a: i32x16<S>, bits: u32) -> i32x16<S> {
        a >> bits
    }
    #[inline(always)]
    fn ieq(a: i32x16<S>, b: i32x16<S>) -> mask32x16<S> {
        a.simd_eq(b)
    }
    #[inline(always)]
    fn ilt(a: i32x16<S>, b: i32x16<S>) -> mask32x16<S> {
        a.simd_lt(b)
    }
    #[inline(always)]
    fn iselect(m: mask32x16<S>, a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
        m.select(a, b)
    }

    #[inline(always)]
    fn to_i(a: f32x16<S>) -> i32x16<S> {
        // The plain conversion gives i32::MIN on x86 and a saturated value elsewhere; the precise one is `as i32`.
        a.to_int_precise()
    }
    #[inline(always)]
    fn to_f(a: i32x16<S>) -> f32x16<S> {
        a.to_float()
    }
    #[inline(always)]
    fn f_bits(a: f32x16<S>) -> i32x16<S> {
        a.bitcast()
    }
    #[inline(always)]
    fn bits_f(a: i32x16<S>) -> f32x16<S> {
        a.bitcast()
    }

    #[inline(always)]
    fn gather(table: &[u32], i: i32x16<S>) -> i32x16<S> {
        // No level of `fearless_simd` has a gather, so the lanes go through memory: one scalar load each.
        let mut lanes: [i32; 16] = i.into();
        let mut k = 0;
        while k < 16 {
            lanes[k] =
                if table.is_empty() { 0 } else { table[(lanes[k].max(0) as usize).min(table.len() - 1)].cast_signed() };
            k += 1;
        }
        i32x16::simd_from(i.token(), lanes)
    }

    #[inline(always)]
    fn halves_of_pairs(self, pairs: &[u64]) -> (i32x16<S>, i32x16<S>) {
        let words: &[u32] = bytemuck::must_cast_slice(&pairs[..16]);
        let (a, b) = (u32x16::from_slice(self.0, &words[..16]), u32x16::from_slice(self.0, &words[16..]));
        let (even, odd) = (a.unzip_low(b).bitcast(), a.unzip_high(b).bitcast());
        if cfg!(target_endian = "little") { (even, odd) } else { (odd, even) }
    }
}
