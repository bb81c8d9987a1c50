//! Mip chains: each level half as large as the one before, rounded down, as Vulkan and D3D have it.
//!
//! A texel of the smaller level covers, along each axis, as much of the larger one as their sizes say, and is the mean of that: two texels where the size is even; where
//! it is odd, n = 2m + 1, three, of which the outer ones count for what they have in it, m - i, m and i + 1 parts of n for texel i (Guthe and Heckbert 2005, "Non-power-of-two
//! mipmapping"). No texel counts more than another: the mean of each level is that of the texture. Colours are decoded to linear light first, and not encoded
//! between levels, so that errors do not add up.
//!
//! By alpha: a colour counts by its alpha, so that what is transparent does not bleed in. Where all is transparent, colours count alike.

use super::format::{Decoded, Filterable, numbers};
use super::image::{Extent, Image, LEVELS};
use crate::Error;
use bytemuck::bytes_of;
use std::marker::PhantomData;
use std::ops::{Range, RangeInclusive};

/// Levels that are made of a few rows at a time, so that their colours, as floats, stay in the nearest caches.
const BAND_LEVELS: u32 = 4;

/// The texels of a full chain.
pub(super) fn chain<F: Filterable, const BY_ALPHA: bool>(image: &Image<'_, F>) -> Result<Vec<F::Texel>, Error> {
    let (extent, last) = (image.extent, image.extent.levels() - 1);
    let mut firsts = [0; LEVELS];
    let mut total = 0u64;
    for level in 0..=last {
        firsts[level as usize] = total as usize;
        total += extent.level(level).texels();
    }
    if total > i32::MAX as u64 {
        return Err(Error::TextureTooLarge { texels: total });
    }
    let base = &image.texels[..extent.texels() as usize];
    let mut texels = reserved::<F::Texel>(total as usize)?;
    texels.extend_from_slice(base);
    texels.resize(total as usize, base[0]);
    let (band, deepest) = band(extent, last);
    let mut rest = reserved(if deepest < last { extent.level(deepest).texels() as usize } else { 0 })?;
    let pays = !BY_ALPHA && base.len() >= Codes::<F>::WORTH;
    let codes = if pays { Codes::<F>::new(image.decoded) } else { None };
    for (k, part) in base.chunks_exact(band.texels() as usize).enumerate() {
        let texel = |i: usize| numbers::<F>(part[i], image.decoded);
        let rows = |rows: [Range<usize>; 2], out: &mut Vec<_>| match &codes {
            Some(codes) => codes.halve_rows(rows.map(|row| &part[row]), out),
            None => halve_rows(rows, texel, out),
        };
        let colors = halvings::<BY_ALPHA>(band, 1..=deepest, texel, rows, |level, colors| {
            store::<F>(colors, &mut texels[firsts[level as usize] + k * colors.len()..]);
        })?;
        if deepest < last {
            rest.extend_from_slice(&colors);
        }
    }
    if deepest < last {
        let texel = |i: usize| rest[i];
        let rows = |rows: [Range<usize>; 2], out: &mut Vec<_>| halve_rows(rows, texel, out);
        halvings::<BY_ALPHA>(extent.level(deepest), deepest + 1..=last, texel, rows, |level, colors| {
            store::<F>(colors, &mut texels[firsts[level as usize]..]);
        })?;
    }
    Ok(texels)
}

/// What levels are made of at a time, and how many: rows that become one row, and no more. All at once where the height is odd, or slices become fewer.
fn band(extent: Extent, last: u32) -> (Extent, u32) {
    match extent.height.trailing_zeros().min(BAND_LEVELS) {
        _ if extent.is_volume => (extent, last),
        0 => (extent, last),
        levels => (Extent { height: 1 << levels, slices: 1, ..extent }, levels),
    }
}

/// Makes levels from the colours of the one before, each of which goes to `store`. The result is the last. `rows` makes a row of the first of them from two of even length.
fn halvings<const BY_ALPHA: bool>(
    mut from: Extent,
    levels: RangeInclusive<u32>,
    texel: impl Fn(usize) -> [f32; 4] + Copy,
    rows: impl Fn([Range<usize>; 2], &mut Vec<[f32; 4]>) + Copy,
    mut store: impl FnMut(u32, &[[f32; 4]]),
) -> Result<Vec<[f32; 4]>, Error> {
    let mut larger: Vec<[f32; 4]> = Vec::new();
    for level in levels.clone() {
        let to = from.level(1);
        let mut smaller = reserved::<[f32; 4]>(to.texels() as usize)?;
        if level == *levels.start() {
            halve::<BY_ALPHA>(from, to, &mut smaller, texel, rows);
        } else {
            let texel = |i: usize| larger[i];
            halve::<BY_ALPHA>(from, to, &mut smaller, texel, |rows, out| halve_rows(rows, texel, out));
        }
        store(level, &smaller);
        (larger, from) = (smaller, to);
    }
    Ok(larger)
}

