//! How surfaces look, in the words of glTF 2.0 and its KHR_materials extensions.

use std::sync::Arc;

use crate::TextureRef;

/// How a surface looks. Factors are linear light; a texture multiplies the factor beside it, and is linear unless its
/// documentation says sRGB. A texture that the file names but that could not be read is `None`.
///
/// An extension that a file does not use is `None`, and means what its specification says of that: nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The file's name for it; empty where it has none.
    pub name: Arc<str>,
    /// Linear light, straight alpha; multiplies [`Vertex::color`](crate::Vertex::color).
    pub base_color_factor: [f32; 4],
    /// sRGB, with alpha.
    pub base_color_texture: Option<TextureRef>,
    /// 0 for a dielectric, 1 for a metal.
    pub metallic_factor: f32,
    /// Perceptual roughness: 0 for a mirror, 1 for the dullest surface.
    pub roughness_factor: f32,
    /// Roughness in green, metalness in blue.
    pub metallic_roughness_texture: Option<TextureRef>,
    /// The direction of the normal, `2 * rgb - 1`, in the frame of tangent, bitangent and normal.
    pub normal_texture: Option<TextureRef>,
    /// Multiplies x and y of the normal texture.
    pub normal_scale: f32,
    /// How much ambient light there is, in red: 1 for all.
    pub occlusion_texture: Option<TextureRef>,
    /// 0 leaves the occlusion texture out, 1 is all of it.
    pub occlusion_strength: f32,
    /// Linear light, times [`Material::emissive_strength`].
    pub emissive_factor: [f32; 3],
    /// sRGB.
    pub emissive_texture: Option<TextureRef>,
    /// KHR_materials_emissive_strength; otherwise 1.
    pub emissive_strength: f32,
    /// KHR_materials_unlit: the base colour is what is seen, whatever the light.
    pub unlit: bool,
    /// KHR_materials_ior: the index of refraction, otherwise 1.5; 0 stands for infinity.
    pub ior: f32,
    /// KHR_materials_specular.
    pub specular: Option<Specular>,
    /// KHR_materials_clearcoat.
    pub clearcoat: Option<Clearcoat>,
    /// KHR_materials_sheen.
    pub sheen: Option<Sheen>,
    /// KHR_materials_transmission.
    pub transmission: Option<Transmission>,
    /// KHR_materials_volume.
    pub volume: Option<Volume>,
    /// KHR_materials_iridescence.
    pub iridescence: Option<Iridescence>,
    /// KHR_materials_anisotropy.
    pub anisotropy: Option<Anisotropy>,
    /// KHR_materials_pbrSpecularGlossiness: if there, it takes the place of base colour, metalness and roughness.
    pub specular_glossiness: Option<SpecularGlossiness>,
    /// Whether back faces are drawn. OBJ, STL and PLY: always; glTF: as the file says.
    pub double_sided: bool,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
}

impl Default for Material {
    /// White, opaque, double sided; a dielectric of middling roughness. It is what models have whose files say nothing
    /// of materials, glTF's aside: these have the specification's default, [`Material::gltf`].
    fn default() -> Self {
        Self { metallic_factor: 0.0, roughness_factor: 0.5, double_sided: true, ..Self::gltf() }
    }
}

impl Material {
    /// glTF's default material (specification, 5.19): white, opaque, seen from the front only; a rough metal.
    pub fn gltf() -> Self {
        Self {
            name: "".into(),
            base_color_factor: [1.0; 4],
            base_color_texture: None,
            metallic_factor: 1.0,
            roughness_factor: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            occlusion_texture: None,
            occlusion_strength: 1.0,
            emissive_factor: [0.0; 3],
            emissive_texture: None,
            emissive_strength: 1.0,
            unlit: false,
            ior: 1.5,
            specular: None,
            clearcoat: None,
            sheen: None,
            transmission: None,
            volume: None,
            iridescence: None,
            anisotropy: None,
            specular_glossiness: None,
            double_sided: false,
            alpha_mode: AlphaMode::Opaque,
        }
    }

    /// Each texture reference that there is.
    pub fn textures(&self) -> impl Iterator<Item = &TextureRef> {
        let own = [
            &self.base_color_texture,
            &self.metallic_roughness_texture,
            &self.normal_texture,
            &self.occlusion_texture,
            &self.emissive_texture,
        ];
        let specular = self.specular.iter().flat_map(|s| [&s.texture, &s.color_texture]);
        let clearcoat = self.clearcoat.iter().flat_map(|c| [&c.texture, &c.roughness_texture, &c.normal_texture]);
        let sheen = self.sheen.iter().flat_map(|s| [&s.color_texture, &s.roughness_texture]);
        let transmission = self.transmission.iter().map(|t| &t.texture);
        let volume = self.volume.iter().map(|v| &v.thickness_texture);
        let iridescence = self.iridescence.iter().flat_map(|i| [&i.texture, &i.thickness_texture]);
        let anisotropy = self.anisotropy.iter().map(|a| &a.texture);
        let glossiness =
            self.specular_glossiness.iter().flat_map(|s| [&s.diffuse_texture, &s.specular_glossiness_texture]);
        let all = own.into_iter().chain(specular).chain(clearcoat).chain(sheen).chain(transmission);
        all.chain(volume).chain(iridescence).chain(anisotropy).chain(glossiness).filter_map(Option::as_ref)
    }
}

