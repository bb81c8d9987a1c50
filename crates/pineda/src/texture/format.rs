//! How texels are stored, and what numbers they stand for.
//!
//! A lookup brings texels into lanes as words, takes those apart into channels, filters the channels and scales the result once: so 8-bit codes are filtered as the
//! integers that they are, without an error of their own, and a texel that is not filtered is its code over 255, rounded once. sRGB codes are decoded, by
//! table, before anything else happens.

use crate::lanes::{Lanes, Scalar};
use crate::math::{Bool, Int, Real, Rgba, RgbaI, RgbaU, Uint};
use crate::target::format::{ColorFormat, PART_OF_255, PART_OF_65535, REST_OF_255, REST_OF_65535};
use crate::target::half::{REBIAS, SMALLEST_NORMAL, SPECIAL};
use crate::target::srgb::SRGB;
use bytemuck::{Pod, must_cast};
use core::fmt::Debug;

pub(super) mod sealed {
    /// Keeps the formats to those that are listed.
    pub trait Sealed {}
}

/// The linear value of each sRGB code.
pub(super) type Decoded = [f32; 256];

/// A format of textures: a type without values, such as [`Rgba8Srgb`]. What a lookup returns is known when the shader is compiled, and so is the code for it.
///
/// Sealed. The formats are those of [`ColorBuffer`](crate::ColorBuffer), under the same names, with the same texels: so a target's buffer is a texture's, too.
pub trait TextureFormat: sealed::Sealed + Copy + Debug + Send + Sync + 'static {
    /// What a texture's memory is made of.
    type Texel: Pod + Debug + PartialEq + Send + Sync;
    /// A channel of it.
    type Channel: Pod;
    /// What [`fetch`](crate::Texture2d::fetch) returns: [`Rgba`], [`RgbaU`] or [`RgbaI`].
    type Color<L: Lanes>: Copy;
    /// How many channels it has: 1, 2 or 4. Those that it lacks are 0, alpha 1.
    const CHANNELS: usize;
    /// Whether it is encoded by the sRGB curve.
    const IS_SRGB: bool;
    /// Words that a texel is brought into lanes as.
    #[doc(hidden)]
    const WORDS: usize;
    /// Whether a texel is half a word, as it lies in memory.
    #[doc(hidden)]
    const IS_NARROW: bool = size_of::<Self::Texel>() <= 2 && !Self::IS_SRGB;
    #[doc(hidden)]
    fn words(texel: Self::Texel, decoded: &Decoded) -> [u32; 4];
    /// Words, as what they stand for; 0 in the channels that the format has where `inside` does not hold.
    #[doc(hidden)]
    fn color<L: Lanes>(words: [L::I; 4], inside: L::M) -> Self::Color<L>;
}

/// A format whose texels can be filtered: any but those of integers.
pub trait Filterable: TextureFormat {
    /// What 1 is before it is scaled.
    #[doc(hidden)]
    const UNITS: [f32; 4];
    /// Channels before they are scaled; anything where the format has none.
    #[doc(hidden)]
    fn channels<L: Lanes>(words: [L::I; 4]) -> [Real<L>; 4];
    /// Scales channels, and gives 0 and 1 where the format has none.
    #[doc(hidden)]
    fn scaled<L: Lanes>(channels: [Real<L>; 4]) -> [Real<L>; 4];
    /// The first channel of a texel that is not filtered, scaled: the same bits as by [`scaled`](Self::scaled), where these take a division and codes do not.
    #[doc(hidden)]
    #[inline(always)]
    fn scaled_code<L: Lanes>(channels: [Real<L>; 4]) -> Real<L> {
        Self::scaled(channels)[0]
    }
    /// The texel that is nearest to numbers in linear light.
    #[doc(hidden)]
    fn nearest(numbers: [f32; 4]) -> Self::Texel;
}

/// A table that is never looked at, for formats without the curve.
static NO_CURVE: Decoded = [0.0; 256];

