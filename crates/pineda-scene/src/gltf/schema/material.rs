//! Materials, as the JSON has them: in f64, so that a number too large for an f32 is one field's trouble, not the file's.

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::json::Whole;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Material {
    pub(in crate::gltf) name: Option<String>,
    #[serde(default)]
    pub(in crate::gltf) pbr_metallic_roughness: PbrMetallicRoughness,
    pub(in crate::gltf) normal_texture: Option<TextureInfo>,
    pub(in crate::gltf) occlusion_texture: Option<TextureInfo>,
    pub(in crate::gltf) emissive_texture: Option<TextureInfo>,
    pub(in crate::gltf) emissive_factor: Option<[f64; 3]>,
    #[serde(default)]
    pub(in crate::gltf) double_sided: bool,
    pub(in crate::gltf) alpha_mode: Option<String>,
    pub(in crate::gltf) alpha_cutoff: Option<f64>,
    #[serde(default)]
    pub(in crate::gltf) extensions: MaterialExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct PbrMetallicRoughness {
    pub(in crate::gltf) base_color_factor: Option<[f64; 4]>,
    pub(in crate::gltf) base_color_texture: Option<TextureInfo>,
    pub(in crate::gltf) metallic_factor: Option<f64>,
    pub(in crate::gltf) roughness_factor: Option<f64>,
    pub(in crate::gltf) metallic_roughness_texture: Option<TextureInfo>,
}

/// A reference to a texture. Normal textures have a scale, occlusion textures a strength.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct TextureInfo {
    pub(in crate::gltf) index: Whole,
    #[serde(default)]
    pub(in crate::gltf) tex_coord: Whole,
    pub(in crate::gltf) scale: Option<f64>,
    pub(in crate::gltf) strength: Option<f64>,
    #[serde(default)]
    pub(in crate::gltf) extensions: TextureInfoExtensions,
}

impl TextureInfo {
    /// The set of texture coordinates that it is looked up with.
    pub(in crate::gltf) fn uv_set(&self) -> Whole {
        self.extensions.transform.as_ref().and_then(|transform| transform.tex_coord).unwrap_or(self.tex_coord)
    }
}

