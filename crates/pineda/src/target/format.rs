//! Colours in a tile: stored as the target stores them, so that a pass split in two gives the same bits.

use super::half::{f32_to_f16, from_half, to_half};
use super::srgb::SRGB;
use crate::pass::ColorMask;
use crate::shading::OutputKind;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};
use bytemuck::must_cast;

/// A format of [`ColorBuffer`](super::ColorBuffer): how a channel is stored, and how many there are: 1, 2 or 4.
///
/// In a tile a pixel is one, two or four words, as they are stored: the channels of the 8-bit formats in the bytes of one word, red in the lowest; those
/// of the 16-bit formats in the halves of one or two; of the others, a word for each channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ColorFormat {
    None,
    Unorm8(u8),
    Srgb8(u8),
    Unorm16(u8),
    Half(u8),
    Float(u8),
    Uint(u8),
    Int(u8),
}

impl ColorFormat {
    /// Whether it holds numbers from 0 to 1 and no others.
    pub(crate) fn is_unorm(self) -> bool {
        matches!(self, Self::Unorm8(_) | Self::Srgb8(_) | Self::Unorm16(_))
    }

    /// What numbers it takes.
    pub(crate) fn kind(self) -> OutputKind {
        match self {
            Self::Uint(_) => OutputKind::Uint,
            Self::Int(_) => OutputKind::Int,
            _ => OutputKind::Float,
        }
    }

    /// Words of a pixel in a tile.
    #[inline(always)]
    pub(crate) fn words(self) -> usize {
        match self {
            Self::None => 0,
            Self::Unorm8(_) | Self::Srgb8(_) => 1,
            Self::Unorm16(channels) | Self::Half(channels) => channels.div_ceil(2).into(),
            Self::Float(channels) | Self::Uint(channels) | Self::Int(channels) => channels.into(),
        }
    }

    /// The words of a colour; those that a pixel does not have are 0. Inlined, since most who call it know the format when they are compiled.
    #[inline(always)]
    pub(crate) fn encoded(self, color: [f32; 4]) -> [u32; 4] {
        let only = |channels: u8, codes: [u32; 4]| {
            let mut codes = codes;
            codes[channels.into()..].fill(0);
            codes
        };
        let [r, g, b, a] = color;
        match self {
            Self::Unorm8(channels) => bytes(only(channels, each(color, unorm8))),
            Self::Srgb8(channels) => {
                let code = |x| u32::from(SRGB.encode(x));
                bytes(only(channels, [code(r), code(g), code(b), unorm8(a).into()]))
            }
            Self::Unorm16(channels) => halves(only(channels, each(color, unorm16))),
            Self::Half(channels) => halves(only(channels, each(color, f32_to_f16))),
            Self::Float(channels) => only(channels, must_cast(color)),
            Self::None | Self::Uint(_) | Self::Int(_) => [0; 4],
        }
    }
}

/// A colour's codes.
#[inline(always)]
fn each<C: Into<u32>>([r, g, b, a]: [f32; 4], code: impl Fn(f32) -> C) -> [u32; 4] {
    [code(r).into(), code(g).into(), code(b).into(), code(a).into()]
}

fn bytes([r, g, b, a]: [u32; 4]) -> [u32; 4] {
    [r | g << 8 | b << 16 | a << 24, 0, 0, 0]
}

fn halves([r, g, b, a]: [u32; 4]) -> [u32; 4] {
    [r | g << 16, b | a << 16, 0, 0]
}

/// The colours of a tile's blocks, without a border.
#[derive(Debug)]
pub(crate) struct TileColor {
    pub(crate) format: ColorFormat,
    /// Block by block, and within a block word by word.
    pub(crate) words: Vec<[u32; 16]>,
}

/// Red, green, blue and alpha in the lanes; the bits of integers, for a format of integers.
pub(crate) type Channels<S> = [f32x16<S>; 4];

impl TileColor {
    pub(crate) fn new(format: ColorFormat) -> Self {
        Self { format, words: Vec::new() }
    }

    /// Gives `blocks` blocks one colour, as words.
    pub(crate) fn clear(&mut self, blocks: usize, color: [u32; 4]) {
        self.words.clear();
        let each = self.format.words();
        if each <= 1 {
            self.words.resize(blocks * each, [color[0]; 16]);
            return;
        }
        let pixel = color.map(|word| [word; 16]);
        self.words.reserve(blocks * each);
        for _ in 0..blocks {
            self.words.extend_from_slice(&pixel[..each]);
        }
    }

