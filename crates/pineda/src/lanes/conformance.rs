//! The suite that a SIMD level must pass: every operation, on every level that this CPU has, bit for bit against
//! [`Scalar`]. A NaN may have any sign and payload; everything else must agree in each bit.
//!
//! What is built of these operations (functions, lookups) is checked in the same way, but only at the levels that shaders are compiled for: at others it never runs, and it is long enough for that
//! to be a third of what the tests take to compile.

#![allow(
    clippy::excessive_precision,
    clippy::approx_constant,
    reason = "these are values to try, written as they come"
)]

use super::{Lanes, Packet, Scalar};
use crate::wide::{dispatch, dispatch_shader};
use fearless_simd::{Level, Simd};

/// The levels that this CPU has, from plain arrays up.
pub(crate) fn levels() -> Vec<Level> {
    let best = Level::new();
    let mut levels = vec![Level::fallback()];
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        levels.extend(best.as_sse2().map(Level::Sse2));
        levels.extend(best.as_sse4_2().map(Level::Sse4_2));
        levels.extend(best.as_avx2().map(Level::Avx2));
        levels.extend(best.as_avx512().map(Level::Avx512));
    }
    #[cfg(target_arch = "aarch64")]
    levels.extend(best.as_neon().map(Level::Neon));
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    levels.extend(best.as_wasm_simd128().map(Level::WasmSimd128));
    if best.is_fallback() {
        levels.truncate(1);
    }
    levels
}

/// Those of them that shaders are compiled for.
pub(crate) fn shader_levels() -> Vec<Level> {
    let mut levels = levels();
    levels.retain(|level| {
        dispatch_shader!(*level, simd => core::mem::discriminant(&simd.level()) == core::mem::discriminant(level))
    });
    levels
}

/// One operation on two rows of bits, at any width.
pub(crate) trait Operation {
    const NAME: &'static str;
    /// Whether the result is a float, whose NaNs are all alike.
    const FLOAT: bool;
    fn step<L: Lanes>(lanes: L, a: L::I, b: L::I) -> L::I;
}

/// Runs the operation on each pair at every level.
pub(crate) fn check<O: Operation>(pairs: &[(u32, u32)]) {
    compare::<O>(pairs, &levels(), |level, a, b, found| {
        dispatch!(level, simd => {
            assert_eq!(core::mem::discriminant(&simd.level()), core::mem::discriminant(&level), "the level under test");
            run::<_, O>(Packet(simd), a, b, found);
        });
    });
}

/// The same at the levels that shaders are compiled for.
pub(crate) fn check_in_shaders<O: Operation>(pairs: &[(u32, u32)]) {
    compare::<O>(pairs, &shader_levels(), |level, a, b, found| {
        dispatch_shader!(level, simd => run::<_, O>(Packet(simd), a, b, found));
    });
}

/// Compares what a function finds at each level with what [`Scalar`] finds.
fn compare<O: Operation>(pairs: &[(u32, u32)], levels: &[Level], find: impl Fn(Level, &[i32], &[i32], &mut [i32])) {
    let (mut a, mut b): (Vec<i32>, Vec<i32>) = pairs.iter().map(|p| (p.0.cast_signed(), p.1.cast_signed())).unzip();
    a.resize(a.len().next_multiple_of(16), 0);
    b.resize(a.len(), 0);
    let mut expected = vec![0; a.len()];
    run::<Scalar, O>(Scalar, &a, &b, &mut expected);
    for &level in levels {
        let mut found = vec![0; a.len()];
        find(level, &a, &b, &mut found);
        for i in 0..a.len() {
            let both_nan =
                O::FLOAT && [expected[i], found[i]].iter().all(|x| f32::from_bits(x.cast_unsigned()).is_nan());
            assert!(
                both_nan || expected[i] == found[i],
                "{}({:#010x} = {:?}, {:#010x} = {:?}) is {:#010x} in scalar code, {:#010x} at {level:?}",
                O::NAME,
                a[i],
                f32::from_bits(a[i].cast_unsigned()),
                b[i],
                f32::from_bits(b[i].cast_unsigned()),
                expected[i],
                found[i],
            );
        }
    }
}

