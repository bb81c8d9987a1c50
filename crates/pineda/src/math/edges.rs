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
    use core::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    for (name, function) in
        [("sin", Real::sin as fn(Real) -> Real), ("tan", Real::tan), ("asin", Real::asin), ("atan", Real::atan)]
    {
        check(name, function, &[(0.0, 0.0), (-0.0, -0.0), (1e-45, 1e-45), (-1e-40, -1e-40), (NAN, NAN)]);
    }
    for (name, function) in [("sin", Real::sin as fn(Real) -> Real), ("cos", Real::cos), ("tan", Real::tan)] {
        check(name, function, &[(INFINITY, NAN), (-INFINITY, NAN), (NAN, NAN)]);
    }
    check("cos", Real::cos, &[(0.0, 1.0), (-0.0, 1.0), (1e-45, 1.0), (PI, -1.0)]);
    check("sin", Real::sin, &[(FRAC_PI_2, 1.0), (-FRAC_PI_2, -1.0), (f32::MAX, -0.5218765), (262144.0, -0.08410703)]);
    check("tan", Real::tan, &[(FRAC_PI_4, 1.0), (FRAC_PI_2, -22877332.0)]);
    check("asin", Real::asin, &[(1.0, FRAC_PI_2), (-1.0, -FRAC_PI_2), (1.0000001, NAN), (-INFINITY, NAN)]);
    check(
        "acos",
        Real::acos,
        &[(1.0, 0.0), (-1.0, PI), (0.0, FRAC_PI_2), (-0.0, FRAC_PI_2), (1.0000001, NAN), (NAN, NAN)],
    );
    check(
        "atan",
        Real::atan,
        &[(1.0, FRAC_PI_4), (INFINITY, FRAC_PI_2), (-INFINITY, -FRAC_PI_2), (f32::MAX, FRAC_PI_2)],
    );
}

#[test]
fn the_angle_of_a_point_is_as_annex_f_of_c99_has_it() {
    use core::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    let points = |x: f32| move |y: Real| y.atan2(x);
    for sign in [1.0, -1.0] {
        let zero = 0.0 * sign;
        check(
            "atan2(y, 0)",
            points(0.0),
            &[(zero, zero), (sign * 1e-45, sign * FRAC_PI_2), (sign * INFINITY, sign * FRAC_PI_2)],
        );
        check("atan2(y, -0)", points(-0.0), &[(zero, sign * PI), (sign, sign * FRAC_PI_2)]);
        check(
            "atan2(y, 1)",
            points(1.0),
            &[(zero, zero), (sign, sign * FRAC_PI_4), (sign * INFINITY, sign * FRAC_PI_2)],
        );
        check("atan2(y, -1)", points(-1.0), &[(zero, sign * PI), (sign, sign * 3.0 * FRAC_PI_4)]);
        check(
            "atan2(y, infinity)",
            points(INFINITY),
            &[(zero, zero), (sign * f32::MAX, zero), (sign * INFINITY, sign * FRAC_PI_4)],
        );
        check(
            "atan2(y, -infinity)",
            points(-INFINITY),
            &[(sign, sign * PI), (sign * INFINITY, sign * 3.0 * FRAC_PI_4)],
        );
    }
    check("atan2(y, NaN)", points(NAN), &[(0.0, NAN), (1.0, NAN), (INFINITY, NAN)]);
    check("atan2(NaN, x)", points(1.0), &[(NAN, NAN)]);
    // The quotient vanishes, or is more than any float.
    check("atan2", points(1e30), &[(1e-45, 0.0), (-1e-20, -0.0)]);
    check("atan2", points(1e-45), &[(f32::MAX, FRAC_PI_2)]);
}

#[test]
fn cube_roots() {
    check("cbrt", Real::cbrt, &[(27.0, 3.0), (-8.0, -2.0), (0.0, 0.0), (-0.0, -0.0), (1e-45, 1.1190347e-15)]);
    check("cbrt", Real::cbrt, &[(INFINITY, INFINITY), (-INFINITY, -INFINITY), (NAN, NAN), (f32::MAX, 6.9814636e12)]);
}

#[test]
fn the_srgb_curve() {
    let same = [(0.0, 0.0), (-0.0, -0.0), (1.0, 1.0), (INFINITY, INFINITY), (-INFINITY, -INFINITY), (NAN, NAN)];
    check("linear_to_srgb", Real::linear_to_srgb, &same);
    check("srgb_to_linear", Real::srgb_to_linear, &same);
    check("linear_to_srgb", Real::linear_to_srgb, &[(-0.001, -0.012920001), (0.002, 0.025840001)]);
    check("srgb_to_linear", Real::srgb_to_linear, &[(f32::MAX, INFINITY), (1e19, INFINITY), (1e16, 2.208992e38)]);
    // The codes of 8 bits are those of targets and textures.
    for code in 0..=255_u8 {
        let linear = Real::<Scalar>(f32::from(code) / 255.0).srgb_to_linear();
        let value = f64::from(code) / 255.0;
        let exact = if code <= 10 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) } as f32;
        assert!((linear.0 / exact - 1.0).abs() < 2e-7 || code == 0, "code {code}: {linear:?}, not {exact}");
        assert_eq!((linear.linear_to_srgb() * 255.0).round().0, f32::from(code));
    }
    let color = crate::Rgba::<Scalar>::from([0.5, 0.2, 1.0, 0.3]).linear_to_srgb();
    assert_eq!((color.g.0, color.a.0), (0.4845292, 0.3));
    assert_eq!(v([1.0, 1.0, 1.0]).luminance().0, 1.0);
}

