//! Files that a model names: buffers of a glTF file, material libraries of an OBJ file.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::limits::Budget;

/// Where the files that a model names come from.
///
/// Closures are resolvers, too, so a model in memory can bring its files along:
///
/// ```
/// use pineda_scene::{Format, Limits, load_bytes};
///
/// let obj = b"mtllib red.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
/// let files = |path: &str, _max_bytes: u64| match path {
///     "red.mtl" => Ok(b"newmtl red\nKd 1 0 0\n".to_vec()),
///     _ => Err(std::io::ErrorKind::NotFound.into()),
/// };
/// let loaded = load_bytes(obj, Format::Obj, &files, &Limits::default())?;
/// assert_eq!(loaded.scene.materials[0].base_color_factor, [1.0, 0.0, 0.0, 1.0]);
/// # Ok::<(), pineda_scene::Error>(())
/// ```
pub trait Resolver {
    /// The bytes of a file, at most `max_bytes` of them (more: an error of kind [`io::ErrorKind::FileTooLarge`]).
    ///
    /// `path` is relative to the model's folder, decoded, with `/` between its parts, and without `..`.
    fn read(&self, path: &str, max_bytes: u64) -> io::Result<Vec<u8>>;
}

impl<F: Fn(&str, u64) -> io::Result<Vec<u8>>> Resolver for F {
    fn read(&self, path: &str, max_bytes: u64) -> io::Result<Vec<u8>> {
        self(path, max_bytes)
    }
}

/// No files at all: for a model that is whole in itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Resolver for NoFiles {
    fn read(&self, _path: &str, _max_bytes: u64) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::NotFound, "the model was given without other files"))
    }
}

/// The files of a folder and of the folders in it. Symbolic links are followed, wherever they lead.
#[derive(Clone, Debug)]
pub struct Folder(pub PathBuf);

impl Resolver for Folder {
    fn read(&self, path: &str, max_bytes: u64) -> io::Result<Vec<u8>> {
        read_file(&self.0.join(path), max_bytes)
    }
}

/// The files that a model names. Each is read once, however often it is named: a short list of names is not to become
/// any number of copies.
pub(crate) struct SideFiles<'a> {
    files: &'a dyn Resolver,
    known: HashMap<String, Arc<Vec<u8>>>,
}

impl<'a> SideFiles<'a> {
    pub(crate) fn new(files: &'a dyn Resolver) -> Self {
        Self { files, known: HashMap::new() }
    }

    /// `path` as [`Resolver::read`] takes it.
    pub(crate) fn read(&mut self, path: &str, budget: &mut Budget) -> io::Result<Arc<Vec<u8>>> {
        if let Some(known) = self.known.get(path) {
            return Ok(Arc::clone(known));
        }
        let bytes = self.files.read(path, budget.bytes_left())?;
        let too_large = |error: crate::Error| io::Error::new(io::ErrorKind::FileTooLarge, error.to_string());
        budget.add_bytes(bytes.len() as u64).map_err(too_large)?;
        let bytes = Arc::new(bytes);
        self.known.insert(path.to_owned(), Arc::clone(&bytes));
        Ok(bytes)
    }
}

/// A regular file's bytes, at most `max_bytes`.
///
/// # Errors
/// Those of the file system; [`io::ErrorKind::FileTooLarge`]; and whatever is no regular file (a folder, a pipe, a
/// device), because such a one could block for ever or never end.
pub fn read_file(path: &Path, max_bytes: u64) -> io::Result<Vec<u8>> {
    // Opening some devices has effects: ask before opening.
    let metadata = std::fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !metadata.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file"));
    }
    let too_large = |bytes: u64| {
        let message = format!("{bytes} bytes or more, where {max_bytes} are allowed");
        io::Error::new(io::ErrorKind::FileTooLarge, message)
    };
    if metadata.len() > max_bytes {
        return Err(too_large(metadata.len()));
    }
    let mut bytes = Vec::with_capacity(metadata.len() as usize);
    // The file may grow while it is read.
    File::open(path)?.take(max_bytes.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > max_bytes { Err(too_large(bytes.len() as u64)) } else { Ok(bytes) }
}

/// A decoded name from a model file as a path below the model's folder; `None` if it leads out of it: absolute, with a
/// drive or scheme (`C:`, `http:`), or with more `..` than folders before them.
pub(crate) fn path_inside(name: &str) -> Option<String> {
    if name.contains('\0') || name.starts_with(['/', '\\']) {
        return None;
    }
    let mut parts: Vec<&str> = Vec::new();
    for part in name.split(['/', '\\']) {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            // Also keeps out NTFS's alternate streams ("a.bin:stream").
            _ if part.contains(':') => return None,
            _ => parts.push(part),
        }
    }
    if parts.is_empty() { None } else { Some(parts.join("/")) }
}

/// `%41` becomes `A`; `None` if the result is not UTF-8. A lone `%` stands for itself, as in many files.
pub(crate) fn percent_decode(uri: &str) -> Option<String> {
    String::from_utf8(percent_decode_bytes(uri)).ok()
}

pub(crate) fn percent_decode_bytes(uri: &str) -> Vec<u8> {
    let digit = |at: usize| uri.as_bytes().get(at).and_then(|&b| char::from(b).to_digit(16));
    let mut out = Vec::with_capacity(uri.len());
    let mut at = 0;
    while let Some(&byte) = uri.as_bytes().get(at) {
        match (byte, digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                out.push((high * 16 + low) as u8);
                at += 3;
            }
            _ => {
                out.push(byte);
                at += 1;
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn path_inside_stays_inside() {
        let of = |name: &str| path_inside(name);
        assert_eq!(of("a.bin").as_deref(), Some("a.bin"));
        assert_eq!(of("./sub//a.bin").as_deref(), Some("sub/a.bin"));
        assert_eq!(of("sub\\a.bin").as_deref(), Some("sub/a.bin"));
        assert_eq!(of("sub/../a.bin").as_deref(), Some("a.bin"));
        for out in [
            "../a.bin",
            "sub/../../a.bin",
            "/etc/passwd",
            "\\\\host\\a",
            "C:\\a.mtl",
            "C:a",
            "http://h/a",
            "a\0b",
            "",
            ".",
            "..",
        ] {
            assert_eq!(of(out), None, "{out:?}");
        }
    }

    #[test]
    fn percent_decoding() {
        assert_eq!(percent_decode("Box%20With%20Spaces.bin").as_deref(), Some("Box With Spaces.bin"));
        assert_eq!(percent_decode("%c3%A4").as_deref(), Some("ä"));
        assert_eq!(percent_decode("100%").as_deref(), Some("100%"));
        assert_eq!(percent_decode("%zz%4").as_deref(), Some("%zz%4"));
        assert_eq!(percent_decode("%ff"), None);
    }

    #[test]
    fn folders_and_large_files_are_refused() {
        let folder = Folder(PathBuf::from(env!("CARGO_MANIFEST_DIR")));
        assert_eq!(folder.read("src", 100).unwrap_err().kind(), io::ErrorKind::IsADirectory);
        assert_eq!(folder.read("Cargo.toml", 10).unwrap_err().kind(), io::ErrorKind::FileTooLarge);
        assert_eq!(folder.read("no such file", 10).unwrap_err().kind(), io::ErrorKind::NotFound);
        assert!(folder.read("Cargo.toml", 1 << 20).unwrap().starts_with(b"[package]"));
    }
}
