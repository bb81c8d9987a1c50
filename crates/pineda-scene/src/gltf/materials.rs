//! Materials: base colour, sides, alpha.

use super::schema::Root;
use crate::{AlphaMode, Material};

/// The file's materials, in its order.
pub(super) fn materials(root: &Root) -> Vec<Material> {
    let convert = |material: &super::schema::Material| Material {
        name: material.name.as_deref().unwrap_or_default().into(),
        base_color_factor: material.pbr_metallic_roughness.base_color_factor.unwrap_or([1.0; 4]),
        double_sided: material.double_sided,
        alpha_mode: match material.alpha_mode.as_deref() {
            Some("MASK") => AlphaMode::Mask { cutoff: material.alpha_cutoff.unwrap_or(0.5) },
            Some("BLEND") => AlphaMode::Blend,
            _ => AlphaMode::Opaque,
        },
        ..Material::gltf()
    };
    root.materials.iter().map(convert).collect()
}

pub(super) fn note(root: &Root) -> Option<String> {
    let is_opaque = |mode: Option<&str>| !matches!(mode, Some("MASK" | "BLEND"));
    let count = root.materials.iter().filter(|m| !is_opaque(m.alpha_mode.as_deref())).count();
    crate::note::transparency(count)
}
