//! A material's numbers and textures, as the shader wants them.

use crate::gallery::{Gallery, Map};
use pineda::Error;
use pineda_scene::{AlphaMode, Material, TextureRef};

/// What a surface is made of: factors, and the maps that multiply them.
#[derive(Debug)]
pub(super) struct Coating<'s> {
    pub(super) base_color: [f32; 4],
    pub(super) base_color_map: Option<Map<'s>>,
    pub(super) workflow: Workflow<'s>,
    pub(super) normal_map: Option<Map<'s>>,
    pub(super) normal_scale: f32,
    pub(super) occlusion_map: Option<Map<'s>>,
    pub(super) occlusion_strength: f32,
    pub(super) emissive: [f32; 3],
    pub(super) emissive_map: Option<Map<'s>>,
    pub(super) unlit: bool,
    /// What a dielectric reflects head-on: ((ior - 1) / (ior + 1))^2.
    pub(super) reflectance: f32,
    pub(super) ior: f32,
    pub(super) specular: Option<Specular<'s>>,
    pub(super) clearcoat: Option<Clearcoat<'s>>,
    pub(super) sheen: Option<Sheen<'s>>,
    pub(super) transmission: Option<Transmission<'s>>,
    pub(super) anisotropy: Option<Anisotropy<'s>>,
    pub(super) iridescence: Option<Iridescence<'s>>,
    pub(super) alpha_mode: AlphaMode,
}

/// Which numbers say how the surface reflects.
#[derive(Debug)]
pub(super) enum Workflow<'s> {
    Metallic { metallic: f32, roughness: f32, map: Option<Map<'s>> },
    Specular { specular: [f32; 3], glossiness: f32, map: Option<Map<'s>> },
}

#[derive(Debug)]
pub(super) struct Specular<'s> {
    pub(super) factor: f32,
    pub(super) map: Option<Map<'s>>,
    pub(super) color: [f32; 3],
    pub(super) color_map: Option<Map<'s>>,
}

#[derive(Debug)]
pub(super) struct Clearcoat<'s> {
    pub(super) factor: f32,
    pub(super) map: Option<Map<'s>>,
    pub(super) roughness: f32,
    pub(super) roughness_map: Option<Map<'s>>,
    pub(super) normal_map: Option<Map<'s>>,
    pub(super) normal_scale: f32,
}

#[derive(Debug)]
pub(super) struct Sheen<'s> {
    pub(super) color: [f32; 3],
    pub(super) color_map: Option<Map<'s>>,
    pub(super) roughness: f32,
    pub(super) roughness_map: Option<Map<'s>>,
}

#[derive(Debug)]
pub(super) struct Transmission<'s> {
    pub(super) factor: f32,
    pub(super) map: Option<Map<'s>>,
    /// On the stage; 0 for a thin wall.
    pub(super) thickness: f32,
    pub(super) thickness_map: Option<Map<'s>>,
    /// What is left of light after a unit of the stage, as exponents of e.
    pub(super) absorption: [f32; 3],
}

#[derive(Debug)]
pub(super) struct Anisotropy<'s> {
    pub(super) strength: f32,
    /// Cosine and sine of the direction, from the tangent towards the bitangent.
    pub(super) direction: [f32; 2],
    pub(super) map: Option<Map<'s>>,
}

#[derive(Debug)]
pub(super) struct Iridescence<'s> {
    pub(super) factor: f32,
    pub(super) map: Option<Map<'s>>,
    pub(super) ior: f32,
    /// Nanometres.
    pub(super) thickness: [f32; 2],
    pub(super) thickness_map: Option<Map<'s>>,
}

