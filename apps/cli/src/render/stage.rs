//! The scene and the camera, made ready to draw.
//!
//! The world is moved and scaled so that the camera looks at the origin from distance 1: what is drawn is the same, and
//! neither a model far from its origin nor one of atoms or galaxies loses anything to 32-bit floats.

use crate::arguments::RenderArguments;
use crate::failure::Failure;
use pineda::{Cull, DepthState, DrawState, Indices, Mat4, Mesh};
use pineda_looks::{Studio, Vertex};
use pineda_scene::{Bounds, Framing, Normals, Object, Scene, View, flat_normals, smooth_normals};

/// A camera and what it sees.
#[derive(Debug)]
pub(crate) struct Stage {
    pub(crate) camera: Camera,
    /// In the order of the scene's objects.
    pub(crate) props: Vec<Prop>,
}

/// In the stage's own world, where the distance from the eye to the target is 1 and the target is the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    pub(crate) clip_from_world: Mat4,
    pub(crate) eye: [f32; 3],
    pub(crate) up: [f32; 3],
    pub(crate) near: f32,
    pub(crate) far: f32,
}

/// An object, ready to draw.
#[derive(Debug)]
pub(crate) struct Prop {
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
    double_sided: bool,
    /// Linear light.
    pub(crate) base_color: [f32; 3],
    /// Its number in the scene.
    pub(crate) material: usize,
}

impl Stage {
    /// `crease` is in degrees; 0 gives flat faces where there are no normals.
    pub(crate) fn new(scene: Scene, arguments: &RenderArguments, crease: f64) -> Result<Self, Failure> {
        let bounds = Bounds::of(&scene).ok_or_else(|| Failure::data("the scene has nothing to draw"))?;
        let view = View {
            azimuth: arguments.azimuth,
            elevation: arguments.elevation,
            fov: arguments.fov,
            aspect: f64::from(arguments.size.width) / f64::from(arguments.size.height),
        };
        let framing = Framing::new(&bounds, &view).map_err(Failure::usage)?;
        let offset = [0, 1, 2].map(|axis| framing.eye[axis] - framing.target[axis]);
        let distance = offset.iter().map(|x| x * x).sum::<f64>().sqrt();
        let camera = Camera::new(&framing, offset, distance, view.aspect);
        let Scene { objects, materials, .. } = scene;
        let props = objects.into_iter().map(|mut object| {
            if object.normals == Normals::Absent {
                if crease > 0.0 { smooth_normals(&mut object, crease) } else { flat_normals(&mut object) }
            }
            let material = &materials[object.material];
            let [r, g, b, _] = material.base_color_factor;
            Prop {
                vertices: vertices(&object, framing.target, distance),
                triangles: object.triangles,
                double_sided: material.double_sided,
                base_color: [r, g, b],
                material: object.material,
            }
        });
        Ok(Self { props: props.collect(), camera })
    }
}

fn vertices(object: &Object, target: [f64; 3], distance: f64) -> Vec<Vertex> {
    let place = |x: f32, axis: usize| ((f64::from(x) - target[axis]) / distance) as f32;
    let vertex = |vertex: &pineda_scene::Vertex| {
        let [x, y, z] = vertex.position;
        Vertex { position: [place(x, 0), place(y, 1), place(z, 2)], normal: vertex.normal, color: vertex.color }
    };
    object.vertices.iter().map(vertex).collect()
}

impl Camera {
    fn new(framing: &Framing, offset: [f64; 3], distance: f64, aspect: f64) -> Self {
        let eye = offset.map(|x| (x / distance) as f32);
        let up = framing.up.map(|x| x as f32);
        let (near, far) = ((framing.near / distance) as f32, (framing.far / distance) as f32);
        let projection = Mat4::perspective(framing.fov_y as f32, aspect as f32, near, far);
        Self { clip_from_world: projection * Mat4::look_at(eye, [0.0; 3], up), eye, up, near, far }
    }

    /// The studio, built around this camera.
    pub(crate) fn studio(&self) -> Studio {
        Studio::new(self.clip_from_world, self.eye, [0.0; 3], self.up)
    }
}

impl Prop {
    pub(crate) fn mesh(&self) -> Mesh<'_, Vertex> {
        Mesh { vertices: &self.vertices, indices: Indices::U32(self.triangles.as_flattened()) }
    }

    pub(crate) fn state(&self) -> DrawState {
        DrawState {
            cull: if self.double_sided { Cull::None } else { Cull::Back },
            depth: DepthState::default(),
            ..DrawState::default()
        }
    }
}