    /// The colours of a block, decoded. There are none of integers.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, s: S, block: usize) -> Channels<S> {
        match self.format {
            ColorFormat::Unorm8(4) => from_bytes(s, u32x16::simd_from(s, self.words[block])),
            ColorFormat::Srgb8(4) => {
                let words = &self.words[block];
                let decoded = decode_srgb(words);
                let alpha = from_unorm8(s, u32x16::simd_from(s, *words) >> 24);
                [
                    f32x16::simd_from(s, decoded[0]),
                    f32x16::simd_from(s, decoded[1]),
                    f32x16::simd_from(s, decoded[2]),
                    alpha,
                ]
            }
            ColorFormat::Float(4) => {
                let words = &self.words[4 * block..4 * block + 4];
                [float(s, &words[0]), float(s, &words[1]), float(s, &words[2]), float(s, &words[3])]
            }
            _ => {
                let [r, g, b, a] = self.load_other(s, block);
                [f32x16::simd_from(s, r), f32x16::simd_from(s, g), f32x16::simd_from(s, b), f32x16::simd_from(s, a)]
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
            ColorFormat::Unorm8(4) => {
                let [r, g, b, a] = color;
                let packed =
                    to_unorm8(s, r) | (to_unorm8(s, g) << 8) | (to_unorm8(s, b) << 16) | (to_unorm8(s, a) << 24);
                self.store_packed(s, block, mask, packed, written);
            }
            ColorFormat::Srgb8(4) => {
                let alpha = to_unorm8(s, color[3]) << 24;
                let packed = encode_srgb(s, color[0], color[1], color[2]) | alpha;
                self.store_packed(s, block, mask, packed, written);
            }
            ColorFormat::Float(4) => {
                let mut k = 0;
                while k < 4 {
                    if written[k] {
                        let there = &mut self.words[4 * block + k];
                        let new: u32x16<S> = one_nan(s, color[k]).bitcast();
                        *there = mask.select(new, u32x16::simd_from(s, *there)).into();
                    }
                    k += 1;
                }
            }
            _ => {
                let [r, g, b, a] = color;
                self.store_other(s, block, mask.to_bitmask(), &[r.into(), g.into(), b.into(), a.into()], written);
            }
        }
    }

    /// Copies the colour of one sample from another, each a block and a lane there, if it is asked for: without a branch, which would be guessed wrong too often.
    #[inline(always)]
    pub(crate) fn copy_sample(&mut self, from: [usize; 2], to: [usize; 2], asked: bool) {
        let each = self.format.words();
        let mut k = 0;
        while k < each {
            let word = self.words[each * from[0] + k][from[1] & 15];
            let there = &mut self.words[each * to[0] + k][to[1] & 15];
            *there = std::hint::select_unpredictable(asked, word, *there);
            k += 1;
        }
    }

    /// Whether two blocks hold the same.
    #[inline(always)]
    pub(crate) fn is_same<S: Simd>(&self, s: S, a: usize, b: usize) -> bool {
        let each = self.format.words();
        let mut same = mask32x16::splat(s, true);
        let mut k = 0;
        while k < each {
            let (a, b) =
                (u32x16::simd_from(s, self.words[each * a + k]), u32x16::simd_from(s, self.words[each * b + k]));
            same = same & a.simd_eq(b);
            k += 1;
        }
        same.to_bitmask() == 0xffff
    }

