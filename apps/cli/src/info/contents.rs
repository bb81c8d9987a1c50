//! What is in a model, as plain data.

use crate::failure::Failure;
use crate::render::failure as model_failure;
use pineda_scene::{AlphaMode, Bounds, Format, LightKind, Loaded, Model, Pose, Projection, Scene, Texels};
use serde::Serialize;
use std::path::Path;
use std::sync::Arc;

/// A model. Objects, materials, images, cameras and lights are those of its own scene; names may be empty.
#[derive(Debug, Serialize)]
pub(crate) struct Info {
    pub(crate) file: String,
    /// `null` where it is told by the file's first bytes.
    pub(crate) format: Option<String>,
    pub(crate) scenes: Vec<Arc<str>>,
    pub(crate) default_scene: usize,
    pub(crate) counts: Counts,
    /// The least and the greatest coordinates of what is drawn.
    pub(crate) bounds: Option<[[f64; 3]; 2]>,
    pub(crate) objects: Vec<ObjectInfo>,
    pub(crate) materials: Vec<MaterialInfo>,
    pub(crate) images: Vec<ImageInfo>,
    pub(crate) animations: Vec<AnimationInfo>,
    pub(crate) variants: Vec<Arc<str>>,
    pub(crate) cameras: Vec<CameraInfo>,
    pub(crate) lights: Vec<LightInfo>,
    /// What was left out, and why.
    pub(crate) notes: Vec<String>,
}

#[derive(Debug, Serialize)]
pub(crate) struct Counts {
    pub(crate) objects: usize,
    pub(crate) vertices: usize,
    pub(crate) triangles: usize,
    pub(crate) lines: usize,
    pub(crate) points: usize,
}

#[derive(Debug, Serialize)]
pub(crate) struct ObjectInfo {
    pub(crate) name: Arc<str>,
    pub(crate) vertices: usize,
    pub(crate) triangles: usize,
    pub(crate) lines: usize,
    pub(crate) points: usize,
    /// Sets of texture coordinates.
    pub(crate) uv_sets: usize,
    pub(crate) has_normals: bool,
    pub(crate) has_tangents: bool,
    pub(crate) material: usize,
}

#[derive(Debug, Serialize)]
pub(crate) struct MaterialInfo {
    pub(crate) name: Arc<str>,
    pub(crate) alpha: &'static str,
    pub(crate) double_sided: bool,
    pub(crate) textures: usize,
    /// As in glTF's extensions, without `KHR_materials_`.
    pub(crate) extensions: Vec<&'static str>,
}

#[derive(Debug, Serialize)]
pub(crate) struct ImageInfo {
    pub(crate) name: Arc<str>,
    pub(crate) size: [u32; 2],
    pub(crate) bits: u8,
}

#[derive(Debug, Serialize)]
pub(crate) struct AnimationInfo {
    pub(crate) name: Arc<str>,
    pub(crate) seconds: f64,
}

#[derive(Debug, Serialize)]
pub(crate) struct CameraInfo {
    pub(crate) name: Arc<str>,
    pub(crate) kind: &'static str,
    pub(crate) eye: [f64; 3],
    pub(crate) forward: [f64; 3],
    /// Vertical field of view in degrees, of a perspective camera.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) fov: Option<f64>,
}

#[derive(Debug, Serialize)]
pub(crate) struct LightInfo {
    pub(crate) name: Arc<str>,
    pub(crate) kind: &'static str,
    pub(crate) color: [f32; 3],
    /// Lux of a directional light, candela of the others.
    pub(crate) intensity: f32,
}