fn store<F: Filterable>(colors: &[[f32; 4]], texels: &mut [F::Texel]) {
    for (texel, &color) in texels.iter_mut().zip(colors) {
        *texel = F::nearest(color);
    }
}

fn reserved<T>(length: usize) -> Result<Vec<T>, Error> {
    let mut texels = Vec::new();
    let error = |_| Error::OutOfMemory { bytes: length.saturating_mul(size_of::<T>()), what: "a texture's levels" };
    texels.try_reserve_exact(length).map_err(error)?;
    Ok(texels)
}

/// The texels of the larger level along one axis that texel `i` of the smaller one covers: the first, and how much each counts.
fn covered(from: u32, to: u32, i: u32) -> (u32, [f64; 3], usize) {
    let n = f64::from(from);
    if from == to {
        (i, [1.0, 0.0, 0.0], 1)
    } else if from.is_multiple_of(2) {
        (2 * i, [0.5, 0.5, 0.0], 2)
    } else {
        (2 * i, [f64::from(to - i) / n, f64::from(to) / n, f64::from(i + 1) / n], 3)
    }
}

fn halve<const BY_ALPHA: bool>(
    from: Extent,
    to: Extent,
    out: &mut Vec<[f32; 4]>,
    texel: impl Fn(usize) -> [f32; 4] + Copy,
    rows: impl Fn([Range<usize>; 2], &mut Vec<[f32; 4]>),
) {
    let (width, height) = (from.width as usize, from.height as usize);
    let columns: Vec<_> = (0..to.width).map(|x| covered(from.width, to.width, x)).collect();
    for z in 0..to.slices {
        let (first_z, weights_z, count_z) = covered(from.slices, to.slices, z);
        for y in 0..to.height {
            let (first_y, weights_y, count_y) = covered(from.height, to.height, y);
            if !BY_ALPHA && count_z == 1 && count_y == 2 && from.width.is_multiple_of(2) {
                let first = (first_z as usize * height + first_y as usize) * width;
                rows([first..first + width, first + width..first + 2 * width], out);
                continue;
            }
            for &(first_x, weights_x, count_x) in &columns {
                let (mut plain, mut by_alpha) = ([0.0; 4], [0.0; 3]);
                for (dz, &weight_z) in weights_z[..count_z].iter().enumerate() {
                    for (dy, &weight_y) in weights_y[..count_y].iter().enumerate() {
                        let row = ((first_z as usize + dz) * height + first_y as usize + dy) * width + first_x as usize;
                        for (dx, &weight_x) in weights_x[..count_x].iter().enumerate() {
                            let (color, weight) = (texel(row + dx), weight_z * weight_y * weight_x);
                            for (sum, channel) in plain.iter_mut().zip(color) {
                                *sum += weight * f64::from(channel);
                            }
                            if BY_ALPHA {
                                for (sum, channel) in by_alpha.iter_mut().zip(color) {
                                    *sum += weight * f64::from(color[3]) * f64::from(channel);
                                }
                            }
                        }
                    }
                }
                let alpha = plain[3];
                if BY_ALPHA && alpha > 0.0 {
                    plain[..3].copy_from_slice(&[by_alpha[0] / alpha, by_alpha[1] / alpha, by_alpha[2] / alpha]);
                }
                out.push(rounded(plain));
            }
        }
    }
}

/// Of two rows, what most textures have everywhere: means of two by two texels. The same sums in the same order as above, of which the compiler knows the length here.
fn halve_rows([upper, lower]: [Range<usize>; 2], texel: impl Fn(usize) -> [f32; 4] + Copy, out: &mut Vec<[f32; 4]>) {
    out.extend((0..upper.len() / 2).map(|x| {
        let (upper, lower) = (upper.start + 2 * x, lower.start + 2 * x);
        let [a, b, c, d] = [texel(upper), texel(upper + 1), texel(lower), texel(lower + 1)];
        let mean = |k: usize| {
            let part = |color: [f32; 4]| 0.25 * f64::from(color[k]);
            (((0.0 + part(a)) + part(b)) + part(c)) + part(d)
        };
        rounded([mean(0), mean(1), mean(2), mean(3)])
    }));
}

