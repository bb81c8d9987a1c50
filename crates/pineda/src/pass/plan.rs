//! Cutting a pass into batches that fit the memory that it may use.
//!
//! A batch is a stretch of the pass's triangles (lines and points count as such), in submission order, that goes through all stages at once. Mostly there is one. Where
//! there are more, each is drawn to the target before the next: the target holds all that there is between two draws, so that
//! it makes no difference to any bit.

use super::assembly::Assembly;
use super::draw_call::DrawCall;
use super::strokes::{self, RECORDS_EACH, StrokeRun};
use super::validate::DrawExtent;
use super::{Compare, Conservative, DepthState, DrawState, Indices, Pass, Scissor, Viewport};
use crate::Target;
use crate::geometry::project::Projection;
use crate::raster::corners::Corners;
use crate::raster::reach::PixelRect;
use crate::raster::samples::Samples;
use crate::raster::stroke::{Stroke, StrokeShape};
use crate::raster::triangle_id::MAX_BATCH_TRIANGLES;
use crate::shading::StageUses;
use crate::shading::run::{RecordRow, Source};
use crate::wide::{Simd, f32x16};
use std::ops::Range;

/// Bytes that a triangle takes in records and bins for each sample of a pixel, about; and in the list of those that are assembled.
const TRIANGLE_BYTES: usize = 56;
const ASSEMBLED_BYTES: usize = 12;
/// Bytes that a line, a point or a conservative triangle takes there, about: as many records as most have.
const STROKE_BYTES: usize = 160;
/// Bytes of a screen vertex.
const SCREEN_VERTEX_BYTES: usize = 16;
/// No batch is made for less than this, and none for more: so that 32 bits can name any word of its vertex records.
const LEAST_MEMORY: usize = 1 << 20;
const MOST_MEMORY: usize = if usize::BITS == 32 { 1 << 31 } else { 8 << 30 };

/// A stretch of one draw's triangles.
#[derive(Clone, Debug)]
pub(crate) struct Run<'p> {
    pub(crate) draw: usize,
    /// The first of its triangles, as the draw counts them through all instances, and how many numbers they have.
    pub(crate) first_triangle: usize,
    pub(crate) triangles: usize,
    /// Numbers of one triangle: 1, unless it is drawn as edges or corners.
    pub(crate) numbers_each: usize,
    /// Triangles of one instance.
    pub(crate) triangles_each: usize,
    /// The number of its first triangle in the batch.
    pub(crate) first_number: usize,
    pub(crate) geometry: Geometry<'p>,
    /// Where its vertices stand in the batch's screen vertices, and their records' rows.
    pub(crate) screen: Range<usize>,
    pub(crate) records: Range<usize>,
    pub(crate) projection: Projection,
    /// What its draw can cover.
    pub(crate) rect: PixelRect,
    pub(crate) segment: usize,
    /// If it is drawn as lines or points.
    pub(crate) strokes: Option<StrokeRun>,
}

/// Which vertices a run shades, and which of them its triangles have.
#[derive(Clone, Debug)]
pub(crate) enum Geometry<'p> {
    /// As the draw's indices say, or as vertices follow each other.
    Given(Corners<'p>, Source<'p>),
    /// As the triangles say that are assembled in this part of the batch's list. They hold places; vertex `first_vertex` of each instance
    /// has its first, and `vertices_each` later comes the next instance's.
    Shared { triangles: Range<usize>, first_vertex: u32, vertices_each: u32, source: Source<'static> },
    /// Each corner a vertex of its own, as the triangles of one instance say that are assembled in this part of the batch's list. The first
    /// instance's vertex 0 has the number `base`, and they are `stride` apart.
    Alone { triangles: Range<usize>, base: usize, stride: usize },
}

