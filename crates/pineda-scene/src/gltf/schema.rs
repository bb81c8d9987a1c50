//! The JSON: the fields of glTF 2.0's schema and of the extensions that are read. What is not named here is skipped.

mod json;
mod material;

use serde::Deserialize;

use crate::Error;
pub(super) use json::{Attributes, List, Semantic, Whole};
pub(super) use material::{Material, TextureInfo, Transform};

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Root {
    asset: Asset,
    pub(super) scene: Option<Whole>,
    #[serde(default)]
    pub(super) scenes: List<Scene>,
    #[serde(default)]
    pub(super) nodes: List<Node>,
    #[serde(default)]
    pub(super) meshes: List<Mesh>,
    #[serde(default)]
    pub(super) materials: List<Material>,
    #[serde(default)]
    pub(super) accessors: List<Accessor>,
    #[serde(default)]
    pub(super) buffer_views: List<BufferView>,
    #[serde(default)]
    pub(super) buffers: List<Buffer>,
    #[serde(default)]
    pub(super) images: List<Image>,
    #[serde(default)]
    pub(super) textures: List<Texture>,
    #[serde(default)]
    pub(super) samplers: List<Sampler>,
    #[serde(default)]
    pub(super) cameras: List<Camera>,
    #[serde(default)]
    pub(super) extensions: RootExtensions,
    #[serde(default)]
    pub(super) animations: List<Animation>,
    #[serde(default)]
    pub(super) skins: List<Skin>,
    #[serde(default)]
    pub(super) extensions_used: List<String>,
    #[serde(default)]
    pub(super) extensions_required: List<String>,
}