/// A quarter of what each code of a channel of 8 bits stands for: the first level of such formats is a sum of four looked up.
struct Codes<F> {
    quarters: Box<[[f64; 256]; 4]>,
    format: PhantomData<F>,
}

impl<F: Filterable> Codes<F> {
    /// Texels of level 0 from which on the table pays.
    const WORTH: usize = 4096;

    /// `None` for formats of other channels.
    fn new(decoded: &Decoded) -> Option<Self> {
        if size_of::<F::Channel>() != 1 {
            return None;
        }
        let mut quarters = Box::new([[0.0; 256]; 4]);
        for code in 0..=255u8 {
            let color = numbers::<F>(*bytemuck::from_bytes(&[code; 4][..F::CHANNELS]), decoded);
            (0..4).for_each(|k| quarters[k][usize::from(code)] = 0.25 * f64::from(color[k]));
        }
        Some(Self { quarters, format: PhantomData })
    }

    /// As [`halve_rows`]. (No code stands for -0, so that there is no difference whether a sum begins with 0.)
    fn halve_rows(&self, [upper, lower]: [&[F::Texel]; 2], out: &mut Vec<[f32; 4]>) {
        let (upper, lower) = (upper.as_chunks::<2>().0, lower.as_chunks::<2>().0);
        out.extend((0..upper.len().min(lower.len())).map(|x| {
            let ([a, b], [c, d]) = (&upper[x], &lower[x]);
            let mean = |k: usize| {
                // A channel that the format lacks is the same for all codes.
                let quarter = |texel: &F::Texel| self.quarters[k][usize::from(bytes_of(texel)[k % F::CHANNELS])];
                ((quarter(a) + quarter(b)) + quarter(c)) + quarter(d)
            };
            rounded([mean(0), mean(1), mean(2), mean(3)])
        }));
    }
}

#[inline(always)]
fn rounded([r, g, b, a]: [f64; 4]) -> [f32; 4] {
    [r as f32, g as f32, b as f32, a as f32]
}

#[cfg(test)]
mod tests {
    use super::{Codes, Filterable, numbers};
    use crate::texture::{R32F, Rgba8, Rgba8Srgb, Rgba32F, Texture2d, Texture2dArray, Texture3d};

    fn floats(texture: &Texture2d<'_, R32F>, level: u32) -> Vec<f32> {
        texture.texels(level).to_vec()
    }

    #[test]
    fn the_mean_of_each_level_is_the_textures() {
        for (width, height) in [(7, 5), (8, 8), (1, 13), (31, 2), (6, 9)] {
            let texels: Vec<f32> = (0..width * height).map(|k: u32| f32::from(k.wrapping_mul(40_503) as u8)).collect();
            let mean = |texels: &[f32]| texels.iter().map(|&x| f64::from(x)).sum::<f64>() / texels.len() as f64;
            let texture = Texture2d::<R32F>::new(width, height, &texels).unwrap().with_mips().unwrap();
            assert_eq!(texture.levels(), 32 - width.max(height).leading_zeros());
            assert_eq!(texture.size(texture.levels() - 1), [1, 1]);
            for level in 0..texture.levels() {
                let difference = (mean(&floats(&texture, level)) - mean(&texels)).abs();
                assert!(difference < 1e-4, "{width} x {height}, level {level}: {difference}");
            }
        }
    }

    #[test]
    fn odd_sizes_weigh_what_a_texel_has_in_the_smaller_one() {
        let texture = Texture2d::<R32F>::new(5, 1, &[1.0, 0.0, 0.0, 0.0, 0.0]).unwrap().with_mips().unwrap();
        assert_eq!(floats(&texture, 1), [2.0 / 5.0, 0.0]);
        let texture = Texture2d::<R32F>::new(5, 1, &[0.0, 0.0, 1.0, 0.0, 0.0]).unwrap().with_mips().unwrap();
        assert_eq!(floats(&texture, 1), [1.0 / 5.0, 1.0 / 5.0]);
    }

    #[test]
    fn even_sizes_are_summed_as_others_are() {
        // Rows of an even width are halved by a loop of their own.
        let texels: Vec<f32> = (0..8 * 6).map(|k: u32| 1.0 / (1.0 + k.wrapping_mul(40_503) as f32)).collect();
        let texture = Texture2d::<R32F>::new(8, 6, &texels).unwrap().with_mips().unwrap();
        let expected: Vec<f32> = (0..4 * 3)
            .map(|k| {
                let first = (k / 4) * 16 + (k % 4) * 2;
                let parts = [0, 1, 8, 9].map(|next| 0.25 * f64::from(texels[first + next]));
                parts.iter().fold(0.0, |sum, part| sum + part) as f32
            })
            .collect();
        assert_eq!(floats(&texture, 1), expected);
    }

