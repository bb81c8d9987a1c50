//! Interpolation: sixteen fragments of a block, of one triangle or of several, get their varyings.
//!
//! A packet is never split by triangle: that would run the fragment stage several times for a handful of pixels each. Its weights and
//! its vertices' varyings are put together first, in one of three ways, and from there on the way no longer matters:
//!
//! - *one* triangle: everything is the same in all lanes, and kept for the next packet;
//! - a *few*, up to eight: each triangle's vertices in turn, its lanes selected by mask;
//! - *many*: each lane loads its own vertices; rows of four words are turned round by shuffles.
//!
//! Packets with clipped triangles, and varyings that are flat, linear on the screen, or differentiated, take triangles in turn, in full.
//!
//! A varying is `(f0 + b1 (f1 - f0)) + b2 (f2 - f0)`, in canonical order of the vertices. What is the same at all three vertices stays
//! exactly that.
//!
//! Nothing here knows the shader's types: varyings are rows of numbers, so that this is compiled once for each SIMD level, and not again for
//! every shader.

use super::distinct::{Distinct, Fragments, Way};
use super::packet::{PacketRows, VaryingLayout};
use super::run::{RECORD_HEADER, RunView, record_rows};
use super::weights::{Prepared, Weights, of_clipped, of_lanes, of_triangle};
use super::{Interpolation, MAX_VARYINGS};
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::raster::triangle_id::{ORDER_BITS, TriangleId};
use crate::tile::view::BlockLanes;
use crate::transpose::columns4;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x4, u32x16};

/// How the three vertices' values of one varying enter: the first, and by how much the others exceed it.
#[derive(Clone, Copy)]
struct Corner3<S: Simd> {
    f0: f32x16<S>,
    d1: f32x16<S>,
    d2: f32x16<S>,
}

/// The triangle that the last packet showed alone, if it did: its neighbour often shows it, too.
pub(crate) struct Last<S: Simd> {
    id: TriangleId,
    prepared: Prepared<S>,
    /// Each varying at the first vertex, and by how much the others exceed it.
    corners: [[f32; 3]; MAX_VARYINGS],
}

impl<S: Simd> Last<S> {
    #[inline(always)]
    pub(crate) fn none(s: S) -> Self {
        Self { id: TriangleId(0), prepared: Prepared::none(s), corners: [[0.0; 3]; MAX_VARYINGS] }
    }
}

/// Interpolates all varyings of a packet into its rows.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
pub(crate) fn interpolate<S: Simd>(
    s: S,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    layout: &VaryingLayout,
    fragments: &Fragments<'_>,
    distinct: &Distinct,
    lanes: &BlockLanes<S>,
    last: &mut Last<S>,
    rows: &mut PacketRows<'_>,
) {
    let each = record_rows(layout.interpolation.len());
    match distinct.way {
        Way::One => one(s, run, layout, fragments, TriangleId(distinct.ids[0]), lanes, last, rows),
        Way::Two => apart(s, run, layout, fragments, &ByTriangle::<S, 2>::new(s, run, each, distinct), lanes, rows),
        Way::Four => apart(s, run, layout, fragments, &ByTriangle::<S, 4>::new(s, run, each, distinct), lanes, rows),
        Way::Eight => apart(s, run, layout, fragments, &ByTriangle::<S, 8>::new(s, run, each, distinct), lanes, rows),
        Way::ByLane => {
            apart(s, run, layout, fragments, &ByLane::new(s, run, each, distinct), lanes, rows);
        }
        Way::InFull => few_in_full(s, run, position, layout, fragments, distinct, rows),
    }
}

#[inline(never)]
fn few_in_full<S: Simd>(
    s: S,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    layout: &VaryingLayout,
    fragments: &Fragments<'_>,
    distinct: &Distinct,
    rows: &mut PacketRows<'_>,
) {
    s.vectorize(
        #[inline(always)]
        || {
            in_full(s, run, position, layout, fragments, distinct, &BlockLanes::new(s), rows);
        },
    );
}

#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
fn one<S: Simd>(
    s: S,
    run: &RunView<'_>,
    layout: &VaryingLayout,
    fragments: &Fragments<'_>,
    id: TriangleId,
    lanes: &BlockLanes<S>,
    last: &mut Last<S>,
    rows: &mut PacketRows<'_>,
) {
    let varyings = layout.interpolation.len().min(MAX_VARYINGS);
    if last.id != id {
        let each = record_rows(varyings);
        let [a, b, c] = run.canonical_places(id);
        let places = [a, b, c, run.places(id)[0]];
        last.id = id;
        last.prepared = Prepared::new(s, run, each, &places, lanes);
        let mut k = 0;
        while k < varyings {
            last.corners[k] = vertex_values(run, each, &places, k, false);
            k += 1;
        }
    }
    let both = Both::new::<false>(s, &last.prepared.weights(s, fragments.x, fragments.y), layout);
    let mut k = 0;
    while k < varyings {
        let [f0, d1, d2] = last.corners[k];
        let corner = Corner3 { f0: f32x16::splat(s, f0), d1: f32x16::splat(s, d1), d2: f32x16::splat(s, d2) };
        both.set::<false>(layout, rows, k, corner);
        k += 1;
    }
}

