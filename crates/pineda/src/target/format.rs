//! Colours in a tile: stored as the target stores them, so that a pass split in two gives the same bits.

use super::srgb::SRGB;
use super::{ColorBuffer, Target};
use crate::pass::ColorMask;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};

/// A format of [`ColorBuffer`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ColorFormat {
    None,
    Rgba8,
    Rgba8Srgb,
    Rgba32F,
}

impl ColorFormat {
    pub(crate) fn of(target: &Target<'_>) -> Self {
        match target.color {
            ColorBuffer::None => Self::None,
            ColorBuffer::Rgba8(_) => Self::Rgba8,
            ColorBuffer::Rgba8Srgb(_) => Self::Rgba8Srgb,
            ColorBuffer::Rgba32F(_) => Self::Rgba32F,
        }
    }

    /// Whether it holds numbers from 0 to 1 and no others.
    pub(crate) fn is_unorm(self) -> bool {
        matches!(self, Self::Rgba8 | Self::Rgba8Srgb)
    }

    /// A colour's codes in an 8-bit format, red in the low byte.
    pub(crate) fn packed(self, [r, g, b, a]: [f32; 4]) -> u32 {
        let code = |c: f32| if self == Self::Rgba8Srgb { SRGB.encode(c) } else { unorm8(c) };
        u32::from_le_bytes([code(r), code(g), code(b), unorm8(a)])
    }
}

/// The colours of a tile's blocks, without a border.
#[derive(Debug)]
pub(crate) struct TileColor {
    pub(crate) format: ColorFormat,
    /// Of the 8-bit formats: red in the low byte.
    pub(crate) packed: Vec<[u32; 16]>,
    /// Of Rgba32F: channel by channel.
    pub(crate) float: Vec<[[f32; 16]; 4]>,
}

/// Red, green, blue and alpha in the lanes.
pub(crate) type Channels<S> = [f32x16<S>; 4];

impl TileColor {
    pub(crate) fn new(format: ColorFormat) -> Self {
        Self { format, packed: Vec::new(), float: Vec::new() }
    }

    /// Gives `blocks` blocks one colour.
    pub(crate) fn clear(&mut self, blocks: usize, color: [f32; 4]) {
        self.packed.clear();
        self.float.clear();
        match self.format {
            ColorFormat::None => {}
            ColorFormat::Rgba8 | ColorFormat::Rgba8Srgb => {
                self.packed.resize(blocks, [self.format.packed(color); 16]);
            }
            ColorFormat::Rgba32F => self.float.resize(blocks, color.map(|c| [c; 16])),
        }
    }

