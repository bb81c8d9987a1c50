//! What the functions give at the edges of their domains, as their documentation says.

use super::{Real, Vec3};
use crate::lanes::Scalar;

const INFINITY: f32 = f32::INFINITY;
const NAN: f32 = f32::NAN;

/// Checks a function at the given points, bit by bit (so -0 is not 0), any NaN being like another.
fn check(name: &str, function: impl Fn(Real) -> Real, points: &[(f32, f32)]) {
    for &(x, expected) in points {
        let found = function(Real(x)).0;
        let same = found.to_bits() == expected.to_bits() || (found.is_nan() && expected.is_nan());
        assert!(same, "{name}({x}) is {found}, not {expected}");
    }
}

#[test]
fn exponentials() {
    check("exp2", Real::exp2, &[(0.0, 1.0), (-0.0, 1.0), (1e-45, 1.0), (-126.0, f32::MIN_POSITIVE), (-126.00001, 0.0)]);
    check("exp2", Real::exp2, &[(127.0, 1.7014118e38), (128.0, INFINITY), (1e30, INFINITY), (-1e30, 0.0), (NAN, NAN)]);
    check("exp2", Real::exp2, &[(INFINITY, INFINITY), (-INFINITY, 0.0), (127.99999, 3.4028056e38)]);
    check(
        "exp",
        Real::exp,
        &[(0.0, 1.0), (-0.0, 1.0), (1.0, core::f32::consts::E), (-87.33655, 0.0), (88.72284, INFINITY)],
    );
    check(
        "exp",
        Real::exp,
        &[(INFINITY, INFINITY), (-INFINITY, 0.0), (NAN, NAN), (1e-45, 1.0), (-1e30, 0.0), (1e30, INFINITY)],
    );
}

#[test]
fn logarithms() {
    for (name, function) in [("log2", Real::log2 as fn(Real) -> Real), ("log", Real::log)] {
        check(name, function, &[(1.0, 0.0), (0.0, -INFINITY), (-0.0, -INFINITY), (INFINITY, INFINITY), (NAN, NAN)]);
        check(name, function, &[(-1.0, NAN), (-1e-45, NAN), (-INFINITY, NAN)]);
    }
    check("log2", Real::log2, &[(1e-45, -149.0), (f32::MIN_POSITIVE, -126.0), (8.0, 3.0)]);
}

#[test]
fn powers() {
    for n in [1e-45, 0.5, 1.0, 64.0, f32::MAX] {
        check(
            "powf(positive)",
            |x| x.powf(n),
            &[(0.0, 0.0), (-0.0, 0.0), (1.0, 1.0), (INFINITY, INFINITY), (NAN, NAN)],
        );
        check("powf(negative)", |x| x.powf(-n), &[(0.0, INFINITY), (1.0, 1.0), (INFINITY, 0.0), (NAN, NAN)]);
        check("powf", |x| x.powf(n), &[(-1.0, NAN), (-0.5, NAN), (-INFINITY, NAN)]);
    }
    check("powf(0)", |x| x.powf(0.0), &[(0.0, 1.0), (1.0, 1.0), (-2.0, 1.0), (INFINITY, 1.0), (NAN, 1.0)]);
    check("powf(NaN)", |x| x.powf(NAN), &[(0.0, NAN), (1.0, NAN), (2.0, NAN)]);
    check("powf(infinity)", |x| x.powf(INFINITY), &[(0.5, 0.0), (2.0, INFINITY), (1.0, NAN)]);
    check("powf(64)", |x| x.powf(64.0), &[(0.1, 0.0), (1e-45, 0.0), (10.0, INFINITY), (2.0, 1.8446744e19)]);
    check("powi(0)", |x| x.powi(0), &[(0.0, 1.0), (NAN, 1.0)]);
    check("powi(5)", |x| x.powi(5), &[(-2.0, -32.0), (0.0, 0.0), (3.0, 243.0), (-INFINITY, -INFINITY), (NAN, NAN)]);
    check("powi(1)", |x| x.powi(1), &[(0.1, 0.1)]);
    check("powi(64)", |x| x.powi(64), &[(2.0, 1.8446744e19)]);
}

