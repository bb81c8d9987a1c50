//! glTF: the JSON, the GLB container, and what refers to what.

use super::make::{Gltf, INDICES, POSITION, cut, patched, utf16};
use super::{Blank, Case, Error, Picture, Wanted, case};
use serde_json::{Value, json};

pub(super) fn cases() -> Vec<Case> {
    [text(), container(), references(), trees(), lists()].into_iter().flatten().collect()
}

/// A good file with one place changed.
fn with(name: &'static str, place: &str, value: Value, wanted: Wanted) -> Case {
    case(name, "a.gltf", Gltf::good().set(place, value).text(), wanted)
}

fn text() -> Vec<Case> {
    let good = Gltf::good().text();
    let half = cut(good.clone().into_bytes(), good.len() / 2);
    let twice = good.replacen("{", "{\"nodes\": [],", 1);
    let deep = |open: &str, close: &str| {
        let (open, close) = (open.repeat(100_000), close.repeat(100_000));
        good.replacen("{", &format!("{{\"extras\": {open}0{close},"), 1)
    };
    vec![
        case("json-empty", "a.gltf", "", Error(&["line 1", "complete?"])),
        case("json-spaces", "a.gltf", " \n \n ", Error(&["line 3"])),
        case("json-cut-short", "a.gltf", half, Error(&["JSON line 1", "EOF"])),
        case("json-list", "a.gltf", "[1, 2]", Error(&["JSON"])),
        case("json-zeros", "a.gltf", [0; 64], Error(&["JSON line 1, column 1"])),
        case("json-utf16", "a.gltf", utf16(&good), Error(&["line 1", "UTF-16"])),
        case("json-utf8-mark", "a.gltf", format!("\u{feff}{good}"), Picture(&[])),
        case(
            "json-not-utf8",
            "a.gltf",
            good.replace("scene\"", "\u{1}\"").replace('\u{1}', "\\ud800"),
            Error(&["JSON"]),
        ),
        case("json-key-twice", "a.gltf", twice, Error(&["duplicate field `nodes`"])),
        case("json-deep-lists", "a.gltf", deep("[", "]"), Picture(&[])),
        case("json-deep-objects", "a.gltf", deep("{\"a\":", "}"), Picture(&[])),
        case("json-text-behind", "a.gltf", good.clone() + "}", Error(&["trailing"])),
        case("json-number-too-large", "a.gltf", good.replace("0.7", "1e999"), Error(&["JSON", "number out of range"])),
        case("json-nan", "a.gltf", good.replace("0.7", "NaN"), Error(&["JSON line 1"])),
        with("asset-1.0", "/asset/version", json!("1.0"), Error(&["version '1.0'", "glTF 2.0"])),
        with("asset-number", "/asset/version", json!(2.0), Error(&["JSON", "a string"])),
        with("scene-negative", "/scene", json!(-1), Error(&["not negative"])),
        with("scene-fraction", "/scene", json!(0.5), Error(&["not negative"])),
        with("required", "/extensionsRequired", json!(["X_unknown"]), Error(&["requires X_unknown"])),
        with("used", "/extensionsUsed", json!(["X_unknown"]), Picture(&["not supported: X_unknown"])),
        with(
            "required-strange",
            "/extensionsRequired",
            json!(["\u{7}\n\u{1b}[31m".repeat(1000)]),
            Error(&["requires"]),
        ),
    ]
}