/// The table that [`words`](TextureFormat::words) takes.
pub(super) fn decoded<F: TextureFormat>() -> &'static Decoded {
    if F::IS_SRGB { SRGB.decoded() } else { &NO_CURVE }
}

/// A texel's numbers in linear light, complete.
#[inline]
pub(super) fn numbers<F: Filterable>(texel: F::Texel, decoded: &Decoded) -> [f32; 4] {
    let words = must_cast(F::words(texel, decoded));
    let [r, g, b, a] = F::scaled::<Scalar>(F::channels::<Scalar>(words));
    [r.into(), g.into(), b.into(), a.into()]
}

/// Byte `k` of each lane, as a number.
#[inline(always)]
fn byte<L: Lanes>(words: L::I, k: u32) -> Real<L> {
    let word = Uint::<L>(words);
    let byte = if k == 3 { word >> 24 } else { (word >> (8 * k)) & 255 };
    byte.to_int().to_real()
}

/// Half `k` of each lane.
#[inline(always)]
fn half<L: Lanes>(words: [L::I; 4], k: usize) -> Uint<L> {
    let word = Uint::<L>(words[k / 2]);
    if k % 2 == 1 { word >> 16 } else { word & 0xffff }
}

/// [`f16_to_f32`](crate::f16_to_f32) in the lanes.
#[inline(always)]
fn float_of_half<L: Lanes>(half: Uint<L>) -> Real<L> {
    let (sign, size) = ((half & 0x8000) << 16, (half & 0x7fff) << 13);
    let small = Real::<L>(L::bits_f((size + SMALLEST_NORMAL).0)) - f32::from_bits(SMALLEST_NORMAL);
    let other = size + size.to_int().ge(SPECIAL.cast_signed()).select(Uint::new(size.lanes(), 2 * REBIAS), REBIAS);
    let float = size.to_int().lt(0x80_0000).select(Uint(L::f_bits(small.0)), other);
    Real(L::bits_f((float | sign).0))
}

/// Codes over 255, rounded once where they are whole.
#[inline(always)]
fn over_255<L: Lanes>(x: Real<L>) -> Real<L> {
    x * PART_OF_255 + x * REST_OF_255
}

/// Channels that a format lacks: 0, and 1 for alpha.
#[inline(always)]
fn complete<L: Lanes>(count: usize, mut channels: [Real<L>; 4]) -> [Real<L>; 4] {
    let mut k = count;
    while k < 4 {
        channels[k] = Real::new(channels[0].lanes(), if k == 3 { 1.0 } else { 0.0 });
        k += 1;
    }
    channels
}

/// The channels of a texel as an array.
trait Array<C> {
    fn array(self) -> [C; 4];
    fn texel(channels: [C; 4]) -> Self;
}

macro_rules! arrays {
    ($($channel:ty)+) => {$(
        impl Array<$channel> for $channel {
            #[inline(always)]
            fn array(self) -> [$channel; 4] {
                [self, Default::default(), Default::default(), Default::default()]
            }
            #[inline(always)]
            fn texel([r, ..]: [$channel; 4]) -> Self {
                r
            }
        }
        impl Array<$channel> for [$channel; 2] {
            #[inline(always)]
            fn array(self) -> [$channel; 4] {
                [self[0], self[1], Default::default(), Default::default()]
            }
            #[inline(always)]
            fn texel([r, g, ..]: [$channel; 4]) -> Self {
                [r, g]
            }
        }
        impl Array<$channel> for [$channel; 4] {
            #[inline(always)]
            fn array(self) -> [$channel; 4] {
                self
            }
            #[inline(always)]
            fn texel(channels: [$channel; 4]) -> Self {
                channels
            }
        }
    )+};
}

arrays! { u8 u16 f32 u32 i32 }

