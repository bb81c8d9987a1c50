//! Images: PNG, JPEG and WebP. One that cannot be shown is a note; the model is drawn without it.

use super::make::{Gltf, IMAGE, cut, patched, png};
use super::{Case, Error, Picture, Wanted, case};
use serde_json::json;

pub(super) fn cases() -> Vec<Case> {
    [pngs(), jpegs(), webps(), bombs(), materials()].into_iter().flatten().collect()
}

/// The good file with another image.
fn textured(image: &[u8]) -> Gltf {
    let mut file = Gltf::good();
    let view = file.view(image);
    file.set("/images/0/bufferView", json!(view))
}

fn of(name: &'static str, image: &[u8], wanted: Wanted) -> Case {
    case(name, "a.glb", textured(image).glb(), wanted)
}

const NOT_DECODED: Wanted = Picture(&["image 'number 0' cannot be decoded"]);

fn pngs() -> Vec<Case> {
    let good = png(4, 4, &[200; 64]);
    // IHDR is the first chunk: its size at 16, bits and kind of colour behind that. Sums over chunks are looked at last.
    let header = |at: usize, with: &[u8]| summed(patched(good.clone(), at, with));
    vec![
        of("png-empty", &[], NOT_DECODED),
        of("png-is-text", b"Dear Sir or Madam", Picture(&["neither PNG, JPEG nor WebP"])),
        of("png-is-ktx", b"\xabKTX 20\xbb\r\n\x1a\n", Picture(&["KTX, which cannot be read"])),
        of("png-mark-only", &good[..8], NOT_DECODED),
        of("png-header-only", &good[..33], NOT_DECODED),
        of("png-cut-short", &good[..good.len() - 20], NOT_DECODED),
        of("png-sum-wrong", &patched(good.clone(), 29, &[0; 4]), NOT_DECODED),
        of("png-width-0", &header(16, &[0; 4]), NOT_DECODED),
        of("png-width-negative", &header(16, &[255; 4]), Picture(&["4294967295 x 4 pixels", "Limits::image_pixels"])),
        of("png-3-bits", &header(24, &[3]), NOT_DECODED),
        of("png-colour-kind-unknown", &header(25, &[7]), NOT_DECODED),
        of("png-palette-missing", &header(25, &[3]), NOT_DECODED),
        of("png-interlaced-but-not", &header(28, &[1]), NOT_DECODED),
        of("png-data-are-no-zlib", &summed(patched(good.clone(), 41, &[0xff; 8])), NOT_DECODED),
        of("png-larger-than-its-data", &header(16, &[0, 0, 16, 0, 0, 0, 16, 0]), NOT_DECODED),
    ]
}

/// With the sums of its chunks made right.
fn summed(mut png: Vec<u8>) -> Vec<u8> {
    let mut at = 8;
    while at + 12 <= png.len() {
        let length = u32::from_be_bytes([png[at], png[at + 1], png[at + 2], png[at + 3]]) as usize;
        let sum = crc(&png[at + 4..at + 8 + length]);
        png[at + 8 + length..at + 12 + length].copy_from_slice(&sum.to_be_bytes());
        at += 12 + length;
    }
    png
}

/// PNG's and zip's sum over bytes (ISO 3309).
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum: u32, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 })
    })
}

fn jpegs() -> Vec<Case> {
    let mut good = Vec::new();
    let pixels: Vec<u8> = (0..32 * 32 * 3).map(|i| (i * 7 % 251) as u8).collect();
    jpeg_encoder::Encoder::new(&mut good, 90).encode(&pixels, 32, 32, jpeg_encoder::ColorType::Rgb).unwrap();
    let marker = |kind: u8| good.windows(2).position(|pair| pair == [0xff, kind]).unwrap();
    let frame = marker(0xc0);
    let sized = |height: u16, width: u16| {
        let [a, b] = height.to_be_bytes();
        let [c, d] = width.to_be_bytes();
        patched(good.clone(), frame + 5, &[a, b, c, d])
    };
    vec![
        of("jpeg-good", &good, Picture(&[])),
        of("jpeg-mark-only", &good[..2], NOT_DECODED),
        of("jpeg-header-cut-short", &good[..frame + 4], NOT_DECODED),
        of("jpeg-height-0", &sized(0, 32), NOT_DECODED),
        of("jpeg-width-0", &sized(32, 0), NOT_DECODED),
        of("jpeg-components-200", &patched(good.clone(), frame + 9, &[200]), NOT_DECODED),
        of("jpeg-sampling-0", &patched(good.clone(), frame + 11, &[0]), NOT_DECODED),
        of("jpeg-of-65535", &sized(65535, 65535), Picture(&["65535 x 65535 pixels", "Limits::image_pixels"])),
        of("jpeg-of-2048-and-few-bytes", &sized(2048, 2048), Picture(&[])),
        of("jpeg-lengths-of-0", &patched(good.clone(), frame + 2, &[0, 0]), NOT_DECODED),
    ]
}

