//! How much each vertex counts at a sample.
//!
//! The barycentric coordinates of a point are the areas of the three triangles that it makes with the edges, and these areas are the edge
//! functions: lambda_0 = E_12(p) / area, and so on. Perspective-correct interpolation divides each by its vertex's w:
//!
//! ```text
//! f(p) = sum(E_i f_i / w_i) / sum(E_i / w_i)
//! ```
//!
//! The edge functions are computed exactly, in integers (or in f64, which holds them), and rounded to f32 once. So whichever way a packet
//! is filled, with one triangle or with sixteen, a sample gets the same weights.
//!
//! A clipped triangle has vertices that are not on the raster. Its weights come from the homogeneous edge functions of Olano and Greer
//! (1997), e_i(x, y) = (a_i x + b_i y + c_i), where (a_i, b_i, c_i) is the cross product of the other two vertices' (x, y, w): they are
//! E_i / w_i but for a common factor, and hold behind the eye, too.

use super::barycentric::Corner3;
use crate::geometry::clip::canonical_positions;
use crate::geometry::project::Homogeneous;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::raster::triangle_id::TriangleId;
use crate::shading::run::RunView;
use crate::tile::view::Positions;
use crate::wide::{Simd, f32x16, f64x8, i32x16, mask32x16};

/// Coordinates relative to a block's first sample up to which edge functions in the block fit i32: 2 (2^15)^2 = 2^31, less what the
/// block's 3 pixels add.
const NEAR: i32 = (1 << 15) - 4 * SUBPIXELS;

/// The weights of the three vertices, in canonical order, before they are divided by their sum. Where `FULL` is false, only the
/// perspective ones count; the rest is never computed.
#[derive(Clone, Copy)]
pub(crate) struct Weights<S: Simd> {
    /// With perspective.
    pub(crate) perspective: [f32x16<S>; 3],
    /// On the screen.
    pub(crate) linear: [f32x16<S>; 3],
    /// What the perspective ones gain a pixel right, and a pixel down.
    pub(crate) dx: [f32x16<S>; 3],
    pub(crate) dy: [f32x16<S>; 3],
    /// The same of the linear ones.
    pub(crate) linear_dx: [f32x16<S>; 3],
    pub(crate) linear_dy: [f32x16<S>; 3],
}

impl<S: Simd> Weights<S> {
    /// Those of a triangle on the raster, from its edge functions and their steps.
    #[inline(always)]
    pub(crate) fn from_edges<const FULL: bool>(
        edge: [f32x16<S>; 3],
        dx: [f32x16<S>; 3],
        dy: [f32x16<S>; 3],
        inv_w: [f32x16<S>; 3],
    ) -> Self {
        let mut this = Self { perspective: edge, linear: edge, dx, dy, linear_dx: dx, linear_dy: dy };
        let mut k = 0;
        while k < 3 {
            this.perspective[k] = edge[k] * inv_w[k];
            if FULL {
                this.dx[k] = dx[k] * inv_w[k];
                this.dy[k] = dy[k] * inv_w[k];
            }
            k += 1;
        }
        this
    }

    /// The depth, which is linear on the screen, of triangles on the raster.
    #[inline(always)]
    pub(crate) fn depth(&self, s: S, z: Corner3<S>) -> f32x16<S> {
        let [a, b, c] = self.linear;
        let scale = f32x16::splat(s, 1.0) / ((a + b) + c);
        (z.f0 + b * scale * z.d1) + c * scale * z.d2
    }

    /// Takes over another triangle's weights in the lanes of a mask.
    #[inline(always)]
    pub(crate) fn select(&mut self, mask: mask32x16<S>, other: &Self) {
        let mut k = 0;
        while k < 3 {
            self.perspective[k] = mask.select(other.perspective[k], self.perspective[k]);
            self.linear[k] = mask.select(other.linear[k], self.linear[k]);
            self.dx[k] = mask.select(other.dx[k], self.dx[k]);
            self.dy[k] = mask.select(other.dy[k], self.dy[k]);
            self.linear_dx[k] = mask.select(other.linear_dx[k], self.linear_dx[k]);
            self.linear_dy[k] = mask.select(other.linear_dy[k], self.linear_dy[k]);
            k += 1;
        }
    }
}

