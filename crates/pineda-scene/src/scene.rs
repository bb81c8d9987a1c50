//! The scene: what every reader makes and a renderer draws.

use std::sync::Arc;

use crate::{Camera, Error, Image, Light, Material, Select, Texture};

/// Objects, what they are made of, and the cameras and lights that the file brings along.
///
/// An object's number is its place in [`Scene::objects`], a material's its place in [`Scene::materials`], a triangle's
/// its place in its object: the numbers that `ids` shading shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Drawn in this order. A loaded scene has at least one, and none that is empty.
    pub objects: Vec<Object>,
    /// A file's materials in the file's order; a default one follows where an object needs it. Those that no object has
    /// are without their textures.
    pub materials: Vec<Material>,
    /// What materials look up.
    pub textures: Vec<Texture>,
    /// What textures show; poses of one model share them.
    pub images: Vec<Arc<Image>>,
    /// Those of the scene's nodes, in their order.
    pub cameras: Vec<Camera>,
    /// Those of the scene's nodes, in their order. Light that a renderer brings itself is not among them.
    pub lights: Vec<Light>,
}

impl Scene {
    /// One of the scene's cameras.
    ///
    /// # Errors
    /// [`Error::NoSuch`] with the names that there are.
    pub fn camera(&self, select: &Select) -> Result<&Camera, Error> {
        let names: Vec<_> = self.cameras.iter().map(|camera| camera.name.clone()).collect();
        Ok(&self.cameras[select.among("camera", &names)?])
    }
}

/// Triangles, lines and points with one material: a group of an OBJ file, a solid of an STL file, a primitive of a glTF
/// node's mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The file's name for it; empty where it has none.
    pub name: Arc<str>,
    /// In world space.
    pub vertices: Vec<Vertex>,
    /// Sets of texture coordinates, each as long as `vertices`, or none at all; (0, 0) is the image's top left corner,
    /// (1, 1) its bottom right one.
    pub uvs: Vec<Vec<[f32; 2]>>,
    /// As long as `vertices`, or empty: x, y, z in world space, of length 1 (or 0 where the file has none), and in w the
    /// bitangent's sign, `bitangent = w * cross(normal, tangent)`.
    pub tangents: Vec<[f32; 4]>,
    /// Indices into `vertices`, always in range; counter-clockwise as seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// The two ends of each line; indices into `vertices`.
    pub lines: Vec<[u32; 2]>,
    /// Indices into `vertices`.
    pub points: Vec<u32>,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// Where the vertices' normals come from.
    pub normals: Normals,
    /// How long a unit of the mesh's own space is in the world, on average over directions: see
    /// [`Volume::thickness_factor`](crate::Volume::thickness_factor). 1 unless a glTF node says otherwise.
    pub thickness_scale: f32,
}

impl Default for Object {
    /// Nothing, of the first material.
    fn default() -> Self {
        Self {
            name: "".into(),
            vertices: Vec::new(),
            uvs: Vec::new(),
            tangents: Vec::new(),
            triangles: Vec::new(),
            lines: Vec::new(),
            points: Vec::new(),
            material: 0,
            normals: Normals::Absent,
            thickness_scale: 1.0,
        }
    }
}

impl Object {
    /// Whether it has no triangles, lines or points.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.lines.is_empty() && self.points.is_empty()
    }

    /// Every index into `vertices`: of triangles, lines, points.
    pub fn indices(&self) -> impl Iterator<Item = u32> {
        self.triangles.as_flattened().iter().chain(self.lines.as_flattened()).chain(&self.points).copied()
    }
}

/// A corner of triangles, an end of lines, a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Vertex {
    /// World space. Not necessarily finite where nothing names the vertex.
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
