//! Physically based pictures: glTF 2.0's materials in a photographer's studio.
//!
//! ```text
//! scene -> Stage      objects where the camera wants them
//!       -> Coating    each material's numbers and textures (`material.rs`)
//! studio -> Environment   light from all around, filtered by roughness (`studio.rs`, `environment.rs`)
//! stage  -> Lamp          the scene's own lights, on request (`lamps.rs`)
//!        -> Caster        what hides light: props, less what is cut out of them (`caster.rs`)
//!        -> Shadow        what the key light sees (`shadow.rs`)
//!        -> Occlusion     what is hidden from light from all around (`occlusion.rs`)
//!        -> Ground        both shadows on the ground (`ground.rs`, `overhead.rs`), the key light's where there is any (`nearest.rs`)
//!        -> Behind        the opaque part, for what lets light through (`transmission.rs`)
//! all of it -> Surface    the fragment stage (`shader.rs`, `brdf.rs`, `tone.rs`)
//! ```
//!
//! [`draw`] goes through these steps in order; each is drawn with `pineda` itself.

mod brdf;
mod caster;
mod environment;
mod ground;
mod lamps;
mod material;
mod nearest;
mod occlusion;
mod overhead;
mod paint;
mod shader;
mod shadow;
mod studio;
mod tone;
mod transmission;

pub use environment::Environment;
pub use tone::ToneMapping;

use crate::gallery::Gallery;
use crate::layers::sides;
use crate::stage::{Prop, Stage};
use caster::Caster;
use ground::Ground;
use lamps::Lamp;
use material::Coating;
use occlusion::Occlusion;
use pineda::{
    Blend, ColorBuffer, DepthState, DrawState, Error, Indices, MAX_SIZE, Mesh, Pass, Renderer, Samples, Target,
};
use pineda_scene::{AlphaMode, Scene};
use shader::{Light, Mapped, Masked, Plain, Surface};
use shadow::Shadow;
use transmission::Behind;

/// How a picture is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PbrSettings {
    /// Samples a pixel.
    pub samples: Samples,
    /// What light is multiplied by before it is toned.
    pub exposure: f32,
    /// How light beyond 1 is brought into the picture.
    pub tone_mapping: ToneMapping,
    /// Whether the key light shines, where the environment is the studio, with its shadow.
    pub shadows: bool,
    /// Whether the scene's own lights shine, beside the environment: a white, matt surface on which pi lux fall is white. They cast no shadows.
    pub own_lights: bool,
    /// Whether a shadow falls on the ground below the model. Seen from below, there is none.
    pub ground: bool,
    /// Whether what is near hides light from all around.
    pub occlusion: bool,
    /// Whether textures are looked up in smaller levels where they are seen small.
    pub mipmaps: bool,
}

impl Default for PbrSettings {
    /// Everything, with four samples.
    fn default() -> Self {
        Self {
            samples: Samples::Four,
            exposure: 1.0,
            tone_mapping: ToneMapping::Neutral,
            shadows: true,
            own_lights: false,
            ground: true,
            occlusion: true,
            mipmaps: true,
        }
    }
}

/// A material's surface, in the form that its shader has.
#[derive(Debug)]
enum Skin<'a, 's> {
    Plain(Plain<'a, 's>),
    Mapped(Mapped<'a, 's>),
    Masked(Masked<'a, 's>),
}

/// What a pass shows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    /// What hides what is behind it.
    Opaque,
    /// What lets light through.
    Clear,
    /// What is blended.
    Blended,
}