fn container() -> Vec<Case> {
    let good = Gltf::good().glb();
    let json = u32::from_le_bytes([good[12], good[13], good[14], good[15]]) as usize;
    let binary = 20 + json;
    let glb = |name, bytes: Vec<u8>, wanted| case(name, "a.glb", bytes, wanted);
    vec![
        glb("glb-empty", Vec::new(), Error(&["line 1", "complete?"])),
        glb("glb-header-cut-short", cut(good.clone(), 8), Error(&["byte 8", "cut short"])),
        glb("glb-cut-short", cut(good.clone(), good.len() - 5), Error(&["byte 8", "cut short"])),
        glb("glb-version-1", patched(good.clone(), 4, &[1]), Error(&["byte 4", "version 1"])),
        glb("glb-length-huge", patched(good.clone(), 8, &[255; 4]), Error(&["byte 8", "4294967295 bytes"])),
        glb("glb-json-length-huge", patched(good.clone(), 12, &[255; 4]), Error(&["byte 12", "cut short"])),
        glb("glb-json-length-0", patched(good.clone(), 12, &[0; 4]), Error(&["byte 20", "cut short"])),
        glb("glb-json-missing", patched(good.clone(), 16, b"BIN\0"), Error(&["byte 12", "not its JSON"])),
        glb("glb-binary-length-huge", patched(good.clone(), binary, &[255, 255, 255, 127]), Error(&["cut short"])),
        glb(
            "glb-binary-of-another-kind",
            patched(good.clone(), binary + 4, b"XXXX"),
            Error(&["buffer 0", "not in the file"]),
        ),
        glb(
            "glb-binary-short",
            {
                let mut short = Gltf::good();
                short.binary.truncate(20);
                short.glb()
            },
            Error(&["buffer view 6", "only 20 bytes", "cut short"]),
        ),
        glb("glb-is-obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec(), Error(&["JSON line 1, column 1"])),
    ]
}

fn references() -> Vec<Case> {
    let attribute = "/meshes/0/primitives/0/attributes";
    vec![
        with("no-scene", "/scene", json!(7), Error(&["scene 7", "does not exist"])),
        with("no-node", "/scenes/0/nodes", json!([99]), Error(&["node 99", "does not exist"])),
        with("no-child", "/nodes/1/children", json!([99]), Error(&["node 99", "does not exist"])),
        with("no-mesh", "/nodes/0/mesh", json!(u64::MAX), Error(&["node 0", "mesh 18446744073709551615"])),
        with("no-skin", "/nodes/0/skin", json!(3), Error(&["skin 3", "does not exist"])),
        with("no-camera", "/nodes/3/camera", json!(3), Picture(&[])),
        with("no-material", "/meshes/0/primitives/0/material", json!(3), Error(&["primitive 0", "material 3"])),
        with("no-accessor", &format!("{attribute}/POSITION"), json!(99), Error(&["POSITION, accessor 99"])),
        with("no-indices", "/meshes/0/primitives/0/indices", json!(99), Error(&["indices, accessor 99"])),
        with("no-view", "/accessors/0/bufferView", json!(99), Error(&["accessor 0, buffer view 99"])),
        with("no-buffer", "/bufferViews/0/buffer", json!(99), Error(&["buffer 99", "does not exist"])),
        with(
            "no-texture",
            "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
            json!(9),
            Picture(&["texture 9"]),
        ),
        with("no-image", "/textures/0/source", json!(9), Picture(&["texture 0 has no image"])),
        with("no-sampler", "/textures/0/sampler", json!(9), Picture(&[])),
        with("no-image-view", "/images/0/bufferView", json!(99), Picture(&["buffer view 99"])),
        with("no-primitives", "/meshes/0/primitives", json!([]), Error(&["nothing to draw"])),
        with(
            "no-positions",
            attribute,
            json!({"NORMAL": 2}),
            Error(&["nothing to draw", "1 primitive without positions"]),
        ),
        with("mode-unknown", "/meshes/0/primitives/0/mode", json!(7), Error(&["primitive 0", "mode 7"])),
        with(
            "texture-set-huge",
            "/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord",
            json!(1e18),
            Picture(&[]),
        ),
        case(
            "index-too-large",
            "a.glb",
            Gltf::good().number(INDICES, 0, f32::from_bits(0x0009_0000)).glb(),
            Error(&["accessor 1", "index 9", "only 4 vertices"]),
        ),
        case(
            "positions-are-the-image",
            "a.glb",
            Gltf::good().set(&format!("/accessors/{POSITION}/bufferView"), json!(12)).glb(),
            Blank(&[]),
        ),
    ]
}

fn trees() -> Vec<Case> {
    let nodes = |name, nodes: Value, wanted| case(name, "a.glb", Gltf::plain().set("/nodes", nodes).glb(), wanted);
    let chain = |length: usize| {
        let links = (1..length).map(|child| json!({"children": [child]}));
        Value::Array(links.chain([json!({"mesh": 0})]).collect())
    };
    let wide = vec![json!({"mesh": 0}); 1 << 16];
    let many: Vec<usize> = (0..1 << 16).collect();
    let primitive = json!({"attributes": {"POSITION": 0}, "mode": 0});
    vec![
        nodes("node-is-its-own-child", json!([{"children": [0], "mesh": 0}]), Error(&["node 0", "its own ancestor"])),
        nodes(
            "node-cycle",
            json!([{"children": [1]}, {"children": [2]}, {"children": [0], "mesh": 0}]),
            Error(&["node 0", "ancestor"]),
        ),
        nodes(
            "node-with-two-parents",
            json!([{"children": [1, 2]}, {"children": [3]}, {"children": [3]}, {"mesh": 0}]),
            Error(&["node 3", "twice"]),
        ),
        nodes("nodes-deep", chain(5000), Error(&["1025 nodes above a node", "Limits::nesting"])),
        nodes("nodes-as-deep-as-may-be", chain(1025), Picture(&[])),
        case(
            "nodes-many-with-one-mesh",
            "a.glb",
            Gltf::plain()
                .set("/nodes", Value::Array(wide))
                .set("/scenes/0/nodes", json!(many))
                .set("/meshes/0/primitives", json!(vec![primitive; 9]))
                .glb(),
            Error(&["objects", "524288 are allowed"]),
        ),
        case(
            "joint-cycle",
            "a.glb",
            Gltf::good()
                .set("/nodes/1", json!({"children": [2]}))
                .set("/nodes/2", json!({"children": [1]}))
                .set("/scenes/0/nodes", json!([0]))
                .glb(),
            Error(&["nodes above a node", "Limits::nesting"]),
        ),
        nodes(
            "matrix-of-15",
            json!([{"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0]}]),
            Error(&["JSON", "16"]),
        ),
        nodes(
            "matrix-huge",
            json!([{"mesh": 0, "matrix": [1e300,0,0,0, 0,1e300,0,0, 0,0,1e300,0, 0,0,0,1]}]),
            Error(&["nothing to draw", "2 triangles dropped"]),
        ),
        nodes("matrix-zero", json!([{"mesh": 0, "matrix": vec![0; 16]}]), Blank(&["4 normals without a direction"])),
        nodes("rotation-zero", json!([{"mesh": 0, "rotation": [0, 0, 0, 0]}]), Picture(&[])),
        nodes("rotation-huge", json!([{"mesh": 0, "rotation": [0, 0, 1e300, 1e300]}]), Picture(&[])),
        nodes("scale-tiny", json!([{"mesh": 0, "scale": [1e-30, 1e-30, 1e-30]}]), Picture(&[])),
        nodes("scale-huge", json!([{"mesh": 0, "scale": [3e38, 3e38, 3e38]}]), Picture(&[])),
        nodes("translation-far", json!([{"mesh": 0, "translation": [1e30, 0, 0]}]), Blank(&[])),
    ]
}

/// Three bytes in the file that are hundreds in memory.
fn lists() -> Vec<Case> {
    let many = |name, list: &str, element: &str, count: usize, wanted| {
        let elements = vec![element; count].join(",");
        let text = Gltf::plain().text();
        let text = text.replacen('{', &format!("{{\"{list}\": [{elements}],"), 1);
        case(name, "a.gltf", text, wanted)
    };
    let most = 1 << 20;
    vec![
        many("list-too-long", "extensionsUsed", "\"\"", most + 1, Error(&["Limits::JSON_LIST"])),
        many("list-of-materials", "materials", "{}", most, Error(&["lists", "Limits::JSON_BYTES"])),
        many("list-of-images", "images", "{}", most, Picture(&[])),
        many("list-of-textures", "textures", "{}", most, Picture(&[])),
        many("list-of-skins", "skins", "{\"joints\":[]}", most, Picture(&[])),
        many(
            "list-of-channels",
            "animations",
            "{\"channels\":[{\"sampler\":0,\"target\":{\"path\":\"\"}}],\"samplers\":[]}",
            most / 4,
            Picture(&[]),
        ),
        many("list-of-animations", "animations", "{\"channels\":[],\"samplers\":[]}", most / 4, Picture(&[])),
    ]
}
