//! What can be wrong with draws, found before anything is drawn.

use super::draw_call::DrawCall;
use super::{Indices, Pass};
use crate::wide::dispatch;
use crate::{Error, parallel};
use fearless_simd::Level;
use std::sync::{Mutex, PoisonError};

/// What planning needs of a draw: how many triangles, and which of its vertices they name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct DrawExtent {
    pub(crate) triangles: usize,
    pub(crate) vertices: std::ops::Range<usize>,
}

/// Indices looked at by one job.
const CHUNK: usize = 1 << 18;

/// Checks all draws; with an error, the first draw's.
pub(crate) fn validate(pass: &Pass<'_>, level: Level, threads: usize) -> Result<Vec<DrawExtent>, Error> {
    let mut extents = Vec::with_capacity(pass.draws.len());
    let mut chunks = Vec::new();
    for (draw, call) in pass.draws.iter().enumerate() {
        if let Some(viewport) = call.state().viewport {
            viewport.validate().map_err(|reason| Error::Viewport { draw, reason })?;
        }
        call.state().depth_bias.validate().map_err(|field| Error::DepthBias { draw, field })?;
        let vertices = call.vertex_count();
        let (count, what) = match call.indices() {
            Indices::Sequential => (vertices, "vertices"),
            Indices::U32(indices) => (indices.len(), "indices"),
        };
        if !count.is_multiple_of(3) {
            return Err(Error::PartialTriangle { draw, count, what });
        }
        for (count, what) in [(vertices, "vertices"), (count / 3, "triangles")] {
            if u32::try_from(count).is_err() {
                return Err(Error::TooMany { draw, count, what });
            }
        }
        if let Indices::U32(indices) = call.indices() {
            chunks.extend(indices.chunks(CHUNK).map(|chunk| (draw, chunk)));
        }
        extents.push(DrawExtent { triangles: count / 3, vertices: 0..vertices });
    }
    let named = Mutex::new(vec![(u32::MAX, 0); extents.len()]);
    parallel::for_each(&mut vec![(); threads], chunks.into_iter(), |(), (draw, chunk)| {
        let (low, high) = dispatch!(level, _s => smallest_and_largest(chunk));
        let range = &mut named.lock().unwrap_or_else(PoisonError::into_inner)[draw];
        *range = (range.0.min(low), range.1.max(high));
    });
    let named = named.into_inner().unwrap_or_else(PoisonError::into_inner);
    for (draw, (extent, (low, high))) in extents.iter_mut().zip(named).enumerate() {
        let Indices::U32(indices) = pass.draws[draw].indices() else { continue };
        if indices.is_empty() {
            extent.vertices = 0..0;
        } else if (high as usize) < extent.vertices.len() {
            extent.vertices = low as usize..high as usize + 1;
        } else {
            return Err(out_of_range(draw, &*pass.draws[draw], indices));
        }
    }
    Ok(extents)
}

fn out_of_range(draw: usize, call: &(dyn DrawCall + '_), indices: &[u32]) -> Error {
    let vertices = call.vertex_count();
    let position = indices.iter().position(|&i| i as usize >= vertices).unwrap_or_default();
    Error::IndexOutOfRange { draw, index: indices[position], position, vertices }
}

/// Of a chunk of indices. A plain loop, which the compiler turns into vector code for the level that it is inlined into.
#[inline(always)]
pub(crate) fn smallest_and_largest(indices: &[u32]) -> (u32, u32) {
    let (mut low, mut high) = (u32::MAX, 0);
    for &index in indices {
        low = low.min(index);
        high = high.max(index);
    }
    (low, high)
}
