//! Pixels of a colour buffer between the caller's memory and a tile.

use super::ColorBuffer;
use super::bands::TileRows;
use super::color::with_pixels;
use super::format::TileColor;
use bytemuck::must_cast;

/// A pixel as words: see [`ColorFormat`](super::format::ColorFormat).
pub(crate) trait Texel: Copy {
    const WORDS: usize;
    /// Its words; further ones are 0.
    fn to_words(self) -> [u32; 4];
    fn from_words(words: [u32; 4]) -> Self;
}

macro_rules! texels {
    ($($texel:ty: $words:literal, |$pixel:ident| $to:expr, |$word:ident| $from:expr;)+) => {$(
        impl Texel for $texel {
            const WORDS: usize = $words;
            #[inline(always)]
            fn to_words(self) -> [u32; 4] {
                let $pixel = self;
                $to
            }
            #[inline(always)]
            fn from_words($word: [u32; 4]) -> Self {
                $from
            }
        }
    )+};
}

texels! {
    u8: 1, |p| [p.into(), 0, 0, 0], |w| w[0] as u8;
    [u8; 2]: 1, |p| [u16::from_le_bytes(p).into(), 0, 0, 0], |w| (w[0] as u16).to_le_bytes();
    [u8; 4]: 1, |p| [u32::from_le_bytes(p), 0, 0, 0], |w| w[0].to_le_bytes();
    u16: 1, |p| [p.into(), 0, 0, 0], |w| w[0] as u16;
    [u16; 2]: 1, |p| [pair(p[0], p[1]), 0, 0, 0], |w| [w[0] as u16, (w[0] >> 16) as u16];
    [u16; 4]: 2, |p| [pair(p[0], p[1]), pair(p[2], p[3]), 0, 0],
        |w| [w[0] as u16, (w[0] >> 16) as u16, w[1] as u16, (w[1] >> 16) as u16];
    f32: 1, |p| [p.to_bits(), 0, 0, 0], |w| f32::from_bits(w[0]);
    [f32; 2]: 2, |p| [p[0].to_bits(), p[1].to_bits(), 0, 0], |w| [f32::from_bits(w[0]), f32::from_bits(w[1])];
    [f32; 4]: 4, |p| must_cast(p), |w| must_cast(w);
    u32: 1, |p| [p, 0, 0, 0], |w| w[0];
    [u32; 2]: 2, |p| [p[0], p[1], 0, 0], |w| [w[0], w[1]];
    [u32; 4]: 4, |p| p, |w| w;
    i32: 1, |p| [p as u32, 0, 0, 0], |w| w[0] as i32;
    [i32; 2]: 2, |p| [p[0] as u32, p[1] as u32, 0, 0], |w| [w[0] as i32, w[1] as i32];
    [i32; 4]: 4, |p| must_cast(p), |w| must_cast(w);
}

#[inline(always)]
fn pair(low: u16, high: u16) -> u32 {
    u32::from(low) | u32::from(high) << 16
}

impl TileColor {
    /// Copies a tile's part of a band in. `blocks` gives the number of the first block of a row of blocks.
    pub(crate) fn load_rows(&mut self, rows: &TileRows, band: &mut ColorBuffer<'_>, blocks: impl Fn(usize) -> usize) {
        with_pixels!(band, pixels => load(rows, pixels, &mut self.words, blocks), ());
    }

    /// Copies the tile out.
    pub(crate) fn store_rows(&self, rows: &TileRows, band: &mut ColorBuffer<'_>, blocks: impl Fn(usize) -> usize) {
        with_pixels!(band, pixels => store(rows, pixels, &self.words, blocks), ());
    }
}

/// Gives a tile's part of a band one colour, as words.
pub(crate) fn fill_rows(rows: &TileRows, band: &mut ColorBuffer<'_>, color: [u32; 4]) {
    with_pixels!(band, pixels => rows.fill(pixels, Texel::from_words(color)), ());
}

fn load<T: Texel>(rows: &TileRows, pixels: &mut [T], words: &mut [[u32; 16]], blocks: impl Fn(usize) -> usize) {
    if T::WORDS == 1 {
        return rows.load(pixels, words, blocks, |pixel: T| pixel.to_words()[0]);
    }
    rows.for_each(pixels, blocks, |piece, block, first| {
        let words = &mut words[T::WORDS * block..T::WORDS * (block + 1)];
        for (k, pixel) in piece.iter().enumerate() {
            let of_pixel = pixel.to_words();
            for word in 0..T::WORDS {
                words[word][first + k] = of_pixel[word];
            }
        }
    });
}

fn store<T: Texel>(rows: &TileRows, pixels: &mut [T], words: &[[u32; 16]], blocks: impl Fn(usize) -> usize) {
    if T::WORDS == 1 {
        return rows.store(pixels, words, blocks, |word| T::from_words([word, 0, 0, 0]));
    }
    rows.for_each(pixels, blocks, |piece, block, first| {
        let words = &words[T::WORDS * block..T::WORDS * (block + 1)];
        for (k, pixel) in piece.iter_mut().enumerate() {
            let mut of_pixel = [0; 4];
            for word in 0..T::WORDS {
                of_pixel[word] = words[word][first + k];
            }
            *pixel = T::from_words(of_pixel);
        }
    });
}
