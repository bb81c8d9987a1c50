//! Models from files and from standard input.

use crate::failure::Failure;
use crate::values::ModelFormat;
use pineda_scene::{Error, Format, Limits, Loaded, Model, NoFiles, Pose};
use std::io::Read;
use std::path::Path;

/// The name that stands for standard input.
pub(crate) fn is_standard_input(path: &Path) -> bool {
    path == Path::new("-")
}

/// A model, not yet posed.
pub(crate) fn model(path: &Path, format: Option<ModelFormat>) -> Result<Model, Failure> {
    let limits = Limits::default();
    if is_standard_input(path) {
        return standard_input(format, &limits);
    }
    Model::open_as(path, format.map(Format::from), &limits).map_err(|error| failure(error, path))
}

/// The model's scene in a pose, and what was left out of it.
pub(crate) fn posed(path: &Path, format: Option<ModelFormat>, pose: &Pose) -> Result<Loaded, Failure> {
    model(path, format)?.into_scene(pose).map_err(|error| failure(error, path))
}

fn standard_input(format: Option<ModelFormat>, limits: &Limits) -> Result<Model, Failure> {
    let name = Path::new("standard input");
    let mut bytes = Vec::new();
    // One more than may be: so that too much is found out, not cut off.
    let read = std::io::stdin().lock().take(limits.file_bytes + 1).read_to_end(&mut bytes);
    read.map_err(|error| Failure::data(format_args!("the model cannot be read: {error}")).at(name.display()))?;
    let format = format.map(Format::from).or_else(|| Format::from_content(&bytes)).ok_or_else(|| {
        Failure::data("what comes from standard input is of no known format")
            .at(name.display())
            .help("say what it is: --model-format obj, stl, ply, 3mf or gltf")
    })?;
    Model::from_bytes(&bytes, format, &NoFiles, limits).map_err(|error| failure(error, name))
}

/// What is wrong with a model, as a person reads it.
pub(crate) fn failure(error: Error, path: &Path) -> Failure {
    match error {
        Error::File { path, error } => {
            Failure::data(format_args!("the model {}", predicate(&error))).at(path.display())
        }
        error => {
            let name = if is_standard_input(path) { Path::new("standard input") } else { path };
            Failure::data(format_args!("the model {}", predicate(&error))).at(name.display())
        }
    }
}

/// What is wrong, as the end of a sentence that begins with "the model".
fn predicate(error: &Error) -> String {
    match error {
        Error::Read { .. }
        | Error::UnknownFormat
        | Error::Limit { .. }
        | Error::NothingToDraw { .. }
        | Error::NoSuch { .. } => error.to_string(),
        _ => format!("cannot be read: {error}"),
    }
}