#[inline(always)]
fn run<L: Lanes, O: Operation>(lanes: L, a: &[i32], b: &[i32], out: &mut [i32]) {
    let mut i = 0;
    while i < a.len() {
        L::store_int(O::step(lanes, lanes.load_int(&a[i..]), lanes.load_int(&b[i..])), &mut out[i..]);
        i += L::N;
    }
}

/// Declares operations and checks each on the given pairs, by [`check`] or [`check_in_shaders`]: `float` ones from floats to a float, `mask` ones from floats
/// to yes or no, `int` ones from integers to an integer, `to_int` ones from floats to an integer.
macro_rules! conformance {
    ($check:ident $pairs:expr; $($kind:ident $name:ident<$width:ident>($lanes:ident, $a:ident, $b:ident) = $result:expr;)+) => {$({
        struct Case;
        impl $crate::lanes::conformance::Operation for Case {
            const NAME: &'static str = stringify!($name);
            const FLOAT: bool = $crate::lanes::conformance::conformance!(@float $kind);
            #[inline(always)]
            fn step<$width: Lanes>($lanes: $width, $a: $width::I, $b: $width::I) -> $width::I {
                let _ = ($lanes, $b);
                $crate::lanes::conformance::conformance!(@step $kind $width $lanes $a $b $result)
            }
        }
        $crate::lanes::conformance::$check::<Case>($pairs);
    })+};
    (@float float) => { true };
    (@float $kind:ident) => { false };
    (@step float $width:ident $lanes:ident $a:ident $b:ident $result:expr) => {{
        let ($a, $b) = ($width::bits_f($a), $width::bits_f($b));
        let _ = ($a, $b);
        $width::f_bits($result)
    }};
    (@step mask $width:ident $lanes:ident $a:ident $b:ident $result:expr) => {{
        let ($a, $b) = ($width::bits_f($a), $width::bits_f($b));
        let _ = ($a, $b);
        $width::iselect($result, $lanes.int(-1), $lanes.int(0))
    }};
    (@step to_int $width:ident $lanes:ident $a:ident $b:ident $result:expr) => {{
        let ($a, $b) = ($width::bits_f($a), $width::bits_f($b));
        let _ = ($a, $b);
        $result
    }};
    (@step int $width:ident $lanes:ident $a:ident $b:ident $result:expr) => { $result };
}
pub(crate) use conformance;

/// Floats where implementations differ, if they do.
pub(crate) const SPECIAL: [f32; 62] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    1.5,
    -1.5,
    2.5,
    -2.5,
    0.99999994,
    -0.99999994,
    0.49999997,
    3.0,
    -3.0,
    0.1,
    64.0,
    1e-45,
    -1e-45,
    1.1754942e-38,
    -1.1754942e-38,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    1e-20,
    -1e-20,
    1e20,
    -1e20,
    8388607.5,
    -8388607.5,
    8388608.0,
    -8388608.0,
    8388609.0,
    16777216.0,
    16777218.0,
    4194303.75,
    -4194303.75,
    2147483520.0,
    2147483648.0,
    -2147483648.0,
    -2147483904.0,
    4294967296.0,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    -f32::NAN,
    127.0,
    128.0,
    -126.0,
    -127.0,
    88.72283,
    88.72284,
    -87.33654,
    -87.33655,
    3.1415927,
    -3.1415927,
    1.5707964,
    8192.0,
    1048576.0,
    1048576.1,
    0.70710677,
];

/// Each special value with each, then random bits, then random numbers of a middling size.
pub(crate) fn pairs() -> Vec<(u32, u32)> {
    let mut pairs = Vec::new();
    for a in SPECIAL {
        for b in SPECIAL {
            pairs.push((a.to_bits(), b.to_bits()));
        }
    }
    let mut random = Random(1);
    for _ in 0..4096 {
        pairs.push((random.next(), random.next()));
    }
    for _ in 0..4096 {
        pairs.push((random.number(20.0).to_bits(), random.number(20.0).to_bits()));
    }
    pairs
}