/// What a material's alpha means, in glTF's words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Nothing: the surface is opaque.
    Opaque,
    /// Fragments with less alpha than the cutoff are not there, the others are opaque.
    Mask {
        /// Usually 0.5.
        cutoff: f32,
    },
    /// "Source over".
    Blend,
}

/// KHR_materials_specular: how strong a dielectric's reflection is.
#[derive(Clone, Debug, PartialEq)]
pub struct Specular {
    /// 0 for none, 1 for what the index of refraction says.
    pub factor: f32,
    /// The factor's, in alpha.
    pub texture: Option<TextureRef>,
    /// The colour seen head-on. May be beyond 1.
    pub color_factor: [f32; 3],
    /// The colour's. sRGB.
    pub color_texture: Option<TextureRef>,
}

impl Default for Specular {
    fn default() -> Self {
        Self { factor: 1.0, texture: None, color_factor: [1.0; 3], color_texture: None }
    }
}

/// KHR_materials_clearcoat: a varnish over everything else.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearcoat {
    /// 0 for none, 1 for all of it.
    pub factor: f32,
    /// The factor's, in red.
    pub texture: Option<TextureRef>,
    /// The varnish's own, perceptual.
    pub roughness_factor: f32,
    /// The roughness', in green.
    pub roughness_texture: Option<TextureRef>,
    /// The varnish's own normals; without one it has the geometry's.
    pub normal_texture: Option<TextureRef>,
    /// Multiplies x and y of the normal texture.
    pub normal_scale: f32,
}

impl Default for Clearcoat {
    fn default() -> Self {
        Self {
            factor: 0.0,
            texture: None,
            roughness_factor: 0.0,
            roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
        }
    }
}

/// KHR_materials_sheen: the soft light at the edges of cloth.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheen {
    /// Black for none.
    pub color_factor: [f32; 3],
    /// The colour's. sRGB.
    pub color_texture: Option<TextureRef>,
    /// Perceptual.
    pub roughness_factor: f32,
    /// The roughness', in alpha.
    pub roughness_texture: Option<TextureRef>,
}

/// KHR_materials_transmission: light that goes through an infinitely thin surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transmission {
    /// 0 for none, 1 for all that is not reflected.
    pub factor: f32,
    /// The factor's, in red.
    pub texture: Option<TextureRef>,
}

/// KHR_materials_volume: what is behind a transmitting surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// In the mesh's own space; 0 for a thin surface. The scene's objects are in world space: a renderer scales it by
    /// [`Object::thickness_scale`](crate::Object::thickness_scale).
    pub thickness_factor: f32,
    /// The thickness', in green.
    pub thickness_texture: Option<TextureRef>,
    /// How far light goes in world space until it has the colour below; infinite for clear matter.
    pub attenuation_distance: f32,
    /// What white light becomes over that distance.
    pub attenuation_color: [f32; 3],
}

impl Default for Volume {
    fn default() -> Self {
        Self {
            thickness_factor: 0.0,
            thickness_texture: None,
            attenuation_distance: f32::INFINITY,
            attenuation_color: [1.0; 3],
        }
    }
}

/// KHR_materials_iridescence: a thin film.
#[derive(Clone, Debug, PartialEq)]
pub struct Iridescence {
    /// 0 for none, 1 for all of it.
    pub factor: f32,
    /// The factor's, in red.
    pub texture: Option<TextureRef>,
    /// The film's index of refraction.
    pub ior: f32,
    /// The thickness where the texture is 0, in nanometres.
    pub thickness_minimum: f32,
    /// The thickness where the texture is 1, and without one, in nanometres.
    pub thickness_maximum: f32,
    /// The thickness', in green.
    pub thickness_texture: Option<TextureRef>,
}

impl Default for Iridescence {
    fn default() -> Self {
        Self {
            factor: 0.0,
            texture: None,
            ior: 1.3,
            thickness_minimum: 100.0,
            thickness_maximum: 400.0,
            thickness_texture: None,
        }
    }
}

/// KHR_materials_anisotropy: reflections that are longer one way, as of brushed metal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Anisotropy {
    /// 0 for none, 1 for the longest.
    pub strength: f32,
    /// Counter-clockwise from the tangent, in radians.
    pub rotation: f32,
    /// The direction `2 * rg - 1` in red and green, before the rotation; the strength's factor in blue.
    pub texture: Option<TextureRef>,
}

/// KHR_materials_pbrSpecularGlossiness: an older way to describe the same surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct SpecularGlossiness {
    /// Linear light, straight alpha.
    pub diffuse_factor: [f32; 4],
    /// sRGB, with alpha.
    pub diffuse_texture: Option<TextureRef>,
    /// The reflection's colour seen head-on.
    pub specular_factor: [f32; 3],
    /// 1 minus the perceptual roughness.
    pub glossiness_factor: f32,
    /// The specular colour, sRGB; the glossiness' in alpha, linear.
    pub specular_glossiness_texture: Option<TextureRef>,
}

impl Default for SpecularGlossiness {
    fn default() -> Self {
        Self {
            diffuse_factor: [1.0; 4],
            diffuse_texture: None,
            specular_factor: [1.0; 3],
            glossiness_factor: 1.0,
            specular_glossiness_texture: None,
        }
    }
}
