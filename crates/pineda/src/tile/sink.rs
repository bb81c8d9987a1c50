//! What becomes of covered samples: the coverage kernels hand them over a block at a time.

use super::view::TileView;
use super::{Bounds, Tile};
use crate::pass::Compare;
use crate::pass::plan::DepthRule;
use crate::raster::samples::MAX_SAMPLES;
use crate::target::depth::DepthFormat;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};

/// Takes the covered samples of blocks, triangle by triangle, in submission order.
pub(crate) trait Sink<S: Simd> {
    /// The samples of one block that a triangle covers, and the triangle's depth at all of the block's samples.
    fn samples(&mut self, s: S, block: usize, inside: mask32x16<S>, z: f32x16<S>, id: u32);

    /// Whether a triangle whose depths lie in this range can be left out of the whole tile, by what is known of it.
    #[inline(always)]
    fn hides_tile(&self, _: S, _sample: usize, _depths: DepthRange) -> bool {
        false
    }

    /// Whether it can be left out of a 16 x 16 window, by what is known of it.
    #[inline(always)]
    fn hides_window(&self, _window: Window, _depths: DepthRange) -> bool {
        false
    }

    /// Whether it can be left out of the window from `block` on, by what is there: takes longer than asking what is known.
    #[inline(always)]
    fn hides_blocks(&self, _: S, _block: usize, _stride: usize, _depths: DepthRange) -> bool {
        false
    }

    /// Whether all samples of the window from `block` on are sure to pass, by what is there.
    #[inline(always)]
    fn lets_all_pass(&self, _: S, _block: usize, _stride: usize, _depths: DepthRange) -> bool {
        false
    }

    /// All samples of a block, which are sure to pass.
    #[inline(always)]
    fn passing(&mut self, s: S, block: usize, z: f32x16<S>, id: u32) {
        self.samples(s, block, mask32x16::splat(s, true), z, id);
    }

    /// A triangle whose depths lie in this range was drawn to every sample of a window.
    #[inline(always)]
    fn covered_window(&mut self, _window: Window, _depths: DepthRange) {}
}

/// A window of 16 x 16 pixels, by its number in the tile, row by row; and one sample of each of its pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    pub(crate) sample: usize,
    pub(crate) number: usize,
}

/// Depths, before clamping.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DepthRange {
    pub(crate) nearest: f32,
    pub(crate) farthest: f32,
}

/// Clamps depths to a range, as bits: negative numbers and -0 are negative as integers, too.
#[inline(always)]
fn clamped<S: Simd>(z: f32x16<S>, low: i32, high: i32) -> i32x16<S> {
    z.bitcast::<i32x16<S>>().max(low).min(high)
}

const ONE: i32 = 1.0f32.to_bits() as i32;

/// The depth test of a draw.
pub(crate) trait DepthTest<S: Simd>: Copy {
    /// Whether it is used where passing samples are counted.
    const COUNTS: bool;
    /// The bits that are compared, and stored.
    fn depths(&self, s: S, z: f32x16<S>) -> i32x16<S>;
    /// Which of the samples pass.
    fn passes(&self, s: S, z: i32x16<S>, there: i32x16<S>) -> mask32x16<S>;
    /// The bounds of what is compared.
    fn range(&self, depths: DepthRange) -> DepthRange;
    /// Whether it passes for (less, equal, greater).
    fn outcomes(&self) -> [bool; 3];
}

/// [`Compare::Less`], or [`Compare::Greater`], of f32s over the whole range.
#[derive(Clone, Copy)]
pub(crate) struct Usual<const GREATER: bool>;

impl<S: Simd, const GREATER: bool> DepthTest<S> for Usual<GREATER> {
    const COUNTS: bool = false;

    #[inline(always)]
    fn depths(&self, _: S, z: f32x16<S>) -> i32x16<S> {
        clamped(z, 0, ONE)
    }

    #[inline(always)]
    fn passes(&self, _: S, z: i32x16<S>, there: i32x16<S>) -> mask32x16<S> {
        if GREATER { z.simd_gt(there) } else { z.simd_lt(there) }
    }

    #[inline(always)]
    fn range(&self, depths: DepthRange) -> DepthRange {
        // No bound that is compared with lies beyond 0 to 1.
        depths
    }

    #[inline(always)]
    fn outcomes(&self) -> [bool; 3] {
        [!GREATER, false, GREATER]
    }
}

/// Any comparison, range and format.
#[derive(Clone, Copy)]
pub(crate) struct AnyTest {
    pub(crate) rule: DepthRule,
    pub(crate) format: DepthFormat,
}

impl<S: Simd> DepthTest<S> for AnyTest {
    const COUNTS: bool = true;

    #[inline(always)]
    fn depths(&self, s: S, z: f32x16<S>) -> i32x16<S> {
        let z = clamped(z, self.rule.low, self.rule.high);
        if self.format.is_float() { z } else { self.format.rounded_lanes(s, z.bitcast()).bitcast() }
    }

