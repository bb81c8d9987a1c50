//! Files that are wrong on purpose, each made from a good one, and what the command makes of each: an error that says what is wrong and where, or a picture of what is good. Never a panic, and within
//! five seconds and a GiB of memory, whatever the file asks for.
//!
//! Which there are, and what becomes of them, is data: one list a kind of file. To look at the files:
//!
//!     PINEDA_FILES=1 cargo test -p pineda-cli malformed    # then target/tmp/malformed

mod geometry;
mod gltf;
mod gltf_moving;
mod gltf_packed;
mod make;
mod mesh_files;
mod panoramas;
#[cfg(unix)]
mod places;
mod raster;
mod run;
mod textures;
mod threemf;

use run::{Outcome, run};
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

/// What must become of a file.
#[derive(Clone, Copy, Debug)]
enum Wanted {
    /// Exit code 1, the file's name, and all of this in the message.
    Error(&'static [&'static str]),
    /// A picture with something in it, and a note for each of these; without any, not a word.
    Picture(&'static [&'static str]),
    /// The same, but nothing that is large enough, or near enough, to be seen.
    Blank(&'static [&'static str]),
}
use Wanted::{Blank, Error, Picture};

/// A file that is wrong, and the files beside it.
struct Case {
    /// What is wrong with it; the name of its folder, too.
    name: &'static str,
    /// The first is the one that the command reads.
    files: Vec<(&'static str, Vec<u8>)>,
    /// What the command is asked for beside the file and a small picture.
    options: &'static [&'static str],
    wanted: Wanted,
}

/// One file, drawn without any light.
fn case(name: &'static str, file: &'static str, bytes: impl Into<Vec<u8>>, wanted: Wanted) -> Case {
    Case { name, files: vec![(file, bytes.into())], options: &["--shading", "unlit"], wanted }
}

impl Case {
    fn beside(mut self, file: &'static str, bytes: impl Into<Vec<u8>>) -> Self {
        self.files.push((file, bytes.into()));
        self
    }

    fn options(self, options: &'static [&'static str]) -> Self {
        Self { options, ..self }
    }
}

/// Every list that there is.
fn all() -> [Vec<Case>; 9] {
    [
        gltf::cases(),
        gltf_moving::cases(),
        gltf_packed::cases(),
        geometry::cases(),
        textures::cases(),
        mesh_files::cases(),
        panoramas::cases(),
        raster::cases(),
        threemf::cases(),
    ]
}

/// A folder for one list's files; with `PINEDA_FILES` it stays.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("malformed").join(name);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if std::env::var_os("PINEDA_FILES").is_none() {
            let _ = fs::remove_dir_all(&self.0);
        }
    }
}

/// Draws every file of a list, and names all at once of which something else became.
fn check(list: &str, cases: &[Case]) {
    let root = Folder::new(list);
    let problems: Vec<String> = cases
        .iter()
        .filter_map(|case| {
            let folder = root.0.join(case.name);
            fs::create_dir(&folder).unwrap();
            for (name, bytes) in &case.files {
                fs::write(folder.join(name), bytes).unwrap();
            }
            let problem = problem(&folder, case.files[0].0, case.options, case.wanted)?;
            Some(format!("{list}/{}: {problem}", case.name))
        })
        .collect();
    assert!(problems.is_empty(), "{} of {}:\n{}", problems.len(), cases.len(), problems.join("\n"));
}

/// What is not as it should be with a file that is in a folder.
fn problem(folder: &Path, file: &str, options: &[&str], wanted: Wanted) -> Option<String> {
    let command = match options {
        ["raster", ..] => vec!["raster", file, "-o", "a.png"],
        ["--environment", ..] => vec!["render", "-o", "a.png", "--size", "8x8", "--environment", file],
        _ => vec!["render", file, "-o", "a.png", "--size", "48x48"],
    };
    let more = match options {
        ["raster", more @ ..] | ["--environment", more @ ..] | more => more,
    };
    let Outcome { code, stderr } = match run(folder, &[&command, more, &["--threads", "2"]].concat()) {
        Ok(outcome) => outcome,
        Err(problem) => return Some(problem),
    };
    let picture = folder.join("a.png");
    let said = |parts: &[&str]| parts.iter().find(|part| !stderr.contains(**part)).map(|part| format!("no {part:?}"));
    let problem = match wanted {
        Error(_) if code != Some(1) || picture.exists() => Some("should be an error".to_owned()),
        Error(_) if !stderr.starts_with("error: ") || !stderr.contains(&format!("  where: {file}")) => {
            Some("does not say where".to_owned())
        }
        Error(parts) => said(parts),
        Picture(_) | Blank(_) if code != Some(0) => Some("should be drawn".to_owned()),
        Picture([]) | Blank([]) if !stderr.is_empty() => Some("should be without notes".to_owned()),
        Picture(_) if !shows_something(&picture) => Some("should show something".to_owned()),
        Blank(_) if shows_something(&picture) => Some("should show nothing".to_owned()),
        Picture(notes) | Blank(notes) => said(notes),
    };
    // One line or two for people, however strange the file's own words are.
    let unreadable = stderr.len() > 1000 || stderr.chars().any(|c| c.is_control() && c != '\n');
    let problem = problem.or_else(|| unreadable.then(|| "its message cannot be read".to_owned()));
    problem.map(|problem| format!("{problem}; exit code {code:?}, said:\n{stderr}"))
}

/// Whether not all pixels are the same.
fn shows_something(picture: &Path) -> bool {
    let Ok(bytes) = fs::read(picture) else { return false };
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut data).unwrap();
    let bytes = info.color_type.samples() * info.bit_depth as usize / 8;
    data[..info.buffer_size()].chunks(bytes).any(|pixel| pixel != &data[..bytes])
}

#[test]
fn malformed_gltf() {
    check("gltf", &gltf::cases());
}

#[test]
fn malformed_gltf_that_moves() {
    check("gltf-moving", &gltf_moving::cases());
}

#[test]
fn malformed_gltf_that_is_packed() {
    check("gltf-packed", &gltf_packed::cases());
}

#[test]
fn malformed_geometry() {
    check("geometry", &geometry::cases());
}

#[test]
fn malformed_textures() {
    check("textures", &textures::cases());
}

#[test]
fn malformed_obj_stl_and_ply() {
    check("meshes", &mesh_files::cases());
}

#[test]
fn malformed_panoramas() {
    check("panoramas", &panoramas::cases());
}

#[test]
fn malformed_raster() {
    check("raster", &raster::cases());
}

#[test]
fn malformed_3mf() {
    check("3mf", &threemf::cases());
}

#[test]
fn malformed_files_are_many_and_each_has_its_name() {
    let names: Vec<_> = all().iter().flatten().map(|case| case.name).collect();
    assert!(names.len() >= 400, "{}", names.len());
    assert_eq!(names.iter().collect::<HashSet<_>>().len(), names.len());
}
