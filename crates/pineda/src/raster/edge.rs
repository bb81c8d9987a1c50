//! The edge function, of sixteen triangles at once (Pineda 1988):
//!
//! ```text
//! E_ab(p) = (b.x - a.x)(p.y - a.y) - (b.y - a.y)(p.x - a.x)
//! ```
//!
//! For vertices in clockwise order on the picture it is positive inside; his has the other sign, for the other winding. It is linear: a step to the right or down
//! adds a constant. At the third vertex it is twice the triangle's area.

use super::corners::Sixteen;
use super::top_left::is_top_left;
use crate::geometry::raster_space::SUBPIXEL_BITS;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};

/// An edge of each of sixteen triangles in canonical order: where it starts, and how far it goes.
#[derive(Clone, Copy)]
pub(super) struct Edge<S: Simd> {
    pub(super) x: i32x16<S>,
    pub(super) y: i32x16<S>,
    pub(super) dx: i32x16<S>,
    pub(super) dy: i32x16<S>,
}

impl<S: Simd> Edge<S> {
    #[inline(always)]
    pub(super) fn is_top_left(&self) -> mask32x16<S> {
        is_top_left(self.dx, self.dy)
    }

    /// The edge function with the fill rule at a sample, over 256, rounded down. Not negative where the sample is inside. From sample
    /// to sample the edge function changes by multiples of 256, so that nothing is lost. Fits i32 for triangles up to [`MID_EXTENT`].
    #[inline(always)]
    pub(super) fn at(&self, x: i32x16<S>, y: i32x16<S>) -> i32x16<S> {
        let e = self.dx * (y - self.y) - self.dy * (x - self.x);
        self.is_top_left().select(e, e - 1) >> SUBPIXEL_BITS
    }

    /// What [`Self::at`] gains a pixel right, and a pixel down, as two i16.
    #[inline(always)]
    pub(super) fn steps(&self) -> u32x16<S> {
        pack(-self.dy, self.dx)
    }
}

/// Two i16 in a word.
#[inline(always)]
pub(super) fn pack<S: Simd>(low: i32x16<S>, high: i32x16<S>) -> u32x16<S> {
    ((low & 0xffff) | (high << 16)).bitcast()
}

/// Twice the signed area, rounded once to f32, which keeps its sign and whether it is 0. i32 holds it for all but large triangles.
#[inline(always)]
pub(super) fn area_x2<S: Simd>(s: S, t: &Sixteen<S>, large: mask32x16<S>) -> f32x16<S> {
    let (ax, ay) = (t.x[1] - t.x[0], t.y[1] - t.y[0]);
    let (bx, by) = (t.x[2] - t.x[0], t.y[2] - t.y[0]);
    let area: f32x16<S> = (ax * by - bx * ay).to_float();
    if large.all_false() {
        return area;
    }
    let (p_low, p_high) = ax.widening_mul(by);
    let (q_low, q_high) = bx.widening_mul(ay);
    let low: [i64; 8] = (p_low - q_low).into();
    let high: [i64; 8] = (p_high - q_high).into();
    let mut exact = [0.0; 16];
    let mut k = 0;
    while k < 8 {
        exact[k] = low[k] as f32;
        exact[k + 8] = high[k] as f32;
        k += 1;
    }
    large.select(f32x16::simd_from(s, exact), area)
}
