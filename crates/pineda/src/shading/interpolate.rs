//! Interpolation: sixteen fragments of a block, of one triangle or of several, get their varyings.
//!
//! A packet is never split by triangle: that would run the fragment stage several times for a handful of pixels each. Its weights and
//! its vertices' varyings are put together first, in one of four ways, and from there on the way no longer matters:
//!
//! - a *few* triangles, one to eight: their edge functions and varyings are made ready once while a tile shows them, and the lanes pick theirs;
//! - one *large* triangle, whose edge functions may not fit 32 bits: many packets in a row, as a rule, which have a lot in common (see [`single`](super::single));
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
use super::packet::{BATCH, PacketBatch, VaryingLayout};
use super::run::RunView;
use super::single::Single;
use crate::raster::triangle_id::TriangleId;
use crate::wide::Simd;

/// What interpolation keeps from batch to batch.
#[derive(Debug)]
pub(crate) struct Interpolator {
    cache: TriangleCache,
    single: Single,
    distinct: [Distinct; BATCH],
}

impl Interpolator {
    pub(crate) fn new() -> Self {
        Self { cache: TriangleCache::new(), single: Single::NONE, distinct: [Distinct::NONE; BATCH] }
    }

    /// Other triangles come.
    pub(crate) fn forget(&mut self) {
        self.cache.forget();
        self.single.forget();
    }

    /// From here on, triangles are of a run with such varyings.
    #[inline(always)]
    pub(crate) fn start(&mut self, run: &RunView<'_>, layout: &VaryingLayout) {
        self.cache.start(run, layout);
    }

    /// Empties the batch for packets of one triangle only, which is not clipped.
    #[inline(always)]
    pub(crate) fn start_batch_of(
        &mut self,
        run: &RunView<'_>,
        layout: &VaryingLayout,
        batch: &mut PacketBatch,
        id: TriangleId,
    ) {
        self.single.prepare(run, layout, id);
        self.single.start(layout, run.front_is_clockwise, batch);
    }

    /// Interpolates the varyings of a batch that was started for one triangle.
    #[inline(always)]
    pub(crate) fn interpolate_one<S: Simd>(&mut self, s: S, layout: &VaryingLayout, batch: &mut PacketBatch) {
        self.single.interpolate_all(s, layout, batch);
    }

    /// Interpolates all varyings of a batch's packets into their rows. With `SINGLE`, each packet is known to show one triangle.
    #[inline(always)]
    pub(crate) fn interpolate<S: Simd, const SINGLE: bool>(
        &mut self,
        s: S,
        run: &RunView<'_>,
        position: &dyn Fn(usize) -> [f32; 4],
        layout: &VaryingLayout,
        batch: &mut PacketBatch,
    ) {
        // Step by step for the whole batch, and way by way: so that few branches are guessed wrong.
        let mut k = 0;
        while k < batch.len() {
            let (distinct, fragments) = (&mut self.distinct[k & (BATCH - 1)], batch.fragments(k));
            if SINGLE {
                distinct.set_single(layout, &fragments);
            } else {
                distinct.set(s, layout, &fragments);
            }
            if !S::HAS_SHORTCUTS {
                distinct.way = distinct.way.general();
            }
            k += 1;
        }
        let mut k = 0;
        while k < batch.len() {
            self.distinct[k & (BATCH - 1)].prepare(run, &mut self.cache);
            k += 1;
        }
        let mut ways = Ways::NONE;
        let mut k = 0;
        while k < batch.len() {
            let distinct = &mut self.distinct[k & (BATCH - 1)];
            let mut way = distinct.way_with(&self.cache);
            if way == Way::Large && batch.is_moved(k) {
                // What is kept of the last triangle is of pixels' centres.
                (way, distinct.lanes) = (Way::ByLane, [distinct.ids[0]; 16]);
            }
            ways.add(way, k);
            k += 1;
        }
        if layout.derivatives {
            self.with_derivatives(s, run, layout, batch, &ways);
        } else {
            self.by_ways::<S, false>(s, run, layout, batch, &ways);
        }
        if !ways.of(Way::InFull).is_empty() {
            in_full(s, run, position, layout, batch, &self.distinct, ways.of(Way::InFull));
        }
    }

    /// Packets whose varyings are all interpolated with perspective; with derivatives if `FULL`.
    #[inline(always)]
    fn by_ways<S: Simd, const FULL: bool>(
        &mut self,
        s: S,
        run: &RunView<'_>,
        layout: &VaryingLayout,
        batch: &mut PacketBatch,
        ways: &Ways,
    ) {
        let Self { cache, single, distinct } = self;
        if S::HAS_SHORTCUTS {
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
        }
        let mut large = ways.of(Way::Large);
        while !large.is_empty() {
            let id = distinct[large[0] as usize & (BATCH - 1)].ids[0];
            let mut count = 1;
            while count < large.len() && distinct[large[count] as usize & (BATCH - 1)].ids[0] == id {
                count += 1;
            }
            single.prepare(run, layout, TriangleId(id));
            single.interpolate_listed::<S, FULL>(s, layout, batch, &large[..count]);
            large = &large[count..];
        }
        by_lane::<S, FULL>(s, run, layout, batch, distinct, ways.of(Way::ByLane));
    }

    /// The same, as a function of its own: the plain one is left as small as it is.
    #[inline(never)]
    fn with_derivatives<S: Simd>(
        &mut self,
        s: S,
        run: &RunView<'_>,
        layout: &VaryingLayout,
        batch: &mut PacketBatch,
        ways: &Ways,
    ) {
        s.apart(
            #[inline(always)]
            || self.by_ways::<S, true>(s, run, layout, batch, ways),
        );
    }
}
