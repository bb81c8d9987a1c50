//! Smooth lines: how much of each pixel a line's rectangle covers.
//!
//! Which pixels it touches at all is decided in integers: two convex shapes are apart if a line along an edge of one of them parts them. How much of such a
//! pixel it covers is the area of the pixel's square, cut by the rectangle's four edges (Sutherland and Hodgman 1974), in f64: from exact corners, within
//! some units in the last place of the exact area; and then rounded to f32.

use super::reach::PixelRect;
use crate::geometry::raster_space::{SUBPIXEL_BITS, SUBPIXELS};

/// The corners of a rectangle, clockwise on the picture, in subpixels.
pub(crate) type Rectangle = [[i32; 2]; 4];

/// log2 of the side of a square of pixels that is looked at as a whole.
const GROUP_BITS: u32 = 3;

/// Calls `cover` with the column and row of each pixel in `rect` that the rectangle covers a part of, 8 x 8 pixels after 8 x 8 pixels.
pub(crate) fn touched(corners: &Rectangle, rect: &PixelRect, mut cover: impl FnMut(i32, i32)) {
    let [low, high] = [i32::min, i32::max]
        .map(|pick| [0, 1].map(|axis| corners.iter().map(|p| p[axis]).fold(corners[0][axis], pick)));
    // The first pixel that it reaches into, and the one after the last.
    let [x0, y0] = low.map(|v| v >> SUBPIXEL_BITS);
    let [x1, y1] = high.map(|v| (v + SUBPIXELS - 1) >> SUBPIXEL_BITS);
    let (x0, y0, x1, y1) = (x0.max(rect.x0), y0.max(rect.y0), x1.min(rect.x1), y1.min(rect.y1));
    if x0 >= x1 || y0 >= y1 {
        return;
    }
    let side = 1 << GROUP_BITS;
    for row in y0 >> GROUP_BITS..=(y1 - 1) >> GROUP_BITS {
        let (first_row, end_row) = (y0.max(row * side), y1.min((row + 1) * side));
        let (left, right) = across(corners, first_row * SUBPIXELS, end_row * SUBPIXELS);
        let (left, right) = ((left >> SUBPIXEL_BITS).max(x0), ((right >> SUBPIXEL_BITS) + 1).min(x1));
        let mut column = left >> GROUP_BITS;
        while column * side < right {
            for y in first_row..end_row {
                for x in left.max(column * side)..right.min((column + 1) * side) {
                    if touches(corners, x, y) {
                        cover(x, y);
                    }
                }
            }
            column += 1;
        }
    }
}

/// Bounds of where the rectangle reaches, left and right, between two heights; a little too wide, never too narrow.
fn across(corners: &Rectangle, top: i32, bottom: i32) -> (i32, i32) {
    let (mut left, mut right) = (i32::MAX, i32::MIN);
    for k in 0..4 {
        let (p, q) = (corners[k], corners[(k + 1) % 4]);
        let (upper, lower) = if p[1] <= q[1] { (p, q) } else { (q, p) };
        if lower[1] < top || upper[1] > bottom {
            continue;
        }
        for height in [upper[1].max(top), lower[1].min(bottom)] {
            let (dx, dy) = (f64::from(lower[0] - upper[0]), f64::from(lower[1] - upper[1]));
            let at = if dy == 0.0 { 0.0 } else { dx * f64::from(height - upper[1]) / dy };
            let x = upper[0] + at as i32;
            (left, right) = (left.min(x - 2), right.max(x + 2));
            if dy == 0.0 {
                (left, right) = (left.min(lower[0] - 2), right.max(lower[0] + 2));
            }
        }
    }
    (left, right)
}

