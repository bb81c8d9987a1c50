//! glTF: sparse accessors, buffers in other places, instances, compressed geometry.

use super::make::{Gltf, floats};
use super::{Blank, Case, Error, Picture, case};
use serde_json::{Value, json};

pub(super) fn cases() -> Vec<Case> {
    [sparse(), buffers(), instances(), meshopt(), draco()].into_iter().flatten().collect()
}

fn sparse() -> Vec<Case> {
    let sparse = |name, indices: &[u8], count: u64, wanted| {
        let mut file = Gltf::plain();
        let [indices, values] = [file.view(indices), file.view(&floats(&[0.25; 6]))];
        let sparse = json!({"count": count, "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values}});
        case(name, "a.glb", file.set("/accessors/0/sparse", sparse).glb(), wanted)
    };
    vec![
        sparse("sparse-good", &[1, 2], 2, Picture(&[])),
        sparse("sparse-not-in-order", &[2, 1], 2, Error(&["accessor 0", "do not increase"])),
        sparse("sparse-twice", &[1, 1], 2, Error(&["do not increase"])),
        sparse("sparse-out-of-range", &[1, 4], 2, Error(&["sparse index 4", "4 elements"])),
        sparse("sparse-too-few", &[1], 2, Error(&["sparse, buffer view", "need 2 bytes"])),
        sparse("sparse-huge", &[1, 2], u64::MAX, Error(&["sparse, buffer view"])),
    ]
}

fn buffers() -> Vec<Case> {
    let changed =
        |name, place: &str, value: Value, wanted| case(name, "a.glb", Gltf::plain().set(place, value).glb(), wanted);
    let uri = |name, uri: &str, wanted| case(name, "a.gltf", Gltf::plain().text_with(uri), wanted);
    vec![
        changed(
            "count-5",
            "/accessors/0/count",
            json!(5),
            Error(&["accessor 0, buffer view 0", "5 elements need 60 bytes"]),
        ),
        changed("count-0", "/accessors/0/count", json!(0), Error(&["4 elements in NORMAL, but 0 in POSITION"])),
        changed("count-huge", "/accessors/0/count", json!(u64::MAX), Error(&["18446744073709551615 elements"])),
        changed("count-float-huge", "/accessors/0/count", json!(1e300), Error(&["JSON", "not negative"])),
        changed(
            "count-from-nowhere",
            "/accessors/0",
            json!({"componentType": 5126, "type": "VEC3", "count": 4_000_000_000u64}),
            Error(&["Limits::"]),
        ),
        changed("offset-overflows", "/accessors/0/byteOffset", json!(u64::MAX), Error(&["accessor 0", "bytes"])),
        changed("offset-not-aligned", "/accessors/0/byteOffset", json!(1), Error(&["need 49 bytes"])),
        changed("stride-overflows", "/bufferViews/0/byteStride", json!(u64::MAX), Error(&["4 elements need"])),
        changed("stride-1", "/bufferViews/0/byteStride", json!(1), Blank(&[])),
        changed("view-overflows", "/bufferViews/0/byteLength", json!(u64::MAX), Error(&["buffer view 0", "cut short"])),
        changed("view-behind", "/bufferViews/0/byteOffset", json!(1e6), Error(&["buffer view 0", "cut short"])),
        changed("component-unknown", "/accessors/0/componentType", json!(5124), Error(&["component type 5124"])),
        changed("type-unknown", "/accessors/0/type", json!("MAT5"), Error(&["MAT5"])),
        changed("indices-are-floats", "/accessors/1/componentType", json!(5126), Error(&["accessor 1"])),
        uri("data-not-base64", "data:;base64,A*", Error(&["buffer 0", "base64"])),
        uri("data-without-comma", "data:application/octet-stream", Error(&["buffer 0", "no comma"])),
        uri("data-short", "data:;base64,AAAA", Error(&["only 3 bytes", "cut short"])),
        uri("data-unicode", "dätä:;base64,AAAA", Error(&["not in the model's folder"])),
        uri("buffer-missing", "gone.bin", Error(&["'gone.bin'", "put it beside the model"])),
        uri("buffer-short", "a.bin", Error(&["only 10 bytes", "cut short"])).beside("a.bin", [0; 10]),
        uri("buffer-is-the-model", "a.gltf", Error(&["accessor 1", "only 4 vertices"])),
        uri("uri-long", &"a".repeat(1 << 20), Error(&["cannot be read"])),
    ]
}

fn instances() -> Vec<Case> {
    let instanced = |name, count: u64, view: bool, wanted| {
        let mut file = Gltf::plain();
        let places = file.floats("VEC3", &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
        file.json["accessors"][places]["count"] = json!(count);
        if !view {
            file.json["accessors"][places].as_object_mut().unwrap().remove("bufferView");
        }
        let extensions = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}});
        case(name, "a.glb", file.set("/nodes/0/extensions", extensions).glb(), wanted)
    };
    vec![
        instanced("instances-good", 2, true, Picture(&[])),
        instanced("instances-too-many", 3, true, Error(&["node 0, EXT_mesh_gpu_instancing", "need 36 bytes"])),
        instanced("instances-none", 0, true, Error(&["nothing to draw"])),
        instanced("instances-from-nowhere", 1 << 40, false, Error(&["Limits::expanded"])),
        instanced("instances-a-million-from-nowhere", 1 << 20, false, Error(&["objects", "Limits::objects"])),
    ]
}

/// Three indices, 0, 1, 2.
const SEQUENCE: [u8; 8] = [0xd1, 0, 4, 4, 0, 0, 0, 0];

