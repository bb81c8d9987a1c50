//! Inputs that are damaged on purpose: cut short, bytes changed, pieces moved. A reader may refuse them or read what is
//! left, but never panic, and what it returns can be drawn.

use std::path::Path;

use pineda_scene::{
    Bounds, Folder, Format, Framing, Limits, Model, NoFiles, Pose, Resolver, Scene, Texels, View, load_bytes,
};

use crate::gltf_file::{File, push};
use crate::images::{data_uri, pixel, textured};
use crate::models;
use crate::threemf::{file, model};

/// Small, so that a damaged file cannot make the test slow.
const LIMITS: Limits = Limits {
    file_bytes: 1 << 25,
    vertices: 1 << 22,
    triangles: 1 << 22,
    expanded: 1 << 21,
    objects: 1 << 12,
    nesting: 64,
    inflated: 1 << 20,
    image_pixels: 1 << 20,
    pixels: 1 << 21,
    expanded_pixels: 1 << 20,
};

fn try_to_read(bytes: &[u8], format: Format, files: &dyn Resolver) {
    let Ok(model) = Model::from_bytes(bytes, format, files, &LIMITS) else { return };
    // In the middle of an animation, if there is one.
    let animation = model.contents().animations.first().map(|_| 0.into());
    let time = model.contents().animations.first().map_or(0.0, |animation| animation.duration / 2.0);
    if animation.is_some()
        && let Ok(loaded) = model.scene(&Pose { animation, time, ..Pose::default() })
    {
        check(&loaded.scene);
    }
    if let Ok(loaded) = model.into_scene(&Pose::default()) {
        check(&loaded.scene);
    }
}

/// What a renderer relies on.
fn check(scene: &Scene) {
    for object in &scene.objects {
        assert!(!object.is_empty() && object.material < scene.materials.len());
        for v in object.indices() {
            assert!(object.vertices[v as usize].position.iter().all(|c| c.is_finite()));
        }
    }
    Framing::new(&Bounds::of(scene).unwrap(), &View::default()).unwrap();
    for object in &scene.objects {
        let count = object.vertices.len();
        assert!(object.uvs.iter().all(|uvs| uvs.len() == count));
        assert!(object.tangents.is_empty() || object.tangents.len() == count);
    }
    for reference in scene.materials.iter().flat_map(|material| material.textures()) {
        assert!(reference.texture < scene.textures.len());
    }
    for texture in &scene.textures {
        assert!(texture.image < scene.images.len());
    }
    for image in &scene.images {
        let pixels = match &image.texels {
            Texels::Rgba8(texels) => texels.len(),
            Texels::Rgba16(texels) => texels.len(),
        };
        assert!(pixels > 0 && pixels as u64 == u64::from(image.width) * u64::from(image.height));
    }
}

/// The same numbers in every run: a linear congruential generator (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound
    }
}

/// Numbers where mistakes are likely.
const SUSPICIOUS: [&[u8]; 14] = [
    b"\xff\xff\xff\xff",
    b"\0\0\0\0",
    b"\0\0\0\x80",
    b"\xff\xff\xff\x7f",
    b"\0\0\xc0\x7f",
    b"-1",
    b"0",
    b"1e999",
    b"nan",
    b"4294967296",
    b"18446744073709551615",
    b"99999999999999999999",
    b"\n",
    b"/",
];

fn damage(bytes: &mut Vec<u8>, random: &mut Random) {
    for _ in 0..1 + random.below(4) {
        if bytes.is_empty() {
            return;
        }
        let at = random.below(bytes.len());
        match random.below(6) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.below(256) as u8,
            2 => {
                let number = SUSPICIOUS[random.below(SUSPICIOUS.len())];
                let end = (at + number.len()).min(bytes.len());
                bytes.splice(at..end, number.iter().copied());
            }
            3 => {
                let end = at + random.below(bytes.len() - at);
                bytes.drain(at..end.min(at + 64));
            }
            4 => {
                let piece = bytes[at..bytes.len().min(at + 40)].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, piece);
            }
            _ => bytes[at] = b"0123456789-+.e{}[],\"/ \n"[random.below(23)],
        }
    }
}

fn every_cut(bytes: &[u8], format: Format, files: &dyn Resolver, cuts: usize) {
    let step = bytes.len().div_ceil(cuts).max(1);
    for length in (0..bytes.len()).step_by(step) {
        try_to_read(&bytes[..length], format, files);
    }
}

