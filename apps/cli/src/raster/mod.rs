//! `pineda raster`: the tutorials' program.

mod draw;
mod file;

use crate::arguments::{RasterArguments, Show};
use crate::failure::Failure;
use crate::output::Output;
use crate::picture::PictureFormat;
use pineda::Renderer;

/// Of JPEGs.
const QUALITY: u8 = 92;

pub(crate) fn run(arguments: &RasterArguments, renderer: &mut Renderer) -> Result<(), Failure> {
    let output = Output::of(&arguments.output);
    let format = match arguments.picture_format {
        Some(format) => format,
        None => PictureFormat::of(&arguments.output)?,
    };
    if arguments.show == Show::Depth && !format.has_16_bits() {
        return Err(Failure::usage("depth has 16 bits, and this format 8").at("--show depth").help("write a .png"));
    }
    if format.is_float() {
        return Err(Failure::usage("these are codes, not light: EXR is for `pineda render`").help("write a .png"));
    }
    output.check()?;
    let drawing = match &arguments.file {
        Some(path) => file::read(path)?,
        None => file::Drawing::of_tutorial_1(),
    };
    let picture = draw::draw(&drawing, arguments.show, renderer)?;
    output.write(&picture.encode(format, QUALITY)?)
}
