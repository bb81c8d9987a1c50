//! Snapping: the only rounding that the rules ask for.
//!
//! D3D11.3 functional spec, 3.4.1: x and y of every vertex go to the nearest 1/256 pixel, ties to the even one.

use dashu_int::IBig;
pub use dashu_ratio::RBig as Rational;

/// The rational that a float stands for; `None` for NaN and infinity. Every finite float is one, exactly.
pub fn rational(x: f32) -> Option<Rational> {
    Rational::try_from(x).ok()
}

/// Snaps a coordinate in pixels to 1/256 pixel, ties to even. Works on the float's bits, with integers.
///
/// `None` for NaN, infinity and |x| >= 2^48 pixels (far beyond any guard band).
pub fn snap(x: f64) -> Option<i64> {
    if x.is_nan() || x.abs() >= 2f64.powi(48) {
        return None;
    }
    let bits = x.to_bits();
    let stored_exponent = (bits >> 52 & 0x7ff) as i64;
    let fraction = (bits & ((1 << 52) - 1)) as i128;
    // |x| = mantissa * 2^exponent; subnormal numbers have no hidden bit and the exponent of the smallest normal ones.
    let mantissa = if stored_exponent == 0 { fraction } else { fraction | 1 << 52 };
    let exponent = stored_exponent.max(1) - 1075 + 8; // 2^8 subpixels in a pixel
    let magnitude = if exponent >= 0 {
        mantissa << exponent
    } else if exponent < -60 {
        0 // less than 2^53 * 2^-60 subpixels, nowhere near one half
    } else {
        let one = 1i128 << -exponent;
        let (whole, rest) = (mantissa / one, mantissa % one);
        let round_up = 2 * rest > one || (2 * rest == one && whole % 2 == 1);
        whole + round_up as i128
    };
    let sign = if x < 0.0 { -1 } else { 1 };
    Some(sign * magnitude as i64)
}

/// Snaps an exact coordinate in pixels to 1/256 pixel, ties to even.
pub fn snap_exact(x: &Rational) -> IBig {
    let subpixels = x * Rational::from(256);
    let below = subpixels.floor();
    let half = Rational::from_parts(1.into(), 2u8.into());
    let rest = &subpixels - Rational::from(below.clone());
    let odd = !(&below % IBig::from(2)).is_zero();
    if rest > half || (rest == half && odd) { below + 1 } else { below }
}

/// Whether `candidate` (in 1/256 px) is what a position `exact` (in px) may snap to, if it was computed with an error
/// of at most `tolerance` px before snapping.
pub fn snapped_within(candidate: i64, exact: &Rational, tolerance: f64) -> bool {
    let (low, high) = around(exact, tolerance);
    snap_exact(&low) <= IBig::from(candidate) && IBig::from(candidate) <= snap_exact(&high)
}

/// What `exact` (in px) snaps to, unless an error of `tolerance` px could have made it snap to something else.
///
/// `None` within a hair of a tie and beyond the range of `i64`.
pub fn snap_unambiguous(exact: &Rational, tolerance: f64) -> Option<i64> {
    let (low, high) = around(exact, tolerance);
    let snapped = snap_exact(&low);
    if snapped == snap_exact(&high) { i64::try_from(snapped).ok() } else { None }
}

fn around(exact: &Rational, tolerance: f64) -> (Rational, Rational) {
    let tolerance = Rational::try_from(tolerance).expect("a tolerance is a finite number");
    (exact - &tolerance, exact + &tolerance)
}
