//! Packets with clipped triangles, varyings that are flat or linear on the screen, and barycentric coordinates: triangles in turn, in full.

use super::Interpolation;
use super::barycentric::{Both, Corner3};
use super::coordinates::coordinates;
use super::distinct::{Distinct, Fragments};
use super::packet::{BATCH, PacketBatch, PacketRows, VaryingLayout};
use super::run::{RunView, record_rows};
use super::weights::{Weights, of_clipped, of_triangle};
use crate::raster::triangle_id::{ORDERS, TriangleId};
use crate::tile::view::{BlockLanes, Positions};
use crate::wide::{Simd, f32x16, mask32x16};

/// Interpolates the packets that the list names.
#[inline(never)]
pub(crate) fn in_full<S: Simd>(
    s: S,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    layout: &VaryingLayout,
    batch: &mut PacketBatch,
    distinct: &[Distinct; BATCH],
    list: &[u8],
) {
    s.apart(
        #[inline(always)]
        || {
            let lanes = BlockLanes::new(s);
            let mut i = 0;
            while i < list.len() {
                let k = list[i] as usize;
                let (fragments, mut rows) = batch.packet(k);
                one_in_full(s, run, position, layout, &fragments, &distinct[k & (BATCH - 1)], &lanes, &mut rows);
                i += 1;
            }
        },
    );
}

#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
fn one_in_full<S: Simd>(
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
    let first = TriangleId(distinct.ids[0]);
    let Placed { mut weights, mut depth, order, places: first_places } =
        triangle(s, run, position, layout, fragments, first, each, lanes);
    places[0] = first_places;
    if layout.barycentrics {
        place(s, run, first, &weights, order, masks[0], rows);
    }
    let mut t = 1;
    while t < count {
        let id = TriangleId(distinct.ids[t & 15]);
        let next = triangle(s, run, position, layout, fragments, id, each, lanes);
        places[t & 15] = next.places;
        masks[t & 15] = mask32x16::from_bitmask(s, u64::from(distinct.masks[t & 15]));
        weights.select(masks[t & 15], &next.weights);
        depth = masks[t & 15].select(next.depth, depth);
        if layout.barycentrics {
            place(s, run, id, &next.weights, next.order, masks[t & 15], rows);
        }
        t += 1;
    }
    let both = Both::new::<true>(s, &weights, layout);
    let mut k = 0;
    while k < layout.interpolation.len() {
        let is_flat = layout.interpolation[k] == Interpolation::Flat;
        let mut corner = Corner3::splat(s, run.vertex_values(each, &places[0], k, is_flat));
        let mut t = 1;
        while t < count {
            let mask = masks[t & 15];
            let [f0, d1, d2] = run.vertex_values(each, &places[t & 15], k, is_flat);
            corner.f0 = mask.select(f32x16::splat(s, f0), corner.f0);
            corner.d1 = mask.select(f32x16::splat(s, d1), corner.d1);
            corner.d2 = mask.select(f32x16::splat(s, d2), corner.d2);
            t += 1;
        }
        both.set::<true>(layout, rows, k, corner);
        k += 1;
    }
    if layout.depth {
        *rows.z = depth.into();
    }
}

/// Writes the barycentric coordinates of a triangle to the lanes of a mask.
#[inline(never)]
fn place<S: Simd>(
    s: S,
    run: &RunView<'_>,
    id: TriangleId,
    weights: &Weights<S>,
    order: [usize; 3],
    mask: mask32x16<S>,
    rows: &mut PacketRows<'_>,
) {
    s.apart(
        #[inline(always)]
        || {
            let both =
                [coordinates(s, run, id, &weights.perspective, order), coordinates(s, run, id, &weights.linear, order)];
            let mut k = 0;
            while k < 2 {
                let mut vertex = 0;
                while vertex < 3 {
                    let there = f32x16::simd_from(s, rows.barycentrics[k][vertex]);
                    rows.barycentrics[k][vertex] = mask.select(f32x16::simd_from(s, both[k][vertex]), there).into();
                    vertex += 1;
                }
                k += 1;
            }
        },
    );
}

/// What a packet needs of a triangle that is not in the cache.
struct Placed<S: Simd> {
    weights: Weights<S>,
    /// Which corner each weight is of.
    order: [usize; 3],
    /// The places of the vertices in that order, and the provoking vertex's.
    places: [usize; 4],
    /// If it is asked for.
    depth: f32x16<S>,
}

#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
fn triangle<S: Simd>(
    s: S,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    layout: &VaryingLayout,
    fragments: &Fragments<'_>,
    id: TriangleId,
    each: usize,
    lanes: &BlockLanes<S>,
) -> Placed<S> {
    let at = Positions::new(s, lanes, fragments.moved);
    let submitted = run.places(id);
    let of =
        |order: [usize; 3]| [submitted[order[0] % 3], submitted[order[1] % 3], submitted[order[2] % 3], submitted[0]];
    if id.is_clipped() {
        let (weights, order, depth) = of_clipped(s, run, position, id, fragments.x, fragments.y, at);
        return Placed { weights, order, places: of(order), depth };
    }
    let [a, b, c] = ORDERS[id.order_code() as usize & 7];
    let order = [a as usize, b as usize, c as usize];
    let places @ [a, b, c, _] = of(order);
    let weights = of_triangle(s, run, each, [a, b, c], fragments.x, fragments.y, at);
    let mut depth = f32x16::splat(s, 0.0);
    if layout.depth {
        depth = weights.depth(s, Corner3::splat(s, run.vertex_depths([a, b, c])));
    }
    Placed { weights, order, places, depth }
}
