//! What a file's extensions mean to a reader of geometry and base colours.

use super::schema::Root;
use crate::Error;
use crate::text::shown;

/// Required or not, nothing is missing without a word about it: read here, part of textures (whose absence has a note
/// of its own), or about things that are only drawn on request, such as the model's own lights.
const HONOURED: [&str; 5] =
    ["KHR_mesh_quantization", "KHR_lights_punctual", "KHR_texture_transform", "KHR_xmp_json_ld", "KHR_xmp"];

/// The rest by prefix: those that change how a surface looks, never where it is.
const LOOKS: [&str; 10] = [
    "KHR_materials_",
    "EXT_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
    "KHR_lights_",
    "EXT_lights_",
    "KHR_techniques_webgl",
    "KHR_animation_pointer",
    "FB_material",
];

/// Refuses a file whose geometry cannot be read without an extension that is not supported.
pub(super) fn check_required(root: &Root) -> Result<(), Error> {
    let is_supported = |name: &str| HONOURED.contains(&name) || LOOKS.iter().any(|prefix| name.starts_with(prefix));
    let names: Vec<String> =
        root.extensions_required.iter().filter(|name| !is_supported(name)).map(|name| shown(name.as_bytes())).collect();
    if names.is_empty() { Ok(()) } else { Err(Error::ExtensionRequired { names }) }
}

/// The extensions that would make the picture different.
pub(super) fn note(root: &Root) -> Option<String> {
    let is_texture = |name: &str| name.contains("_texture_");
    let names: Vec<String> = root
        .extensions_used
        .iter()
        .filter(|name| !HONOURED.contains(&name.as_str()) && !is_texture(name))
        .map(|name| shown(name.as_bytes()))
        .collect();
    (!names.is_empty()).then(|| format!("extensions not supported yet: {}", names.join(", ")))
}
