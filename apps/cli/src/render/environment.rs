//! The light of `--shading pbr`.

use crate::arguments::{How, Lights, RenderArguments, Shading};
use crate::failure::Failure;
use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers, Vec2, read};
use pineda_looks::pbr::Environment;
use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;
use zune_core::bytestream::ZCursor;
use zune_hdr::HdrDecoder;

/// Panoramas have at most so many pixels, 8192 x 4096: far more than what is left of them when they are filtered.
const MOST_PIXELS: usize = 1 << 25;
/// And their files at most so many bytes.
const MOST_BYTES: u64 = 1 << 30;

/// The studio, dimmed beside models' own lights, or the panorama that was asked for; none for looks that have no use for it. All models share it.
pub(crate) fn of(arguments: &RenderArguments, how: &How) -> Result<Option<Environment>, Failure> {
    let look = &arguments.look;
    if look.shading != Shading::Pbr {
        let (what, option) = match (&look.environment, look.lights) {
            (Some(_), _) => ("light from around", "--environment"),
            (None, Lights::Model) => ("a model's lights", "--lights model"),
            (None, Lights::Studio) => return Ok(None),
        };
        return Err(Failure::usage(format_args!("this shading does not know of {what}"))
            .at(option)
            .help("leave it away, or give --shading pbr"));
    }
    let mut renderer = how.renderer()?;
    Ok(Some(match (&look.environment, look.lights) {
        (None, Lights::Studio) => Environment::studio(&mut renderer)?,
        (None, Lights::Model) => Environment::dim_studio(&mut renderer)?,
        (Some(path), _) => {
            let (width, height, pixels) = panorama(path)?;
            Environment::panorama(width, height, &pixels, &mut renderer)?
        }
    }))
}

/// Its width and height, and its pixels in linear light, row by row from the top.
type Panorama = (u32, u32, Vec<[f32; 3]>);

fn panorama(path: &Path) -> Result<Panorama, Failure> {
    let wrong = |error: String| {
        Failure::data(format_args!("the environment cannot be read: {error}"))
            .at(path.display())
            .help("it must be a .hdr (Radiance) or .exr (OpenEXR) panorama, twice as wide as high")
    };
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes));
    read.map_err(|error| wrong(error.to_string()))?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(wrong(format!("it is larger than {MOST_BYTES} bytes")));
    }
    let read = if bytes.starts_with(b"#?") { radiance(&bytes) } else { openexr(&bytes) };
    read.map_err(wrong)
}

/// What comes first in a file says how large all is.
fn check_size(width: usize, height: usize) -> Result<(), String> {
    match width.saturating_mul(height) <= MOST_PIXELS {
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
    Ok((width as u32, height as u32, pixels.as_chunks().0.to_vec()))
}

fn openexr(bytes: &[u8]) -> Result<Panorama, String> {
    let said = |error: exr::error::Error| error.to_string();
    let headers = MetaData::read_from_buffered(bytes, false).map_err(said)?.headers;
    headers.iter().try_for_each(|header| check_size(header.layer_size.0, header.layer_size.1))?;
    let empty = |size: Vec2<usize>, _: &_| (size, vec![[0.0; 3]; size.area()]);
    let set =
        |(size, pixels): &mut (Vec2<usize>, Vec<[f32; 3]>), at: Vec2<usize>, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.1 * size.0 + at.0] = [r, g, b];
        };
    let layers = read().no_deep_data().largest_resolution_level().rgba_channels(empty, set);
    let image = layers.first_valid_layer().all_attributes().from_buffered(Cursor::new(bytes)).map_err(said)?;
    let (Vec2(width, height), pixels) = image.layer_data.channel_data.pixels;
    Ok((width as u32, height as u32, pixels))
}
