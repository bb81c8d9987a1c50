//! Clipping of the few triangles that cross the near plane, the far plane, the guard band or a plane of the shader's own.
//!
//! Sutherland and Hodgman's algorithm (1974) in homogeneous coordinates and f64. Two triangles that share an edge must clip it
//! to bit-identical points, or a crack opens: a cut is always computed from the edge's inside end to its outside end, and planes
//! come in one fixed order, so that a cut depends on nothing but the edge. Only coverage and depth use the clipped polygon; what a
//! fragment interpolates comes from the whole triangle (see [`crate::shading::weights`]), so that no attribute is ever cut.

use super::project::{Homogeneous, Projection, outcode};
use super::raster_space::{GUARD_BAND, ScreenVertex};
use crate::pass::draw_call::DrawCall;
use crate::shading::MAX_CLIP_DISTANCES;

/// A triangle gains at most one vertex a plane.
const MAX_VERTICES: usize = 3 + 6 + MAX_CLIP_DISTANCES;
/// The triangles that become of one are set up together.
const _: () = assert!(MAX_VERTICES - 2 <= 16);

/// A triangle as its vertex stage gives it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ClipTriangle {
    pub(crate) positions: [[f32; 4]; 3],
    pub(crate) distances: [[f32; MAX_CLIP_DISTANCES]; 3],
}

/// A clipped triangle, as triangles of one winding.
#[derive(Debug)]
pub(crate) struct Clipped {
    triangles: [[ScreenVertex; 3]; MAX_VERTICES - 2],
    count: usize,
    /// The sign of the snapped polygon's area, for the vertices in the order in which they were given: true where it is positive,
    /// that is, clockwise on the picture.
    pub(crate) is_clockwise: bool,
}

impl Clipped {
    pub(crate) fn triangles(&self) -> &[[ScreenVertex; 3]] {
        &self.triangles[..self.count]
    }
}

impl ClipTriangle {
    /// Of the vertices with these numbers.
    pub(crate) fn of(call: &dyn DrawCall, vertices: [usize; 3]) -> Self {
        Self {
            positions: vertices.map(|vertex| call.position(vertex)),
            distances: vertices.map(|vertex| call.clip_distances(vertex)),
        }
    }
}

/// The planes that vertices can lie outside of, in the order in which they cut.
pub(super) fn planes() -> impl Iterator<Item = u32> {
    let of_view = [outcode::NEAR, outcode::FAR, outcode::LEFT, outcode::RIGHT, outcode::TOP, outcode::BOTTOM];
    of_view.into_iter().chain((0..MAX_CLIP_DISTANCES).map(|k| outcode::FIRST_OWN << k))
}

/// A corner of the polygon: where it is, and its place on the raster if it is one of the triangle's own that is on it.
#[derive(Clone, Copy)]
struct Corner {
    at: Homogeneous,
    /// From the shader's own planes.
    distances: [f64; MAX_CLIP_DISTANCES],
    on_raster: Option<ScreenVertex>,
}

/// Clips a triangle with finite positions and distances; `None` if nothing of it is left.
pub(crate) fn clip(projection: &Projection, triangle: &ClipTriangle, screen: [ScreenVertex; 3]) -> Option<Clipped> {
    let ClipTriangle { positions, distances } = *triangle;
    // Seen edge-on it covers nothing. Its plane goes through the eye, and so may the edges of what clipping leaves of it: points that
    // rounding alone would give a place.
    if projection.is_edge_on(positions) {
        return None;
    }
    let corner = |k: usize| Corner {
        at: projection.homogeneous(positions[k]),
        distances: distances[k].map(f64::from),
        on_raster: Some(screen[k]).filter(|v| !v.is_off_raster()),
    };
    let mut corners = [corner(0), corner(1), corner(2)];
    let swapped = sort(&mut corners, |corner| corner.at);
    let outside = screen[0].outcode() | screen[1].outcode() | screen[2].outcode();

    let mut polygon = [corners[0]; MAX_VERTICES];
    polygon[..3].copy_from_slice(&corners);
    let mut count = 3;
    for plane in planes() {
        if outside & plane != 0 {
            (polygon, count) = cut(&polygon[..count], plane);
        }
    }

    let mut points = [ScreenVertex::default(); MAX_VERTICES];
    for (point, corner) in points.iter_mut().zip(&polygon[..count]) {
        *point = corner.on_raster.map_or_else(|| to_raster(projection, corner.at), Some)?;
    }
    fan(&points[..count]).map(|mut clipped| {
        clipped.is_clockwise ^= swapped;
        clipped
    })
}

