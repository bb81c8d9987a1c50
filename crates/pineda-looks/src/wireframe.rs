//! The edges of triangles on a pale surface.

use crate::Vertex;
use crate::matcap::{Shape, shape};
use pineda::{Fragment, Lanes, Mat4, Rgba, Scalar, Shader, Vec4, shader};

/// A colour that is darker where the surface turns away from the eye: with two colours, for surfaces and for lines. Light within 0 to 1: `Rgba8Srgb`, `Rgba32F`.
#[derive(Clone, Debug, PartialEq)]
pub struct Wireframe {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// See [`Matcap::eye`](crate::Matcap::eye).
    pub eye: [f32; 4],
    /// Linear light.
    pub color: [f32; 3],
}

impl Wireframe {
    /// A colour for surfaces.
    pub const PALE: [f32; 3] = [0.76, 0.79, 0.82];
    /// A colour for lines.
    pub const INK: [f32; 3] = [0.012, 0.05, 0.16];
}

#[shader]
impl Shader for Wireframe {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Shape<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Shape<Scalar>) {
        shape(self.clip_from_world, self.eye, vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let facing = f.normal.normalize().dot(f.to_eye.normalize()).abs().min(1.0);
        Rgba::opaque(f.splat(self.color) * (facing * 0.45 + 0.55))
    }
}