    /// The colours of a block, decoded.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, s: S, block: usize) -> Channels<S> {
        match self.format {
            ColorFormat::None => [f32x16::splat(s, 0.0); 4],
            ColorFormat::Rgba8 => {
                let p = u32x16::simd_from(s, self.packed[block]);
                [from_unorm8(s, p), from_unorm8(s, p >> 8), from_unorm8(s, p >> 16), from_unorm8(s, p >> 24)]
            }
            ColorFormat::Rgba8Srgb => {
                let words = &self.packed[block];
                let mut decoded = [[0.0; 16]; 3];
                let srgb = &*SRGB;
                let mut k = 0;
                while k < 16 {
                    let [r, g, b, _] = words[k].to_le_bytes();
                    decoded[0][k] = srgb.decode(r);
                    decoded[1][k] = srgb.decode(g);
                    decoded[2][k] = srgb.decode(b);
                    k += 1;
                }
                let alpha = from_unorm8(s, u32x16::simd_from(s, *words) >> 24);
                [
                    f32x16::simd_from(s, decoded[0]),
                    f32x16::simd_from(s, decoded[1]),
                    f32x16::simd_from(s, decoded[2]),
                    alpha,
                ]
            }
            ColorFormat::Rgba32F => {
                let [r, g, b, a] = &self.float[block];
                [f32x16::simd_from(s, *r), f32x16::simd_from(s, *g), f32x16::simd_from(s, *b), f32x16::simd_from(s, *a)]
            }
        }
    }

    /// Encodes and stores channels of the colours of some of a block's samples.
    #[inline(always)]
    pub(crate) fn store<S: Simd>(
        &mut self,
        s: S,
        block: usize,
        mask: mask32x16<S>,
        color: Channels<S>,
        channels: ColorMask,
    ) {
        let written = channels.channels();
        match self.format {
            ColorFormat::None => {}
            ColorFormat::Rgba8 => {
                let [r, g, b, a] = color;
                let packed =
                    to_unorm8(s, r) | (to_unorm8(s, g) << 8) | (to_unorm8(s, b) << 16) | (to_unorm8(s, a) << 24);
                self.store_packed(s, block, mask, packed, written);
            }
            ColorFormat::Rgba8Srgb => {
                let alpha = to_unorm8(s, color[3]) << 24;
                let packed = encode_srgb(s, color[0], color[1], color[2]) | alpha;
                self.store_packed(s, block, mask, packed, written);
            }
            ColorFormat::Rgba32F => {
                let mut k = 0;
                while k < 4 {
                    if written[k] {
                        let there = f32x16::simd_from(s, self.float[block][k]);
                        self.float[block][k] = mask.select(one_nan(s, color[k]), there).into();
                    }
                    k += 1;
                }
            }
        }
    }

    #[inline(always)]
    fn store_packed<S: Simd>(
        &mut self,
        s: S,
        block: usize,
        mask: mask32x16<S>,
        mut packed: u32x16<S>,
        written: [bool; 4],
    ) {
        let there = u32x16::simd_from(s, self.packed[block]);
        if written != [true; 4] {
            let bytes = u32::from_le_bytes(written.map(|written| if written { 255 } else { 0 }));
            packed = (packed & bytes) | (there & !bytes);
        }
        self.packed[block] = mask.select(packed, there).into();
    }
}

/// Makes every NaN the same one: sign and payload of a computed NaN differ between kinds of processors.
#[inline(always)]
pub(crate) fn one_nan<S: Simd>(s: S, x: f32x16<S>) -> f32x16<S> {
    x.simd_eq(x).select(x, f32x16::splat(s, f32::from_bits(0x7fc0_0000)))
}

/// Clamps to 0 to 1; NaN counts as 0.
#[inline(always)]
pub(crate) fn clamp_unorm<S: Simd>(s: S, x: f32x16<S>) -> f32x16<S> {
    let (zero, one) = (f32x16::splat(s, 0.0), f32x16::splat(s, 1.0));
    let x = x.simd_gt(zero).select(x, zero);
    x.simd_lt(one).select(x, one)
}

/// `round(255 x)` of a value clamped to 0 to 1; NaN counts as 0.
pub(crate) fn unorm8(x: f32) -> u8 {
    let x = if x > 0.0 { x } else { 0.0 };
    let x = if x < 1.0 { x } else { 1.0 };
    (x * 255.0 + 0.5) as u8
}

#[inline(always)]
fn to_unorm8<S: Simd>(s: S, x: f32x16<S>) -> u32x16<S> {
    let code: i32x16<S> = (clamp_unorm(s, x) * 255.0 + 0.5).to_int();
    code.bitcast()
}

/// The low byte of each lane, over 255.
#[inline(always)]
fn from_unorm8<S: Simd>(s: S, codes: u32x16<S>) -> f32x16<S> {
    let low: i32x16<S> = (codes & 255).bitcast();
    let value: f32x16<S> = low.to_float();
    value / f32x16::splat(s, 255.0)
}

/// The sRGB codes of three channels, packed, alpha 0.
#[inline(always)]
fn encode_srgb<S: Simd>(s: S, r: f32x16<S>, g: f32x16<S>, b: f32x16<S>) -> u32x16<S> {
    let (r, g, b): ([f32; 16], [f32; 16], [f32; 16]) = (r.into(), g.into(), b.into());
    u32x16::simd_from(s, encode_srgb_words(&r, &g, &b))
}

#[inline(never)]
fn encode_srgb_words(r: &[f32; 16], g: &[f32; 16], b: &[f32; 16]) -> [u32; 16] {
    let srgb = &*SRGB;
    let mut words = [0; 16];
    for k in 0..16 {
        words[k] = u32::from_le_bytes([srgb.encode(r[k]), srgb.encode(g[k]), srgb.encode(b[k]), 0]);
    }
    words
}
