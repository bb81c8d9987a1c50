#![no_main]

//! The stream of a primitive with KHR_draco_mesh_compression.

use pineda_fuzz::{glb, read};
use pineda_scene::Format;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let length = bytes.len();
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "COLOR_0": 1}}, "indices": 2,
            "extensions": {{"KHR_draco_mesh_compression": {{"bufferView": 0, "attributes": {{"POSITION": 0, "COLOR_0": 1}}}}}}}}]}}],
        "accessors": [{{"componentType": 5126, "type": "VEC3", "count": 25}},
            {{"componentType": 5121, "type": "VEC4", "normalized": true, "count": 25}},
            {{"componentType": 5123, "type": "SCALAR", "count": 96}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {length}}}], "buffers": [{{"byteLength": {length}}}]}}"#
    );
    read(Format::Gltf, &glb(&json, bytes));
});
