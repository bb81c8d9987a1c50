//! One function for each `--shading`.

use super::stage::{Prop, Stage};
use super::{Plan, background, resolve};
use crate::arguments::Shading;
use crate::failure::Failure;
use crate::picture::Pixels;
use pineda::{ColorBuffer, NO_ID, Pass, Renderer, Shader, Target};
use pineda_looks::{Depth, Lambert, Normals, Studio, Vertex};

pub(crate) fn draw(stage: &Stage, plan: &Plan, renderer: &mut Renderer) -> Result<Pixels, Failure> {
    let camera = stage.camera;
    match plan.shading {
        Shading::Studio => {
            let studio = camera.studio();
            let shader = |prop: &Prop| Studio { base_color: prop.base_color, ..studio.clone() };
            let mut samples = vec![[0; 4]; plan.size.pixels() * (plan.oversampling * plan.oversampling) as usize];
            execute(stage, plan, renderer, shader, |target| Target {
                color: ColorBuffer::Rgba8Srgb(&mut samples),
                ..target
            })?;
            let pixels = resolve::average(&samples, plan.size, plan.oversampling);
            Ok(background::behind(pixels, plan.size, plan.background))
        }
        Shading::Lambert => {
            let clip_from_world = camera.clip_from_world;
            let shader = |prop: &Prop| Lambert { clip_from_world, base_color: prop.base_color, ..Lambert::default() };
            let mut pixels = vec![[0; 4]; plan.size.pixels()];
            execute(stage, plan, renderer, shader, |target| Target {
                color: ColorBuffer::Rgba8Srgb(&mut pixels),
                ..target
            })?;
            Ok(background::behind(pixels, plan.size, plan.background))
        }
        Shading::Normals => {
            let shader = |_: &Prop| Normals { clip_from_world: camera.clip_from_world };
            let mut pixels = vec![[0; 4]; plan.size.pixels()];
            execute(stage, plan, renderer, shader, |target| Target {
                color: ColorBuffer::Rgba8(&mut pixels),
                ..target
            })?;
            Ok(background::behind(pixels, plan.size, plan.background))
        }
        Shading::Depth => {
            let shader = |_: &Prop| distance(stage);
            let mut pixels = vec![[0.0; 4]; plan.size.pixels()];
            execute(stage, plan, renderer, shader, |target| Target {
                color: ColorBuffer::Rgba32F(&mut pixels),
                ..target
            })?;
            let codes = pixels.into_iter().map(|[gray, _, _, alpha]| depth_code((alpha != 0.0).then_some(gray)));
            Ok(Pixels::Gray16(codes.collect()))
        }
        Shading::Ids => ids(stage, plan, renderer),
    }
}

fn distance(stage: &Stage) -> Depth {
    let camera = stage.camera;
    Depth { clip_from_world: camera.clip_from_world, near: camera.near, far: camera.far }
}

/// `round(65534 depth)` of a depth in 0 to 1, and 65535 of none.
pub(crate) fn depth_code(depth: Option<f32>) -> u16 {
    depth.map_or(65535, |depth| (f64::from(depth) * 65534.0 + 0.5).clamp(0.0, 65534.0) as u16)
}

/// Red is the object, green the material; the triangle is blue + 65536 (65535 - alpha), so that small numbers are opaque.
fn ids(stage: &Stage, plan: &Plan, renderer: &mut Renderer) -> Result<Pixels, Failure> {
    const MOST: usize = 65536;
    let materials = stage.props.iter().map(|prop| prop.material + 1).max().unwrap_or_default();
    for (count, what) in [(stage.props.len(), "objects"), (materials, "materials")] {
        if count > MOST {
            return Err(Failure::data(format_args!("the model has {count} {what}; an ids picture can name {MOST}")));
        }
    }
    let (mut draws, mut triangles) = (vec![0; plan.size.pixels()], vec![0; plan.size.pixels()]);
    execute(
        stage,
        plan,
        renderer,
        |_| distance(stage),
        |target| Target { draw_ids: Some(&mut draws), triangle_ids: Some(&mut triangles), ..target },
    )?;
    let number = |(draw, triangle): (u32, u32)| match draw {
        NO_ID => [0; 4],
        _ => {
            let material = stage.props[draw as usize].material as u16;
            [draw as u16, material, triangle as u16, 65535 - (triangle >> 16) as u16]
        }
    };
    Ok(Pixels::Rgba16(draws.into_iter().zip(triangles).map(number).collect()))
}

/// Draws each object with its own shader to the target that `buffers` completes.
fn execute<'a, S: Shader<Vertex = Vertex>>(
    stage: &Stage,
    plan: &Plan,
    renderer: &mut Renderer,
    shader: impl Fn(&Prop) -> S,
    buffers: impl FnOnce(Target<'a>) -> Target<'a>,
) -> Result<(), Failure> {
    let shaders: Vec<S> = stage.props.iter().map(shader).collect();
    let mut pass = Pass::new();
    for (prop, shader) in stage.props.iter().zip(&shaders) {
        pass.draw(shader, prop.mesh(), prop.state());
    }
    let target = Target::new(plan.size.width * plan.oversampling, plan.size.height * plan.oversampling);
    renderer.render(&pass, &mut buffers(target))?;
    Ok(())
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
