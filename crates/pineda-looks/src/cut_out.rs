//! Surfaces with holes: where a material's alpha is less than its cutoff, there is nothing (glTF's `MASK`).
//!
//! Only this shader knows of that. A surface that is cut out is drawn twice: by this one to the depth buffer alone, and then by any other with the comparison `Equal`, which finds what is left of it. So all the
//! other shaders discard nothing, and shade what is seen once however many leaves lie on top of each other.

use crate::base_color::factor_and_texture;
use crate::{Gallery, Map, Vertex};
use pineda::{Error, Fragment, Lanes, Mat4, Real, Rgba, Scalar, Shader, Vec2, Vec3, Vec4, shader, varyings};
use pineda_scene::{AlphaMode, Material};

/// White where alpha is large enough, and elsewhere nothing: fragments are discarded.
#[derive(Clone, Debug)]
pub struct CutOut<'s> {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// Multiplies the vertex' alpha.
    pub alpha: f32,
    /// Its alpha multiplies that.
    pub map: Option<Map<'s>>,
    /// What has less alpha is not there.
    pub cutoff: f32,
}

varyings! {
    /// What alpha depends on.
    pub struct Opacity {
        /// The vertex' alpha.
        pub alpha: Real,
        /// The first set of texture coordinates.
        pub uv: Vec2,
        /// The second set.
        pub uv_1: Vec2,
    }
}

impl<'s> CutOut<'s> {
    /// What is left of a material; all of it unless the material says `MASK`. For `mipmaps` see [`Gallery::map`].
    ///
    /// Errors: as [`Gallery::map`].
    pub fn of(
        material: &Material,
        clip_from_world: Mat4,
        gallery: &mut Gallery<'s>,
        mipmaps: bool,
    ) -> Result<Self, Error> {
        let AlphaMode::Mask { cutoff } = material.alpha_mode else {
            return Ok(Self { clip_from_world, alpha: 1.0, map: None, cutoff: f32::NEG_INFINITY });
        };
        let (factor, texture) = factor_and_texture(material);
        let map = gallery.map(texture, true, mipmaps)?;
        Ok(Self { clip_from_world, alpha: factor[3], map, cutoff })
    }
}

#[shader]
impl Shader for CutOut<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Opacity<L>;
    const DERIVATIVES: bool = true;
    const DISCARDS: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Opacity<Scalar>) {
        let [uv, uv_1] = vertex.uvs;
        let alpha = Opacity { alpha: vertex.color[3].into(), uv: uv.into(), uv_1: uv_1.into() };
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), alpha)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let mut alpha = f.alpha * self.alpha;
        if let Some(map) = &self.map {
            let Opacity { uv, uv_1, .. } = f.dual();
            alpha *= map.sample([uv, uv_1]).a;
        }
        f.discard(alpha.lt(self.cutoff));
        Rgba::gray(f.splat(1.0))
    }
}
