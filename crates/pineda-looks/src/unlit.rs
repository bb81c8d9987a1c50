//! The base colour and no light.

use crate::base_color::BaseColor;
use crate::surface::{Surface, Vertex, surface};
use pineda::{Fragment, Lanes, Mat4, Rgba, Scalar, Shader, Vec4, shader};

/// Base colour x vertex colour, in linear light, whatever the light (KHR_materials_unlit).
#[derive(Clone, Debug)]
pub struct Unlit<'s> {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// The surface's.
    pub base: BaseColor<'s>,
}

#[shader]
impl Shader for Unlit<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Surface<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Surface<Scalar>) {
        surface(self.clip_from_world, vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Surface { uv, uv_1, .. } = f.dual();
        self.base.at(f.color, [uv, uv_1])
    }
}
