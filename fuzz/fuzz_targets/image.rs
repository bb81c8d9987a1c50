#![no_main]

//! A texture: PNG, JPEG or WebP.

use pineda_fuzz::{glb, read};
use pineda_scene::Format;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let length = bytes.len();
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}],
        "materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}],
        "textures": [{{"source": 0}}], "images": [{{"bufferView": 0}}],
        "accessors": [{{"componentType": 5126, "type": "VEC3", "count": 3}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {length}}}], "buffers": [{{"byteLength": {length}}}]}}"#
    );
    read(Format::Gltf, &glb(&json, bytes));
});
