//! From clip space to the picture, exactly.

use crate::coverage::Point;
use crate::snap::{Rational, rational, snap_unambiguous};

/// Where a clip-space vertex (x, y, z, w) lands in a picture of `width` x `height` pixels: (x px right, y px down).
///
/// `((x / w + 1) / 2 * width, (1 - y / w) / 2 * height)`, without rounding, for either sign of w. `None` if w is zero or
/// if x, y or w is not finite.
pub fn project_exact(vertex: [f32; 4], width: u32, height: u32) -> Option<[Rational; 2]> {
    let [x, y, _, w] = vertex;
    let (x, y, w) = (rational(x)?, rational(y)?, rational(w)?);
    if w.is_zero() {
        return None;
    }
    let half = |size: u32| Rational::from_parts(size.into(), 2u8.into());
    Some([(x / &w + Rational::ONE) * half(width), (Rational::ONE - y / w) * half(height)])
}

/// The snapped position of a clip-space vertex, unless an error of `tolerance` px before snapping could change it.
///
/// The rasterizer projects in f64 and so may be off by a tiny part of a pixel, which matters only next to a tie: tests
/// leave such vertices (`None`) out.
pub fn project_snapped(vertex: [f32; 4], width: u32, height: u32, tolerance: f64) -> Option<Point> {
    let [x, y] = project_exact(vertex, width, height)?;
    Some([snap_unambiguous(&x, tolerance)?, snap_unambiguous(&y, tolerance)?])
}
