//! A model that has been read: it can be posed again and again without being read again.

use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gltf::Document;
use crate::limits::Budget;
use crate::resolver::read_file;
use crate::{Error, Folder, Format, Limits, Loaded, Pose, Resolver, finish, gltf, obj, ply, stl, threemf};

/// A model with all its scenes, animations and variants; each [`Pose`] of it is a scene.
///
/// Files are read once, and images are decoded once, when a pose first shows them. Poses may be asked for from several
/// threads.
///
/// ```
/// use pineda_scene::{Format, Limits, Model, NoFiles, Pose};
///
/// let obj = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
/// let model = Model::from_bytes(obj, Format::Obj, &NoFiles, &Limits::default())?;
/// assert!(model.contents().animations.is_empty());
/// assert_eq!(model.scene(&Pose::default())?.scene.objects[0].triangles, [[0, 1, 2]]);
///
/// let walking = Pose { animation: Some("Walk".into()), time: 0.5, ..Pose::default() };
/// assert_eq!(model.scene(&walking).unwrap_err().to_string(), "has no animation 'Walk': it has no animations");
/// # Ok::<(), pineda_scene::Error>(())
/// ```
#[derive(Debug)]
pub struct Model {
    content: Content,
    contents: Contents,
    /// For errors.
    path: Option<PathBuf>,
}

#[derive(Debug)]
enum Content {
    Gltf(Box<Document>),
    /// The other formats know one scene only.
    Still(Loaded),
}

/// What a [`Pose`] can ask for: names in the file's order, empty where a thing has none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contents {
    /// glTF's scenes. There may be none: then all of the file is shown.
    pub scenes: Vec<Arc<str>>,
    /// Which of them a pose shows that asks for none.
    pub default_scene: usize,
    /// Animations.
    pub animations: Vec<Animation>,
    /// Material variants.
    pub variants: Vec<Arc<str>>,
}

/// An animation's name and length.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// The file's name for it; may be empty.
    pub name: Arc<str>,
    /// The time of its last key, in seconds.
    pub duration: f64,
}

impl Model {
    /// Reads the model in the file `path`, and the files in its folder that it names.
    ///
    /// The extension says which format it is; if it says nothing, the file's first bytes do.
    ///
    /// # Errors
    /// [`Error::File`] with the path and what is wrong.
    pub fn open(path: impl AsRef<Path>, limits: &Limits) -> Result<Self, Error> {
        Self::open_as(path, None, limits)
    }

    /// [`Model::open`] of a file that is in this format, whatever its extension and its first bytes say.
    ///
    /// # Errors
    /// As [`Model::open`].
    pub fn open_as(path: impl AsRef<Path>, format: Option<Format>, limits: &Limits) -> Result<Self, Error> {
        let path = path.as_ref();
        let read = || {
            let bytes = read_file(path, limits.file_bytes).map_err(|error| match error.kind() {
                io::ErrorKind::FileTooLarge => Error::Limit {
                    what: "bytes",
                    count: std::fs::metadata(path).map_or(limits.file_bytes, |m| m.len()),
                    limit: limits.file_bytes,
                    field: "Limits::file_bytes",
                },
                _ => Error::Read { error },
            })?;
            let format = format.or_else(|| Format::from_extension(path)).or_else(|| Format::from_content(&bytes));
            let format = format.ok_or(Error::UnknownFormat)?;
            let folder = Folder(path.parent().unwrap_or(Path::new("")).to_owned());
            Self::read(Cow::Owned(bytes), format, &folder, limits)
        };
        let model = read().map_err(|error| in_file(Some(path), error))?;
        Ok(Self { path: Some(path.to_owned()), ..model })
    }

    /// Reads a model from its file's bytes; `files` gives the files that it names.
    ///
    /// # Errors
    /// What is wrong with the model.
    pub fn from_bytes(bytes: &[u8], format: Format, files: &dyn Resolver, limits: &Limits) -> Result<Self, Error> {
        Self::read(Cow::Borrowed(bytes), format, files, limits)
    }

