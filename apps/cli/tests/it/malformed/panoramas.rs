//! Panoramas for `--environment`: Radiance and OpenEXR.

use super::make::{cut, patched};
use super::{Case, Error, Picture, Wanted, case};
use exr::image::Blocks;
use exr::prelude::{Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage};
use std::io::Cursor;

pub(super) fn cases() -> Vec<Case> {
    [radiance(), openexr()].into_iter().flatten().collect()
}

fn radiance() -> Vec<Case> {
    let of = |name, head: &str, pixels: &[u8], wanted: Wanted| {
        case(name, "a.hdr", [head.as_bytes(), pixels].concat(), wanted).options(&["--environment"])
    };
    const HEAD: &str = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    let sized = |size: &str| format!("{HEAD}{size}\n");
    let flat = [128, 100, 90, 129].repeat(8);
    // Two rows of runs: each channel 16 times the same.
    let runs = [[2, 2, 0, 16].as_slice(), &[128 + 16, 128].repeat(4)].concat().repeat(2);
    vec![
        of("hdr-good", &sized("-Y 2 +X 4"), &flat, Picture(&[])),
        of("hdr-empty", "", &[], Error(&["environment cannot be read"])),
        of("hdr-mark-only", "#?RADIANCE\n", &[], Error(&["environment cannot be read"])),
        of("hdr-without-size", HEAD, &[], Error(&["environment cannot be read"])),
        of("hdr-size-of-words", &sized("-Y two +X four"), &flat, Error(&["environment cannot be read"])),
        of("hdr-size-0", &sized("-Y 0 +X 0"), &[], Error(&["environment cannot be read"])),
        of("hdr-size-negative", &sized("-Y -2 +X -4"), &flat, Error(&["environment cannot be read"])),
        of("hdr-size-huge", &sized("-Y 1000000 +X 2000000"), &flat, Error(&["environment cannot be read"])),
        of("hdr-size-overflows", &sized("-Y 4294967296 +X 4294967296"), &flat, Error(&["environment cannot be read"])),
        of("hdr-size-as-large-as-may-be", &sized("-Y 4096 +X 8192"), &flat, Error(&["environment cannot be read"])),
        of("hdr-cut-short", &sized("-Y 2 +X 4"), &flat[..20], Error(&["environment cannot be read"])),
        of("hdr-run-cut-short", &sized("-Y 2 +X 16"), &runs[..9], Error(&["environment cannot be read"])),
        of("hdr-run-too-long", &sized("-Y 2 +X 16"), &patched(runs.clone(), 4, &[255]), Picture(&[])),
        of("hdr-run-of-another-width", &sized("-Y 2 +X 16"), &patched(runs, 3, &[17]), Picture(&[])),
        of(
            "hdr-header-without-end",
            &format!("#?RADIANCE\n{}", "A=B\n".repeat(100_000)),
            &[],
            Error(&["environment cannot be read"]),
        ),
        of(
            "hdr-is-a-model",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            &[],
            Error(&["environment cannot be read", ".hdr"]),
        ),
    ]
}

fn openexr() -> Vec<Case> {
    let of = |name, bytes: Vec<u8>, wanted: Wanted| case(name, "a.exr", bytes, wanted).options(&["--environment"]);
    let image = |encoding, pixel: f32| {
        let pixels = |_: Vec2<usize>| (pixel, 0.5f32, 0.25f32, 1.0f32);
        let layer = Layer::new((8, 4), LayerAttributes::named("a"), encoding, SpecificChannels::rgba(pixels));
        let mut bytes = Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    };
    let good = image(Encoding::SMALL_LOSSLESS, 1.0);
    // The attribute's name, its type, its length, and four numbers.
    let window = |name: &str, numbers: [i32; 4]| {
        let key = format!("{name}\0box2i\0");
        let at = good.windows(key.len()).position(|bytes| bytes == key.as_bytes()).unwrap() + key.len() + 4;
        patched(good.clone(), at, &numbers.map(i32::to_le_bytes).concat())
    };
    // Behind name, type and length of the attribute its sides.
    let tile = |sides: [u32; 2]| {
        let tiled = image(Encoding { blocks: Blocks::Tiles(Vec2(4, 4)), ..Encoding::UNCOMPRESSED }, 1.0);
        let key = b"tiles\0tiledesc\0";
        let at = tiled.windows(key.len()).position(|bytes| bytes == key).unwrap() + key.len() + 4;
        patched(tiled, at, &sides.map(u32::to_le_bytes).concat())
    };
    let length = {
        let at = good.windows(9).position(|bytes| bytes == b"channels\0").unwrap() + 9 + 7;
        patched(good.clone(), at, &[255, 255, 255, 127])
    };
    const WRONG: Wanted = Error(&["environment cannot be read"]);
    vec![
        of("exr-good", good.clone(), Picture(&[])),
        of("exr-nan", image(Encoding::UNCOMPRESSED, f32::NAN), Picture(&[])),
        of("exr-infinite", image(Encoding::FAST_LOSSLESS, f32::INFINITY), Picture(&[])),
        of("exr-mark-only", cut(good.clone(), 4), WRONG),
        of("exr-header-cut-short", cut(good.clone(), 100), WRONG),
        of("exr-cut-short", cut(good.clone(), good.len() - 10), WRONG),
        of("exr-of-zeros", patched(vec![0; 4000], 0, &good[..8]), WRONG),
        of("exr-attribute-huge", length, WRONG),
        of(
            "exr-window-huge",
            window("dataWindow", [0, 0, i32::MAX - 1, i32::MAX - 1]),
            Error(&["environment cannot be read", "data window"]),
        ),
        // A bug once: a row's memory is taken several times.
        of(
            "exr-window-of-long-rows",
            window("dataWindow", [0, 0, 8_257_543, 3]),
            Error(&["8257544 x 4 pixels", "in a row"]),
        ),
        of("exr-tile", tile([4, 4]), Picture(&[])),
        // A bug once: memory was taken for a tile, whatever the picture's own size.
        of("exr-tile-huge", tile([1 << 15, 4]), Error(&["32768 x 4 pixels", "in a row"])),
        of("exr-tile-large", tile([8192, 4096]), Error(&["pieces of 536870912 bytes"])),
        of("exr-window-inside-out", window("dataWindow", [5, 5, 0, 0]), WRONG),
        of("exr-window-overflows", window("dataWindow", [i32::MIN, i32::MIN, i32::MAX, i32::MAX]), WRONG),
        of("exr-window-as-large-as-may-be", window("dataWindow", [0, 0, 8191, 4095]), WRONG),
        of(
            "exr-window-far-away",
            window("dataWindow", [-1_000_000_000, 1_000_000_000, -999_999_993, 1_000_000_003]),
            WRONG,
        ),
        of("exr-version-9", patched(good.clone(), 4, &[9]), WRONG),
        of("exr-of-deep-data", patched(good.clone(), 5, &[8]), Picture(&[])),
    ]
}
