//! Normals for objects whose file has none.

mod flat;
mod smooth;
mod weld;

pub use flat::flat_normals;
pub use smooth::smooth_normals;

use crate::Vertex;
use crate::vector::{Vec3, area_vector_x2, normalize, widen};

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
