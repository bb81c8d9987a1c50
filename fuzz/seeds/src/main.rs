//! Writes what fuzzing begins with: a small good file of each kind, in `../corpus/TARGET`.

use base64::Engine;
use exr::prelude::{Image, WritableImage};
use std::fs;
use std::path::Path;

fn main() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../crates/pineda-scene");
    let read = |name: &str| fs::read(tests.join(name)).expect("the repository's file");
    for level in 0..=10 {
        write("draco", &level.to_string(), &draco(level));
    }
    meshopt(&String::from_utf8(read("src/gltf/meshopt/vectors.txt")).expect("text"));
    for name in ["baseline.jpg", "progressive.jpg", "grey.jpg", "cmyk.jpg", "lossy.webp"] {
        write("image", name, &read(&format!("tests/it/images/{name}")));
    }
    images();
    panoramas();
    write("threemf_model", "all", MODEL.as_bytes());
    let mtl = "newmtl a\nKd 1 0 .5\nKe 1 1 1\nd 0.5\nNs 100\nPr 0.5\nPm 1\nillum 2\nmap_Kd -s 1 2 3 -o 0 1 -clamp on a.png\nnorm a.png\nnewmtl b\nTr 0.5\nKs 1 1 1\nNi 1.4\nmap_d a.png\nmap_Bump -bm 2 a.png\nPc 1\nPs 1 1 1\naniso 1\n";
    write("mtl", "all", mtl.as_bytes());
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../apps/cli/examples");
    for entry in fs::read_dir(examples).expect("the repository's folder") {
        let path = entry.expect("a file").path();
        let text = fs::read_to_string(&path).expect("text");
        // As small as is drawn.
        write("raster", &path.file_name().unwrap_or_default().to_string_lossy(), text.replace("512", "60").as_bytes());
    }
    write("raster", "clip", br#"{"size": [16, 9], "space": "clip", "vertices": [{"position": [1, -2, 0.5, 1e3], "colour": [1, 0, 0, 0.5]}, {"position": [0, 1e30], "depth": 1, "w": -1}, {"position": [-1, -1, 0, 0]}], "triangles": [[0, 1, 2], [2, 1, 0]], "cull": "back", "front_face": "clockwise", "depth_test": true, "background": [0, 1, 0]}"#);
    write("raster", "ndc", br#"{"size": [8, 8], "space": "ndc", "vertices": [{"position": [-1, -1]}, {"position": [1, -1, 0.5]}, {"position": [0, 1], "w": 2}]}"#);
}

const MODEL: &str = r##"<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" requiredextensions="m p" xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02" xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06">
<metadata name="Title">a &amp; b</metadata>
<resources><basematerials id="1"><base name="red" displaycolor="#FF000080"/></basematerials><m:colorgroup id="2"><m:color color="#00FF00"/><m:color color="#0000FFFF"/></m:colorgroup>
<object id="3" name="t" type="model" pid="1" pindex="0"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1e0" z="-.5"/></vertices>
<triangles><triangle v1="0" v2="1" v3="2" pid="2" p1="0" p2="1" p3="0"/><triangle v1="2" v2="1" v3="0"/></triangles></mesh></object>
<object id="4"><components><component objectid="3" transform="1 0 0 0 1 0 0 0 1 5 6 7"/><component objectid="3" p:path="/a.model"/></components></object></resources>
<build><item objectid="4" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/><item objectid="3"/></build></model>"##;

fn write(target: &str, name: &str, bytes: &[u8]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus").join(target);
    fs::create_dir_all(&folder).expect("a folder that can be made");
    fs::write(folder.join(format!("seed-{name}")), bytes).expect("a file that can be written");
}

/// A grid of 5 x 5 points with positions and colours.
fn draco(level: i32) -> Vec<u8> {
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
    let position = |x: u32, y: u32| [x as f32, y as f32, 0.0].iter().flat_map(|c| c.to_le_bytes()).collect();
    attribute(GeometryAttributeType::Position, 3, DataType::Float32, false, &position);
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
    encoder.encode(&options, &mut buffer).expect("a good mesh");
    buffer.data().to_vec()
}

/// The reader's own test vectors, after the three bytes that the target wants.
fn meshopt(vectors: &str) {
    for (number, line) in vectors.lines().filter(|line| !line.starts_with('#')).enumerate() {
        let words: Vec<&str> = line.split(' ').collect();
        let place = |names: &[&str], name: &str| names.iter().position(|n| *n == name).unwrap_or(0) as u8;
        let mode = place(&["ATTRIBUTES", "TRIANGLES", "INDICES"], words[0]);
        let filter = place(&["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"], words[1]);
        let mut bytes = vec![mode + 3 * filter, words[2].parse().unwrap_or(255), words[3].parse().unwrap_or(4)];
        bytes.extend(base64::engine::general_purpose::STANDARD.decode(words[4]).expect("base64"));
        write("meshopt", &number.to_string(), &bytes);
    }
}

fn images() {
    use png::{BitDepth, ColorType};
    for (color, depth) in [
        (ColorType::Rgba, BitDepth::Eight),
        (ColorType::Rgb, BitDepth::Sixteen),
        (ColorType::Grayscale, BitDepth::One),
        (ColorType::GrayscaleAlpha, BitDepth::Sixteen),
        (ColorType::Indexed, BitDepth::Two),
    ] {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 5, 3);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if color == ColorType::Indexed {
            encoder.set_palette(vec![1, 2, 3, 40, 50, 60, 7, 8, 9, 0, 0, 0]);
            encoder.set_trns(vec![255, 7]);
        }
        let row = (5 * color.samples() * depth as usize).div_ceil(8);
        let mut writer = encoder.write_header().expect("a good header");
        writer.write_image_data(&(0..3 * row as u8).collect::<Vec<u8>>()).expect("good data");
        writer.finish().expect("a good end");
        write("image", &format!("{color:?}-{depth:?}.png"), &bytes);
    }
    let pixels: Vec<u8> = (0..16 * 8 * 4).map(|i| (i * 7 % 251) as u8).collect();
    let mut webp = Vec::new();
    image_webp::WebPEncoder::new(&mut webp).encode(&pixels, 16, 8, image_webp::ColorType::Rgba8).expect("good pixels");
    write("image", "lossless.webp", &webp);
    let mut jpeg = Vec::new();
    let mut encoder = jpeg_encoder::Encoder::new(&mut jpeg, 80);
    encoder.set_progressive(true);
    encoder.set_restart_interval(1);
    encoder.encode(&pixels, 16, 8, jpeg_encoder::ColorType::Rgba).expect("good pixels");
    write("image", "restarts.jpg", &jpeg);
}

