//! How near the polynomials come to the true values: `libm`'s in f64, which are right to far more digits than an f32 has.
//!
//! The default tests walk through the floats in strides, a million points a function. `cargo test --release -- --ignored
//! every_float` visits all of them; it passed last on 22 November 2026. The largest errors that a separate scan found, in ULP: exp2 1.23 (within
//! +-126), exp 0.99 (within +-87.33), log2 1.34, log 0.86, sin and cos 2.43 (within +-8192); inverse_sqrt 1.35.

use super::{Real, Vec2, Vec3};
use crate::lanes::Scalar;

/// The stride of the default tests: a prime, so that no bit pattern is left out by system.
const STRIDE: usize = 4099;

/// The distance from the true value in units of the last place that an f32 of its size has.
fn ulps(found: f32, exact: f64) -> f64 {
    if exact.is_nan() || found.is_nan() {
        return if exact.is_nan() && found.is_nan() { 0.0 } else { f64::INFINITY };
    }
    let rounded = exact as f32;
    if rounded.is_infinite() || found.is_infinite() {
        return if rounded == found { 0.0 } else { f64::INFINITY };
    }
    let exponent = libm::ilogb(exact.abs().max(f64::from(f32::MIN_POSITIVE)));
    (f64::from(found) - exact).abs() / libm::exp2(f64::from(exponent - 23))
}

/// The largest error over the floats from `low` to `high` that the stride visits, and where it is.
fn worst(range: [f32; 2], stride: usize, found: fn(Real) -> Real, exact: fn(f64) -> f64) -> (f64, f32) {
    let mut worst = (0.0, 0.0);
    let largest = range[1].max(-range[0]);
    for bits in (0..=largest.to_bits()).step_by(stride) {
        for x in [f32::from_bits(bits), -f32::from_bits(bits)] {
            if x >= range[0] && x <= range[1] {
                let error = ulps(found(Real(x)).0, exact(f64::from(x)));
                if error > worst.0 {
                    worst = (error, x);
                }
            }
        }
    }
    worst
}

