//! The pixels of a line one pixel wide: the diamond exit rule, in integers.
//!
//! Around each pixel's centre f lies the open diamond R_f = { p : |p.x - f.x| + |p.y - f.y| < 1/2 }. A line from a to b covers the pixels whose R_f it
//! touches, but for one that b lies in (Vulkan 1.4, "Bresenham Line Segment Rasterization"; OpenGL 4.6, 14.5.1). Both ends count as if they lay at
//! -(e, e^2) from where they are, for an e that is smaller than anything else: which is also what the [top-left rule](super::top_left) says.
//!
//! Of a line that goes further along u than along v:
//!
//! - *In a column (of u) whose centre it passes, it touches one diamond: the one around the centre that is nearest to where it passes.* Let it pass a
//!   centre at the distance h along v. At s further on, the diamond's measure is |s| + |h + m s|, and as |m| <= 1 that is never below |h|. So it touches the
//!   diamond if |h| < 1/2; and |h| = 1/2 does not happen, because of e.
//! - *Before its start and after its end*, the same measure grows with the distance from the column's centre. So where it starts beyond the centre,
//!   it touches a diamond if it starts in one; where it ends before the centre, likewise, but then b lies in it.
//!
//! So its pixels are one in each column from the first whose centre it passes to the last; and the column of a, if a lies in a diamond beyond its
//! centre; less the column of b, if b does.
//!
//! | value | range | proof |
//! | --- | --- | --- |
//! | ends | +-2^23 | the guard band |
//! | extents | +-2^24 | |
//! | where it passes a centre, times the extent | 2^23 2^24 + 2^24 2^24 < 2^49 | |

use super::reach::PixelRect;
use crate::geometry::raster_space::{GUARD_BAND, HALF_PIXEL, SUBPIXEL_BITS, SUBPIXELS};

