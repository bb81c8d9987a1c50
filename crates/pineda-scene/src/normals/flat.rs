//! One normal a face.

use super::{ANY, face_normal, rounded};
use crate::{Normals, Object, Vertex};

/// Gives each triangle three vertices of its own with its face's normal, computed in f64 and rounded once.
///
/// Triangles keep their number, corners and colours. Vertices that no triangle names are gone.
pub fn flat_normals(object: &mut Object) {
    let mut vertices = Vec::with_capacity(3 * object.triangles.len());
    for &triangle in &object.triangles {
        let normal = rounded(face_normal(&object.vertices, triangle).unwrap_or(ANY));
        vertices.extend(triangle.map(|v| Vertex { normal, ..object.vertices[v as usize] }));
    }
    for (triangle, first) in object.triangles.iter_mut().zip((0..).step_by(3)) {
        *triangle = [first, first + 1, first + 2];
    }
    object.vertices = vertices;
    object.normals = Normals::Flat;
}