#[derive(Debug, Default, Deserialize)]
pub(in crate::gltf) struct TextureInfoExtensions {
    #[serde(rename = "KHR_texture_transform")]
    pub(in crate::gltf) transform: Option<Transform>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Transform {
    pub(in crate::gltf) offset: Option<[f64; 2]>,
    pub(in crate::gltf) rotation: Option<f64>,
    pub(in crate::gltf) scale: Option<[f64; 2]>,
    pub(in crate::gltf) tex_coord: Option<Whole>,
}

#[derive(Debug, Default, Deserialize)]
pub(in crate::gltf) struct MaterialExtensions {
    #[serde(rename = "KHR_materials_unlit")]
    pub(in crate::gltf) unlit: Option<IgnoredAny>,
    #[serde(rename = "KHR_materials_emissive_strength")]
    pub(in crate::gltf) emissive_strength: Option<EmissiveStrength>,
    #[serde(rename = "KHR_materials_ior")]
    pub(in crate::gltf) ior: Option<Ior>,
    #[serde(rename = "KHR_materials_specular")]
    pub(in crate::gltf) specular: Option<Specular>,
    #[serde(rename = "KHR_materials_clearcoat")]
    pub(in crate::gltf) clearcoat: Option<Clearcoat>,
    #[serde(rename = "KHR_materials_sheen")]
    pub(in crate::gltf) sheen: Option<Sheen>,
    #[serde(rename = "KHR_materials_transmission")]
    pub(in crate::gltf) transmission: Option<Transmission>,
    #[serde(rename = "KHR_materials_volume")]
    pub(in crate::gltf) volume: Option<Volume>,
    #[serde(rename = "KHR_materials_iridescence")]
    pub(in crate::gltf) iridescence: Option<Iridescence>,
    #[serde(rename = "KHR_materials_anisotropy")]
    pub(in crate::gltf) anisotropy: Option<Anisotropy>,
    #[serde(rename = "KHR_materials_pbrSpecularGlossiness")]
    pub(in crate::gltf) specular_glossiness: Option<SpecularGlossiness>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct EmissiveStrength {
    pub(in crate::gltf) emissive_strength: Option<f64>,
}

#[derive(Debug, Deserialize)]
pub(in crate::gltf) struct Ior {
    pub(in crate::gltf) ior: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Specular {
    pub(in crate::gltf) specular_factor: Option<f64>,
    pub(in crate::gltf) specular_texture: Option<TextureInfo>,
    pub(in crate::gltf) specular_color_factor: Option<[f64; 3]>,
    pub(in crate::gltf) specular_color_texture: Option<TextureInfo>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Clearcoat {
    pub(in crate::gltf) clearcoat_factor: Option<f64>,
    pub(in crate::gltf) clearcoat_texture: Option<TextureInfo>,
    pub(in crate::gltf) clearcoat_roughness_factor: Option<f64>,
    pub(in crate::gltf) clearcoat_roughness_texture: Option<TextureInfo>,
    pub(in crate::gltf) clearcoat_normal_texture: Option<TextureInfo>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Sheen {
    pub(in crate::gltf) sheen_color_factor: Option<[f64; 3]>,
    pub(in crate::gltf) sheen_color_texture: Option<TextureInfo>,
    pub(in crate::gltf) sheen_roughness_factor: Option<f64>,
    pub(in crate::gltf) sheen_roughness_texture: Option<TextureInfo>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Transmission {
    pub(in crate::gltf) transmission_factor: Option<f64>,
    pub(in crate::gltf) transmission_texture: Option<TextureInfo>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Volume {
    pub(in crate::gltf) thickness_factor: Option<f64>,
    pub(in crate::gltf) thickness_texture: Option<TextureInfo>,
    pub(in crate::gltf) attenuation_distance: Option<f64>,
    pub(in crate::gltf) attenuation_color: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Iridescence {
    pub(in crate::gltf) iridescence_factor: Option<f64>,
    pub(in crate::gltf) iridescence_texture: Option<TextureInfo>,
    pub(in crate::gltf) iridescence_ior: Option<f64>,
    pub(in crate::gltf) iridescence_thickness_minimum: Option<f64>,
    pub(in crate::gltf) iridescence_thickness_maximum: Option<f64>,
    pub(in crate::gltf) iridescence_thickness_texture: Option<TextureInfo>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct Anisotropy {
    pub(in crate::gltf) anisotropy_strength: Option<f64>,
    pub(in crate::gltf) anisotropy_rotation: Option<f64>,
    pub(in crate::gltf) anisotropy_texture: Option<TextureInfo>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::gltf) struct SpecularGlossiness {
    pub(in crate::gltf) diffuse_factor: Option<[f64; 4]>,
    pub(in crate::gltf) diffuse_texture: Option<TextureInfo>,
    pub(in crate::gltf) specular_factor: Option<[f64; 3]>,
    pub(in crate::gltf) glossiness_factor: Option<f64>,
    pub(in crate::gltf) specular_glossiness_texture: Option<TextureInfo>,
}

impl Material {
    /// Every texture that it names.
    pub(in crate::gltf) fn textures(&self) -> impl Iterator<Item = &TextureInfo> {
        let pbr = &self.pbr_metallic_roughness;
        let own = [
            &pbr.base_color_texture,
            &pbr.metallic_roughness_texture,
            &self.normal_texture,
            &self.occlusion_texture,
            &self.emissive_texture,
        ];
        let e = &self.extensions;
        let specular = e.specular.iter().flat_map(|s| [&s.specular_texture, &s.specular_color_texture]);
        let clearcoat = e
            .clearcoat
            .iter()
            .flat_map(|c| [&c.clearcoat_texture, &c.clearcoat_roughness_texture, &c.clearcoat_normal_texture]);
        let sheen = e.sheen.iter().flat_map(|s| [&s.sheen_color_texture, &s.sheen_roughness_texture]);
        let transmission = e.transmission.iter().map(|t| &t.transmission_texture);
        let volume = e.volume.iter().map(|v| &v.thickness_texture);
        let iridescence = e.iridescence.iter().flat_map(|i| [&i.iridescence_texture, &i.iridescence_thickness_texture]);
        let anisotropy = e.anisotropy.iter().map(|a| &a.anisotropy_texture);
        let glossiness =
            e.specular_glossiness.iter().flat_map(|s| [&s.diffuse_texture, &s.specular_glossiness_texture]);
        let all = own.into_iter().chain(specular).chain(clearcoat).chain(sheen).chain(transmission);
        all.chain(volume).chain(iridescence).chain(anisotropy).chain(glossiness).filter_map(Option::as_ref)
    }
}
