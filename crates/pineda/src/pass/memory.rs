//! What a renderer allocates: buffers that grow, and those that stand in between flushes for what a target lacks.

use super::{Pass, Store};
use crate::target::{ColorBuffer, DepthBuffer};
use crate::{Error, Target};

/// Whether a draw tests stencil values.
pub(super) fn uses_stencil(pass: &Pass<'_>) -> bool {
    pass.draws.iter().any(|call| call.state().stencil.is_some())
}

/// The target, without the colour buffers that are not stored, and with a depth buffer of ours if it has none and there is more than one flush; the same for the stencil buffer, if that is used.
pub(super) fn with_own<'a>(
    pass: &Pass<'_>,
    target: &'a mut Target<'_>,
    depth: &'a mut [f32],
    stencil: &'a mut [u8],
    flushes: usize,
) -> Target<'a> {
    let pixels = target.width as usize * target.height as usize;
    // Nothing that is drawn depends on what a colour buffer holds, but for the buffer itself.
    let stored = |k: usize, color: &'a mut ColorBuffer<'_>| match pass.color_ops[k].store {
        Store::Keep => color.reborrow(),
        Store::Discard => ColorBuffer::None,
    };
    // Tiles with several samples are kept as a whole.
    let needs_own = flushes > 1 && target.depth.is_none() && target.samples.is_one();
    let own = needs_own.then(|| &mut depth[..pixels]);
    Target {
        width: target.width,
        height: target.height,
        samples: target.samples,
        color: stored(0, &mut target.color),
        more_colors: (1..).zip(&mut target.more_colors).map(|(k, color)| stored(k, color)).collect(),
        depth: own.map_or(target.depth.reborrow(), DepthBuffer::D32F),
        stencil: target.stencil.as_deref_mut().or(stencil.get_mut(..pixels)),
        triangle_ids: target.triangle_ids.as_deref_mut(),
        instance_ids: target.instance_ids.as_deref_mut(),
        draw_ids: target.draw_ids.as_deref_mut(),
        barycentrics: target.barycentrics.as_deref_mut(),
        hits: target.hits.as_deref_mut(),
    }
}

/// Makes a buffer hold at least so many elements.
pub(super) fn grow<T: Clone + Default>(buffer: &mut Vec<T>, length: usize, what: &'static str) -> Result<(), Error> {
    let more = length.saturating_sub(buffer.len());
    let bytes = length.saturating_mul(size_of::<T>());
    buffer.try_reserve(more).map_err(|_| Error::OutOfMemory { bytes, what })?;
    if more > 0 {
        buffer.resize(length, T::default());
    }
    Ok(())
}
