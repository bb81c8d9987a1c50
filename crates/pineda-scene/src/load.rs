//! From a file, or bytes, to a scene in one step.

use std::path::Path;

use crate::{Error, Format, Limits, Model, Pose, Resolver, Scene};

/// A model in one pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// What is to be drawn: at least one triangle, line or point, all with finite corners.
    pub scene: Scene,
    /// What of the file is not in the scene, one line each.
    pub notes: Vec<String>,
}

/// Loads the model in the file `path`, and the files in its folder that it names, within the default [`Limits`]; as it
/// is stored, without animation. [`Model`] has the other poses.
///
/// The extension says which format it is; if it says nothing, the file's first bytes do.
///
/// # Errors
/// [`Error::File`] with the path and what is wrong.
pub fn load(path: impl AsRef<Path>) -> Result<Loaded, Error> {
    load_with(path, &Limits::default())
}

/// [`load`] within limits of your own.
///
/// # Errors
/// [`Error::File`] with the path and what is wrong.
pub fn load_with(path: impl AsRef<Path>, limits: &Limits) -> Result<Loaded, Error> {
    Model::open(path, limits)?.into_scene(&Pose::default())
}

/// Loads a model from its file's bytes; `files` gives the files that it names.
///
/// # Errors
/// What is wrong with the model. [`Error::NothingToDraw`] if there is nothing to draw.
pub fn load_bytes(bytes: &[u8], format: Format, files: &dyn Resolver, limits: &Limits) -> Result<Loaded, Error> {
    Model::from_bytes(bytes, format, files, limits)?.into_scene(&Pose::default())
}
