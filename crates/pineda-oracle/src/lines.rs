//! The pixels of a line one pixel wide, by the definition: Vulkan 1.4, "Bresenham Line Segment Rasterization" (and OpenGL 4.6, 14.5.1).
//!
//! Around each pixel's centre f lies an open diamond:
//!
//! ```text
//!         /\             R_f = { p : |p.x - f.x| + |p.y - f.y| < 1/2 }
//!        /  \
//!        \f /            A line from a to b owns the pixel if it touches R_f, unless b lies in R_f:
//!         \/             it owns the diamonds that it leaves.
//! ```
//!
//! So that nothing ever lies on a diamond's border, both ends are moved by -(e, e^2) for an e that is smaller than anything that matters. That is
//! also what the top-left rule does to triangles: see [`polygon_coverage`](crate::polygon_coverage).
//!
//! How far a point of the line is from f, in the sense of the diamond, is a convex function along the line, made of straight pieces that change where the
//! line passes f to the left or right, above or below. So the smallest value is at one of these places or at an end.

use crate::coverage::{Point, SUBPIXELS, centre};

/// A line from the first point to the second, in 1/256 pixel. |x| and |y| are at most 2^23.
pub type Line = [Point; 2];

/// e is 2^-30 subpixels. The nearest that two things of a line can be without being the same is 2^-24, for no difference of coordinates is larger than
/// 2^24; and whatever e is multiplied by is at least as large as 2^-24, too.
const UNITS: i128 = 1 << 60;
const E: i128 = 1 << 30;
const E_SQUARED: i128 = 1;

/// Whether the line owns pixel (i, j).
pub fn line_covers([a, b]: Line, pixel: [i64; 2]) -> bool {
    // From the pixel's centre, in units of 2^-60 subpixels.
    let moved = |p: Point| {
        let [x, y] = [0, 1].map(|axis| i128::from(p[axis] - centre(pixel)[axis]) * UNITS);
        [x - E, y - E_SQUARED]
    };
    let (a, b) = (moved(a), moved(b));
    let radius = i128::from(SUBPIXELS / 2) * UNITS;
    let is_inside = |p: [i128; 2]| p[0].abs() + p[1].abs() < radius;
    let leaves = !is_inside(b);
    let passes_inside = [0, 1].into_iter().any(|axis| {
        // Where the line passes the centre on this axis, if it does, times the line's extent on it.
        let other = 1 - axis;
        let extent = (b[axis] - a[axis]) / UNITS;
        let passes = a[axis].signum() * b[axis].signum() < 0;
        let there = a[other] * extent - a[axis] * ((b[other] - a[other]) / UNITS);
        passes && there.abs() < radius * extent.abs()
    });
    leaves && (is_inside(a) || passes_inside)
}

/// The pixels of a picture that a line owns, row by row from the top.
pub fn line_coverage(line: Line, width: u32, height: u32) -> Vec<bool> {
    (0..height).flat_map(|j| (0..width).map(move |i| line_covers(line, [i.into(), j.into()]))).collect()
}

/// Whether a point, a square of side `size` around `middle` (in 1/256 pixel), owns pixel (i, j): its left and top border belong to it, the others
/// do not. Where the size is odd, the square reaches a subpixel further right and down.
pub fn point_covers(middle: Point, size: i64, pixel: [i64; 2]) -> bool {
    [0, 1].into_iter().all(|axis| {
        let first = middle[axis] - size.div_euclid(2);
        (first..first + size).contains(&centre(pixel)[axis])
    })
}
