//! The fill rule.
//!
//! A sample that lies exactly on an edge belongs to the triangle only if the edge is a *top* edge (exactly horizontal, the
//! triangle below it) or a *left* edge (not horizontal, on the triangle's left side). An edge that two triangles share is a
//! top or left edge of exactly one of them, so that each sample on it is covered once (D3D11.3, 3.4.2.1).
//!
//! ```text
//!        top                      With y down and the vertices in clockwise order, an edge
//!      -------->                  from a to b, (dx, dy) = b - a, is
//!     ^         \                 - a top edge if it runs right:  dy == 0 and dx > 0
//! left \         \ right          - a left edge if it runs up:    dy < 0
//!       \         v
//!        <---------               A sample on a vertex needs both of its edges to be top or left:
//!          bottom                 that follows, because it lies on both.
//! ```
//!
//! Setup applies the rule once, by taking 1 from the edge functions of the other edges: for integers, `E > 0` is `E - 1 >= 0`,
//! and from there on a sample is inside where all three are `>= 0`.

use crate::wide::{Simd, i32x16, mask32x16};

/// Whether the edges with these differences, of triangles in clockwise order on the picture, are top or left edges.
#[inline(always)]
pub(crate) fn is_top_left<S: Simd>(dx: i32x16<S>, dy: i32x16<S>) -> mask32x16<S> {
    dy.simd_lt(0) | (dy.simd_eq(0) & dx.simd_gt(0))
}

/// The same of one edge.
pub(crate) fn is_top_left_edge(dx: i32, dy: i32) -> bool {
    dy < 0 || (dy == 0 && dx > 0)
}