    #[inline(always)]
    fn passes(&self, s: S, z: i32x16<S>, there: i32x16<S>) -> mask32x16<S> {
        self.rule.compare.passes(s, z, there)
    }

    #[inline(always)]
    fn range(&self, depths: DepthRange) -> DepthRange {
        // Clamping and rounding are monotone.
        let low = f32::from_bits(self.rule.low as u32);
        let high = f32::from_bits(self.rule.high as u32);
        let bounded = |z: f32| {
            self.format.rounded(if z < low {
                low
            } else if z > high {
                high
            } else {
                z
            })
        };
        DepthRange { nearest: bounded(depths.nearest), farthest: bounded(depths.farthest) }
    }

    #[inline(always)]
    fn outcomes(&self) -> [bool; 3] {
        self.rule.compare.outcomes()
    }
}

impl Compare {
    /// In which lanes `new` passes against `there`: `new` less, equal or greater.
    #[inline(always)]
    pub(crate) fn passes<S: Simd>(self, s: S, new: i32x16<S>, there: i32x16<S>) -> mask32x16<S> {
        let [less, equal, greater] = self.outcomes();
        (mask32x16::splat(s, less) & new.simd_lt(there))
            | (mask32x16::splat(s, equal) & new.simd_eq(there))
            | (mask32x16::splat(s, greater) & new.simd_gt(there))
    }

    /// A bit for each lane that passes, by one comparison: for loops in which a branch that always goes the same way costs less than two comparisons more.
    #[inline(always)]
    pub(crate) fn passing_lanes<S: Simd>(self, _: S, new: i32x16<S>, there: i32x16<S>) -> u32 {
        // Bits in each case by itself: a mask that comes out of one of eight cases is taken apart and put together again.
        match self {
            Self::Never => 0,
            Self::Less => new.simd_lt(there).to_bitmask() as u32,
            Self::Equal => new.simd_eq(there).to_bitmask() as u32,
            Self::LessEqual => new.simd_le(there).to_bitmask() as u32,
            Self::Greater => new.simd_gt(there).to_bitmask() as u32,
            Self::NotEqual => (!new.simd_eq(there)).to_bitmask() as u32,
            Self::GreaterEqual => new.simd_ge(there).to_bitmask() as u32,
            Self::Always => 0xffff,
        }
    }
}

/// Keeps the depth and, with `ID`, the triangle of the samples that pass: visibility, no shader involved.
pub(crate) struct Visibility<'a, T, const ID: bool> {
    tile_depth: &'a mut [[i32; 16]],
    tile_id: &'a mut [[u32; 16]],
    bounds: &'a mut [Bounds; MAX_SAMPLES],
    test: T,
    /// Where the tile lies, if passing samples are counted, and how many there were.
    counted_in: Option<TileView>,
    pub(crate) passed: u64,
}

impl<'a, T, const ID: bool> Visibility<'a, T, ID> {
    pub(crate) fn new<S: Simd>(
        tile: &'a mut Tile,
        test: T,
        counted_in: Option<TileView>,
    ) -> (Self, &'a mut super::mid::Worklist)
    where
        T: DepthTest<S>,
    {
        let [less, _, greater] = test.outcomes();
        tile.unbound(less, greater);
        let Tile { depth, id, bounds, worklist, .. } = tile;
        (Self { tile_depth: depth, tile_id: id, bounds, test, counted_in, passed: 0 }, worklist)
    }
}

impl<T, const ID: bool> Visibility<'_, T, ID> {
    /// The farthest and the nearest depth in each lane of a window's blocks.
    #[inline(always)]
    fn extremes<S: Simd>(&self, s: S, block: usize, stride: usize) -> (f32x16<S>, f32x16<S>) {
        let first = i32x16::simd_from(s, self.tile_depth[block]);
        let (mut farthest, mut nearest) = (first, first);
        let mut row = 0;
        while row < 4 {
            let blocks = &self.tile_depth[block + row * stride..block + row * stride + 4];
            let mut k = 0;
            while k < 4 {
                let there = i32x16::simd_from(s, blocks[k]);
                farthest = farthest.max(there);
                nearest = nearest.min(there);
                k += 1;
            }
            row += 1;
        }
        (farthest.bitcast(), nearest.bitcast())
    }
}

