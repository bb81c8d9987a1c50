//! Small glTF models, written by the tests.

use crate::workspace::Workspace;

/// Two squares in planes of constant z, 2 x 2 around the origin, each with a material of its own; one below the other in the file.
pub(crate) struct Squares {
    /// z of each, in the file's order.
    pub(crate) z: [f32; 2],
    /// Each as glTF's JSON.
    pub(crate) materials: [&'static str; 2],
    /// 0 for points, 1 for lines, 4 for triangles.
    pub(crate) mode: u32,
    /// More of the file's top level, each with a comma at its end.
    pub(crate) more: &'static str,
    /// More of the node at (0, 0, 5), each with a comma before it.
    pub(crate) front: &'static str,
}

impl Default for Squares {
    fn default() -> Self {
        Self { z: [0.0, 0.5], materials: ["{}", "{}"], mode: 4, more: "", front: "" }
    }
}

impl Squares {
    /// Writes `NAME.gltf` and `NAME.bin`. Accessor 2 has the times 0 and 2, accessor 3 the places (0, 0, 0) and (4, 0, 0), for animations.
    pub(crate) fn write(&self, folder: &Workspace, name: &str) {
        let mut numbers = Vec::new();
        for z in self.z {
            for [x, y] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
                numbers.extend([x, y, z]);
            }
        }
        numbers.extend([0.0, 2.0]);
        numbers.extend([0.0, 0.0, 0.0, 4.0, 0.0, 0.0]);
        let bytes: Vec<u8> = numbers.iter().flat_map(|number: &f32| number.to_le_bytes()).collect();
        let length = bytes.len();
        folder.write(&format!("{name}.bin"), bytes);
        let Self { z: [a, b], materials: [first, second], mode, more, front } = self;
        let text = format!(
            r#"{{"asset": {{"version": "2.0"}}, {more}
            "scenes": [{{"name": "both", "nodes": [0, 1, 2]}}, {{"name": "second", "nodes": [1]}}], "scene": 0,
            "nodes": [{{"mesh": 0}}, {{"mesh": 1}}, {{"name": "front", "camera": 0, "translation": [0, 0, 5]{front}}}],
            "cameras": [{{"type": "orthographic", "orthographic": {{"xmag": 1, "ymag": 1, "znear": 1, "zfar": 9}}}}],
            "meshes": [
                {{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0, "mode": {mode}}}]}},
                {{"primitives": [{{"attributes": {{"POSITION": 1}}, "material": 1, "mode": {mode}}}]}}],
            "materials": [{first}, {second}],
            "accessors": [
                {{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [-1, -1, {a}], "max": [1, 1, {a}]}},
                {{"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC3", "min": [-1, -1, {b}], "max": [1, 1, {b}]}},
                {{"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2]}},
                {{"bufferView": 2, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"}}],
            "bufferViews": [
                {{"buffer": 0, "byteLength": 72}}, {{"buffer": 0, "byteOffset": 72, "byteLength": 72}},
                {{"buffer": 0, "byteOffset": 144, "byteLength": 32}}],
            "buffers": [{{"uri": "{name}.bin", "byteLength": {length}}}]}}"#
        );
        folder.write(&format!("{name}.gltf"), text);
    }
}
