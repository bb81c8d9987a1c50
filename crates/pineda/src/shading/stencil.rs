//! Depth and stencil test of ordered packets, and what the stencil test leaves behind.

use crate::pass::{DrawState, StencilFace, StencilOperation};
use crate::raster::triangle_id::{CLIPPED_CLOCKWISE, TriangleId};
use crate::tile::Tile;
use crate::wide::{Simd, i32x16, mask32x16};

/// The samples that are covered, that pass the stencil test, and that pass both tests.
#[derive(Clone, Copy)]
pub(crate) struct Tested<'a, S: Simd> {
    covered: mask32x16<S>,
    stencil: mask32x16<S>,
    pub(crate) both: mask32x16<S>,
    face: Option<&'a StencilFace>,
}

/// A draw's tests.
#[derive(Clone, Copy)]
pub(crate) struct Tests<'a> {
    pub(crate) state: &'a DrawState,
    pub(crate) front_is_clockwise: bool,
}

impl<'a> Tests<'a> {
    /// Tests samples that a triangle covers in a block against what the tile holds.
    #[inline(always)]
    pub(crate) fn of<S: Simd>(
        &self,
        s: S,
        tile: &Tile,
        id: TriangleId,
        block: usize,
        covered: mask32x16<S>,
        depth: &[i32; 16],
    ) -> Tested<'a, S> {
        let state = self.state;
        let there = i32x16::simd_from(s, tile.depth[block]);
        let passes = covered & state.depth.compare.passes(s, i32x16::simd_from(s, *depth), there);
        let Some(stencil) = &state.stencil else {
            return Tested { covered, stencil: covered, both: passes, face: None };
        };
        let is_clockwise = id.order_code() < 3 || id.order_code() == CLIPPED_CLOCKWISE;
        let face = if is_clockwise == self.front_is_clockwise { &stencil.front } else { &stencil.back };
        let read = i32::from(face.read_mask);
        let reference = i32x16::splat(s, i32::from(face.reference) & read);
        let stored = i32x16::simd_from(s, tile.stencil[block]) & read;
        let stencil = covered & face.compare.passes(s, reference, stored);
        Tested { covered, stencil, both: stencil & passes, face: Some(face) }
    }
}

impl<S: Simd> Tested<'_, S> {
    /// The samples that must be shaded before it is known which pass: those that pass by the triangle's depth, unless the fragment stage writes
    /// another, or failing changes the stencil buffer and so is the stage's to decide, too.
    #[inline(always)]
    pub(crate) fn undecided(&self, writes_depth: bool) -> mask32x16<S> {
        if self.face.is_some_and(|face| [face.fail, face.depth_fail] != [StencilOperation::Keep; 2]) {
            return self.covered;
        }
        if writes_depth { self.stencil } else { self.both }
    }

    /// Applies the face's operations.
    #[inline(always)]
    pub(crate) fn update(&self, s: S, tile: &mut Tile, block: usize) {
        let Some(face) = self.face else { return };
        let there = i32x16::simd_from(s, tile.stencil[block]);
        let fail = self.stencil.select(there, operated(s, face, face.fail, there));
        let depth_fail = self.both.select(there, operated(s, face, face.depth_fail, there));
        let pass = operated(s, face, face.pass, there);
        let new = self.both.select(pass, self.stencil.select(depth_fail, fail));
        let write = i32::from(face.write_mask);
        let new = (there & !write) | (new & write);
        tile.stencil[block] = self.covered.select(new, there).into();
    }
}

#[inline(always)]
fn operated<S: Simd>(s: S, face: &StencilFace, operation: StencilOperation, there: i32x16<S>) -> i32x16<S> {
    match operation {
        StencilOperation::Keep => there,
        StencilOperation::Zero => i32x16::splat(s, 0),
        StencilOperation::Replace => i32x16::splat(s, face.reference.into()),
        StencilOperation::IncrementClamp => (there + 1).min(255),
        StencilOperation::DecrementClamp => (there - 1).max(0),
        StencilOperation::Invert => there ^ 255,
        StencilOperation::IncrementWrap => (there + 1) & 255,
        StencilOperation::DecrementWrap => (there - 1) & 255,
    }
}
