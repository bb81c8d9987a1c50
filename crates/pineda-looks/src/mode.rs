//! What to show of a scene: each mode's shaders, for a whole stage.

use crate::base_color::BaseColor;
use crate::cut_out::CutOut;
use crate::normal_map::{MappedLambert, MappedNormals, NormalMap};
use crate::stage::{Camera, Prop, Stage};
use crate::{Alpha, Depth, Gallery, Lambert, Layer, Matcap, Normals, Unlit, Uv, Vertex, Wireframe};
use pineda::{Blend, DepthBias, DepthState, DrawState, Error, Mesh, Pass, PolygonMode, PrimitiveTopology, Shader};
use pineda_scene::{AlphaMode, Scene};

/// What to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// [`Unlit`]; light within 0 to 1.
    Unlit,
    /// [`Lambert`]; light within 0 to 1.
    Lambert,
    /// [`Normals`]; plain numbers.
    Normals,
    /// [`Depth`]; plain numbers, for a target of floats. What writes ids, hits and the like shows the same surfaces.
    Depth,
    /// [`Uv`]; plain numbers.
    Uv,
    /// [`Wireframe`]; light within 0 to 1.
    Wireframe,
    /// [`Matcap`]; light within 0 to 1.
    Matcap,
    /// How many fragments a pixel gets, whatever their depth: in each channel. For a target of floats.
    Overdraw,
}

impl Mode {
    /// What alpha is taken for.
    #[must_use]
    pub fn alpha(self) -> Alpha {
        match self {
            Self::Unlit | Self::Lambert => Alpha::Blends,
            Self::Normals | Self::Depth | Self::Uv | Self::Matcap => Alpha::Cuts,
            // Overdraw counts fragments, so that each object is drawn once only.
            Self::Wireframe | Self::Overdraw => Alpha::Ignored,
        }
    }
}

/// How textures are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Textures {
    /// Whether textures that are made smaller are looked up in smaller images; otherwise bilinearly in the full-size one.
    pub mipmaps: bool,
    /// Whether normal textures bend normals, in [`Mode::Normals`] and [`Mode::Lambert`].
    pub normal_maps: bool,
}

impl Default for Textures {
    /// Smaller images, no bent normals.
    fn default() -> Self {
        Self { mipmaps: true, normal_maps: false }
    }
}

/// The shaders that show a stage in a mode.
pub struct Show<'s> {
    mode: Mode,
    /// One for each object.
    looks: Vec<Box<dyn Look + 's>>,
    /// For each object that is cut out.
    cuts: Vec<Option<CutOut<'s>>>,
}

/// Shaders of any type.
trait Look: Sync {
    fn draw<'a>(&'a self, pass: &mut Pass<'a>, mesh: Mesh<'a, Vertex>, state: DrawState);
}

impl<S: Shader<Vertex = Vertex>> Look for S {
    fn draw<'a>(&'a self, pass: &mut Pass<'a>, mesh: Mesh<'a, Vertex>, state: DrawState) {
        pass.draw(self, mesh, state);
    }
}

/// A surface, and its edges.
struct Edged {
    surface: Wireframe,
    lines: Wireframe,
}

impl Look for Edged {
    fn draw<'a>(&'a self, pass: &mut Pass<'a>, mesh: Mesh<'a, Vertex>, state: DrawState) {
        let mut lines = state;
        if state.topology == PrimitiveTopology::TriangleList {
            let depth_bias = DepthBias { constant: 4.0, slope: 1.0, clamp: 0.0 };
            pass.draw(&self.surface, mesh, DrawState { depth_bias, ..state });
            lines.polygon_mode = PolygonMode::Line;
        }
        pass.draw(&self.lines, mesh, lines);
    }
}

impl<'s> Show<'s> {
    /// Makes textures ready, as far as the mode looks them up.
    ///
    /// Errors: no memory for textures.
    pub fn new(stage: &Stage, scene: &'s Scene, mode: Mode, textures: Textures) -> Result<Self, Error> {
        let mut gallery = Gallery::new(scene);
        let (mut looks, mut cuts) = (Vec::with_capacity(stage.props.len()), Vec::new());
        for prop in &stage.props {
            looks.push(look(&stage.camera, prop, scene, &mut gallery, mode, textures)?);
            let is_cut = mode.alpha() >= Alpha::Cuts && matches!(prop.alpha_mode(), AlphaMode::Mask { .. });
            cuts.push(if is_cut { Some(cut_out(&stage.camera, prop, scene, &mut gallery, textures)?) } else { None });
        }
        Ok(Self { mode, looks, cuts })
    }

    /// Records the draws of `stage`, the one that the shaders were made for. The result is, for each draw, its layer: which object it shows, and what of it.
    pub fn record<'a>(&'a self, stage: &'a Stage, pass: &mut Pass<'a>) -> Vec<Layer<'a>> {
        let layers = stage.layers(self.mode.alpha());
        for layer in &layers {
            let state = match self.mode {
                Mode::Overdraw => DrawState { depth: DepthState::OFF, blend: Blend::ADD, ..layer.state },
                _ => layer.state,
            };
            match &self.cuts[layer.number] {
                Some(cut) if layer.is_cut => cut.draw(pass, layer.mesh, state),
                _ => self.looks[layer.number].draw(pass, layer.mesh, state),
            }
        }
        layers
    }
}

fn cut_out<'s>(
    camera: &Camera,
    prop: &Prop,
    scene: &Scene,
    gallery: &mut Gallery<'s>,
    textures: Textures,
) -> Result<CutOut<'s>, Error> {
    CutOut::of(prop.material(scene), camera.clip_from_world, gallery, textures.mipmaps)
}

fn look<'s>(
    camera: &Camera,
    prop: &Prop,
    scene: &'s Scene,
    gallery: &mut Gallery<'s>,
    mode: Mode,
    textures: Textures,
) -> Result<Box<dyn Look + 's>, Error> {
    let (clip_from_world, eye) = (camera.clip_from_world, camera.to_eye());
    let material = prop.material(scene);
    let normals = match mode {
        Mode::Normals | Mode::Lambert if textures.normal_maps => {
            NormalMap::of(material, prop.has_tangents, gallery, textures.mipmaps)?
        }
        _ => None,
    };
    let mut base = || BaseColor::of(material, gallery, textures.mipmaps);
    Ok(match mode {
        Mode::Unlit => Box::new(Unlit { clip_from_world, base: base()? }),
        Mode::Lambert => {
            let lambert = Lambert::new(clip_from_world, base()?);
            match normals {
                Some(normals) => Box::new(MappedLambert { lambert, normals }),
                None => Box::new(lambert),
            }
        }
        Mode::Normals => match normals {
            Some(normals) => Box::new(MappedNormals { clip_from_world, normals }),
            None => Box::new(Normals { clip_from_world }),
        },
        Mode::Depth => {
            Box::new(Depth { clip_from_world, distance: camera.distance(), near: camera.near, far: camera.far })
        }
        Mode::Uv => Box::new(Uv { clip_from_world }),
        Mode::Wireframe => {
            let colored = |color| Wireframe { clip_from_world, eye, color };
            Box::new(Edged { surface: colored(Wireframe::PALE), lines: colored(Wireframe::INK) })
        }
        Mode::Matcap => Box::new(Matcap { clip_from_world, eye, up: camera.up }),
        Mode::Overdraw => Box::new(cut_out(camera, prop, scene, gallery, textures)?),
    })
}