    #[test]
    fn bands_of_rows_give_the_means_of_all() {
        // Heights that are halved in bands, and then as wholes; small integers, whose sums are exact.
        for (width, height, layers) in [(8u32, 64u32, 1u32), (4, 32, 3), (64, 64, 2), (2, 16, 1), (1, 32, 1)] {
            let texels: Vec<f32> =
                (0..width * height * layers).map(|k| f32::from(k.wrapping_mul(40_503) as u8)).collect();
            let texture = Texture2dArray::<R32F>::new(width, height, layers, &texels).unwrap().with_mips().unwrap();
            for level in 0..texture.levels() {
                let [across, down] = [width, height].map(|size| size >> level.min(size.ilog2()));
                let [wide, high] = [width / across, height / down];
                let expected = (0..across * down * layers).map(|k| {
                    let (x, y) = (k % across * wide, k / across * high);
                    let sum: f32 =
                        (0..wide * high).map(|i| texels[((y + i / wide) * width + x + i % wide) as usize]).sum();
                    sum / (wide * high) as f32
                });
                assert!(expected.eq(texture.texels(level).iter().copied()), "{width} x {height}, level {level}");
            }
        }
    }

    #[test]
    fn codes_looked_up_are_halved_as_numbers_are() {
        fn check<F: Filterable<Texel = [u8; 4]>>(width: u32, height: u32) {
            let codes: Vec<[u8; 4]> =
                (0..width * height).map(|k| k.wrapping_mul(2_654_435_761).to_le_bytes()).collect();
            assert!(codes.len() >= Codes::<F>::WORTH);
            let decoded: Vec<_> =
                codes.iter().map(|&texel| numbers::<F>(texel, crate::texture::format::decoded::<F>())).collect();
            let looked_up = Texture2d::<F>::new(width, height, codes).unwrap().with_mips().unwrap();
            let computed = Texture2d::<Rgba32F>::new(width, height, decoded).unwrap().with_mips().unwrap();
            for level in 1..looked_up.levels() {
                let expected: Vec<_> = computed.texels(level).iter().map(|&color| F::nearest(color)).collect();
                assert_eq!(looked_up.texels(level), expected, "level {level}");
            }
        }
        check::<Rgba8>(64, 64);
        check::<Rgba8Srgb>(64, 96);
        check::<Rgba8Srgb>(62, 70);
    }

    #[test]
    fn colors_are_decoded_before_they_are_mixed() {
        let checks = [[0, 0, 0, 255], [255, 255, 255, 255]];
        let texture = Texture2d::<Rgba8Srgb>::new(2, 1, &checks).unwrap().with_mips().unwrap();
        assert_eq!(texture.texels(1), [[188, 188, 188, 255]], "half of the light");
        let texture = Texture2d::<Rgba8>::new(2, 1, &checks).unwrap().with_mips().unwrap();
        assert_eq!(texture.texels(1), [[128, 128, 128, 255]], "half of the number");
    }

    #[test]
    fn by_alpha_what_is_transparent_does_not_bleed_in() {
        let leaf = [[0, 200, 0, 255], [255, 0, 255, 0]];
        let texture = Texture2d::<Rgba8>::new(2, 1, &leaf).unwrap();
        assert_eq!(texture.with_alpha_weighted_mips().unwrap().texels(1), [[0, 200, 0, 128]]);
        assert_eq!(texture.with_mips().unwrap().texels(1), [[128, 100, 128, 128]]);
        let air = Texture2d::<Rgba8>::new(2, 1, &[[10, 0, 0, 0], [20, 0, 0, 0]]).unwrap();
        assert_eq!(air.with_alpha_weighted_mips().unwrap().texels(1), [[15, 0, 0, 0]]);
    }

    #[test]
    fn depth_is_halved_and_layers_are_not() {
        let texels: Vec<f32> = (0..8).map(|k| k as f32).collect();
        let volume = Texture3d::<R32F>::new(2, 2, 2, &texels).unwrap().with_mips().unwrap();
        assert_eq!((volume.levels(), volume.texels(1)), (2, &[3.5][..]));
    }
}
