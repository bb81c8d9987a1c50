//! Normals for objects whose file has none.

mod flat;
mod smooth;
mod weld;

pub use flat::flat_normals;
pub use smooth::smooth_normals;

use crate::vector::{Vec3, area_vector_x2, normalize, widen};
use crate::{Normals, Object, Vertex};

/// The normal of what has no area, which no picture shows: some direction, so that arithmetic on it stays finite.
const ANY: Vec3 = [0.0, 0.0, 1.0];

fn corners(vertices: &[Vertex], triangle: [u32; 3]) -> [Vec3; 3] {
    triangle.map(|v| widen(vertices[v as usize].position))
}

/// A triangle's unit normal; `None` without area or with a corner that is not finite.
fn face_normal(vertices: &[Vertex], triangle: [u32; 3]) -> Option<Vec3> {
    let [a, b, c] = corners(vertices, triangle);
    normalize(area_vector_x2(a, b, c))
}

fn rounded(normal: Vec3) -> [f32; 3] {
    normal.map(|c| c as f32)
}

/// An object's vertices, made anew with other normals.
struct Rebuilt {
    vertices: Vec<Vertex>,
    uvs: Vec<Vec<[f32; 2]>>,
}

impl Rebuilt {
    fn new(object: &Object) -> Self {
        let count = 3 * object.triangles.len();
        Self { vertices: Vec::with_capacity(count), uvs: vec![Vec::with_capacity(count); object.uvs.len()] }
    }

    /// Adds the object's vertex `v` with a normal; its new number.
    fn push(&mut self, object: &Object, v: u32, normal: [f32; 3]) -> u32 {
        for (new, old) in self.uvs.iter_mut().zip(&object.uvs) {
            new.push(old[v as usize]);
        }
        self.vertices.push(Vertex { normal, ..object.vertices[v as usize] });
        self.vertices.len() as u32 - 1
    }

    /// Gives the object its new vertices and triangles. Its lines and points take theirs along.
    fn replace(mut self, object: &mut Object, triangles: Vec<[u32; 3]>, normals: Normals) {
        let mut strokes: Vec<u32> = object.lines.as_flattened().iter().chain(&object.points).copied().collect();
        strokes.sort_unstable();
        strokes.dedup();
        let first = self.vertices.len() as u32;
        for &v in &strokes {
            self.push(object, v, object.vertices[v as usize].normal);
        }
        for v in object.lines.as_flattened_mut().iter_mut().chain(&mut object.points) {
            *v = first + strokes.partition_point(|stroke| stroke < v) as u32;
        }
        object.vertices = self.vertices;
        object.uvs = self.uvs;
        object.tangents = Vec::new();
        object.triangles = triangles;
        object.normals = normals;
    }
}
