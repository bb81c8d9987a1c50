//! `pineda raster`: the tutorials' program.

mod draw;
mod file;

use crate::arguments::RasterArguments;
use crate::failure::Failure;
use crate::output;
use crate::picture::Format;
use pineda::Renderer;

pub(crate) fn run(arguments: &RasterArguments, renderer: &mut Renderer) -> Result<(), Failure> {
    let format = Format::of(&arguments.output)?;
    output::check(&arguments.output)?;
    let drawing = match &arguments.file {
        Some(path) => file::read(path)?,
        None => file::Drawing::of_tutorial_1(),
    };
    let picture = draw::draw(&drawing, arguments.show, renderer)?;
    output::write(&arguments.output, &picture.encode(format)?)
}
