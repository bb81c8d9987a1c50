//! Interpolation: sixteen fragments of a block, of one triangle or of several, get their varyings.
//!
//! A packet is never split by triangle: that would run the fragment stage several times for a handful of pixels each. Its weights and
//! its vertices' varyings are put together first, in one of four ways, and from there on the way no longer matters:
//!
//! - a *few* triangles, one to eight: their edge functions and varyings are made ready once while a tile shows them, and the lanes pick theirs;
//! - one *large* triangle: what does not fit 32 bits is computed in f64;
//! - *many*: each lane loads its own vertices; rows of eight words are turned round by shuffles;
//! - *in full*: what is clipped, flat, or linear on the screen.
//!
//! Nothing here knows the shader's types: varyings are rows of numbers, so that this is compiled once for each SIMD level, and not again for
//! every shader.

use super::by_lane::by_lane;
use super::cached::TriangleCache;
use super::distinct::{Distinct, Way, Ways};
use super::few::few;
use super::in_full::in_full;
use super::large::{Last, large};
use super::packet::{BATCH, PacketBatch, VaryingLayout};
use super::run::RunView;
use crate::wide::Simd;

/// Interpolates all varyings of a batch's packets into their rows. With `SINGLE`, each packet is known to show one triangle.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
pub(crate) fn interpolate<S: Simd, const SINGLE: bool>(
    s: S,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    layout: &VaryingLayout,
    batch: &mut PacketBatch,
    distinct: &mut [Distinct; BATCH],
    last: &mut Last<S>,
    cache: &mut TriangleCache,
) {
    // Step by step for the whole batch, and way by way: so that few branches are guessed wrong.
    let mut k = 0;
    while k < batch.len() {
        let (distinct, fragments) = (&mut distinct[k & (BATCH - 1)], batch.packets()[k].fragments());
        if SINGLE {
            distinct.set_single(layout, &fragments);
        } else {
            distinct.set(s, layout, &fragments);
        }
        k += 1;
    }
    let mut k = 0;
    while k < batch.len() {
        distinct[k & (BATCH - 1)].prepare(run, cache);
        k += 1;
    }
    let mut ways = Ways::default();
    let mut k = 0;
    while k < batch.len() {
        let distinct = &mut distinct[k & (BATCH - 1)];
        let mut way = distinct.way_with(cache);
        if way == Way::Large && batch.is_moved(k) {
            // What is kept of the last triangle is of pixels' centres.
            (way, distinct.lanes) = (Way::ByLane, [distinct.ids[0]; 16]);
        }
        ways.add(way, k);
        k += 1;
    }
    if layout.derivatives {
        with_derivatives(s, run, layout, batch, distinct, &ways, last, cache);
    } else {
        by_ways::<S, false>(s, run, layout, batch, distinct, &ways, last, cache);
    }
    if !ways.of(Way::InFull).is_empty() {
        in_full(s, run, position, layout, batch, distinct, ways.of(Way::InFull));
    }
}

/// Packets whose varyings are all interpolated with perspective; with derivatives if `FULL`.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
fn by_ways<S: Simd, const FULL: bool>(
    s: S,
    run: &RunView<'_>,
    layout: &VaryingLayout,
    batch: &mut PacketBatch,
    distinct: &[Distinct; BATCH],
    ways: &Ways,
    last: &mut Last<S>,
    cache: &TriangleCache,
) {
    if !ways.of(Way::One).is_empty() {
        few::<S, 1, FULL>(s, layout, batch, distinct, ways.of(Way::One), cache);
    }
    if !ways.of(Way::Two).is_empty() {
        few::<S, 2, FULL>(s, layout, batch, distinct, ways.of(Way::Two), cache);
    }
    if !ways.of(Way::Four).is_empty() {
        few::<S, 4, FULL>(s, layout, batch, distinct, ways.of(Way::Four), cache);
    }
    if !ways.of(Way::Eight).is_empty() {
        few::<S, 8, FULL>(s, layout, batch, distinct, ways.of(Way::Eight), cache);
    }
    large::<S, FULL>(s, run, layout, batch, distinct, ways.of(Way::Large), last);
    by_lane::<S, FULL>(s, run, layout, batch, distinct, ways.of(Way::ByLane));
}

/// The same, as a function of its own: the plain one is left as small as it is.
#[inline(never)]
#[expect(clippy::too_many_arguments, reason = "as many as the plain one has")]
fn with_derivatives<S: Simd>(
    s: S,
    run: &RunView<'_>,
    layout: &VaryingLayout,
    batch: &mut PacketBatch,
    distinct: &[Distinct; BATCH],
    ways: &Ways,
    last: &mut Last<S>,
    cache: &TriangleCache,
) {
    s.vectorize(
        #[inline(always)]
        || by_ways::<S, true>(s, run, layout, batch, distinct, ways, last, cache),
    );
}