impl Run<'_> {
    pub(crate) fn corners<'a>(&'a self, assembled: &'a [[u32; 3]]) -> Corners<'a> {
        match &self.geometry {
            Geometry::Given(corners, _) => *corners,
            Geometry::Shared { triangles, .. } => {
                Corners::Indexed { indices: &assembled[triangles.clone()], first_vertex: 0 }
            }
            Geometry::Alone { .. } => Corners::Sequential,
        }
    }

    pub(crate) fn source<'a>(&'a self, assembled: &'a [[u32; 3]]) -> Source<'a> {
        match &self.geometry {
            Geometry::Given(_, source) => *source,
            Geometry::Shared { source, .. } => *source,
            Geometry::Alone { triangles, base, stride } => {
                let indices = assembled[triangles.clone()].as_flattened();
                Source::List { indices, base: *base, stride: *stride }
            }
        }
    }

    /// How many triangles are assembled for it.
    pub(crate) fn assembled(&self) -> usize {
        match &self.geometry {
            Geometry::Given(..) => 0,
            Geometry::Shared { triangles, .. } | Geometry::Alone { triangles, .. } => triangles.len(),
        }
    }

    /// The instance that a triangle of the run belongs to, and its number there; `number` counts from the run's first.
    pub(crate) fn instance_and_triangle(&self, number: usize) -> (usize, usize) {
        let triangle = self.first_triangle + if self.numbers_each == 1 { number } else { number / self.numbers_each };
        // Mostly there is one instance, and divisions take longer than all else that is done for a pixel's id.
        if triangle < self.triangles_each {
            return (0, triangle);
        }
        (triangle / self.triangles_each, triangle % self.triangles_each)
    }
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

    /// Clamps depths, whatever they are: of NaN it makes the least. (Those of triangles are never NaN, and clamped as integers.)
    #[inline(always)]
    pub(crate) fn clamped<S: Simd>(&self, s: S, z: f32x16<S>) -> f32x16<S> {
        let low = f32x16::splat(s, f32::from_bits(self.low as u32));
        let high = f32x16::splat(s, f32::from_bits(self.high as u32));
        z.max(low).min(high)
    }

    /// Whether depths are clamped to no less than 0 to 1.
    pub(crate) fn is_whole_range(&self) -> bool {
        self.low == 0 && self.high == 1.0f32.to_bits() as i32
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
    /// Of those, how many are assembled.
    pub(crate) assembled: usize,
    pub(crate) screen_vertices: usize,
    pub(crate) record_rows: usize,
    pub(crate) strokes: usize,
    pub(crate) stroke_rows: usize,
    bytes: usize,
    /// Whether each draw is a segment of its own, so that it can be counted alone.
    counts: bool,
}

/// Cuts a valid pass into at least one batch.
pub(crate) fn plan<'p>(
    pass: &'p Pass<'_>,
    extents: &'p [DrawExtent],
    target: &Target<'_>,
    memory: usize,
    counts: bool,
) -> Plan<'p> {
    let budget = memory.clamp(LEAST_MEMORY, MOST_MEMORY);
    let Target { width, height, samples, .. } = *target;
    Plan { pass, extents, width, height, budget, counts, samples, draw: 0, triangle: 0, is_done: false }
}

/// One batch after the other: of a draw with very many instances there are more than one would like to keep.
#[derive(Clone, Debug)]
pub(crate) struct Plan<'p> {
    pass: &'p Pass<'p>,
    extents: &'p [DrawExtent],
    width: u32,
    height: u32,
    budget: usize,
    /// As [`Batch::counts`].
    counts: bool,
    samples: Samples,
    /// The next triangle: its draw, and its number there through all instances.
    draw: usize,
    triangle: usize,
    is_done: bool,
}

impl<'p> Iterator for Plan<'p> {
    type Item = Batch<'p>;

    fn next(&mut self) -> Option<Batch<'p>> {
        if self.is_done {
            return None;
        }
        let mut batch = Batch { counts: self.counts, ..Batch::default() };
        while let Some(extent) = self.extents.get(self.draw) {
            if self.triangle == extent.triangles * extent.instances {
                (self.draw, self.triangle) = (self.draw + 1, 0);
                continue;
            }
            let call = &*self.pass.draws[self.draw];
            let room = Room {
                bytes: self.budget - batch.bytes.min(self.budget),
                triangles: (MAX_BATCH_TRIANGLES - batch.triangles) / strokes::numbers_each(call.state()),
                is_fresh: batch.runs.is_empty(),
            };
            let Some(piece) = piece(call, extent, self.triangle, &room, batch.assembled, self.samples) else {
                return Some(batch);
            };
            self.triangle += piece.triangles;
            batch.push(call, self.draw, extent, piece, self);
        }
        self.is_done = true;
        Some(batch)
    }
}

/// What a batch still has room for.
struct Room {
    bytes: usize,
    triangles: usize,
    is_fresh: bool,
}

/// Triangles of a draw from some first one on, and the vertices that are shaded for them.
struct Piece<'p> {
    first: usize,
    triangles: usize,
    geometry: Geometry<'p>,
    vertices: usize,
    bytes: usize,
}

