//! The SIMD levels, and running code at one of them.

/// A SIMD level of which it is known, when code is compiled for it, whether it has vector instructions.
///
/// `fearless_simd` tells that at run time only. The optimizer would drop the way not taken, but not before it had inlined all of it.
pub trait Simd: fearless_simd::Simd {
    /// Whether all CPUs have the level for which the program is compiled.
    const IS_BASELINE: bool = false;
    /// Whether lanes are elements of plain arrays.
    const IS_PLAIN: bool = false;
    /// Whether ways are taken that are there for speed alone. Where they are not, less is to be compiled; and what the other levels draw is compared with what the general ways do.
    const HAS_SHORTCUTS: bool = false;
    /// Whether a packet is two registers.
    const HAS_HALVES: bool = false;
    /// Whether [`u32x16::pick`](super::u32x16::pick) is one instruction.
    const CAN_PICK: bool = false;
    /// Whether [`u32x16::pick_in_fours`](super::u32x16::pick_in_fours) is one instruction for each register.
    const CAN_PICK_IN_FOURS: bool = false;
    /// Whether there are instructions that multiply 32-bit integers. Without, `fearless_simd` takes vectors apart and puts them together again, lane by lane: a loop is shorter.
    const MULTIPLIES: bool = false;
    /// The same of shifts by as many bits as another vector's lanes say.
    const SHIFTS_EACH: bool = false;
    /// Whether the level's maximum and minimum of floats are x86's, `a > b ? a : b` and `a < b ? a : b` to the bit, of NaN and zeros too. Elsewhere they treat these in other ways.
    const MAX_COMPARES: bool = false;

    /// Runs code in a function of its own, which has the level's instructions. What is called there must be `#[inline(always)]`.
    #[inline(always)]
    fn apart<R>(self, run: impl FnOnce() -> R) -> R {
        if Self::IS_PLAIN {
            in_plain_code(run)
        } else if Self::IS_BASELINE {
            vectorize_baseline(run)
        } else {
            self.vectorize(run)
        }
    }
}

/// `fearless_simd`'s `vectorize` where the target has the level's instructions anyway. That one would be inlined after it was optimized by itself: twice the work. `cargo xtask asm` looks for the name.
#[inline(never)]
fn vectorize_baseline<R>(run: impl FnOnce() -> R) -> R {
    run()
}

/// The same for plain arrays, by another name.
#[inline(never)]
fn in_plain_code<R>(run: impl FnOnce() -> R) -> R {
    run()
}

/// What each level has.
macro_rules! levels {
    ($($(#[$condition:meta])* $token:ty: $($has:ident $(($when:literal))?)*;)+) => {$(
        $(#[$condition])*
        impl Simd for $token {
            $(const $has: bool = true $(&& cfg!(target_feature = $when))?;)*
        }
    )+};
}

levels! {
    fearless_simd::Fallback: IS_BASELINE IS_PLAIN;
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    fearless_simd::x86::Sse2: IS_BASELINE("sse2") MAX_COMPARES;
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    fearless_simd::x86::Sse4_2: HAS_SHORTCUTS CAN_PICK_IN_FOURS MULTIPLIES MAX_COMPARES;
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    fearless_simd::x86::Avx2: HAS_SHORTCUTS HAS_HALVES CAN_PICK_IN_FOURS MULTIPLIES SHIFTS_EACH MAX_COMPARES;
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    fearless_simd::x86::Avx512: HAS_SHORTCUTS CAN_PICK CAN_PICK_IN_FOURS MULTIPLIES SHIFTS_EACH MAX_COMPARES;
    #[cfg(target_arch = "aarch64")]
    fearless_simd::aarch64::Neon: IS_BASELINE("neon") HAS_SHORTCUTS CAN_PICK_IN_FOURS MULTIPLIES SHIFTS_EACH;
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    fearless_simd::wasm32::WasmSimd128: IS_BASELINE HAS_SHORTCUTS CAN_PICK_IN_FOURS MULTIPLIES;
}

/// `fearless_simd::dispatch!` for code that is generic over the [`Simd`] of this module: evaluates the expression, with the level's
/// token in the variable, in a function that has the level's instructions. What is called there must be `#[inline(always)]`.
macro_rules! dispatch {
    (@at $token:ident, $simd:pat => $run:expr) => {{
        let $simd = $token;
        $crate::wide::Simd::apart(
            $token,
            #[inline(always)]
            || $run,
        )
    }};
    ($level:expr, $simd:pat => $run:expr) => {
        match $level {
            fearless_simd::Level::Fallback(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            fearless_simd::Level::Sse2(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            fearless_simd::Level::Sse4_2(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            fearless_simd::Level::Avx2(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            fearless_simd::Level::Avx512(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            #[cfg(target_arch = "aarch64")]
            fearless_simd::Level::Neon(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            fearless_simd::Level::WasmSimd128(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            level => unreachable!("fearless_simd has a level that pineda does not know: {level:?}"),
        }
    };
}
pub(crate) use dispatch;

/// [`dispatch!`] for what is compiled once for each shader, and takes longest to compile: AVX2 and AVX-512 where there are such, and for all other levels the one that the machine's kind has at least
/// (SSE2, NEON). The lanes of those other levels are judged by themselves (`lanes/conformance.rs`).
macro_rules! dispatch_shader {
    ($level:expr, $simd:pat => $run:expr) => {
        match $level {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            fearless_simd::Level::Avx2(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            fearless_simd::Level::Avx512(token) => $crate::wide::dispatch!(@at token, $simd => $run),
            _ => {
                let $simd = $crate::shading::native().0;
                $run
            }
        }
    };
}
pub(crate) use dispatch_shader;
