//! What shading knows of lines and points, beyond that they look like triangles.

use super::distinct::Fragments;
use crate::pass::ProvokingVertex;
use crate::raster::groups::LinearDepth;
use crate::raster::smooth::covered_area;
use crate::raster::stroke::{Stroke, StrokeShape, corners_of_line};
use crate::wide::{Simd, f32x16};

/// The strokes of a run.
#[derive(Clone, Copy)]
pub(crate) struct StrokeView<'a> {
    pub(crate) shape: StrokeShape,
    pub(crate) strokes: &'a [Stroke],
    /// Whether they are the edges or the corners of triangles, three each.
    pub(crate) is_of_triangles: bool,
    pub(crate) provoking: ProvokingVertex,
}

impl StrokeView<'_> {
    /// The parts of a packet's pixels that a smooth line covers, by its number in the run; `None` of anything else. The packet is all of that line.
    #[inline(always)]
    pub(crate) fn covered_parts<S: Simd>(&self, s: S, stroke: usize, fragments: &Fragments<'_>) -> Option<f32x16<S>> {
        let StrokeShape::Smooth { width } = self.shape else { return None };
        let corners = corners_of_line(&self.strokes[stroke], width);
        let mut parts = [0.0; 16];
        let mut rest = fragments.mask & 0xffff;
        while rest != 0 {
            let lane = rest.trailing_zeros() & 15;
            rest &= rest - 1;
            let (column, row) = ((lane & 3) as i32, (lane >> 2) as i32);
            parts[lane as usize] = covered_area(&corners, fragments.x + column, fragments.y + row);
        }
        Some(f32x16::simd_from(s, parts))
    }

    /// The depth of a stroke, by its number in the run, at a place on the raster.
    pub(crate) fn depth(&self, stroke: usize, at: [i32; 2]) -> f32 {
        let Stroke { ends: [a, b], z: [za, zb], .. } = self.strokes[stroke];
        match self.shape {
            StrokeShape::Point => za,
            _ => LinearDepth::along(a, b, za, zb).at(at),
        }
    }

    /// Barycentric coordinates in a line, a point or the triangle that it is of, from those of a stroke's three records: `values[k]` is that of
    /// record `order[k]`; what is returned, of vertex `order[k]` as submitted.
    pub(crate) fn coordinates(
        &self,
        stroke: usize,
        values: [[f32; 16]; 3],
        order: [usize; 3],
    ) -> ([[f32; 16]; 3], [usize; 3]) {
        let (none, mut of_record) = ([0.0; 16], [[0.0; 16]; 3]);
        for (value, record) in values.into_iter().zip(order) {
            of_record[record] = value;
        }
        let is_last = self.provoking == ProvokingVertex::Last;
        // Which vertices the first and the second record are of.
        let [first, second] = match (self.is_of_triangles, is_last) {
            (true, false) => [stroke % 3, (stroke + 1) % 3],
            (true, true) => [(stroke + 2) % 3, stroke % 3],
            (false, true) if self.shape != StrokeShape::Point => [1, 0],
            (false, _) => [0, 1],
        };
        let (mut a, mut b) = ([1.0; 16], none);
        if self.shape != StrokeShape::Point {
            // The third record has the first's varyings.
            for (lane, a) in a.iter_mut().enumerate() {
                *a = of_record[0][lane] + of_record[2][lane];
            }
            b = of_record[1];
        }
        ([a, b, none], [first, second, 3 - first - second])
    }
}