/// Draws a stage whose objects came from `scene`, `width` x `height` pixels: linear light from 0 to 1, alpha multiplied in, row by row from the top. Where nothing is, all is 0.
///
/// Errors: sizes that targets cannot have; no memory.
pub fn draw(
    stage: &Stage,
    scene: &Scene,
    environment: &Environment,
    settings: &PbrSettings,
    [width, height]: [u32; 2],
    renderer: &mut Renderer,
) -> Result<Vec<[f32; 4]>, Error> {
    if width > MAX_SIZE || height > MAX_SIZE {
        return Err(Error::TargetSize { width, height });
    }
    let mut gallery = Gallery::new(scene);
    let coatings: Vec<Coating<'_>> = scene
        .materials
        .iter()
        .map(|material| Coating::new(material, &mut gallery, settings.mipmaps, stage.scale))
        .collect::<Result<_, _>>()?;
    let part = |prop: &Prop| match &coatings[prop.material] {
        Coating { alpha_mode: AlphaMode::Blend, .. } => Part::Blended,
        Coating { transmission: Some(glass), .. } if glass.factor > 0.0 => Part::Clear,
        _ => Part::Opaque,
    };

    let casters: Vec<Caster<'_, '_>> = stage
        .props
        .iter()
        .map(|prop| Caster::new(prop, scene, &mut gallery, settings.mipmaps))
        .collect::<Result<_, _>>()?;

    // The studio turns with the camera; a panorama is of a place.
    let axes = if environment.is_studio { axes(stage) } else { [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
    let key = if environment.has_key && settings.shadows {
        let toward = [0, 1, 2].map(|k| (0..3).map(|axis| studio::KEY[axis] * axes[axis][k]).sum());
        // Glass casts a shadow, too.
        Some(Shadow::new(stage, toward, width.max(height), &casters, |prop| part(prop) != Part::Blended, renderer)?)
    } else {
        None
    };
    let occlusion = match settings.occlusion {
        true => Some(Occlusion::new(stage, &casters, [width, height], |prop| part(prop) == Part::Opaque, renderer)?),
        false => None,
    };
    let ground = match settings.ground {
        true => Ground::new(stage, &casters, key.as_ref(), renderer)?,
        false => None,
    };
    let lamps: Vec<Lamp> = match settings.own_lights {
        true => stage.lights.iter().map(Lamp::new).collect(),
        false => Vec::new(),
    };
    let light = Light {
        clip_from_world: stage.camera.clip_from_world,
        eye: stage.camera.eye,
        to_eye: stage.camera.to_eye(),
        environment,
        axes,
        key: key.as_ref().map(|shadow| (studio::KEY_LIGHT, shadow)),
        lamps: &lamps,
        occlusion: occlusion.as_ref(),
        exposure: settings.exposure,
        tone_mapping: settings.tone_mapping,
    };
    let picture = Picture { stage, coatings: &coatings, light: &light, part: &part };
    let behind = match stage.props.iter().any(|prop| part(prop) == Part::Clear) {
        true => Some(picture.behind([width, height], renderer)?),
        false => None,
    };

    let skins = picture.skins(behind.as_ref(), false);
    let floor = ground.as_ref().map(|ground| (ground.corners(light.clip_from_world), ground.paint()));
    let mut pass = Pass::new();
    pass.clear_color = Some([0.0; 4]);
    if let Some((corners, paint)) = &floor {
        pass.draw(paint, Mesh { vertices: corners, indices: Indices::Sequential }, Ground::state([width, height]));
    }
    picture.add(&mut pass, &skins, Part::Opaque);
    picture.add(&mut pass, &skins, Part::Clear);
    picture.add(&mut pass, &skins, Part::Blended);
    let mut pixels = vec![[0.0; 4]; width as usize * height as usize];
    let color = ColorBuffer::Rgba32F(&mut pixels);
    renderer.render(&pass, &mut Target { samples: settings.samples, color, ..Target::new(width, height) })?;
    Ok(pixels)
}

/// What [`draw`] draws twice if something lets light through.
struct Picture<'a, 's> {
    stage: &'a Stage,
    coatings: &'a [Coating<'s>],
    light: &'a Light<'a>,
    part: &'a dyn Fn(&Prop) -> Part,
}

impl<'a, 's> Picture<'a, 's> {
    /// The shader of each prop.
    fn skins(&self, behind: Option<&'a Behind>, is_raw: bool) -> Vec<Skin<'a, 's>> {
        let skin = |prop: &Prop| {
            let coating = &self.coatings[prop.material];
            let surface = Surface { light: self.light, coating, has_tangents: prop.has_tangents, behind, is_raw };
            if matches!(coating.alpha_mode, AlphaMode::Mask { .. }) {
                Skin::Masked(Masked(surface))
            } else if coating.has_maps() {
                Skin::Mapped(Mapped(surface))
            } else {
                Skin::Plain(Plain(surface))
            }
        };
        self.stage.props.iter().map(skin).collect()
    }

    /// Adds the draws of one part: what is blended from back to front.
    fn add<'p>(&self, pass: &mut Pass<'p>, skins: &'p [Skin<'a, 's>], part: Part)
    where
        'a: 'p,
    {
        let mut props: Vec<_> =
            self.stage.props.iter().zip(skins).filter(|(prop, _)| (self.part)(prop) == part).collect();
        if part != Part::Opaque {
            props.sort_by(|(a, _), (b, _)| b.distance_squared.total_cmp(&a.distance_squared));
        }
        for (prop, skin) in props {
            for (mesh, topology) in prop.meshes() {
                let mut states = vec![DrawState { topology, ..prop.state() }];
                if part == Part::Blended {
                    let depth = DepthState { write: false, ..DepthState::default() };
                    states = sides(DrawState { depth, blend: Blend::PREMULTIPLIED, ..states[0] }).collect();
                }
                for state in states {
                    match skin {
                        Skin::Plain(shader) => pass.draw(shader, mesh, state),
                        Skin::Mapped(shader) => pass.draw(shader, mesh, state),
                        Skin::Masked(shader) => pass.draw(shader, mesh, state),
                    };
                }
            }
        }
    }

    /// The opaque part alone, not toned.
    fn behind(&self, [width, height]: [u32; 2], renderer: &mut Renderer) -> Result<Behind, Error> {
        let skins = self.skins(None, true);
        let mut pass = Pass::new();
        pass.clear_color = Some([0.0; 4]);
        self.add(&mut pass, &skins, Part::Opaque);
        let mut pixels = vec![[0; 4]; width as usize * height as usize];
        let color = ColorBuffer::Rgba16F(&mut pixels);
        renderer.render(&pass, &mut Target { color, ..Target::new(width, height) })?;
        Behind::new(width, height, pixels, self.light.clip_from_world)
    }
}

/// The studio turns with the camera, but stays upright: where its x (to the right), y (up) and z (towards the camera) point on the stage.
fn axes(stage: &Stage) -> [[f32; 3]; 3] {
    let ([x, _, z], [up_x, _, up_z]) = (stage.camera.eye, stage.camera.up);
    // Seen from straight above, what is up in the picture is away from the camera.
    let (x, z) = if x * x + z * z > 1e-8 { (x, z) } else { (-up_x, -up_z) };
    let length = (x * x + z * z).sqrt();
    let (x, z) = if length > 0.0 { (x / length, z / length) } else { (0.0, 1.0) };
    [[z, 0.0, -x], [0.0, 1.0, 0.0], [x, 0.0, z]]
}