fn webps() -> Vec<Case> {
    let mut good = Vec::new();
    let pixels: Vec<u8> = (0..16 * 16 * 4).map(|i| (i * 7 % 251) as u8).collect();
    image_webp::WebPEncoder::new(&mut good).encode(&pixels, 16, 16, image_webp::ColorType::Rgba8).unwrap();
    // A canvas of 16384 x 16384, and nothing on it.
    let mut canvas = b"RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0".to_vec();
    canvas.extend([0xff, 0x3f, 0, 0xff, 0x3f, 0]);
    vec![
        of("webp-good", &good, Picture(&[])),
        of("webp-mark-only", &good[..12], NOT_DECODED),
        of("webp-cut-short", &good[..good.len() / 2], NOT_DECODED),
        of("webp-length-huge", &patched(good.clone(), 16, &[255; 4]), Picture(&[])),
        of("webp-canvas-without-picture", &canvas, NOT_DECODED),
        of("webp-of-noise", &[&good[..25], &[0x5a; 200]].concat(), NOT_DECODED),
    ]
}

/// Few bytes that are many pixels.
fn bombs() -> Vec<Case> {
    vec![
        of("bomb-of-pixels", &large(100_000, 100_000), Picture(&["100000 x 100000 pixels", "Limits::image_pixels"])),
        of("bomb-of-largest-size", &large(8192, 8192), Picture(&["8192 x 8192 pixels", "Limits::expanded_pixels"])),
        of("bomb-of-pixels-that-are-not-there", &large(5000, 5000), NOT_DECODED),
        of("bomb-of-data-behind-a-pixel", &inflating(), Picture(&[])),
    ]
}

/// A good header of that size, and no data to speak of.
fn large(width: u32, height: u32) -> Vec<u8> {
    let size = [width.to_be_bytes(), height.to_be_bytes()].concat();
    summed(patched(png(1, 1, &[0; 4]), 16, &size))
}

/// A pixel whose data inflate to sixty-four MiB of zeros.
fn inflating() -> Vec<u8> {
    let long = png(4096, 4096, &vec![0; 4096 * 4096 * 4]);
    summed(patched(long, 16, &[0, 0, 0, 1, 0, 0, 0, 1]))
}

fn materials() -> Vec<Case> {
    let image = |name, uri: &str, wanted| {
        let file = Gltf::good().set("/images/0", json!({"uri": uri}));
        case(name, "a.glb", file.glb(), wanted)
    };
    let good = png(1, 1, &[255; 4]);
    vec![
        image("image-missing", "gone.png", Picture(&["image 'gone.png' not found"])),
        image("image-outside", "../../secret.png", Picture(&["outside the model's folder"])),
        image("image-outside-in-percents", "%2e%2e%2fsecret.png", Picture(&["outside the model's folder"])),
        image("image-on-the-network", "https://example.org/a.png", Picture(&["outside the model's folder"])),
        image("image-data-broken", "data:image/png;base64,****", Picture(&["cannot be read"])),
        image("image-is-a-model", "a.glb", Picture(&["neither PNG, JPEG nor WebP"])),
        case(
            "image-of-nothing",
            "a.glb",
            Gltf::good().set("/images/0", json!({})).glb(),
            Picture(&["neither a URI nor a buffer view"]),
        ),
        case(
            "image-view-too-long",
            "a.glb",
            Gltf::good().set(&format!("/bufferViews/{IMAGE}/byteLength"), json!(1e9)).glb(),
            Picture(&["cut short"]),
        ),
        case(
            "image-in-obj",
            "a.obj",
            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n",
            Picture(&["image 'a.png' cannot be decoded"]),
        )
        .beside("a.mtl", "newmtl a\nmap_Kd a.png\n")
        .beside("a.png", cut(good, 20)),
        case(
            "samplers-unknown",
            "a.glb",
            Gltf::good()
                .set("/samplers/0", json!({"magFilter": 1, "minFilter": u64::MAX, "wrapS": 3, "wrapT": 0}))
                .glb(),
            Picture(&[]),
        ),
        case(
            "alpha-mode-unknown",
            "a.glb",
            Gltf::good().set("/materials/0/alphaMode", json!("FOG")).glb(),
            Picture(&[]),
        ),
        case(
            "alpha-cutoff-huge",
            "a.glb",
            Gltf::good()
                .set("/materials/0/alphaMode", json!("MASK"))
                .set("/materials/0/alphaCutoff", json!(-1e300))
                .glb(),
            Picture(&[]),
        ),
        case("material-of-text", "a.glb", Gltf::good().set("/materials/0", json!("red")).glb(), Error(&["JSON"])),
    ]
}
