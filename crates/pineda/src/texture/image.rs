//! What a texture holds, whatever its dimension: levels, each a stack of slices, each rows of texels; all of them in one slice of memory, so that lanes at different
//! levels load alike.

use super::format::{self, Decoded, Filterable, TextureFormat};
use super::mipmap;
use crate::Error;
use crate::lanes::Lanes;
use crate::math::Uint;
use std::borrow::Cow;

/// The largest width and height of a texture, in texels.
pub const MAX_TEXTURE_SIZE: u32 = 16_384;

/// The largest width, height and depth of a 3D texture, in texels.
pub const MAX_TEXTURE_SIZE_3D: u32 = 2_048;

/// The most layers of an array of textures.
pub const MAX_TEXTURE_LAYERS: u32 = 2_048;

/// A full chain of the largest size has 15 levels. A power of two: any number is brought in range by a mask.
pub(super) const LEVELS: usize = 16;

/// Width, height, and slices: layers, the faces of cubes, or depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Extent {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) slices: u32,
    /// Whether slices are depth, and become fewer from level to level.
    pub(super) is_volume: bool,
}

impl Extent {
    /// The extent of a level.
    pub(super) fn level(self, level: u32) -> Self {
        let smaller = |size: u32| (size >> level.min(31)).max(1);
        let slices = if self.is_volume { smaller(self.slices) } else { self.slices };
        Self { width: smaller(self.width), height: smaller(self.height), slices, ..self }
    }

    pub(super) fn texels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height) * u64::from(self.slices)
    }

    /// The levels of a full chain, down to a single texel.
    pub(super) fn levels(self) -> u32 {
        let depth = if self.is_volume { self.slices } else { 1 };
        32 - self.width.max(self.height).max(depth).leading_zeros()
    }
}

/// A level, as lookups want it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Level {
    /// Width, height and slices.
    pub(super) size: [f32; 3],
    /// Texels from a row to the next, from a slice to the next, and before the first.
    pub(super) row: i32,
    pub(super) slice: i32,
    pub(super) first: i32,
}

/// The texels and levels of a texture.
#[derive(Clone)]
pub(super) struct Image<'a, F: TextureFormat> {
    pub(super) texels: Cow<'a, [F::Texel]>,
    pub(super) levels: [Level; LEVELS],
    pub(super) count: u32,
    pub(super) extent: Extent,
    pub(super) decoded: &'static Decoded,
}

impl<F: TextureFormat> core::fmt::Debug for Image<'_, F> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Extent { width, height, slices, .. } = self.extent;
        write!(f, "{} {width} x {height} x {slices}, {} levels", core::any::type_name::<F>(), self.count)
    }
}

impl<'a, F: TextureFormat> Image<'a, F> {
    /// `texels` hold `count` levels, from the largest on, each slice by slice from the first on, each of those row by row from the top.
    pub(super) fn new(extent: Extent, count: u32, texels: Cow<'a, [F::Texel]>) -> Result<Self, Error> {
        let Extent { width, height, slices, is_volume } = extent;
        let (most, most_slices) =
            if is_volume { (MAX_TEXTURE_SIZE_3D, MAX_TEXTURE_SIZE_3D) } else { (MAX_TEXTURE_SIZE, MAX_TEXTURE_LAYERS) };
        let in_range = |size: u32, most: u32| (1..=most).contains(&size);
        if !in_range(width, most) || !in_range(height, most) || !in_range(slices, most_slices) {
            return Err(Error::TextureSize { width, height, slices, most, most_slices });
        }
        if !in_range(count, extent.levels()) {
            return Err(Error::TextureLevels { levels: count, most: extent.levels(), width, height });
        }
        let expected: u64 = (0..count).map(|level| extent.level(level).texels()).sum();
        // Texels are numbered by i32, in lanes.
        if expected > i32::MAX as u64 {
            return Err(Error::TextureTooLarge { texels: expected });
        }
        if texels.len() as u64 != expected {
            return Err(Error::TextureLength { length: texels.len(), expected: expected as usize });
        }
        let mut levels = [Level::default(); LEVELS];
        let mut first = 0;
        for (k, level) in (0..count).zip(&mut levels) {
            let Extent { width, height, slices, .. } = extent.level(k);
            let (row, slice) = (width as i32, (width * height) as i32);
            *level = Level { size: [width, height, slices].map(|size| size as f32), row, slice, first };
            first += extent.level(k).texels() as i32;
        }
        Ok(Self { texels, levels, count, extent, decoded: format::decoded::<F>() })
    }

