//! Materials, with what extensions say of them.

use super::images::Textures;
use super::schema::{self, Root, TextureInfo};
use crate::text::shown;
use crate::{
    AlphaMode, Anisotropy, Clearcoat, Iridescence, Material, Sheen, Specular, SpecularGlossiness, TextureRef,
    Transmission, Volume,
};

/// The file's materials, in its order; those that are not drawn without textures.
pub(super) fn materials(root: &Root, is_drawn: &[bool], textures: &Textures) -> Vec<Material> {
    let of = |(number, material): (usize, &schema::Material)| {
        let is_drawn = is_drawn.get(number).copied().unwrap_or(false);
        convert(material, &|info: &Option<TextureInfo>| {
            info.as_ref().filter(|_| is_drawn).and_then(|info| reference(info, textures))
        })
    };
    root.materials.iter().enumerate().map(of).collect()
}

fn convert(material: &schema::Material, texture: &dyn Fn(&Option<TextureInfo>) -> Option<TextureRef>) -> Material {
    let pbr = &material.pbr_metallic_roughness;
    let extensions = &material.extensions;
    let (normal_texture, normal_scale) = normal(&material.normal_texture, texture);
    let occlusion_strength = material.occlusion_texture.as_ref().and_then(|info| info.strength);
    Material {
        name: shown(material.name.as_deref().unwrap_or_default().as_bytes()).into(),
        base_color_factor: finite(pbr.base_color_factor, [1.0; 4]),
        base_color_texture: texture(&pbr.base_color_texture),
        metallic_factor: unit(pbr.metallic_factor, 1.0),
        roughness_factor: unit(pbr.roughness_factor, 1.0),
        metallic_roughness_texture: texture(&pbr.metallic_roughness_texture),
        normal_texture,
        normal_scale,
        occlusion_texture: texture(&material.occlusion_texture),
        occlusion_strength: unit(occlusion_strength, 1.0),
        emissive_factor: finite(material.emissive_factor, [0.0; 3]),
        emissive_texture: texture(&material.emissive_texture),
        emissive_strength: one(extensions.emissive_strength.as_ref().and_then(|e| e.emissive_strength), 1.0),
        unlit: extensions.unlit.is_some(),
        ior: one(extensions.ior.as_ref().and_then(|i| i.ior), 1.5),
        specular: extensions.specular.as_ref().map(|s| Specular {
            factor: unit(s.specular_factor, 1.0),
            texture: texture(&s.specular_texture),
            color_factor: finite(s.specular_color_factor, [1.0; 3]),
            color_texture: texture(&s.specular_color_texture),
        }),
        clearcoat: extensions.clearcoat.as_ref().map(|c| {
            let (normal_texture, normal_scale) = normal(&c.clearcoat_normal_texture, texture);
            Clearcoat {
                factor: unit(c.clearcoat_factor, 0.0),
                texture: texture(&c.clearcoat_texture),
                roughness_factor: unit(c.clearcoat_roughness_factor, 0.0),
                roughness_texture: texture(&c.clearcoat_roughness_texture),
                normal_texture,
                normal_scale,
            }
        }),
        sheen: extensions.sheen.as_ref().map(|s| Sheen {
            color_factor: finite(s.sheen_color_factor, [0.0; 3]),
            color_texture: texture(&s.sheen_color_texture),
            roughness_factor: unit(s.sheen_roughness_factor, 0.0),
            roughness_texture: texture(&s.sheen_roughness_texture),
        }),
        transmission: extensions.transmission.as_ref().map(|t| Transmission {
            factor: unit(t.transmission_factor, 0.0),
            texture: texture(&t.transmission_texture),
        }),
        volume: extensions.volume.as_ref().map(|v| Volume {
            thickness_factor: one(v.thickness_factor, 0.0),
            thickness_texture: texture(&v.thickness_texture),
            // 0 would be division by it: glTF wants more, and no matter at all is what comes closest.
            attenuation_distance: v
                .attenuation_distance
                .map(|d| d as f32)
                .filter(|&d| d > 0.0)
                .unwrap_or(f32::INFINITY),
            attenuation_color: finite(v.attenuation_color, [1.0; 3]),
        }),
        iridescence: extensions.iridescence.as_ref().map(|i| Iridescence {
            factor: unit(i.iridescence_factor, 0.0),
            texture: texture(&i.iridescence_texture),
            ior: one(i.iridescence_ior, 1.3),
            thickness_minimum: one(i.iridescence_thickness_minimum, 100.0),
            thickness_maximum: one(i.iridescence_thickness_maximum, 400.0),
            thickness_texture: texture(&i.iridescence_thickness_texture),
        }),
        anisotropy: extensions.anisotropy.as_ref().map(|a| Anisotropy {
            strength: unit(a.anisotropy_strength, 0.0),
            rotation: one(a.anisotropy_rotation, 0.0),
            texture: texture(&a.anisotropy_texture),
        }),
        specular_glossiness: extensions.specular_glossiness.as_ref().map(|s| SpecularGlossiness {
            diffuse_factor: finite(s.diffuse_factor, [1.0; 4]),
            diffuse_texture: texture(&s.diffuse_texture),
            specular_factor: finite(s.specular_factor, [1.0; 3]),
            glossiness_factor: unit(s.glossiness_factor, 1.0),
            specular_glossiness_texture: texture(&s.specular_glossiness_texture),
        }),
        double_sided: material.double_sided,
        alpha_mode: match material.alpha_mode.as_deref() {
            Some("MASK") => AlphaMode::Mask { cutoff: one(material.alpha_cutoff, 0.5) },
            Some("BLEND") => AlphaMode::Blend,
            _ => AlphaMode::Opaque,
        },
    }
}

