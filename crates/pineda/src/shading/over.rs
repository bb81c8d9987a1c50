//! Ordered packets "over" a target of 8-bit codes: what most programs that blend do.
//!
//! Of `c = s a + d (1 - a)` and `a' = a + a_d (1 - a)`, everything is computed and rounded as [`blend`] says. Two things are known beforehand:
//!
//! - Where sources lie in 0 to 1, they need not be clamped; and the results never: with t the f32 nearest to 1 - a, `a + t` is at most 1 + 2^-25, which rounds to 1, and neither product
//!   exceeds its factor.
//! - What is opaque stays opaque: `a + t` is at least 1 - 2^-25, too, which rounds to 1 as well.

use super::blend::blend;
use super::shade::{Shading, channels, keep};
use crate::pass::{Blend, ColorMask, ColorState};
use crate::target::format::{ColorFormat, from_bytes, from_unorm8, to_bytes, unorm8_code};
use crate::wide::{Simd, f32x16, mask32x16, u32x16};

const ONE: u32 = 1.0f32.to_bits();
const OPAQUE: u32 = 0xff00_0000;

/// Whether a draw's colours go over those of such a target, all channels of them.
pub(crate) fn is_over(state: &ColorState, format: ColorFormat) -> bool {
    let Blend { color, alpha, .. } = Blend::ALPHA;
    let blends = state.blend.color == color && state.blend.alpha == alpha;
    blends && state.mask == ColorMask::ALL && format == ColorFormat::Unorm8(4)
}

/// Brings the colours of a batch into the tile, where there is nothing else to be done with them.
#[inline(always)]
pub(crate) fn merge_over<S: Simd>(s: S, shading: &mut Shading<'_>) {
    let writes_depth = shading.call.state().depth.write;
    let mut i = 0;
    while i < shading.batch.len() {
        let packet = &shading.batch.packets()[i];
        let block = packet.block as usize;
        let alive = mask32x16::from_bitmask(s, u64::from(packet.alive));
        keep(s, shading.tile, writes_depth, block, alive, &packet.depth, &packet.ids);
        let words = &mut shading.color.words[block];
        let there = u32x16::simd_from(s, *words);
        let source = channels(s, &packet.color);
        // As integers, everything below 0 and NaN are larger than 1.
        let bits: [u32x16<S>; 4] = [source[0].bitcast(), source[1].bitcast(), source[2].bitcast(), source[3].bitcast()];
        let is_within = !bits[0].max(bits[1]).max(bits[2].max(bits[3])).simd_gt(ONE).any_true();
        let is_opaque = !there.simd_lt(OPAQUE).any_true();
        let new = if is_within & is_opaque {
            let [r, g, b, a] = source;
            (over(s, r, a, there, 0) | over(s, g, a, there, 8)) | (over(s, b, a, there, 16) | OPAQUE)
        } else {
            to_bytes(s, blend(s, &Blend::ALPHA, true, source, source, from_bytes(s, there)))
        };
        *words = alive.select(new, there).into();
        i += 1;
    }
}

/// The code of a channel of an opaque target, `shift` bits up as it lies there, after `channel` of that alpha went over it. One by one, so that no channel waits in memory for the others.
#[inline(always)]
fn over<S: Simd>(s: S, channel: f32x16<S>, alpha: f32x16<S>, there: u32x16<S>, shift: u32) -> u32x16<S> {
    let free = f32x16::splat(s, 1.0) - alpha;
    unorm8_code(channel * alpha + from_unorm8(s, there >> shift) * free) << shift
}