impl<S: Simd, T: DepthTest<S>, const ID: bool> Sink<S> for Visibility<'_, T, ID> {
    #[inline(always)]
    fn samples(&mut self, s: S, block: usize, inside: mask32x16<S>, z: f32x16<S>, id: u32) {
        let z = self.test.depths(s, z);
        let depth = &mut self.tile_depth[block];
        let there = i32x16::simd_from(s, *depth);
        let passes = inside & self.test.passes(s, z, there);
        *depth = passes.select(z, there).into();
        if T::COUNTS && self.counted_in.is_some_and(|view| !view.is_border(block)) {
            self.passed += u64::from(passes.to_bitmask().count_ones());
        }
        if ID {
            let ids = &mut self.tile_id[block];
            let there = u32x16::simd_from(s, *ids);
            *ids = passes.select(u32x16::splat(s, id), there).into();
        }
    }

    #[inline(always)]
    fn hides_tile(&self, s: S, sample: usize, depths: DepthRange) -> bool {
        let ([less, equal, greater], depths) = (self.test.outcomes(), self.test.range(depths));
        let bounds = &self.bounds[sample & (MAX_SAMPLES - 1)];
        let (farthest, nearest) = (f32x16::simd_from(s, bounds.farthest), f32x16::simd_from(s, bounds.nearest));
        let all = |mask: mask32x16<S>| mask.to_bitmask() == 0xffff;
        (!greater && all(if equal { farthest.simd_lt(depths.nearest) } else { farthest.simd_le(depths.nearest) }))
            || (!less && all(if equal { nearest.simd_gt(depths.farthest) } else { nearest.simd_ge(depths.farthest) }))
    }

    #[inline(always)]
    fn hides_window(&self, window: Window, depths: DepthRange) -> bool {
        let ([less, equal, greater], depths) = (self.test.outcomes(), self.test.range(depths));
        let bounds = &self.bounds[window.sample & (MAX_SAMPLES - 1)];
        let (farthest, nearest) = (bounds.farthest[window.number & 15], bounds.nearest[window.number & 15]);
        (!greater && (if equal { depths.nearest > farthest } else { depths.nearest >= farthest }))
            || (!less && (if equal { depths.farthest < nearest } else { depths.farthest <= nearest }))
    }

    #[inline(always)]
    fn hides_blocks(&self, s: S, block: usize, stride: usize, depths: DepthRange) -> bool {
        let ([less, equal, greater], depths) = (self.test.outcomes(), self.test.range(depths));
        if less && greater {
            return false;
        }
        let (farthest, nearest) = self.extremes(s, block, stride);
        let all = |mask: mask32x16<S>| mask.to_bitmask() == 0xffff;
        (!greater && all(if equal { farthest.simd_lt(depths.nearest) } else { farthest.simd_le(depths.nearest) }))
            || (!less && all(if equal { nearest.simd_gt(depths.farthest) } else { nearest.simd_ge(depths.farthest) }))
    }

    #[inline(always)]
    fn lets_all_pass(&self, s: S, block: usize, stride: usize, depths: DepthRange) -> bool {
        // The usual tests only: others count what passes, or take longer to say what they let pass.
        if T::COUNTS {
            return false;
        }
        let (farthest, nearest) = self.extremes(s, block, stride);
        let [less, ..] = self.test.outcomes();
        // As they are compared: clamped.
        if less {
            nearest.simd_gt(if depths.farthest > 0.0 { depths.farthest } else { 0.0 }).to_bitmask() == 0xffff
        } else {
            farthest.simd_lt(if depths.nearest < 1.0 { depths.nearest } else { 1.0 }).to_bitmask() == 0xffff
        }
    }

    #[inline(always)]
    fn passing(&mut self, s: S, block: usize, z: f32x16<S>, id: u32) {
        self.tile_depth[block] = self.test.depths(s, z).into();
        if ID {
            self.tile_id[block] = u32x16::splat(s, id).into();
        }
    }

    #[inline(always)]
    fn covered_window(&mut self, window: Window, depths: DepthRange) {
        let ([less, _, greater], depths) = (self.test.outcomes(), self.test.range(depths));
        let bounds = &mut self.bounds[window.sample & (MAX_SAMPLES - 1)];
        let (farthest, nearest) = (&mut bounds.farthest[window.number & 15], &mut bounds.nearest[window.number & 15]);
        // What did not pass was no farther (nearer) than this triangle. Where both may pass, the next triangle may undo it.
        if less && !greater && depths.farthest < *farthest {
            *farthest = if depths.farthest > 0.0 { depths.farthest } else { 0.0 };
        }
        if greater && !less && depths.nearest > *nearest {
            *nearest = if depths.nearest < 1.0 { depths.nearest } else { 1.0 };
        }
    }
}

/// Counts how often each sample is covered, whatever its depth.
pub(crate) struct HitCounter<'a>(pub(crate) &'a mut [[u32; 16]]);

impl<S: Simd> Sink<S> for HitCounter<'_> {
    #[inline(always)]
    fn samples(&mut self, s: S, block: usize, inside: mask32x16<S>, _: f32x16<S>, _: u32) {
        let hits = &mut self.0[block];
        let there = u32x16::simd_from(s, *hits);
        *hits = inside.select(there + 1, there).into();
    }
}