impl<'s> Coating<'s> {
    /// `scale` is how long the object's unit is on the stage. Errors: no memory for the textures' smaller levels.
    pub(super) fn new(
        material: &Material,
        gallery: &mut Gallery<'s>,
        mipmaps: bool,
        scale: f32,
    ) -> Result<Self, Error> {
        let mut map = |texture: &Option<TextureRef>, is_srgb: bool| gallery.map(texture.as_ref(), is_srgb, mipmaps);
        let (base_color, base_color_map, workflow) = match &material.specular_glossiness {
            Some(model) => {
                let workflow = Workflow::Specular {
                    specular: model.specular_factor,
                    glossiness: model.glossiness_factor,
                    map: map(&model.specular_glossiness_texture, true)?,
                };
                (model.diffuse_factor, map(&model.diffuse_texture, true)?, workflow)
            }
            None => {
                let workflow = Workflow::Metallic {
                    metallic: material.metallic_factor,
                    roughness: material.roughness_factor,
                    map: map(&material.metallic_roughness_texture, false)?,
                };
                (material.base_color_factor, map(&material.base_color_texture, true)?, workflow)
            }
        };
        // 0 stands for infinity.
        let ior = if material.ior == 0.0 { f32::INFINITY } else { material.ior };
        let reflectance =
            if ior.is_infinite() { 1.0 } else { ((ior - 1.0) / (ior + 1.0)) * ((ior - 1.0) / (ior + 1.0)) };
        let mut specular = None;
        if let Some(model) = &material.specular {
            let (factor, color) = (model.factor, model.color_factor);
            let (factor_map, color_map) = (map(&model.texture, false)?, map(&model.color_texture, true)?);
            specular = Some(Specular { factor, map: factor_map, color, color_map });
        }
        let mut clearcoat = None;
        if let Some(model) = &material.clearcoat {
            clearcoat = Some(Clearcoat {
                factor: model.factor,
                map: map(&model.texture, false)?,
                roughness: model.roughness_factor,
                roughness_map: map(&model.roughness_texture, false)?,
                normal_map: map(&model.normal_texture, false)?,
                normal_scale: model.normal_scale,
            });
        }
        let mut sheen = None;
        if let Some(model) = &material.sheen {
            sheen = Some(Sheen {
                color: model.color_factor,
                color_map: map(&model.color_texture, true)?,
                roughness: model.roughness_factor,
                roughness_map: map(&model.roughness_texture, false)?,
            });
        }
        let mut transmission = None;
        if let Some(model) = &material.transmission {
            let volume = material.volume.as_ref();
            let thickness = volume.map_or(0.0, |volume| volume.thickness_factor * scale);
            let absorption = volume.map_or([0.0; 3], |volume| {
                let distance = volume.attenuation_distance * scale;
                volume.attenuation_color.map(|color| libm::logf(color.max(1e-4)) / distance)
            });
            transmission = Some(Transmission {
                factor: model.factor,
                map: map(&model.texture, false)?,
                thickness,
                thickness_map: match volume {
                    Some(volume) => map(&volume.thickness_texture, false)?,
                    None => None,
                },
                absorption,
            });
        }
        let mut anisotropy = None;
        if let Some(model) = &material.anisotropy {
            let direction = [libm::cosf(model.rotation), libm::sinf(model.rotation)];
            anisotropy = Some(Anisotropy { strength: model.strength, direction, map: map(&model.texture, false)? });
        }
        let mut iridescence = None;
        if let Some(model) = &material.iridescence {
            iridescence = Some(Iridescence {
                factor: model.factor,
                map: map(&model.texture, false)?,
                ior: model.ior,
                thickness: [model.thickness_minimum, model.thickness_maximum],
                thickness_map: map(&model.thickness_texture, false)?,
            });
        }
        Ok(Self {
            base_color,
            base_color_map,
            workflow,
            normal_map: map(&material.normal_texture, false)?,
            normal_scale: material.normal_scale,
            occlusion_map: map(&material.occlusion_texture, false)?,
            occlusion_strength: material.occlusion_strength,
            emissive: material.emissive_factor.map(|c| c * material.emissive_strength),
            emissive_map: map(&material.emissive_texture, true)?,
            unlit: material.unlit,
            reflectance,
            ior,
            specular,
            clearcoat,
            sheen,
            transmission,
            anisotropy,
            iridescence,
            alpha_mode: material.alpha_mode,
        })
    }

    /// Whether anything is looked up where the surface is.
    pub(super) fn has_maps(&self) -> bool {
        let Self { base_color_map, normal_map, occlusion_map, emissive_map, .. } = self;
        let mut has = [base_color_map, normal_map, occlusion_map, emissive_map].into_iter().any(Option::is_some);
        has |= match &self.workflow {
            Workflow::Metallic { map, .. } | Workflow::Specular { map, .. } => map.is_some(),
        };
        has |= self.specular.as_ref().is_some_and(|s| s.map.is_some() || s.color_map.is_some());
        has |= self
            .clearcoat
            .as_ref()
            .is_some_and(|c| c.map.is_some() || c.roughness_map.is_some() || c.normal_map.is_some());
        has |= self.sheen.as_ref().is_some_and(|s| s.color_map.is_some() || s.roughness_map.is_some());
        has |= self.transmission.as_ref().is_some_and(|t| t.map.is_some() || t.thickness_map.is_some());
        has |= self.iridescence.as_ref().is_some_and(|i| i.map.is_some() || i.thickness_map.is_some());
        // Without coordinates there is no direction to be anisotropic along.
        has | self.anisotropy.is_some()
    }
}