fn normal(
    info: &Option<TextureInfo>,
    texture: &dyn Fn(&Option<TextureInfo>) -> Option<TextureRef>,
) -> (Option<TextureRef>, f32) {
    (texture(info), one(info.as_ref().and_then(|info| info.scale), 1.0))
}

fn finite<const N: usize>(factor: Option<[f64; N]>, default: [f32; N]) -> [f32; N] {
    factor
        .map(|factor| factor.map(|f| f as f32))
        .filter(|factor| factor.iter().all(|f| f.is_finite()))
        .unwrap_or(default)
}

fn one(factor: Option<f64>, default: f32) -> f32 {
    factor.map(|f| f as f32).filter(|f| f.is_finite()).unwrap_or(default)
}

/// A factor that has a sense within 0..=1 only.
fn unit(factor: Option<f64>, default: f32) -> f32 {
    one(factor, default).clamp(0.0, 1.0)
}

fn reference(info: &TextureInfo, textures: &Textures) -> Option<TextureRef> {
    let texture = *textures.number_of.get(&info.index.index())?;
    let transform = info.extensions.transform.as_ref();
    Some(TextureRef {
        texture,
        uv_set: info.uv_set().index(),
        transform: transform.map_or(TextureRef::IDENTITY, matrix),
    })
}

/// Translation * rotation * scale, as KHR_texture_transform multiplies them: v goes down, so that a positive angle
/// turns the image's coordinates counter-clockwise as they are seen.
fn matrix(transform: &schema::Transform) -> [[f32; 3]; 2] {
    let [x, y] = transform.offset.unwrap_or([0.0; 2]);
    let [w, h] = transform.scale.unwrap_or([1.0; 2]);
    let angle = transform.rotation.unwrap_or(0.0);
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let matrix = [[cos * w, sin * h, x], [-sin * w, cos * h, y]].map(|row| row.map(|c| c as f32));
    if matrix.as_flattened().iter().all(|c| c.is_finite()) { matrix } else { TextureRef::IDENTITY }
}
