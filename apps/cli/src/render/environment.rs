//! The light of `--shading pbr`.

use crate::arguments::{How, Lights, RenderArguments, Shading};
use crate::failure::Failure;
use crate::panorama::{self, Panorama};
use pineda_looks::pbr::Environment;
use pineda_scene::read_file;
use std::path::Path;

/// Panoramas' files have at most so many bytes.
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
    Ok(Some(match (&look.environment, look.lights) {
        (None, Lights::Studio) => Environment::studio()?,
        (None, Lights::Model) => Environment::dim_studio(&mut how.renderer()?)?,
        (Some(path), _) => {
            let (width, height, pixels) = read(path)?;
            Environment::panorama(width, height, pixels.as_chunks().0, &mut how.renderer()?)?
        }
    }))
}

fn read(path: &Path) -> Result<Panorama, Failure> {
    let wrong = |error: String| {
        Failure::data(format_args!("the environment cannot be read: {error}"))
            .at(path.display())
            .help("it must be a .hdr (Radiance) or .exr (OpenEXR) panorama, twice as wide as high")
    };
    let bytes = read_file(path, MOST_BYTES).map_err(|error| wrong(error.to_string()))?;
    panorama::read(&bytes).map_err(wrong)
}
