//! The light of `--shading pbr`.

use crate::arguments::{How, RenderArguments, Shading};
use crate::failure::Failure;
use image::{ImageReader, Limits};
use pineda_looks::pbr::Environment;
use std::path::Path;

/// Panoramas have at most so many pixels a side: far more than what is left of them when they are filtered.
const MOST: u32 = 16384;

/// The studio, or the panorama that was asked for; none for looks that have no use for it. All models share it.
pub(crate) fn of(arguments: &RenderArguments, how: &How) -> Result<Option<Environment>, Failure> {
    let look = &arguments.look;
    if look.shading != Shading::Pbr {
        return match &look.environment {
            Some(_) => Err(Failure::usage("this shading does not know of light from around")
                .at("--environment")
                .help("leave it away, or give --shading pbr")),
            None => Ok(None),
        };
    }
    let mut renderer = how.renderer()?;
    Ok(Some(match &look.environment {
        None => Environment::studio(&mut renderer)?,
        Some(path) => {
            let (width, height, pixels) = panorama(path)?;
            Environment::panorama(width, height, &pixels, &mut renderer)?
        }
    }))
}

fn panorama(path: &Path) -> Result<(u32, u32, Vec<[f32; 3]>), Failure> {
    let wrong = |error: &dyn std::fmt::Display| {
        Failure::data(format_args!("the environment cannot be read: {error}"))
            .at(path.display())
            .help("it must be a .hdr (Radiance) or .exr (OpenEXR) panorama, twice as wide as high")
    };
    let mut reader = ImageReader::open(path).map_err(|error| wrong(&error))?;
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MOST), Some(MOST));
    reader.limits(limits);
    let picture =
        reader.with_guessed_format().map_err(|error| wrong(&error))?.decode().map_err(|error| wrong(&error))?;
    let picture = picture.into_rgb32f();
    let (width, height) = picture.dimensions();
    let pixels = picture.into_raw().chunks_exact(3).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    Ok((width, height, pixels))
}