/// The same for all fragments of a block: one triangle, at the block whose first pixel is (x, y).
#[inline(always)]
pub(crate) fn of_triangle<S: Simd>(
    s: S,
    run: &RunView<'_>,
    rows: usize,
    places: [usize; 3],
    x: i32,
    y: i32,
    at: Positions<S>,
) -> Weights<S> {
    let (px, py) = (x * SUBPIXELS + HALF_PIXEL, y * SUBPIXELS + HALF_PIXEL);
    let mut vx = [0; 3];
    let mut vy = [0; 3];
    let mut inv_w = [0.0; 3];
    let mut k = 0;
    while k < 3 {
        let record = &run.records[places[k] * rows];
        vx[k] = record[0] as i32 - px;
        vy[k] = record[1] as i32 - py;
        inv_w[k] = f32::from_bits(record[2]);
        k += 1;
    }
    let mut edge = [f32x16::splat(s, 0.0); 3];
    let mut step_x = [0; 3];
    let mut step_y = [0; 3];
    let mut k = 0;
    while k < 3 {
        let (a, b) = ((k + 1) % 3, (k + 2) % 3);
        step_x[k] = vy[a] - vy[b];
        step_y[k] = vx[b] - vx[a];
        k += 1;
    }
    if reach(vx).max(reach(vy)) < NEAR {
        let mut k = 0;
        while k < 3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let first = vx[a] * vy[b] - vx[b] * vy[a];
            let exact = at.x * step_x[k] + at.y * step_y[k] + first;
            edge[k] = exact.to_float();
            k += 1;
        }
    } else {
        let (x_low, x_high) = at.x.to_float().widen();
        let (y_low, y_high) = at.y.to_float().widen();
        let mut k = 0;
        while k < 3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let first = (i64::from(vx[a]) * i64::from(vy[b]) - i64::from(vx[b]) * i64::from(vy[a])) as f64;
            let (right, down) = (f64::from(step_x[k]), f64::from(step_y[k]));
            let low = (x_low * right + y_low * down) + first;
            let high = (x_high * right + y_high * down) + first;
            edge[k] = low.narrow(high);
            k += 1;
        }
    }
    // Differences times 256: exact.
    let mut dx = edge;
    let mut dy = edge;
    let mut w = edge;
    let mut k = 0;
    while k < 3 {
        dx[k] = f32x16::splat(s, step_x[k] as f32 * SUBPIXELS as f32);
        dy[k] = f32x16::splat(s, step_y[k] as f32 * SUBPIXELS as f32);
        w[k] = f32x16::splat(s, inv_w[k]);
        k += 1;
    }
    Weights::from_edges::<true>(edge, dx, dy, w)
}

/// One clipped triangle, which of its vertices as submitted each weight is of, and its depths.
#[inline(never)]
pub(crate) fn of_clipped<S: Simd>(
    s: S,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    id: TriangleId,
    x: i32,
    y: i32,
    at: Positions<S>,
) -> (Weights<S>, [usize; 3], f32x16<S>) {
    let places = run.places(id);
    let positions = places.map(|place| position(run.source.vertex(place)));
    let (p, order) = canonical_positions(run.projection, positions);
    // The largest that a coefficient can contribute on a target, so that all weights are at most 1.
    let reach = f64::from(crate::MAX_SIZE) * f64::from(SUBPIXELS);
    let mut coefficients = [[0.0f64; 3]; 3];
    let mut largest = 0.0f64;
    for (k, row) in coefficients.iter_mut().enumerate() {
        let (a, b) = (&p[(k + 1) % 3], &p[(k + 2) % 3]);
        *row = [a.y * b.w - b.y * a.w, b.x * a.w - a.x * b.w, a.x * b.y - b.x * a.y];
        largest = largest.max(row[0].abs() * reach + row[1].abs() * reach + row[2].abs());
    }
    let scale = if largest > 0.0 && largest.is_finite() { 1.0 / largest } else { 0.0 };
    let (weights, depth) = s.apart(
        #[inline(always)]
        || evaluate_homogeneous(s, &coefficients, scale, &p, x, y, at),
    );
    let depth = depth * run.projection.depth_range() + run.projection.depth(0.0);
    (weights, order, depth)
}