/// Whether the rectangle covers a part of pixel (x, y), which it must reach in both directions.
fn touches(corners: &Rectangle, x: i32, y: i32) -> bool {
    (0..4).all(|k| {
        let (p, q) = (corners[k], corners[(k + 1) % 4]);
        let (dx, dy) = (i64::from(q[0] - p[0]), i64::from(q[1] - p[1]));
        // At the pixel's corner that is farthest inside: to the right of where the edge goes.
        let cx = i64::from(x + i32::from(dy < 0)) * i64::from(SUBPIXELS);
        let cy = i64::from(y + i32::from(dx > 0)) * i64::from(SUBPIXELS);
        dx * (cy - i64::from(p[1])) - dy * (cx - i64::from(p[0])) > 0
    })
}

/// The part of pixel (x, y) that the rectangle covers, 0 to 1.
pub(crate) fn covered_area(corners: &Rectangle, x: i32, y: i32) -> f32 {
    let (left, top) = (x * SUBPIXELS, y * SUBPIXELS);
    let side = f64::from(SUBPIXELS);
    let mut polygon = [[0.0f64; 2]; 8];
    polygon[..4].copy_from_slice(&[[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]);
    let mut count = 4;
    for k in 0..4 {
        let (p, q) = (corners[k], corners[(k + 1) % 4]);
        let (dx, dy) = (f64::from(q[0] - p[0]), f64::from(q[1] - p[1]));
        let (px, py) = (f64::from(p[0] - left), f64::from(p[1] - top));
        let inside = |at: [f64; 2]| dx * (at[1] - py) - dy * (at[0] - px);
        let (from, from_count) = (polygon, count);
        count = 0;
        for i in 0..from_count {
            let (a, b) = (from[i], from[(i + 1) % from_count]);
            let (da, db) = (inside(a), inside(b));
            if da >= 0.0 {
                polygon[count & 7] = a;
                count += 1;
            }
            if (da >= 0.0) != (db >= 0.0) {
                let t = da / (da - db);
                polygon[count & 7] = [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
                count += 1;
            }
        }
        // A convex polygon gains one corner an edge: 8 at the most.
        count = count.min(8);
    }
    let mut area_x2 = 0.0;
    for i in 1..count.max(1) - 1 + usize::from(count == 0) {
        let ([ax, ay], [bx, by], [cx, cy]) = (polygon[0], polygon[i], polygon[(i + 1) & 7]);
        area_x2 += (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    }
    let area = area_x2 * (0.5 / (side * side));
    (if area > 0.0 { area.min(1.0) } else { 0.0 }) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::stroke::{Stroke, corners_of_line};
    use pineda_oracle::cases::Random;
    use pineda_oracle::{Rational, covered_area as exact_area};

    const RECT: PixelRect = PixelRect { x0: 0, y0: 0, x1: 23, y1: 17 };

    #[test]
    fn areas_are_the_oracles() {
        let mut random = Random::new(0x500);
        let half_ulp = Rational::try_from(2f64.powi(-24)).expect("a finite number");
        for case in 0..200 {
            let far = if case % 5 == 0 { 1 << 20 } else { 4_000 };
            let mut end = || [random.between(-far, far + 4_000) as i32, random.between(-far, far + 2_000) as i32];
            let (a, mut b) = (end(), end());
            if case % 4 == 0 {
                b = [a[0] + 700, a[1]];
            }
            let width = random.between(256, 3_000) as f64;
            let corners = corners_of_line(&Stroke { ends: [a, b], ..Stroke::default() }, width);
            let mut hits = vec![0; 23 * 17];
            touched(&corners, &RECT, |x, y| hits[(y * 23 + x) as usize] += 1);
            let outline = corners.map(|p| p.map(i64::from));
            for (at, &hits) in hits.iter().enumerate() {
                let (x, y) = (at as i32 % 23, at as i32 / 23);
                let exact = exact_area(&outline, [x.into(), y.into()]);
                let expected = i32::from(exact > Rational::ZERO);
                assert_eq!(hits, expected, "pixel ({x}, {y}) of {a:?} to {b:?}, {width} wide");
                let found = Rational::try_from(covered_area(&corners, x, y)).expect("a finite number");
                let error = if found > exact { found - exact } else { exact - found };
                assert!(error <= half_ulp, "pixel ({x}, {y}) of {a:?} to {b:?}, {width} wide: off by {error}");
            }
        }
    }
}
