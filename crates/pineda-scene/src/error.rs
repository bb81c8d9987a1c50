//! What can be wrong with a model.

use std::io;
use std::path::PathBuf;

use crate::Format;

/// Why a model could not be loaded: what is wrong, where, and what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The error that a named file gave.
    #[error("{}: {error}", path.display())]
    File {
        /// The model's file.
        path: PathBuf,
        /// What is wrong with it.
        error: Box<Self>,
    },
    /// The file could not be opened or read.
    #[error("cannot be read: {error}")]
    Read {
        /// The system's reason.
        error: io::Error,
    },
    /// Neither the extension nor the first bytes say what the file is.
    #[error(
        "is of no known format; readable are OBJ, STL, PLY, 3MF, glTF and GLB: give the file its extension (.obj, .stl, .ply, .3mf, .gltf, .glb)"
    )]
    UnknownFormat,
    /// A line of a text file breaks its format's rules.
    #[error("{format}, line {line}: {message}")]
    Text {
        /// The file's format.
        format: Format,
        /// From 1.
        line: usize,
        /// What is wrong and what was expected.
        message: String,
    },
    /// A place in a binary file breaks its format's rules.
    #[error("{format}, byte {offset}: {message}")]
    Binary {
        /// The file's format.
        format: Format,
        /// From the file's beginning.
        offset: usize,
        /// What is wrong and what was expected.
        message: String,
    },
    /// glTF's JSON cannot be parsed, or is not glTF.
    #[error("glTF, JSON line {line}, column {column}: {message}")]
    Json {
        /// From 1; 0 if the reader cannot tell.
        line: usize,
        /// From 1; 0 if the reader cannot tell.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// Something in a glTF file contradicts the rest of it.
    #[error("glTF, {place}: {message}")]
    Gltf {
        /// Such as `mesh 0, primitive 2, accessor 5`.
        place: String,
        /// What is wrong and what was expected.
        message: String,
    },
    /// A glTF file cannot be read without an extension that is not supported.
    #[error("glTF: the file requires {}, which cannot be read: export it without {}", names.join(", "), if names.len() == 1 { "this extension" } else { "these extensions" })]
    ExtensionRequired {
        /// Those of `extensionsRequired` that are not supported.
        names: Vec<String>,
    },
    /// A part of a 3MF file cannot be read, or contradicts the rest of it.
    #[error("3MF, {place}: {message}")]
    ThreeMf {
        /// Such as `3D/3dmodel.model, byte 512, <triangle>`.
        place: String,
        /// What is wrong and what was expected.
        message: String,
    },
    /// A file that the model needs could not be read.
    #[error("the file '{uri}', which the model needs, cannot be read: {error}: put it beside the model")]
    SideFile {
        /// As the model names it.
        uri: String,
        /// The reason.
        error: io::Error,
    },
    /// A model names a file outside its own folder, or on the network.
    #[error(
        "the model names '{uri}', which is not in the model's folder: copy the file there and name it by a relative path"
    )]
    OutsideFolder {
        /// As the model names it.
        uri: String,
    },
    /// Something is larger than [`crate::Limits`] allow.
    #[error("has {count} {what}; {limit} are allowed: if the file is to be trusted, raise {field}")]
    Limit {
        /// What there is too much of.
        what: &'static str,
        /// How much the file asks for, at least.
        count: u64,
        /// How much is allowed.
        limit: u64,
        /// The field that allows it.
        field: &'static str,
    },
    /// There is nothing to draw.
    #[error("has nothing to draw{}", if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join("; ")) })]
    NothingToDraw {
        /// What there is instead: the reader's notes.
        reasons: Vec<String>,
    },
    /// A [`crate::Select`] that selects nothing.
    #[error("has no {what} {asked}: {}", listed(what, there))]
    NoSuch {
        /// `scene`, `animation`, `variant` or `camera`.
        what: &'static str,
        /// The name, in quotes, or number that was asked for.
        asked: String,
        /// The names of those that there are, in order; some may be empty.
        there: Vec<String>,
    },
    /// A [`crate::View`] that shows nothing.
    #[error("a view with {name} {value} shows nothing: {expected}")]
    View {
        /// The field.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
}

impl Error {
    pub(crate) fn text(format: Format, line: usize, message: impl Into<String>) -> Self {
        Self::Text { format, line, message: message.into() }
    }

    pub(crate) fn binary(format: Format, offset: usize, message: impl Into<String>) -> Self {
        Self::Binary { format, offset, message: message.into() }
    }

    pub(crate) fn threemf(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self::ThreeMf { place: place.into(), message: message.into() }
    }

    pub(crate) fn gltf(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Gltf { place: place.into(), message: message.into() }
    }
}

/// `it has 0 'Walk', 1 'Run' and 7 more`, for whoever asked for something else.
fn listed(what: &str, names: &[String]) -> String {
    const SHOWN: usize = 8;
    if names.is_empty() {
        return format!("it has no {what}s");
    }
    let shown = names.iter().take(SHOWN).enumerate().map(|(number, name)| match name.as_str() {
        "" => number.to_string(),
        name => format!("{number} '{}'", crate::text::shown(name.as_bytes())),
    });
    let shown: Vec<_> = shown.collect();
    let more = names.len() - shown.len();
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("it has {}{more}", shown.join(", "))
}
