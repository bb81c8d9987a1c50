//! Texture coordinates as colours.

use crate::Vertex;
use pineda::{Fragment, Lanes, Mat4, Rgba, Scalar, Shader, Vec2, Vec3, Vec4, shader};

/// The first set of texture coordinates: u in red and v in green, from 0 to 1 and then from 0 again; in blue a board of 8 x 8 fields, 0 and 0.25, so that one sees how a texture would be stretched.
/// A surface without texture coordinates has (0, 0) all over.
///
/// Plain numbers, not light: draw it to a linear target (`Rgba8`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uv {
    /// World space to clip space.
    pub clip_from_world: Mat4,
}

#[shader]
impl Shader for Uv {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec2<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Vec2<Scalar>) {
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), vertex.uvs[0].into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (u, v) = (f.x.fract(), f.y.fract());
        let is_odd = (((u * 8.0).floor() + (v * 8.0).floor()) * 0.5).fract();
        Rgba::opaque(Vec3::new(u, v, is_odd * 0.5))
    }
}
