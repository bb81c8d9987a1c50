//! Barycentric coordinates, depth and attributes, exactly; and how far an answer in floats is from them.

use crate::coverage::{Triangle, centre, edge};
use crate::snap::{Rational, rational};

/// The barycentric coordinates of a pixel's centre in a snapped triangle, which sum to one. Outside the triangle they are
/// extrapolated. `None` if the triangle has no area.
pub fn barycentrics([a, b, c]: Triangle, pixel: [i64; 2]) -> Option<[Rational; 3]> {
    let (p, area) = (centre(pixel), edge(a, b, c));
    let divide = |e: i64| Rational::from_parts((e * area.signum()).into(), area.unsigned_abs().into());
    (area != 0).then(|| [edge(b, c, p), edge(c, a, p), edge(a, b, p)].map(divide))
}

/// Perspective-correct weights from barycentric coordinates of the picture: lambda_i / w_i, made to sum to one.
///
/// `None` if a w is zero or not finite, or if the point is on the vanishing line (extrapolated there, all is infinite).
pub fn perspective([l0, l1, l2]: &[Rational; 3], [w0, w1, w2]: [f32; 3]) -> Option<[Rational; 3]> {
    let (w0, w1, w2) = (rational(w0)?, rational(w1)?, rational(w2)?);
    if [&w0, &w1, &w2].into_iter().any(Rational::is_zero) {
        return None;
    }
    let weights = [l0 / w0, l1 / w1, l2 / w2];
    let sum = &weights[0] + &weights[1] + &weights[2];
    (!sum.is_zero()).then(|| weights.map(|weight| weight / &sum))
}

/// The weighted sum of three values at the corners. Depth takes the weights of [`barycentrics`] (z is linear in raster
/// space), other attributes those of [`perspective`]. `None` if a value is not finite.
pub fn interpolate([b0, b1, b2]: &[Rational; 3], [f0, f1, f2]: [f32; 3]) -> Option<Rational> {
    Some(b0 * rational(f0)? + b1 * rational(f1)? + b2 * rational(f2)?)
}

/// |answer - exact|, correctly rounded to f64; infinite if the answer is not finite.
pub fn error(answer: f32, exact: &Rational) -> f64 {
    rational(answer).map_or(f64::INFINITY, |answer| (answer - exact).to_f64().value().abs())
}

/// |answer - exact| in units of the last place that an f32 has at |exact|: 0.5 is as good as rounding once.
pub fn error_in_ulps(answer: f32, exact: &Rational) -> f64 {
    // Powers of two are exact in f64; below the normal numbers the spacing of f32 no longer shrinks.
    let magnitude = exact.to_f64().value().abs().max(f64::from(f32::MIN_POSITIVE));
    let power_of_two = f64::from_bits(magnitude.to_bits() & 0x7ff0_0000_0000_0000);
    error(answer, exact) / (power_of_two * f64::from(f32::EPSILON))
}
