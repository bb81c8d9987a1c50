//! Coverage in homogeneous coordinates, without clipping and without projecting a single vertex (tutorial 3; Olano and
//! Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997).
//!
//! A pixel at (X, Y) in [-1, 1] x [-1, 1] shows the points (X w, Y w, w) of a ray from the eye, w > 0. The corners
//! V_i = (x, y, w) of a triangle span a cone from the eye. The ray is inside if it is a sum of corners with weights >= 0:
//!
//! ```text
//!   (X, Y, 1) = m0 V0 + m1 V1 + m2 V2     with     m0 = (V1 x V2) . (X, Y, 1) / det(V0, V1, V2)     and so on
//! ```
//!
//! so each edge is a half-plane of the picture whatever the signs of w. At this scale the point met has w = 1, in front of
//! the eye, and z = m0 z0 + m1 z1 + m2 z2: so 0 <= z <= w cuts off two more half-planes. The tutorial did this in f32,
//! where two triangles disagree about the edge that they share; in exact arithmetic nothing is lost.

use dashu_int::IBig;
use dashu_int::ops::Abs;

use crate::snap::Rational;

/// The visible part (w > 0, 0 <= z <= w) of a clip-space triangle in a picture: an intersection of half-planes.
///
/// Positions are exact here, neither projected nor snapped. A rasterizer that snaps agrees wherever
/// [`margin`](Self::margin) is well above half a subpixel; closer to an edge either answer can be right.
#[derive(Clone, Debug)]
pub struct Visible {
    half_planes: Vec<HalfPlane>,
    picture: Picture,
    has_area: bool,
}

impl Visible {
    /// The visible part of a flat convex polygon with corners (x, y, z, w), usually three, in a picture of `width` x
    /// `height` pixels. The first three corners must not be on one line. `None` if a coordinate is not finite.
    pub fn new(corners: &[[f32; 4]], width: u32, height: u32) -> Option<Self> {
        assert!(corners.len() >= 3, "a polygon has three corners or more, not {}", corners.len());
        let picture = Picture { width, height };
        let (rays, depths) = scaled_to_integers(corners)?;
        let determinant = dot(&cross(&rays[0], &rays[1]), &rays[2]);
        let front = determinant.signum(); // turns every half-plane inwards
        let has_area = !determinant.is_zero();

        let mut half_planes = Vec::new();
        for (a, b) in rays.iter().zip(rays.iter().cycle().skip(1)) {
            let plane = cross(a, b);
            if has_area {
                half_planes.push(HalfPlane::edge(plane.map(|n| n * &front), picture));
            } else if plane.iter().any(|n| !n.is_zero()) {
                half_planes.push(HalfPlane::edge(plane, picture)); // two corners seen at one place have no line
            }
        }
        if has_area {
            // |det| z = z0 |det| m0 + z1 |det| m1 + z2 |det| m2, a plane like those of the edges; and |det| w = |det|.
            let weights = [(1, 2), (2, 0), (0, 1)].map(|(a, b)| cross(&rays[a], &rays[b]));
            let z = [0, 1, 2].map(|n| {
                (&depths[0] * &weights[0][n] + &depths[1] * &weights[1][n] + &depths[2] * &weights[2][n]) * &front
            });
            let w_minus_z = [-&z[0], -&z[1], determinant.abs() - &z[2]];
            half_planes.extend([z, w_minus_z].map(|plane| HalfPlane::depth(plane, picture)));
        }
        Some(Self { half_planes, picture, has_area })
    }

    /// Whether the visible part owns pixel (i, j). The top-left rule decides on an edge; the near and the far plane belong
    /// to the visible part. Nothing is covered by a triangle seen edge-on.
    pub fn covers(&self, pixel: [i64; 2]) -> bool {
        let ray = self.picture.ray(pixel);
        self.has_area && self.half_planes.iter().all(|half_plane| half_plane.contains(&ray))
    }

    /// The coverage of the whole picture, row by row from the top.
    pub fn coverage(&self) -> Vec<bool> {
        self.picture.pixels().map(|pixel| self.covers(pixel)).collect()
    }

    /// How far in pixels the centre of pixel (i, j) is from the nearest edge of the visible part: positive inside, where
    /// it is that distance; negative outside, where the true distance is at least that. Good to twelve digits.
    pub fn margin(&self, pixel: [i64; 2]) -> f64 {
        let ray = self.picture.ray(pixel);
        let distances = self.half_planes.iter().map(|half_plane| half_plane.distance(&ray));
        // Seen edge-on there is no inside, but the lines still tell how far away the triangle is at least.
        if self.has_area {
            distances.fold(f64::INFINITY, f64::min)
        } else {
            -distances.map(f64::abs).fold(0.0, f64::max)
        }
    }

    /// How far in pixels each corner of a pixel lies inside of each edge, negative outside: for each edge the corners of the whole picture, row by row from the top, one more
    /// in a row than pixels. `None` if it is seen edge-on.
    pub fn corner_margins(&self) -> Option<Vec<Vec<f64>>> {
        let rays: Vec<Vector> = self.picture.corner_rays().collect();
        let of_edge = |half_plane: &HalfPlane| rays.iter().map(|ray| half_plane.distance(ray)).collect();
        self.has_area.then(|| self.half_planes.iter().map(of_edge).collect())
    }

    /// The pixels whose coverage somebody else sees differently, with their [`margin`](Self::margin): those well away from
    /// an edge are wrong, the others only worth counting.
    pub fn disagreements(&self, covered: &[bool]) -> Vec<([i64; 2], f64)> {
        let pixels = self.picture.pixels().zip(covered);
        pixels.filter(|&(pixel, &c)| self.covers(pixel) != c).map(|(pixel, _)| (pixel, self.margin(pixel))).collect()
    }
}

