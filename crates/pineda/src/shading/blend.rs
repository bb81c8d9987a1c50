//! How a fragment's colour meets the one that is there.

use crate::pass::Blend;
use crate::target::format::Channels;
use crate::wide::{Simd, f32x16};

/// The colour to be stored: `source` over `target`, both decoded, in linear light.
#[inline(always)]
pub(crate) fn blend<S: Simd>(s: S, mode: Blend, source: Channels<S>, target: Channels<S>) -> Channels<S> {
    let through = f32x16::splat(s, 1.0) - source[3];
    let [r, g, b, a] = source;
    let source = match mode {
        Blend::Opaque => return source,
        Blend::SourceOver => [r * a, g * a, b * a, a],
        Blend::PremultipliedSourceOver => source,
    };
    let mut out = source;
    let mut k = 0;
    while k < 4 {
        out[k] = source[k] + target[k] * through;
        k += 1;
    }
    out
}
