//! A scene and a camera, made ready to draw.
//!
//! The world is moved and scaled so that the camera looks at the origin from distance 1: what is drawn is the same, and neither a model far from its origin nor one of atoms or galaxies loses
//! anything to 32-bit floats.

use crate::Vertex;
use pineda::{Cull, DrawState, Indices, Mat4, Mesh, PrimitiveTopology};
use pineda_scene::{
    AlphaMode, Bounds, Framing, Lens, Light, LightKind, Material, Normals, Object, Scene, flat_normals, smooth_normals,
};

/// A camera and what it sees.
#[derive(Debug)]
pub struct Stage {
    /// Its world is the stage's.
    pub camera: Camera,
    /// In the order of the scene's objects.
    pub props: Vec<Prop>,
    /// The least and the greatest coordinates of what is drawn, in the stage's world.
    pub bounds: [[f32; 3]; 2],
    /// How long a unit of the scene is on the stage.
    pub scale: f32,
    /// The scene's own lights, where they are on the stage, as bright as they are in the scene.
    pub lights: Vec<Light>,
}

/// A camera that stands at distance 1 from what it looks at, the origin.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// The stage's world to clip space.
    pub clip_from_world: Mat4,
    /// Whether all things keep their size, however far away they are.
    pub is_orthographic: bool,
    /// Where the camera stands.
    pub eye: [f32; 3],
    /// Roughly upwards in the picture.
    pub up: [f32; 3],
    /// Distance of the near plane along the view axis.
    pub near: f32,
    /// Distance of the far plane along the view axis.
    pub far: f32,
}

/// An object, ready to draw.
#[derive(Debug)]
pub struct Prop {
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
    lines: Vec<[u32; 2]>,
    points: Vec<u32>,
    double_sided: bool,
    alpha_mode: AlphaMode,
    /// Its number in the scene.
    pub material: usize,
    /// Whether it has tangents of its own.
    pub has_tangents: bool,
    /// The square of the distance from the eye to the middle of its box.
    pub distance_squared: f32,
}

impl Stage {
    /// Takes a scene's objects, and gives those without normals some: smoothed between faces that meet at less than `crease` degrees, or flat ones where that is 0. The scene keeps its
    /// materials and textures. `None` if there is nothing to draw.
    pub fn new(scene: &mut Scene, framing: &Framing, aspect: f64, crease: f64) -> Option<Self> {
        let bounds = Bounds::of(scene)?;
        let offset = [0, 1, 2].map(|axis| framing.eye[axis] - framing.target[axis]);
        let distance = offset.iter().map(|x| x * x).sum::<f64>().sqrt();
        let camera = Camera::new(framing, offset, distance, aspect);
        let objects = std::mem::take(&mut scene.objects);
        let place = |x: f64, axis: usize| ((x - framing.target[axis]) / distance) as f32;
        let bounds = [bounds.min, bounds.max].map(|corner| [0, 1, 2].map(|axis| place(corner[axis], axis)));
        let prop = |mut object: Object| {
            if object.normals == Normals::Absent {
                if crease > 0.0 { smooth_normals(&mut object, crease) } else { flat_normals(&mut object) }
            }
            let vertices = vertices(&object, place, camera.eye);
            let material = &scene.materials[object.material];
            Prop {
                distance_squared: distance_squared(&object, &vertices, camera.eye),
                vertices,
                has_tangents: !object.tangents.is_empty(),
                triangles: object.triangles,
                lines: object.lines,
                points: object.points,
                double_sided: material.double_sided,
                alpha_mode: material.alpha_mode,
                material: object.material,
            }
        };
        let props = objects.into_iter().map(prop).collect();
        let lights = scene.lights.iter().map(|light| lit_from(light, framing.target, distance)).collect();
        Some(Self { camera, props, bounds, scale: (1.0 / distance) as f32, lights })
    }
}

/// A light on a stage on which `unit` of the scene's units are one.
fn lit_from(light: &Light, origin: [f64; 3], unit: f64) -> Light {
    let position = [0, 1, 2].map(|axis| (light.position[axis] - origin[axis]) / unit);
    // What falls on a surface is intensity over the distance squared, and that has become smaller.
    let intensity = match light.kind {
        LightKind::Directional => light.intensity,
        LightKind::Point | LightKind::Spot { .. } => (f64::from(light.intensity) / (unit * unit)) as f32,
    };
    Light { position, intensity, range: (f64::from(light.range) / unit) as f32, ..light.clone() }
}

