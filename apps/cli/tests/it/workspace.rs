//! A folder for one test, the command run in it, and pictures read back.

use std::fs;
use std::io::Cursor;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// An empty folder, removed at the end.
pub(crate) struct Workspace(PathBuf);

/// What a run of the command gave.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Workspace {
    pub(crate) fn new(name: &str) -> Self {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    /// The command in this folder.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pineda"));
        command.args(arguments).current_dir(&self.0).stdin(Stdio::null());
        command
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Run {
        let output = self.command(arguments).output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        let run = Run {
            code: output.status.code().expect("not killed by a signal"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        };
        assert!(!run.stderr.contains("panicked"), "{arguments:?}: {}", run.stderr);
        run
    }

    /// Runs the command, which must succeed without a word.
    pub(crate) fn succeed(&self, arguments: &[&str]) {
        let run = self.run(arguments);
        assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""), "{arguments:?}");
    }

    /// Runs the command, which must fail with `code`, a message that begins with "error: " and contains each of `parts`, nothing on standard
    /// output, and no new file.
    pub(crate) fn fail(&self, arguments: &[&str], code: i32, parts: &[&str]) {
        let before = self.files();
        let run = self.run(arguments);
        assert_eq!(run.code, code, "{arguments:?}: {run:?}");
        assert!(run.stderr.starts_with("error: "), "{arguments:?}: {run:?}");
        for part in parts {
            assert!(run.stderr.contains(part), "{arguments:?}: no {part:?} in {}", run.stderr);
        }
        assert_eq!(run.stdout, "", "{arguments:?}");
        assert_eq!(self.files(), before, "{arguments:?}");
    }

    /// The names in this folder, sorted.
    pub(crate) fn files(&self) -> Vec<String> {
        let names = fs::read_dir(&self.0).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    /// Width, height, colour type, bits of a channel, and the bytes of the pixels of a PNG.
    pub(crate) fn png(&self, name: &str) -> Png {
        let mut reader = png::Decoder::new(Cursor::new(self.read(name))).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        Png { size: [info.width, info.height], color: info.color_type, bits: info.bit_depth as u8, data }
    }
}

impl Drop for Workspace {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A picture read back.
#[derive(Debug, PartialEq)]
pub(crate) struct Png {
    pub(crate) size: [u32; 2],
    pub(crate) color: png::ColorType,
    pub(crate) bits: u8,
    pub(crate) data: Vec<u8>,
}

impl Png {
    /// The pixels of `N` 8-bit channels.
    pub(crate) fn pixels8<const N: usize>(&self) -> Vec<[u8; N]> {
        assert_eq!((self.bits, self.color.samples()), (8, N));
        self.data.as_chunks().0.to_vec()
    }

    /// The pixels of `N` 16-bit channels.
    pub(crate) fn pixels16<const N: usize>(&self) -> Vec<[u16; N]> {
        assert_eq!((self.bits, self.color.samples()), (16, N));
        let words: Vec<u16> = self.data.as_chunks().0.iter().map(|&word| u16::from_be_bytes(word)).collect();
        words.as_chunks().0.to_vec()
    }
}
