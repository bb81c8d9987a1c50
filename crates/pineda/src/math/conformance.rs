//! The functions of `math`, on every SIMD level of this CPU that shaders are compiled for, bit for bit against scalar code.

#![allow(
    clippy::excessive_precision,
    clippy::approx_constant,
    reason = "these are values to try, written as they come"
)]

use super::{Bool, Mat3, Mat4, Real, Vec3};
use crate::lanes::Lanes;
use crate::lanes::conformance::{SPECIAL, conformance, pairs};

#[test]
fn simple_functions_have_the_same_bits_at_every_level() {
    conformance! {
        check_in_shaders &pairs();
        float max<L>(lanes, a, b) = Real::<L>(a).max(Real(b)).0;
        float min<L>(lanes, a, b) = Real::<L>(a).min(Real(b)).0;
        float clamp<L>(lanes, a, b) = Real::<L>(a).clamp(Real(b), 1.0).0;
        float sign<L>(lanes, a, b) = Real::<L>(a).sign().0;
        float ceil<L>(lanes, a, b) = Real::<L>(a).ceil().0;
        float fract<L>(lanes, a, b) = Real::<L>(a).fract().0;
        float round<L>(lanes, a, b) = Real::<L>(a).round().0;
        float round_ties_even<L>(lanes, a, b) = Real::<L>(a).round_ties_even().0;
        float trunc<L>(lanes, a, b) = Real::<L>(a).trunc().0;
        float modulo<L>(lanes, a, b) = Real::<L>(a).modulo(Real(b)).0;
        float copysign<L>(lanes, a, b) = Real::<L>(a).copysign(Real(b)).0;
        mask is_finite<L>(lanes, a, b) = Real::<L>(a).is_finite().0;
        float mix<L>(lanes, a, b) = Real::<L>(a).mix(Real(b), 0.3).0;
        float step<L>(lanes, a, b) = Real::<L>(a).step(Real(b)).0;
        float smoothstep<L>(lanes, a, b) = Real::<L>(a).smoothstep(-1.0, Real(b)).0;
        float powi_0<L>(lanes, a, b) = Real::<L>(a).powi(0).0;
        float powi_1<L>(lanes, a, b) = Real::<L>(a).powi(1).0;
        float powi_13<L>(lanes, a, b) = Real::<L>(a).powi(13).0;
        mask gt<L>(lanes, a, b) = Real::<L>(a).gt(Real(b)).0;
        mask ge<L>(lanes, a, b) = Real::<L>(a).ge(Real(b)).0;
        mask ne<L>(lanes, a, b) = Real::<L>(a).ne(Real(b)).0;
        mask select_masks<L>(lanes, a, b) = Bool::<L>(L::lt(a, b)).select(Real::<L>(a).lt(0.5), Real(b).lt(0.5)).0;
        float plain_left<L>(lanes, a, b) = (0.1 - 3.0 / Real::<L>(a) + 0.7 * Real(b)).0;
    }
}

#[test]
fn polynomials_have_the_same_bits_at_every_level() {
    // A prime stride through all 2^32 floats, and the special ones.
    let mut pairs: Vec<(u32, u32)> = (0..u32::MAX).step_by(16_411).map(|bits| (bits, 0)).collect();
    pairs.extend(SPECIAL.map(|x| (x.to_bits(), 0)));
    conformance! {
        check_in_shaders &pairs;
        float exp2<L>(lanes, a, b) = Real::<L>(a).exp2().0;
        float exp<L>(lanes, a, b) = Real::<L>(a).exp().0;
        float log2<L>(lanes, a, b) = Real::<L>(a).log2().0;
        float log<L>(lanes, a, b) = Real::<L>(a).log().0;
        float inverse_sqrt<L>(lanes, a, b) = Real::<L>(a).inverse_sqrt().0;
        float tan<L>(lanes, a, b) = Real::<L>(a).tan().0;
        float asin<L>(lanes, a, b) = Real::<L>(a).asin().0;
        float acos<L>(lanes, a, b) = Real::<L>(a).acos().0;
        float atan<L>(lanes, a, b) = Real::<L>(a).atan().0;
        float cbrt<L>(lanes, a, b) = Real::<L>(a).cbrt().0;
        float linear_to_srgb<L>(lanes, a, b) = Real::<L>(a).linear_to_srgb().0;
        float srgb_to_linear<L>(lanes, a, b) = Real::<L>(a).srgb_to_linear().0;
        float sin<L>(lanes, a, b) = Real::<L>(a).sin().0;
        float cos<L>(lanes, a, b) = Real::<L>(a).cos().0;
        float sin_2_pi<L>(lanes, a, b) = (Real::<L>(a).fract() * 6.28).sin().0;
    }
}

#[test]
fn powers_and_angles_have_the_same_bits_at_every_level() {
    conformance! {
        check_in_shaders &pairs();
        float atan2<L>(lanes, a, b) = Real::<L>(a).atan2(Real(b)).0;
        float powf<L>(lanes, a, b) = Real::<L>(a).powf(Real(b)).0;
        float powf_of_abs<L>(lanes, a, b) = Real::<L>(a).abs().powf(Real(b)).0;
        float powf_64<L>(lanes, a, b) = Real::<L>(a).fract().powf(64.0).0;
        float powf_gamma<L>(lanes, a, b) = Real::<L>(a).abs().powf(1.0 / 2.4).0;
    }
}

#[test]
fn vectors_have_the_same_bits_at_every_level() {
    conformance! {
        check_in_shaders &pairs();
        float dot<L>(lanes, a, b) = vector::<L>(a, b).dot([0.1, -0.2, 0.3]).0;
        float length<L>(lanes, a, b) = vector::<L>(a, b).length().0;
        float distance<L>(lanes, a, b) = vector::<L>(a, b).distance([1.0, 2.0, 3.0]).0;
        float normalize<L>(lanes, a, b) = vector::<L>(a, b).normalize().dot([1.0, 10.0, 100.0]).0;
        float cross<L>(lanes, a, b) = vector::<L>(a, b).cross([1.0, 2.0, 3.0]).dot([1.0, 10.0, 100.0]).0;
        float reflect<L>(lanes, a, b) = vector::<L>(a, b).reflect([0.6, 0.0, 0.8]).dot([1.0, 10.0, 100.0]).0;
        float mix<L>(lanes, a, b) = vector::<L>(a, b).mix([1.0, 2.0, 3.0], Real(a)).dot([1.0, 10.0, 100.0]).0;
        float clamp<L>(lanes, a, b) = vector::<L>(a, b).clamp(-2.0, [3.0, 4.0, 5.0]).dot([1.0, 10.0, 100.0]).0;
        float refract<L>(lanes, a, b) = vector::<L>(a, b).refract([0.6, 0.0, 0.8], 0.7).dot([1.0, 10.0, 100.0]).0;
        float small_matrix<L>(lanes, a, b) = Mat3::new(vector::<L>(a, b), vector(b, a), vector(b, b)).inverse().determinant().0;
        float matrix<L>(lanes, a, b) = (Mat4::rotation_x(1.0) * vector::<L>(a, b).extend(1.0)).dot([1.0, 2.0, 3.0, 4.0]).0;
    }
}

#[inline(always)]
fn vector<L: Lanes>(a: L::F, b: L::F) -> Vec3<L> {
    Vec3::new(Real(a), Real(b), Real(a) * 0.25 + 1.5)
}
