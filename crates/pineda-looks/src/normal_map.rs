//! Normals that a texture bends, and what they look like: as colours and in Lambert's light.

use crate::surface::seen;
use crate::tangent_frame::{Slopes, from_slopes, from_tangent};
use crate::{Gallery, Lambert, Map, Vertex};
use pineda::{Error, Fragment, Lanes, Mat4, Rgba, Scalar, Shader, Vec2, Vec3, Vec4, shader, varyings};
use pineda_scene::Material;

/// A material's normal texture, on a surface.
#[derive(Clone, Debug)]
pub struct NormalMap<'s> {
    /// Linear numbers.
    pub map: Map<'s>,
    /// Multiplies x and y.
    pub scale: f32,
    /// Whether the surface has tangents of its own; otherwise they are derived.
    pub has_tangents: bool,
}

impl<'s> NormalMap<'s> {
    /// That of a material, if it has one. For `mipmaps` see [`Gallery::map`].
    ///
    /// Errors: as [`Gallery::map`].
    pub fn of(
        material: &Material,
        has_tangents: bool,
        gallery: &mut Gallery<'s>,
        mipmaps: bool,
    ) -> Result<Option<Self>, Error> {
        let map = gallery.map(material.normal_texture.as_ref(), false, mipmaps)?;
        Ok(map.map(|map| Self { map, scale: material.normal_scale, has_tangents }))
    }
}

varyings! {
    /// A surface with a texture of normals at a pixel.
    pub struct Bumpy {
        /// World space.
        pub position: Vec3,
        /// World space, interpolated.
        pub normal: Vec3,
        /// The model's tangent, interpolated.
        pub tangent: Vec4,
        /// The vertex colour, in linear light, with straight alpha.
        pub color: Vec4,
        /// The first set of texture coordinates.
        pub uv: Vec2,
        /// The second set.
        pub uv_1: Vec2,
    }
}

#[shader]
fn bumpy(clip_from_world: Mat4, vertex: &Vertex) -> (Vec4, Bumpy) {
    let position = Vec3::from(vertex.position);
    let [uv, uv_1] = vertex.uvs;
    let varyings = Bumpy {
        position,
        normal: vertex.normal.into(),
        tangent: vertex.tangent.into(),
        color: vertex.color.into(),
        uv: uv.into(),
        uv_1: uv_1.into(),
    };
    (clip_from_world * position.extend(1.0), varyings)
}

#[shader]
impl NormalMap<'_> {
    /// The bent normal of the side that is seen.
    fn seen_normal<L: Lanes, S: Shader<Varyings<L> = Bumpy<L>>>(&self, f: &Fragment<L, S>) -> Vec3<L> {
        let Bumpy { position, uv, uv_1, .. } = f.dual();
        let texel = self.map.sample([uv, uv_1]).rgb() * 2.0 - 1.0;
        let texel = texel * [self.scale, self.scale, 1.0];
        let normal = if self.has_tangents {
            from_tangent(texel, f.normal, f.tangent)
        } else {
            let uv = self.map.coordinates([uv, uv_1]);
            let slopes = Slopes { position: [position.dx(), position.dy()], uv: [uv.dx(), uv.dy()] };
            let facing = f.front_facing().select(f.splat(1.0), f.splat(-1.0));
            from_slopes(texel, f.normal, facing, slopes)
        };
        seen::<L, S>(f, normal)
    }
}

/// [`Normals`](crate::Normals) with a normal texture.
#[derive(Clone, Debug)]
pub struct MappedNormals<'s> {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// The texture.
    pub normals: NormalMap<'s>,
}

#[shader]
impl Shader for MappedNormals<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Bumpy<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Bumpy<Scalar>) {
        bumpy(self.clip_from_world, vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::opaque(self.normals.seen_normal(f) * 0.5 + 0.5)
    }
}

/// [`Lambert`] with a normal texture.
#[derive(Clone, Debug)]
pub struct MappedLambert<'s> {
    /// Light, and base colour.
    pub lambert: Lambert<'s>,
    /// The texture.
    pub normals: NormalMap<'s>,
}

#[shader]
impl Shader for MappedLambert<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Bumpy<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Bumpy<Scalar>) {
        bumpy(self.lambert.clip_from_world, vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Bumpy { uv, uv_1, .. } = f.dual();
        let base = self.lambert.base.at(f.color, [uv, uv_1]);
        self.lambert.lit(base, self.normals.seen_normal(f))
    }
}
