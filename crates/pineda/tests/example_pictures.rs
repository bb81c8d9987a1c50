//! The pictures of the examples that show one feature each, by hash of their raw pixels: the same at every SIMD level, with any number of threads
//! and any tile size. Those of the tutorials are in `tutorials.rs`.

#![allow(missing_docs, reason = "a test")]

#[path = "../examples/deferred.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod deferred;
#[path = "../examples/depth_prepass.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod depth_prepass;
#[path = "../examples/environment.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod environment;
mod gallery;
#[path = "../examples/impostors.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod impostors;
#[path = "../examples/normal_mapping.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod normal_mapping;
#[path = "../examples/order_dependent_transparency.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod order_dependent_transparency;
#[path = "../examples/parallax.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod parallax;
#[path = "../examples/post_process.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod post_process;
#[path = "../examples/procedural.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod procedural;
#[path = "../examples/shadow_map.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod shadow_map;
#[path = "../examples/shadow_volume.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod shadow_volume;
#[path = "../examples/sorted_transparency.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod sorted_transparency;
#[path = "../examples/sprites.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod sprites;
#[path = "../examples/stencil_outline.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod stencil_outline;
#[path = "../examples/visibility_buffer.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod visibility_buffer;
#[path = "../examples/warp.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod warp;

use pineda::{Error, Settings, Simd, TileSize};

/// FNV-1a of what it draws, with each SIMD level, each number of threads and each tile size.
fn check(draw: fn(Settings) -> Result<Vec<[u8; 4]>, Error>, expected: u64) {
    for simd in Simd::available() {
        for (threads, tile) in [(1, TileSize::T64), (2, TileSize::T16), (7, TileSize::T32)] {
            let settings = Settings { simd, threads, tile, ..Settings::default() };
            let pixels = draw(settings.clone()).expect("it draws");
            let add = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            let hash = pixels.as_flattened().iter().fold(0xcbf2_9ce4_8422_2325, add);
            assert_eq!(hash, expected, "{hash:#018x} with {settings:?}");
        }
    }
}

#[test]
fn sorted_transparency_picture() {
    check(sorted_transparency::draw, 0x571a_8019_2f11_6561);
}

#[test]
fn stencil_outline_picture() {
    check(stencil_outline::draw, 0x2b0d_da74_55ad_ae12);
}

#[test]
fn deferred_picture() {
    check(deferred::draw, 0x8aa7_3f56_2e5d_ec12);
}

#[test]
fn depth_prepass_picture() {
    check(depth_prepass::draw, 0x82c6_7005_59a7_1509);
}

#[test]
fn environment_picture() {
    check(environment::draw, 0x3804_cc29_6519_1d6d);
}

#[test]
fn impostors_picture() {
    check(impostors::draw, 0x0e34_f44f_cb35_5ad2);
}

#[test]
fn parallax_picture() {
    check(parallax::draw, 0x102b_7195_708b_dde1);
}

#[test]
fn warp_picture() {
    check(warp::draw, 0xbb3c_6b18_67e8_5d11);
}

#[test]
fn normal_mapping_picture() {
    check(normal_mapping::draw, 0x5d16_d177_735f_1ccd);
}

#[test]
fn post_process_picture() {
    check(post_process::draw, 0xffd3_66ea_0555_33fd);
}

#[test]
fn shadow_map_picture() {
    check(shadow_map::draw, 0xf05c_7077_1870_850b);
}

#[test]
fn sprites_picture() {
    check(sprites::draw, 0xbd86_6930_faa7_7af5);
}

#[test]
fn shadow_volume_picture() {
    check(shadow_volume::draw, 0x03e6_8f33_e093_f709);
}

#[test]
fn order_dependent_transparency_picture() {
    check(order_dependent_transparency::draw, 0x8b45_354e_4d26_a039);
}

#[test]
fn visibility_buffer_picture() {
    check(visibility_buffer::draw, 0xc64b_23c6_b995_02cc);
}

#[test]
fn gallery_of_features() {
    gallery::check("deferred", &deferred::draw(Settings::default()).expect("it draws"));
    gallery::check("depth_prepass", &depth_prepass::draw(Settings::default()).expect("it draws"));
    gallery::check(
        "order_dependent_transparency",
        &order_dependent_transparency::draw(Settings::default()).expect("it draws"),
    );
    gallery::check("environment", &environment::draw(Settings::default()).expect("it draws"));
    gallery::check("impostors", &impostors::draw(Settings::default()).expect("it draws"));
    gallery::check("normal_mapping", &normal_mapping::draw(Settings::default()).expect("it draws"));
    gallery::check("parallax", &parallax::draw(Settings::default()).expect("it draws"));
    gallery::check("post_process", &post_process::draw(Settings::default()).expect("it draws"));
    gallery::check("procedural", &procedural::draw(Settings::default()).expect("it draws"));
    gallery::check("shadow_map", &shadow_map::draw(Settings::default()).expect("it draws"));
    gallery::check("sprites", &sprites::draw(Settings::default()).expect("it draws"));
    gallery::check("shadow_volume", &shadow_volume::draw(Settings::default()).expect("it draws"));
    gallery::check("sorted_transparency", &sorted_transparency::draw(Settings::default()).expect("it draws"));
    gallery::check("stencil_outline", &stencil_outline::draw(Settings::default()).expect("it draws"));
    gallery::check("visibility_buffer", &visibility_buffer::draw(Settings::default()).expect("it draws"));
    gallery::check("warp", &warp::draw(Settings::default()).expect("it draws"));
}

#[test]
fn procedural_picture() {
    check(procedural::draw, 0xba97_b258_73ae_8fd6);
}
