//! `pineda render`: a model, framed and shaded as the project's render conventions define.

mod background;
mod modes;
mod resolve;
mod stage;

pub(crate) use modes::depth_code;

use crate::arguments::{RenderArguments, Shading};
use crate::failure::Failure;
use crate::output;
use crate::picture::{Format, Picture};
use crate::values::{Background, Size};
use pineda::{MAX_SIZE, Renderer};
use stage::Stage;
use std::io::Write;

/// The angle up to which faces are smoothed into each other in the default look, in degrees.
const DEFAULT_CREASE: f64 = 40.0;

pub(crate) fn run(arguments: &RenderArguments, renderer: &mut Renderer) -> Result<(), Failure> {
    let format = Format::of(&arguments.output)?;
    let plan = Plan::new(arguments, format)?;
    output::check(&arguments.output)?;
    let stage = Stage::new(scene(arguments)?, arguments, plan.crease)?;
    let picture = Picture { size: arguments.size, pixels: modes::draw(&stage, &plan, renderer)? };
    output::write(&arguments.output, &picture.encode(format)?)
}

/// What the options amount to together.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plan {
    shading: Shading,
    size: Size,
    /// Samples a pixel in each direction.
    oversampling: u32,
    background: Background,
    /// 0 for flat faces.
    crease: f64,
}

impl Plan {
    fn new(arguments: &RenderArguments, format: Format) -> Result<Self, Failure> {
        let (shading, size) = (arguments.shading, arguments.size);
        let is_studio = shading == Shading::Studio;
        let oversampling = match arguments.samples.as_deref() {
            Some("16") => 4,
            Some("4") => 2,
            None if is_studio => 2,
            _ => 1,
        };
        if oversampling > 1 && !is_studio {
            return Err(Failure::usage("anti-aliasing is for studio shading: the other modes are exact")
                .at("--samples")
                .help("leave --samples away, or give --shading studio"));
        }
        if size.width.max(size.height) * oversampling > MAX_SIZE {
            let most = MAX_SIZE / oversampling;
            let samples = oversampling * oversampling;
            return Err(Failure::usage(format_args!(
                "with {samples} samples a pixel a picture has at most {most} pixels a side"
            ))
            .at(format_args!("--size {}x{}", size.width, size.height))
            .help("give a smaller --size, or --samples 1"));
        }
        if matches!(shading, Shading::Depth | Shading::Ids) && arguments.background.is_some() {
            return Err(Failure::usage("this shading shows numbers: it has no background")
                .at("--background")
                .help("leave --background away"));
        }
        if shading == Shading::Ids && format == Format::Ppm {
            return Err(Failure::usage("PPM has three channels, and ids need four")
                .at(format_args!("-o {}", arguments.output.display()))
                .help("name the output .png"));
        }
        let default_background = if is_studio { Background::Studio } else { Background::Transparent };
        Ok(Self {
            shading,
            size,
            oversampling,
            background: arguments.background.unwrap_or(default_background),
            crease: arguments.smooth.unwrap_or(if is_studio { DEFAULT_CREASE } else { 0.0 }),
        })
    }
}

fn scene(arguments: &RenderArguments) -> Result<pineda_scene::Scene, Failure> {
    let Some(path) = &arguments.model else { return Ok(pineda_scene::demo()) };
    let loaded = pineda_scene::load(path).map_err(|error| match error {
        pineda_scene::Error::File { path, error } => {
            Failure::data(format_args!("the model {}", predicate(&error))).at(path.display())
        }
        error => Failure::data(error).at(path.display()),
    })?;
    let mut notes = loaded.notes;
    notes.extend(not_drawn(&loaded.scene));
    if loaded.scene.objects.iter().all(|object| object.triangles.is_empty()) {
        let reasons = notes.join("; ");
        return Err(Failure::data(format_args!("the model has nothing to draw ({reasons})")).at(path.display()));
    }
    for note in &notes {
        // Nobody is left to tell if standard error is closed.
        let _ = writeln!(std::io::stderr(), "note: {note}");
    }
    Ok(loaded.scene)
}

/// What a scene has that no shading shows yet, one line each.
fn not_drawn(scene: &pineda_scene::Scene) -> Vec<String> {
    let sum = |count: fn(&pineda_scene::Object) -> usize| scene.objects.iter().map(count).sum::<usize>();
    let [strokes, images] = [sum(|o| o.lines.len() + o.points.len()), scene.images.len()];
    let mut drawn = vec![false; scene.materials.len()];
    scene.objects.iter().for_each(|object| drawn[object.material] = true);
    let is_blended = |(material, drawn): &(&pineda_scene::Material, bool)| {
        *drawn && material.alpha_mode != pineda_scene::AlphaMode::Opaque
    };
    let blended = scene.materials.iter().zip(drawn).filter(is_blended).count();
    let mut lines = Vec::new();
    let mut line = |count: usize, what: &str, one: &str, many: &str, how: &str| {
        if count > 0 {
            lines.push(format!("{what} not drawn yet: {count} {} {how}", if count == 1 { one } else { many }));
        }
    };
    line(strokes, "lines and points are", "line or point", "lines and points", "skipped");
    line(images, "textures are", "image", "images", "ignored");
    line(blended, "transparency is", "material", "materials", "drawn opaque");
    lines
}

/// What is wrong, as the end of a sentence that begins with "the model".
fn predicate(error: &pineda_scene::Error) -> String {
    use pineda_scene::Error;
    match error {
        Error::Read { .. } | Error::UnknownFormat | Error::Limit { .. } | Error::NothingToDraw { .. } => {
            error.to_string()
        }
        _ => format!("cannot be read: {error}"),
    }
}
