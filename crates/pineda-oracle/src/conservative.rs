//! Which pixels a snapped triangle touches, and which it covers whole: closed squares against closed triangles, by what one sees.
//!
//! Two convex shapes meet if a corner of one lies in the other, or if their outlines cross. One lies in the other if all of its corners do.

use crate::coverage::{Point, SUBPIXELS, Triangle, Winding, edge, winding};

/// Whether the triangle touches pixel (i, j) anywhere, corners and edges of both included. A triangle without area touches nothing.
pub fn touches(triangle: Triangle, pixel: [i64; 2]) -> bool {
    let square = square(pixel);
    winding(triangle) != Winding::Degenerate
        && (square.iter().any(|&corner| contains(triangle, corner))
            || triangle
                .iter()
                .any(|corner| (0..2).all(|axis| (square[0][axis]..=square[2][axis]).contains(&corner[axis])))
            || sides(&triangle).any(|of_triangle| sides(&square).any(|of_square| meet(of_triangle, of_square))))
}

/// Whether the triangle covers all of pixel (i, j); its edges may pass along the pixel's borders. A triangle without area covers nothing.
pub fn covers_whole(triangle: Triangle, pixel: [i64; 2]) -> bool {
    winding(triangle) != Winding::Degenerate && square(pixel).iter().all(|&corner| contains(triangle, corner))
}

/// Whether a point lies in the triangle or on its edges.
pub fn contains([a, b, c]: Triangle, p: Point) -> bool {
    let sides = [edge(a, b, p), edge(b, c, p), edge(c, a, p)];
    sides.iter().all(|&side| side >= 0) || sides.iter().all(|&side| side <= 0)
}

/// The corners of a pixel, the smallest coordinates first and the largest third.
fn square([i, j]: [i64; 2]) -> [Point; 4] {
    [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|corner| corner.map(|v| v * SUBPIXELS))
}

fn sides(corners: &[Point]) -> impl Iterator<Item = [Point; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
}

/// Whether two segments cross: each one's ends lie on both sides of the other's line. Where one merely touches the other, a corner lies in the other shape.
fn meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    edge(a, b, c).signum() * edge(a, b, d).signum() < 0 && edge(c, d, a).signum() * edge(c, d, b).signum() < 0
}
