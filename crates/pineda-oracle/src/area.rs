//! How much of a pixel a convex polygon covers, exactly.

use crate::coverage::{Point, SUBPIXELS};
use crate::snap::Rational;

/// The part of pixel (i, j) inside a convex polygon, 0 to 1. Its corners are in 1/256 pixel and go clockwise in the picture (y down): the pixel's square is cut along one
/// edge after the other, and what is left is measured.
pub fn covered_area(corners: &[Point], [i, j]: [i64; 2]) -> Rational {
    let square = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
    let mut left: Vec<[Rational; 2]> = square.map(|p| p.map(|v| Rational::from(v * SUBPIXELS))).into();
    for (k, p) in corners.iter().enumerate() {
        left = cut(&left, *p, corners[(k + 1) % corners.len()]);
    }
    let twice = left.iter().zip(left.iter().cycle().skip(1)).map(|(p, q)| &p[0] * &q[1] - &q[0] * &p[1]);
    twice.fold(Rational::ZERO, |sum, part| sum + part) / Rational::from(2 * SUBPIXELS * SUBPIXELS)
}

/// What of a polygon lies to the right of a line, as one goes from a to b.
fn cut(polygon: &[[Rational; 2]], a: Point, b: Point) -> Vec<[Rational; 2]> {
    let [dx, dy] = [0, 1].map(|axis| Rational::from(b[axis] - a[axis]));
    let inside = |p: &[Rational; 2]| &dx * (&p[1] - Rational::from(a[1])) - &dy * (&p[0] - Rational::from(a[0]));
    let mut left = Vec::new();
    for (p, q) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (at_p, at_q) = (inside(p), inside(q));
        if at_p >= Rational::ZERO {
            left.push(p.clone());
        }
        if (at_p > Rational::ZERO && at_q < Rational::ZERO) || (at_p < Rational::ZERO && at_q > Rational::ZERO) {
            let t = &at_p / (&at_p - &at_q);
            left.push([0, 1].map(|axis| &p[axis] + (&q[axis] - &p[axis]) * &t));
        }
    }
    left
}
