use pineda_scene::{Error, Format, Limits, NoFiles, load_bytes};
use serde_json::{Value, json};

use crate::gltf_file::{File, push};

/// The file with one place in its JSON (a path as in `/nodes/0/mesh`) changed or added.
fn with(place: &str, value: Value) -> File {
    let mut file = File::square();
    let (parent, key) = place.rsplit_once('/').unwrap();
    let parent = file.json.pointer_mut(parent).unwrap();
    match key.parse::<usize>() {
        Ok(index) => parent[index] = value,
        Err(_) => parent[key] = value,
    }
    file
}

#[test]
fn gltf_json_errors() {
    let fails = |text: &str, says: &[&str]| crate::fails(Format::Gltf, text, says);
    fails("", &["glTF, JSON line 1, column 0", "complete?"]);
    fails("{", &["JSON line 1"]);
    fails("{}", &["asset"]);
    fails("[1, 2]", &["JSON"]);
    fails("{\"asset\": {\"version\": \"2.0\"}}", &["nothing to draw"]);
    fails("{\"asset\": {\"version\": \"1.0\"}, \"meshes\": {\"a\": 1}}", &["version '1.0'", "glTF 2.0"]);
    fails("{\"asset\": {\"version\": \"3.0\"}}", &["version '3.0'"]);
    fails("{\"asset\": {\"version\": \"2.0\"},\n\"scene\": -1}", &["line 2", "not negative"]);
    fails("{\"asset\": {\"version\": \"2.0\"}, \"scene\": 1.5}", &["not negative"]);
    fails(&format!("{{\"asset\": {{\"version\": \"2.0\"}}, \"extras\": {}", "[".repeat(100_000)), &["JSON"]);
    let names = vec!["\"\""; Limits::JSON_LIST + 1].join(",");
    fails(&format!("{{\"asset\": {{\"version\": \"2.0\"}}, \"extensionsUsed\": [{names}]}}"), &["Limits::JSON_LIST"]);
}

#[test]
fn gltf_glb_errors() {
    let good = File::square().glb();
    let fails = |bytes: &[u8], says: &[&str]| crate::fails(Format::Gltf, bytes, says);
    let changed = |at: usize, byte: u8| {
        let mut bytes = good.clone();
        bytes[at] = byte;
        bytes
    };
    fails(&good[..8], &["byte 8", "cut short"]);
    fails(&good[..good.len() - 1], &["byte 8", "cut short"]);
    fails(&changed(4, 1), &["byte 4", "version 1"]);
    fails(&changed(14, 255), &["byte 12", "cut short"]);
    fails(&changed(16, b'X'), &["byte 12", "not its JSON"]);
    fails(b"glTF\x02\0\0\0\x0c\0\0\0", &["cut short"]);
    // Another kind of chunk in place of the binary one.
    let binary = good.windows(4).position(|w| w == b"BIN\0").unwrap();
    fails(&changed(binary, b'X'), &["buffer 0", "not in the file"]);
}

#[test]
fn gltf_references_to_what_does_not_exist() {
    with("/scene", json!(1)).fails(&["scene 1", "does not exist"]);
    with("/scenes/0/nodes", json!([9])).fails(&["node 9", "does not exist"]);
    with("/nodes/0/children", json!([9])).fails(&["node 9", "does not exist"]);
    with("/nodes/0/mesh", json!(9)).fails(&["node 0", "mesh 9"]);
    with("/meshes/0/primitives/0/material", json!(9)).fails(&["mesh 0, primitive 0", "material 9"]);
    with("/meshes/0/primitives/0/attributes/POSITION", json!(9))
        .fails(&["primitive 0, POSITION, accessor 9", "does not exist"]);
    with("/meshes/0/primitives/0/indices", json!(9)).fails(&["primitive 0, indices, accessor 9"]);
    with("/accessors/0/bufferView", json!(9)).fails(&["accessor 0, buffer view 9", "does not exist"]);
    with("/bufferViews/0/buffer", json!(9)).fails(&["buffer 9", "does not exist"]);
    with("/nodes/0/mesh", json!(u64::MAX)).fails(&["mesh 18446744073709551615"]);
}

