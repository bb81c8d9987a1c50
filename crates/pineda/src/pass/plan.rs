//! Cutting a pass into batches that fit the memory that it may use.
//!
//! A batch is a stretch of the pass's triangles, in submission order, that goes through all stages at once. Mostly there is one. Where
//! there are more, each is drawn to the target before the next: the target holds all that there is between two draws, so that
//! it makes no difference to any bit.

use super::validate::{DrawExtent, smallest_and_largest};
use super::{ColorMask, Compare, DepthState, DrawState, Indices, Pass, Scissor, Viewport};
use crate::geometry::project::Projection;
use crate::raster::corners::Corners;
use crate::raster::setup::PixelRect;
use crate::raster::triangle_id::MAX_BATCH_TRIANGLES;
use crate::shading::run::Source;
use std::ops::Range;

/// Bytes that a triangle takes in records and bins, about.
const TRIANGLE_BYTES: usize = 56;
/// Bytes of a screen vertex.
const SCREEN_VERTEX_BYTES: usize = 16;
/// No batch is made for less than this, and none for more: so that 32 bits can name any word of its vertex records.
const LEAST_MEMORY: usize = 1 << 20;
const MOST_MEMORY: usize = if usize::BITS == 32 { 1 << 31 } else { 8 << 30 };

/// A stretch of one draw's triangles.
#[derive(Clone, Debug)]
pub(crate) struct Run<'p> {
    pub(crate) draw: usize,
    /// The first of its triangles, as the draw counts them, and how many there are.
    pub(crate) first_triangle: usize,
    pub(crate) triangles: usize,
    /// The number of its first triangle in the batch.
    pub(crate) first_number: usize,
    pub(crate) corners: Corners<'p>,
    pub(crate) source: Source<'p>,
    /// Where its vertices stand in the batch's screen vertices, and their records' rows.
    pub(crate) screen: Range<usize>,
    pub(crate) records: Range<usize>,
    pub(crate) projection: Projection,
    /// What its draw can cover.
    pub(crate) rect: PixelRect,
    pub(crate) segment: usize,
}

/// Consecutive runs that tiles treat alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Segment {
    pub(crate) kind: SegmentKind,
    pub(crate) depth: DepthRule,
    /// The draw that it belongs to, if draws are counted.
    pub(crate) draw: Option<usize>,
    /// What can be covered, if that is not the whole target.
    pub(crate) rect: Option<PixelRect>,
}

/// How depths are compared, and what they are clamped to before: the viewport's range, as bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DepthRule {
    pub(crate) compare: Compare,
    pub(crate) low: i32,
    pub(crate) high: i32,
}

impl DepthRule {
    fn new(compare: Compare, viewport: &Viewport) -> Self {
        // Adding 0 makes 0 of -0.
        let [a, b] = [viewport.min_depth, viewport.max_depth].map(|z| (z + 0.0).to_bits() as i32);
        Self { compare, low: a.min(b), high: a.max(b) }
    }

    /// Whether it is the usual one: [`Compare::Less`] over all depths.
    pub(crate) fn is_usual(&self) -> bool {
        *self == Self { compare: Compare::Less, low: 0, high: 1.0f32.to_bits() as i32 }
    }
}

/// How a segment's triangles become pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SegmentKind {
    /// Visibility first, shading when all of the batch is in.
    Deferred,
    /// Visibility alone: no colour is written.
    DepthOnly,
    /// Fragment by fragment, in order, with this run's shader.
    Ordered { run: usize },
}

/// What goes through the stages at once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Batch<'p> {
    pub(crate) runs: Vec<Run<'p>>,
    pub(crate) segments: Vec<Segment>,
    pub(crate) triangles: usize,
    pub(crate) screen_vertices: usize,
    pub(crate) record_rows: usize,
    bytes: usize,
    /// Whether each draw is a segment of its own, so that it can be counted alone.
    counts: bool,
}

/// Cuts a valid pass into at least one batch.
pub(crate) fn plan<'p>(
    pass: &'p Pass<'_>,
    extents: &[DrawExtent],
    width: u32,
    height: u32,
    memory: usize,
    counts: bool,
) -> Vec<Batch<'p>> {
    let budget = memory.clamp(LEAST_MEMORY, MOST_MEMORY);
    let fresh = || Batch { counts, ..Batch::default() };
    let mut batches = vec![fresh()];
    for (draw, extent) in extents.iter().enumerate() {
        let mut first = 0;
        while first < extent.triangles {
            let last = batches.len() - 1;
            let room = budget - batches[last].bytes.min(budget);
            let room_for = MAX_BATCH_TRIANGLES - batches[last].triangles;
            let is_fresh = batches[last].runs.is_empty();
            match piece(pass, extent, draw, first, room, room_for, is_fresh) {
                Some(piece) => {
                    first += piece.triangles;
                    batches[last].push(pass, draw, piece, width, height);
                }
                None => batches.push(fresh()),
            }
        }
    }
    batches
}

/// Triangles of a draw from some first one on, and the vertices that are shaded for them.
struct Piece<'p> {
    first: usize,
    triangles: usize,
    corners: Corners<'p>,
    source: Source<'p>,
    vertices: usize,
    bytes: usize,
}

