//! Finished pictures, and the two formats that they are written in.

use crate::failure::Failure;
use crate::values::Size;
use png::{BitDepth, ColorType, Compression, SrgbRenderingIntent};
use std::path::Path;

/// Pixels row by row, the top row first.
#[derive(Debug)]
pub(crate) struct Picture {
    pub(crate) size: Size,
    pub(crate) pixels: Pixels,
}

#[derive(Debug)]
pub(crate) enum Pixels {
    Rgb8(Vec<[u8; 3]>),
    /// Straight alpha.
    Rgba8(Vec<[u8; 4]>),
    Gray16(Vec<u16>),
    /// Four numbers: not a picture to look at.
    Rgba16(Vec<[u16; 4]>),
}

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Png,
    Ppm,
}

impl Format {
    /// By the extension.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("ppm") => Ok(Self::Ppm),
            _ => Err(Failure::usage("a picture is written as .png or .ppm, and this name ends in neither")
                .at(format_args!("-o {}", path.display()))
                .help("name it picture.png")),
        }
    }
}

impl Picture {
    /// The file's bytes.
    pub(crate) fn encode(&self, format: Format) -> Result<Vec<u8>, Failure> {
        match format {
            Format::Png => self.png(),
            Format::Ppm => self.ppm(),
        }
    }

    fn png(&self) -> Result<Vec<u8>, Failure> {
        let (color, depth, data) = match &self.pixels {
            Pixels::Rgb8(p) => (ColorType::Rgb, BitDepth::Eight, p.as_flattened().to_vec()),
            Pixels::Rgba8(p) => (ColorType::Rgba, BitDepth::Eight, p.as_flattened().to_vec()),
            Pixels::Gray16(p) => (ColorType::Grayscale, BitDepth::Sixteen, big_endian(p)),
            Pixels::Rgba16(p) => (ColorType::Rgba, BitDepth::Sixteen, big_endian(p.as_flattened())),
        };
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.size.width, self.size.height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        encoder.set_compression(Compression::Balanced);
        if depth == BitDepth::Eight {
            encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        }
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(&data)?;
            writer.finish()
        });
        written.map_err(|error| Failure::data(format_args!("the picture cannot be encoded: {error}")))?;
        Ok(bytes)
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
            Pixels::Rgba16(_) => {
                return Err(
                    Failure::usage("PPM has three channels, and this picture has four").help("name the output .png")
                );
            }
        }
        Ok(bytes)
    }
}

fn big_endian(words: &[u16]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_be_bytes()).collect()
}

/// Straight alpha over black, in linear light.
fn before_black([r, g, b, a]: [u8; 4]) -> [u8; 3] {
    match a {
        255 => [r, g, b],
        0 => [0; 3],
        _ => [r, g, b].map(|code| {
            let srgb = &*crate::srgb::SRGB;
            srgb.encode(srgb.decode(code) * (f32::from(a) / 255.0))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ppm(pixels: Pixels) -> Vec<u8> {
        Picture { size: Size { width: 2, height: 1 }, pixels }.encode(Format::Ppm).unwrap()
    }

    #[test]
    fn picture_as_ppm() {
        assert_eq!(ppm(Pixels::Rgb8(vec![[1, 2, 3], [4, 5, 6]])), b"P6\n2 1\n255\n\x01\x02\x03\x04\x05\x06");
        assert_eq!(ppm(Pixels::Rgba8(vec![[9, 8, 7, 0], [255, 0, 7, 255]])), b"P6\n2 1\n255\n\0\0\0\xff\0\x07");
        assert_eq!(ppm(Pixels::Gray16(vec![1, 65535])), b"P6\n2 1\n65535\n\0\x01\0\x01\0\x01\xff\xff\xff\xff\xff\xff");
    }

    #[test]
    fn picture_as_png_is_read_back() {
        let numbers = vec![[1, 2, 3, 65535], [65535, 40000, 0, 7]];
        let picture = Picture { size: Size { width: 2, height: 1 }, pixels: Pixels::Rgba16(numbers) };
        let bytes = picture.encode(Format::Png).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        assert_eq!(data, [0, 1, 0, 2, 0, 3, 255, 255, 255, 255, 0x9c, 0x40, 0, 0, 0, 7]);
        assert!(picture.encode(Format::Ppm).is_err());
    }
}
