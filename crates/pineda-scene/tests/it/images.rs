//! Images of all kinds, made here or by other programs, as textures of a glTF file.

use std::io;

use base64::Engine;
use pineda_scene::{Error, Format, Limits, Loaded, NoFiles, Texels, TextureRef, load_bytes};
use png::{BitDepth, ColorType};
use serde_json::json;

use crate::gltf_file::{File, push};
use crate::only;

pub(crate) fn png(color: ColorType, depth: BitDepth, width: u32, height: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == ColorType::Indexed {
        encoder.set_palette(vec![1, 2, 3, 40, 50, 60]);
        encoder.set_trns(vec![255, 7]);
    }
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    bytes
}

/// A white pixel.
pub(crate) fn pixel() -> Vec<u8> {
    png(ColorType::Rgba, BitDepth::Eight, 1, 1, &[255; 4])
}

fn webp(color: image_webp::ColorType, width: u32, height: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    image_webp::WebPEncoder::new(&mut bytes).encode(data, width, height, color).unwrap();
    bytes
}

/// A textured square; its material, texture and image are the file's first.
pub(crate) fn textured(image: serde_json::Value) -> File {
    let mut file = File::square();
    let uvs = file.floats("VEC2", &[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
    file.attribute("TEXCOORD_0", uvs);
    file.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    file.json["textures"] = json!([{"source": 0}]);
    file.json["images"] = json!([image]);
    file.primitive()["material"] = json!(0);
    file
}

pub(crate) fn data_uri(bytes: &[u8]) -> String {
    format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
}

fn of_image(bytes: &[u8]) -> Loaded {
    textured(json!({"uri": data_uri(bytes)})).loaded()
}

/// The only image of a file that has it as its texture.
fn decoded(bytes: &[u8]) -> (u32, u32, Texels) {
    let loaded = of_image(bytes);
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    let [image] = &loaded.scene.images[..] else { panic!("{:?}", loaded.scene.images) };
    (image.width, image.height, image.texels.clone())
}

#[test]
fn images_png_of_every_kind() {
    use BitDepth::{Eight, One, Sixteen};
    let rgba8 = |width, height, texels: &[[u8; 4]]| (width, height, Texels::Rgba8(texels.to_vec()));
    let rgba16 = |texels: &[[u16; 4]]| (texels.len() as u32, 1, Texels::Rgba16(texels.to_vec()));
    let of = |color, depth, width, height, data: &[u8]| decoded(&png(color, depth, width, height, data));
    assert_eq!(of(ColorType::Rgba, Eight, 1, 2, &[1, 2, 3, 4, 5, 6, 7, 8]), rgba8(1, 2, &[[1, 2, 3, 4], [5, 6, 7, 8]]));
    assert_eq!(of(ColorType::Rgb, Eight, 2, 1, &[1, 2, 3, 4, 5, 6]), rgba8(2, 1, &[[1, 2, 3, 255], [4, 5, 6, 255]]));
    assert_eq!(of(ColorType::Grayscale, Eight, 2, 1, &[9, 8]), rgba8(2, 1, &[[9, 9, 9, 255], [8, 8, 8, 255]]));
    assert_eq!(of(ColorType::GrayscaleAlpha, Eight, 2, 1, &[9, 8, 7, 6]), rgba8(2, 1, &[[9, 9, 9, 8], [7, 7, 7, 6]]));
    assert_eq!(of(ColorType::Grayscale, One, 2, 1, &[0x40]), rgba8(2, 1, &[[0, 0, 0, 255], [255; 4]]));
    assert_eq!(of(ColorType::Indexed, One, 2, 1, &[0x40]), rgba8(2, 1, &[[1, 2, 3, 255], [40, 50, 60, 7]]));
    let words = [0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0xff, 0xfe];
    assert_eq!(of(ColorType::Rgba, Sixteen, 1, 1, &words), rgba16(&[[0x0102, 0x0304, 0x0506, 0xfffe]]));
    assert_eq!(of(ColorType::Rgb, Sixteen, 1, 1, &words[..6]), rgba16(&[[0x0102, 0x0304, 0x0506, 0xffff]]));
    assert_eq!(
        of(ColorType::GrayscaleAlpha, Sixteen, 2, 1, &words),
        rgba16(&[[0x0102, 0x0102, 0x0102, 0x0304], [0x0506, 0x0506, 0x0506, 0xfffe]])
    );
}

/// Plain colours, so that every decoder that is right finds the same.
#[test]
fn images_jpeg() {
    let [orange, blue] = [[200, 100, 50, 255], [20, 41, 220, 255]];
    for bytes in [&include_bytes!("images/baseline.jpg")[..], include_bytes!("images/progressive.jpg")] {
        let (width, height, texels) = decoded(bytes);
        let Texels::Rgba8(texels) = texels else { panic!("JPEG has 8 bits") };
        assert_eq!((width, height), (16, 8));
        for (at, texel) in texels.into_iter().enumerate() {
            assert_eq!(texel, if at % 16 < 8 { orange } else { blue }, "{at}");
        }
    }
    let plain = |bytes: &[u8], color: [u8; 4]| assert_eq!(decoded(bytes), (8, 8, Texels::Rgba8(vec![color; 64])));
    plain(include_bytes!("images/grey.jpg"), [77, 77, 77, 255]);
    plain(include_bytes!("images/cmyk.jpg"), [235, 117, 0, 255]);
}

#[test]
fn images_webp() {
    let of = |bytes: &[u8]| decoded(bytes).2;
    let rgba = webp(image_webp::ColorType::Rgba8, 2, 1, &[1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(of(&rgba), Texels::Rgba8(vec![[1, 2, 3, 4], [5, 6, 7, 8]]));
    let rgb = webp(image_webp::ColorType::Rgb8, 1, 2, &[1, 2, 3, 4, 5, 6]);
    assert_eq!(of(&rgb), Texels::Rgba8(vec![[1, 2, 3, 255], [4, 5, 6, 255]]));
    assert_eq!(of(include_bytes!("images/lossy.webp")), Texels::Rgba8(vec![[201, 100, 48, 255]; 16]));
}

/// In a file beside the model, in a data URI and in a buffer view it is the same image.
#[test]
fn images_from_everywhere() {
    let bytes = png(ColorType::Rgb, BitDepth::Eight, 1, 1, &[1, 2, 3]);
    let mut file = textured(json!({}));
    let view = file.view(&bytes);
    file.json["images"][0] = json!({"bufferView": view, "mimeType": "image/png", "name": "inside"});
    let loaded = crate::read(Format::Gltf, file.glb()).unwrap();
    let texels = &loaded.scene.images[0].texels;
    assert_eq!((&*loaded.scene.images[0].name, loaded.notes.len()), ("inside", 0));
    assert_eq!(&of_image(&bytes).scene.images[0].texels, texels);
    let files = move |path: &str, _max: u64| match path {
        "a b/c.png" => Ok(bytes.clone()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    let file = textured(json!({"uri": "a%20b/c.png"}));
    let loaded = load_bytes(file.text().as_bytes(), Format::Gltf, &files, &Limits::default()).unwrap();
    assert_eq!((&*loaded.scene.images[0].name, &loaded.scene.images[0].texels), ("a b/c.png", texels));
    assert_eq!(loaded.scene.materials[0].base_color_texture, Some(TextureRef::new(0)));
}

/// One line each, and the model without them.
#[test]
fn images_that_cannot_be_had() {
    let note = |image: serde_json::Value, parts: &[&str]| {
        let loaded = textured(image).loaded();
        assert_eq!(loaded.notes.len(), 1, "{:?}", loaded.notes);
        assert!(parts.iter().all(|part| loaded.notes[0].contains(part)), "{:?}", loaded.notes);
        assert!(!loaded.notes[0].contains('\n'));
        assert!(loaded.scene.images.is_empty() && loaded.scene.textures.is_empty());
        assert_eq!(loaded.scene.materials[only(&loaded).material].base_color_texture, None);
    };
    note(json!({"uri": "gone.png"}), &["image 'gone.png' not found"]);
    note(json!({"uri": "../../secret.png"}), &["image '../../secret.png' is outside the model's folder"]);
    note(json!({"uri": "http://host/a.png"}), &["outside the model's folder"]);
    note(json!({"uri": "data:,%00%01"}), &["image 'number 0' cannot be decoded", "neither PNG, JPEG nor WebP"]);
    note(json!({"uri": "data:;base64,A*", "name": "logo"}), &["image 'logo' cannot be read", "base64"]);
    note(json!({"uri": data_uri(b"\xabKTX 20\xbb\r\n\x1a\n")}), &["KTX"]);
    note(json!({"uri": data_uri(&pixel()[..40])}), &["cannot be decoded"]);
    note(json!({"uri": data_uri(&include_bytes!("images/baseline.jpg")[..30])}), &["cannot be decoded"]);
    note(json!({"uri": data_uri(&include_bytes!("images/lossy.webp")[..20])}), &["cannot be decoded"]);
    note(json!({"bufferView": 99}), &["image 'number 0' cannot be read", "buffer view 99"]);
    note(json!({}), &["neither a URI nor a buffer view"]);
    let mut file = textured(json!({"uri": data_uri(&pixel())}));
    file.json["textures"][0] = json!({});
    assert_eq!(file.loaded().notes, ["texture 0 has no image that can be shown"]);
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = json!(3);
    assert_eq!(file.loaded().notes, ["texture 3 has no image that can be shown"]);
}

#[test]
fn images_that_nothing_shows_are_not_asked_for() {
    let mut file = textured(json!({"uri": data_uri(&pixel())}));
    push(&mut file.json["images"], json!({"uri": "gone.png"}));
    push(&mut file.json["textures"], json!({"source": 1}));
    push(&mut file.json["materials"], json!({"emissiveTexture": {"index": 1}}));
    let loaded = file.loaded();
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    assert_eq!((loaded.scene.images.len(), loaded.scene.textures.len()), (1, 1));
    assert_eq!(loaded.scene.materials[1].emissive_texture, None);
}

#[test]
fn images_of_several_textures_are_one() {
    let mut file = textured(json!({"uri": data_uri(&pixel())}));
    push(&mut file.json["textures"], json!({"source": 0, "name": "again"}));
    file.json["materials"][0]["normalTexture"] = json!({"index": 1});
    let scene = file.loaded().scene;
    assert_eq!((scene.images.len(), scene.textures.len()), (1, 2));
    assert_eq!((scene.textures[1].image, &*scene.textures[1].name), (0, "again"));
    assert_eq!(scene.materials[0].normal_texture, Some(TextureRef::new(1)));
}

#[test]
fn images_webp_as_an_extension_comes_before_its_fallback() {
    let mut file = textured(json!({"uri": "fallback.png"}));
    let webp = webp(image_webp::ColorType::Rgb8, 1, 1, &[1, 2, 3]);
    push(&mut file.json["images"], json!({"uri": data_uri(&webp)}));
    file.json["textures"][0]["extensions"] = json!({"EXT_texture_webp": {"source": 1}});
    file.json["extensionsUsed"] = json!(["EXT_texture_webp"]);
    file.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
    let loaded = file.loaded();
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    assert_eq!(loaded.scene.images[0].texels, Texels::Rgba8(vec![[1, 2, 3, 255]]));
}

/// A picture of 60,000 x 60,000 pixels takes no more bytes than this to announce.
fn bomb(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = pixel();
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let checksum = crc(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&checksum.to_be_bytes());
    bytes
}

/// PNG's checksum (PNG specification, annex D).
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), |crc, _| step(crc)))
}

#[test]
fn images_too_large_are_left_out() {
    let note = |bytes: &[u8], limits: Limits| {
        let file = textured(json!({"uri": data_uri(bytes)}));
        let loaded = load_bytes(file.text().as_bytes(), Format::Gltf, &pineda_scene::NoFiles, &limits).unwrap();
        assert!(loaded.scene.images.is_empty());
        loaded.notes.join("; ")
    };
    let says = |note: String, parts: &[&str]| assert!(parts.iter().all(|part| note.contains(part)), "{note}");
    says(note(&bomb(60_000, 60_000), Limits::default()), &["60000 x 60000", "Limits::image_pixels"]);
    says(note(&bomb(u32::MAX, 1), Limits::default()), &["Limits::image_pixels"]);
    let limits = Limits { pixels: 99, ..Limits::default() };
    says(note(&bomb(10, 10), limits), &["10 x 10 pixels; 99 are allowed in all images", "Limits::pixels"]);
    let limits = Limits { expanded_pixels: 10, ..Limits::default() };
    says(note(&bomb(100, 100), limits), &["100 x 100", "Limits::expanded_pixels"]);
    // The size is announced, but the pixels are not there.
    says(note(&bomb(2, 2), Limits::default()), &["cannot be decoded"]);
}

#[test]
fn images_files_count_against_the_limit_of_bytes() {
    let file = textured(json!({"uri": "a.png"}));
    let text = file.text();
    let bytes = pixel();
    let files = move |_: &str, max: u64| {
        if max < bytes.len() as u64 { Err(io::ErrorKind::FileTooLarge.into()) } else { Ok(bytes.clone()) }
    };
    let load = |file_bytes: usize| {
        let limits = Limits { file_bytes: file_bytes as u64, ..Limits::default() };
        load_bytes(text.as_bytes(), Format::Gltf, &files, &limits)
    };
    assert!(load(text.len() + 1000).unwrap().notes.is_empty());
    assert_eq!(load(text.len() + 3).unwrap().notes.len(), 1);
    assert!(matches!(load(text.len() - 1), Err(Error::Limit { .. })));
}

/// A bug once: each image's bytes allowed pixels of their own, so that one small picture, named often, took gigabytes.
#[test]
fn images_that_share_their_bytes_share_what_these_allow() {
    // Black, after as much noise as it takes to be allowed alone.
    let mut pixels = vec![0; 256 * 256 * 4];
    pixels[..2048].iter_mut().fold(1u32, |noise, byte| {
        *byte = (noise >> 24) as u8;
        noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223)
    });
    let image = png(ColorType::Rgba, BitDepth::Eight, 256, 256, &pixels);
    assert!((256 * 256..512 * 256).contains(&(32 * image.len())));
    let mut file = textured(json!({}));
    let view = file.view(&image);
    file.json["images"] = json!(vec![json!({"bufferView": view}); 100]);
    file.json["textures"] = (0..100).map(|source| json!({"source": source})).collect();
    let material = |texture| json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture}}});
    file.json["materials"] = (0..100).map(material).collect();
    let primitive = file.primitive().clone();
    let of_material = |material: usize| {
        let mut primitive = primitive.clone();
        primitive["material"] = json!(material);
        primitive
    };
    file.json["meshes"][0]["primitives"] = (0..100).map(of_material).collect();
    let text = file.text();
    let limits = Limits { expanded_pixels: 0, ..Limits::default() };
    let loaded = load_bytes(text.as_bytes(), Format::Gltf, &NoFiles, &limits).unwrap();
    assert_eq!(loaded.scene.images.len(), 32 * text.len() / (256 * 256));
    assert!(loaded.notes[0].contains("for all images of so few bytes"), "{:?}", loaded.notes);
}

/// A bug once: each buffer and image read the file anew that it names.
#[test]
fn images_and_buffers_of_one_file_read_it_once() {
    let reads = std::cell::Cell::new(0);
    let bytes = pixel();
    let files = |_: &str, _: u64| {
        reads.set(reads.get() + 1);
        Ok(bytes.clone())
    };
    let mut file = textured(json!({"uri": "a.png"}));
    file.json["images"] = json!([{"uri": "a.png"}, {"uri": "./a.png"}]);
    file.json["textures"] = json!([{"source": 0}, {"source": 1}]);
    file.json["materials"][0]["normalTexture"] = json!({"index": 1});
    push(&mut file.json["buffers"], json!({"byteLength": 4, "uri": "a.png"}));
    push(&mut file.json["bufferViews"], json!({"buffer": 1, "byteLength": 4}));
    let loaded = load_bytes(file.text().as_bytes(), Format::Gltf, &files, &Limits::default()).unwrap();
    assert_eq!((loaded.scene.images.len(), reads.get()), (2, 1));
}
