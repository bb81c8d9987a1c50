//! Scenes and shaders that the benchmarks share.

#![allow(dead_code, reason = "each benchmark uses some of it")]

use pineda::{Fragment, Lanes, Mat4, Rgba, Shader, Vec3, Vec4, shader, varyings};

pub(crate) const WIDTH: u32 = 1920;
pub(crate) const HEIGHT: u32 = 1080;
pub(crate) const EYE: [f32; 3] = [0.0, 0.0, 7.5];

#[derive(Clone, Copy)]
pub(crate) struct Vertex {
    pub(crate) position: [f32; 3],
    pub(crate) normal: [f32; 3],
    pub(crate) color: [f32; 3],
}

pub(crate) struct Scene {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) indices: Vec<u32>,
    pub(crate) camera: Mat4,
}

varyings! { pub(crate) struct Colored { color: Vec3 } }

pub(crate) struct Gouraud {
    pub(crate) camera: Mat4,
}

#[shader]
impl Shader for Gouraud {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Colored<L>;

    fn vertex(&self, v: &Vertex) -> (Vec4, Colored) {
        (self.camera * Vec3::from(v.position).extend(1.0), Colored { color: v.color.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::opaque(f.color)
    }
}

varyings! { pub(crate) struct Lit { world: Vec3, normal: Vec3 } }

pub(crate) struct BlinnPhong {
    pub(crate) camera: Mat4,
    pub(crate) eye: [f32; 3],
    pub(crate) light: [f32; 3],
    pub(crate) shininess: f32,
}

#[shader]
impl Shader for BlinnPhong {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Lit<L>;

    fn vertex(&self, v: &Vertex) -> (Vec4, Lit) {
        let world = Vec3::from(v.position);
        (self.camera * world.extend(1.0), Lit { world, normal: v.normal.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let normal = f.normal.normalize();
        let half = ((self.eye - f.world).normalize() + self.light).normalize();
        let diffuse = normal.dot(self.light).max(0.0);
        let specular = normal.dot(half).max(0.0).powf(self.shininess);
        Rgba::opaque(f.splat([0.8, 0.3, 0.2]) * (0.1 + 0.9 * diffuse) + 0.4 * specular)
    }
}

/// Sixteen layers over the whole picture.
pub(crate) fn fill(front_to_back: bool) -> Scene {
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    for layer in 0..16u8 {
        let place = if front_to_back { layer } else { 15 - layer };
        let first = vertices.len() as u32;
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            let color = [x * 0.5 + 0.5, y * 0.5 + 0.5, f32::from(place) / 16.0];
            vertices.push(Vertex { position: [x, y, 0.1 + f32::from(place) * 0.05], normal: [0.0; 3], color });
        }
        indices.extend([0, 1, 2, 0, 2, 3].map(|k| first + k));
    }
    Scene { vertices, indices, camera: Mat4::IDENTITY }
}

/// A million triangles of about two pixels: a jittered grid.
pub(crate) fn micro() -> Scene {
    let (columns, rows) = (1000u32, 500u32);
    let mut state = 12345u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0 - 0.5
    };
    let mut vertices = Vec::new();
    for j in 0..=rows {
        for i in 0..=columns {
            let x = (i as f32 + random() * 0.6) / columns as f32 * 2.0 - 1.0;
            let y = (j as f32 + random() * 0.6) / rows as f32 * 2.0 - 1.0;
            let color = [random() + 0.5, random() + 0.5, random() + 0.5];
            vertices.push(Vertex { position: [x, y, 0.5 + 0.1 * random()], normal: [0.0; 3], color });
        }
    }
    Scene { vertices, indices: grid_indices(rows, columns), camera: Mat4::IDENTITY }
}

/// A torus knot of 70,000 triangles that fills the picture.
pub(crate) fn knot() -> Scene {
    use std::f32::consts::TAU;
    let (along, around) = (700u32, 50u32);
    let curve = |t: f32| {
        let r = 2.0 + (3.0 * t).cos();
        [r * (2.0 * t).cos(), r * (2.0 * t).sin(), (3.0 * t).sin()]
    };
    let cross =
        |a: [f32; 3], b: [f32; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let unit = |v: [f32; 3]| v.map(|x| x / (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt());
    let mut vertices = Vec::new();
    for i in 0..=along {
        let t = i as f32 / along as f32 * TAU;
        let (p, q) = (curve(t), curve(t + 0.01));
        let side = unit(cross([q[0] - p[0], q[1] - p[1], q[2] - p[2]], [0.0, 0.0, 1.0]));
        let up = unit(cross(side, [q[0] - p[0], q[1] - p[1], q[2] - p[2]]));
        for j in 0..=around {
            let angle = j as f32 / around as f32 * TAU;
            let normal = [0, 1, 2].map(|k| side[k] * angle.cos() + up[k] * angle.sin());
            let position = [0, 1, 2].map(|k| p[k] + 0.6 * normal[k]);
            vertices.push(Vertex { position, normal, color: [1.0; 3] });
        }
    }
    let camera =
        Mat4::perspective(0.9, WIDTH as f32 / HEIGHT as f32, 1.0, 30.0) * Mat4::look_at(EYE, [0.0; 3], [0.0, 1.0, 0.0]);
    Scene { vertices, indices: grid_indices(along, around), camera }
}

/// The same triangles as [`grid_indices`], as strips that are restarted for each row.
pub(crate) fn grid_strips(outer: u32, inner: u32) -> Vec<u32> {
    let stride = inner + 1;
    let row = |j: u32| (0..=inner).flat_map(move |i| [j * stride + i, (j + 1) * stride + i]).chain([u32::MAX]);
    (0..outer).flat_map(row).collect()
}

/// Two triangles for each cell of `outer` rows of `inner` cells.
fn grid_indices(outer: u32, inner: u32) -> Vec<u32> {
    let stride = inner + 1;
    let mut indices = Vec::new();
    for j in 0..outer {
        for i in 0..inner {
            let a = j * stride + i;
            indices.extend([a, a + 1, a + stride + 1, a, a + stride + 1, a + stride]);
        }
    }
    indices
}
