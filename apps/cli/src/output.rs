//! Writing a file whole or not at all.

use crate::failure::Failure;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Refuses what cannot be written, before time is spent on drawing it.
pub(crate) fn check(path: &Path) -> Result<(), Failure> {
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(cannot_write(path, "its folder does not exist").help("make the folder first"));
    }
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => Err(cannot_write(path, "it is a folder").help("name a file in it")),
        Ok(there) if there.permissions().readonly() => {
            Err(cannot_write(path, "the file that is there is read-only").help("make it writable, or name another"))
        }
        _ => Ok(()),
    }
}

/// Writes `bytes` to a file beside `path` and then gives it its name, so that `path` is always either what it was or whole.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    try_write(path, bytes).map_err(|error| cannot_write(path, error))
}

fn try_write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A link stays one: what it leads to is replaced.
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if fs::metadata(&path).is_ok_and(|there| !there.is_file()) {
        // A pipe or a device: there is nothing to rename.
        return OpenOptions::new().write(true).open(&path)?.write_all(bytes);
    }
    let mut unfinished = Unfinished::create(&path)?;
    unfinished.file.write_all(bytes)?;
    unfinished.file.sync_data()?;
    unfinished.finish(&path)
}

fn cannot_write(path: &Path, reason: impl std::fmt::Display) -> Failure {
    Failure::data(format_args!("the picture cannot be written: {reason}")).at(path.display())
}

/// A file that is removed again unless it is finished.
struct Unfinished {
    path: PathBuf,
    file: File,
    finished: bool,
}

impl Unfinished {
    /// In the folder of `path`, so that renaming it is one step.
    fn create(path: &Path) -> io::Result<Self> {
        let path = path.with_file_name(format!(".pineda-{}.part", std::process::id()));
        let file = OpenOptions::new().write(true).create_new(true).open(&path)?;
        Ok(Self { path, file, finished: false })
    }

    fn finish(mut self, path: &Path) -> io::Result<()> {
        fs::rename(&self.path, path)?;
        self.finished = true;
        Ok(())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if !self.finished {
            // Nothing better is left to do if this fails.
            let _ = fs::remove_file(&self.path);
        }
    }
}
