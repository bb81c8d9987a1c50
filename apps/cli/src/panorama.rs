//! Panoramas from the bytes of Radiance (.hdr) and OpenEXR (.exr) files.

use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{ReadChannels, ReadLayers, Vec2, read as read_exr};
use std::io::Cursor;
use zune_core::bytestream::ZCursor;
use zune_hdr::HdrDecoder;

/// Panoramas have at most so many pixels, 8192 x 4096: far more than what is left of them when they are filtered.
const MOST_PIXELS: usize = 1 << 25;
/// And so many in a row or column: decoders take several times a row's memory.
const LONGEST_SIDE: usize = 1 << 14;

/// And what of an OpenEXR file is decompressed at a time at most so many bytes: 256 of the longest rows, of four floats.
const LARGEST_BLOCK: usize = 256 * LONGEST_SIDE * 16;

/// Its width and height, and red, green and blue of its pixels in linear light, row by row from the top.
pub(crate) type Panorama = (u32, u32, Vec<f32>);

/// All of a panorama; an error is the reason.
pub(crate) fn read(bytes: &[u8]) -> Result<Panorama, String> {
    if bytes.starts_with(b"#?") { radiance(bytes) } else { openexr(bytes) }
}

/// What comes first in a file says how large all is.
fn check_size(width: usize, height: usize) -> Result<(), String> {
    if width.max(height) > LONGEST_SIDE {
        return Err(format!("it has {width} x {height} pixels, and more than {LONGEST_SIDE} in a row are not read"));
    }
    match width * height <= MOST_PIXELS {
        true => Ok(()),
        false => Err(format!("it has {width} x {height} pixels, and more than {MOST_PIXELS} are not read")),
    }
}

fn radiance(bytes: &[u8]) -> Result<Panorama, String> {
    let mut decoder = HdrDecoder::new(ZCursor::new(bytes));
    decoder.decode_headers().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("it has no size")?;
    check_size(width, height)?;
    let pixels = decoder.decode().map_err(|error| error.to_string())?;
    Ok((width as u32, height as u32, pixels))
}

fn openexr(bytes: &[u8]) -> Result<Panorama, String> {
    let said = |error: exr::error::Error| error.to_string();
    let headers = MetaData::read_from_buffered(bytes, false).map_err(said)?.headers;
    for header in &headers {
        check_size(header.layer_size.0, header.layer_size.1)?;
        // A tile may be larger than the picture that it is of.
        if let BlockDescription::Tiles(tiles) = header.blocks {
            check_size(tiles.tile_size.0, tiles.tile_size.1)?;
        }
        let block = header.max_block_byte_size();
        if block > LARGEST_BLOCK {
            return Err(format!("it is stored in pieces of {block} bytes, and more than {LARGEST_BLOCK} are not read"));
        }
    }
    let empty = |size: Vec2<usize>, _: &_| (size, vec![0.0; 3 * size.area()]);
    let set = |(size, pixels): &mut (Vec2<usize>, Vec<f32>), at: Vec2<usize>, (r, g, b, _): (f32, f32, f32, f32)| {
        pixels[3 * (at.1 * size.0 + at.0)..][..3].copy_from_slice(&[r, g, b]);
    };
    let layers = read_exr().no_deep_data().largest_resolution_level().rgba_channels(empty, set);
    let image = layers.first_valid_layer().all_attributes().from_buffered(Cursor::new(bytes)).map_err(said)?;
    let (Vec2(width, height), pixels) = image.layer_data.channel_data.pixels;
    Ok((width as u32, height as u32, pixels))
}