fn panoramas() {
    let mut flat = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 4 +X 8\n".to_vec();
    flat.extend((0..4 * 8 * 4).map(|i| 100 + i as u8));
    write("panorama", "flat.hdr", &flat);
    let mut runs = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 16\n".to_vec();
    for _ in 0..2 {
        runs.extend([2, 2, 0, 16]);
        for _ in 0..4 {
            // A run of twelve, then four of their own.
            runs.extend([128 + 12, 130, 4, 1, 2, 3, 4]);
        }
    }
    write("panorama", "runs.hdr", &runs);
    use exr::prelude::{Encoding, Layer, LayerAttributes, SpecificChannels};
    for (name, encoding) in [
        ("plain", Encoding::UNCOMPRESSED),
        ("runs", Encoding::FAST_LOSSLESS),
        ("zip", Encoding::SMALL_LOSSLESS),
        ("piz", Encoding { compression: exr::compression::Compression::PIZ, ..Encoding::SMALL_LOSSLESS }),
        ("pxr24", Encoding { compression: exr::compression::Compression::PXR24, ..Encoding::SMALL_LOSSLESS }),
        ("b44", Encoding { compression: exr::compression::Compression::B44, ..Encoding::SMALL_LOSSLESS }),
    ] {
        let pixels = |at: exr::prelude::Vec2<usize>| (at.0 as f32, at.1 as f32 * 0.5, 1.5f32, 1.0f32);
        let layer = Layer::new((8, 4), LayerAttributes::named("a"), encoding, SpecificChannels::rgba(pixels));
        let mut bytes = std::io::Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut bytes).expect("a good image");
        write("panorama", &format!("{name}.exr"), &bytes.into_inner());
    }
}