impl Info {
    /// What is in a model that was read from `path`.
    pub(crate) fn of(model: &Model, path: &Path) -> Result<Self, Failure> {
        let contents = model.contents();
        let posed = model.scene(&Pose::default());
        let Loaded { scene, notes } = posed.map_err(|error| model_failure(error, path))?;
        let animations = contents.animations.iter();
        Ok(Self {
            file: path.to_string_lossy().into_owned(),
            format: Format::from_extension(path).map(|format| format.to_string()),
            scenes: contents.scenes.clone(),
            default_scene: contents.default_scene,
            counts: counts(&scene),
            bounds: Bounds::of(&scene).map(|bounds| [bounds.min, bounds.max]),
            objects: scene.objects.iter().map(object).collect(),
            materials: scene.materials.iter().map(material).collect(),
            images: scene.images.iter().map(|image| self::image(image)).collect(),
            animations: animations.map(|a| AnimationInfo { name: a.name.clone(), seconds: a.duration }).collect(),
            variants: contents.variants.clone(),
            cameras: scene.cameras.iter().map(camera).collect(),
            lights: scene.lights.iter().map(light).collect(),
            notes,
        })
    }
}

fn counts(scene: &Scene) -> Counts {
    let sum = |count: fn(&pineda_scene::Object) -> usize| scene.objects.iter().map(count).sum();
    Counts {
        objects: scene.objects.len(),
        vertices: sum(|object| object.vertices.len()),
        triangles: sum(|object| object.triangles.len()),
        lines: sum(|object| object.lines.len()),
        points: sum(|object| object.points.len()),
    }
}

fn object(object: &pineda_scene::Object) -> ObjectInfo {
    ObjectInfo {
        name: object.name.clone(),
        vertices: object.vertices.len(),
        triangles: object.triangles.len(),
        lines: object.lines.len(),
        points: object.points.len(),
        uv_sets: object.uvs.len(),
        has_normals: object.normals != pineda_scene::Normals::Absent,
        has_tangents: !object.tangents.is_empty(),
        material: object.material,
    }
}

fn material(material: &pineda_scene::Material) -> MaterialInfo {
    let extensions = [
        (material.unlit, "unlit"),
        (material.emissive_strength != 1.0, "emissive_strength"),
        (material.ior != 1.5, "ior"),
        (material.specular.is_some(), "specular"),
        (material.clearcoat.is_some(), "clearcoat"),
        (material.sheen.is_some(), "sheen"),
        (material.transmission.is_some(), "transmission"),
        (material.volume.is_some(), "volume"),
        (material.iridescence.is_some(), "iridescence"),
        (material.anisotropy.is_some(), "anisotropy"),
        (material.specular_glossiness.is_some(), "pbrSpecularGlossiness"),
    ];
    MaterialInfo {
        name: material.name.clone(),
        alpha: match material.alpha_mode {
            AlphaMode::Opaque => "opaque",
            AlphaMode::Mask { .. } => "mask",
            AlphaMode::Blend => "blend",
        },
        double_sided: material.double_sided,
        textures: material.textures().count(),
        extensions: extensions.into_iter().filter_map(|(is_used, name)| is_used.then_some(name)).collect(),
    }
}

fn image(image: &pineda_scene::Image) -> ImageInfo {
    let bits = if matches!(image.texels, Texels::Rgba8(_)) { 8 } else { 16 };
    ImageInfo { name: image.name.clone(), size: [image.width, image.height], bits }
}

fn camera(camera: &pineda_scene::Camera) -> CameraInfo {
    let (kind, fov) = match camera.projection {
        Projection::Perspective { fov_y, .. } => ("perspective", Some(fov_y.to_degrees())),
        Projection::Orthographic { .. } => ("orthographic", None),
    };
    CameraInfo { name: camera.name.clone(), kind, eye: camera.eye, forward: camera.forward, fov }
}

fn light(light: &pineda_scene::Light) -> LightInfo {
    let kind = match light.kind {
        LightKind::Directional => "directional",
        LightKind::Point => "point",
        LightKind::Spot { .. } => "spot",
    };
    LightInfo { name: light.name.clone(), kind, color: light.color, intensity: light.intensity }
}
