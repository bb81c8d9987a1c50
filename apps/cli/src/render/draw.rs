//! One way for each kind of `--shading`: what is drawn into, and what becomes of it.

use super::develop;
use super::plan::Plan;
use crate::arguments::Shading;
use crate::failure::Failure;
use crate::heat;
use crate::picture::Pixels;
use pineda::{ColorBuffer, NO_ID, Pass, PrimitiveTopology, Renderer, Target};
use pineda_looks::pbr::{self, Environment};
use pineda_looks::{Layer, Mode, Show, Stage};
use pineda_scene::Scene;

/// The picture of a stage whose objects came from `scene`.
pub(crate) fn draw(
    stage: &Stage,
    scene: &Scene,
    plan: &Plan,
    environment: Option<&Environment>,
    renderer: &mut Renderer,
) -> Result<Pixels, Failure> {
    match plan.shading {
        Shading::Pbr => {
            let size = [plan.size.width, plan.size.height];
            // Made before anything was drawn.
            let Some(environment) = environment else { return Err(Failure::data("there is no light")) };
            Ok(develop::light(pbr::draw(stage, scene, environment, &plan.pbr, size, renderer)?, plan))
        }
        Shading::Unlit => Ok(develop::light(colors(stage, scene, Mode::Unlit, plan, renderer)?, plan)),
        Shading::Lambert => Ok(develop::light(colors(stage, scene, Mode::Lambert, plan, renderer)?, plan)),
        Shading::Wireframe => Ok(develop::light(colors(stage, scene, Mode::Wireframe, plan, renderer)?, plan)),
        Shading::Matcap => Ok(develop::light(colors(stage, scene, Mode::Matcap, plan, renderer)?, plan)),
        Shading::Normals => Ok(develop::numbers(colors(stage, scene, Mode::Normals, plan, renderer)?, plan)),
        Shading::Uv => Ok(develop::numbers(colors(stage, scene, Mode::Uv, plan, renderer)?, plan)),
        Shading::Depth => depth(colors(stage, scene, Mode::Depth, plan, renderer)?, plan),
        Shading::Overdraw => {
            let counts = colors(stage, scene, Mode::Overdraw, plan, renderer)?;
            // Sums of ones are exact in f32.
            Ok(counted(counts.into_iter().map(|[count, ..]| count as u32).collect(), heat::heat, plan))
        }
        Shading::Coverage => {
            let mut hits = vec![0; plan.size.pixels()];
            // Each object once: what is cut out is drawn twice in other modes.
            let mode = Mode::Overdraw;
            execute(stage, scene, mode, plan, renderer, |target| Target { hits: Some(&mut hits), ..target })?;
            Ok(counted(hits, heat::count_color, plan))
        }
        Shading::Ids => ids(stage, scene, plan, renderer),
    }
}

/// What a mode's shaders return, multiplied by alpha.
fn colors(
    stage: &Stage,
    scene: &Scene,
    mode: Mode,
    plan: &Plan,
    renderer: &mut Renderer,
) -> Result<Vec<[f32; 4]>, Failure> {
    let mut pixels = vec![[0.0; 4]; plan.size.pixels()];
    let color = ColorBuffer::Rgba32F(&mut pixels);
    execute(stage, scene, mode, plan, renderer, |target| Target { color, ..target })?;
    Ok(pixels)
}

/// Draws to the target that `buffers` completes. The result is what each draw shows, by its number: object, and the number of its first triangle, line or point among all of the object's.
fn execute<'a>(
    stage: &Stage,
    scene: &Scene,
    mode: Mode,
    plan: &Plan,
    renderer: &mut Renderer,
    buffers: impl FnOnce(Target<'a>) -> Target<'a>,
) -> Result<Vec<[u32; 2]>, Failure> {
    let show = Show::new(stage, scene, mode, plan.textures)?;
    let mut pass = Pass::new();
    let layers = show.record(stage, &mut pass);
    let target = Target { samples: plan.samples, ..Target::new(plan.size.width, plan.size.height) };
    renderer.render(&pass, &mut buffers(target))?;
    Ok(layers.iter().map(shown).collect())
}

fn shown(layer: &Layer<'_>) -> [u32; 2] {
    let [triangles, lines, _] = layer.prop.counts();
    let first = match layer.state.topology {
        PrimitiveTopology::LineList => triangles,
        PrimitiveTopology::PointList => triangles + lines,
        _ => 0,
    };
    [layer.number as u32, first as u32]
}

fn depth(pixels: Vec<[f32; 4]>, plan: &Plan) -> Result<Pixels, Failure> {
    if plan.format.is_float() {
        return Ok(Pixels::Rgba32F(pixels));
    }
    let codes = pixels.into_iter().map(|[gray, _, _, alpha]| depth_code((alpha != 0.0).then_some(gray)));
    Ok(Pixels::Gray16(codes.collect()))
}

/// `round(65534 depth)` of a depth in 0 to 1, and 65535 of none.
pub(crate) fn depth_code(depth: Option<f32>) -> u16 {
    depth.map_or(65535, |depth| (f64::from(depth) * 65534.0 + 0.5).clamp(0.0, 65534.0) as u16)
}

/// Counts as colours; as they are where the format holds floats.
fn counted(counts: Vec<u32>, color: fn(u32) -> [u8; 3], plan: &Plan) -> Pixels {
    if plan.format.is_float() {
        let gray = |count: u32| [count as f32, count as f32, count as f32, 1.0];
        return Pixels::Rgba32F(counts.into_iter().map(gray).collect());
    }
    Pixels::Rgb8(counts.into_iter().map(color).collect())
}

/// Red is the object, green the material; the triangle is blue + 65536 (65535 - alpha), so that small numbers are opaque. As floats: object, material, triangle, and 1.
fn ids(stage: &Stage, scene: &Scene, plan: &Plan, renderer: &mut Renderer) -> Result<Pixels, Failure> {
    const MOST: usize = 65536;
    let materials = stage.props.iter().map(|prop| prop.material + 1).max().unwrap_or_default();
    for (count, what) in [(stage.props.len(), "objects"), (materials, "materials")] {
        if count > MOST {
            return Err(Failure::data(format_args!("the model has {count} {what}; an ids picture can name {MOST}")));
        }
    }
    let (mut draws, mut triangles) = (vec![0; plan.size.pixels()], vec![0; plan.size.pixels()]);
    let shown = execute(stage, scene, Mode::Depth, plan, renderer, |target| Target {
        draw_ids: Some(&mut draws),
        triangle_ids: Some(&mut triangles),
        ..target
    })?;
    let numbers = draws.into_iter().zip(triangles).map(|(draw, triangle)| {
        (draw != NO_ID).then(|| {
            let [object, first] = shown[draw as usize];
            [object, stage.props[object as usize].material as u32, first + triangle]
        })
    });
    if plan.format.is_float() {
        let floats = |[object, material, triangle]: [u32; 3]| [object as f32, material as f32, triangle as f32, 1.0];
        return Ok(Pixels::Rgba32F(numbers.map(|pixel| pixel.map_or([0.0; 4], floats)).collect()));
    }
    let codes = |[object, material, triangle]: [u32; 3]| {
        [object as u16, material as u16, triangle as u16, 65535 - (triangle >> 16) as u16]
    };
    Ok(Pixels::Rgba16(numbers.map(|pixel| pixel.map_or([0; 4], codes)).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_codes() {
        let codes = [Some(-0.1), Some(0.0), Some(0.5), Some(1.0), Some(1.1), Some(f32::NAN), None].map(depth_code);
        assert_eq!(codes, [0, 0, 32767, 65534, 65534, 0, 65535]);
    }
}
