//! One normal a face.

use super::{ANY, Rebuilt, face_normal, rounded};
use crate::{Normals, Object};

/// Gives each triangle three vertices of its own with its face's normal, computed in f64 and rounded once.
///
/// Triangles keep their number, corners, colours and texture coordinates, tangents are left out: they belonged to other
/// normals. Lines and points keep the normals that they have. Vertices that nothing names are gone.
pub fn flat_normals(object: &mut Object) {
    let mut rebuilt = Rebuilt::new(object);
    let mut triangles = Vec::with_capacity(object.triangles.len());
    for &triangle in &object.triangles {
        let normal = rounded(face_normal(&object.vertices, triangle).unwrap_or(ANY));
        triangles.push(triangle.map(|v| rebuilt.push(object, v, normal)));
    }
    rebuilt.replace(object, triangles, Normals::Flat);
}
