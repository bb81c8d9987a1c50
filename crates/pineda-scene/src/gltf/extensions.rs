//! Which extensions are read.
//!
//! KHR_texture_basisu is not: of its decoders `basis-universal` and `ktx2-rw` build C++, and `basisu`, Rust alone, has
//! had one release (0.1) so far. A texture's PNG or JPEG is shown where it has one.

use super::schema::Root;
use crate::Error;
use crate::text::shown;

/// What a file may require.
const SUPPORTED: [&str; 21] = [
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
];

/// Refuses a file that cannot be shown as it is meant without an extension that is not supported.
pub(super) fn check_required(root: &Root) -> Result<(), Error> {
    let names = unsupported(&root.extensions_required);
    if names.is_empty() { Ok(()) } else { Err(Error::ExtensionRequired { names }) }
}

/// Names the extensions that might make the picture different.
pub(super) fn note(root: &Root) -> Option<String> {
    let names = unsupported(&root.extensions_used);
    (!names.is_empty()).then(|| format!("extensions not supported: {}", names.join(", ")))
}

/// As many names as one line holds.
fn unsupported(names: &[String]) -> Vec<String> {
    const MOST: usize = 12;
    let names = names.iter().filter(|name| !SUPPORTED.contains(&name.as_str()));
    names.take(MOST).map(|name| shown(name.as_bytes())).collect()
}
