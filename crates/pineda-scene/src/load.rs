//! From a file, or bytes, to a scene.

use std::io;
use std::path::Path;

use crate::limits::Budget;
use crate::resolver::read_file;
use crate::{Error, Folder, Format, Limits, Resolver, Scene, finish, gltf, obj, ply, stl};

/// A model.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// What is to be drawn: at least one triangle, all with finite corners.
    pub scene: Scene,
    /// What of the file is not in the scene, one line each.
    pub notes: Vec<String>,
}

/// Loads the model in the file `path`, and the files in its folder that it names, within the default [`Limits`].
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
    let path = path.as_ref();
    let in_file = |error| Error::File { path: path.to_owned(), error: Box::new(error) };
    let bytes = read_file(path, limits.file_bytes).map_err(|error| match error.kind() {
        io::ErrorKind::FileTooLarge => in_file(Error::Limit {
            what: "bytes",
            count: std::fs::metadata(path).map_or(limits.file_bytes, |m| m.len()),
            limit: limits.file_bytes,
            field: "Limits::file_bytes",
        }),
        _ => in_file(Error::Read { error }),
    })?;
    let format = Format::from_extension(path).or_else(|| Format::from_content(&bytes));
    let format = format.ok_or_else(|| in_file(Error::UnknownFormat))?;
    let folder = Folder(path.parent().unwrap_or(Path::new("")).to_owned());
    load_bytes(&bytes, format, &folder, limits).map_err(in_file)
}

/// Loads a model from its file's bytes; `files` gives the files that it names.
///
/// # Errors
/// What is wrong with the model. [`Error::NoTriangles`] if there is nothing to draw.
pub fn load_bytes(bytes: &[u8], format: Format, files: &dyn Resolver, limits: &Limits) -> Result<Loaded, Error> {
    let mut budget = Budget::new(limits, bytes.len())?;
    let mut loaded = match format {
        Format::Obj => obj::read(bytes, files, &mut budget)?,
        Format::Stl => stl::read(bytes, &mut budget)?,
        Format::Ply => ply::read(bytes, &mut budget)?,
        Format::Gltf => gltf::read(bytes, files, &mut budget)?,
    };
    finish::finish(&mut loaded);
    if loaded.scene.objects.is_empty() { Err(Error::NoTriangles { reasons: loaded.notes }) } else { Ok(loaded) }
}
