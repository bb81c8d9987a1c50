//! The colour buffers of a target.

use super::format::ColorFormat;

/// A colour buffer and its format: a slice of the caller's, with plain numbers as pixels.
///
/// A channel that the format lacks is dropped when a colour is stored; for blending it is 0, or 1 if it is alpha.
///
/// ```
/// use pineda::{ColorBuffer, Target};
/// let mut normals = vec![[0u16; 4]; 640 * 480];
/// let target = Target { color: ColorBuffer::Rgba16F(&mut normals), ..Target::new(640, 480) };
/// ```
#[derive(Debug, Default)]
pub enum ColorBuffer<'a> {
    /// None: what a fragment stage returns for it is dropped. Fragment stages of opaque draws do not run where there is no buffer at all.
    #[default]
    None,
    /// Red in 8 bits.
    R8(&'a mut [u8]),
    /// Red and green in 8 bits each.
    Rg8(&'a mut [[u8; 2]]),
    /// Red, green, blue, alpha, each `round(255 x)` of a value clamped to 0 to 1; NaN counts as 0.
    Rgba8(&'a mut [[u8; 4]]),
    /// Red in 8 bits, encoded as in [`Rgba8Srgb`](Self::Rgba8Srgb).
    R8Srgb(&'a mut [u8]),
    /// Red and green in 8 bits each, encoded as in [`Rgba8Srgb`](Self::Rgba8Srgb).
    Rg8Srgb(&'a mut [[u8; 2]]),
    /// As [`Rgba8`](Self::Rgba8), with red, green and blue encoded by the sRGB curve (IEC 61966-2-1) to the nearest code; blended in linear light.
    Rgba8Srgb(&'a mut [[u8; 4]]),
    /// Red in 16 bits.
    R16(&'a mut [u16]),
    /// Red and green in 16 bits each.
    Rg16(&'a mut [[u16; 2]]),
    /// Red, green, blue, alpha, each the code nearest to `65535 x`, halves to even, of a value clamped to 0 to 1; NaN counts as 0.
    Rgba16(&'a mut [[u16; 4]]),
    /// Red as a 16-bit float.
    R16F(&'a mut [u16]),
    /// Red and green as 16-bit floats.
    Rg16F(&'a mut [[u16; 2]]),
    /// Red, green, blue, alpha as the bits of 16-bit floats: the nearest, see [`f32_to_f16`](crate::f32_to_f16). The crate `half`'s `f16` can be cast to them, with `bytemuck`.
    Rgba16F(&'a mut [[u16; 4]]),
    /// Red as f32.
    R32F(&'a mut [f32]),
    /// Red and green as f32.
    Rg32F(&'a mut [[f32; 2]]),
    /// As the fragment stage returns them; every NaN is stored with the bits 0x7fc0_0000.
    Rgba32F(&'a mut [[f32; 4]]),
    /// Red as an unsigned integer.
    R32U(&'a mut [u32]),
    /// Red and green as unsigned integers.
    Rg32U(&'a mut [[u32; 2]]),
    /// Unsigned integers, as a fragment stage returns them that returns [`Uint`](crate::Uint) or [`RgbaU`](crate::RgbaU). They are not blended.
    Rgba32U(&'a mut [[u32; 4]]),
    /// Red as a signed integer.
    R32I(&'a mut [i32]),
    /// Red and green as signed integers.
    Rg32I(&'a mut [[i32; 2]]),
    /// Signed integers, as a fragment stage returns them that returns [`Int`](crate::Int) or [`RgbaI`](crate::RgbaI). They are not blended.
    Rgba32I(&'a mut [[i32; 4]]),
}

/// Evaluates an expression with the pixels of a buffer, whatever their type, or another one if there is none.
macro_rules! with_pixels {
    ($buffer:expr, $pixels:ident => $do:expr, $none:expr) => {{
        use $crate::target::ColorBuffer as Buffer;
        match $buffer {
            Buffer::None => $none,
            Buffer::R8($pixels) | Buffer::R8Srgb($pixels) => $do,
            Buffer::Rg8($pixels) | Buffer::Rg8Srgb($pixels) => $do,
            Buffer::Rgba8($pixels) | Buffer::Rgba8Srgb($pixels) => $do,
            Buffer::R16($pixels) | Buffer::R16F($pixels) => $do,
            Buffer::Rg16($pixels) | Buffer::Rg16F($pixels) => $do,
            Buffer::Rgba16($pixels) | Buffer::Rgba16F($pixels) => $do,
            Buffer::R32F($pixels) => $do,
            Buffer::Rg32F($pixels) => $do,
            Buffer::Rgba32F($pixels) => $do,
            Buffer::R32U($pixels) => $do,
            Buffer::Rg32U($pixels) => $do,
            Buffer::Rgba32U($pixels) => $do,
            Buffer::R32I($pixels) => $do,
            Buffer::Rg32I($pixels) => $do,
            Buffer::Rgba32I($pixels) => $do,
        }
    }};
}
pub(crate) use with_pixels;

/// A match that gives a buffer of each format again.
macro_rules! same_format {
    ($buffer:expr, $pixels:ident, $none:expr, $wrap:ident => $do:expr) => {
        same_format!(@ $buffer, $pixels, $none, $wrap, $do;
            R8 Rg8 Rgba8 R8Srgb Rg8Srgb Rgba8Srgb R16 Rg16 Rgba16 R16F Rg16F Rgba16F
            R32F Rg32F Rgba32F R32U Rg32U Rgba32U R32I Rg32I Rgba32I)
    };
    (@ $buffer:expr, $pixels:ident, $none:expr, $wrap:ident, $do:expr; $($name:ident)+) => {
        match $buffer {
            ColorBuffer::None => $none,
            $(ColorBuffer::$name($pixels) => {
                let $wrap = ColorBuffer::$name;
                $do
            })+
        }
    };
}

impl<'a> ColorBuffer<'a> {
    /// The same buffer, for a shorter while.
    pub(crate) fn reborrow(&mut self) -> ColorBuffer<'_> {
        same_format!(self, pixels, ColorBuffer::None, wrap => wrap(pixels))
    }

    /// Stretches of so many pixels.
    pub(crate) fn into_chunks(self, length: usize) -> Box<dyn Iterator<Item = Self> + 'a> {
        same_format!(self, pixels, Box::new(std::iter::empty()), wrap => Box::new(pixels.chunks_mut(length).map(wrap)))
    }

    pub(crate) fn is_none(&self) -> bool {
        matches!(self, Self::None)
    }

    /// Its elements; `None` without a buffer.
    pub(crate) fn length(&self) -> Option<usize> {
        with_pixels!(self, pixels => Some(pixels.len()), None)
    }

    pub(crate) fn format(&self) -> ColorFormat {
        macro_rules! formats {
            ($($name:ident: $encoding:ident($channels:literal),)+) => {
                match self {
                    Self::None => ColorFormat::None,
                    $(Self::$name(_) => ColorFormat::$encoding($channels),)+
                }
            };
        }
        formats! {
            R8: Unorm8(1),
            Rg8: Unorm8(2),
            Rgba8: Unorm8(4),
            R8Srgb: Srgb8(1),
            Rg8Srgb: Srgb8(2),
            Rgba8Srgb: Srgb8(4),
            R16: Unorm16(1),
            Rg16: Unorm16(2),
            Rgba16: Unorm16(4),
            R16F: Half(1),
            Rg16F: Half(2),
            Rgba16F: Half(4),
            R32F: Float(1),
            Rg32F: Float(2),
            Rgba32F: Float(4),
            R32U: Uint(1),
            Rg32U: Uint(2),
            Rgba32U: Uint(4),
            R32I: Int(1),
            Rg32I: Int(2),
            Rgba32I: Int(4),
        }
    }
}
