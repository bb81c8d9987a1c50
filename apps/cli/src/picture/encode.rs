//! Pictures to the bytes of files.

use super::{Picture, PictureFormat, Pixels};
use crate::failure::Failure;
use crate::srgb::SRGB;
use crate::values::Size;
use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};
use flate2::{Compression, write::ZlibEncoder};
use png::chunk::IDAT;
use png::{BitDepth, ColorType, DeflateCompression, SrgbRenderingIntent};
use std::borrow::Cow;
use std::io::{Cursor, Write};

/// Half or less of the time of the library's usual level, 6, for files that are somewhat larger.
const PNG_LEVEL: u8 = 3;

impl Picture {
    /// The file's bytes. `quality`, 1 to 100, is for JPEGs.
    pub(crate) fn encode(&self, format: PictureFormat, quality: u8) -> Result<Vec<u8>, Failure> {
        match format {
            PictureFormat::Png => self.png(),
            PictureFormat::Jpeg => self.jpeg(quality),
            PictureFormat::Webp => self.webp(),
            PictureFormat::Exr => self.exr(),
            PictureFormat::Ppm => self.ppm(),
        }
    }

    fn png(&self) -> Result<Vec<u8>, Failure> {
        let (color, depth, data) = match &self.pixels {
            Pixels::Rgb8(p) => (ColorType::Rgb, BitDepth::Eight, Cow::from(p.as_flattened())),
            Pixels::Rgba8(p) => (ColorType::Rgba, BitDepth::Eight, Cow::from(p.as_flattened())),
            Pixels::Gray16(p) => (ColorType::Grayscale, BitDepth::Sixteen, big_endian(p).into()),
            Pixels::Rgba16(p) => (ColorType::Rgba, BitDepth::Sixteen, big_endian(p.as_flattened()).into()),
            Pixels::Rgba32F(_) => return Err(cannot_hold("PNG", "floats")),
        };
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.size.width, self.size.height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        encoder.set_deflate_compression(DeflateCompression::Level(PNG_LEVEL));
        if depth == BitDepth::Eight {
            encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        }
        let written = encoder.write_header().and_then(|mut writer| {
            // Pictures with a background, which changes slowly, are about as small without filters as with them; those without would be up to twice as large.
            match color {
                ColorType::Rgb => writer.write_chunk(IDAT, &unfiltered(&data, 3 * self.size.width as usize)?)?,
                _ => writer.write_image_data(&data)?,
            }
            writer.finish()
        });
        written.map_err(cannot_encode)?;
        Ok(bytes)
    }

    fn jpeg(&self, quality: u8) -> Result<Vec<u8>, Failure> {
        let Pixels::Rgb8(pixels) = &self.pixels else { return Err(cannot_hold("JPEG", "alpha or 16 bits")) };
        let (Ok(width), Ok(height)) = (self.size.width.try_into(), self.size.height.try_into()) else {
            return Err(Failure::usage("a JPEG has at most 65535 pixels a side").help("name the output .png"));
        };
        let mut bytes = Vec::new();
        let encoder = jpeg_encoder::Encoder::new(&mut bytes, quality);
        encoder.encode(pixels.as_flattened(), width, height, jpeg_encoder::ColorType::Rgb).map_err(cannot_encode)?;
        Ok(bytes)
    }

    fn webp(&self) -> Result<Vec<u8>, Failure> {
        use image_webp::{ColorType, WebPEncoder};
        let (data, color) = match &self.pixels {
            Pixels::Rgb8(pixels) => (pixels.as_flattened(), ColorType::Rgb8),
            Pixels::Rgba8(pixels) => (pixels.as_flattened(), ColorType::Rgba8),
            _ => return Err(cannot_hold("WebP", "more than 8 bits")),
        };
        let mut bytes = Vec::new();
        let encoder = WebPEncoder::new(&mut bytes);
        encoder.encode(data, self.size.width, self.size.height, color).map_err(cannot_encode)?;
        Ok(bytes)
    }

    /// Channels R, G, B and A of 32-bit floats, multiplied by alpha, as OpenEXR has it.
    fn exr(&self) -> Result<Vec<u8>, Failure> {
        let Pixels::Rgba32F(pixels) = &self.pixels else { return Err(cannot_hold("EXR", "integers")) };
        let (width, height) = (self.size.width as usize, self.size.height as usize);
        let channels = SpecificChannels::rgba(|Vec2(x, y)| <(f32, f32, f32, f32)>::from(pixels[y * width + x]));
        let mut bytes = Cursor::new(Vec::new());
        let image = Image::from_channels((width, height), channels);
        image.write().to_buffered(&mut bytes).map_err(cannot_encode)?;
        Ok(bytes.into_inner())
    }

    /// P6, as in tutorial 1. What is transparent is put before black; grey becomes three equal channels.
    fn ppm(&self) -> Result<Vec<u8>, Failure> {
        let Size { width, height } = self.size;
        let maximum = if matches!(self.pixels, Pixels::Gray16(_)) { 65535 } else { 255 };
        let mut bytes = format!("P6\n{width} {height}\n{maximum}\n").into_bytes();
        match &self.pixels {
            Pixels::Rgb8(pixels) => bytes.extend_from_slice(pixels.as_flattened()),
            Pixels::Rgba8(pixels) => bytes.extend(pixels.iter().flat_map(|&pixel| before_black(pixel))),
            Pixels::Gray16(pixels) => bytes.extend(pixels.iter().flat_map(|gray| [gray.to_be_bytes(); 3]).flatten()),
            Pixels::Rgba16(_) => return Err(cannot_hold("PPM", "four channels")),
            Pixels::Rgba32F(_) => return Err(cannot_hold("PPM", "floats")),
        }
        Ok(bytes)
    }
}