fn vertices(object: &Object, place: impl Fn(f64, usize) -> f32, eye: [f32; 3]) -> Vec<Vertex> {
    let none: &[[f32; 2]] = &[];
    let uvs = |set: usize| object.uvs.get(set).map_or(none, |set| set);
    let uvs = [uvs(0), uvs(1)];
    let vertex = |(k, vertex): (usize, &pineda_scene::Vertex)| {
        let place = |axis: usize| place(vertex.position[axis].into(), axis);
        let uv = |set: usize| uvs[set].get(k).copied().unwrap_or_default();
        let position = [place(0), place(1), place(2)];
        Vertex {
            position,
            // Lines and points without normals turn to whoever looks at them.
            normal: if vertex.normal == [0.0; 3] { towards(position, eye) } else { vertex.normal },
            tangent: object.tangents.get(k).copied().unwrap_or_default(),
            uvs: [uv(0), uv(1)],
            color: vertex.color,
        }
    };
    object.vertices.iter().enumerate().map(vertex).collect()
}

/// The unit vector from a place to the eye.
fn towards(position: [f32; 3], eye: [f32; 3]) -> [f32; 3] {
    let away = [0, 1, 2].map(|axis| eye[axis] - position[axis]);
    let length = away.iter().map(|x| x * x).sum::<f32>().sqrt();
    if length > 0.0 && length.is_finite() { away.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}

fn distance_squared(object: &Object, vertices: &[Vertex], eye: [f32; 3]) -> f32 {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for index in object.indices() {
        let position = vertices[index as usize].position;
        for axis in 0..3 {
            low[axis] = if position[axis] < low[axis] { position[axis] } else { low[axis] };
            high[axis] = if position[axis] > high[axis] { position[axis] } else { high[axis] };
        }
    }
    (0..3).map(|axis| 0.5 * (low[axis] + high[axis]) - eye[axis]).map(|x| x * x).sum()
}

impl Camera {
    fn new(framing: &Framing, offset: [f64; 3], distance: f64, aspect: f64) -> Self {
        let eye = offset.map(|x| (x / distance) as f32);
        let up = framing.up.map(|x| x as f32);
        let (near, far) = ((framing.near / distance) as f32, (framing.far / distance) as f32);
        let (projection, is_orthographic) = match framing.lens {
            Lens::Perspective { fov_y } => (Mat4::perspective(fov_y as f32, aspect as f32, near, far), false),
            Lens::Orthographic { half_height } => {
                let (x, y) = ((half_height * aspect / distance) as f32, (half_height / distance) as f32);
                (Mat4::orthographic(-x, x, -y, y, near, far), true)
            }
        };
        let clip_from_world = projection * Mat4::look_at(eye, [0.0; 3], up);
        Self { clip_from_world, is_orthographic, eye, up, near, far }
    }

    /// From a place to its distance along the view axis: the dot product of this with (x, y, z, 1).
    #[must_use]
    pub fn distance(&self) -> [f32; 4] {
        let [x, y, z] = self.eye;
        if self.is_orthographic { [-x, -y, -z, 1.0] } else { self.clip_from_world.0.map(|column| column[3]) }
    }

    /// From a place towards the eye: this less w times the place.
    #[must_use]
    pub fn to_eye(&self) -> [f32; 4] {
        let [x, y, z] = self.eye;
        [x, y, z, if self.is_orthographic { 0.0 } else { 1.0 }]
    }
}

impl Prop {
    /// Its triangles.
    #[must_use]
    pub fn mesh(&self) -> Mesh<'_, Vertex> {
        Mesh { vertices: &self.vertices, indices: Indices::U32(self.triangles.as_flattened()) }
    }

    /// Its triangles, lines and points, as far as there are such, and the topology that each is drawn with.
    pub fn meshes(&self) -> impl Iterator<Item = (Mesh<'_, Vertex>, PrimitiveTopology)> {
        let lists = [
            (self.triangles.as_flattened(), PrimitiveTopology::TriangleList),
            (self.lines.as_flattened(), PrimitiveTopology::LineList),
            (&self.points[..], PrimitiveTopology::PointList),
        ];
        let lists = lists.into_iter().filter(|(indices, _)| !indices.is_empty());
        lists.map(|(indices, topology)| (Mesh { vertices: &self.vertices, indices: Indices::U32(indices) }, topology))
    }

    /// As its material's sides say.
    #[must_use]
    pub fn state(&self) -> DrawState {
        DrawState { cull: if self.double_sided { Cull::None } else { Cull::Back }, ..DrawState::default() }
    }

    /// What its material says of alpha.
    #[must_use]
    pub fn alpha_mode(&self) -> AlphaMode {
        self.alpha_mode
    }

    /// How many triangles it has, how many lines, and how many points.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        [self.triangles.len(), self.lines.len(), self.points.len()]
    }

    /// What it is made of.
    #[must_use]
    pub fn material<'s>(&self, scene: &'s Scene) -> &'s Material {
        &scene.materials[self.material]
    }
}
