//! Writing a file whole or not at all.

use crate::failure::Failure;
use std::fs::{self, File, OpenOptions};
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Where a picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// `-`.
    Standard,
    File(PathBuf),
}

impl Output {
    pub(crate) fn of(path: &Path) -> Self {
        if path == Path::new("-") { Self::Standard } else { Self::File(path.to_owned()) }
    }

    /// Refuses what cannot be written, before time is spent on drawing it.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        match self {
            Self::Standard if io::stdout().is_terminal() => {
                Err(Failure::usage("a picture's bytes are nothing for a terminal")
                    .at("-o -")
                    .help("send them somewhere: add `> picture.png`, or name a file"))
            }
            Self::Standard => Ok(()),
            Self::File(path) => check(path),
        }
    }

    pub(crate) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        match self {
            Self::Standard => {
                let mut out = io::stdout().lock();
                let written = out.write_all(bytes).and_then(|()| out.flush());
                written.map_err(|error| cannot_write(Path::new("standard output"), error))
            }
            Self::File(path) => write(path, bytes),
        }
    }
}

/// Makes a folder for pictures, and those that it is in.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| {
        Failure::data(format_args!("the folder for pictures cannot be made: {error}")).at(path.display())
    })
}

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
        // Several threads may write to one folder.
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path = path.with_file_name(format!(".pineda-{}-{number}.part", std::process::id()));
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
