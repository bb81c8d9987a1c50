use std::io;

use pineda_scene::{AlphaMode, Format, Limits, Normals, load_bytes};
use serde_json::json;

use crate::gltf_file::{File, push};
use crate::{corners, only, positions};

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn bytes_of<const N: usize>(numbers: &[[u8; N]]) -> Vec<u8> {
    numbers.as_flattened().to_vec()
}

#[test]
fn gltf_triangle_without_indices() {
    let loaded = File::triangle().loaded();
    assert_eq!(corners(only(&loaded)), [TRIANGLE]);
    assert_eq!(only(&loaded).normals, Normals::Absent);
    let material = &loaded.scene.materials[only(&loaded).material];
    assert!(!material.double_sided && material.base_color_factor == [1.0; 4]);
    assert!(loaded.notes.is_empty());
}

#[test]
fn gltf_glb_and_files_and_data_uris_are_equal() {
    let mut file = File::square();
    let expected = file.loaded();
    assert_eq!(crate::read(Format::Gltf, file.glb()).unwrap(), expected);
    file.json["buffers"][0] = json!({"byteLength": file.buffer.len(), "uri": "sub%20folder/./a%2Db.bin"});
    let buffer = file.buffer.clone();
    let resolver = move |path: &str, _max: u64| match path {
        "sub folder/a-b.bin" => Ok(buffer.clone()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    let loaded = load_bytes(file.text().as_bytes(), Format::Gltf, &resolver, &Limits::default()).unwrap();
    assert_eq!(loaded, expected);
    // With a byte order mark, which some editors add.
    assert_eq!(crate::read(Format::Gltf, format!("\u{feff}{}", File::square().text())).unwrap(), expected);
}

#[test]
fn gltf_indices_of_all_types() {
    let expected = corners(only(&File::square().loaded()));
    for (component, bytes) in [
        (5121, vec![0, 1, 2, 0, 2, 3]),
        (5123, [0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect()),
        (5125, [0u32, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect()),
    ] {
        let mut file = File::square();
        let indices = file.accessor(&bytes, component, "SCALAR", 6);
        file.primitive()["indices"] = json!(indices);
        assert_eq!(corners(only(&file.loaded())), expected, "{component}");
    }
}

#[test]
fn gltf_strips_and_fans() {
    let triangles = |mode: u32, with_indices: bool| {
        let mut file = File::new();
        let points: Vec<f32> = (0..5).flat_map(|i| [i as f32, (i * i) as f32, 0.0]).collect();
        let position = file.floats("VEC3", &points);
        file.attribute("POSITION", position);
        file.primitive()["mode"] = json!(mode);
        if with_indices {
            let indices = file.accessor(&[4, 3, 2, 1, 0], 5121, "SCALAR", 5);
            file.primitive()["indices"] = json!(indices);
        }
        only(&file.loaded()).triangles.clone()
    };
    assert_eq!(triangles(5, false), [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
    assert_eq!(triangles(5, true), [[4, 3, 2], [3, 1, 2], [2, 1, 0]]);
    assert_eq!(triangles(6, false), [[1, 2, 0], [2, 3, 0], [3, 4, 0]]);
    assert_eq!(triangles(6, true), [[3, 2, 4], [2, 1, 4], [1, 0, 4]]);
    assert_eq!(triangles(4, false), [[0, 1, 2]]);
}

#[test]
fn gltf_points_and_lines() {
    let of = |mode: u32, with_indices: bool| {
        let mut file = File::square();
        file.primitive()["mode"] = json!(mode);
        let indices = file.accessor(&[3, 2, 0], 5121, "SCALAR", 3);
        file.primitive()["indices"] = json!(indices);
        if !with_indices {
            file.primitive().as_object_mut().unwrap().remove("indices");
        }
        let object = only(&file.loaded()).clone();
        assert!(object.triangles.is_empty() && !object.is_empty());
        (object.lines, object.points, object.vertices.len())
    };
    assert_eq!(of(0, false), (vec![], vec![0, 1, 2, 3], 4));
    assert_eq!(of(1, false), (vec![[0, 1], [2, 3]], vec![], 4));
    assert_eq!(of(2, false), (vec![[0, 1], [1, 2], [2, 3], [3, 0]], vec![], 4));
    assert_eq!(of(3, false), (vec![[0, 1], [1, 2], [2, 3]], vec![], 4));
    // Where few are named, those become vertices, in the order in which they are. Incomplete elements are left out.
    assert_eq!(of(0, true), (vec![], vec![0, 1, 2], 3));
    assert_eq!(of(1, true), (vec![[0, 1]], vec![], 2));
    assert_eq!(of(2, true), (vec![[3, 2], [2, 0], [0, 3]], vec![], 4));
    assert_eq!(of(3, true), (vec![[3, 2], [2, 0]], vec![], 4));
}

#[test]
fn gltf_primitives_without_positions_are_skipped_with_a_note() {
    let mut file = File::square();
    push(&mut file.json["meshes"][0]["primitives"], json!({"attributes": {}}));
    let loaded = file.loaded();
    assert_eq!(only(&loaded).triangles.len(), 2);
    assert_eq!(loaded.notes, ["1 primitive without positions skipped"]);
}

#[test]
fn gltf_interleaved_attributes_with_a_stride() {
    let mut file = File::new();
    let mut bytes = vec![0xff; 4];
    for corner in TRIANGLE {
        bytes.extend(corner.iter().flat_map(|c| c.to_le_bytes()));
        bytes.extend([0f32, 0.0, 1.0].iter().flat_map(|c| c.to_le_bytes()));
        bytes.extend([255, 0, 51, 255]);
    }
    // The last element need not be followed by a whole stride.
    let view = file.view(&bytes);
    file.json["bufferViews"][view]["byteStride"] = json!(28);
    let mut accessor = |offset: u32, component: u32, kind: &str| {
        let accessor = json!({"bufferView": view, "byteOffset": offset, "componentType": component, "type": kind, "count": 3, "normalized": component == 5121});
        push(&mut file.json["accessors"], accessor)
    };
    let [position, normal, color] = [accessor(4, 5126, "VEC3"), accessor(16, 5126, "VEC3"), accessor(28, 5121, "VEC4")];
    file.attribute("POSITION", position);
    file.attribute("NORMAL", normal);
    file.attribute("COLOR_0", color);
    let loaded = file.loaded();
    let object = only(&loaded);
    assert_eq!(corners(object), [TRIANGLE]);
    assert!(object.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0] && v.color == [1.0, 0.0, 0.2, 1.0]));
    assert_eq!(object.normals, Normals::Given);
}

#[test]
fn gltf_colours_of_all_types() {
    let color = |component: u32, kind: &str, bytes: &[u8]| {
        let mut file = File::triangle();
        let color = file.accessor(&bytes.repeat(3), component, kind, 3);
        // Whole numbers are parts of the largest even if "normalized" is forgotten.
        file.attribute("COLOR_0", color);
        only(&file.loaded()).vertices[2].color
    };
    assert_eq!(color(5121, "VEC3", &[255, 0, 51]), [1.0, 0.0, 0.2, 1.0]);
    assert_eq!(color(5121, "VEC4", &[255, 0, 51, 102]), [1.0, 0.0, 0.2, 0.4]);
    assert_eq!(color(5123, "VEC3", &bytes_of(&[65535u16, 0, 13107].map(u16::to_le_bytes))), [1.0, 0.0, 0.2, 1.0]);
    assert_eq!(color(5126, "VEC4", &bytes_of(&[1f32, 0.0, 0.2, 0.4].map(f32::to_le_bytes))), [1.0, 0.0, 0.2, 0.4]);
    assert_eq!(color(5126, "VEC3", &bytes_of(&[f32::NAN, 0.0, 0.2].map(f32::to_le_bytes))), [1.0; 4]);
}

#[test]
fn gltf_quantized_positions_and_normals() {
    let object = |component: u32, normalized: bool, bytes: &[u8]| {
        let mut file = File::new();
        for name in ["POSITION", "NORMAL"] {
            let accessor = file.accessor(bytes, component, "VEC3", 3);
            file.json["accessors"][accessor]["normalized"] = json!(normalized);
            file.attribute(name, accessor);
        }
        file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        file.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
        let loaded = file.loaded();
        assert!(loaded.notes.is_empty());
        only(&loaded).clone()
    };
    let shorts = |numbers: [i16; 9]| bytes_of(&numbers.map(i16::to_le_bytes));
    let points = object(5122, true, &shorts([32767, 0, 0, -32768, 0, 0, 0, 16384, 0]));
    assert_eq!(positions(&points), [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, (16384.0 / 32767.0) as f32, 0.0]]);
    assert_eq!(points.vertices[1].normal, [-1.0, 0.0, 0.0]);
    let points = object(5122, false, &shorts([3, 0, 0, 0, 4, 0, -5, 0, 0]));
    assert_eq!(positions(&points), [[3.0, 0.0, 0.0], [0.0, 4.0, 0.0], [-5.0, 0.0, 0.0]]);
    let points = object(5120, true, &[127, 0, 0, 0x80, 0, 0, 0, 0x81, 0]);
    assert_eq!(positions(&points), [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]);
    let points = object(5120, false, &[3, 0, 0, 0xff, 0, 0, 0, 4, 0]);
    assert_eq!(positions(&points), [[3.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 4.0, 0.0]]);
    let points = object(5121, true, &[255, 0, 0, 51, 0, 0, 0, 1, 0]);
    assert_eq!(positions(&points), [[1.0, 0.0, 0.0], [0.2, 0.0, 0.0], [0.0, (1.0 / 255.0) as f32, 0.0]]);
    let points = object(5123, false, &bytes_of(&[60000u16, 0, 0, 1, 0, 0, 0, 2, 0].map(u16::to_le_bytes)));
    assert_eq!(positions(&points), [[60000.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
}

#[test]
fn gltf_sparse_accessors() {
    for component in [5121u32, 5123, 5125] {
        let mut file = File::triangle();
        let size = [5121, 5123, 5125].iter().position(|&c| c == component).map_or(0, |i| 1 << i);
        let mut indices = vec![0; 2 * size];
        indices[size] = 2;
        let indices = file.view(&indices);
        let values = file.view(&bytes_of(&[7f32, 0.0, 0.0, 0.0, 8.0, 0.0].map(f32::to_le_bytes)));
        file.json["accessors"][0]["sparse"] = json!({
            "count": 2,
            "indices": {"bufferView": indices, "componentType": component},
            "values": {"bufferView": values},
        });
        assert_eq!(positions(only(&file.loaded())), [[7.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 8.0, 0.0]]);
        // Without a view of its own it is zeros below.
        file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
        assert_eq!(positions(only(&file.loaded())), [[7.0, 0.0, 0.0], [0.0; 3], [0.0, 8.0, 0.0]]);
    }
}

#[test]
fn gltf_nodes_are_multiplied_in_f64_and_rounded_once() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([
        {"children": [1], "scale": [0.1, 0.1, 0.1]},
        {"children": [2], "translation": [10.0, 0.0, 0.0]},
        {"mesh": 0, "scale": [3.0, 3.0, 3.0]},
    ]);
    let expected = TRIANGLE.map(|[x, y, z]| {
        let of = |c: f32, t: f64| ((0.1 * 3.0) * f64::from(c) + 0.1 * t) as f32;
        [of(x, 10.0), of(y, 0.0), of(z, 0.0)]
    });
    assert_eq!(positions(only(&file.loaded())), expected);
}

/// Front faces stay front faces, and normals outside, however the node is mirrored.
#[test]
fn gltf_mirrored_nodes_keep_their_front() {
    for scale in [[1, 1, 1], [-1, 1, 1], [1, -2, 3], [-1, -1, 1], [-1, -1, -1], [2, 3, -1]] {
        let mut file = File::triangle();
        let normals = file.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
        file.attribute("NORMAL", normals);
        file.node()["scale"] = json!(scale);
        let loaded = file.loaded();
        let [a, b, c] = corners(only(&loaded))[0];
        let sub = |a: [f32; 3], b: [f32; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let (u, v) = (sub(b, a), sub(c, a));
        let facing = u[0] * v[1] - u[1] * v[0];
        let normal = only(&loaded).vertices[0].normal;
        assert_eq!(normal, [0.0, 0.0, if scale[2] < 0 { -1.0 } else { 1.0 }], "{scale:?}");
        assert!(facing * normal[2] > 0.0, "{scale:?}");
        assert_eq!(only(&loaded).triangles[0][0], 0, "the first corner stays first");
    }
}

#[test]
fn gltf_normals_by_the_inverse_transpose() {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[1.0, 1.0, 0.0].repeat(3));
    file.attribute("NORMAL", normals);
    file.node()["scale"] = json!([2.0, 1.0, 1.0]);
    let [x, y, z] = only(&file.loaded()).vertices[0].normal;
    assert_eq!([x, y, z], [0.2f64.sqrt() as f32, 0.8f64.sqrt() as f32, 0.0]);
}

#[test]
fn gltf_a_node_that_flattens_its_mesh_is_drawn() {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[1.0, 0.0, 0.0].repeat(3));
    file.attribute("NORMAL", normals);
    file.node()["scale"] = json!([1.0, 1.0, 0.0]);
    let loaded = file.loaded();
    assert_eq!(only(&loaded).vertices[0].normal, [0.0, 0.0, 1.0]);
    assert_eq!(loaded.notes, ["3 normals without a direction replaced by the faces'"]);
}

#[test]
fn gltf_one_mesh_by_many_nodes() {
    let mut file = File::square();
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    file.json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}, {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,7,0,1]}]);
    let loaded = file.loaded();
    let first: Vec<_> = loaded.scene.objects.iter().map(|o| o.vertices[0].position).collect();
    assert_eq!(first, [[0.0; 3], [5.0, 0.0, 0.0], [0.0, 7.0, 0.0]]);
}

