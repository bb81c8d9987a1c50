//! Makes glTF files for tests: a buffer with accessors, and the JSON around it.

use base64::Engine;
use pineda_scene::{Error, Format, Loaded};
use serde_json::{Value, json};

/// A file with one buffer. `json` is open to any change before the file is written.
pub(crate) struct File {
    pub(crate) json: Value,
    pub(crate) buffer: Vec<u8>,
}

pub(crate) const F32: u32 = 5126;

impl File {
    /// A scene of one node with one mesh with one primitive, whose attributes and indices are to be added.
    pub(crate) fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}}]}],
            "accessors": [],
            "bufferViews": [],
            "buffers": [{}],
        });
        Self { json, buffer: Vec::new() }
    }

    /// One triangle without indices, in the plane z = 0, seen from +z.
    pub(crate) fn triangle() -> Self {
        let mut file = Self::new();
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        file.attribute("POSITION", positions);
        file
    }

    /// Four corners of the unit square, and two triangles.
    pub(crate) fn square() -> Self {
        let mut file = Self::new();
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
        file.attribute("POSITION", positions);
        let indices = file.accessor(&[0, 1, 2, 0, 2, 3], 5121, "SCALAR", 6);
        file.primitive()["indices"] = json!(indices);
        file
    }

    /// The number of a new buffer view of these bytes.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        while !self.buffer.len().is_multiple_of(4) {
            self.buffer.push(0);
        }
        let view = json!({"buffer": 0, "byteOffset": self.buffer.len(), "byteLength": bytes.len()});
        self.buffer.extend(bytes);
        push(&mut self.json["bufferViews"], view)
    }

    /// The number of a new accessor with a buffer view of its own.
    pub(crate) fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        push(
            &mut self.json["accessors"],
            json!({"bufferView": view, "componentType": component, "type": kind, "count": count}),
        )
    }

    pub(crate) fn floats(&mut self, kind: &str, numbers: &[f32]) -> usize {
        let channels = match kind {
            "SCALAR" => 1,
            "MAT4" => 16,
            _ => kind[3..].parse().unwrap(),
        };
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        self.accessor(&bytes, F32, kind, numbers.len() / channels)
    }

    pub(crate) fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    pub(crate) fn attribute(&mut self, name: &str, accessor: usize) {
        self.primitive()["attributes"][name] = json!(accessor);
    }

    pub(crate) fn node(&mut self) -> &mut Value {
        &mut self.json["nodes"][0]
    }

    /// With the buffer as a data URI.
    pub(crate) fn text(&self) -> String {
        let mut json = self.json.clone();
        if json["buffers"][0] == json!({}) {
            let data = base64::engine::general_purpose::STANDARD.encode(&self.buffer);
            json["buffers"][0] =
                json!({"byteLength": self.buffer.len(), "uri": format!("data:application/octet-stream;base64,{data}")});
        }
        json.to_string()
    }

    /// With the buffer as GLB's binary chunk.
    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"][0] = json!({"byteLength": self.buffer.len()});
        let mut json = json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut binary = self.buffer.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut bytes = b"glTF".to_vec();
        let word = |number: usize| (number as u32).to_le_bytes();
        bytes.extend(word(2));
        bytes.extend(word(12 + 8 + json.len() + 8 + binary.len()));
        bytes.extend(word(json.len()));
        bytes.extend(b"JSON");
        bytes.extend(json);
        bytes.extend(word(binary.len()));
        bytes.extend(b"BIN\0");
        bytes.extend(binary);
        bytes
    }

    pub(crate) fn read(&self) -> Result<Loaded, Error> {
        crate::read(Format::Gltf, self.text())
    }

    pub(crate) fn loaded(&self) -> Loaded {
        self.read().unwrap()
    }

    #[track_caller]
    pub(crate) fn fails(&self, says: &[&str]) {
        crate::fails(Format::Gltf, self.text(), says);
    }
}

/// Adds to a JSON list; the number of what was added.
pub(crate) fn push(list: &mut Value, value: Value) -> usize {
    let list = list.as_array_mut().unwrap();
    list.push(value);
    list.len() - 1
}