/// A clipped triangle's positions in the order that clipping takes them in, and which of the given ones each of them is.
pub(crate) fn canonical_positions(projection: &Projection, positions: [[f32; 4]; 3]) -> ([Homogeneous; 3], [usize; 3]) {
    let keyed = |k: usize| (projection.homogeneous(positions[k]), k);
    let mut keyed = [keyed(0), keyed(1), keyed(2)];
    sort(&mut keyed, |(at, _)| *at);
    let [(a, i), (b, j), (c, k)] = keyed;
    ([a, b, c], [i, j, k])
}

/// Brings the corners into an order that does not depend on the one they were given in. True if that was an odd permutation.
fn sort<T>(corners: &mut [T; 3], at: impl Fn(&T) -> Homogeneous) -> bool {
    // Adding 0 makes -0 and 0 the same.
    let key = |corner: &T| {
        let Homogeneous { x, y, z, w } = at(corner);
        [x + 0.0, y + 0.0, w + 0.0, z + 0.0]
    };
    let mut swapped = false;
    for (a, b) in [(0, 1), (1, 2), (0, 1)] {
        if key(&corners[b]) < key(&corners[a]) {
            corners.swap(a, b);
            swapped = !swapped;
        }
    }
    swapped
}

/// How far a point lies inside a plane; negative outside. Linear, so that it can be interpolated.
pub(super) fn distance(plane: u32, p: &Homogeneous, distances: &[f64; MAX_CLIP_DISTANCES], guard_band: i32) -> f64 {
    let band = f64::from(guard_band) * p.w;
    match plane {
        outcode::NEAR => p.z,
        outcode::FAR => p.w - p.z,
        outcode::LEFT => band + p.x,
        outcode::RIGHT => band - p.x,
        outcode::TOP => band + p.y,
        outcode::BOTTOM => band - p.y,
        own => distances[(own / outcode::FIRST_OWN).trailing_zeros() as usize % MAX_CLIP_DISTANCES],
    }
}

/// Cuts off what lies outside a plane.
fn cut(polygon: &[Corner], plane: u32) -> ([Corner; MAX_VERTICES], usize) {
    let Some(&first) = polygon.first() else { return ([ORIGIN; MAX_VERTICES], 0) };
    let mut out = [first; MAX_VERTICES];
    let mut count = 0;
    let mut push = |corner| {
        // A convex polygon gains one vertex a plane; rounding cannot make it gain more than the array holds, for each
        // vertex that is kept is kept once and cuts come in pairs around what is left out.
        if count < MAX_VERTICES {
            out[count] = corner;
            count += 1;
        }
    };
    for (k, a) in polygon.iter().enumerate() {
        let b = &polygon[(k + 1) % polygon.len()];
        let distance = |corner: &Corner| distance(plane, &corner.at, &corner.distances, GUARD_BAND);
        let (da, db) = (distance(a), distance(b));
        if da >= 0.0 {
            push(*a);
        }
        if (da >= 0.0) != (db >= 0.0) {
            let (inside, outside, di, d_o) = if da >= 0.0 { (a, b, da, db) } else { (b, a, db, da) };
            push(between(inside, outside, di, d_o));
        }
    }
    (out, count)
}

const ORIGIN: Corner = Corner {
    at: Homogeneous { x: 0.0, y: 0.0, z: 0.0, w: 0.0 },
    distances: [0.0; MAX_CLIP_DISTANCES],
    on_raster: None,
};

/// The point of an edge on a plane, from the distances of its ends: a sum of both with positive weights, each of which is as precise
/// as the distances are, however near the point is to either end.
fn between(inside: &Corner, outside: &Corner, di: f64, d_o: f64) -> Corner {
    let (wi, wo) = (-d_o / (di - d_o), di / (di - d_o));
    let mix = |a: f64, b: f64| a * wi + b * wo;
    let (a, b) = (&inside.at, &outside.at);
    Corner {
        at: Homogeneous { x: mix(a.x, b.x), y: mix(a.y, b.y), z: mix(a.z, b.z), w: mix(a.w, b.w) },
        distances: std::array::from_fn(|k| mix(inside.distances[k], outside.distances[k])),
        on_raster: None,
    }
}