/// What a PNG's `IDAT` holds, without filters. The library gives its compressor a row at a time, which clears 32 KiB for each.
fn unfiltered(data: &[u8], row: usize) -> std::io::Result<Vec<u8>> {
    const AT_A_TIME: usize = 1 << 20;
    let mut compressor = ZlibEncoder::new(Vec::new(), Compression::new(PNG_LEVEL.into()));
    let mut rows = Vec::new();
    for row in data.chunks_exact(row) {
        rows.push(0);
        rows.extend_from_slice(row);
        if rows.len() >= AT_A_TIME {
            compressor.write_all(&rows)?;
            rows.clear();
        }
    }
    compressor.write_all(&rows)?;
    compressor.finish()
}

/// The plan of a picture asks for what its format can hold: nobody should see this.
fn cannot_hold(format: &str, what: &str) -> Failure {
    Failure::usage(format_args!("{format} cannot hold {what}")).help("name the output .png")
}

fn cannot_encode(error: impl std::fmt::Display) -> Failure {
    Failure::data(format_args!("the picture cannot be encoded: {error}"))
}

fn big_endian(words: &[u16]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_be_bytes()).collect()
}

/// Straight alpha over black, in linear light.
fn before_black([r, g, b, a]: [u8; 4]) -> [u8; 3] {
    match a {
        255 => [r, g, b],
        0 => [0; 3],
        _ => [r, g, b].map(|code| SRGB.encode(SRGB.decode(code) * (f32::from(a) / 255.0))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers, read};

    fn encode(pixels: Pixels, format: PictureFormat) -> Result<Vec<u8>, Failure> {
        Picture { size: Size { width: 2, height: 1 }, pixels }.encode(format, 90)
    }

    #[test]
    fn picture_as_ppm() {
        let ppm = |pixels| encode(pixels, PictureFormat::Ppm).unwrap();
        assert_eq!(ppm(Pixels::Rgb8(vec![[1, 2, 3], [4, 5, 6]])), b"P6\n2 1\n255\n\x01\x02\x03\x04\x05\x06");
        assert_eq!(ppm(Pixels::Rgba8(vec![[9, 8, 7, 0], [255, 0, 7, 255]])), b"P6\n2 1\n255\n\0\0\0\xff\0\x07");
        assert_eq!(ppm(Pixels::Gray16(vec![1, 65535])), b"P6\n2 1\n65535\n\0\x01\0\x01\0\x01\xff\xff\xff\xff\xff\xff");
    }

    #[test]
    fn picture_as_png_is_read_back() {
        let numbers = || Pixels::Rgba16(vec![[1, 2, 3, 65535], [65535, 40000, 0, 7]]);
        let bytes = encode(numbers(), PictureFormat::Png).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        assert_eq!(data, [0, 1, 0, 2, 0, 3, 255, 255, 255, 255, 0x9c, 0x40, 0, 0, 0, 7]);
        for other in [PictureFormat::Ppm, PictureFormat::Jpeg, PictureFormat::Webp, PictureFormat::Exr] {
            assert!(encode(numbers(), other).is_err());
        }
    }

    /// 1,260,000 bytes of rows, which the compressor gets in two parts.
    #[test]
    fn picture_as_png_is_read_back_when_it_is_large() {
        let size = Size { width: 700, height: 600 };
        let pixels: Vec<_> = (0..700 * 600_u32).map(|i| [i as u8, (i >> 8) as u8, (i % 251) as u8]).collect();
        let bytes = Picture { size, pixels: Pixels::Rgb8(pixels.clone()) }.encode(PictureFormat::Png, 90).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        assert!(data == pixels.as_flattened());
    }

    #[test]
    fn picture_as_webp_is_read_back() {
        let pixels = vec![[9, 8, 7, 0], [255, 0, 7, 130]];
        let bytes = encode(Pixels::Rgba8(pixels.clone()), PictureFormat::Webp).unwrap();
        let mut decoder = image_webp::WebPDecoder::new(Cursor::new(bytes)).unwrap();
        let mut data = vec![0; 8];
        decoder.read_image(&mut data).unwrap();
        assert_eq!(data, pixels.as_flattened());
    }

    #[test]
    fn picture_as_exr_is_read_back() {
        let pixels = vec![[0.5, 1e-9, 7.25, 1.0], [0.0, 0.1, -2.0, 0.25]];
        let bytes = encode(Pixels::Rgba32F(pixels.clone()), PictureFormat::Exr).unwrap();
        let size = |size: Vec2<usize>, _: &_| vec![[0.0; 4]; size.area()];
        let set = |read: &mut Vec<_>, at: Vec2<usize>, (r, g, b, a): (f32, f32, f32, f32)| read[at.0] = [r, g, b, a];
        let layers = read().no_deep_data().largest_resolution_level().rgba_channels(size, set).first_valid_layer();
        let image = layers.all_attributes().from_buffered(Cursor::new(bytes)).unwrap();
        assert_eq!(image.layer_data.channel_data.pixels, pixels);
    }

    #[test]
    fn picture_as_jpeg_is_alike() {
        let bytes = encode(Pixels::Rgb8(vec![[200, 100, 50]; 2]), PictureFormat::Jpeg).unwrap();
        let read = zune_jpeg::JpegDecoder::new(zune_core::bytestream::ZCursor::new(&bytes)).decode().unwrap();
        for (channel, wanted) in read[3..].iter().zip([200u8, 100, 50]) {
            assert!(channel.abs_diff(wanted) < 4, "{read:?}");
        }
    }
}