#[test]
fn gltf_nodes_that_are_no_trees() {
    let mut file = File::square();
    file.json["nodes"] = json!([{"children": [1]}, {"children": [2]}, {"children": [0], "mesh": 0}]);
    file.fails(&["node 0", "its own ancestor"]);
    file.json["nodes"] = json!([{"children": [0]}]);
    file.fails(&["node 0", "its own ancestor"]);
    file.json["nodes"] = json!([{"children": [1, 2]}, {"children": [3]}, {"children": [3]}, {"mesh": 0}]);
    file.fails(&["node 3", "twice"]);
    // Without scenes a cycle has no root: nothing is drawn, and nothing hangs.
    file.json["nodes"] = json!([{"children": [1]}, {"children": [0], "mesh": 0}]);
    file.json.as_object_mut().unwrap().remove("scenes");
    file.json.as_object_mut().unwrap().remove("scene");
    file.fails(&["nothing to draw"]);
}

#[test]
fn gltf_nodes_too_deep() {
    let mut file = File::square();
    let mut nodes: Vec<_> = (1..5000).map(|child| json!({"children": [child]})).collect();
    nodes.push(json!({"mesh": 0}));
    file.json["nodes"] = json!(nodes);
    file.fails(&["1025 nodes above a node", "1024 are allowed", "Limits::nesting"]);
    nodes.drain(..5000 - 1025);
    let chain: Vec<_> = (1..1025).map(|child| json!({"children": [child]})).chain([json!({"mesh": 0})]).collect();
    file.json["nodes"] = json!(chain);
    assert_eq!(file.loaded().scene.objects.len(), 1);
}

#[test]
fn gltf_wrong_accessors() {
    with("/accessors/0/count", json!(5)).fails(&["accessor 0, buffer view 0", "5 elements need 60 bytes", "only 48"]);
    with("/accessors/0/count", json!(u64::MAX)).fails(&["buffer view 0", "18446744073709551615 elements"]);
    with("/accessors/0/byteOffset", json!(4)).fails(&["need 52 bytes"]);
    with("/accessors/0/byteOffset", json!(u64::MAX)).fails(&["need 18446744073709551615 bytes"]);
    with("/accessors/0/componentType", json!(5124)).fails(&["accessor 0", "component type 5124"]);
    with("/accessors/0/type", json!("VEC2")).fails(&["accessor 0", "POSITION with 2 numbers each: expected 3"]);
    with("/accessors/0/type", json!("MAT3")).fails(&["accessor 0", "4 elements need 144 bytes"]);
    with("/accessors/0/type", json!("MAT5")).fails(&["accessor 0", "MAT5"]);
    with("/accessors/0/count", json!(3)).fails(&["accessor 1", "index 3", "only 3 vertices"]);
    with("/accessors/1/componentType", json!(5120)).fails(&["accessor 1", "indices must be"]);
    with("/bufferViews/0/byteLength", json!(1000)).fails(&[
        "buffer view 0",
        "ends at byte 1000",
        "only 54 bytes",
        "cut short",
    ]);
    with("/bufferViews/0/byteOffset", json!(u64::MAX)).fails(&["buffer view 0", "cut short"]);
    with("/bufferViews/0/byteStride", json!(u64::MAX)).fails(&["buffer view 0", "4 elements need"]);
    with("/meshes/0/primitives/0/mode", json!(7)).fails(&["primitive 0", "mode 7"]);
    with("/meshes/0/primitives/0/attributes/NORMAL", json!(1)).fails(&["NORMAL with 1 numbers"]);
    let mut file = File::square();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0]);
    file.attribute("NORMAL", normals);
    file.fails(&["mesh 0, primitive 0", "1 elements in NORMAL, but 4 in POSITION"]);
}

