//! Are barycentric coordinates, depth and varyings within their bounds of the exact ones?
//!
//! With u = 2^-24, the most that rounding to f32 can be off by, relatively, and terms in u^2 left out:
//!
//! - *Barycentric coordinates.* An edge function is exact and rounded once (1 u); 1 / w is rounded (1 u), and so is the product with it
//!   (1 u). Inside the triangle all three are of one sign, so that their sum is off by 3 u and two additions, 5 u in all;
//!   the quotient by 3 + 5 + 1 = 9 u, which is at most 9 units in the last place: [`BARYCENTRIC_ULPS`].
//! - *Varyings.* f = (f0 + b1 d1) + b2 d2 with d = f_i - f0, so |d| <= 2 M where M is the largest |f_i|. Here b is off by 10 u (a
//!   reciprocal and a product instead of a quotient), d by 1 u, their product by 12 u: b1 d1 + b2 d2 is off by at most
//!   12 u (b1 + b2) 2 M <= 24 u M. Each of the two sums lies within M (a little more) and adds 1 u M: 26 u M: [`VARYING_ROUNDINGS`].
//! - *Depth.* z = (z0 + fx dz_dx) + fy dz_dy is a plane over the picture, and a sliver's slopes are as steep as it is thin. With
//!   (a, b) the two sides from the first vertex and A = 2 area: dz_dx = (dz1 b.y - dz2 a.y) / A and dz_dy = (dz2 a.x - dz1 b.x) / A. A difference of
//!   depths, a product, the difference of two, 1 / A of a rounded A, the product with it and the one with fx: at most 7 u of
//!   S = |fx| (|dz1 b.y| + |dz2 a.y|) / |A| + |fy| (|dz2 a.x| + |dz1 b.x|) / |A|, and two sums, each at most 1 u (|z0| + S): 9 u (|z0| + S):
//!   [`DEPTH_ROUNDINGS`]. For triangles of ordinary shape S is about 1 or 2. Clamping to 0 to 1 brings it only nearer.
//!
//! All this is for triangles that need no clipping. A clipped one's barycentric coordinates come from f64 throughout: see [`clipped`].

use crate::coverage::certain;
use crate::drawing::vertices;
use crate::{Drawing, Tally};
use pineda_oracle::cases::{Case, Space};
use pineda_oracle::{
    Rational, Triangle, barycentrics, clip_space_barycentrics, error, error_in_ulps, interpolate, perspective, snap,
};

/// The most that a barycentric coordinate may be off by, in units in the last place.
pub const BARYCENTRIC_ULPS: f64 = 9.001;
/// The most that a varying may be off by, in 2^-24 of the largest value at the three vertices.
pub const VARYING_ROUNDINGS: f64 = 26.001;
/// The most that a depth may be off by, in 2^-24 of |z0| + S as defined above.
pub const DEPTH_ROUNDINGS: f64 = 9.001;

/// 2^-24.
const U: f64 = 1.0 / 16_777_216.0;

/// Pixels of a case that are looked at.
const SAMPLES: usize = 6;

/// Checks some of the pixels that a drawing shows something at.
pub(crate) fn judge(case: &Case, drawing: &Drawing, tally: &mut Tally) -> Result<(), String> {
    let vertices = vertices(case);
    let shown: Vec<usize> = (0..drawing.depth.len()).filter(|&at| drawing.triangle_ids[at] != pineda::NO_ID).collect();
    let step = shown.len().div_ceil(SAMPLES).max(1);
    // Another start in each case.
    for &at in shown.iter().skip(case.seed as usize / 7 % step).step_by(step) {
        let pixel = [at as i64 % i64::from(case.width), at as i64 / i64::from(case.width)];
        let corners = case.triangles[drawing.triangle_ids[at] as usize].map(|k| vertices[k as usize]);
        let positions = corners.map(|corner| corner.position);
        let sample = Sample { pixel, weights: drawing.barycentrics[at], depth: drawing.depth[at] };
        let snapped = match case.space {
            Space::Raster => Some(positions.map(|[x, y, ..]| [x, y].map(|x| snap(x.into()).unwrap_or_default()))),
            Space::Clip => certain(case, positions),
        };
        let say = |problem: String| format!("pixel {pixel:?}: {problem}");
        let Some(snapped) = snapped else {
            // Where a corner's snapping is uncertain, nothing is known of a triangle that is not clipped.
            if positions.iter().all(|&position| is_on_raster(position, case)) {
                continue;
            }
            if let Some(exact) = clip_space_barycentrics(positions, case.width, case.height, pixel) {
                clipped(&sample, positions, &exact, case, tally).map_err(say)?;
            }
            continue;
        };
        let Some(linear) = barycentrics(snapped, pixel) else { return Err(say("a triangle without area".into())) };
        let Some(smooth) = perspective(&linear, positions.map(|[.., w]| w)) else { continue };
        tally.numbers += 1;
        for (found, exact) in sample.weights.iter().zip(&smooth) {
            let ulps = error_in_ulps(*found, exact);
            tally.worst_barycentric = tally.worst_barycentric.max(ulps);
            if ulps > BARYCENTRIC_ULPS {
                return Err(say(format!("barycentric coordinate {found:?} is {ulps} ulps off")));
            }
        }
        let color = drawing.color[at];
        for (channel, found) in color.into_iter().enumerate() {
            let (values, weights) = match channel {
                0 | 1 => (corners.map(|corner| corner.smooth[channel]), &smooth),
                _ => (corners.map(|corner| corner.linear[channel - 2]), &linear),
            };
            let largest = values.iter().fold(0.0, |largest: f32, v| largest.max(v.abs()));
            let Some(exact) = interpolate(weights, values) else { continue };
            let roundings = error(found, &exact) / (U * f64::from(largest));
            tally.worst_varying = tally.worst_varying.max(roundings);
            if roundings > VARYING_ROUNDINGS {
                return Err(say(format!("varying {channel} is {found:?}, {roundings} roundings off")));
            }
        }
        let depths = positions.map(|[_, _, z, w]| if case.space == Space::Clip { z / w } else { z });
        depth(&sample, snapped, depths, &linear, tally).map_err(say)?;
    }
    Ok(())
}

