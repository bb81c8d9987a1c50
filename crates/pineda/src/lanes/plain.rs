//! Sixteen lanes without vector instructions: loops over plain arrays, for `fearless_simd`'s `Fallback` level.
//!
//! `Fallback` has these operations too, but spells them out lane by lane. That is so much code that LLVM's time grows with
//! the square of a shader's length: one `powf` took 40 s to compile, in debug and in release builds, and takes a second as
//! loops. (LLVM makes vectors of them at whatever level the target has; the bits are the same.)

use fearless_simd::{f32x16, i32x16, mask32x16, prelude::*};

/// Declares an operation on each lane by itself: `fn name(a: f32, b: f32) -> bool = a < b;`
macro_rules! lane_by_lane {
    ($(fn $name:ident($first:ident: $first_type:ident $(, $rest:ident: $rest_type:ident)*) -> $result:ident = $lane:expr;)+) => {$(
        #[inline(always)]
        pub(super) fn $name<S: Simd>(
            $first: lane_by_lane!(@type $first_type), $($rest: lane_by_lane!(@type $rest_type)),*
        ) -> lane_by_lane!(@type $result) {
            let simd = $first.token();
            let $first = lane_by_lane!(@array $first_type $first);
            $(let $rest = lane_by_lane!(@array $rest_type $rest);)*
            let mut result = [Default::default(); 16];
            let mut k = 0;
            while k < 16 {
                let $first = lane_by_lane!(@lane $first_type $first k);
                $(let $rest = lane_by_lane!(@lane $rest_type $rest k);)*
                result[k] = lane_by_lane!(@result $result $lane);
                k += 1;
            }
            <lane_by_lane!(@type $result)>::simd_from(simd, result)
        }
    )+};
    (@type f32) => { f32x16<S> };
    (@type i32) => { i32x16<S> };
    (@type bool) => { mask32x16<S> };
    // A mask's lanes are -1 and 0.
    (@array bool $a:ident) => { <[i32; 16]>::from($a) };
    (@array $type:ident $a:ident) => { $a.to_array() };
    (@lane bool $a:ident $k:ident) => { $a[$k] != 0 };
    (@lane $type:ident $a:ident $k:ident) => { $a[$k] };
    (@result bool $lane:expr) => { -i32::from($lane) };
    (@result $type:ident $lane:expr) => { $lane };
}

lane_by_lane! {
    fn add(a: f32, b: f32) -> f32 = a + b;
    fn sub(a: f32, b: f32) -> f32 = a - b;
    fn mul(a: f32, b: f32) -> f32 = a * b;
    fn div(a: f32, b: f32) -> f32 = a / b;
    fn neg(a: f32) -> f32 = -a;
    fn abs(a: f32) -> f32 = a.abs();
    fn sqrt(a: f32) -> f32 = a.sqrt();
    fn floor(a: f32) -> f32 = a.floor();
    fn lt(a: f32, b: f32) -> bool = a < b;
    fn le(a: f32, b: f32) -> bool = a <= b;
    fn eq(a: f32, b: f32) -> bool = a == b;
    fn select(m: bool, a: f32, b: f32) -> f32 = if m { a } else { b };
    fn and(a: bool, b: bool) -> bool = a & b;
    fn or(a: bool, b: bool) -> bool = a | b;
    fn xor(a: bool, b: bool) -> bool = a ^ b;
    fn not(a: bool) -> bool = !a;
    fn iadd(a: i32, b: i32) -> i32 = a.wrapping_add(b);
    fn isub(a: i32, b: i32) -> i32 = a.wrapping_sub(b);
    fn imul(a: i32, b: i32) -> i32 = a.wrapping_mul(b);
    fn iand(a: i32, b: i32) -> i32 = a & b;
    fn ior(a: i32, b: i32) -> i32 = a | b;
    fn ixor(a: i32, b: i32) -> i32 = a ^ b;
    fn ieq(a: i32, b: i32) -> bool = a == b;
    fn ilt(a: i32, b: i32) -> bool = a < b;
    fn iselect(m: bool, a: i32, b: i32) -> i32 = if m { a } else { b };
    fn to_i(a: f32) -> i32 = a as i32;
    fn to_f(a: i32) -> f32 = a as f32;
    fn f_bits(a: f32) -> i32 = a.to_bits().cast_signed();
    fn bits_f(a: i32) -> f32 = f32::from_bits(a.cast_unsigned());
}

/// `a << bits`.
#[inline(always)]
pub(super) fn ishl<S: Simd>(a: i32x16<S>, bits: u32) -> i32x16<S> {
    let mut lanes = a.to_array();
    let mut k = 0;
    while k < 16 {
        lanes[k] <<= bits;
        k += 1;
    }
    i32x16::simd_from(a.simd, lanes)
}

/// `a >> bits`, filling with the sign.
#[inline(always)]
pub(super) fn ishr<S: Simd>(a: i32x16<S>, bits: u32) -> i32x16<S> {
    let mut lanes = a.to_array();
    let mut k = 0;
    while k < 16 {
        lanes[k] >>= bits;
        k += 1;
    }
    i32x16::simd_from(a.simd, lanes)
}