/// The weights of the second and third vertex, normalised, and their derivatives.
#[derive(Clone, Copy)]
struct Barycentric<S: Simd> {
    b1: f32x16<S>,
    b2: f32x16<S>,
    dx: [f32x16<S>; 2],
    dy: [f32x16<S>; 2],
}

impl<S: Simd> Barycentric<S> {
    #[inline(always)]
    fn new(s: S, weights: &[f32x16<S>; 3], dx: &[f32x16<S>; 3], dy: &[f32x16<S>; 3], derivatives: bool) -> Self {
        let sum = (weights[0] + weights[1]) + weights[2];
        let scale = f32x16::splat(s, 1.0) / sum;
        let (b1, b2) = (weights[1] * scale, weights[2] * scale);
        let mut this = Self { b1, b2, dx: [b1, b2], dy: [b1, b2] };
        if derivatives {
            // Of a quotient: (n / d)' = (n' - (n / d) d') / d.
            let (sum_dx, sum_dy) = ((dx[0] + dx[1]) + dx[2], (dy[0] + dy[1]) + dy[2]);
            this.dx = [(dx[1] - b1 * sum_dx) * scale, (dx[2] - b2 * sum_dx) * scale];
            this.dy = [(dy[1] - b1 * sum_dy) * scale, (dy[2] - b2 * sum_dy) * scale];
        }
        this
    }
}

/// Both kinds of barycentric coordinates.
struct Both<S: Simd> {
    perspective: Barycentric<S>,
    linear: Barycentric<S>,
}

impl<S: Simd> Both<S> {
    #[inline(always)]
    fn new<const FULL: bool>(s: S, weights: &Weights<S>, layout: &VaryingLayout) -> Self {
        let derivatives = FULL && layout.derivatives;
        let perspective = Barycentric::new(s, &weights.perspective, &weights.dx, &weights.dy, derivatives);
        let linear = if FULL {
            Barycentric::new(s, &weights.linear, &weights.linear_dx, &weights.linear_dy, derivatives)
        } else {
            perspective
        };
        Self { perspective, linear }
    }

    /// Varying `k` and its derivatives, from its values at the vertices.
    #[inline(always)]
    fn set<const FULL: bool>(&self, layout: &VaryingLayout, rows: &mut PacketRows<'_>, k: usize, f: Corner3<S>) {
        let interpolation = if FULL { layout.interpolation[k] } else { Interpolation::Perspective };
        let b = match interpolation {
            Interpolation::Flat => {
                rows.here[k] = f.f0.into();
                return;
            }
            Interpolation::Perspective => &self.perspective,
            Interpolation::NoPerspective => &self.linear,
        };
        rows.here[k] = ((f.f0 + b.b1 * f.d1) + b.b2 * f.d2).into();
        if FULL && layout.derivatives {
            rows.dx[k] = (b.dx[0] * f.d1 + b.dx[1] * f.d2).into();
            rows.dy[k] = (b.dy[0] * f.d1 + b.dy[1] * f.d2).into();
        }
    }
}

/// The weights of one triangle, the places of its vertices in their order, and the provoking vertex's.
#[inline(always)]
fn triangle<S: Simd>(
    s: S,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    fragments: &Fragments<'_>,
    id: TriangleId,
    each: usize,
    lanes: &BlockLanes<S>,
) -> (Weights<S>, [usize; 4]) {
    let (weights, places) = if id.is_clipped() {
        let (weights, order) = of_clipped(s, run, position, id, fragments.x, fragments.y);
        let submitted = run.places(id);
        (weights, [submitted[order[0]], submitted[order[1]], submitted[order[2]]])
    } else {
        let places = run.canonical_places(id);
        (of_triangle(s, run, each, places, fragments.x, fragments.y, lanes), places)
    };
    (weights, [places[0], places[1], places[2], run.places(id)[0]])
}

