//! Extensions that say where geometry is: instances, compressed buffer views.

use pineda_scene::{Error, Format, Limits, NoFiles, load_bytes};
use serde_json::json;

use crate::gltf_file::{File, push};
use crate::{only, positions};

#[test]
fn gltf_instances() {
    let mut file = File::triangle();
    let translations = file.floats("VEC3", &[1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    let scales = file.floats("VEC3", &[1.0, 1.0, 1.0, 3.0, -3.0, 3.0]);
    // No turn, and half a turn about z, in bytes.
    let rotations = file.accessor(&[0, 0, 0, 127, 0, 0, 127, 0], 5120, "VEC4", 2);
    file.json["accessors"][rotations]["normalized"] = json!(true);
    let attributes = json!({"TRANSLATION": translations, "SCALE": scales, "ROTATION": rotations, "_ID": 99});
    file.json["nodes"] = json!([{"mesh": 0, "translation": [0, 0, 5], "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}}]);
    file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    file.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
    let loaded = file.loaded();
    assert!(loaded.notes.is_empty());
    let [first, second] = &loaded.scene.objects[..] else { panic!("two instances") };
    assert_eq!(positions(first), [[1.0, 0.0, 5.0], [2.0, 0.0, 5.0], [1.0, 1.0, 5.0]]);
    assert_eq!(positions(second), [[2.0, 0.0, 5.0], [-1.0, 0.0, 5.0], [2.0, 3.0, 5.0]]);
    // The second is mirrored.
    assert_eq!((first.triangles[0], second.triangles[0]), ([0, 1, 2], [0, 2, 1]));
    let instancing = "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes";
    *file.json.pointer_mut(&format!("{instancing}/SCALE")).unwrap() = json!(0);
    file.fails(&["node 0, EXT_mesh_gpu_instancing", "SCALE needs 3 numbers for each instance"]);
    *file.json.pointer_mut(instancing).unwrap() = json!({});
    file.fails(&["nothing to draw"]);
}

#[test]
fn gltf_instances_without_bytes_are_limited() {
    let mut file = File::triangle();
    let zeros = json!({"componentType": 5126, "type": "VEC3", "count": 5_000_000});
    let translations = push(&mut file.json["accessors"], zeros);
    file.node()["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": translations}}});
    let error = load_bytes(file.text().as_bytes(), Format::Gltf, &NoFiles, &Limits::default()).unwrap_err();
    assert!(matches!(error, Error::Limit { field: "Limits::objects", .. }), "{error}");
}

/// Streams written by hand: the version 1 of attributes and of indices.
#[test]
fn gltf_compressed_buffer_views() {
    for name in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        let mut file = File::new();
        // Three elements of 12 bytes. Each channel is stored as it is (control bits 3), and the bits that have changed
        // since the element before (mode 2): the x of the second and the y of the third are 1.0.
        let mut stream = vec![0xa1, 0xff, 0xff, 0xff];
        let one = 1f32.to_bits();
        for changes in [[0, one, 0], [0, 0, one], [0, 0, 0]] {
            for byte in 0..4 {
                stream.extend(changes.map(|change: u32| change.to_le_bytes()[byte]));
            }
        }
        stream.extend([0; 24 - 15]);
        stream.extend([0; 12]);
        stream.extend([2, 2, 2]);
        let compressed = |file: &mut File, stream: &[u8], stride: u32, count: u32, mode: &str| {
            let view = file.view(stream);
            let mut definition = file.json["bufferViews"][view].take();
            definition["byteStride"] = json!(stride);
            definition["count"] = json!(count);
            definition["mode"] = json!(mode);
            let length = stride * count;
            // The copy for others is not there.
            file.json["bufferViews"][view] =
                json!({"buffer": 1, "byteOffset": 1000, "byteLength": length, "extensions": {name: definition}});
            view
        };
        push(&mut file.json["buffers"], json!({"byteLength": 2000, "extensions": {name: {"fallback": true}}}));
        let view = compressed(&mut file, &stream, 12, 3, "ATTRIBUTES");
        let accessor = json!({"bufferView": view, "componentType": 5126, "type": "VEC3", "count": 3});
        let accessor = push(&mut file.json["accessors"], accessor);
        file.attribute("POSITION", accessor);
        // Indices as differences from one of the last two: 2, 1, 0.
        let view = compressed(&mut file, &[0xd1, 8, 2, 2, 0, 0, 0, 0], 2, 3, "INDICES");
        let accessor = json!({"bufferView": view, "componentType": 5123, "type": "SCALAR", "count": 3});
        let accessor = push(&mut file.json["accessors"], accessor);
        file.primitive()["indices"] = json!(accessor);
        file.json["extensionsUsed"] = json!([name, "KHR_mesh_quantization"]);
        file.json["extensionsRequired"] = json!([name]);
        let loaded = file.loaded();
        assert!(loaded.notes.is_empty());
        assert_eq!(positions(only(&loaded)), [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
        assert_eq!(only(&loaded).triangles, [[2, 1, 0]]);
        file.json["bufferViews"][0]["extensions"][name]["mode"] = json!("INDICES");
        file.fails(&["buffer view 0", "2 or 4 bytes"]);
        file.json["bufferViews"][0]["extensions"][name]["byteLength"] = json!(1u64 << 40);
        file.fails(&["buffer view 0", "cut short"]);
    }
}