/// As many triangles as there is room for; `None` if it is better to start a fresh batch. `assembled` is where those begin that are assembled for it.
fn piece<'p>(
    call: &'p (dyn DrawCall + 'p),
    extent: &DrawExtent,
    first: usize,
    room: &Room,
    assembled: usize,
    samples: Samples,
) -> Option<Piece<'p>> {
    let assembly = Assembly::of(call);
    let (instance, within) = (first / extent.triangles, first % extent.triangles);
    let base = instance * call.vertex_count();
    let is_assembled = !assembly.is_plain_list()
        || match assembly.indices {
            Indices::Sequential => false,
            Indices::U32(_) => extent.instances > 1,
            Indices::U8(_) | Indices::U16(_) => true,
        };
    let stroke_bytes = size_of::<Stroke>() + RECORDS_EACH * size_of::<RecordRow>() * call.record_rows();
    let triangle_bytes = match strokes::shape(call.state()) {
        Some(_) => strokes::numbers_each(call.state()) * (stroke_bytes + STROKE_BYTES * samples.count()),
        None if call.state().conservative != Conservative::Off => STROKE_BYTES * samples.count(),
        None => TRIANGLE_BYTES * samples.count(),
    };
    let triangle_bytes = triangle_bytes + if is_assembled { ASSEMBLED_BYTES } else { 0 };
    let vertex_bytes = SCREEN_VERTEX_BYTES + size_of::<RecordRow>() * call.record_rows();
    let bytes = |triangles: usize, vertices: usize| {
        triangles.saturating_mul(triangle_bytes).saturating_add(vertices.saturating_mul(vertex_bytes))
    };
    let shared = |triangles: usize, vertices: Range<usize>, instances: usize| {
        let source = if instances == 1 {
            Source::Range(base + vertices.start)
        } else {
            let (first, each) = (base + vertices.start, vertices.len());
            Source::Instances { first, each, stride: call.vertex_count() }
        };
        let geometry = match assembly.indices {
            Indices::Sequential if !is_assembled => Geometry::Given(Corners::Sequential, source),
            Indices::U32(indices) if !is_assembled => {
                let indices = &indices.as_chunks().0[within..within + triangles];
                Geometry::Given(Corners::Indexed { indices, first_vertex: vertices.start as u32 }, source)
            }
            _ => Geometry::Shared {
                triangles: assembled..assembled + triangles * instances,
                first_vertex: vertices.start as u32,
                vertices_each: vertices.len() as u32,
                source,
            },
        };
        let (triangles, vertices) = (triangles * instances, vertices.len() * instances);
        Piece { first, triangles, geometry, vertices, bytes: bytes(triangles, vertices) }
    };

    // With a vertex of its own for each corner.
    let alone = |triangles: usize, instances: usize| {
        let stride = call.vertex_count();
        let geometry = match assembly.indices {
            Indices::U32(indices) if assembly.is_plain_list() => {
                let indices = &indices[3 * within..3 * (within + triangles)];
                Geometry::Given(Corners::Sequential, Source::List { indices, base, stride })
            }
            _ => Geometry::Alone { triangles: assembled..assembled + triangles, base, stride },
        };
        let triangles = triangles * instances;
        Piece { first, triangles, geometry, vertices: 3 * triangles, bytes: bytes(triangles, 3 * triangles) }
    };

    if within == 0 && extent.instances > 1 {
        let is_sparse = extent.vertices.len() > 3 * extent.triangles;
        let vertices = if is_sparse { 3 * extent.triangles } else { extent.vertices.len() };
        let each = bytes(extent.triangles, vertices);
        let whole = (extent.instances - instance).min(room.triangles / extent.triangles).min(room.bytes / each);
        if whole > 0 {
            let vertices = extent.vertices.clone();
            return Some(if is_sparse {
                alone(extent.triangles, whole)
            } else {
                shared(extent.triangles, vertices, whole)
            });
        }
    }

    let left = (extent.triangles - within).min(room.triangles);
    let count_alone = left.min((room.bytes / bytes(1, 3)).max(if room.is_fresh { 16 } else { 0 }));
    let is_sequential_list = matches!(assembly.indices, Indices::Sequential) && !is_assembled;
    if is_sequential_list {
        return (count_alone > 0).then(|| shared(count_alone, 3 * within..3 * (within + count_alone), 1));
    }
    // All that is left, with all of the draw's vertices.
    if left == extent.triangles - within && bytes(left, extent.vertices.len()) <= room.bytes {
        return Some(shared(left, extent.vertices.clone(), 1));
    }
    if !room.is_fresh {
        return None;
    }
    // A stretch whose vertices stand close together in the buffer, as those of most meshes do.
    let triangles = left.min(room.bytes / bytes(1, 1));
    if triangles > count_alone {
        let (low, high) = assembly.reach(&extent.stretches, within, triangles);
        let span = low as usize..high as usize + 1;
        if bytes(triangles, span.len()) <= room.bytes {
            return Some(shared(triangles, span, 1));
        }
    }
    Some(alone(count_alone, 1))
}

