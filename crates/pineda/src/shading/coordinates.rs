//! Barycentric coordinates as users see them: of a triangle's own vertices, in the order in which they were submitted.
//!
//! Interpolation has no use for the third of them, and multiplies by the reciprocal of their sum, once for all varyings. Here each is a quotient, so that none is further off than it must be:
//! by a rounding more than its edge function and the sum.

use super::run::RunView;
use crate::raster::triangle_id::TriangleId;
use crate::target::format::one_nan;
use crate::wide::{Simd, f32x16};

/// Of sixteen fragments: the first vertex's, the second's, the third's.
pub(crate) type Coordinates = [[f32; 16]; 3];

/// From weights in any order: `order[k]` says which corner (as [`RunView::places`] has them) weight `k` is of.
#[inline(always)]
pub(crate) fn coordinates<S: Simd>(
    s: S,
    run: &RunView<'_>,
    id: TriangleId,
    weights: &[f32x16<S>; 3],
    order: [usize; 3],
) -> Coordinates {
    let [a, b, c] = *weights;
    let sum = (a + b) + c;
    let values = [one_nan(s, a / sum).into(), one_nan(s, b / sum).into(), one_nan(s, c / sum).into()];
    let (values, vertices) = match &run.strokes {
        None => (values, [run.submitted(order[0]), run.submitted(order[1]), run.submitted(order[2])]),
        Some(strokes) => strokes.coordinates(id.number() - run.first_number, values, order),
    };
    let mut of_vertices = [[0.0; 16]; 3];
    for (value, vertex) in values.into_iter().zip(vertices) {
        of_vertices[vertex] = value;
    }
    of_vertices
}