#[test]
fn trigonometry() {
    check("sin", Real::sin, &[(0.0, 0.0), (-0.0, 0.0), (1e-45, 1e-45), (INFINITY, NAN), (-INFINITY, NAN), (NAN, NAN)]);
    check("cos", Real::cos, &[(0.0, 1.0), (-0.0, 1.0), (1e-45, 1.0), (INFINITY, NAN), (-INFINITY, NAN), (NAN, NAN)]);
    check("sin", Real::sin, &[(1048576.1, 0.0), (f32::MAX, 0.0), (core::f32::consts::FRAC_PI_2, 1.0)]);
    check("cos", Real::cos, &[(1048576.1, 1.0), (f32::MIN, 1.0), (core::f32::consts::PI, -1.0)]);
}

#[test]
fn minimum_maximum_and_sign() {
    check("max(0)", |x| x.max(0.0), &[(1.0, 1.0), (-1.0, 0.0), (NAN, 0.0), (INFINITY, INFINITY)]);
    check("max(NaN)", |x| x.max(NAN), &[(1.0, NAN)]);
    check("min(1)", |x| x.min(1.0), &[(2.0, 1.0), (0.5, 0.5), (NAN, 1.0)]);
    check("clamp(0, 1)", |x| x.clamp(0.0, 1.0), &[(2.0, 1.0), (0.5, 0.5), (-2.0, 0.0), (NAN, 0.0)]);
    check("clamp(1, 0)", |x| x.clamp(1.0, 0.0), &[(2.0, 0.0), (0.5, 0.0)]);
    check("sign", Real::sign, &[(3.0, 1.0), (-1e-45, -1.0), (0.0, 0.0), (-0.0, 0.0), (NAN, NAN), (-INFINITY, -1.0)]);
    check("abs", Real::abs, &[(-3.0, 3.0), (-0.0, 0.0)]);
}

#[test]
fn whole_and_broken_parts() {
    check("floor", Real::floor, &[(1.5, 1.0), (-1.5, -2.0), (-0.0, -0.0), (-0.3, -1.0), (8388609.0, 8388609.0)]);
    check("floor", Real::floor, &[(INFINITY, INFINITY), (NAN, NAN), (-1e-45, -1.0), (1e-45, 0.0)]);
    check("ceil", Real::ceil, &[(1.5, 2.0), (-1.5, -1.0), (-0.3, -0.0), (0.0, 0.0), (3.0, 3.0)]);
    check("fract", Real::fract, &[(1.25, 0.25), (-1.25, 0.75), (-1e-45, 1.0), (INFINITY, NAN)]);
}

#[test]
fn steps() {
    check("step(1)", |x| x.step(1.0), &[(0.5, 0.0), (1.0, 1.0), (2.0, 1.0), (NAN, 1.0)]);
    check(
        "smoothstep(1, 3)",
        |x| x.smoothstep(1.0, 3.0),
        &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.5), (3.0, 1.0), (4.0, 1.0)],
    );
    check("smoothstep(1, 1)", |x| x.smoothstep(1.0, 1.0), &[(0.5, 0.0), (1.0, 0.0), (1.5, 1.0)]);
    check("smoothstep", |x| x.smoothstep(0.0, 1.0), &[(NAN, 0.0), (INFINITY, 1.0), (-INFINITY, 0.0)]);
    check("mix(3, 1/2)", |x| x.mix(3.0, 0.5), &[(1.0, 2.0)]);
}

#[test]
fn vectors() {
    let v = |a: [f32; 3]| Vec3::<Scalar>::from(a);
    assert_eq!(v([1.0, 0.0, 0.0]).cross([0.0, 1.0, 0.0]), v([0.0, 0.0, 1.0]), "right-handed");
    assert_eq!(v([1.0, -1.0, 0.0]).reflect([0.0, 1.0, 0.0]), v([1.0, 1.0, 0.0]));
    assert_eq!(v([1.0, 2.0, 3.0]).dot([4.0, 5.0, 6.0]).0, 32.0);
    assert_eq!(v([1.0, 2.0, 2.0]).length().0, 3.0);
    assert_eq!(v([1.0, 2.0, 3.0]).distance([1.0, 5.0, 7.0]).0, 5.0);
    assert_eq!(v([0.0, 2.0, 4.0]).lerp([2.0, 2.0, 0.0], 0.5), v([1.0, 2.0, 2.0]));
    assert_eq!([1.0, 2.0, 3.0] - v([1.0, 1.0, 1.0]) * 2.0, v([-1.0, 0.0, 1.0]));
    assert_eq!([2.0, 4.0, 6.0] / Real::<Scalar>(2.0), v([1.0, 2.0, 3.0]));
    let mut sum = v([1.0, 1.0, 1.0]);
    sum += [1.0, 2.0, 3.0];
    sum *= 2.0;
    assert_eq!(sum, v([4.0, 6.0, 8.0]));
}
