//! Packets of one triangle that is too large for the cache: kept while one packet after the other shows it.

use super::MAX_VARYINGS;
use super::barycentric::{Both, Corner3};
use super::distinct::{Distinct, Fragments};
use super::packet::{BATCH, PacketBatch, PacketRows, VaryingLayout};
use super::run::{RunView, record_rows};
use super::weights::Prepared;
use crate::raster::triangle_id::TriangleId;
use crate::tile::view::BlockLanes;
use crate::wide::Simd;

/// The triangle that the last packet showed alone, if it did: its neighbour often shows it, too.
pub(crate) struct Last<S: Simd> {
    id: TriangleId,
    prepared: Prepared<S>,
    /// Each varying at the first vertex, and by how much the others exceed it.
    corners: [[f32; 3]; MAX_VARYINGS],
    depths: [f32; 3],
}

impl<S: Simd> Last<S> {
    #[inline(always)]
    pub(crate) fn none(s: S) -> Self {
        Self { id: TriangleId(0), prepared: Prepared::none(s), corners: [[0.0; 3]; MAX_VARYINGS], depths: [0.0; 3] }
    }
}

/// Interpolates the packets that the list names; with derivatives if `FULL`.
#[inline(always)]
pub(crate) fn large<S: Simd, const FULL: bool>(
    s: S,
    run: &RunView<'_>,
    layout: &VaryingLayout,
    batch: &mut PacketBatch,
    distinct: &[Distinct; BATCH],
    list: &[u8],
    last: &mut Last<S>,
) {
    let lanes = BlockLanes::new(s);
    let mut i = 0;
    while i < list.len() {
        let k = list[i] as usize;
        let (fragments, mut rows) = batch.packet(k);
        let id = TriangleId(distinct[k & (BATCH - 1)].ids[0]);
        one::<S, FULL>(s, run, layout, &fragments, id, &lanes, last, &mut rows);
        i += 1;
    }
}

#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
fn one<S: Simd, const FULL: bool>(
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
            last.corners[k] = run.vertex_values(each, &places, k, false);
            k += 1;
        }
        if layout.depth {
            last.depths = run.vertex_depths([a, b, c]);
        }
    }
    let weights = last.prepared.weights::<FULL>(s, fragments.x, fragments.y);
    let both = Both::new::<FULL>(s, &weights, layout);
    let mut k = 0;
    while k < varyings {
        both.set::<FULL>(layout, rows, k, Corner3::splat(s, last.corners[k]));
        k += 1;
    }
    if layout.depth {
        *rows.z = weights.depth(s, Corner3::splat(s, last.depths)).into();
    }
}
