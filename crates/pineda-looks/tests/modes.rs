//! Every mode on a scene with all that modes must get right, by hash of the raw pixels: the same at every SIMD level, with any number of threads and any tile size.
//!
//! `PINEDA_PICTURES=1 cargo test -p pineda-looks --test modes` writes the pictures to `target/tmp/modes` instead of comparing.

#![allow(missing_docs, reason = "a test")]

mod still_life;

use pineda::{ColorBuffer, Pass, Renderer, Settings, Simd, Target, TileSize};
use pineda_looks::{Mode, Show, Stage, Textures};
use pineda_scene::{Bounds, Framing, Scene, View};
use still_life::still_life;

const SIZE: u32 = 128;

fn draw(mut scene: Scene, view: &View, mode: Mode, textures: Textures, settings: Settings) -> Vec<[f32; 4]> {
    let framing = Framing::new(&Bounds::of(&scene).unwrap(), view).unwrap();
    let stage = Stage::new(&mut scene, &framing, 1.0, 0.0).unwrap();
    let show = Show::new(&stage, &scene, mode, textures).unwrap();
    let mut pass = Pass::new();
    show.record(&stage, &mut pass);
    let mut pixels = vec![[0.0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings).unwrap().render(&pass, &mut target).unwrap();
    pixels
}

/// FNV-1a over the bits of all pixels.
fn check(name: &str, view: &View, mode: Mode, textures: Textures, expected: u64) {
    for simd in Simd::available() {
        for (threads, tile) in [(1, TileSize::T64), (7, TileSize::T16)] {
            let settings = Settings { simd, threads, tile, ..Settings::default() };
            let pixels = draw(still_life(), view, mode, textures, settings);
            let hash = pixels.as_flattened().iter().fold(0xcbf2_9ce4_8422_2325u64, |hash, x| {
                (hash ^ u64::from(x.to_bits())).wrapping_mul(0x0100_0000_01b3)
            });
            if std::env::var_os("PINEDA_PICTURES").is_some() {
                println!("{name} {hash:#018x}");
                return write(name, &pixels);
            }
            assert_eq!(hash, expected, "{name}: {hash:#018x} at {simd}, {threads} threads, {tile:?}");
        }
    }
}

/// As plain numbers, over grey, so that alpha is seen.
fn write(name: &str, pixels: &[[f32; 4]]) {
    let folder = concat!(env!("CARGO_TARGET_TMPDIR"), "/modes");
    std::fs::create_dir_all(folder).unwrap();
    let file = std::fs::File::create(format!("{folder}/{name}.png")).unwrap();
    let bytes = pixels.iter().flat_map(|&[r, g, b, a]| {
        [r, g, b].map(|c| ((c + 0.2 * (1.0 - a)).clamp(0.0, 1.0).sqrt() * 255.0 + 0.5) as u8)
    });
    let bytes: Vec<u8> = bytes.collect();
    let mut png = png::Encoder::new(file, SIZE, SIZE);
    png.set_color(png::ColorType::Rgb);
    png.write_header().unwrap().write_image_data(&bytes).unwrap();
}

const VIEW: View =
    View { azimuth: 20.0, elevation: 25.0, fov: 40.0, aspect: 1.0, up: [0.0, 1.0, 0.0], orthographic: false };
const FLAT: Textures = Textures { mipmaps: true, normal_maps: false };
const BUMPY: Textures = Textures { mipmaps: true, normal_maps: true };

#[test]
fn modes_unlit_golden() {
    check("unlit", &VIEW, Mode::Unlit, FLAT, 0x9ca7_f0e7_f29c_04ea);
}

#[test]
fn modes_unlit_without_mipmaps_golden() {
    check("unlit_without_mipmaps", &VIEW, Mode::Unlit, Textures { mipmaps: false, ..FLAT }, 0x4cfd_20a5_0397_76ee);
}

#[test]
fn modes_lambert_golden() {
    check("lambert", &VIEW, Mode::Lambert, FLAT, 0x5ac4_c023_b6cc_2c04);
    check("lambert_with_normal_maps", &VIEW, Mode::Lambert, BUMPY, 0x7afc_b5fb_11d1_46df);
}

#[test]
fn modes_normals_golden() {
    check("normals", &VIEW, Mode::Normals, FLAT, 0xd78b_5e1d_1b0e_3a7c);
    check("normals_with_normal_maps", &VIEW, Mode::Normals, BUMPY, 0x8cad_a3ea_e0ef_672f);
    let back = View { azimuth: 200.0, ..VIEW };
    check("normals_with_normal_maps_from_behind", &back, Mode::Normals, BUMPY, 0x2da2_5a27_17ba_7c29);
}

#[test]
fn modes_depth_golden() {
    check("depth", &VIEW, Mode::Depth, FLAT, 0x3c06_daad_8522_95c6);
    check("depth_orthographic", &View { orthographic: true, ..VIEW }, Mode::Depth, FLAT, 0xcc11_1b37_5175_3245);
}

#[test]
fn modes_uv_golden() {
    check("uv", &VIEW, Mode::Uv, FLAT, 0x46a4_46ab_a389_9081);
}

#[test]
fn modes_wireframe_golden() {
    check("wireframe", &VIEW, Mode::Wireframe, FLAT, 0x514d_eaa0_6866_cc7c);
}

#[test]
fn modes_matcap_golden() {
    check("matcap", &VIEW, Mode::Matcap, FLAT, 0x7e23_b24e_172c_fde5);
    check("matcap_orthographic", &View { orthographic: true, ..VIEW }, Mode::Matcap, FLAT, 0xbfcd_cd49_5034_d226);
}

#[test]
fn modes_overdraw_golden() {
    check("overdraw", &VIEW, Mode::Overdraw, FLAT, 0x5cd1_d884_e736_2325);
}
