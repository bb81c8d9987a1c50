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
    let zeros = json!({"componentType": 5126, "type": "VEC3", "count": 1_000_000});
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

/// A grid of 5 x 5 points as the encoder of `draco-core` writes it, without loss or with.
fn draco_grid(level: i32) -> Vec<u8> {
    use draco_core::{
        DataType, EncoderBuffer, EncoderOptions, FaceIndex, GeometryAttributeType, Mesh, MeshEncoder, PointAttribute,
        PointIndex,
    };
    let mut mesh = Mesh::new();
    let mut attribute = |kind, components, data_type, normalized, bytes: &dyn Fn(u32, u32) -> Vec<u8>| {
        let mut attribute = PointAttribute::new();
        attribute.init(kind, components, data_type, normalized, 25);
        for i in 0..25 {
            let bytes = bytes(i % 5, i / 5);
            attribute.buffer_mut().write(i as usize * bytes.len(), &bytes);
        }
        mesh.add_attribute(attribute);
    };
    let floats = |floats: &[f32]| floats.iter().flat_map(|f| f.to_le_bytes()).collect::<Vec<u8>>();
    attribute(GeometryAttributeType::Position, 3, DataType::Float32, false, &|x, y| floats(&[x as f32, y as f32, 0.0]));
    attribute(GeometryAttributeType::Color, 4, DataType::Uint8, true, &|x, y| vec![x as u8 * 51, y as u8 * 51, 0, 255]);
    mesh.set_num_faces(32);
    for cell in 0..16 {
        let a = cell % 4 + cell / 4 * 5;
        for (half, [b, c]) in [[a + 1, a + 6], [a + 6, a + 5]].into_iter().enumerate() {
            mesh.set_face(FaceIndex(2 * cell + half as u32), [PointIndex(a), PointIndex(b), PointIndex(c)]);
        }
    }
    let mut encoder = MeshEncoder::new();
    encoder.set_mesh(mesh);
    let mut options = EncoderOptions::new();
    options.set_compression_level(level);
    let mut buffer = EncoderBuffer::new();
    encoder.encode(&options, &mut buffer).unwrap();
    buffer.data().to_vec()
}

fn draco(stream: &[u8]) -> File {
    let mut file = File::new();
    let view = file.view(stream);
    for (name, component, kind, count) in
        [("POSITION", 5126, "VEC3", 25), ("COLOR_0", 5121, "VEC4", 25), ("", 5123, "SCALAR", 96)]
    {
        let accessor =
            json!({"componentType": component, "type": kind, "count": count, "normalized": component == 5121});
        let accessor = push(&mut file.json["accessors"], accessor);
        if name.is_empty() {
            file.primitive()["indices"] = json!(accessor);
        } else {
            file.attribute(name, accessor);
        }
    }
    file.primitive()["extensions"] =
        json!({"KHR_draco_mesh_compression": {"bufferView": view, "attributes": {"POSITION": 0, "COLOR_0": 1}}});
    file.json["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    file.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    file
}

#[test]
fn gltf_draco() {
    for level in [0, 5, 7, 10] {
        let mut file = draco(&draco_grid(level));
        let loaded = file.loaded();
        assert!(loaded.notes.is_empty());
        let object = only(&loaded);
        assert_eq!((object.triangles.len(), object.vertices.len()), (32, 25));
        let mut area = 0.0;
        for triangle in &object.triangles {
            let [a, b, c] = triangle.map(|v| object.vertices[v as usize]);
            let [[ax, ay, _], [bx, by, _], [cx, cy, _]] = [a, b, c].map(|v| v.position);
            area += (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
            for v in [a, b, c] {
                assert_eq!(v.color, [v.position[0] / 5.0, v.position[1] / 5.0, 0.0, 1.0], "{level}");
            }
        }
        assert_eq!(area, 32.0, "{level}");
        // Compressed, although the file does not say that it requires it.
        file.json.as_object_mut().unwrap().remove("extensionsRequired");
        assert_eq!(file.loaded().scene, loaded.scene);
    }
}

#[test]
fn gltf_draco_with_a_copy_is_not_decoded() {
    let mut file = File::square();
    file.primitive()["extensions"] =
        json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}});
    assert_eq!(only(&file.loaded()).triangles.len(), 2);
}

#[test]
fn gltf_draco_errors() {
    let stream = draco_grid(7);
    draco(&stream[..stream.len() / 2]).fails(&["mesh 0, primitive 0, KHR_draco_mesh_compression", "cannot be decoded"]);
    draco(b"DRACO?").fails(&["cannot be decoded"]);
    let mut file = draco(&stream);
    let extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    *file.json.pointer_mut(&format!("{extension}/attributes/COLOR_0")).unwrap() = json!(7);
    file.fails(&["no attribute for COLOR_0"]);
    *file.json.pointer_mut(&format!("{extension}/bufferView")).unwrap() = json!(7);
    file.fails(&["buffer view 7"]);
    // Damaged streams are errors or other meshes.
    for at in 0..stream.len() {
        for bits in [1, 0x40, 0xff] {
            let mut damaged = stream.clone();
            damaged[at] ^= bits;
            let _ = draco(&damaged).read();
        }
    }
}

/// A bug once: what fails cost nothing, so that a few bytes for each primitive had the decoder fail for minutes.
#[test]
fn gltf_draco_streams_that_primitives_share_are_counted_each_time() {
    let mut stream = draco_grid(7);
    stream.resize(1 << 16, 0xff);
    let mut file = draco(&stream);
    let good = file.view(&draco_grid(7));
    let mut mesh = file.json["meshes"][0].clone();
    file.json["meshes"][0]["primitives"] = json!(vec![file.primitive().clone(); 100]);
    mesh["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = json!(good);
    push(&mut file.json["meshes"], mesh);
    file.json["nodes"][0]["mesh"] = json!(1);
    assert!(load_bytes(&file.glb(), Format::Gltf, &NoFiles, &Limits::default()).is_ok());
    let limits = Limits { expanded: 0, ..Limits::default() };
    let error = load_bytes(&file.glb(), Format::Gltf, &NoFiles, &limits).unwrap_err();
    assert!(matches!(error, Error::Limit { field: "Limits::expanded", .. }), "{error}");
}