#[test]
fn gltf_which_scene() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0]}, {"mesh": 0, "translation": [2, 0, 0]}, {"children": [0]}]);
    file.json["scenes"] = json!([{"nodes": [0]}, {"nodes": [1]}]);
    let first = |file: &File| file.loaded().scene.objects.iter().map(|o| o.vertices[0].position[0]).collect::<Vec<_>>();
    file.json["scene"] = json!(1);
    assert_eq!(first(&file), [1.0]);
    file.json.as_object_mut().unwrap().remove("scene");
    assert_eq!(first(&file), [0.0]);
    // Without scenes: every node that is nobody's child.
    file.json.as_object_mut().unwrap().remove("scenes");
    assert_eq!(first(&file), [1.0, 2.0, 0.0]);
}

#[test]
fn gltf_vertices_that_no_triangle_names_are_left_out_of_shared_lists() {
    let mut file = File::new();
    let points: Vec<f32> = (0..1000).flat_map(|i| [i as f32, (i % 7) as f32, 0.0]).collect();
    let position = file.floats("VEC3", &points);
    let indices = file.accessor(&[200, 3, 9, 9, 3, 4], 5121, "SCALAR", 6);
    let primitives: Vec<_> =
        (0..3).map(|_| json!({"attributes": {"POSITION": position}, "indices": indices})).collect();
    file.json["meshes"][0]["primitives"] = json!(primitives);
    let loaded = file.loaded();
    assert_eq!(loaded.scene.objects.len(), 3);
    for object in &loaded.scene.objects {
        assert_eq!(object.triangles, [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(object.vertices.iter().map(|v| v.position[0]).collect::<Vec<_>>(), [200.0, 3.0, 9.0, 4.0]);
    }
}

#[test]
fn gltf_materials() {
    let mut file = File::square();
    file.json["materials"] = json!([
        {"name": "unused"},
        {"name": "glass", "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4]}, "doubleSided": true, "alphaMode": "BLEND"},
        {"alphaMode": "MASK", "alphaCutoff": 0.25},
        {"alphaMode": "MASK"},
    ]);
    file.primitive()["material"] = json!(1);
    let loaded = file.loaded();
    assert_eq!((loaded.scene.materials.len(), only(&loaded).material), (4, 1));
    let glass = &loaded.scene.materials[1];
    assert_eq!((&*glass.name, glass.base_color_factor, glass.double_sided), ("glass", [0.1, 0.2, 0.3, 0.4], true));
    let modes: Vec<_> = loaded.scene.materials.iter().map(|m| m.alpha_mode).collect();
    assert_eq!(
        modes,
        [AlphaMode::Opaque, AlphaMode::Blend, AlphaMode::Mask { cutoff: 0.25 }, AlphaMode::Mask { cutoff: 0.5 }]
    );
    assert!(loaded.notes.is_empty());
}

#[test]
fn gltf_extensions_that_are_not_read_are_named_in_one_line() {
    let mut file = File::square();
    file.json["extensionsUsed"] = json!(["KHR_materials_clearcoat", "X_one", "KHR_texture_transform", "X_two"]);
    file.json["extensionsRequired"] = json!(["KHR_texture_transform", "KHR_materials_clearcoat"]);
    assert_eq!(file.loaded().notes, ["extensions not supported: X_one, X_two"]);
}

#[test]
fn gltf_whole_numbers_written_as_floats() {
    let text = File::square().text().replace("\"count\":6", "\"count\":6.0").replace("\"mesh\":0", "\"mesh\":0.0");
    assert_eq!(only(&crate::read(Format::Gltf, text).unwrap()).triangles.len(), 2);
}

#[test]
fn gltf_buffers_that_geometry_does_not_need_are_not_read() {
    let mut file = File::square();
    push(&mut file.json["buffers"], json!({"byteLength": 1000, "uri": "missing.bin"}));
    assert_eq!(only(&file.loaded()).triangles.len(), 2);
}

#[test]
fn gltf_positions_that_are_not_finite_drop_their_triangles() {
    let mut file = File::square();
    file.buffer[0..4].copy_from_slice(&f32::NAN.to_le_bytes());
    file.fails(&["nothing to draw", "2 triangles dropped"]);
    let mut file = File::square();
    file.buffer[12..16].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let loaded = file.loaded();
    assert_eq!(only(&loaded).triangles, [[0, 2, 3]]);
    assert_eq!(loaded.notes, ["1 triangle dropped: a corner is infinite or not a number"]);
    // Finite in the file, but not in the world.
    let mut file = File::square();
    file.node()["scale"] = json!([1e300, 1, 1]);
    file.fails(&["nothing to draw"]);
}
