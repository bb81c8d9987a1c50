//! One distant light, for pictures that two renderers must agree on.

use crate::base_color::BaseColor;
use crate::surface::{Surface, Vertex, seen_normal, surface};
use pineda::{Fragment, Lanes, Mat4, Rgba, Scalar, Shader, Vec3, Vec4, shader};

/// Base colour x vertex colour x (a + (1 - a) max(0, n . l)), in linear light.
#[derive(Clone, Debug)]
pub struct Lambert<'s> {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// The surface's.
    pub base: BaseColor<'s>,
    /// Towards the light, in world space, of length 1: l.
    pub light: [f32; 3],
    /// The part of the light that comes from everywhere, 0 to 1: a.
    pub ambient: f32,
}

impl<'s> Lambert<'s> {
    /// a = 0.25, l = (0.5, 1, 0.8) normalised.
    #[must_use]
    pub fn new(clip_from_world: Mat4, base: BaseColor<'s>) -> Self {
        let length = 1.89f32.sqrt();
        Self { clip_from_world, base, light: [0.5 / length, 1.0 / length, 0.8 / length], ambient: 0.25 }
    }
}

#[shader]
impl Shader for Lambert<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Surface<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Surface<Scalar>) {
        surface(self.clip_from_world, vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Surface { uv, uv_1, .. } = f.dual();
        let base = self.base.at(f.color, [uv, uv_1]);
        self.lit(base, seen_normal::<L, Self>(f, f.normal))
    }
}

#[shader]
impl Lambert<'_> {
    /// A base colour in the light that a normal gets.
    pub(crate) fn lit<L: Lanes>(&self, base: Rgba<L>, normal: Vec3<L>) -> Rgba<L> {
        let cosine = normal.dot(self.light).max(0.0);
        Rgba::new(base.rgb() * (self.ambient + (1.0 - self.ambient) * cosine), base.a)
    }
}
