//! The functions of shaders, beside the true ones: a sample of the floats. All of them: `cargo xtask ulp`, docs/math.md.

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