fn random_damage(bytes: &[u8], format: Format, files: &dyn Resolver, seed: u64, times: usize) {
    let mut random = Random(seed);
    for _ in 0..times {
        let mut copy = bytes.to_vec();
        damage(&mut copy, &mut random);
        try_to_read(&copy, format, files);
    }
}

/// A file of each kind, with everything in it that the reader knows.
fn seeds() -> Vec<(Format, Vec<u8>)> {
    let obj = "mtllib a.mtl\no a\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv .2 .3 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nusemtl m\nf 1 2 3 4 5\ng b\nf -5/1/-1 -4//1 -3 \\\n 1/1\nl 1 2\n";
    let ascii_stl = "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 .5\nvertex 0 .5 0\nendloop\nendfacet\nendsolid a\nsolid b\nendsolid b\n";
    let mut binary_stl = vec![b' '; 80];
    binary_stl[10..20].copy_from_slice(b"COLOR=\x01\x02\x03\x04");
    binary_stl.extend(2u32.to_le_bytes());
    binary_stl.extend((0..100).map(|i| (i * 7) as u8));
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment a\nelement vertex 4\nproperty float x\nproperty double y\nproperty short z\nproperty uchar red\nproperty uchar green\nproperty float blue\nproperty list uchar uchar more\nelement face 2\nproperty list uchar int vertex_indices\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        )
    };
    let ascii_ply = header("ascii")
        + "0 0 0 1 2 3 0\n1 0 0 1 2 3 1 7\n1 1 0 1 2 3 0\n0 1 0 255 0 1 0\n4 0 1 2 3\n3 0 1 2\n6 0 1 2 -1 2 3\n";
    let binary_ply = |format: &str, big: bool| {
        let mut bytes = header(format).into_bytes();
        let mut push = |number: &[u8]| if big { bytes.extend(number.iter().rev()) } else { bytes.extend(number) };
        for i in 0..4i16 {
            push(&f32::from(i).to_le_bytes());
            push(&f64::from(i * i).to_le_bytes());
            push(&i.to_le_bytes());
            push(&[1]);
            push(&[2]);
            push(&0.5f32.to_le_bytes());
            push(&[1]);
            push(&[9]);
        }
        for face in [&[0, 1, 2, 3][..], &[0, 1, 2]] {
            push(&[face.len() as u8]);
            face.iter().for_each(|i: &i32| push(&i.to_le_bytes()));
        }
        [6, 0, 1, 2, -1, 2, 3].iter().for_each(|i: &i32| push(&i.to_le_bytes()));
        bytes
    };
    let gltf = everything_gltf();
    vec![
        (Format::Obj, obj.into()),
        (Format::Stl, ascii_stl.into()),
        (Format::Stl, binary_stl),
        (Format::Ply, ascii_ply.into_bytes()),
        (Format::Ply, binary_ply("binary_little_endian", false)),
        (Format::Ply, binary_ply("binary_big_endian", true)),
        (Format::ThreeMf, threemf()),
        (Format::Gltf, gltf.text().into_bytes()),
        (Format::Gltf, gltf.glb()),
        (Format::Gltf, moving_gltf().text().into_bytes()),
        (Format::Gltf, moving_gltf().glb()),
    ]
}

/// All that the reader knows. What is damaged is found by the sums, mostly: the fuzzer has a target without these.
fn threemf() -> Vec<u8> {
    let resources = r##"<basematerials id="2"><base displaycolor="#ff0000"/></basematerials><object id="1" pid="2"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="2" v3="1" p1="0"/></triangles></mesh></object><object id="3"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 2 3 4"/></components></object>"##;
    file(&model("", resources, r#"<item objectid="3"/><item objectid="1"/>"#))
}

fn everything_gltf() -> File {
    use serde_json::json;
    let mut file = File::square();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(4));
    file.attribute("NORMAL", normals);
    let colors = file.accessor(&[200; 16], 5121, "VEC4", 4);
    file.attribute("COLOR_0", colors);
    let indices = file.view(&[1, 3]);
    let values = file.view(&[0x40; 24]);
    file.json["accessors"][0]["sparse"] = json!({"count": 2, "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values}});
    file.json["nodes"] = json!([{"children": [1, 2], "scale": [-1, 2, 1]}, {"mesh": 0, "rotation": [0, 0, 0.6, 0.8]}, {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 3,2,1,1]}]);
    file.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}, "alphaMode": "MASK"}]);
    file.primitive()["material"] = json!(0);
    file.primitive()["mode"] = json!(5);
    file
}

