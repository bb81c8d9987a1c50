//! The scene: what every reader makes and a renderer draws.

use std::sync::Arc;

/// Objects and the materials that they are made of.
///
/// An object's number is its place in [`Scene::objects`], a material's its place in [`Scene::materials`], a triangle's
/// its place in its object: the numbers that `ids` shading shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Drawn in this order. A loaded scene has at least one, and none without triangles.
    pub objects: Vec<Object>,
    /// A file's materials in the file's order; a default one follows where an object needs it.
    pub materials: Vec<Material>,
}

/// Triangles with one material: a group of an OBJ file, a solid of an STL file, a primitive of a glTF node's mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The file's name for it; empty where it has none.
    pub name: Arc<str>,
    /// In world space.
    pub vertices: Vec<Vertex>,
    /// Indices into `vertices`, always in range; counter-clockwise as seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// Where the vertices' normals come from.
    pub normals: Normals,
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Vertex {
    /// World space. Not necessarily finite where no triangle names the vertex.
    pub position: [f32; 3],
    /// World space, of length 1; `[0.0; 3]` throughout an object with [`Normals::Absent`].
    pub normal: [f32; 3],
    /// Linear light, straight alpha, usually within 0..=1; white where the file gives no colour.
    pub color: [f32; 4],
}

impl Vertex {
    /// White.
    pub const WHITE: [f32; 4] = [1.0; 4];

    /// A white vertex without a normal.
    pub fn at(position: [f32; 3]) -> Self {
        Self { position, normal: [0.0; 3], color: Self::WHITE }
    }
}

/// Where an object's normals come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normals {
    /// There are none: each triangle is flat.
    Absent,
    /// The file (or the code that built the scene) gives them.
    Given,
    /// Each triangle has its own three vertices with its face's normal: [`crate::flat_normals`].
    Flat,
    /// Averaged over faces, split at creases: [`crate::smooth_normals`].
    Smooth,
}

/// How a surface looks, as far as readers know.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The file's name for it; empty where it has none.
    pub name: Arc<str>,
    /// Linear light, straight alpha; multiplies [`Vertex::color`].
    pub base_color_factor: [f32; 4],
    /// Whether back faces are drawn. OBJ, STL and PLY: always; glTF: as the file says.
    pub double_sided: bool,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
}

impl Default for Material {
    /// White, opaque, double sided.
    fn default() -> Self {
        Self { name: "".into(), base_color_factor: [1.0; 4], double_sided: true, alpha_mode: AlphaMode::Opaque }
    }
}

/// What a material's alpha means, in glTF's words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Nothing: the surface is opaque.
    Opaque,
    /// Fragments with less alpha than the cutoff are not there, the others are opaque.
    Mask {
        /// Usually 0.5.
        cutoff: f32,
    },
    /// "Source over".
    Blend,
}
