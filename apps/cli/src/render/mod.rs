//! `pineda render`: models, framed and shaded as the project's render conventions define.

mod batch;
mod camera;
mod develop;
mod draw;
mod environment;
mod load;
mod names;
mod plan;
mod progress;
mod report;
mod upright;

pub(crate) use draw::depth_code;
pub(crate) use load::{failure, model};

use crate::arguments::{How, RenderArguments, Shading};
use crate::failure::Failure;
use crate::output::{self, Output};
use crate::picture::Picture;
use names::Job;
use pineda::Renderer;
use pineda_looks::Stage;
use pineda_looks::pbr::Environment;
use pineda_scene::Loaded;
use plan::Plan;
use progress::Progress;
use report::{Outcome, Report};
use std::io::Write;
use std::path::Path;
use std::time::Instant;

pub(crate) fn run(arguments: &RenderArguments, how: &How) -> Result<(), Failure> {
    let (jobs, format) = names::jobs(&arguments.models, &arguments.files)?;
    let plan = Plan::new(arguments, format)?;
    let environment = environment::of(arguments, how)?;
    let draw = |job: &Job, renderer: &mut Renderer| draw(job, &plan, environment.as_ref(), arguments, renderer);
    match &arguments.files.out_dir {
        Some(_) => many(&jobs, &plan, arguments, how, draw),
        None => one(&jobs[0], &plan, arguments, how, draw),
    }
}

/// Draws and writes a picture; see [`draw`].
trait Draw: Fn(&Job, &mut Renderer) -> Result<Vec<String>, Failure> + Sync {}

impl<F: Fn(&Job, &mut Renderer) -> Result<Vec<String>, Failure> + Sync> Draw for F {}

/// One picture: what is wrong with it is what is wrong.
fn one(job: &Job, plan: &Plan, arguments: &RenderArguments, how: &How, draw: impl Draw) -> Result<(), Failure> {
    job.output.check()?;
    let start = Instant::now();
    let drawn = how.renderer().and_then(|mut renderer| draw(job, &mut renderer));
    if !arguments.files.json {
        Progress::new(1).lines(&lines(drawn.as_deref().unwrap_or_default(), None));
        return drawn.map(|_| ());
    }
    let outcome = match drawn {
        Ok(notes) => Outcome::Drawn { notes, time: start.elapsed() },
        Err(failure) => Outcome::Failed(failure),
    };
    let report = Report::new(std::slice::from_ref(job), std::slice::from_ref(&outcome), plan.size).json()?;
    print(&report)?;
    if let Outcome::Failed(failure) = outcome { Err(failure) } else { Ok(()) }
}

/// Many pictures: what is wrong with some is listed when the others are done.
fn many(jobs: &[Job], plan: &Plan, arguments: &RenderArguments, how: &How, draw: impl Draw) -> Result<(), Failure> {
    for job in jobs {
        if let Output::File(path) = &job.output {
            output::make_folder(path.parent().unwrap_or(Path::new("")))?;
        }
    }
    let files = &arguments.files;
    let progress = Progress::new(jobs.len());
    let outcomes = batch::run(jobs, how, files.jobs.map(usize::from), &progress, |job, renderer| {
        if files.resume && is_done(job) {
            return Outcome::Skipped;
        }
        let start = Instant::now();
        match job.output.check().and_then(|()| draw(job, renderer)) {
            Ok(notes) => {
                if !files.json {
                    progress.lines(&lines(&notes, job.model.as_deref()));
                }
                Outcome::Drawn { notes, time: start.elapsed() }
            }
            Err(failure) => Outcome::Failed(failure),
        }
    })?;
    if files.json {
        print(&Report::new(jobs, &outcomes, plan.size).json()?)?;
    }
    let failures: Vec<&Failure> =
        outcomes.iter().filter_map(|o| if let Outcome::Failed(failure) = o { Some(failure) } else { None }).collect();
    for failure in &failures {
        // Nobody is left to tell if standard error is closed.
        let _ = write!(std::io::stderr(), "{failure}");
    }
    match failures.len() {
        0 => Ok(()),
        failed => Err(Failure::data(format_args!("{failed} of {} models could not be drawn", jobs.len()))
            .help("the reasons are above; the other pictures are written")),
    }
}

/// Draws and writes a picture. The result is what was left out of the model.
fn draw(
    job: &Job,
    plan: &Plan,
    environment: Option<&Environment>,
    arguments: &RenderArguments,
    renderer: &mut Renderer,
) -> Result<Vec<String>, Failure> {
    let loaded = match &job.model {
        None => Loaded { scene: pineda_scene::demo(), notes: Vec::new() },
        Some(path) => load::posed(path, arguments.files.model_format, &plan.pose)?,
    };
    let place = |failure: Failure| match &job.model {
        Some(path) => failure.at_first(path.display()),
        None => failure,
    };
    let Loaded { mut scene, notes } = loaded;
    if plan.pbr.own_lights && scene.lights.is_empty() {
        let without = Failure::data("the model has no lights of its own");
        return Err(place(without.help("leave --lights model away; `pineda info MODEL` lists a model's lights")));
    }
    let aspect = f64::from(plan.size.width) / f64::from(plan.size.height);
    let mut framing = camera::framing(&arguments.camera, &scene, aspect).map_err(place)?;
    if plan.shading == Shading::Pbr {
        upright::turn(&mut scene, &mut framing, arguments.camera.up.0);
    }
    let stage = Stage::new(&mut scene, &framing, aspect, plan.crease)
        .ok_or_else(|| Failure::data("the model has nothing to draw"))
        .map_err(place)?;
    let pixels = draw::draw(&stage, &scene, plan, environment, renderer).map_err(place)?;
    let picture = Picture { size: plan.size, pixels };
    job.output.write(&picture.encode(plan.format, plan.quality)?)?;
    Ok(notes)
}

/// Whether a picture is there and no older than its model.
fn is_done(job: &Job) -> bool {
    let (Some(model), Output::File(picture)) = (&job.model, &job.output) else { return false };
    let changed = |path: &Path| std::fs::metadata(path).and_then(|there| there.modified()).ok();
    matches!((changed(model), changed(picture)), (Some(model), Some(picture)) if picture >= model)
}

fn lines(notes: &[String], model: Option<&Path>) -> Vec<String> {
    let line = |note: &String| match model {
        Some(path) => format!("note: {}: {note}", path.display()),
        None => format!("note: {note}"),
    };
    notes.iter().map(line).collect()
}

fn print(text: &str) -> Result<(), Failure> {
    let written = std::io::stdout().write_all(text.as_bytes());
    written.map_err(|error| Failure::data(format_args!("standard output cannot be written: {error}")))
}
