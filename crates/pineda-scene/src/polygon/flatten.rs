//! From a polygon in space to one in the plane, and whether that is convex.

use crate::vector::{Vec3, add, cross, widen};

/// A polygon's corners in the plane.
pub(super) type Point = [f64; 2];

/// Projects a polygon along the axis that is closest to its normal (Newell's: half the sum of the cross products of
/// successive corners, the normal of the best-fit plane) so that it runs counter-clockwise. `false` if it has no
/// plane: all corners on a line, or not finite.
///
/// Dropping a coordinate shears the best-fit plane onto the axis plane. That keeps points on a line, orders along it
/// and insides of triangles, which is all that triangulation asks; and it keeps the file's own coordinates, so that
/// corners that are exactly on a line stay so.
pub(super) fn flatten(positions: impl Iterator<Item = [f32; 3]>, points: &mut Vec<Point>) -> bool {
    let positions: Vec<Vec3> = positions.map(widen).collect();
    let mut normal = [0.0; 3];
    // Relative to a corner, so that a small polygon far from the origin keeps its digits.
    let origin = positions[0];
    let relative = |i: usize| crate::vector::sub(positions[i % positions.len()], origin);
    for i in 0..positions.len() {
        normal = add(normal, cross(relative(i), relative(i + 1)));
    }
    let [x, y, z] = normal.map(f64::abs);
    points.clear();
    if !(x + y + z > 0.0 && (x + y + z).is_finite()) {
        return false;
    }
    let (mut u, mut v, along) = if x >= y && x >= z {
        (1, 2, 0)
    } else if y >= z {
        (2, 0, 1)
    } else {
        (0, 1, 2)
    };
    if normal[along] < 0.0 {
        std::mem::swap(&mut u, &mut v);
    }
    points.extend(positions.iter().map(|p| [p[u], p[v]]));
    true
}

/// Twice the area of the triangle a, b, c: positive if it runs counter-clockwise. Differences of f32 coordinates of
/// like size are exact in f64.
pub(super) fn area_x2(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether a counter-clockwise polygon turns left at every corner, and once around in all.
pub(super) fn is_strictly_convex(points: &[Point]) -> bool {
    let n = points.len();
    let corner = |i: usize| points[i % n];
    // A polygon that goes around once changes between forward and backward edges twice; a pentagram does four times.
    let is_forward = |i: usize| {
        let (a, b) = (corner(i), corner(i + 1));
        (b[0], b[1]) > (a[0], a[1])
    };
    let mut turns = 0;
    for i in 0..n {
        if area_x2(corner(i), corner(i + 1), corner(i + 2)) <= 0.0 {
            return false;
        }
        turns += u32::from(is_forward(i) != is_forward(i + 1));
    }
    turns <= 2
}