    /// Copies the colours of some of a block's samples from another block.
    #[inline(always)]
    pub(crate) fn copy_block<S: Simd>(&mut self, s: S, from: usize, to: usize, mask: mask32x16<S>) {
        let each = self.format.words();
        let mut k = 0;
        while k < each {
            let word = u32x16::simd_from(s, self.words[each * from + k]);
            let there = &mut self.words[each * to + k];
            *there = mask.select(word, u32x16::simd_from(s, *there)).into();
            k += 1;
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
        let there = u32x16::simd_from(s, self.words[block]);
        if written != [true; 4] {
            let [r, g, b, a] = written;
            let bytes = u32::from_le_bytes([r.into(), g.into(), b.into(), a.into()]) * 255;
            packed = (packed & bytes) | (there & !bytes);
        }
        self.words[block] = mask.select(packed, there).into();
    }

    /// [`Self::load`] for the less usual formats. Not inlined: they would only be in the way of the usual ones.
    #[inline(never)]
    fn load_other<S: Simd>(&self, s: S, block: usize) -> [[f32; 16]; 4] {
        s.apart(
            #[inline(always)]
            || self.load_any(s, block),
        )
    }

    #[inline(always)]
    fn load_any<S: Simd>(&self, s: S, block: usize) -> [[f32; 16]; 4] {
        let each = self.format.words();
        let words = &self.words[each * block..each * (block + 1)];
        // What is not there: 0, and 1 for alpha.
        let mut color = [[0.0; 16], [0.0; 16], [0.0; 16], [1.0; 16]];
        let channels = match self.format {
            ColorFormat::None | ColorFormat::Uint(_) | ColorFormat::Int(_) => return [[0.0; 16]; 4],
            ColorFormat::Unorm8(n)
            | ColorFormat::Srgb8(n)
            | ColorFormat::Unorm16(n)
            | ColorFormat::Half(n)
            | ColorFormat::Float(n) => n as usize,
        };
        let mut k = 0;
        while k < channels {
            let value = match self.format {
                ColorFormat::Srgb8(_) if k < 3 => f32x16::simd_from(s, decode_srgb(&words[0])[k]),
                ColorFormat::Unorm8(_) | ColorFormat::Srgb8(_) => {
                    from_unorm8(s, u32x16::simd_from(s, words[0]) >> (8 * k as u32))
                }
                ColorFormat::Unorm16(_) => from_unorm16(s, half_word(s, words, k)),
                ColorFormat::Half(_) => from_half(s, half_word(s, words, k)),
                _ => float(s, &words[k]),
            };
            color[k] = value.into();
            k += 1;
        }
        color
    }

    /// [`Self::store`] for the less usual formats.
    #[inline(never)]
    fn store_other<S: Simd>(&mut self, s: S, block: usize, mask: u64, color: &[[f32; 16]; 4], written: [bool; 4]) {
        s.apart(
            #[inline(always)]
            || self.store_any(s, block, mask32x16::from_bitmask(s, mask), color, written),
        );
    }

    #[inline(always)]
    fn store_any<S: Simd>(
        &mut self,
        s: S,
        block: usize,
        mask: mask32x16<S>,
        color: &[[f32; 16]; 4],
        written: [bool; 4],
    ) {
        let (format, each) = (self.format, self.format.words());
        let words = &mut self.words[each * block..each * (block + 1)];
        let (channels, bits) = match format {
            ColorFormat::None => return,
            ColorFormat::Unorm8(n) | ColorFormat::Srgb8(n) => (n as usize, 8),
            ColorFormat::Unorm16(n) | ColorFormat::Half(n) => (n as usize, 16),
            ColorFormat::Float(n) | ColorFormat::Uint(n) | ColorFormat::Int(n) => (n as usize, 32),
        };
        let mut k = 0;
        while k < channels {
            let value = f32x16::simd_from(s, color[k]);
            let code: u32x16<S> = match format {
                ColorFormat::Srgb8(_) if k < 3 => u32x16::simd_from(s, encode_srgb_word(&color[k])),
                ColorFormat::Unorm8(_) | ColorFormat::Srgb8(_) => to_unorm8(s, value),
                ColorFormat::Unorm16(_) => to_unorm16(s, value),
                ColorFormat::Half(_) => to_half(s, value),
                ColorFormat::Float(_) => one_nan(s, value).bitcast(),
                _ => u32x16::simd_from(s, bytemuck::must_cast::<_, [u32; 16]>(color[k])),
            };
            if written[k] {
                let shift = (k as u32 * bits) & 31;
                let there = &mut words[k * bits as usize / 32];
                let old = u32x16::simd_from(s, *there);
                let field = (u32::MAX >> (32 - bits)) << shift;
                let new = (code << shift) | (old & !field);
                *there = mask.select(new, old).into();
            }
            k += 1;
        }
    }
}

#[inline(always)]
fn float<S: Simd>(s: S, word: &[u32; 16]) -> f32x16<S> {
    u32x16::simd_from(s, *word).bitcast()
}

/// The half of a word that channel `k` has, in the low half.
#[inline(always)]
fn half_word<S: Simd>(s: S, words: &[[u32; 16]], k: usize) -> u32x16<S> {
    u32x16::simd_from(s, words[k / 2]) >> (16 * (k as u32 & 1))
}

/// Makes every NaN the same one: sign and payload of a computed NaN differ between kinds of processors.
#[inline(always)]
pub(crate) fn one_nan<S: Simd>(s: S, x: f32x16<S>) -> f32x16<S> {
    x.simd_eq(x).select(x, f32x16::splat(s, f32::from_bits(0x7fc0_0000)))
}

/// Clamps to 0 to 1; NaN counts as 0.
#[inline(always)]
pub(crate) fn clamp_unorm<S: Simd>(s: S, x: f32x16<S>) -> f32x16<S> {
    x.max(f32x16::splat(s, 0.0)).min(f32x16::splat(s, 1.0))
}

/// `round(255 x)` of a value clamped to 0 to 1; NaN counts as 0.
pub(crate) fn unorm8(x: f32) -> u8 {
    let x = if x > 0.0 { x } else { 0.0 };
    let x = if x < 1.0 { x } else { 1.0 };
    (x * 255.0 + 0.5) as u8
}

/// The code nearest to `65535 x`, halves to even, of a value clamped to 0 to 1; NaN counts as 0. The product is exact in f64.
fn unorm16(x: f32) -> u16 {
    let x = if x > 0.0 { x } else { 0.0 };
    let x = if x < 1.0 { x } else { 1.0 };
    (f64::from(x) * 65_535.0).round_ties_even() as u16
}

#[inline(always)]
fn to_unorm16<S: Simd>(s: S, x: f32x16<S>) -> u32x16<S> {
    // Adding 1.5 * 2^52 leaves no bits for a fraction.
    const MAGIC: f64 = 6_755_399_441_055_744.0;
    let (low, high) = clamp_unorm(s, x).widen();
    let low = (low * 65_535.0 + MAGIC) - MAGIC;
    let high = (high * 65_535.0 + MAGIC) - MAGIC;
    low.narrow(high).to_int().bitcast()
}

/// The low half of each lane, over 65535.
#[inline(always)]
fn from_unorm16<S: Simd>(_: S, codes: u32x16<S>) -> f32x16<S> {
    let low: i32x16<S> = (codes & 0xffff).bitcast();
    let value: f32x16<S> = low.to_float();
    value * PART_OF_65535 + value * REST_OF_65535
}

/// 1 / 65535 is 2^-16 (1 + 2^-16 + 2^-32 + ...): the same as for 255, below.
pub(crate) const PART_OF_65535: f32 = 1.0 / 65_536.0;
pub(crate) const REST_OF_65535: f32 = (1.0 / 65_535.0 - PART_OF_65535 as f64) as f32;

#[inline(always)]
fn to_unorm8<S: Simd>(s: S, x: f32x16<S>) -> u32x16<S> {
    unorm8_code(clamp_unorm(s, x))
}

/// The low byte of each lane, over 255: the nearest f32, without a division. 1 / 255 is taken in two parts, of which the first has so few bits
/// that its product is exact.
#[inline(always)]
pub(crate) fn from_unorm8<S: Simd>(_: S, codes: u32x16<S>) -> f32x16<S> {
    let low: i32x16<S> = (codes & 255).bitcast();
    let value: f32x16<S> = low.to_float();
    value * PART_OF_255 + value * REST_OF_255
}

pub(crate) const PART_OF_255: f32 = f32::from_bits((1.0f32 / 255.0).to_bits() & !0xff);
pub(crate) const REST_OF_255: f32 = (1.0 / 255.0 - PART_OF_255 as f64) as f32;

/// The four bytes of each lane, over 255.
#[inline(always)]
pub(crate) fn from_bytes<S: Simd>(s: S, p: u32x16<S>) -> Channels<S> {
    [from_unorm8(s, p), from_unorm8(s, p >> 8), from_unorm8(s, p >> 16), from_unorm8(s, p >> 24)]
}

/// Packed 8-bit codes of channels, red in the lowest byte, all of them known to be from 0 to 1.
#[inline(always)]
pub(crate) fn to_bytes<S: Simd>(_: S, [r, g, b, a]: Channels<S>) -> u32x16<S> {
    unorm8_code(r) | (unorm8_code(g) << 8) | (unorm8_code(b) << 16) | (unorm8_code(a) << 24)
}

/// The 8-bit code of what is known to be from 0 to 1.
#[inline(always)]
pub(crate) fn unorm8_code<S: Simd>(x: f32x16<S>) -> u32x16<S> {
    (x * 255.0 + 0.5).to_int().bitcast()
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

#[inline(never)]
fn encode_srgb_word(channel: &[f32; 16]) -> [u32; 16] {
    let srgb = &*SRGB;
    let mut words = [0; 16];
    for k in 0..16 {
        words[k] = srgb.encode(channel[k]).into();
    }
    words
}

/// The linear values of the three low bytes.
#[inline(always)]
fn decode_srgb(words: &[u32; 16]) -> [[f32; 16]; 3] {
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
    decoded
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wide::dispatch;

    #[test]
    fn codes_over_255_are_rounded_once() {
        for code in 0..=255u32 {
            let words = [code | 0xabcd_ef00; 16];
            let found: [f32; 16] =
                dispatch!(fearless_simd::Level::new(), s => from_unorm8(s, u32x16::simd_from(s, words)).into());
            assert_eq!(found, [code as f32 / 255.0; 16]);
        }
    }

    #[test]
    fn codes_over_65535_are_rounded_once() {
        for code in 0..=65_535u32 {
            let words = [code | 0xabcd_0000; 16];
            let found: [f32; 16] =
                dispatch!(fearless_simd::Level::new(), s => from_unorm16(s, u32x16::simd_from(s, words)).into());
            assert_eq!(found, [code as f32 / 65_535.0; 16]);
        }
    }
}