/// The raster point of a position within all planes; `None` where w is 0, which is at best a degenerate polygon's corner.
pub(super) fn to_raster(projection: &Projection, at: Homogeneous) -> Option<ScreenVertex> {
    // A cut can land a rounding error outside of its plane.
    let band = f64::from(GUARD_BAND);
    let snap = |v: f64| (v / at.w).round_ties_even().clamp(-band, band) as i32;
    let z = projection.bounded_depth((at.z / at.w) as f32);
    (at.w > 0.0).then(|| ScreenVertex::new(snap(at.x), snap(at.y), projection.depth(z), (1.0 / at.w) as f32))
}

/// Cuts a polygon into triangles that all wind the same way.
///
/// Snapping can leave a vertex of the convex polygon reflex by less than a subpixel. A fan from most of the vertices would then have a
/// triangle that winds the wrong way and covers what lies outside; a fan from the reflex vertex has none.
fn fan(points: &[ScreenVertex]) -> Option<Clipped> {
    let count = points.len();
    let area = |a: usize, b: usize, c: usize| area_x2([points[a % count], points[b % count], points[c % count]]);
    let total: i64 = (1..count.saturating_sub(1)).map(|k| area(0, k, k + 1)).sum();
    if total == 0 {
        return None;
    }
    let winds_right =
        |apex: usize| (1..count - 1).all(|k| area(apex, apex + k, apex + k + 1).signum() != -total.signum());
    let apex = (0..count).find(|&apex| winds_right(apex)).unwrap_or(0);
    let mut clipped =
        Clipped { triangles: [[ScreenVertex::default(); 3]; MAX_VERTICES - 2], count: 0, is_clockwise: total > 0 };
    for k in 1..count - 1 {
        let corners = [apex, apex + k, apex + k + 1];
        if area(corners[0], corners[1], corners[2]).signum() == total.signum() {
            clipped.triangles[clipped.count] = corners.map(|c| points[c % count]);
            clipped.count += 1;
        }
    }
    Some(clipped)
}

/// Twice the signed area of a triangle on the raster, in subpixels squared: positive where it winds clockwise on the picture (y is down).
pub(crate) fn area_x2(v: [ScreenVertex; 3]) -> i64 {
    let side = |k: usize| (i64::from(v[k].x()) - i64::from(v[0].x()), i64::from(v[k].y()) - i64::from(v[0].y()));
    let ((ax, ay), (bx, by)) = (side(1), side(2));
    ax * by - bx * ay
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pass::{Space, Viewport};

    fn screen(projection: &Projection, positions: [[f32; 4]; 3]) -> [ScreenVertex; 3] {
        let mut padded = [positions[0]; 16];
        padded[..3].copy_from_slice(&positions);
        let mut out = [ScreenVertex::default(); 16];
        projection.project(fearless_simd::Level::fallback(), &padded, &mut out);
        [out[0], out[1], out[2]]
    }

    fn triangle(positions: [[f32; 4]; 3]) -> ClipTriangle {
        ClipTriangle { positions, distances: [[0.0; MAX_CLIP_DISTANCES]; 3] }
    }

    #[test]
    fn every_order_of_the_vertices_clips_to_the_same_triangles() {
        let projection = Projection::new(Space::Clip, &Viewport::whole(64, 48));
        let p = [[0.5, -0.25, 0.5, 1.0], [-3.0, 0.5, -2.0, -1.5], [0.25, 2.0, 3.0, 2.5]];
        let reference = clip(&projection, &triangle(p), screen(&projection, p)).expect("it crosses the picture");
        assert!(reference.triangles().len() > 1, "both the near and the far plane cut it");
        for (order, is_odd) in [([1, 2, 0], false), ([2, 0, 1], false), ([0, 2, 1], true), ([2, 1, 0], true)] {
            let q = order.map(|k| p[k]);
            let clipped = clip(&projection, &triangle(q), screen(&projection, q)).expect("the same triangle");
            assert_eq!(clipped.triangles(), reference.triangles());
            assert_eq!(clipped.is_clockwise, reference.is_clockwise ^ is_odd);
        }
    }

    #[test]
    fn a_triangle_wholly_behind_the_eye_leaves_nothing() {
        let projection = Projection::new(Space::Clip, &Viewport::whole(64, 48));
        let p = [[0.0, 0.0, -1.0, -1.0], [1.0, 0.0, -1.0, -2.0], [0.0, 1.0, -2.0, -1.0]];
        assert!(clip(&projection, &triangle(p), screen(&projection, p)).is_none());
    }
}
