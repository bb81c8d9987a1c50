//! What shading knows of a run of triangles: where its vertices are, and what came out of their vertex stage.

use super::strokes::StrokeView;
use crate::geometry::project::Projection;
use crate::geometry::raster_space::ScreenVertex;
use crate::pass::ProvokingVertex;
use crate::pass::plan::Run;
use crate::raster::corners::Corners;
use crate::raster::triangle_id::{ORDERS, TriangleId};

/// Words of a vertex record before its varyings: x and y in subpixels, 1 / w.
pub(crate) const RECORD_HEADER: usize = 3;

/// Vertex records are whole rows of these: what lanes load of many vertices is found and checked once for each.
pub(crate) type RecordRow = [u32; 8];

/// Rows of the record of a vertex with `varyings` numbers.
pub(crate) const fn record_rows(varyings: usize) -> usize {
    (RECORD_HEADER + varyings).div_ceil(8)
}

/// Which vertex of the draw stands at a place.
///
/// Vertices are numbered through all instances: the number of instance i's vertex v is `i * (vertices of the mesh) + v`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source<'a> {
    /// Vertex `first + place`.
    Range(usize),
    /// The vertices that indices name, of one instance after the other; the first one's vertex 0 has the number `base`, and they are `stride` apart.
    List { indices: &'a [u32], base: usize, stride: usize },
    /// The same `each` vertices of one instance after the other, the first of them number `first`; instances are `stride` apart.
    Instances { first: usize, each: usize, stride: usize },
}

impl Source<'_> {
    #[inline(always)]
    pub(crate) fn vertex(&self, place: usize) -> usize {
        match *self {
            Self::Range(first) => first + place,
            Self::List { indices, base, stride } => {
                base + place / indices.len() * stride + indices[place % indices.len()] as usize
            }
            Self::Instances { first, each, stride } => first + place / each * stride + place % each,
        }
    }

    /// The same, where there is one instance: without divisions.
    #[inline(always)]
    pub(crate) fn vertex_of_one(&self, place: usize) -> usize {
        match *self {
            Self::Range(first) | Self::Instances { first, .. } => first + place,
            Self::List { indices, base, .. } => base + indices[place] as usize,
        }
    }
}

/// A run of triangles of one draw, after the vertex stage.
#[derive(Clone, Copy)]
pub(crate) struct RunView<'a> {
    pub(crate) run: &'a Run<'a>,
    pub(crate) corners: Corners<'a>,
    pub(crate) source: Source<'a>,
    /// The number of its first triangle in the batch.
    pub(crate) first_number: usize,
    /// [`record_rows`] for each vertex.
    pub(crate) records: &'a [RecordRow],
    /// The vertices on the raster; none of strokes.
    pub(crate) screen: &'a [ScreenVertex],
    pub(crate) projection: &'a Projection,
    pub(crate) front_is_clockwise: bool,
    pub(crate) provoking: ProvokingVertex,
    /// If it is of lines or points.
    pub(crate) strokes: Option<StrokeView<'a>>,
}

impl RunView<'_> {
    /// The places of a triangle's vertices, as [`Corners`] has them: the provoking vertex first.
    #[inline(always)]
    pub(crate) fn places(&self, id: TriangleId) -> [usize; 3] {
        self.corners.of(id.number().wrapping_sub(self.first_number))
    }

    /// Which vertex of a triangle as submitted is `corner`.
    pub(crate) fn submitted(&self, corner: usize) -> usize {
        match self.provoking {
            ProvokingVertex::First => corner,
            ProvokingVertex::Last => (corner + 2) % 3,
        }
    }

    /// The places of a triangle's vertices, in canonical order.
    #[inline(always)]
    pub(crate) fn canonical_places(&self, id: TriangleId) -> [usize; 3] {
        let places = self.places(id);
        let order = ORDERS[id.order_code() as usize & 7];
        [places[order[0] as usize % 3], places[order[1] as usize % 3], places[order[2] as usize % 3]]
    }

    /// Varying `k` at the first vertex and by how much the others exceed it; of a flat one, at the provoking vertex.
    #[inline(always)]
    pub(crate) fn vertex_values(&self, each: usize, places: &[usize; 4], k: usize, is_flat: bool) -> [f32; 3] {
        if is_flat {
            return [self.word(each, places[3], k), 0.0, 0.0];
        }
        let f0 = self.word(each, places[0], k);
        [f0, self.word(each, places[1], k) - f0, self.word(each, places[2], k) - f0]
    }

    /// The depth at the first of three vertices on the raster, and by how much the others exceed it; 0 of strokes.
    #[inline(always)]
    pub(crate) fn vertex_depths(&self, places: [usize; 3]) -> [f32; 3] {
        if self.screen.is_empty() {
            return [0.0; 3];
        }
        let [a, b, c] = [self.screen[places[0]].z(), self.screen[places[1]].z(), self.screen[places[2]].z()];
        [a, b - a, c - a]
    }

    #[inline(always)]
    fn word(&self, each: usize, place: usize, k: usize) -> f32 {
        let at = RECORD_HEADER + k;
        f32::from_bits(self.records[place * each + at / 8][at % 8])
    }
}