/// Varying `k` at the first vertex and by how much the others exceed it; of a flat one, at the provoking vertex.
#[inline(always)]
fn vertex_values(run: &RunView<'_>, each: usize, places: &[usize; 4], k: usize, is_flat: bool) -> [f32; 3] {
    if is_flat {
        return [word(run, each, places[3], k), 0.0, 0.0];
    }
    let f0 = word(run, each, places[0], k);
    [f0, word(run, each, places[1], k) - f0, word(run, each, places[2], k) - f0]
}

#[inline(always)]
fn word(run: &RunView<'_>, each: usize, place: usize, k: usize) -> f32 {
    let at = RECORD_HEADER + k;
    f32::from_bits(run.records[place * each + at / 4][at % 4])
}

#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
fn in_full<S: Simd>(
    s: S,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    layout: &VaryingLayout,
    fragments: &Fragments<'_>,
    distinct: &Distinct,
    lanes: &BlockLanes<S>,
    rows: &mut PacketRows<'_>,
) {
    let each = record_rows(layout.interpolation.len());
    let mut places = [[0; 4]; 16];
    let mut masks = [mask32x16::splat(s, true); 16];
    let count = distinct.count();
    let mut weights;
    (weights, places[0]) = triangle(s, run, position, fragments, TriangleId(distinct.ids[0]), each, lanes);
    let mut t = 1;
    while t < count {
        let id = TriangleId(distinct.ids[t & 15]);
        let (next, next_places) = triangle(s, run, position, fragments, id, each, lanes);
        places[t & 15] = next_places;
        masks[t & 15] = mask32x16::from_bitmask(s, u64::from(distinct.masks[t & 15]));
        weights.select(masks[t & 15], &next);
        t += 1;
    }
    let both = Both::new::<true>(s, &weights, layout);
    let mut k = 0;
    while k < layout.interpolation.len() {
        let is_flat = layout.interpolation[k] == Interpolation::Flat;
        let [f0, d1, d2] = vertex_values(run, each, &places[0], k, is_flat);
        let mut corner = Corner3 { f0: f32x16::splat(s, f0), d1: f32x16::splat(s, d1), d2: f32x16::splat(s, d2) };
        let mut t = 1;
        while t < count {
            let mask = masks[t & 15];
            let [f0, d1, d2] = vertex_values(run, each, &places[t & 15], k, is_flat);
            corner.f0 = mask.select(f32x16::splat(s, f0), corner.f0);
            corner.d1 = mask.select(f32x16::splat(s, d1), corner.d1);
            corner.d2 = mask.select(f32x16::splat(s, d2), corner.d2);
            t += 1;
        }
        both.set::<true>(layout, rows, k, corner);
        k += 1;
    }
}