/// The perspective-correct weights of a clip-space triangle's corners at a pixel, which sum to one; whatever the signs of
/// w. `None` if a coordinate is not finite, if the triangle is seen edge-on or if the pixel is on its vanishing line.
pub fn clip_space_barycentrics(
    triangle: [[f32; 4]; 3],
    width: u32,
    height: u32,
    pixel: [i64; 2],
) -> Option<[Rational; 3]> {
    let (rays, _) = scaled_to_integers(&triangle)?;
    let ray = Picture { width, height }.ray(pixel);
    let weights = [(1, 2), (2, 0), (0, 1)].map(|(a, b)| dot(&cross(&rays[a], &rays[b]), &ray));
    let sum: IBig = weights.iter().sum();
    (!sum.is_zero() && !dot(&cross(&rays[0], &rays[1]), &rays[2]).is_zero())
        .then(|| weights.map(|weight| Rational::from(weight) / &sum))
}

/// A vector (x, y, w), or a plane through the eye given by its normal.
type Vector = [IBig; 3];

#[derive(Clone, Copy, Debug)]
struct Picture {
    width: u32,
    height: u32,
}

impl Picture {
    /// (X, Y, 1) of a pixel's centre times width * height, which makes integers of it: X = (2 i + 1) / width - 1 and
    /// Y = 1 - (2 j + 1) / height.
    fn ray(self, [i, j]: [i64; 2]) -> Vector {
        let [width, height] = [i64::from(self.width), i64::from(self.height)];
        [(2 * i + 1 - width) * height, (height - 2 * j - 1) * width, width * height].map(IBig::from)
    }

    /// The same of all corners of pixels, row by row.
    fn corner_rays(self) -> impl Iterator<Item = Vector> {
        let [width, height] = [i64::from(self.width), i64::from(self.height)];
        let ray =
            move |i: i64, j: i64| [(2 * i - width) * height, (height - 2 * j) * width, width * height].map(IBig::from);
        (0..=height).flat_map(move |j| (0..=width).map(move |i| ray(i, j)))
    }

    fn pixels(self) -> impl Iterator<Item = [i64; 2]> {
        (0..i64::from(self.height)).flat_map(move |j| (0..i64::from(self.width)).map(move |i| [i, j]))
    }
}

/// The pixels on one side of a line in the picture: normal . ray > 0, or >= 0 if the line itself belongs to it.
#[derive(Clone, Debug)]
struct HalfPlane {
    normal: Vector,
    owns_line: bool,
    /// What normal . ray changes by, one pixel away from the line.
    change_per_pixel: f64,
}

impl HalfPlane {
    /// The top-left rule: x grows to the right and y upwards, so that a normal (an inward direction) with x > 0 is that of
    /// a left edge, and one straight down that of a top edge.
    fn edge(normal: Vector, picture: Picture) -> Self {
        let (is_left, is_top) = (normal[0] > IBig::ZERO, normal[0].is_zero() && normal[1] < IBig::ZERO);
        Self { owns_line: is_left || is_top, ..Self::depth(normal, picture) }
    }

    fn depth(normal: Vector, picture: Picture) -> Self {
        // One pixel to the right changes the ray's x by 2 * height, one pixel down its y by -2 * width.
        let change_x = 2.0 * f64::from(picture.height) * normal[0].to_f64().value();
        let change_y = 2.0 * f64::from(picture.width) * normal[1].to_f64().value();
        Self { normal, owns_line: true, change_per_pixel: change_x.hypot(change_y) }
    }

    fn contains(&self, ray: &Vector) -> bool {
        let side = dot(&self.normal, ray);
        side > IBig::ZERO || (side.is_zero() && self.owns_line)
    }

    /// Distance from the line in pixels, positive inside. Infinite where there is no line (an edge that is nowhere seen, a
    /// depth that is the same everywhere), with the sign of the side that everything is on.
    fn distance(&self, ray: &Vector) -> f64 {
        let side = dot(&self.normal, ray);
        match self.change_per_pixel {
            0.0 if side.is_zero() => f64::INFINITY,
            change => side.to_f64().value() / change,
        }
    }
}

fn cross([ax, ay, aw]: &Vector, [bx, by, bw]: &Vector) -> Vector {
    [ay * bw - aw * by, aw * bx - ax * bw, ax * by - ay * bx]
}

fn dot([ax, ay, aw]: &Vector, [bx, by, bw]: &Vector) -> IBig {
    ax * bx + ay * by + aw * bw
}

/// The corners as (x, y, w) and z, all multiplied by one power of two that makes integers of them: it cancels out.
fn scaled_to_integers(corners: &[[f32; 4]]) -> Option<(Vec<Vector>, Vec<IBig>)> {
    if !corners.iter().flatten().all(|x| x.is_finite()) {
        return None;
    }
    // A float is a multiple of 2^-23 times the largest power of two below it, and of 2^-149.
    let exponent = |x: &f32| ((x.to_bits() >> 23 & 0xff) as i32).max(1) - 150;
    let lowest = corners.iter().flatten().filter(|&&x| x != 0.0).map(exponent).min().unwrap_or(0);
    let integer = |x: f32| {
        let fraction = x.to_bits() & 0x7f_ffff;
        let mantissa = if x.is_normal() { fraction | 0x80_0000 } else { fraction };
        let magnitude =
            if mantissa == 0 { IBig::ZERO } else { IBig::from(mantissa) << (exponent(&x) - lowest) as usize };
        if x < 0.0 { -magnitude } else { magnitude }
    };
    Some(corners.iter().map(|&[x, y, z, w]| ([x, y, w].map(integer), integer(z))).unzip())
}