/// A skin, a morph target, an animation of both, an image, instances and a compressed buffer view.
fn moving_gltf() -> File {
    use serde_json::json;
    let image = data_uri(&pixel());
    let mut file = textured(json!({"uri": image}));
    let joints = file.accessor(&[0, 1, 0, 0].repeat(4), 5121, "VEC4", 4);
    let weights = file.accessor(&[200, 55, 0, 0].repeat(4), 5121, "VEC4", 4);
    let target = file.floats("VEC3", &[0.1; 12]);
    let matrix = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 2.0, 3.0, 1.0];
    let matrices = file.floats("MAT4", &[matrix, matrix].concat());
    let times = file.floats("SCALAR", &[0.0, 1.0]);
    let turns = file.floats("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.6, 0.0, 0.8]);
    let amounts = file.floats("SCALAR", &[0.0, 0.5, 1.0, 1.0, 0.5, 0.0]);
    let places = file.floats("VEC3", &[1.0; 6]);
    let compressed = file.view(&[0xd1, 8, 2, 2, 0, 0, 0, 0]);
    file.json["bufferViews"][compressed]["extensions"] = json!({"EXT_meshopt_compression": {
        "buffer": 0, "byteOffset": file.json["bufferViews"][compressed]["byteOffset"], "byteLength": 8, "byteStride": 2, "count": 3, "mode": "INDICES"}});
    let indices = json!({"bufferView": compressed, "componentType": 5123, "type": "SCALAR", "count": 3});
    let indices = push(&mut file.json["accessors"], indices);
    file.attribute("JOINTS_0", joints);
    file.attribute("WEIGHTS_0", weights);
    file.primitive()["targets"] = json!([{"POSITION": target}]);
    file.primitive()["indices"] = json!(indices);
    file.json["meshes"][0]["weights"] = json!([0.5]);
    file.json["skins"] = json!([{"joints": [1, 2], "inverseBindMatrices": matrices}]);
    let instances = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}});
    file.json["nodes"] =
        json!([{"mesh": 0, "skin": 0}, {"children": [2]}, {"scale": [1, 2, 3]}, {"mesh": 0, "extensions": instances}]);
    file.json["scenes"][0]["nodes"] = json!([0, 1, 3]);
    file.json["animations"] = json!([{
        "samplers": [{"input": times, "output": turns}, {"input": times, "output": amounts, "interpolation": "CUBICSPLINE"}],
        "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}, {"sampler": 1, "target": {"node": 0, "path": "weights"}}],
    }]);
    file
}

#[test]
fn damaged_files_of_every_length() {
    for (format, bytes) in seeds() {
        assert!(load_bytes(&bytes, format, &NoFiles, &LIMITS).is_ok(), "{format}");
        every_cut(&bytes, format, &NoFiles, usize::MAX);
    }
}

#[test]
fn damaged_files_at_random() {
    for (number, (format, bytes)) in seeds().into_iter().enumerate() {
        random_damage(&bytes, format, &NoFiles, number as u64, 4000);
    }
}

/// Any reader must be safe from any bytes, also those of other formats.
#[test]
fn damaged_files_in_the_wrong_reader() {
    for (_, bytes) in seeds() {
        for format in [Format::Obj, Format::Stl, Format::Ply, Format::ThreeMf, Format::Gltf] {
            try_to_read(&bytes, format, &NoFiles);
        }
    }
}

#[test]
fn damaged_models() {
    let Some(folder) = models::folder() else { return };
    for (number, path) in models::files(&folder).iter().enumerate() {
        let bytes = std::fs::read(path).unwrap();
        let format = Format::from_extension(path).unwrap();
        let files = Folder(path.parent().unwrap_or(Path::new("")).to_owned());
        // About as long for each.
        let is_slow = bytes.len() > 2 << 20 || path.ends_with("MetalRoughSpheresNoTextures.glb");
        let times = if is_slow { 3 } else { (4 << 20) / (bytes.len() + (40 << 10)) };
        every_cut(&bytes, format, &files, times);
        random_damage(&bytes, format, &files, number as u64, times);
    }
}
