//! One distant light, for pictures that two renderers must agree on.

use crate::surface::{Surface, Vertex, seen_normal, surface};
use pineda::{Fragment, Lanes, Mat4, Rgba, Scalar, Shader, Vec4, shader};

/// Base colour x vertex colour x (a + (1 - a) max(0, n . l)), in linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Lambert {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// Linear light.
    pub base_color: [f32; 3],
    /// Towards the light, in world space, of length 1: l.
    pub light: [f32; 3],
    /// The part of the light that comes from everywhere, 0 to 1: a.
    pub ambient: f32,
}

impl Default for Lambert {
    /// White; a = 0.25, l = (0.5, 1, 0.8) normalised.
    fn default() -> Self {
        let length = 1.89f32.sqrt();
        Self {
            clip_from_world: Mat4::IDENTITY,
            base_color: [1.0; 3],
            light: [0.5 / length, 1.0 / length, 0.8 / length],
            ambient: 0.25,
        }
    }
}

#[shader]
impl Shader for Lambert {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Surface<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Surface<Scalar>) {
        surface(self.clip_from_world, vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let cosine = seen_normal::<L, Self>(f, f.normal).dot(self.light).max(0.0);
        Rgba::opaque(f.color * self.base_color * (self.ambient + (1.0 - self.ambient) * cosine))
    }
}