/// Where the lanes' vertex records come from.
trait Vertices<S: Simd> {
    /// Row `r` of the records of each lane's vertex `corner`, in canonical order: four words, lane by lane.
    fn row(&self, s: S, run: &RunView<'_>, corner: usize, r: usize) -> [u32x16<S>; 4];
}

/// Up to `N` triangles, taken in turn.
struct ByTriangle<S: Simd, const N: usize> {
    /// The first rows of the three vertices' records.
    at: [[usize; 3]; N],
    /// The lanes of each; the first has those of none other.
    masks: [mask32x16<S>; N],
}

impl<S: Simd, const N: usize> ByTriangle<S, N> {
    #[inline(always)]
    fn new(s: S, run: &RunView<'_>, each: usize, distinct: &Distinct) -> Self {
        let mut this = Self { at: [[0; 3]; N], masks: [mask32x16::from_bitmask(s, 0); N] };
        let mut t = 0;
        while t < N {
            // Beyond the last any, for no lane: a branch would cost more.
            let [a, b, c] = run.canonical_places(TriangleId(distinct.ids[t & 15]));
            this.at[t] = [a * each, b * each, c * each];
            this.masks[t] = mask32x16::from_bitmask(s, u64::from(distinct.masks[t & 15]));
            t += 1;
        }
        this
    }
}

impl<S: Simd, const N: usize> Vertices<S> for ByTriangle<S, N> {
    #[inline(always)]
    fn row(&self, s: S, run: &RunView<'_>, corner: usize, r: usize) -> [u32x16<S>; 4] {
        let mut records = [&[0; 4]; N];
        let mut t = 0;
        while t < N {
            records[t] = &run.records[self.at[t][corner] + r];
            t += 1;
        }
        let mut row = [u32x16::splat(s, 0); 4];
        let mut i = 0;
        while i < 4 {
            row[i] = u32x16::splat(s, records[0][i]);
            let mut t = 1;
            while t < N {
                row[i] = self.masks[t].select(u32x16::splat(s, records[t][i]), row[i]);
                t += 1;
            }
            i += 1;
        }
        row
    }
}

/// A triangle for each lane: the first rows of its three vertices' records.
struct ByLane([[u32; 16]; 3]);

impl ByLane {
    #[inline(always)]
    fn new<S: Simd>(s: S, run: &RunView<'_>, each: usize, distinct: &Distinct) -> Self {
        let ids = u32x16::simd_from(s, distinct.lanes);
        let [a, b, c] = run.corners.of_each(s, (ids >> ORDER_BITS) - (run.first_number as u32 + 1));
        let each = each as u32;
        let [a, b, c] = [a * each, b * each, c * each];
        let code: i32x16<S> = (ids & ((1 << ORDER_BITS) - 1)).bitcast();
        let (first_is_1, first_is_2) = (code.simd_eq(1) | code.simd_eq(4), code.simd_eq(2) | code.simd_eq(5));
        let counter_clockwise = code.simd_ge(3);
        let second = first_is_1.select(c, first_is_2.select(a, b));
        let third = first_is_1.select(a, first_is_2.select(b, c));
        Self([
            first_is_1.select(b, first_is_2.select(c, a)).into(),
            counter_clockwise.select(third, second).into(),
            counter_clockwise.select(second, third).into(),
        ])
    }
}

impl<S: Simd> Vertices<S> for ByLane {
    #[inline(always)]
    fn row(&self, s: S, run: &RunView<'_>, corner: usize, r: usize) -> [u32x16<S>; 4] {
        let at = &self.0[corner];
        columns4(four(s, run, at, r, 0), four(s, run, at, r, 4), four(s, run, at, r, 8), four(s, run, at, r, 12))
    }
}

#[inline(always)]
fn four<S: Simd>(s: S, run: &RunView<'_>, at: &[u32; 16], r: usize, lane: usize) -> u32x16<S> {
    let a = load(s, run, at[lane] as usize + r);
    let b = load(s, run, at[lane + 1] as usize + r);
    let c = load(s, run, at[lane + 2] as usize + r);
    let d = load(s, run, at[lane + 3] as usize + r);
    a.combine(b).combine(c.combine(d))
}

#[inline(always)]
fn load<S: Simd>(s: S, run: &RunView<'_>, at: usize) -> u32x4<S> {
    u32x4::simd_from(s, run.records[at])
}

/// Lanes that each have vertices of their own.
#[inline(always)]
fn apart<S: Simd>(
    s: S,
    run: &RunView<'_>,
    layout: &VaryingLayout,
    fragments: &Fragments<'_>,
    vertices: &impl Vertices<S>,
    lanes: &BlockLanes<S>,
    rows: &mut PacketRows<'_>,
) {
    let varyings = layout.interpolation.len();
    // The first row of each record holds x, y, 1 / w and the first varying.
    let [mut a, mut b, mut c] = rows_of_three(s, run, vertices, 0);
    let x = (lanes.column << 8) + (fragments.x * SUBPIXELS + HALF_PIXEL);
    let y = (lanes.row << 8) + (fragments.y * SUBPIXELS + HALF_PIXEL);
    let vx = [a[0].bitcast::<i32x16<S>>() - x, b[0].bitcast::<i32x16<S>>() - x, c[0].bitcast::<i32x16<S>>() - x];
    let vy = [a[1].bitcast::<i32x16<S>>() - y, b[1].bitcast::<i32x16<S>>() - y, c[1].bitcast::<i32x16<S>>() - y];
    let weights = of_lanes(vx, vy, [a[2].bitcast(), b[2].bitcast(), c[2].bitcast()]);
    let both = Both::new::<false>(s, &weights, layout);
    let mut r = 0;
    while r < record_rows(varyings) {
        if r != 0 {
            [a, b, c] = rows_of_three(s, run, vertices, r);
        }
        let mut i = 0;
        while i < 4 {
            // Words before the varyings, or behind the last.
            let k = (4 * r + i).wrapping_sub(RECORD_HEADER);
            if k < varyings {
                let f0: f32x16<S> = a[i].bitcast();
                let corner = Corner3 { f0, d1: b[i].bitcast::<f32x16<S>>() - f0, d2: c[i].bitcast::<f32x16<S>>() - f0 };
                both.set::<false>(layout, rows, k, corner);
            }
            i += 1;
        }
        r += 1;
    }
}

/// Row `r` of the records of all three vertices.
#[inline(always)]
fn rows_of_three<S: Simd>(s: S, run: &RunView<'_>, vertices: &impl Vertices<S>, r: usize) -> [[u32x16<S>; 4]; 3] {
    [vertices.row(s, run, 0, r), vertices.row(s, run, 1, r), vertices.row(s, run, 2, r)]
}