/// Reproducible random numbers (Steele et al.'s SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z >> 32) as u32
    }

    /// From `-limit` to `limit`.
    pub(crate) fn number(&mut self, limit: f32) -> f32 {
        (self.next() as f32 / 2_147_483_648.0 - 1.0) * limit
    }
}

#[test]
fn float_operations_have_the_same_bits_at_every_level() {
    conformance! {
        check &pairs();
        float add<L>(lanes, a, b) = L::add(a, b);
        float sub<L>(lanes, a, b) = L::sub(a, b);
        float mul<L>(lanes, a, b) = L::mul(a, b);
        float div<L>(lanes, a, b) = L::div(a, b);
        float sqrt<L>(lanes, a, b) = L::sqrt(a);
        float floor<L>(lanes, a, b) = L::floor(a);
        float splat<L>(lanes, a, b) = L::add(a, lanes.splat(-0.1));
        float iota<L>(lanes, a, b) = L::mul(lanes.iota(), lanes.splat(0.0));
        float select<L>(lanes, a, b) = L::select(L::lt(a, b), a, b);
        float max<L>(lanes, a, b) = L::max(a, b);
        float min<L>(lanes, a, b) = L::min(a, b);
    }
}

#[test]
fn doubles_have_the_same_bits_at_every_level() {
    conformance! {
        check &pairs();
        float narrow<L>(lanes, a, b) = L::narrow(L::widen(a));
        float dadd<L>(lanes, a, b) = L::narrow(L::dadd(L::widen(a), L::widen(b)));
        float dsub<L>(lanes, a, b) = L::narrow(L::dsub(L::widen(a), L::widen(b)));
        float dmul<L>(lanes, a, b) = L::narrow(L::dmul(L::widen(a), L::widen(b)));
        float ddiv<L>(lanes, a, b) = L::narrow(L::ddiv(L::widen(a), L::widen(b)));
        float dsqrt<L>(lanes, a, b) = L::narrow(L::dsqrt(L::widen(a)));
        float low_digits<L>(lanes, a, b) = {
            let quotient = L::ddiv(L::widen(a), L::dadd(L::widen(b), lanes.double(0.1)));
            L::narrow(L::dsub(quotient, L::widen(L::narrow(quotient))))
        };
    }
}

#[test]
fn operations_on_bits_keep_those_of_nan_too() {
    conformance! {
        check &pairs();
        to_int neg<L>(lanes, a, b) = L::f_bits(L::neg(a));
        to_int abs<L>(lanes, a, b) = L::f_bits(L::abs(a));
        to_int select<L>(lanes, a, b) = L::f_bits(L::select(L::lt(a, b), a, b));
        to_int bits<L>(lanes, a, b) = L::f_bits(a);
    }
}

#[test]
fn comparisons_and_masks_agree_at_every_level() {
    conformance! {
        check &pairs();
        mask lt<L>(lanes, a, b) = L::lt(a, b);
        mask le<L>(lanes, a, b) = L::le(a, b);
        mask eq<L>(lanes, a, b) = L::eq(a, b);
        mask and<L>(lanes, a, b) = L::and(L::lt(a, b), L::lt(a, lanes.splat(0.0)));
        mask or<L>(lanes, a, b) = L::or(L::lt(a, b), L::lt(a, lanes.splat(0.0)));
        mask xor<L>(lanes, a, b) = L::xor(L::lt(a, b), L::lt(a, lanes.splat(0.0)));
        mask not<L>(lanes, a, b) = L::not(L::lt(a, b));
        mask of_mask<L>(lanes, a, b) = L::lt(a, L::of_mask(L::lt(a, b)).splat(2.0));
        mask of<L>(lanes, a, b) = L::lt(a, L::of(b).splat(2.0));
    }
}

