//! The level of detail: how many texels a pixel spans, as a power of two.
//!
//! Isotropic (Vulkan 1.4, 16.6.9): log2 of the longer of the two vectors by which a step of a pixel, right or down, moves over the texture, in texels of level 0.
//!
//! Anisotropic (D3D11.3, 7.18.11): a pixel's footprint is taken for a strip as long as the longer vector and as wide as its area leaves. It is covered by n = ceil(length / width)
//! lookups at equal distances along it, each for a square as wide as the strip; where n would exceed what the sampler allows, for squares of length / n.

use super::format::TextureFormat;
use super::image::{Image, Level};
use super::sampler::{Filter, MipFilter, Sampler};
use crate::lanes::Lanes;
use crate::math::{Bool, Real};

/// By how much coordinates grow from a pixel to the next, right and down.
#[derive(Clone, Copy)]
pub(super) struct Gradient<L: Lanes> {
    pub(super) dx: [Real<L>; 3],
    pub(super) dy: [Real<L>; 3],
}

/// Lookups along a line.
pub(super) struct Line<L: Lanes> {
    pub(super) lod: Real<L>,
    /// How many, 1 to 16.
    pub(super) count: Real<L>,
    /// Whether the line goes along the gradient of y.
    pub(super) is_down: Bool<L>,
}

impl Sampler {
    /// Whether it matters at all at which level of detail the texture is.
    pub(super) fn needs_lod<F: TextureFormat>(&self, image: &Image<'_, F>) -> bool {
        self.mag_filter != self.min_filter || (image.count > 1 && self.mip_filter != MipFilter::Base)
    }

    /// How many lookups may be strung along a line.
    pub(super) fn most_lookups(&self) -> u8 {
        if self.min_filter == Filter::Linear { self.anisotropy.clamp(1, 16) } else { 1 }
    }

    /// A level of detail, with its bias, in the sampler's range. NaN is the least.
    #[inline(always)]
    pub(super) fn in_range<L: Lanes>(&self, lod: Real<L>) -> Real<L> {
        (lod + self.lod_bias).max(self.lod_min).min(self.lod_max)
    }
}

impl<L: Lanes> Gradient<L> {
    /// The squares of both vectors' lengths in texels.
    #[inline(always)]
    fn squares<const AXES: usize>(&self, level: &Level) -> [Real<L>; 2] {
        let mut squares = [self.dx[0]; 2];
        let mut k = 0;
        while k < AXES {
            let (right, down) = (self.dx[k] * level.size[k], self.dy[k] * level.size[k]);
            squares[0] = if k == 0 { right * right } else { squares[0] + right * right };
            squares[1] = if k == 0 { down * down } else { squares[1] + down * down };
            k += 1;
        }
        squares
    }

    /// The isotropic level of detail.
    #[inline(always)]
    pub(super) fn lod<const AXES: usize>(&self, level: &Level) -> Real<L> {
        let [right, down] = self.squares::<AXES>(level);
        // The root of a square is half of its logarithm.
        0.5 * log2(right.max(down))
    }

    /// The anisotropic one, of a 2D texture, and where to look.
    #[inline(always)]
    pub(super) fn line(&self, level: &Level, most: u8) -> Line<L> {
        let [width, height, _] = level.size;
        let [right, down] = self.squares::<2>(level);
        let is_down = right.lt(down);
        let long = is_down.select(down, right);
        let area = ((self.dx[0] * self.dy[1] - self.dx[1] * self.dy[0]) * (width * height)).abs();
        // Of nothing by nothing 1, for NaN is below any number to `max`.
        let ratio = (long / area).max(1.0).min(f32::from(most));
        Line { lod: 0.5 * log2(long) - log2(ratio), count: ratio.ceil(), is_down }
    }
}

/// The logarithm to base 2, in f32: within 2^-19 of it as long as it is a level's, and exact for powers of two. [`Real::log2`] is right to the last bit, in twice the time.
/// The
/// coefficients are a minimax fit.
#[inline(always)]
fn log2<L: Lanes>(x: Real<L>) -> Real<L> {
    #![expect(clippy::excessive_precision, reason = "the digits that the derivation gave")]
    let (exponent, m) = x.split();
    let p = m * -0.109_949_186 + 0.186_174_84;
    let p = m * (m * (m * (m * p - 0.191_062_87) + 0.204_600_66) - 0.239_617_39) + 0.288_567_4;
    let p = m * (m * (m * p - 0.360_696_64) + 0.480_898_23) - 0.721_347_33;
    // log2(1 + m) is about 1.44 m: with 1 m apart, p and its rounding count for a third of the result only.
    x.logarithm_in_range(exponent + (m + m * (m * p + 0.442_695_05)))
}
