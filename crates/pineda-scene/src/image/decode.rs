//! One image.

use std::io::Cursor;

use png::{BitDepth, ColorType, Transformations};
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;

use crate::Texels;

/// What an image is in, by its first bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Png,
    Jpeg,
    WebP,
}

/// What an image's beginning says of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) kind: Kind,
    pub(super) width: u32,
    pub(super) height: u32,
    /// 8 or 16 bits a channel.
    pub(super) is_16_bit: bool,
}

impl Header {
    pub(super) fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

/// Reads no further than to where the size is.
pub(super) fn header(bytes: &[u8]) -> Result<Header, String> {
    let kind = kind(bytes)?;
    let (width, height, is_16_bit) = match kind {
        Kind::Png => {
            let mut decoder = png::Decoder::new(Cursor::new(bytes));
            let info = decoder.read_header_info().map_err(|error| error.to_string())?;
            (info.width, info.height, info.bit_depth == BitDepth::Sixteen)
        }
        Kind::Jpeg => {
            let mut decoder = jpeg(bytes);
            decoder.decode_headers().map_err(|error| format!("{error:?}"))?;
            let (width, height) = decoder.dimensions().ok_or("it has no size")?;
            (width as u32, height as u32, false)
        }
        Kind::WebP => {
            let decoder = image_webp::WebPDecoder::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
            let (width, height) = decoder.dimensions();
            (width, height, false)
        }
    };
    if width == 0 || height == 0 {
        return Err("it has no pixels".to_owned());
    }
    Ok(Header { kind, width, height, is_16_bit })
}

fn kind(bytes: &[u8]) -> Result<Kind, String> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Ok(Kind::Png),
        [0xff, 0xd8, ..] => Ok(Kind::Jpeg),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Ok(Kind::WebP),
        [0xab, b'K', b'T', b'X', ..] => Err("it is KTX, which cannot be read".to_owned()),
        _ => Err("it is neither PNG, JPEG nor WebP".to_owned()),
    }
}

/// All pixels of the image whose header that is.
pub(super) fn decode(bytes: &[u8], header: Header) -> Result<Texels, String> {
    let count = usize::try_from(header.pixels()).map_err(|_| "it is too large for this machine".to_owned())?;
    match header.kind {
        Kind::Png => decode_png(bytes, header, count),
        Kind::Jpeg => {
            let mut texels = vec![[0u8; 4]; count];
            let error = |error| format!("{error:?}");
            jpeg(bytes).decode_into(&mut texels.as_flattened_mut()[..3 * count]).map_err(error)?;
            spread(&mut texels, 3, opaque);
            Ok(Texels::Rgba8(texels))
        }
        Kind::WebP => {
            let error = |error: image_webp::DecodingError| error.to_string();
            let mut decoder = image_webp::WebPDecoder::new(Cursor::new(bytes)).map_err(error)?;
            let mut texels = vec![[0u8; 4]; count];
            let channels = if decoder.has_alpha() { 4 } else { 3 };
            decoder.read_image(&mut texels.as_flattened_mut()[..channels * count]).map_err(error)?;
            spread(&mut texels, channels, opaque);
            Ok(Texels::Rgba8(texels))
        }
    }
}

fn opaque([r, g, b]: [u8; 3]) -> [u8; 4] {
    [r, g, b, 255]
}

fn jpeg(bytes: &[u8]) -> zune_jpeg::JpegDecoder<ZCursor<&[u8]>> {
    let options = DecoderOptions::default()
        .set_use_unsafe(false)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX))
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(bytes), options)
}

fn decode_png(bytes: &[u8], header: Header, count: usize) -> Result<Texels, String> {
    let error = |error: png::DecodingError| error.to_string();
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    // Palettes and grey of few bits as 8 bits, and always with alpha.
    decoder.set_transformations(Transformations::EXPAND | Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(error)?;
    let (color, depth) = reader.output_color_type();
    let channels = match color {
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgba => 4,
        _ => return Err("it is PNG of an unknown kind".to_owned()),
    };
    if (depth == BitDepth::Sixteen) != header.is_16_bit {
        return Err("it is PNG of an unknown depth".to_owned());
    }
    if header.is_16_bit {
        let mut texels = vec![[0u16; 4]; count];
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(texels.as_flattened_mut());
        reader.next_frame(&mut bytes[..2 * channels * count]).map_err(error)?;
        for number in texels.as_flattened_mut() {
            *number = u16::from_be(*number);
        }
        spread(&mut texels, channels, |[gray, alpha]: [u16; 2]| [gray, gray, gray, alpha]);
        Ok(Texels::Rgba16(texels))
    } else {
        let mut texels = vec![[0u8; 4]; count];
        reader.next_frame(&mut texels.as_flattened_mut()[..channels * count]).map_err(error)?;
        spread(&mut texels, channels, |[gray, alpha]: [u8; 2]| [gray, gray, gray, alpha]);
        Ok(Texels::Rgba8(texels))
    }
}

/// Gives each pixel its place: the front of `texels` holds all pixels of `N` channels close together. From the last one
/// on, so that none is written over before it is read. Those that have all `channels` already stay as they are.
fn spread<T: Copy, const N: usize>(texels: &mut [[T; 4]], channels: usize, full: impl Fn([T; N]) -> [T; 4]) {
    if channels != N {
        return;
    }
    for i in (0..texels.len()).rev() {
        let packed = texels.as_flattened();
        let pixel = std::array::from_fn(|c| packed[N * i + c]);
        texels[i] = full(pixel);
    }
}