#[test]
fn integer_operations_have_the_same_bits_at_every_level() {
    conformance! {
        check &pairs();
        int iadd<L>(lanes, a, b) = L::iadd(a, b);
        int isub<L>(lanes, a, b) = L::isub(a, b);
        int imul<L>(lanes, a, b) = L::imul(a, b);
        int iand<L>(lanes, a, b) = L::iand(a, b);
        int ior<L>(lanes, a, b) = L::ior(a, b);
        int ixor<L>(lanes, a, b) = L::ixor(a, b);
        int ishl_1<L>(lanes, a, b) = L::ishl(a, 1);
        int ishl_31<L>(lanes, a, b) = L::ishl(a, 31);
        int ishr_0<L>(lanes, a, b) = L::ishr(a, 0);
        int ishr_9<L>(lanes, a, b) = L::ishr(a, 9);
        int ishr_31<L>(lanes, a, b) = L::ishr(a, 31);
        int ieq<L>(lanes, a, b) = L::iselect(L::ieq(a, b), a, lanes.int(7));
        int ilt<L>(lanes, a, b) = L::iselect(L::ilt(a, b), a, b);
        int gather<L>(lanes, a, b) = L::gather(&[3, 1, 4, 0xffff_ffff], a);
        int gather_small<L>(lanes, a, b) = L::gather(&[3, 1, 4, 0xffff_ffff], L::iand(a, lanes.int(7)));
        int gather_nothing<L>(lanes, a, b) = L::gather(&[], a);
        float to_f<L>(lanes, a, b) = L::to_f(L::f_bits(a));
        to_int to_i<L>(lanes, a, b) = L::to_i(a);
    }
}

#[test]
fn conversion_to_integers_saturates() {
    for (x, expected) in
        [(f32::NAN, 0), (-1.9, -1), (2147483520.0, 2147483520), (3e9, i32::MAX), (-3e9, i32::MIN), (-0.0, 0)]
    {
        assert_eq!(Scalar::to_i(x), expected, "{x}");
    }
}

#[test]
fn gather_clamps_its_indices() {
    let table = [10, 20, 30];
    for (i, expected) in [(0, 10), (2, 30), (3, 30), (i32::MAX, 30), (-1, 10), (i32::MIN, 10)] {
        assert_eq!(Scalar::gather(&table, i), expected, "entry {i}");
    }
    assert_eq!(Scalar::gather(&[], 5), 0);
}

/// What concerns all lanes at once, and so cannot be compared lane by lane.
#[inline(always)]
fn whole_packets<L: Lanes>(lanes: L) {
    let all = u32::MAX >> (32 - L::N);
    for bits in [0, 1, 0x8000, 0xffff, 0xa5c3, 0xdead_0001, 0xffff_0000, u32::MAX] {
        let mask = lanes.mask(bits);
        assert_eq!(L::mask_bits(mask), bits & all, "bits above the lanes are ignored");
        assert_eq!(L::mask_bits(L::not(mask)), !bits & all, "and stay 0");
        assert_eq!(L::any(mask), bits & all != 0);
    }
    let mut numbers = [-1.0; 20];
    L::store(lanes.iota(), &mut numbers[2..]);
    for (i, number) in numbers.iter().enumerate() {
        let lane = i.wrapping_sub(2);
        assert_eq!(*number, if lane < L::N { lane as f32 } else { -1.0 }, "only the lanes are written");
    }
    assert_eq!(L::mask_bits(L::eq(lanes.load(&numbers[2..]), lanes.iota())), all);
    let mut integers = [-1; 20];
    L::store_int(L::to_i(lanes.iota()), &mut integers[2..]);
    assert_eq!(integers[1 + L::N], L::N as i32 - 1);
    assert_eq!(integers[2 + L::N], -1);
    assert_eq!(L::mask_bits(L::ieq(lanes.load_int(&integers[2..]), L::to_i(lanes.iota()))), all);
    // Lane i takes entry i: the lanes keep their order.
    let table: [u32; 16] = core::array::from_fn(|i| 100 + i as u32);
    let entries = L::gather(&table, L::to_i(lanes.iota()));
    assert_eq!(L::mask_bits(L::ieq(entries, L::to_i(L::add(lanes.iota(), lanes.splat(100.0))))), all);
}

#[test]
fn packets_keep_their_lanes_in_order() {
    whole_packets(Scalar);
    for level in levels() {
        dispatch!(level, simd => whole_packets(Packet(simd)));
    }
}
