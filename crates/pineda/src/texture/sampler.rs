//! How a texture is looked up: filters, what lies beyond its borders, levels of detail.

use crate::pass::Compare;

/// What a coordinate beyond a texture's borders means. Coordinates run from 0 to 1 over the texture; NaN counts as 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Wrap {
    /// The texture again and again. Infinity counts as 0.
    #[default]
    Repeat,
    /// The texture again and again, every second time mirrored. Infinity counts as 0.
    Mirror,
    /// The texels at the border.
    Clamp,
    /// [`Sampler::border`]. In cube maps as [`Clamp`](Self::Clamp): they have no border.
    Border,
}

/// Which texels of a level count for a lookup.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Filter {
    /// The one that the coordinates lie in, as it is.
    Nearest,
    /// The four (in 3D eight) whose centres are around, weighted by how near they are. Weights are f32: they have more than 8 bits of fraction, all that the
    /// coordinate leaves.
    #[default]
    Linear,
}

/// Which levels of a texture count for a lookup.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum MipFilter {
    /// Level 0, always.
    Base,
    /// The nearest to the level of detail; halves up.
    Nearest,
    /// The two around, weighted: with [`Filter::Linear`] this is trilinear filtering.
    #[default]
    Linear,
}

/// How a texture is looked up: a uniform of a shader, next to the textures.
///
/// ```
/// use pineda::{Sampler, Wrap};
/// let sampler = Sampler { wrap: [Wrap::Clamp; 3], anisotropy: 16, ..Sampler::TRILINEAR };
/// ```
///
/// No value of any field is an error: what makes no sense is taken for the nearest that does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampler {
    /// What lies beyond the borders, along u, v and (in 3D) w.
    pub wrap: [Wrap; 3],
    /// Where a texel is at least as large as a pixel: where the level of detail is at most 0.
    pub mag_filter: Filter,
    /// Where texels are smaller than pixels.
    pub min_filter: Filter,
    /// Which levels count.
    pub mip_filter: MipFilter,
    /// How many lookups, 1 to 16, are strung along a pixel's longer side where the texture is seen at a grazing angle: 1 is none of that. 2D textures only. See
    /// [`Texture2d::sample`](crate::Texture2d::sample).
    pub anisotropy: u8,
    /// Is added to the level of detail.
    pub lod_bias: f32,
    /// The level of detail, bias included, is at least this.
    pub lod_min: f32,
    /// The level of detail, bias included, is at most this.
    pub lod_max: f32,
    /// What lies beyond the borders with [`Wrap::Border`]: in linear light, before channels that the format lacks are made 0 and 1.
    pub border: [f32; 4],
    /// How [`sample_compare`](crate::Texture2d::sample_compare) compares its reference (left) with a texel (right): unless changed, a point is lit if it is not farther from the light
    /// than what the shadow map holds.
    pub compare: Compare,
}

impl Sampler {
    /// The nearest texel of level 0.
    pub const NEAREST: Self = Self {
        mag_filter: Filter::Nearest,
        min_filter: Filter::Nearest,
        mip_filter: MipFilter::Base,
        ..Self::TRILINEAR
    };

    /// Four texels of the nearest level.
    pub const BILINEAR: Self = Self { mip_filter: MipFilter::Nearest, ..Self::TRILINEAR };

    /// Four texels each of two levels: what most surfaces want.
    pub const TRILINEAR: Self = Self {
        wrap: [Wrap::Repeat; 3],
        mag_filter: Filter::Linear,
        min_filter: Filter::Linear,
        mip_filter: MipFilter::Linear,
        anisotropy: 1,
        lod_bias: 0.0,
        lod_min: 0.0,
        lod_max: f32::INFINITY,
        border: [0.0; 4],
        compare: Compare::LessEqual,
    };

    /// Trilinear, with up to sixteen lookups where the texture is seen at a grazing angle: for floors, walls and roads.
    pub const ANISOTROPIC: Self = Self { anisotropy: 16, ..Self::TRILINEAR };

    /// For shadow maps: linear, clamped, level 0.
    pub const SHADOW: Self = Self { wrap: [Wrap::Clamp; 3], mip_filter: MipFilter::Base, ..Self::TRILINEAR };
}

impl Default for Sampler {
    fn default() -> Self {
        Self::TRILINEAR
    }
}
