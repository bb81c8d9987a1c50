#![no_main]

//! A buffer view with EXT_meshopt_compression: positions, or the indices of a triangle list.
//!
//! The first three bytes say how it is to be read: mode and filter, elements, and bytes of an element.

use pineda_fuzz::{glb, read};
use pineda_scene::Format;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let [how, count, stride, stream @ ..] = bytes else { return };
    let length = stream.len();
    let mode = ["ATTRIBUTES", "TRIANGLES", "INDICES"][usize::from(how % 3)];
    let filter = ["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"][usize::from(how / 3 % 5)];
    let (positions, indices, kind) = if mode == "ATTRIBUTES" {
        (0, 1, r#""componentType": 5126, "type": "VEC3""#)
    } else {
        (1, 0, r#""componentType": 5125, "type": "SCALAR""#)
    };
    let other = if mode == "ATTRIBUTES" {
        r#""componentType": 5125, "type": "SCALAR""#
    } else {
        r#""componentType": 5126, "type": "VEC3""#
    };
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": {positions}}}, "indices": {indices}}}]}}],
        "accessors": [{{"bufferView": 0, "count": {count}, {kind}}}, {{"count": 255, {other}}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {length}, "byteStride": {stride}, "extensions": {{"EXT_meshopt_compression": {{
            "buffer": 0, "byteLength": {length}, "count": {count}, "byteStride": {stride}, "mode": "{mode}", "filter": "{filter}"}}}}}}],
        "buffers": [{{"byteLength": {length}}}]}}"#
    );
    read(Format::Gltf, &glb(&json, stream));
});