macro_rules! formats {
    ($($(#[$doc:meta])* $name:ident $encoding:ident $channel:ident $count:literal $texel:ty;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub enum $name {}

        impl sealed::Sealed for $name {}

        formats!(@ $encoding $name $channel $count $texel);
    )+};

    (@common $name:ident $encoding:ident $channel:ident $count:literal $texel:ty, $words:expr) => {
        type Texel = $texel;
        type Channel = $channel;
        const CHANNELS: usize = $count;
        const IS_SRGB: bool = matches!(ColorFormat::$encoding($count), ColorFormat::Srgb8(_));
        const WORDS: usize = $words;
    };

    (@float) => {
        type Color<L: Lanes> = Rgba<L>;
        #[inline(always)]
        fn color<L: Lanes>(words: [L::I; 4], inside: L::M) -> Rgba<L> {
            let mut channels = Self::channels::<L>(words);
            let mut k = 0;
            while k < Self::CHANNELS {
                channels[k] = Bool::<L>(inside).select(channels[k], 0.0);
                k += 1;
            }
            let [r, g, b, a] = Self::scaled(channels);
            Rgba { r, g, b, a }
        }
    };

    (@ Unorm8 $name:ident $channel:ident $count:literal $texel:ty) => {
        impl TextureFormat for $name {
            formats!(@common $name Unorm8 $channel $count $texel, 1);
            formats!(@float);
            #[inline(always)]
            fn words(texel: $texel, _: &Decoded) -> [u32; 4] {
                [u32::from_le_bytes(texel.array()), 0, 0, 0]
            }
        }
        impl Filterable for $name {
            const UNITS: [f32; 4] = [255.0; 4];
            #[inline(always)]
            fn channels<L: Lanes>(words: [L::I; 4]) -> [Real<L>; 4] {
                [byte(words[0], 0), byte(words[0], 1), byte(words[0], 2), byte(words[0], 3)]
            }
            #[inline(always)]
            fn scaled<L: Lanes>([r, g, b, a]: [Real<L>; 4]) -> [Real<L>; 4] {
                complete($count, [over_255(r), over_255(g), over_255(b), over_255(a)])
            }
            #[inline]
            fn nearest(numbers: [f32; 4]) -> $texel {
                Array::<u8>::texel(ColorFormat::Unorm8($count).encoded(numbers)[0].to_le_bytes())
            }
        }
    };

    (@ Srgb8 $name:ident $channel:ident $count:literal $texel:ty) => {
        impl TextureFormat for $name {
            formats!(@common $name Srgb8 $channel $count $texel, $count);
            formats!(@float);
            #[inline(always)]
            fn words(texel: $texel, decoded: &Decoded) -> [u32; 4] {
                let [r, g, b, a] = texel.array();
                [
                    decoded[usize::from(r)].to_bits(),
                    decoded[usize::from(g)].to_bits(),
                    decoded[usize::from(b)].to_bits(),
                    a.into(),
                ]
            }
        }
        impl Filterable for $name {
            const UNITS: [f32; 4] = [1.0, 1.0, 1.0, 255.0];
            #[inline(always)]
            fn channels<L: Lanes>([r, g, b, a]: [L::I; 4]) -> [Real<L>; 4] {
                [Real(L::bits_f(r)), Real(L::bits_f(g)), Real(L::bits_f(b)), Real(L::to_f(a))]
            }
            #[inline(always)]
            fn scaled<L: Lanes>([r, g, b, a]: [Real<L>; 4]) -> [Real<L>; 4] {
                complete($count, [r, g, b, over_255(a)])
            }
            #[inline]
            fn nearest(numbers: [f32; 4]) -> $texel {
                Array::<u8>::texel(ColorFormat::Srgb8($count).encoded(numbers)[0].to_le_bytes())
            }
        }
    };

    (@ Unorm16 $name:ident $channel:ident $count:literal $texel:ty) => {
        impl TextureFormat for $name {
            formats!(@common $name Unorm16 $channel $count $texel, usize::div_ceil($count, 2));
            formats!(@float);
            #[inline(always)]
            fn words(texel: $texel, _: &Decoded) -> [u32; 4] {
                let [r, g, b, a] = texel.array();
                [u32::from(r) | u32::from(g) << 16, u32::from(b) | u32::from(a) << 16, 0, 0]
            }
        }
        impl Filterable for $name {
            const UNITS: [f32; 4] = [65_535.0; 4];
            #[inline(always)]
            fn channels<L: Lanes>(words: [L::I; 4]) -> [Real<L>; 4] {
                [
                    half::<L>(words, 0).to_int().to_real(),
                    half::<L>(words, 1).to_int().to_real(),
                    half::<L>(words, 2).to_int().to_real(),
                    half::<L>(words, 3).to_int().to_real(),
                ]
            }
            #[inline(always)]
            fn scaled<L: Lanes>([r, g, b, a]: [Real<L>; 4]) -> [Real<L>; 4] {
                complete($count, [r / 65_535.0, g / 65_535.0, b / 65_535.0, a / 65_535.0])
            }
            #[inline(always)]
            fn scaled_code<L: Lanes>([r, ..]: [Real<L>; 4]) -> Real<L> {
                r * PART_OF_65535 + r * REST_OF_65535
            }
            #[inline]
            fn nearest(numbers: [f32; 4]) -> $texel {
                let [low, high, ..] = ColorFormat::Unorm16($count).encoded(numbers);
                Array::<u16>::texel([low as u16, (low >> 16) as u16, high as u16, (high >> 16) as u16])
            }
        }
    };

    (@ Half $name:ident $channel:ident $count:literal $texel:ty) => {
        impl TextureFormat for $name {
            formats!(@common $name Half $channel $count $texel, usize::div_ceil($count, 2));
            formats!(@float);
            #[inline(always)]
            fn words(texel: $texel, _: &Decoded) -> [u32; 4] {
                let [r, g, b, a] = texel.array();
                [u32::from(r) | u32::from(g) << 16, u32::from(b) | u32::from(a) << 16, 0, 0]
            }
        }
        impl Filterable for $name {
            const UNITS: [f32; 4] = [1.0; 4];
            #[inline(always)]
            fn channels<L: Lanes>(words: [L::I; 4]) -> [Real<L>; 4] {
                [
                    float_of_half(half::<L>(words, 0)),
                    float_of_half(half::<L>(words, 1)),
                    float_of_half(half::<L>(words, 2)),
                    float_of_half(half::<L>(words, 3)),
                ]
            }
            #[inline(always)]
            fn scaled<L: Lanes>(channels: [Real<L>; 4]) -> [Real<L>; 4] {
                complete($count, channels)
            }
            #[inline]
            fn nearest(numbers: [f32; 4]) -> $texel {
                let [low, high, ..] = ColorFormat::Half($count).encoded(numbers);
                Array::<u16>::texel([low as u16, (low >> 16) as u16, high as u16, (high >> 16) as u16])
            }
        }
    };

    (@ Float $name:ident $channel:ident $count:literal $texel:ty) => {
        impl TextureFormat for $name {
            formats!(@common $name Float $channel $count $texel, $count);
            formats!(@float);
            #[inline(always)]
            fn words(texel: $texel, _: &Decoded) -> [u32; 4] {
                must_cast(texel.array())
            }
        }
        impl Filterable for $name {
            const UNITS: [f32; 4] = [1.0; 4];
            #[inline(always)]
            fn channels<L: Lanes>([r, g, b, a]: [L::I; 4]) -> [Real<L>; 4] {
                [Real(L::bits_f(r)), Real(L::bits_f(g)), Real(L::bits_f(b)), Real(L::bits_f(a))]
            }
            #[inline(always)]
            fn scaled<L: Lanes>(channels: [Real<L>; 4]) -> [Real<L>; 4] {
                complete($count, channels)
            }
            #[inline]
            fn nearest(numbers: [f32; 4]) -> $texel {
                Array::<f32>::texel(numbers)
            }
        }
    };

    (@ Uint $name:ident $channel:ident $count:literal $texel:ty) => { formats!(@integer $name Uint $channel $count $texel, RgbaU); };
    (@ Int $name:ident $channel:ident $count:literal $texel:ty) => { formats!(@integer $name Int $channel $count $texel, RgbaI); };

    (@integer $name:ident $number:ident $channel:ident $count:literal $texel:ty, $color:ident) => {
        impl TextureFormat for $name {
            formats!(@common $name $number $channel $count $texel, $count);
            type Color<L: Lanes> = $color<L>;
            #[inline(always)]
            fn words(texel: $texel, _: &Decoded) -> [u32; 4] {
                must_cast(texel.array())
            }
            #[inline(always)]
            fn color<L: Lanes>(words: [L::I; 4], inside: L::M) -> $color<L> {
                let lanes = L::of_mask(inside);
                let mut channels = [lanes.int(0), lanes.int(0), lanes.int(0), lanes.int(1)];
                let mut k = 0;
                while k < $count {
                    channels[k] = L::iselect(inside, words[k], lanes.int(0));
                    k += 1;
                }
                let [r, g, b, a] = channels;
                $color { r: $number(r), g: $number(g), b: $number(b), a: $number(a) }
            }
        }
    };
}

formats! {
    /// Red in 8 bits: 0 is 0, 255 is 1.
    R8 Unorm8 u8 1 u8;
    /// Red and green in 8 bits each.
    Rg8 Unorm8 u8 2 [u8; 2];
    /// Red, green, blue and alpha in 8 bits each: 0 is 0, 255 is 1.
    Rgba8 Unorm8 u8 4 [u8; 4];
    /// Red in 8 bits, encoded by the sRGB curve.
    R8Srgb Srgb8 u8 1 u8;
    /// Red and green in 8 bits each, encoded by the sRGB curve.
    Rg8Srgb Srgb8 u8 2 [u8; 2];
    /// As [`Rgba8`], with red, green and blue encoded by the sRGB curve (IEC 61966-2-1): what pictures in files mostly are. Decoded to linear light before they are filtered.
    Rgba8Srgb Srgb8 u8 4 [u8; 4];
    /// Red in 16 bits: 65535 is 1.
    R16 Unorm16 u16 1 u16;
    /// Red and green in 16 bits each.
    Rg16 Unorm16 u16 2 [u16; 2];
    /// Red, green, blue and alpha in 16 bits each.
    Rgba16 Unorm16 u16 4 [u16; 4];
    /// Red as a 16-bit float.
    R16F Half u16 1 u16;
    /// Red and green as 16-bit floats.
    Rg16F Half u16 2 [u16; 2];
    /// Red, green, blue and alpha as the bits of 16-bit floats; see [`f32_to_f16`](crate::f32_to_f16).
    Rgba16F Half u16 4 [u16; 4];
    /// Red as f32: also what a depth buffer holds.
    R32F Float f32 1 f32;
    /// Red and green as f32.
    Rg32F Float f32 2 [f32; 2];
    /// Red, green, blue and alpha as f32.
    Rgba32F Float f32 4 [f32; 4];
    /// An unsigned integer; for [`fetch`](crate::Texture2d::fetch) only.
    R32U Uint u32 1 u32;
    /// Two unsigned integers; for [`fetch`](crate::Texture2d::fetch) only.
    Rg32U Uint u32 2 [u32; 2];
    /// Four unsigned integers; for [`fetch`](crate::Texture2d::fetch) only.
    Rgba32U Uint u32 4 [u32; 4];
    /// A signed integer; for [`fetch`](crate::Texture2d::fetch) only.
    R32I Int i32 1 i32;
    /// Two signed integers; for [`fetch`](crate::Texture2d::fetch) only.
    Rg32I Int i32 2 [i32; 2];
    /// Four signed integers; for [`fetch`](crate::Texture2d::fetch) only.
    Rgba32I Int i32 4 [i32; 4];
}