impl<'p> Batch<'p> {
    fn push(
        &mut self,
        call: &(dyn DrawCall + '_),
        draw: usize,
        extent: &DrawExtent,
        piece: Piece<'p>,
        &Plan { width, height, samples, .. }: &Plan<'p>,
    ) {
        let state = call.state();
        let viewport = state.viewport.unwrap_or(Viewport::whole(width, height));
        let rect = covered_rect(&viewport, state.scissor, width, height);
        let whole = PixelRect { x0: 0, y0: 0, x1: width as i32, y1: height as i32 };
        let kind = kind(state, &call.uses(), call.outputs().kinds.len(), self.runs.len());
        let depth = DepthRule::new(state.depth.compare, &viewport);
        // Blocks of 4 x 4 pixels may reach over the border, where nothing may be counted.
        let cuts_blocks = !width.is_multiple_of(4) || !height.is_multiple_of(4);
        let rect_counts = rect != whole || (self.counts && cuts_blocks);
        let segment = Segment { kind, depth, draw: self.counts.then_some(draw), rect: rect_counts.then_some(rect) };
        if self.segments.last() != Some(&segment) {
            self.segments.push(segment);
        }
        let screen = self.screen_vertices..self.screen_vertices + piece.vertices;
        let records = self.record_rows..self.record_rows + piece.vertices * call.record_rows();
        (self.screen_vertices, self.record_rows) = (screen.end, records.end);
        if let Geometry::Shared { triangles, .. } | Geometry::Alone { triangles, .. } = &piece.geometry {
            self.assembled = triangles.end;
        }
        let shape = strokes::shape(state).map(|shape| shape.with_samples(samples));
        let numbers_each = strokes::numbers_each(state);
        let triangles = piece.triangles * numbers_each;
        let strokes = shape.map(|shape| {
            let strokes = self.strokes..self.strokes + triangles;
            let records = self.stroke_rows..self.stroke_rows + triangles * RECORDS_EACH * call.record_rows();
            (self.strokes, self.stroke_rows) = (strokes.end, records.end);
            StrokeRun { shape, strokes, records }
        });
        self.runs.push(Run {
            draw,
            first_triangle: piece.first,
            triangles,
            numbers_each,
            triangles_each: extent.triangles,
            first_number: self.triangles,
            geometry: piece.geometry,
            screen,
            records,
            projection: Projection::new(state.space, &viewport).with_depth_clamp(state.depth_clamp),
            rect,
            segment: self.segments.len() - 1,
            strokes,
        });
        self.triangles += triangles;
        self.bytes += piece.bytes;
    }

    /// The run that triangle `number` of the batch belongs to.
    #[inline(always)]
    pub(crate) fn run_of(&self, number: usize) -> usize {
        self.runs.partition_point(|run| run.first_number <= number).saturating_sub(1)
    }
}

/// How run `run` becomes pixels.
fn kind(state: &DrawState, uses: &StageUses, outputs: usize, run: usize) -> SegmentKind {
    let DepthState { compare, write } = state.depth;
    // Only what leaves its depth behind may wait: else the visibility buffer would not know the depth of what it shows.
    let leaves_depth = write || compare == Compare::Equal;
    let is_smooth = matches!(strokes::shape(state), Some(StrokeShape::Smooth { .. }));
    if is_smooth || state.stencil.is_some() || uses.decides() || state.alpha_to_coverage || !leaves_depth {
        SegmentKind::Ordered { run }
    } else if state.writes_no_color(outputs) {
        SegmentKind::DepthOnly
    } else if state.replaces_colors(outputs) {
        SegmentKind::Deferred
    } else {
        SegmentKind::Ordered { run }
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