#[test]
fn minimum_maximum_and_sign() {
    check("max(0)", |x| x.max(0.0), &[(1.0, 1.0), (-1.0, 0.0), (NAN, 0.0), (INFINITY, INFINITY)]);
    check("max(NaN)", |x| x.max(NAN), &[(1.0, NAN)]);
    check("min(1)", |x| x.min(1.0), &[(2.0, 1.0), (0.5, 0.5), (NAN, 1.0)]);
    check("clamp(0, 1)", |x| x.clamp(0.0, 1.0), &[(2.0, 1.0), (0.5, 0.5), (-2.0, 0.0), (NAN, 0.0)]);
    check("clamp(1, 0)", |x| x.clamp(1.0, 0.0), &[(2.0, 0.0), (0.5, 0.0)]);
    check("sign", Real::sign, &[(3.0, 1.0), (-1e-45, -1.0), (0.0, 0.0), (-0.0, 0.0), (NAN, NAN), (-INFINITY, -1.0)]);
    check("saturate", Real::saturate, &[(2.0, 1.0), (0.5, 0.5), (-2.0, 0.0), (NAN, 0.0)]);
    check("copysign(-0)", |x| x.copysign(-0.0), &[(2.0, -2.0), (-2.0, -2.0), (0.0, -0.0), (INFINITY, -INFINITY)]);
    check("to_radians", Real::to_radians, &[(180.0, core::f32::consts::PI)]);
    check("to_degrees", Real::to_degrees, &[(core::f32::consts::PI, 180.0)]);
    for (x, is) in [(1.0, [false, false, true]), (INFINITY, [false, true, false]), (NAN, [true, false, false])] {
        let x = Real::<Scalar>(x);
        assert_eq!([x.is_nan(), x.is_infinite(), x.is_finite()].map(bool::from), is, "{x:?}");
    }
    check("abs", Real::abs, &[(-3.0, 3.0), (-0.0, 0.0)]);
}

#[test]
fn whole_and_broken_parts() {
    check("floor", Real::floor, &[(1.5, 1.0), (-1.5, -2.0), (-0.0, -0.0), (-0.3, -1.0), (8388609.0, 8388609.0)]);
    check("floor", Real::floor, &[(INFINITY, INFINITY), (NAN, NAN), (-1e-45, -1.0), (1e-45, 0.0)]);
    check("ceil", Real::ceil, &[(1.5, 2.0), (-1.5, -1.0), (-0.3, -0.0), (0.0, 0.0), (3.0, 3.0)]);
    check(
        "round",
        Real::round,
        &[(0.5, 1.0), (-0.5, -1.0), (2.5, 3.0), (-0.3, -0.0), (0.49999997, 0.0), (8388609.0, 8388609.0)],
    );
    check("round", Real::round, &[(INFINITY, INFINITY), (-INFINITY, -INFINITY), (NAN, NAN), (4194303.5, 4194304.0)]);
    check("round_ties_even", Real::round_ties_even, &[(0.5, 0.0), (-0.5, -0.0), (1.5, 2.0), (2.5, 2.0), (-2.6, -3.0)]);
    check("round_ties_even", Real::round_ties_even, &[(8388609.0, 8388609.0), (INFINITY, INFINITY), (NAN, NAN)]);
    check("trunc", Real::trunc, &[(1.9, 1.0), (-1.9, -1.0), (-0.3, -0.0), (-INFINITY, -INFINITY), (NAN, NAN)]);
    check("modulo(3)", |x| x.modulo(3.0), &[(4.0, 1.0), (-1.0, 2.0), (3.0, 0.0), (INFINITY, NAN)]);
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

fn v(a: [f32; 3]) -> Vec3 {
    a.into()
}

#[test]
fn vectors() {
    let glass = v([0.6, -0.8, 0.0]).refract([0.0, 1.0, 0.0], 1.0 / 1.5);
    assert!((glass.length() - 1.0).abs().0 < 1e-6 && (glass.x.0 - 0.4).abs() < 1e-6, "{glass:?}");
    assert_eq!(v([0.8, -0.6, 0.0]).refract([0.0, 1.0, 0.0], 1.5), v([0.0; 3]), "all of it is reflected");
    assert_eq!(v([0.0, 1.0, 0.0]).faceforward([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]), v([0.0, 1.0, 0.0]));
    assert_eq!(v([0.0, 1.0, 0.0]).faceforward([0.0, 1.0, 0.0], [0.0, 1.0, 0.0]), v([0.0, -1.0, 0.0]));
    assert_eq!(v([1.0, 2.0, 3.0]).zxy(), v([3.0, 1.0, 2.0]));
    assert_eq!(v([1.0, 2.0, 3.0]).extend(4.0).wzyx(), [4.0, 3.0, 2.0, 1.0].into());
    assert_eq!(v([1.0, 2.0, 3.0]).xz().cross([0.0, 1.0]), 1.0.into());
    assert_eq!(v([1.5, -2.5, 0.25]).floor(), v([1.0, -3.0, 0.0]));
    assert_eq!(v([1.5, -2.5, 0.25]).smoothstep(0.0, [1.0, 1.0, 0.5]), v([1.0, 0.0, 0.5]));
    assert_eq!(v([1.0, 4.0, 0.25]).powf(0.5), v([1.0, 2.0, 0.5]));
    assert_eq!([v([1.0, 4.0, 0.25]).max_component(), v([1.0, 4.0, 0.25]).min_component()], [4.0.into(), 0.25.into()]);
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
