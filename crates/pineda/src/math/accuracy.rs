//! What is said of the functions' values and is no matter of every float: those are judged by `pineda_proof::ulp`, a sample in its tests, and
//! all of them by `cargo xtask ulp`.

use super::{Real, Vec2, Vec3};
use crate::lanes::Scalar;

/// A prime, so that no bit pattern is left out by system.
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

#[test]
fn angles_are_accurate_at_the_multiples_of_a_quarter_turn() {
    // The nearer to a multiple of π/2, the fewer digits are left of the angle when the quarter turns are gone. The last of these is the float that
    // is nearest of all to one, by 2^-31 quarters, and takes the other way.
    let mut angles: Vec<f32> = (1..166_886_u32).map(|k| (f64::from(k) * core::f64::consts::FRAC_PI_2) as f32).collect();
    // Next to a pole; its tangent was off by 0.61 ULP, for its sine had been the difference of two numbers near 1.
    angles.push(-1_522_788_990_976.0);
    angles.extend([262_144.0, 262_144.03, f32::MAX, 16_367_173.0 * libm::exp2f(72.0)]);
    for x in angles {
        let found = [Real::<Scalar>(x).sin(), Real(x).cos(), Real(x).tan()];
        let (sin, cos) = libm::sincos(f64::from(x));
        for (found, exact) in found.into_iter().zip([sin, cos, libm::tan(f64::from(x))]) {
            assert!(ulps(found.0, exact) <= 0.51, "{x:e}: {:e}, not {exact:e}", found.0);
        }
    }
}

#[test]
fn a_huge_angle_changes_nothing_for_its_neighbours() {
    use crate::lanes::Packet;
    let mut angles: [f32; 16] = core::array::from_fn(|k| 1000.3 * k as f32 - 7.0);
    let alone = angles.map(|x| Real::<Scalar>(x).sin().0);
    angles[5] = 1e30;
    for level in crate::lanes::conformance::shader_levels() {
        let mut found = [0.0; 16];
        crate::wide::dispatch_shader!(level, simd => Real::load(Packet(simd), &angles).sin().store(&mut found));
        for k in 0..16 {
            assert!(k == 5 || found[k].to_bits() == alone[k].to_bits(), "lane {k} at {level:?}");
        }
        assert!(ulps(found[5], libm::sin(f64::from(1e30_f32))) <= 0.51);
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