    fn read(bytes: Cow<'_, [u8]>, format: Format, files: &dyn Resolver, limits: &Limits) -> Result<Self, Error> {
        let mut budget = Budget::new(limits, bytes.len())?;
        // A binary STL file begins with bytes of any kind.
        if format != Format::Stl && is_utf16(&bytes) {
            return Err(Error::text(format, 1, "the file is text in UTF-16: save it in UTF-8"));
        }
        let still = match format {
            Format::Obj => obj::read(&bytes, files, &mut budget)?,
            Format::Stl => stl::read(&bytes, &mut budget)?,
            Format::Ply => ply::read(&bytes, files, &mut budget)?,
            Format::ThreeMf => threemf::read(&bytes, &mut budget)?,
            Format::Gltf => {
                let document = gltf::Document::read(bytes, files, budget)?;
                let contents = document.contents();
                return Ok(Self { content: Content::Gltf(Box::new(document)), contents, path: None });
            }
        };
        let contents = Contents { scenes: vec!["".into()], ..Contents::default() };
        Ok(Self { content: Content::Still(finish::finish(still)), contents, path: None })
    }

    /// What there is to choose from.
    pub fn contents(&self) -> &Contents {
        &self.contents
    }

    /// The model in a pose.
    ///
    /// # Errors
    /// [`Error::NoSuch`] if the model does not have what the pose asks for, [`Error::NothingToDraw`] if the pose shows
    /// nothing; and what is wrong with the parts of a glTF file that this pose is the first to need. All of them in an
    /// [`Error::File`] if the model is from a file.
    pub fn scene(&self, pose: &Pose) -> Result<Loaded, Error> {
        let posed = || {
            let pose = self.contents.resolve(pose)?;
            let loaded = match &self.content {
                Content::Gltf(document) => finish::finish(document.scene(&pose)?),
                Content::Still(loaded) => loaded.clone(),
            };
            drawable(loaded)
        };
        posed().map_err(|error| in_file(self.path.as_deref(), error))
    }

    /// [`Model::scene`] for one pose only: nothing is copied.
    ///
    /// # Errors
    /// As [`Model::scene`].
    pub fn into_scene(self, pose: &Pose) -> Result<Loaded, Error> {
        match self.content {
            Content::Gltf(_) => self.scene(pose),
            Content::Still(loaded) => {
                let resolved = self.contents.resolve(pose);
                resolved.and_then(|_| drawable(loaded)).map_err(|error| in_file(self.path.as_deref(), error))
            }
        }
    }
}

/// A pose by numbers that exist.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ResolvedPose {
    pub(crate) scene: usize,
    pub(crate) animation: Option<usize>,
    pub(crate) time: f64,
    pub(crate) variant: Option<usize>,
    pub(crate) without_textures: bool,
}

impl Contents {
    fn resolve(&self, pose: &Pose) -> Result<ResolvedPose, Error> {
        let scene = pose.scene.as_ref().map(|scene| scene.among("scene", &self.scenes)).transpose()?;
        let animations: Vec<_> = self.animations.iter().map(|animation| animation.name.clone()).collect();
        let animation = pose.animation.as_ref().map(|a| a.among("animation", &animations)).transpose()?;
        let variant = pose.variant.as_ref().map(|variant| variant.among("variant", &self.variants)).transpose()?;
        let Pose { time, without_textures, .. } = *pose;
        Ok(ResolvedPose { scene: scene.unwrap_or(self.default_scene), animation, time, variant, without_textures })
    }
}

/// By the mark that such text begins with, in either byte order.
fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")
}

fn drawable(loaded: Loaded) -> Result<Loaded, Error> {
    if loaded.scene.objects.is_empty() { Err(Error::NothingToDraw { reasons: loaded.notes }) } else { Ok(loaded) }
}

fn in_file(path: Option<&Path>, error: Error) -> Error {
    match path {
        Some(path) => Error::File { path: path.to_owned(), error: Box::new(error) },
        None => error,
    }
}