/// A pixel, and what the drawing has there.
struct Sample {
    pixel: [i64; 2],
    weights: [f32; 3],
    depth: f32,
}

fn depth(sample: &Sample, t: Triangle, z: [f32; 3], linear: &[Rational; 3], tally: &mut Tally) -> Result<(), String> {
    let Some(exact) = interpolate(linear, z) else { return Ok(()) };
    let exact = exact.clamp(Rational::ZERO, Rational::ONE);
    // The anchor is the vertex that comes first by (y, x).
    let mut order = [0, 1, 2];
    order.sort_by_key(|&k| [t[k][1], t[k][0]]);
    let [p, a, b] = order.map(|k| t[k].map(|x| x as f64));
    let [z0, z1, z2] = order.map(|k| f64::from(z[k]));
    let ([ax, ay], [bx, by]) = ([a[0] - p[0], a[1] - p[1]], [b[0] - p[0], b[1] - p[1]]);
    let [fx, fy] = [0, 1].map(|axis| (sample.pixel[axis] as f64 * 256.0 + 128.0 - p[axis]).abs());
    let (dz1, dz2, area) = ((z1 - z0).abs(), (z2 - z0).abs(), (ax * by - bx * ay).abs());
    let spread = fx * (dz1 * by.abs() + dz2 * ay.abs()) / area + fy * (dz2 * ax.abs() + dz1 * bx.abs()) / area;
    let wrong = error(sample.depth, &exact);
    let roundings = if wrong == 0.0 { 0.0 } else { wrong / (U * (z0.abs() + spread)) };
    tally.worst_depth = tally.worst_depth.max(roundings);
    if roundings > DEPTH_ROUNDINGS {
        return Err(format!("depth {:?} is {wrong} off, {roundings} roundings", sample.depth));
    }
    Ok(())
}

/// Whether a vertex surely needs no clipping.
fn is_on_raster([x, y, z, w]: [f32; 4], case: &Case) -> bool {
    let pixels = |v: f32, size: u32| (f64::from(v) / f64::from(w) * 0.5 + 0.5).abs() * f64::from(size);
    let is_in_band = pixels(x, case.width) < 32_767.0 && pixels(y, case.height) < 32_767.0;
    w > 0.0 && (0.0..=w).contains(&z) && is_in_band
}

/// A clipped triangle: its homogeneous edge functions e_i = (a_i x + b_i y) + c_i are sums of products of sums in f64, so that with e = 2^-53
/// each is off by less than 16 e of the largest that its terms can become; rounding the three to f32, their sum and the
/// quotient add 4 u. Where rounding leaves little of the sum (seen from nearly edge-on), little is promised.
fn clipped(
    sample: &Sample,
    positions: [[f32; 4]; 3],
    exact: &[Rational; 3],
    case: &Case,
    tally: &mut Tally,
) -> Result<(), String> {
    let p = positions.map(|[x, y, _, w]| {
        let [x, y, w] = [x, y, w].map(f64::from);
        let half = [f64::from(case.width), f64::from(case.height)].map(|size| size * 128.0);
        // The largest that x and y in subpixels are made of: their terms do not cancel here.
        (
            [x * half[0] + w * half[0], w * half[1] - y * half[1], w],
            [x.abs() + w.abs(), y.abs() + w.abs()].map(|v| v * half[0].max(half[1])),
        )
    });
    let [px, py] = sample.pixel.map(|i| i as f64 * 256.0 + 128.0);
    let (mut sum, mut scale) = (0.0, 0.0f64);
    for k in 0..3 {
        let (([ax, ay, aw], [ax_size, ay_size]), ([bx, by, bw], [bx_size, by_size])) = (p[(k + 1) % 3], p[(k + 2) % 3]);
        sum += (ay * bw - by * aw) * px + (bx * aw - ax * bw) * py + (ax * by - bx * ay);
        let (x, y) = (ay_size * bw.abs() + by_size * aw.abs(), bx_size * aw.abs() + ax_size * bw.abs());
        scale += x * px + y * py + ax_size * by_size + bx_size * ay_size;
    }
    let loss = 32.0 * f64::EPSILON * scale / sum.abs();
    if !loss.is_finite() || loss > 1e-3 {
        return Ok(());
    }
    tally.clipped_numbers += 1;
    for (found, exact) in sample.weights.iter().zip(exact) {
        let (wrong, size) = (error(*found, exact), exact.to_f64().value().abs());
        // Near an edge a pixel can lie outside of the exact triangle by half a subpixel: weights of both signs.
        let allowed = (loss + 8.0 * U) * (1.0 + size) * 2.0;
        if wrong > allowed {
            return Err(format!("clipped barycentric coordinate {found:?} is {wrong} off; {allowed} is allowed"));
        }
    }
    Ok(())
}