type Function = (&'static str, [f32; 2], f64, fn(Real) -> Real, fn(f64) -> f64);

/// Name, range, greatest error in ULP that the documentation admits, ours, the truth.
const FUNCTIONS: [Function; 7] = [
    ("exp2", [-126.0, f32::MAX], 1.5, Real::exp2, libm::exp2),
    ("exp", [-87.33654, f32::MAX], 1.0, Real::exp, libm::exp),
    ("log2", [-1e30, f32::MAX], 1.5, Real::log2, libm::log2),
    ("log", [-1e30, f32::MAX], 1.0, Real::log, libm::log),
    ("inverse_sqrt", [f32::MIN_POSITIVE, f32::MAX], 1.5, Real::inverse_sqrt, |x| 1.0 / x.sqrt()),
    ("sin", [-8192.0, 8192.0], 2.5, Real::sin, libm::sin),
    ("cos", [-8192.0, 8192.0], 2.5, Real::cos, libm::cos),
];

fn check(stride: usize) {
    let mut failures = Vec::new();
    for (name, range, admitted, found, exact) in FUNCTIONS {
        let (error, x) = worst(range, stride, found, exact);
        if error > admitted {
            failures.push(format!("{name}({x:e}) is {error:.3} ULP off; {admitted} are admitted"));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn functions_are_as_accurate_as_documented() {
    check(STRIDE);
    // Near 1 a logarithm is small, and its relative error large if anywhere.
    for (name, found, exact) in [
        ("log2", Real::<Scalar>::log2 as fn(Real) -> Real, libm::log2 as fn(f64) -> f64),
        ("log", Real::log, libm::log),
    ] {
        let (error, x) = worst([0.99, 1.01], 7, found, exact);
        assert!(error <= 1.5, "{name}({x:e}) is {error:.3} ULP off");
    }
}

#[test]
#[ignore = "ten minutes in release mode"]
fn every_float_is_as_accurate_as_documented() {
    check(1);
}

#[test]
fn sine_and_cosine_are_accurate_at_their_zeros() {
    // The nearer to a multiple of π/2, the fewer digits are left of the angle when the quarter turns are gone.
    for quarters in 1..5215_u16 {
        let zero = (f64::from(quarters) * core::f64::consts::FRAC_PI_2) as f32;
        for bits in zero.to_bits() - 20..zero.to_bits() + 20 {
            let x = f32::from_bits(bits);
            let (sin, cos) = libm::sincos(f64::from(x));
            let found = Real::<Scalar>(x).sin_cos();
            assert!(ulps(found.0.0, sin) <= 2.5, "sin({x:e}) is {:e}, not {sin:e}", found.0.0);
            assert!(ulps(found.1.0, cos) <= 2.5, "cos({x:e}) is {:e}, not {cos:e}", found.1.0);
        }
    }
}

#[test]
fn sine_and_cosine_stay_between_minus_1_and_1() {
    for bits in (0..f32::INFINITY.to_bits()).step_by(STRIDE) {
        let (sin, cos) = Real::<Scalar>(f32::from_bits(bits)).sin_cos();
        assert!(sin.0.abs() <= 1.0 && cos.0.abs() <= 1.0, "{:e}", f32::from_bits(bits));
    }
}

#[test]
fn powers_are_as_accurate_as_documented() {
    for n in [0.5, 2.2, 1.0 / 2.4, 5.0, 64.0, 1000.0, -1.0, -3.5] {
        for bits in (0..f32::INFINITY.to_bits()).step_by(STRIDE) {
            let x = f32::from_bits(bits);
            let (found, exact) = (Real::<Scalar>(x).powf(n).0, libm::pow(f64::from(x), f64::from(n)));
            let size = (f64::from(n) * libm::log2(f64::from(x))).abs();
            if size < 125.9 {
                let error = ulps(found, exact);
                assert!(error <= 1.5 + 1.5 * size, "{x:e} to the power of {n} is {error:.1} ULP off");
            } else if size > 126.1 && exact < 1.0 {
                assert!(found == 0.0, "{x:e} to the power of {n} is {found:e}");
            } else if size > 128.1 {
                assert!(found == f32::INFINITY, "{x:e} to the power of {n} is {found:e}");
            }
        }
    }
}

#[test]
fn whole_powers_of_two_are_exact() {
    for n in -126_i16..128 {
        let power = libm::exp2(f64::from(n)) as f32;
        assert_eq!(Real::<Scalar>(f32::from(n)).exp2().0, power, "2 to the power of {n}");
        assert_eq!(Real::<Scalar>(power).log2().0, f32::from(n), "log2({power:e})");
    }
    // Subnormal arguments count as they are.
    assert_eq!(Real::<Scalar>(f32::from_bits(1)).log2().0, -149.0);
}

#[test]
fn inverse_square_roots_of_odd_numbers() {
    let found = |x: f32| Real::<Scalar>(x).inverse_sqrt().0;
    assert_eq!([1.0, 4.0, 25.0, 1e-20, f32::MAX].map(found), [1.0, 0.5, 0.2, 1e10, 5.421_011e-20]);
    assert_eq!(
        [0.0, -0.0, f32::from_bits(1), f32::INFINITY].map(found),
        [f32::INFINITY, f32::INFINITY, f32::INFINITY, 0.0]
    );
    assert!([-1.0, f32::NEG_INFINITY, f32::NAN].into_iter().all(|x| found(x).is_nan()));
}

#[test]
fn normalized_vectors_are_of_length_1() {
    let mut random = crate::lanes::conformance::Random(3);
    for _ in 0..100_000 {
        let v = [random.number(1.0), random.number(1.0), random.number(1.0)];
        let length = v.iter().map(|&x| f64::from(x) * f64::from(x)).sum::<f64>().sqrt();
        let found: [f32; 3] = Vec3::<Scalar>::from(v).normalize().into();
        for (found, x) in found.iter().zip(v) {
            assert!(ulps(*found, f64::from(x) / length) <= 3.0, "{v:?} gives {found}");
        }
    }
}

#[test]
fn normalize_gives_zero_where_there_is_no_direction() {
    let normalized = |v: [f32; 2]| -> [f32; 2] { Vec2::<Scalar>::from(v).normalize().into() };
    assert_eq!(normalized([0.0, 0.0]), [0.0, 0.0]);
    assert_eq!(normalized([-0.0, 0.0]), [0.0, 0.0]);
    assert_eq!(normalized([1e-20, 0.0]), [0.0, 0.0], "its square vanishes");
    assert_eq!(normalized([1e25, 0.0]), [0.0, 0.0], "its square overflows");
    assert_eq!(normalized([3.0, 4.0]), [0.6, 0.8]);
    assert!(normalized([f32::NAN, 1.0]).iter().all(|x| x.is_nan()));
}