/// As many triangles as there is room for; `None` if it is better to start a fresh batch.
fn piece<'p>(
    pass: &'p Pass<'_>,
    extent: &DrawExtent,
    draw: usize,
    first: usize,
    room: usize,
    room_for: usize,
    is_fresh: bool,
) -> Option<Piece<'p>> {
    let call = &pass.draws[draw];
    let vertex_bytes = SCREEN_VERTEX_BYTES + 16 * call.record_rows();
    let bytes = |triangles: usize, vertices: usize| triangles * TRIANGLE_BYTES + vertices * vertex_bytes;
    let left = (extent.triangles - first).min(room_for);
    // With vertices of its own for each corner.
    let alone = left.min((room / bytes(1, 3)).max(if is_fresh { 16 } else { 0 }));
    let sequential = |triangles: usize, source: Source<'p>| {
        let (vertices, bytes) = (3 * triangles, bytes(triangles, 3 * triangles));
        (triangles > 0).then_some(Piece { first, triangles, corners: Corners::Sequential, source, vertices, bytes })
    };
    let indices = match call.indices() {
        Indices::Sequential => return sequential(alone, Source::Range(3 * first)),
        Indices::U32(indices) => indices,
    };
    let shared = |triangles: usize, vertices: Range<usize>| Piece {
        first,
        triangles,
        corners: Corners::Indexed {
            indices: &indices.as_chunks().0[first..first + triangles],
            first_vertex: vertices.start as u32,
        },
        source: Source::Range(vertices.start),
        vertices: vertices.len(),
        bytes: bytes(triangles, vertices.len()),
    };
    // All that is left, with all of the draw's vertices.
    if left == extent.triangles - first && bytes(left, extent.vertices.len()) <= room {
        return Some(shared(left, extent.vertices.clone()));
    }
    if !is_fresh {
        return None;
    }
    // A stretch whose vertices stand close together in the buffer, as those of most meshes do.
    let triangles = left.min(room / bytes(1, 1));
    if triangles > alone {
        let (low, high) = smallest_and_largest(&indices[3 * first..3 * (first + triangles)]);
        let span = low as usize..high as usize + 1;
        if bytes(triangles, span.len()) <= room {
            return Some(shared(triangles, span));
        }
    }
    sequential(alone, Source::List(&indices[3 * first..3 * (first + alone)]))
}

impl<'p> Batch<'p> {
    fn push(&mut self, pass: &Pass<'_>, draw: usize, piece: Piece<'p>, width: u32, height: u32) {
        let call = &pass.draws[draw];
        let state = call.state();
        let viewport = state.viewport.unwrap_or(Viewport::whole(width, height));
        let rect = covered_rect(&viewport, state.scissor, width, height);
        let whole = PixelRect { x0: 0, y0: 0, x1: width as i32, y1: height as i32 };
        let kind = kind(state, call.discards(), self.runs.len());
        let depth = DepthRule::new(state.depth.compare, &viewport);
        let segment =
            Segment { kind, depth, draw: self.counts.then_some(draw), rect: Some(rect).filter(|&rect| rect != whole) };
        if self.segments.last() != Some(&segment) {
            self.segments.push(segment);
        }
        let screen = self.screen_vertices..self.screen_vertices + piece.vertices;
        let records = self.record_rows..self.record_rows + piece.vertices * call.record_rows();
        (self.screen_vertices, self.record_rows) = (screen.end, records.end);
        self.runs.push(Run {
            draw,
            first_triangle: piece.first,
            triangles: piece.triangles,
            first_number: self.triangles,
            corners: piece.corners,
            source: piece.source,
            screen,
            records,
            projection: Projection::new(state.space, &viewport).with_depth_clamp(state.depth_clamp),
            rect,
            segment: self.segments.len() - 1,
        });
        self.triangles += piece.triangles;
        self.bytes += piece.bytes;
    }

    /// The run that triangle `number` of the batch belongs to.
    #[inline(always)]
    pub(crate) fn run_of(&self, number: usize) -> usize {
        self.runs.partition_point(|run| run.first_number <= number).saturating_sub(1)
    }
}

/// How run `run` becomes pixels.
fn kind(state: &DrawState, discards: bool, run: usize) -> SegmentKind {
    let DepthState { compare, write } = state.depth;
    // Only what leaves its depth behind may wait: else the visibility buffer would not know the depth of what it shows.
    let leaves_depth = write || compare == Compare::Equal;
    match state.color_mask {
        _ if state.stencil.is_some() => SegmentKind::Ordered { run },
        ColorMask::NONE if leaves_depth && !discards => SegmentKind::DepthOnly,
        ColorMask::ALL if leaves_depth && !discards && state.blend.replaces() => SegmentKind::Deferred,
        _ => SegmentKind::Ordered { run },
    }
}

/// The pixels of the target that lie in a viewport and a scissor rectangle.
fn covered_rect(viewport: &Viewport, scissor: Option<Scissor>, width: u32, height: u32) -> PixelRect {
    let side = |start: f32, size: f32, scissor: Option<(i32, u32)>, limit: u32| {
        let limit = i64::from(limit);
        let round = |v: f32| (v.round_ties_even() as i64).clamp(0, limit);
        let (a, b) = (round(start), round(start + size));
        let (first, last) = (a.min(b), a.max(b));
        let Some((start, size)) = scissor else { return (first as i32, last as i32) };
        let cut = |v: i64| v.clamp(first, last) as i32;
        (cut(i64::from(start)), cut(i64::from(start) + i64::from(size)))
    };
    let (x0, x1) = side(viewport.x, viewport.width, scissor.map(|s| (s.x, s.width)), width);
    let (y0, y1) = side(viewport.y, viewport.height, scissor.map(|s| (s.y, s.height)), height);
    PixelRect { x0, y0, x1, y1 }
}