/// Calls `cover` with the column and row of each pixel in `rect` that the line from a to b, in subpixels, covers.
pub(crate) fn diamond_exit(a: [i32; 2], b: [i32; 2], rect: &PixelRect, mut cover: impl FnMut(i32, i32)) {
    debug_assert!([a, b].as_flattened().iter().all(|v| v.abs() <= GUARD_BAND));
    let extent = [b[0] - a[0], b[1] - a[1]];
    let is_x_major = extent[0].abs() >= extent[1].abs();
    let (u, v) = if is_x_major { (0, 1) } else { (1, 0) };
    if extent[u] == 0 {
        return;
    }
    let is_forward = extent[u] > 0;
    let (low, high) = if is_forward { (a, b) } else { (b, a) };
    let (du, dv) = (i64::from(high[u] - low[u]), i64::from(high[v] - low[v]));

    // In the row (of v) above where the line passes the border between two exactly: e moves it up, or, if it is the less, along its slope.
    let is_above = if is_x_major { dv <= 0 } else { true };
    let passes = |i: i32| {
        let center = i64::from(i) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL);
        i64::from(low[v]) * du + dv * (center - i64::from(low[u])) - i64::from(is_above)
    };
    let row = du * i64::from(SUBPIXELS);
    let is_in_diamond = |p: [i32; 2], i: i32| {
        let j = passes(i).div_euclid(row) as i32;
        let (du, dv) = (p[u] - (i * SUBPIXELS + HALF_PIXEL), p[v] - (j * SUBPIXELS + HALF_PIXEL));
        // On its border, e moves in what lies to the right.
        let is_right = if is_x_major { du > 0 } else { dv > 0 };
        let distance = du.abs() + dv.abs();
        distance < HALF_PIXEL || (distance == HALF_PIXEL && is_right)
    };

    // A point at a centre counts as before it.
    let first_after = |p: [i32; 2]| (p[u] - HALF_PIXEL + SUBPIXELS - 1) >> SUBPIXEL_BITS;
    let (mut first, mut end) = (first_after(low), first_after(high));
    if is_forward {
        first -= i32::from(is_in_diamond(a, first - 1));
        end -= i32::from(is_in_diamond(b, end - 1));
    } else {
        end += i32::from(is_in_diamond(a, end));
        first += i32::from(is_in_diamond(b, first));
    }

    let ([u0, u1], [v0, v1]) =
        if is_x_major { ([rect.x0, rect.x1], [rect.y0, rect.y1]) } else { ([rect.y0, rect.y1], [rect.x0, rect.x1]) };
    (first, end) = (first.max(u0), end.min(u1));
    let (mut j, mut rest) = (passes(first).div_euclid(row), passes(first).rem_euclid(row));
    let slope = dv * i64::from(SUBPIXELS);
    let (step, step_rest) = (slope.div_euclid(row), slope.rem_euclid(row));
    for i in first..end {
        if i64::from(v0) <= j && j < i64::from(v1) {
            let j = j as i32;
            if is_x_major { cover(i, j) } else { cover(j, i) }
        }
        // All integers: nothing is lost on the way.
        (j, rest) = (j + step, rest + step_rest);
        if rest >= row {
            (j, rest) = (j + 1, rest - row);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pineda_oracle::cases::Random;
    use pineda_oracle::{line_covers, picture};

    const RECT: PixelRect = PixelRect { x0: 0, y0: 0, x1: 23, y1: 17 };

    fn check(a: [i32; 2], b: [i32; 2]) {
        let mut hits = vec![0; 23 * 17];
        diamond_exit(a, b, &RECT, |i, j| hits[(j * 23 + i) as usize] += 1);
        let line = [a, b].map(|p| p.map(i64::from));
        let expected: Vec<bool> =
            (0..17).flat_map(|j| (0..23).map(move |i| [i, j])).map(|pixel| line_covers(line, pixel)).collect();
        let found: Vec<bool> = hits.iter().map(|&hits| hits > 0).collect();
        assert!(found == expected, "{a:?} to {b:?}:\n{}instead of\n{}", picture(&found, 23), picture(&expected, 23));
        assert!(hits.iter().all(|&hits| hits < 2), "{a:?} to {b:?} covers a pixel twice");
    }

    #[test]
    fn every_pixel_is_the_oracles() {
        let mut random = Random::new(0x11e5);
        for case in 0..4_000 {
            let mut coordinate = |kind: i64, size: i64| {
                let v = match kind {
                    // Centres, corners of diamonds, borders; anything; subpixels around them; far beyond; on the guard band's border.
                    0 => 128 * random.between(-6, 2 * size + 6),
                    1 => random.between(-400, 256 * size + 400),
                    2 => 64 * random.between(-4, 4 * size) + random.between(-1, 1),
                    3 => random.between(-1 << 23, 1 << 23),
                    _ => random.pick(&[-1, 1]) << 23,
                };
                v as i32
            };
            let kinds = [[0, 0], [1, 1], [2, 2], [0, 1], [3, 3], [0, 3], [4, 4], [0, 4], [2, 3]][case % 9];
            let a = [coordinate(kinds[0], 23), coordinate(kinds[0], 17)];
            let mut b = [coordinate(kinds[1], 23), coordinate(kinds[1], 17)];
            match case / 9 % 8 {
                0 => b = a,
                1 => b[0] = a[0],
                2 => b[1] = a[1],
                // 45 degrees, where that stays inside.
                3 => b[1] = (a[1] + b[0] - a[0]).clamp(-GUARD_BAND, GUARD_BAND),
                4 => b[1] = (a[1] - b[0] + a[0]).clamp(-GUARD_BAND, GUARD_BAND),
                // Short ones, within a diamond or two.
                5 => {
                    b = [a[0] + (b[0] & 255) - 128, a[1] + (b[1] & 255) - 128]
                        .map(|v| v.clamp(-GUARD_BAND, GUARD_BAND));
                }
                _ => {}
            }
            check(a, b);
            check(b, a);
        }
    }

    #[test]
    fn every_short_line_on_a_grid_of_an_eighth_of_a_pixel() {
        for start in 0..64 {
            let a = [1024 + 32 * (start % 8), 1024 + 32 * (start / 8)];
            for end in 0..17 * 17 {
                check(a, [a[0] + 32 * (end % 17 - 8), a[1] + 32 * (end / 17 - 8)]);
            }
        }
    }
}
