//! What becomes of covered samples: the coverage kernels hand them over a block at a time.

use super::Tile;
use crate::pass::Compare;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};

/// Takes the covered samples of blocks, triangle by triangle, in submission order.
pub(crate) trait Sink<S: Simd> {
    /// The samples of one block that a triangle covers, and the triangle's depth at all of the block's samples.
    fn samples(&mut self, s: S, block: usize, inside: mask32x16<S>, z: f32x16<S>, id: u32);

    /// Whether a triangle that is nowhere nearer than `nearest` can be left out of the whole tile, by what is known of it.
    #[inline(always)]
    fn hides_tile(&self, _: S, _nearest: f32) -> bool {
        false
    }

    /// Whether it can be left out of a 16 x 16 window, by what is known of it.
    #[inline(always)]
    fn hides_window(&self, _window: usize, _nearest: f32) -> bool {
        false
    }

    /// Whether it can be left out of the window from `block` on, by what is there: takes longer than asking what is known.
    #[inline(always)]
    fn hides_blocks(&self, _: S, _block: usize, _stride: usize, _nearest: f32) -> bool {
        false
    }

    /// A triangle that is nowhere farther than `farthest` was drawn to every sample of a window.
    #[inline(always)]
    fn covered_window(&mut self, _window: usize, _farthest: f32) {}
}

/// Clamps depths to 0 to 1, as bits: negative numbers and -0 are negative as integers, too.
#[inline(always)]
pub(crate) fn depth_bits<S: Simd>(z: f32x16<S>) -> i32x16<S> {
    const ONE: i32 = 1.0f32.to_bits() as i32;
    z.bitcast::<i32x16<S>>().max(0).min(ONE)
}

/// The comparison that the depth test of a draw makes.
pub(crate) trait DepthTest<S: Simd>: Copy {
    /// Whether passing samples can only come nearer, so that bounds of what is there stay bounds.
    const NEARER_ONLY: bool;
    /// Which of the samples pass.
    fn passes(&self, s: S, z: i32x16<S>, there: i32x16<S>) -> mask32x16<S>;
}

/// [`Compare::Less`].
#[derive(Clone, Copy)]
pub(crate) struct Less;

impl<S: Simd> DepthTest<S> for Less {
    const NEARER_ONLY: bool = true;

    #[inline(always)]
    fn passes(&self, _: S, z: i32x16<S>, there: i32x16<S>) -> mask32x16<S> {
        z.simd_lt(there)
    }
}

/// Any comparison.
#[derive(Clone, Copy)]
pub(crate) struct AnyCompare(pub(crate) Compare);

impl<S: Simd> DepthTest<S> for AnyCompare {
    const NEARER_ONLY: bool = false;

    #[inline(always)]
    fn passes(&self, s: S, z: i32x16<S>, there: i32x16<S>) -> mask32x16<S> {
        let [less, equal, greater] = self.0.outcomes();
        (mask32x16::splat(s, less) & z.simd_lt(there))
            | (mask32x16::splat(s, equal) & z.simd_eq(there))
            | (mask32x16::splat(s, greater) & z.simd_gt(there))
    }
}

/// Keeps the depth and, with `ID`, the triangle of the samples that pass: visibility, no shader involved.
pub(crate) struct Visibility<'a, T, const ID: bool> {
    tile_depth: &'a mut [[i32; 16]],
    tile_id: &'a mut [[u32; 16]],
    windows: &'a mut [f32; 16],
    test: T,
}

impl<'a, T, const ID: bool> Visibility<'a, T, ID> {
    pub(crate) fn new<S: Simd>(tile: &'a mut Tile, test: T) -> (Self, &'a mut super::mid::Worklist)
    where
        T: DepthTest<S>,
    {
        if !T::NEARER_ONLY {
            tile.bound(1.0);
        }
        let Tile { depth, id, windows, worklist, .. } = tile;
        (Self { tile_depth: depth, tile_id: id, windows, test }, worklist)
    }
}

impl<S: Simd, T: DepthTest<S>, const ID: bool> Sink<S> for Visibility<'_, T, ID> {
    #[inline(always)]
    fn samples(&mut self, s: S, block: usize, inside: mask32x16<S>, z: f32x16<S>, id: u32) {
        let z = depth_bits(z);
        let depth = &mut self.tile_depth[block];
        let there = i32x16::simd_from(s, *depth);
        let passes = inside & self.test.passes(s, z, there);
        *depth = passes.select(z, there).into();
        if ID {
            let ids = &mut self.tile_id[block];
            let there = u32x16::simd_from(s, *ids);
            *ids = passes.select(u32x16::splat(s, id), there).into();
        }
    }

    #[inline(always)]
    fn hides_tile(&self, s: S, nearest: f32) -> bool {
        T::NEARER_ONLY && f32x16::simd_from(s, *self.windows).simd_le(nearest).to_bitmask() == 0xffff
    }

    #[inline(always)]
    fn hides_window(&self, window: usize, nearest: f32) -> bool {
        T::NEARER_ONLY && nearest >= self.windows[window & 15]
    }

    #[inline(always)]
    fn hides_blocks(&self, s: S, block: usize, stride: usize, nearest: f32) -> bool {
        if !T::NEARER_ONLY {
            return false;
        }
        let mut farthest = i32x16::splat(s, 0);
        let mut row = 0;
        while row < 4 {
            let blocks = &self.tile_depth[block + row * stride..block + row * stride + 4];
            farthest = farthest.max(i32x16::simd_from(s, blocks[0])).max(i32x16::simd_from(s, blocks[1]));
            farthest = farthest.max(i32x16::simd_from(s, blocks[2])).max(i32x16::simd_from(s, blocks[3]));
            row += 1;
        }
        farthest.bitcast::<f32x16<S>>().simd_le(nearest).to_bitmask() == 0xffff
    }

    #[inline(always)]
    fn covered_window(&mut self, window: usize, farthest: f32) {
        if T::NEARER_ONLY {
            let bound = &mut self.windows[window & 15];
            if farthest < *bound {
                *bound = farthest.max(0.0);
            }
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