#[inline(always)]
fn evaluate_homogeneous<S: Simd>(
    s: S,
    coefficients: &[[f64; 3]; 3],
    scale: f64,
    p: &[Homogeneous; 3],
    x: i32,
    y: i32,
    at: Positions<S>,
) -> (Weights<S>, f32x16<S>) {
    let center = |first: i32| f64::from(first * SUBPIXELS + HALF_PIXEL);
    let (x_low, x_high) = at.x.to_float().widen();
    let (y_low, y_high) = at.y.to_float().widen();
    let subpixels = f64::from(SUBPIXELS);
    let (x_low, x_high) = (x_low + center(x), x_high + center(x));
    let (y_low, y_high) = (y_low + center(y), y_high + center(y));
    let zero = [f32x16::splat(s, 0.0); 3];
    let mut weights = Weights { perspective: zero, linear: zero, dx: zero, dy: zero, linear_dx: zero, linear_dy: zero };
    let (mut z_low, mut z_high) = (f64x8::splat(s, 0.0), f64x8::splat(s, 0.0));
    let (mut w_low, mut w_high) = (z_low, z_high);
    let mut k = 0;
    while k < 3 {
        let [a, b, c] = [coefficients[k][0] * scale, coefficients[k][1] * scale, coefficients[k][2] * scale];
        let low: f64x8<S> = (x_low * a + y_low * b) + c;
        let high: f64x8<S> = (x_high * a + y_high * b) + c;
        weights.perspective[k] = low.narrow(high);
        weights.linear[k] = (low * p[k].w).narrow(high * p[k].w);
        weights.dx[k] = f32x16::splat(s, (a * subpixels) as f32);
        weights.dy[k] = f32x16::splat(s, (b * subpixels) as f32);
        weights.linear_dx[k] = f32x16::splat(s, (a * subpixels * p[k].w) as f32);
        weights.linear_dy[k] = f32x16::splat(s, (b * subpixels * p[k].w) as f32);
        (z_low, z_high) = (z_low + low * p[k].z, z_high + high * p[k].z);
        (w_low, w_high) = (w_low + low * p[k].w, w_high + high * p[k].w);
        k += 1;
    }
    (weights, (z_low / w_low).narrow(z_high / w_high))
}

/// Another triangle in each lane, none of them clipped: coordinates relative to each lane's own sample, and 1 / w.
#[inline(always)]
pub(crate) fn of_lanes<S: Simd, const FULL: bool>(
    vx: [i32x16<S>; 3],
    vy: [i32x16<S>; 3],
    inv_w: [f32x16<S>; 3],
) -> Weights<S> {
    let (mut edge, mut dx, mut dy) = (inv_w, inv_w, inv_w);
    let is_near = are_near(vx, vy);
    let mut k = 0;
    while k < 3 {
        let (a, b) = ((k + 1) % 3, (k + 2) % 3);
        if is_near {
            edge[k] = (vx[a] * vy[b] - vx[b] * vy[a]).to_float();
        } else {
            let (ax_low, ax_high) = double(vx[a]);
            let (bx_low, bx_high) = double(vx[b]);
            let (ay_low, ay_high) = double(vy[a]);
            let (by_low, by_high) = double(vy[b]);
            edge[k] = (ax_low * by_low - bx_low * ay_low).narrow(ax_high * by_high - bx_high * ay_high);
        }
        if FULL {
            dx[k] = (vy[a] - vy[b]).to_float() * SUBPIXELS as f32;
            dy[k] = (vx[b] - vx[a]).to_float() * SUBPIXELS as f32;
        }
        k += 1;
    }
    Weights::from_edges::<FULL>(edge, dx, dy, inv_w)
}

#[inline(always)]
fn reach(v: [i32; 3]) -> i32 {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

/// Whether all coordinates are from -2^15 up to 2^15, so that the difference of two products of them fits i32.
#[inline(always)]
fn are_near<S: Simd>(vx: [i32x16<S>; 3], vy: [i32x16<S>; 3]) -> bool {
    const HALF: i32 = 1 << 15;
    // Moved up by 2^15, what is in range has no bit from the sixteenth up.
    let x = (vx[0] + HALF) | (vx[1] + HALF) | (vx[2] + HALF);
    let y = (vy[0] + HALF) | (vy[1] + HALF) | (vy[2] + HALF);
    ((x | y) >> 16).simd_eq(0).to_bitmask() == 0xffff
}

/// As f64. Relative coordinates are below 2^24 + 2^22 in size, and f32 holds every integer up to 2^24; beyond, by halves.
#[inline(always)]
fn double<S: Simd>(v: i32x16<S>) -> (f64x8<S>, f64x8<S>) {
    let high: f32x16<S> = (v >> 12).to_float();
    let low: f32x16<S> = (v & 0xfff).to_float();
    let (high_a, high_b) = high.widen();
    let (low_a, low_b) = low.widen();
    (high_a * 4096.0 + low_a, high_b * 4096.0 + low_b)
}
