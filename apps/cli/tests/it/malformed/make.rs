//! Good files, to be made worse.

use serde_json::{Value, json};

/// A glTF file with one of everything: a square with normals, texture coordinates, a skin of two joints, a morph target, an animation and a texture.
#[derive(Clone)]
pub(super) struct Gltf {
    pub(super) json: Value,
    /// The buffer, which becomes GLB's binary chunk.
    pub(super) binary: Vec<u8>,
}

// Accessors, each of which has the buffer view of the same number.
pub(super) const POSITION: usize = 0;
pub(super) const INDICES: usize = 1;
pub(super) const NORMAL: usize = 2;
pub(super) const TEXCOORD: usize = 3;
pub(super) const WEIGHTS: usize = 5;
pub(super) const BIND: usize = 6;
pub(super) const TIMES: usize = 7;
pub(super) const TURNS: usize = 8;
pub(super) const AMOUNTS: usize = 10;
pub(super) const COLOR: usize = 11;
/// The buffer view of the image.
pub(super) const IMAGE: usize = 12;

const F32: u32 = 5126;

impl Gltf {
    pub(super) fn good() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0,
            "scenes": [{"nodes": [0, 1, 3]}],
            "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"translation": [0, 0, 0]}, {"camera": 0, "translation": [0.5, 0.5, 4]}],
            "meshes": [{"weights": [0.5], "primitives": [{
                "attributes": {"POSITION": 0, "NORMAL": 2, "TEXCOORD_0": 3, "JOINTS_0": 4, "WEIGHTS_0": 5, "COLOR_0": 11},
                "indices": 1, "material": 0, "targets": [{"POSITION": 9}]}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0, "sampler": 0}], "samplers": [{}], "images": [{"bufferView": 12}],
            "skins": [{"joints": [1, 2], "inverseBindMatrices": 6}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
            "animations": [{
                "samplers": [{"input": 7, "output": 8}, {"input": 7, "output": 10}],
                "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}, {"sampler": 1, "target": {"node": 0, "path": "weights"}}]}],
            "accessors": [], "bufferViews": [], "buffers": [{}],
        });
        let mut this = Self { json, binary: Vec::new() };
        this.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
        this.accessor(&[0, 0, 1, 0, 2, 0, 0, 0, 2, 0, 3, 0], 5123, "SCALAR", 6);
        this.floats("VEC3", &[0.0, 0.0, 1.0].repeat(4));
        this.floats("VEC2", &[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
        this.accessor(&[0, 1, 0, 0].repeat(4), 5121, "VEC4", 4);
        this.floats("VEC4", &[0.5, 0.5, 0.0, 0.0].repeat(4));
        let identity: [f32; 16] = std::array::from_fn(|i| if i % 5 == 0 { 1.0 } else { 0.0 });
        this.floats("MAT4", &[identity, identity].concat());
        this.floats("SCALAR", &[0.0, 2.0]);
        this.floats("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.6, 0.8]);
        this.floats("VEC3", &[0.125; 12]);
        this.floats("SCALAR", &[0.0, 1.0]);
        this.floats("VEC4", &[1.0; 16]);
        this.view(&png(2, 2, &[255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255]));
        this
    }

    /// Without skin, morph target, texture and animation.
    pub(super) fn plain() -> Self {
        let mut this = Self::good();
        for key in ["skins", "animations", "materials", "textures", "images", "samplers"] {
            this.json.as_object_mut().unwrap().remove(key);
        }
        this.set("/scenes/0/nodes", json!([0]))
            .set("/nodes", json!([{"mesh": 0}]))
            .set("/meshes", json!([{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 2}, "indices": 1}]}]))
    }

    /// The number of a new buffer view of these bytes.
    pub(super) fn view(&mut self, bytes: &[u8]) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let view = json!({"buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len()});
        self.binary.extend(bytes);
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(view);
        views.len() - 1
    }

    /// The number of a new accessor.
    pub(super) fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(json!({"bufferView": view, "componentType": component, "type": kind, "count": count}));
        accessors.len() - 1
    }

    pub(super) fn floats(&mut self, kind: &str, numbers: &[f32]) -> usize {
        let channels = match kind {
            "SCALAR" => 1,
            "MAT4" => 16,
            _ => kind[3..].parse().unwrap(),
        };
        self.accessor(&floats(numbers), F32, kind, numbers.len() / channels)
    }

    /// Changes one place in the JSON, or adds it.
    pub(super) fn set(mut self, place: &str, value: Value) -> Self {
        let (parent, key) = place.rsplit_once('/').unwrap();
        let parent = self.json.pointer_mut(parent).unwrap();
        match key.parse::<usize>() {
            Ok(index) => parent[index] = value,
            Err(_) => parent[key] = value,
        }
        self
    }

    /// Writes over a number of one of the accessors.
    pub(super) fn number(mut self, accessor: usize, at: usize, number: f32) -> Self {
        let offset = self.json["bufferViews"][accessor]["byteOffset"].as_u64().unwrap() as usize + 4 * at;
        self.binary[offset..offset + 4].copy_from_slice(&number.to_le_bytes());
        self
    }

    /// As JSON, with the buffer in a data URI.
    pub(super) fn text(&self) -> String {
        let data: String = self.binary.iter().map(|byte| format!("%{byte:02x}")).collect();
        let buffer = json!({"byteLength": self.binary.len(), "uri": format!("data:application/octet-stream,{data}")});
        self.clone().set("/buffers/0", buffer).json.to_string()
    }

    /// As JSON, with the buffer in a file of its own.
    pub(super) fn text_with(&self, uri: &str) -> String {
        self.clone().set("/buffers/0", json!({"byteLength": self.binary.len(), "uri": uri})).json.to_string()
    }

    pub(super) fn glb(&self) -> Vec<u8> {
        let json = self.clone().set("/buffers/0", json!({"byteLength": self.binary.len()})).json.to_string();
        glb(json.into_bytes(), self.binary.clone())
    }
}

pub(super) fn glb(mut json: Vec<u8>, mut binary: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let word = |number: usize| (number as u32).to_le_bytes();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend(word(12 + 8 + json.len() + 8 + binary.len()));
    bytes.extend(word(json.len()));
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend(word(binary.len()));
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes
}

pub(super) fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// Of RGBA pixels.
pub(super) fn png(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_compression(png::Compression::High);
    encoder.write_header().unwrap().write_image_data(pixels).unwrap();
    bytes
}

/// With some bytes written over.
pub(super) fn patched(mut bytes: Vec<u8>, at: usize, with: &[u8]) -> Vec<u8> {
    bytes[at..at + with.len()].copy_from_slice(with);
    bytes
}

/// What is left when the end is missing.
pub(super) fn cut(mut bytes: Vec<u8>, length: usize) -> Vec<u8> {
    bytes.truncate(length);
    bytes
}

/// In UTF-16 with its mark, as some editors save text.
pub(super) fn utf16(text: &str) -> Vec<u8> {
    "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
}
