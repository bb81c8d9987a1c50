//! The canonical order of a triangle's vertices, of sixteen triangles at once; what it is for: [`TriangleId`](super::triangle_id::TriangleId).

use crate::wide::{Simd, i32x16, mask32x16};

/// Whether (ya, xa) comes before (yb, xb).
#[inline(always)]
fn before<S: Simd>(ya: i32x16<S>, xa: i32x16<S>, yb: i32x16<S>, xb: i32x16<S>) -> mask32x16<S> {
    ya.simd_lt(yb) | (ya.simd_eq(yb) & xa.simd_lt(xb))
}

/// The permutation that brings vertices into canonical order; see [`TriangleId`].
#[derive(Clone, Copy)]
pub(super) struct CanonicalOrder<S: Simd> {
    first_is_1: mask32x16<S>,
    first_is_2: mask32x16<S>,
    counter_clockwise: mask32x16<S>,
}

impl<S: Simd> CanonicalOrder<S> {
    #[inline(always)]
    pub(super) fn of(
        [x0, x1, x2]: [i32x16<S>; 3],
        [y0, y1, y2]: [i32x16<S>; 3],
        counter_clockwise: mask32x16<S>,
    ) -> Self {
        let first_is_1 = before(y1, x1, y0, x0) & !before(y2, x2, y1, x1);
        let first_is_2 = before(y2, x2, y0, x0) & before(y2, x2, y1, x1);
        Self { first_is_1, first_is_2, counter_clockwise }
    }

    #[inline(always)]
    pub(super) fn apply(&self, [a, b, c]: [i32x16<S>; 3]) -> [i32x16<S>; 3] {
        let first = self.first_is_1.select(b, self.first_is_2.select(c, a));
        let second = self.first_is_1.select(c, self.first_is_2.select(a, b));
        let third = self.first_is_1.select(a, self.first_is_2.select(b, c));
        [first, self.counter_clockwise.select(third, second), self.counter_clockwise.select(second, third)]
    }

    #[inline(always)]
    pub(super) fn code(&self, s: S) -> i32x16<S> {
        let none = i32x16::splat(s, 0);
        self.first_is_1.select(i32x16::splat(s, 1), none)
            + self.first_is_2.select(i32x16::splat(s, 2), none)
            + self.counter_clockwise.select(i32x16::splat(s, 3), none)
    }
}
