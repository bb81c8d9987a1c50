//! The functions of shaders, beside the true ones: a sample of the floats. All of them: `cargo xtask ulp`, docs/math.md.

#![allow(missing_docs, reason = "a test")]

use pineda_proof::ulp::{FUNCTIONS, FUNCTIONS_2};

/// A prime, so that no bit pattern is left out by system.
const STRIDE: usize = 32_771;
const PAIRS: u64 = 200_000;

#[test]
fn functions_of_one_number_are_as_accurate_as_documented() {
    for function in &FUNCTIONS {
        let worst = function.worst(0, 1 << 32, STRIDE);
        assert!(worst.ulps <= function.admitted, "{}({:e}) is {} ULP off", function.name, worst.at[0], worst.ulps);
    }
}

#[test]
fn logarithms_are_accurate_near_1_where_they_vanish() {
    let first = u64::from(0.99_f32.to_bits());
    for function in FUNCTIONS.iter().filter(|function| function.name.starts_with("log")) {
        let worst = function.worst(first, u64::from(1.01_f32.to_bits()) - first, 7);
        assert!(worst.ulps <= function.admitted, "{}({:e}) is {} ULP off", function.name, worst.at[0], worst.ulps);
    }
}

#[test]
fn functions_of_two_numbers_are_as_accurate_as_documented() {
    for function in &FUNCTIONS_2 {
        let worst = function.worst(0, PAIRS);
        assert!(worst.ulps <= function.admitted, "{}{:?} is {} ULP off", function.name, worst.at, worst.ulps);
    }
}

/// FNV-1a of each function's results for a sample of floats.
const BITS: &[(&str, u64)] = &[
    ("sqrt", 0xeb82_4e20_39ba_3cef),
    ("inverse_sqrt", 0x9c0a_d1d6_622b_18b5),
    ("cbrt", 0xa0e4_f6de_0120_1f8b),
    ("exp", 0x3114_b534_624e_2494),
    ("exp2", 0x50a3_c8d4_7894_dbff),
    ("log", 0x2bf9_ef21_ab18_d7fc),
    ("log2", 0xb39a_4d51_7858_9e3c),
    ("sin", 0x0c5c_6a5e_bb71_fb2a),
    ("cos", 0xfd6a_e2dd_2e06_8a83),
    ("tan", 0x2b6c_f773_dcd3_e08d),
    ("asin", 0x7d0e_e5b8_de01_05f7),
    ("acos", 0xa829_8e29_50fb_82a5),
    ("atan", 0x0627_0689_8af7_a1e7),
    ("linear_to_srgb", 0xaf90_dd21_b639_724e),
    ("srgb_to_linear", 0x4ebb_a8e9_be14_5282),
    ("powf", 0xec48_99f4_bf8f_39c3),
    ("atan2", 0xd0cc_714f_4fa9_31b2),
];

#[test]
fn functions_have_the_same_bits_on_every_platform() {
    let fnv1a = |hash: u64, x: f32| {
        // What a computed NaN holds depends on the platform.
        let bits = if x.is_nan() { f32::NAN.to_bits() } else { x.to_bits() };
        (hash ^ u64::from(bits)).wrapping_mul(0x0100_0000_01b3)
    };
    let sample = || (0..u32::MAX).step_by(STRIDE).map(f32::from_bits);
    let ones = FUNCTIONS.iter().map(|function| {
        let hash = sample().fold(0xcbf2_9ce4_8422_2325, |hash, x| fnv1a(hash, (function.ours)(x.into()).into()));
        (function.name, hash)
    });
    let twos = FUNCTIONS_2.iter().map(|function| {
        let results = (0..PAIRS).map(|number| function.found(number));
        (function.name, results.fold(0xcbf2_9ce4_8422_2325, fnv1a))
    });
    let found: Vec<_> = ones.chain(twos).collect();
    assert_eq!(found, BITS, "{found:#x?}");
}
