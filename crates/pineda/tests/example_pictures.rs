//! The pictures of the examples that show one feature each, by hash of their raw pixels: the same at every SIMD level, with any number of threads
//! and any tile size. Those of the tutorials are in `tutorials.rs`.

#![allow(missing_docs, reason = "a test")]

#[path = "../examples/deferred.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod deferred;
#[path = "../examples/depth_prepass.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod depth_prepass;
#[path = "../examples/procedural.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod procedural;
#[path = "../examples/sorted_transparency.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod sorted_transparency;
#[path = "../examples/stencil_outline.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod stencil_outline;

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
fn procedural_picture() {
    check(procedural::draw, 0xba97_b258_73ae_8fd6);
}
