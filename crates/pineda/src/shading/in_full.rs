//! Packets with clipped triangles, and varyings that are flat or linear on the screen: triangles in turn, in full.

use super::Interpolation;
use super::barycentric::{Both, Corner3};
use super::distinct::{Distinct, Fragments};
use super::packet::{BATCH, PacketBatch, PacketRows, VaryingLayout};
use super::run::{RunView, record_rows};
use super::weights::{Weights, of_clipped, of_triangle};
use crate::raster::triangle_id::TriangleId;
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
    s.vectorize(
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
    let mut weights;
    let mut depth;
    (weights, places[0], depth) =
        triangle(s, run, position, layout, fragments, TriangleId(distinct.ids[0]), each, lanes);
    let mut t = 1;
    while t < count {
        let id = TriangleId(distinct.ids[t & 15]);
        let (next, next_places, next_depth) = triangle(s, run, position, layout, fragments, id, each, lanes);
        places[t & 15] = next_places;
        masks[t & 15] = mask32x16::from_bitmask(s, u64::from(distinct.masks[t & 15]));
        weights.select(masks[t & 15], &next);
        depth = masks[t & 15].select(next_depth, depth);
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

/// The weights of one triangle, the places of its vertices in their order and the provoking vertex's, and depths if they are asked for.
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
) -> (Weights<S>, [usize; 4], f32x16<S>) {
    let at = Positions::new(s, lanes, fragments.moved);
    let (weights, places, depth) = if id.is_clipped() {
        let (weights, order, depth) = of_clipped(s, run, position, id, fragments.x, fragments.y, at);
        let submitted = run.places(id);
        (weights, [submitted[order[0]], submitted[order[1]], submitted[order[2]]], depth)
    } else {
        let places = run.canonical_places(id);
        let weights = of_triangle(s, run, each, places, fragments.x, fragments.y, at);
        let mut depth = f32x16::splat(s, 0.0);
        if layout.depth {
            depth = weights.depth(s, Corner3::splat(s, run.vertex_depths(places)));
        }
        (weights, places, depth)
    };
    (weights, [places[0], places[1], places[2], run.places(id)[0]], depth)
}
