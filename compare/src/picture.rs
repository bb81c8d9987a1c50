//! Pictures on disk, and how alike two of them are.

use crate::scene::Size;
use anyhow::{Context, Result, ensure};
use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::Path;

/// Codes by which two right pictures may differ in a channel: drivers round colours differently.
const SAME_CODES: u8 = 2;

/// Writes a picture as PNG. The codes are linear, and the file says so with its gamma.
pub(crate) fn write(path: &Path, [width, height]: Size, pixels: &[[u8; 4]]) -> Result<()> {
    let file = File::create(path).with_context(|| format!("cannot write {}", path.display()))?;
    let mut encoder = png::Encoder::new(BufWriter::new(file), width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_source_gamma(png::ScaledFloat::new(1.0));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels.as_flattened())?;
    writer.finish()?;
    Ok(())
}

/// Reads a picture that [`write`] wrote.
pub(crate) fn read(path: &Path) -> Result<Vec<[u8; 4]>> {
    let file = File::open(path).with_context(|| format!("cannot read {}", path.display()))?;
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info()?;
    let [width, height] = [reader.info().width, reader.info().height];
    let mut pixels = vec![[0; 4]; (width * height) as usize];
    ensure!(
        reader.output_buffer_size() == Some(pixels.as_flattened().len()),
        "{} is not a picture with alpha",
        path.display()
    );
    reader.next_frame(pixels.as_flattened_mut())?;
    Ok(pixels)
}

/// The part of the pixels, 0 to 1, in which two pictures differ visibly in some channel.
pub(crate) fn difference(a: &[[u8; 4]], b: &[[u8; 4]]) -> f64 {
    let differs = |(a, b): (&[u8; 4], &[u8; 4])| (0..4).any(|channel| a[channel].abs_diff(b[channel]) > SAME_CODES);
    a.iter().zip(b).filter(|&pair| differs(pair)).count() as f64 / a.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn difference_counts_pixels_beyond_two_codes() {
        let a = [[10, 20, 30, 255]; 4];
        let mut b = a;
        b[0][1] += 2;
        assert_eq!(difference(&a, &b), 0.0);
        b[3][2] -= 3;
        assert_eq!(difference(&a, &b), 0.25);
    }
}
