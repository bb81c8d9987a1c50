//! Which picture goes where.

use crate::arguments::FileArguments;
use crate::failure::Failure;
use crate::output::Output;
use crate::picture::PictureFormat;
use crate::render::load::is_standard_input;
use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};

/// A model and where its picture goes.
#[derive(Clone, Debug)]
pub(crate) struct Job {
    /// `None` for the demo scene.
    pub(crate) model: Option<PathBuf>,
    pub(crate) output: Output,
}

/// The jobs in the models' order, and the pictures' format. No two have the same output.
pub(crate) fn jobs(models: &[PathBuf], files: &FileArguments) -> Result<(Vec<Job>, PictureFormat), Failure> {
    if models.iter().filter(|path| is_standard_input(path)).count() > 1 {
        return Err(Failure::usage("standard input can be read once only").at("-"));
    }
    match (&files.output, &files.out_dir) {
        (Some(output), _) => one(models, output, files),
        (None, Some(folder)) => many(models, folder, files),
        (None, None) => Err(Failure::usage("there is nowhere to write to").help("give -o OUT, or --out-dir DIR")),
    }
}

fn one(models: &[PathBuf], output: &Path, files: &FileArguments) -> Result<(Vec<Job>, PictureFormat), Failure> {
    if models.len() > 1 {
        return Err(Failure::usage(format_args!("{} models do not go into one picture", models.len()))
            .at(format_args!("-o {}", output.display()))
            .help("give a folder for their pictures: --out-dir DIR"));
    }
    let destination = Output::of(output);
    let format = match (files.picture_format, &destination) {
        (Some(format), _) => format,
        (None, Output::Standard) => {
            return Err(Failure::usage("standard output has no name that would say what picture is wanted")
                .at("-o -")
                .help("say it: --picture-format png"));
        }
        (None, Output::File(path)) => PictureFormat::of(path)?,
    };
    if destination == Output::Standard && files.json {
        return Err(Failure::usage("standard output cannot take both the picture and the report")
            .at("-o - --json")
            .help("write the picture to a file"));
    }
    Ok((vec![Job { model: models.first().cloned(), output: destination }], format))
}

fn many(models: &[PathBuf], folder: &Path, files: &FileArguments) -> Result<(Vec<Job>, PictureFormat), Failure> {
    let format = files.picture_format.unwrap_or(PictureFormat::Png);
    if models.is_empty() {
        return Err(Failure::usage("there are no models to draw into the folder")
            .at(format_args!("--out-dir {}", folder.display()))
            .help("name models, or give -o picture.png for the demo scene"));
    }
    let mut taken: HashMap<PathBuf, &Path> = HashMap::with_capacity(models.len());
    let mut jobs = Vec::with_capacity(models.len());
    for model in models {
        let mut picture = folder.join(name(model, files.keep_folders)?).into_os_string();
        // Added, not set: chair.v2.glb is not chair.png.
        picture.push(format!(".{}", format.extension()));
        let picture = PathBuf::from(picture);
        if let Some(other) = taken.insert(picture.clone(), model) {
            let (a, b) = (other.display(), model.display());
            let help = if other == model {
                "name it once"
            } else if files.keep_folders || other.parent() == model.parent() {
                "draw them in two runs, with two folders"
            } else {
                "--keep-folders makes the models' folders in --out-dir, too"
            };
            return Err(Failure::usage(format_args!("two models would become the same picture: {a} and {b}"))
                .at(picture.display())
                .help(help));
        }
        jobs.push(Job { model: Some(model.clone()), output: Output::File(picture) });
    }
    Ok((jobs, format))
}

/// A picture's name, without its extension.
fn name(model: &Path, keep_folders: bool) -> Result<PathBuf, Failure> {
    if is_standard_input(model) {
        return Ok("stdin".into());
    }
    let no_name = || Failure::usage("this is no model's name").at(model.display());
    let stem = model.file_stem().ok_or_else(no_name)?;
    if !keep_folders {
        return Ok(stem.into());
    }
    let mut path = PathBuf::new();
    for part in model.parent().into_iter().flat_map(Path::components) {
        match part {
            Component::Normal(folder) => path.push(folder),
            Component::ParentDir => {
                return Err(Failure::usage(
                    "--keep-folders cannot keep `..`: the picture would lie outside of --out-dir",
                )
                .at(model.display())
                .help("run pineda in the folder that holds all of the models"));
            }
            Component::CurDir | Component::RootDir | Component::Prefix(_) => {}
        }
    }
    Ok(path.join(stem))
}
