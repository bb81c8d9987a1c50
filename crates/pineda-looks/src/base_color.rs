//! A material's base colour at a fragment: factor x vertex colour x texture.
//!
//! What a material cuts out is no shader's business but [`CutOut`](crate::CutOut)'s.

use crate::gallery::UV_SETS;
use crate::{Gallery, Map};
use pineda::{Dual, Error, Lanes, Real, Rgba, Vec2, Vec4, shader};
use pineda_scene::{AlphaMode, Material, TextureRef};

/// What shaders multiply light with.
#[derive(Clone, Debug)]
pub struct BaseColor<'s> {
    /// Linear light, straight alpha.
    pub factor: [f32; 4],
    /// Multiplies it.
    pub map: Option<Map<'s>>,
    /// Whether alpha is what factor, texture and vertex colour make it, for blending; otherwise it is 1.
    pub has_alpha: bool,
}

impl Default for BaseColor<'_> {
    /// White.
    fn default() -> Self {
        Self { factor: [1.0; 4], map: None, has_alpha: false }
    }
}

impl<'s> BaseColor<'s> {
    /// An opaque colour, in linear light.
    #[must_use]
    pub fn opaque([r, g, b]: [f32; 3]) -> Self {
        Self { factor: [r, g, b, 1.0], ..Self::default() }
    }

    /// That of a material; of one of KHR_materials_pbrSpecularGlossiness the diffuse colour. For `mipmaps` see [`Gallery::map`].
    ///
    /// Errors: as [`Gallery::map`].
    pub fn of(material: &Material, gallery: &mut Gallery<'s>, mipmaps: bool) -> Result<Self, Error> {
        let (factor, texture) = factor_and_texture(material);
        let map = gallery.map(texture, true, mipmaps)?;
        Ok(Self { factor, map, has_alpha: material.alpha_mode == AlphaMode::Blend })
    }
}

/// Where a material has its base colour.
pub(crate) fn factor_and_texture(material: &Material) -> ([f32; 4], Option<&TextureRef>) {
    match &material.specular_glossiness {
        Some(diffuse) => (diffuse.diffuse_factor, diffuse.diffuse_texture.as_ref()),
        None => (material.base_color_factor, material.base_color_texture.as_ref()),
    }
}

#[shader]
impl BaseColor<'_> {
    /// In linear light, with straight alpha, where the vertex colour and both sets of texture coordinates are these.
    pub fn at<L: Lanes>(&self, vertex_color: Vec4<L>, uvs: [Vec2<Dual<L>>; UV_SETS]) -> Rgba<L> {
        let mut color = Rgba::from(vertex_color * self.factor);
        if let Some(map) = &self.map {
            color *= map.sample(uvs);
        }
        if self.has_alpha { color } else { Rgba { a: Real::new(color.a.lanes(), 1.0), ..color } }
    }
}