    /// Of a slice of channels, such as the crate `image` gives.
    pub(super) fn of_channels(extent: Extent, channels: &'a [F::Channel]) -> Result<Self, Error> {
        let texels = bytemuck::try_cast_slice(channels);
        let Ok(texels) = texels else {
            let expected = extent.texels().saturating_mul(F::CHANNELS as u64) as usize;
            return Err(Error::TextureLength { length: channels.len(), expected });
        };
        Self::new(extent, 1, Cow::Borrowed(texels))
    }

    /// The texels of lanes, as words. Each index must be that of a texel.
    ///
    /// So no index exceeds what it is limited to here. But the compiler knows then, too, and it limits all lanes at once: instead of a comparison and a branch a lane, after which indices
    /// waited in memory until the last one was judged.
    #[inline(always)]
    pub(super) fn gather<L: Lanes>(&self, lanes: L, index: L::I) -> [L::I; 4] {
        let zero = lanes.int(0);
        let texels: &[F::Texel] = &self.texels;
        let Some(last) = texels.len().checked_sub(1) else { return [zero; 4] };
        let last = u32::try_from(last).unwrap_or(u32::MAX);
        let mut at = [0; 16];
        L::store_int(index, &mut at);
        let mut words = [[0; 16]; 4];
        let mut k = 0;
        while k < L::N {
            let texel = F::words(texels[at[k].cast_unsigned().min(last) as usize], self.decoded);
            let mut w = 0;
            while w < F::WORDS {
                words[w][k] = texel[w].cast_signed();
                w += 1;
            }
            k += 1;
        }
        [lanes.load_int(&words[0]), lanes.load_int(&words[1]), lanes.load_int(&words[2]), lanes.load_int(&words[3])]
    }

    /// The same of two neighbours each: the texel that an index names, and the next one.
    #[inline(always)]
    pub(super) fn gather_pairs<L: Lanes>(&self, lanes: L, index: L::I) -> [[L::I; 4]; 2] {
        let zero = lanes.int(0);
        let mut both = [[zero; 4]; 2];
        let texels: &[F::Texel] = &self.texels;
        let Some(last) = texels.len().checked_sub(2) else { return both };
        let last = u32::try_from(last).unwrap_or(u32::MAX);
        let mut at = [0; 16];
        L::store_int(index, &mut at);
        if F::IS_NARROW {
            let mut words = [0; 16];
            let mut k = 0;
            while k < L::N {
                let [a, b] = self.pair(texels, at[k].cast_unsigned().min(last));
                words[k] = (a[0] | b[0] << 16).cast_signed();
                k += 1;
            }
            let words = Uint::<L>(lanes.load_int(&words));
            (both[0][0], both[1][0]) = ((words & 0xffff).0, (words >> 16).0);
            return both;
        }
        let mut pairs = [[0u64; 16]; 4];
        let mut k = 0;
        while k < L::N {
            let [a, b] = self.pair(texels, at[k].cast_unsigned().min(last));
            let mut w = 0;
            while w < F::WORDS {
                pairs[w][k] = u64::from(a[w]) | u64::from(b[w]) << 32;
                w += 1;
            }
            k += 1;
        }
        let mut w = 0;
        while w < F::WORDS {
            (both[0][w], both[1][w]) = lanes.halves_of_pairs(&pairs[w]);
            w += 1;
        }
        both
    }

    /// A texel and the next one.
    #[inline(always)]
    fn pair(&self, texels: &[F::Texel], first: u32) -> [[u32; 4]; 2] {
        let pair = &texels[first as usize..first as usize + 2];
        [F::words(pair[0], self.decoded), F::words(pair[1], self.decoded)]
    }
}

impl<F: Filterable> Image<'_, F> {
    /// The same, with all levels made from level 0; see [`mipmap`].
    pub(super) fn with_mips<const BY_ALPHA: bool>(&self) -> Result<Image<'static, F>, Error> {
        let texels = mipmap::chain::<F, BY_ALPHA>(self)?;
        Image::new(self.extent, self.extent.levels(), Cow::Owned(texels))
    }
}