#[test]
fn gltf_wrong_sparse_accessors() {
    let sparse = |indices: &[u8], count: u64| {
        let mut file = File::square();
        let indices = file.view(indices);
        let values = file.view(&[0; 24]);
        let sparse = json!({"count": count, "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values}});
        file.json["accessors"][0]["sparse"] = sparse;
        file
    };
    assert!(sparse(&[1, 2], 2).read().is_ok());
    sparse(&[2, 1], 2).fails(&["accessor 0", "do not increase"]);
    sparse(&[1, 1], 2).fails(&["do not increase"]);
    sparse(&[1, 4], 2).fails(&["sparse index 4", "4 elements"]);
    sparse(&[1], 2).fails(&["accessor 0, sparse, buffer view 2", "2 elements need 2 bytes"]);
    sparse(&[0, 1, 2], 3).fails(&["buffer view 3", "need 36 bytes"]);
    sparse(&[0, 1], u64::MAX).fails(&["sparse, buffer view 2"]);
    let mut file = sparse(&[0, 1], 2);
    file.json["accessors"][0]["sparse"]["indices"]["componentType"] = json!(5126);
    file.fails(&["sparse", "component type 5126"]);
}

#[test]
fn gltf_extensions_that_cannot_be_read() {
    let required = |names: Value| with("/extensionsRequired", names);
    required(json!(["X_x"])).fails(&["requires X_x", "without this extension"]);
    required(json!(["X_x", "X_y"])).fails(&["X_x, X_y", "without these extensions"]);
    required(json!(["KHR_materials_unlit", "KHR_texture_basisu"])).fails(&["requires KHR_texture_basisu,"]);
    assert!(required(json!(["KHR_materials_unlit", "KHR_materials_volume"])).read().is_ok());
}

#[test]
fn gltf_buffers_outside_the_folder_are_refused() {
    for uri in [
        "../a.bin",
        "%2e%2e/a.bin",
        "a/../../b",
        "/etc/passwd",
        "file:///etc/passwd",
        "http://host/a.bin",
        "C:\\a.bin",
        "\\\\host\\a",
        "%ff",
    ] {
        with("/buffers/0", json!({"byteLength": 54, "uri": uri})).fails(&[uri, "not in the model's folder"]);
    }
    with("/buffers/0", json!({"byteLength": 54, "uri": "a.bin"})).fails(&["'a.bin'", "put it beside the model"]);
    with("/buffers/0", json!({"byteLength": 54, "uri": "data:;base64,A*"})).fails(&["buffer 0", "base64"]);
    with("/buffers/0", json!({"byteLength": 54, "uri": "data:;base64,AAAA"}))
        .fails(&["buffer 0 has only 3 bytes", "cut short"]);
}

fn limited(file: &File, limits: Limits) -> &'static str {
    match load_bytes(file.text().as_bytes(), Format::Gltf, &NoFiles, &limits) {
        Err(Error::Limit { field, .. }) => field,
        other => panic!("{other:?}"),
    }
}

#[test]
fn gltf_limits() {
    let file = File::square();
    assert_eq!(limited(&file, Limits { vertices: 3, ..Limits::default() }), "Limits::vertices");
    assert_eq!(limited(&file, Limits { triangles: 1, ..Limits::default() }), "Limits::triangles");
    assert_eq!(limited(&file, Limits { objects: 0, ..Limits::default() }), "Limits::objects");
    assert_eq!(limited(&file, Limits { file_bytes: 10, ..Limits::default() }), "Limits::file_bytes");
}

/// Few bytes that ask for very much: each is refused before the memory is taken.
#[test]
fn gltf_bombs() {
    // Zeros without a byte behind them.
    let mut file = File::new();
    push(&mut file.json["accessors"], json!({"componentType": 5126, "type": "VEC3", "count": 4_000_000_000u64}));
    file.attribute("POSITION", 0);
    assert_eq!(limited(&file, Limits::default()), "Limits::expanded");
    file.json["accessors"][0]["count"] = json!(u64::MAX);
    assert_eq!(limited(&file, Limits::default()), "Limits::expanded");
    // Indices without a byte behind them.
    let mut file = File::triangle();
    push(&mut file.json["accessors"], json!({"componentType": 5125, "type": "SCALAR", "count": 4_000_000_000u64}));
    file.primitive()["indices"] = json!(1);
    assert_eq!(limited(&file, Limits::default()), "Limits::expanded");
    // One mesh by many nodes.
    let mut file = File::new();
    let position = file.floats("VEC3", &[0.5; 9000]);
    file.attribute("POSITION", position);
    let nodes: Vec<_> = (0..10_000).collect();
    file.json["scenes"][0]["nodes"] = json!(nodes);
    file.json["nodes"] = json!(vec![json!({"mesh": 0}); 10_000]);
    assert_eq!(limited(&file, Limits { expanded: 1 << 20, ..Limits::default() }), "Limits::expanded");
    // Many primitives without triangles by many nodes.
    file.json["meshes"][0]["primitives"] = json!(vec![json!({"attributes": {}}); 10_000]);
    assert_eq!(limited(&file, Limits::default()), "Limits::objects");
}

/// A bug once: three bytes of JSON took 1,500 in memory, and 2^20 times as many were allowed.
#[test]
fn gltf_lists_of_nothing_are_limited_by_their_memory() {
    let list = |name: &str, count: usize| {
        let elements = vec!["{}"; count].join(",");
        File::square().text().replacen('{', &format!("{{\"{name}\": [{elements}],"), 1)
    };
    crate::fails(Format::Gltf, list("materials", 1 << 20), &["Limits::JSON_BYTES"]);
    assert!(crate::read(Format::Gltf, list("materials", 1 << 14)).is_ok());
}