#[derive(Debug, Default, Deserialize)]
pub(super) struct RootExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub(super) lights: Option<Lights>,
    #[serde(rename = "KHR_materials_variants")]
    pub(super) variants: Option<Variants>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Lights {
    #[serde(default)]
    pub(super) lights: List<Light>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Light {
    pub(super) name: Option<String>,
    #[serde(rename = "type")]
    pub(super) kind: String,
    pub(super) color: Option<[f64; 3]>,
    pub(super) intensity: Option<f64>,
    pub(super) range: Option<f64>,
    pub(super) spot: Option<Spot>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Spot {
    pub(super) inner_cone_angle: Option<f64>,
    pub(super) outer_cone_angle: Option<f64>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Variants {
    #[serde(default)]
    pub(super) variants: List<Named>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Named {
    pub(super) name: Option<String>,
}

#[derive(Debug, Deserialize)]
struct Asset {
    version: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Scene {
    pub(super) name: Option<String>,
    #[serde(default)]
    pub(super) nodes: List<Whole>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Node {
    name: Option<String>,
    pub(super) mesh: Option<Whole>,
    pub(super) skin: Option<Whole>,
    #[serde(default)]
    pub(super) children: List<Whole>,
    /// Column by column.
    pub(super) matrix: Option<Box<[f64; 16]>>,
    pub(super) translation: Option<[f64; 3]>,
    /// x, y, z, w.
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
    pub(super) weights: Option<List<f64>>,
    pub(super) camera: Option<Whole>,
    #[serde(default)]
    pub(super) extensions: NodeExtensions,
}

#[derive(Debug, Default, Deserialize)]
pub(super) struct NodeExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub(super) light: Option<NodeLight>,
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub(super) instancing: Option<Instancing>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Instancing {
    #[serde(default)]
    pub(super) attributes: InstanceAttributes,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) struct InstanceAttributes {
    pub(super) translation: Option<Whole>,
    pub(super) rotation: Option<Whole>,
    pub(super) scale: Option<Whole>,
}

#[derive(Debug, Deserialize)]
pub(super) struct NodeLight {
    pub(super) light: Whole,
}

impl Node {
    pub(super) fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub(super) name: Option<String>,
    pub(super) primitives: List<Primitive>,
    pub(super) weights: Option<List<f64>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: Option<Whole>,
    pub(super) material: Option<Whole>,
    pub(super) mode: Option<Whole>,
    #[serde(default)]
    pub(super) targets: List<Attributes>,
    #[serde(default)]
    pub(super) extensions: PrimitiveExtensions,
}

#[derive(Debug, Default, Deserialize)]
pub(super) struct PrimitiveExtensions {
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub(super) draco: Option<Draco>,
    #[serde(rename = "KHR_materials_variants")]
    pub(super) variants: Option<VariantMappings>,
}

/// Where a primitive's compressed data are, and which of their attributes has which number.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Draco {
    pub(super) buffer_view: Whole,
    #[serde(default)]
    pub(super) attributes: Attributes,
}

#[derive(Debug, Deserialize)]
pub(super) struct VariantMappings {
    #[serde(default)]
    pub(super) mappings: List<VariantMapping>,
}

#[derive(Debug, Deserialize)]
pub(super) struct VariantMapping {
    pub(super) material: Whole,
    #[serde(default)]
    pub(super) variants: List<Whole>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Camera {
    pub(super) name: Option<String>,
    pub(super) perspective: Option<Perspective>,
    pub(super) orthographic: Option<Orthographic>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Perspective {
    pub(super) yfov: f64,
    pub(super) aspect_ratio: Option<f64>,
    pub(super) znear: f64,
    pub(super) zfar: Option<f64>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Orthographic {
    pub(super) xmag: f64,
    pub(super) ymag: f64,
    pub(super) znear: f64,
    pub(super) zfar: f64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Image {
    pub(super) name: Option<String>,
    pub(super) uri: Option<String>,
    pub(super) buffer_view: Option<Whole>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Texture {
    pub(super) name: Option<String>,
    pub(super) sampler: Option<Whole>,
    source: Option<Whole>,
    #[serde(default)]
    extensions: TextureExtensions,
}

#[derive(Debug, Default, Deserialize)]
struct TextureExtensions {
    #[serde(rename = "EXT_texture_webp")]
    webp: Option<TextureSource>,
}

#[derive(Debug, Deserialize)]
struct TextureSource {
    source: Option<Whole>,
}

impl Texture {
    /// The image to show: the best of those that can be decoded.
    pub(super) fn source(&self) -> Option<Whole> {
        self.extensions.webp.as_ref().and_then(|webp| webp.source).or(self.source)
    }
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Sampler {
    pub(super) mag_filter: Option<Whole>,
    pub(super) min_filter: Option<Whole>,
    pub(super) wrap_s: Option<Whole>,
    pub(super) wrap_t: Option<Whole>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Skin {
    pub(super) inverse_bind_matrices: Option<Whole>,
    pub(super) joints: List<Whole>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Animation {
    pub(super) name: Option<String>,
    pub(super) channels: List<AnimationChannel>,
    pub(super) samplers: List<AnimationSampler>,
}

#[derive(Debug, Deserialize)]
pub(super) struct AnimationChannel {
    pub(super) sampler: Whole,
    pub(super) target: AnimationTarget,
}

#[derive(Debug, Deserialize)]
pub(super) struct AnimationTarget {
    pub(super) node: Option<Whole>,
    pub(super) path: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct AnimationSampler {
    pub(super) input: Whole,
    pub(super) output: Whole,
    pub(super) interpolation: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<Whole>,
    #[serde(default)]
    pub(super) byte_offset: Whole,
    pub(super) component_type: Whole,
    #[serde(default)]
    pub(super) normalized: bool,
    pub(super) count: Whole,
    #[serde(rename = "type")]
    pub(super) kind: String,
    pub(super) sparse: Option<Box<Sparse>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Sparse {
    pub(super) count: Whole,
    pub(super) indices: SparseIndices,
    pub(super) values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseIndices {
    pub(super) buffer_view: Whole,
    #[serde(default)]
    pub(super) byte_offset: Whole,
    pub(super) component_type: Whole,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseValues {
    pub(super) buffer_view: Whole,
    #[serde(default)]
    pub(super) byte_offset: Whole,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: Whole,
    #[serde(default)]
    pub(super) byte_offset: Whole,
    pub(super) byte_length: Whole,
    pub(super) byte_stride: Option<Whole>,
    #[serde(default)]
    extensions: BufferViewExtensions,
}

#[derive(Debug, Default, Deserialize)]
struct BufferViewExtensions {
    #[serde(rename = "EXT_meshopt_compression")]
    ext_meshopt: Option<Meshopt>,
    #[serde(rename = "KHR_meshopt_compression")]
    khr_meshopt: Option<Meshopt>,
}

/// Where a view's compressed data are, and what they become.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Meshopt {
    pub(super) buffer: Whole,
    #[serde(default)]
    pub(super) byte_offset: Whole,
    pub(super) byte_length: Whole,
    pub(super) byte_stride: Whole,
    pub(super) count: Whole,
    pub(super) mode: String,
    pub(super) filter: Option<String>,
}

impl BufferView {
    /// The compressed data that stand for the view's own.
    pub(super) fn meshopt(&self) -> Option<&Meshopt> {
        self.extensions.khr_meshopt.as_ref().or(self.extensions.ext_meshopt.as_ref())
    }
}

#[derive(Debug, Deserialize)]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
}

/// Parses the JSON of a glTF 2 file.
pub(super) fn parse(json: &[u8]) -> Result<Root, Error> {
    let as_error = |error: &serde_json::Error| Error::Json {
        line: error.line(),
        column: error.column(),
        message: format!("{}: is it glTF 2.0, and complete?", without_place(error)),
    };
    json::allow_lists(json.len());
    let root: Root = serde_json::from_slice(json).map_err(|error| {
        // glTF 1.0 fails at its first list, which says nothing to anybody.
        old_version(json).unwrap_or_else(|| as_error(&error))
    })?;
    check_version(&root.asset)?;
    if let Some(scene) = root.scene
        && scene.index() >= root.scenes.len()
    {
        return Err(Error::gltf(format!("scene {scene}"), "it is the default scene, but does not exist"));
    }
    Ok(root)
}

fn check_version(asset: &Asset) -> Result<(), Error> {
    if asset.version == "2" || asset.version.starts_with("2.") {
        return Ok(());
    }
    let version = crate::text::shown(asset.version.as_bytes());
    let message = format!("version '{version}': only glTF 2 can be read; export the model as glTF 2.0");
    Err(Error::gltf("asset", message))
}

fn old_version(json: &[u8]) -> Option<Error> {
    #[derive(Debug, Deserialize)]
    struct Head {
        asset: Asset,
    }
    let head: Head = serde_json::from_slice(json).ok()?;
    check_version(&head.asset).err()
}

/// The message of `serde_json`, which repeats the place at its end.
fn without_place(error: &serde_json::Error) -> String {
    let message = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    message.strip_suffix(&place).unwrap_or(&message).to_owned()
}
