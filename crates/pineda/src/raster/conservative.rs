//! Conservative setup: triangles that cover what they touch, or only what they cover whole, from snapped vertices to records in bins.
//!
//! One triangle after the other, for nothing here is worth sixteen lanes. What is decided of a triangle (culling, canonical order, depth's plane) is decided
//! as in [`setup`](super::setup), so that a pixel that is covered either way gets the same bits. [Which pixels](super::rows) are covered is told to
//! [`Strips`], eight rows at a time.
//!
//! A clipped triangle is a polygon, in triangles that share edges. They cover as one: what two of them touch is covered once, and what lies across the edge between two
//! may be covered whole. Depth is the largest one's plane, on the others' pixels, too: a plane each would be steep nonsense where a part is thin.

use super::bins::Share;
use super::corners::Corners;
use super::depth_bias::Bias;
use super::record::{DepthPlane, LargeTriangle, MID_EXTENT};
use super::rows::{Point, Region};
use super::setup::{SetupState, clipped};
use super::strips::{AnchoredPlane, ROWS, Strips};
use super::triangle_id::{CLIPPED_CLOCKWISE, CLIPPED_COUNTER_CLOCKWISE, ORDERS, TriangleId};
use crate::geometry::clip::area_x2;
use crate::geometry::raster_space::{SUBPIXEL_BITS, SUBPIXELS, ScreenVertex};
use crate::pass::Conservative;

type Triangle = [ScreenVertex; 3];

/// Sets up triangles `range` of a run; `first_number` is the number of the run's triangle 0 in the batch.
pub(crate) fn set_up_conservative(
    conservative: Conservative,
    state: &SetupState<'_>,
    corners: &Corners<'_>,
    screen: &[ScreenVertex],
    range: std::ops::Range<usize>,
    first_number: usize,
    share: &mut Share,
) {
    share.statistics.triangles += range.len() as u64;
    let mut region = Region::default();
    for t in range {
        let places = corners.of(t);
        let triangle = places.map(|place| screen[place]);
        if triangle.iter().any(|v| v.is_off_raster()) {
            let Some((clipped, offset)) = clipped(state, places, screen, share) else { continue };
            let code = if clipped.is_clockwise { CLIPPED_CLOCKWISE } else { CLIPPED_COUNTER_CLOCKWISE };
            let id = TriangleId::first(first_number + t) | code;
            // The first of those with the largest area.
            let larger = |a: Triangle, b: &Triangle| if area_x2(*b).abs() > area_x2(a).abs() { *b } else { a };
            let largest = clipped.triangles().iter().fold(Triangle::default(), larger);
            let plane = plane(canonical(largest).1, state.bias.as_ref(), Some(offset));
            region.set(&clipped.triangles().iter().map(points).collect::<Vec<_>>(), conservative);
            cover(state, &region, id, plane, share);
            continue;
        }
        let area = area_x2(triangle);
        if area == 0 || if area > 0 { state.cull_clockwise } else { state.cull_counter_clockwise } {
            share.degenerate += u64::from(state.counts && area == 0);
            share.culled += u64::from(state.counts && area != 0);
            continue;
        }
        let (code, ordered) = canonical(triangle);
        region.set(&[points(&ordered)], conservative);
        let plane = plane(ordered, state.bias.as_ref(), None);
        cover(state, &region, TriangleId::first(first_number + t) | code, plane, share);
    }
}

/// Leaves records of what the region covers of the draw's rectangle.
fn cover(state: &SetupState<'_>, region: &Region, id: u32, plane: AnchoredPlane, share: &mut Share) {
    let rect = &state.rect;
    let ([low_x, low_y], [high_x, high_y]) = region.bounds();
    let [ax, ay] = plane.anchor;
    let reach = (ax - low_x).max(high_x - ax).max(ay - low_y).max(high_y - ay);
    // The rows whose closed squares reach it.
    let first = ((low_y + SUBPIXELS - 1) >> SUBPIXEL_BITS) - 1;
    let (first, end) = (first.max(rect.y0), ((high_y >> SUBPIXEL_BITS) + 1).min(rect.y1));
    if first >= end || rect.x0 >= rect.x1 {
        return;
    }
    let mut strips = Strips::new(share, state.grid, state.samples, id, plane, reach);
    let mut rows: [Vec<_>; ROWS as usize] = Default::default();
    for strip in first.div_euclid(ROWS)..=(end - 1).div_euclid(ROWS) {
        for (row, stretches) in (strip * ROWS..).zip(&mut rows) {
            if (first..end).contains(&row) {
                region.row(row, [rect.x0, rect.x1], stretches);
            } else {
                stretches.clear();
            }
        }
        strips.cover(strip, &rows);
    }
}

fn points(triangle: &Triangle) -> [Point; 3] {
    triangle.map(|v| [v.x(), v.y()])
}

/// The order code of a triangle with area, and its vertices in canonical order.
fn canonical(triangle: Triangle) -> (u32, Triangle) {
    let first = (0..3).min_by_key(|&k: &u32| (triangle[k as usize].y(), triangle[k as usize].x())).unwrap_or(0);
    let code = if area_x2(triangle) < 0 { first + 3 } else { first };
    (code, ORDERS[code as usize].map(|k| triangle[usize::from(k)]))
}

/// The plane of a triangle's depth, to the bit as setup has it; `offset_of_whole` is the offset if the triangle is a part of a clipped one.
fn plane(triangle: Triangle, bias: Option<&Bias>, offset_of_whole: Option<f32>) -> AnchoredPlane {
    let anchor = [triangle[0].x(), triangle[0].y()];
    let side = |k: usize| [triangle[k].x() - anchor[0], triangle[k].y() - anchor[1]];
    let ([ax, ay], [bx, by]) = (side(1), side(2));
    let z = triangle.map(ScreenVertex::z);
    let extent = |a: i32, b: i32| a.max(b).max(0) - a.min(b).min(0);
    if extent(ax, bx) > MID_EXTENT || extent(ay, by) > MID_EXTENT {
        let [a, b, c] = triangle.map(|v| [v.x() as u32, v.y() as u32]);
        let [za, zb, zc] = z.map(f32::to_bits);
        let words = [0, 0, 0, za, 0, 0, a[0], a[1], b[0], b[1], c[0], c[1], 0, zb, zc, 0];
        let record = LargeTriangle(words).with_precise_plane();
        let record = bias.map_or(record, |bias| record.with_bias(bias, offset_of_whole));
        return AnchoredPlane { anchor, depth: DepthPlane::unpack(&record.0) };
    }
    let scale = SUBPIXELS as f32 / area_x2(triangle) as f32;
    let (dz1, dz2) = (z[1] - z[0], z[2] - z[0]);
    let dz_dx = (dz1 * by as f32 - dz2 * ay as f32) * scale;
    let dz_dy = (dz2 * ax as f32 - dz1 * bx as f32) * scale;
    let offset = bias.map(|bias| offset_of_whole.unwrap_or_else(|| bias.offset(&z, dz_dx, dz_dy)));
    let z0 = offset.map_or(z[0], |offset| z[0] + offset);
    AnchoredPlane { anchor, depth: DepthPlane { z0, dz_dx, dz_dy } }
}
