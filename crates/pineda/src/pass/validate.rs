//! What can be wrong with draws, found before anything is drawn.

use super::assembly::{Assembly, Row, STRETCH, Stretch, StretchSummary, Strip, stretches, summarize};
use super::draw_call::DrawCall;
use super::strokes;
use super::{Conservative, Indices, MAX_LINE_WIDTH, MAX_POINT_SIZE, Pass, PrimitiveTopology};
use crate::wide::dispatch;
use crate::{Error, parallel};
use fearless_simd::Level;
use std::sync::{Mutex, PoisonError};

/// What planning needs of a draw.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct DrawExtent {
    /// Triangles of one instance, or lines, or points.
    pub(crate) triangles: usize,
    /// Those of its vertices that indices name lie within.
    pub(crate) vertices: std::ops::Range<usize>,
    pub(crate) instances: usize,
    /// Where strips and fans are restarted, if they are.
    pub(crate) stretches: Vec<Stretch>,
}

/// Indices looked at by one job; whole [stretches](STRETCH).
const CHUNK: usize = 1 << 18;
const _: () = assert!(CHUNK.is_multiple_of(STRETCH));

/// A part of a draw's indices that one job looks at.
enum Chunk<'a> {
    U8(&'a [u8]),
    U16(&'a [u16]),
    U32(&'a [u32]),
    /// The chunk that begins at a place, with a summary to be written for each stretch.
    Restarting(Indices<'a>, Strip, usize, &'a mut [StretchSummary]),
}

/// Checks all draws; with an error, the first draw's.
pub(crate) fn validate(pass: &Pass<'_>, level: Level, threads: usize) -> Result<Vec<DrawExtent>, Error> {
    let mut extents = Vec::with_capacity(pass.draws.len());
    let mut summaries = Vec::with_capacity(pass.draws.len());
    for (draw, call) in pass.draws.iter().enumerate() {
        let extent = extent(draw, &**call)?;
        let restarts = Assembly::of(&**call).restarts;
        summaries.push(vec![StretchSummary::default(); if restarts { length(&**call).div_ceil(STRETCH) } else { 0 }]);
        extents.push(extent);
    }
    let mut chunks = Vec::new();
    for (draw, (call, summaries)) in pass.draws.iter().zip(&mut summaries).enumerate() {
        let mut add = |chunk| chunks.push((draw, chunk));
        if !summaries.is_empty() {
            let (parts, strip) = (summaries.chunks_mut(CHUNK / STRETCH).enumerate(), Strip::of(call.state().topology));
            parts.for_each(|(k, part)| add(Chunk::Restarting(call.indices(), strip, k * CHUNK, part)));
            continue;
        }
        match call.indices() {
            Indices::Sequential => {}
            Indices::U8(indices) => indices.chunks(CHUNK).for_each(|chunk| add(Chunk::U8(chunk))),
            Indices::U16(indices) => indices.chunks(CHUNK).for_each(|chunk| add(Chunk::U16(chunk))),
            Indices::U32(indices) => indices.chunks(CHUNK).for_each(|chunk| add(Chunk::U32(chunk))),
        }
    }
    let named = Mutex::new(vec![(u32::MAX, 0); extents.len()]);
    parallel::for_each(&mut vec![(); threads], chunks.into_iter(), |(), (draw, chunk)| {
        let (low, high) = match chunk {
            Chunk::U8(indices) => dispatch!(level, _s => smallest_and_largest(indices)),
            Chunk::U16(indices) => dispatch!(level, _s => smallest_and_largest(indices)),
            Chunk::U32(indices) => dispatch!(level, _s => smallest_and_largest(indices)),
            Chunk::Restarting(indices, strip, first, out) => match indices {
                Indices::Sequential => return,
                Indices::U8(indices) => summarize_all(indices, indices.len(), strip, first, out),
                Indices::U16(indices) => summarize_all(indices, indices.len(), strip, first, out),
                Indices::U32(indices) => summarize_all(indices, indices.len(), strip, first, out),
            },
        };
        let range = &mut named.lock().unwrap_or_else(PoisonError::into_inner)[draw];
        *range = (range.0.min(low), range.1.max(high));
    });
    let named = named.into_inner().unwrap_or_else(PoisonError::into_inner);
    for (draw, (extent, (low, high))) in extents.iter_mut().zip(named).enumerate() {
        let call = &*pass.draws[draw];
        if !summaries[draw].is_empty() {
            let strip = Strip::of(call.state().topology);
            (extent.stretches, extent.triangles) = stretches(&summaries[draw], length(call), strip);
            fits(draw, extent.triangles, call.state().topology.plural())?;
        }
        if matches!(call.indices(), Indices::Sequential) {
            continue;
        }
        if low > high {
            extent.vertices = 0..0;
        } else if (high as usize) < extent.vertices.len() {
            extent.vertices = low as usize..high as usize + 1;
        } else {
            return Err(out_of_range(draw, call));
        }
    }
    Ok(extents)
}

/// All that can be said of a draw without a look at its indices.
fn extent(draw: usize, call: &(dyn DrawCall + '_)) -> Result<DrawExtent, Error> {
    let state = call.state();
    if let Some(viewport) = state.viewport {
        viewport.validate().map_err(|reason| Error::Viewport { draw, reason })?;
    }
    state.depth_bias.validate().map_err(|field| Error::DepthBias { draw, field })?;
    let (vertices, instances, count) = (call.vertex_count(), call.instance_count(), length(call));
    for (field, value, least, most) in
        [("line_width", state.line_width, 1, MAX_LINE_WIDTH), ("point_size", state.point_size, 0, MAX_POINT_SIZE)]
    {
        if !(least as f32..=most as f32).contains(&value) {
            let value = value.to_string();
            return Err(Error::LineOrPointSize { draw, field, value, least, most });
        }
    }
    if state.conservative != Conservative::Off && strokes::shape(state).is_some() {
        return Err(Error::ConservativeStrokes { draw });
    }
    if state.topology.is_list() && state.primitive_restart {
        return Err(Error::RestartInList { draw });
    }
    let what = if matches!(call.indices(), Indices::Sequential) { "vertices" } else { "indices" };
    let triangles = match state.topology {
        PrimitiveTopology::TriangleList if !count.is_multiple_of(3) => {
            return Err(Error::PartialTriangle { draw, count, what });
        }
        PrimitiveTopology::LineList if !count.is_multiple_of(2) => {
            return Err(Error::PartialLine { draw, count, what });
        }
        PrimitiveTopology::TriangleList => count / 3,
        PrimitiveTopology::TriangleStrip | PrimitiveTopology::TriangleFan => count.saturating_sub(2),
        PrimitiveTopology::PointList => count,
        PrimitiveTopology::LineList => count / 2,
        PrimitiveTopology::LineStrip => count.saturating_sub(1),
        PrimitiveTopology::LineLoop => {
            if count < 2 {
                0
            } else {
                count
            }
        }
    };
    fits(draw, vertices, "vertices")?;
    fits(draw, triangles, state.topology.plural())?;
    fits(draw, instances, "instances")?;
    // They do where a size has 64 bits.
    for (each, what) in [(vertices, "vertices of all instances"), (triangles, "triangles of all instances")] {
        let count = each.saturating_mul(instances);
        if each.checked_mul(instances).is_none() {
            return Err(Error::TooMany { draw, count, what });
        }
    }
    Ok(DrawExtent { triangles, vertices: 0..vertices, instances, stretches: Vec::new() })
}

fn fits(draw: usize, count: usize, what: &'static str) -> Result<(), Error> {
    u32::try_from(count).map(drop).map_err(|_| Error::TooMany { draw, count, what })
}

/// Of the row that a draw's triangles are made from: indices, or vertices.
fn length(call: &(dyn DrawCall + '_)) -> usize {
    Assembly::of(call).length
}

fn out_of_range(draw: usize, call: &(dyn DrawCall + '_)) -> Error {
    let vertices = call.vertex_count();
    let restarts = Assembly::of(call).restarts;
    let (position, index) = match call.indices() {
        Indices::Sequential => None,
        Indices::U8(indices) => first_beyond(indices, indices.len(), vertices, restarts),
        Indices::U16(indices) => first_beyond(indices, indices.len(), vertices, restarts),
        Indices::U32(indices) => first_beyond(indices, indices.len(), vertices, restarts),
    }
    .unwrap_or_default();
    Error::IndexOutOfRange { draw, index, position, vertices }
}

/// The first index that names no vertex, and where it stands.
fn first_beyond<R: Row>(row: R, length: usize, vertices: usize, restarts: bool) -> Option<(usize, u32)> {
    let names_nothing = |&(_, index): &(usize, u32)| index as usize >= vertices && !(restarts && index == R::RESTART);
    (0..length).map(|at| (at, row.at(at))).find(names_nothing)
}

/// Of a chunk of indices. A plain loop, which the compiler turns into vector code for the level that it is inlined into.
#[inline(always)]
fn smallest_and_largest<T: Copy + Ord + Into<u32>>(indices: &[T]) -> (u32, u32) {
    let Some(&(mut low)) = indices.first() else { return (u32::MAX, 0) };
    let mut high = low;
    for &index in indices {
        low = low.min(index);
        high = high.max(index);
    }
    (low.into(), high.into())
}

/// The summaries of the stretches from `first` on, and the smallest and largest index that is no restart.
fn summarize_all<R: Row>(row: R, length: usize, strip: Strip, first: usize, out: &mut [StretchSummary]) -> (u32, u32) {
    let (mut low, mut high) = (u32::MAX, 0);
    for (k, summary) in out.iter_mut().enumerate() {
        let begin = first + k * STRETCH;
        let (own, own_low, own_high) = summarize(row, begin..length.min(begin + STRETCH), strip);
        *summary = own;
        (low, high) = (low.min(own_low), high.max(own_high));
    }
    (low, high)
}
