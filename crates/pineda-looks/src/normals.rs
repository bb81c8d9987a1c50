//! Normals as colours.

use crate::surface::{Vertex, seen_normal};
use pineda::{Fragment, Lanes, Mat4, Rgba, Scalar, Shader, Vec3, Vec4, shader};

/// The world-space normal of the side that is seen, interpolated and normalised: `n * 0.5 + 0.5`.
///
/// Plain numbers, not light: draw it to a linear target (`Rgba8`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Normals {
    /// World space to clip space.
    pub clip_from_world: Mat4,
}

#[shader]
impl Shader for Normals {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec3<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Vec3<Scalar>) {
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), vertex.normal.into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::opaque(seen_normal::<L, Self>(f, f.varyings()) * 0.5 + 0.5)
    }
}