fn meshopt() -> Vec<Case> {
    let packed = |bytes: &[u8], change: Value| {
        let mut file = Gltf::plain();
        let view = file.view(bytes);
        let mut layout = json!({"buffer": 0, "byteOffset": file.json["bufferViews"][view]["byteOffset"], "byteLength": bytes.len(),
            "byteStride": 2, "count": 3, "mode": "INDICES"});
        layout.as_object_mut().unwrap().extend(change.as_object().unwrap().clone());
        let place = format!("/bufferViews/{view}/extensions");
        file.set(&place, json!({"EXT_meshopt_compression": layout}))
            .set("/accessors/1", json!({"bufferView": view, "componentType": 5123, "type": "SCALAR", "count": 3}))
    };
    let of = |name, bytes: &[u8], change: Value, wanted| case(name, "a.glb", packed(bytes, change).glb(), wanted);
    let many = {
        let file = packed(&SEQUENCE, json!({"mode": "ATTRIBUTES", "count": 60_000, "byteStride": 256}));
        let view = file.json["bufferViews"][file.json["bufferViews"].as_array().unwrap().len() - 1].clone();
        let mut views = file.json["bufferViews"].as_array().unwrap().clone();
        views.extend(vec![view; 20_000]);
        file.set("/bufferViews", json!(views))
    };
    vec![
        of("meshopt-good", &SEQUENCE, json!({}), Picture(&[])),
        of("meshopt-cut-short", &SEQUENCE[..4], json!({}), Error(&["buffer view", "cut short"])),
        of("meshopt-empty", &[], json!({}), Error(&["buffer view", "cut short"])),
        of("meshopt-header", &[0; 8], json!({}), Error(&["buffer view"])),
        of("meshopt-count-huge", &SEQUENCE, json!({"count": u64::MAX}), Error(&["Limits::expanded"])),
        of("meshopt-stride-huge", &SEQUENCE, json!({"byteStride": u64::MAX}), Error(&["Limits::expanded"])),
        of("meshopt-mode-unknown", &SEQUENCE, json!({"mode": "SPLINES"}), Error(&["mode SPLINES"])),
        of("meshopt-filter-unknown", &SEQUENCE, json!({"filter": "BLUR"}), Error(&["no filter"])),
        of(
            "meshopt-attributes-of-zeros",
            &[0xa0; 8],
            json!({"mode": "ATTRIBUTES", "byteStride": 4, "count": 1000}),
            Error(&["buffer view"]),
        ),
        of(
            "meshopt-index-out-of-range",
            &[0xd1, 18, 4, 4, 0, 0, 0, 0],
            json!({}),
            Error(&["accessor 1", "index 65531"]),
        ),
        case("meshopt-many-views-of-one-stream", "a.glb", many.glb(), Error(&["buffer view"])),
    ]
}

/// The grid of 5 x 5 points that the reader's own tests have, compressed at level 7.
const GRID: &[u8] = include_bytes!("grid.drc");

fn draco() -> Vec<Case> {
    let packed = |stream: &[u8], primitives: usize| {
        let mut file = Gltf::plain();
        let view = file.view(stream);
        let primitive = json!({
            "attributes": {"POSITION": 0, "COLOR_0": 1}, "indices": 2,
            "extensions": {"KHR_draco_mesh_compression": {"bufferView": view, "attributes": {"POSITION": 0, "COLOR_0": 1}}}});
        file.set("/meshes/0/primitives", json!(vec![primitive; primitives])).set(
            "/accessors",
            json!([
            {"componentType": 5126, "type": "VEC3", "count": 25},
            {"componentType": 5121, "type": "VEC4", "count": 25, "normalized": true},
            {"componentType": 5123, "type": "SCALAR", "count": 96}]),
        )
    };
    let of = |name, stream: &[u8], wanted| case(name, "a.glb", packed(stream, 1).glb(), wanted);
    let attribute = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes/COLOR_0";
    let view = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/bufferView";
    let faces = {
        let mut stream = GRID.to_vec();
        // Behind the header the numbers of vertices and faces, in seven bits a byte.
        stream.splice(12..13, [0xff, 0xff, 0xff, 0xff, 0x0f]);
        stream
    };
    vec![
        of("draco-good", GRID, Picture(&[])),
        of(
            "draco-cut-short",
            &GRID[..GRID.len() / 2],
            Error(&["mesh 0, primitive 0, KHR_draco_mesh_compression", "cannot be decoded"]),
        ),
        of("draco-empty", &[], Error(&["cannot be decoded"])),
        of("draco-header-only", &GRID[..11], Error(&["cannot be decoded"])),
        of(
            "draco-of-text",
            b"DRACO, but not really: as text goes on, so does the stream",
            Error(&["cannot be decoded"]),
        ),
        of("draco-faces-huge", &faces, Error(&["cannot be decoded"])),
        case(
            "draco-attribute-missing",
            "a.glb",
            packed(GRID, 1).set(attribute, json!(9)).glb(),
            Error(&["no attribute for COLOR_0"]),
        ),
        case("draco-view-missing", "a.glb", packed(GRID, 1).set(view, json!(99)).glb(), Error(&["buffer view 99"])),
        case(
            "draco-many-primitives-of-one-stream",
            "a.glb",
            {
                let mut stream = GRID.to_vec();
                stream.truncate(GRID.len() - 1);
                stream.resize(1 << 20, 0xff);
                packed(&stream, 20_000).glb()
            },
            Error(&["KHR_draco_mesh_compression"]),
        ),
    ]
}
