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
use crate::target::format::{ColorFormat, from_bytes, to_bytes};
use crate::wide::{Simd, mask32x16, u32x16};

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
        let [r, g, b, a] = source;
        let (r, g, b, a): (u32x16<S>, u32x16<S>, u32x16<S>, u32x16<S>) =
            (r.bitcast(), g.bitcast(), b.bitcast(), a.bitcast());
        let is_within = !r.max(g).max(b.max(a)).simd_gt(ONE).any_true();
        let is_opaque = !there.simd_lt(OPAQUE).any_true();
        let new = if is_within & is_opaque {
            let [r, g, b, _] = blend(s, &Blend::ALPHA, false, source, source, from_bytes(s, there));
            to_bytes(s, [r, g, b]) | OPAQUE
        } else {
            to_bytes(s, blend(s, &Blend::ALPHA, true, source, source, from_bytes(s, there)))
        };
        *words = alive.select(new, there).into();
        i += 1;
    }
}
