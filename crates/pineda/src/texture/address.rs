//! From coordinates to texels, along one axis.
//!
//! A coordinate s is brought to 0 to 1 first, by the sampler's wrap mode, where it is small enough to lose nothing; times the size it is x, in texels, and texel i covers
//! i to i + 1. Linear filtering takes the two texels whose centres are around x: floor(x - 1/2) and the next one, the second weighted by what the floor left (Vulkan
//! 1.4, 16.6, "Image Operation Steps"; D3D11.3, 7.18.8). Of these, only the first can be one too low and only the second one too high.

use super::sampler::Wrap;
use crate::lanes::Lanes;
use crate::math::{Bool, Int, Real};

/// Two neighbouring texels along an axis.
#[derive(Clone, Copy)]
pub(super) struct Pair<L: Lanes> {
    pub(super) low: Real<L>,
    pub(super) high: Real<L>,
    /// How much the second counts, from 0 to below 1.
    pub(super) part: Real<L>,
}

/// What lies beyond the borders of a level.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Beyond {
    Wrap(Wrap),
    /// Texels of other faces of a cube: numbered -1 and `size`.
    Faces,
}

/// x, in texels: from 0 to `size`; with borders, up to a texel beyond.
#[inline(always)]
fn to_texels<L: Lanes>(beyond: Beyond, s: Real<L>, size: Real<L>) -> Real<L> {
    // `max` and `min` make 0 of NaN. Differences are exact, but that of a tiny negative number is 1.
    match beyond {
        Beyond::Wrap(Wrap::Repeat) => (s - s.floor()).clamp(0.0, 1.0) * size,
        Beyond::Wrap(Wrap::Mirror) => {
            let twice = (s - 2.0 * (0.5 * s).floor()).clamp(0.0, 2.0);
            twice.min(2.0 - twice) * size
        }
        Beyond::Wrap(Wrap::Clamp) | Beyond::Faces => s.clamp(0.0, 1.0) * size,
        Beyond::Wrap(Wrap::Border) => s.ne(s).select(0.0, s * size).max(-1.0).min(size + 1.0),
    }
}

/// The texel that a coordinate lies in. With a border it may be beyond: -1 or `size`.
#[inline(always)]
pub(super) fn nearest<L: Lanes>(beyond: Beyond, s: Real<L>, size: Real<L>) -> Real<L> {
    let texel = to_texels(beyond, s, size).floor();
    if beyond == Beyond::Wrap(Wrap::Border) { texel.min(size) } else { texel.min(size - 1.0) }
}

/// The texels around a coordinate. With a border, or other faces, they may be beyond.
#[inline(always)]
pub(super) fn linear<L: Lanes>(beyond: Beyond, s: Real<L>, size: Real<L>) -> Pair<L> {
    let x = to_texels(beyond, s, size) - 0.5;
    let low = x.floor();
    let (part, high) = (x - low, low + 1.0);
    match beyond {
        Beyond::Wrap(Wrap::Repeat) => {
            Pair { low: low.lt(0.0).select(size - 1.0, low), high: high.ge(size).select(0.0, high), part }
        }
        Beyond::Wrap(Wrap::Mirror | Wrap::Clamp) => Pair { low: low.max(0.0), high: high.min(size - 1.0), part },
        Beyond::Wrap(Wrap::Border) | Beyond::Faces => Pair { low, high, part },
    }
}

/// Whether a texel is beyond the border.
#[inline(always)]
pub(super) fn is_beyond<L: Lanes>(texel: Real<L>, size: Real<L>) -> Bool<L> {
    texel.lt(0.0) | texel.ge(size)
}

/// A whole number below 2^22 in size as an integer: the low bits of its sum with 1.5 * 2^23.
#[inline(always)]
pub(super) fn whole<L: Lanes>(x: Real<L>) -> Int<L> {
    const ROUND: f32 = 12_582_912.0;
    Int(L::f_bits((x + ROUND).0)) - ROUND.to_bits().cast_signed()
}
