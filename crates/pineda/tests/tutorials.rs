//! The pictures of the five tutorials' examples and of the others, by hash of their raw pixels: the same at every SIMD level, with any number
//! of threads and any tile size.

#![allow(missing_docs, reason = "a test")]

#[path = "../examples/barycentric_spin.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod barycentric_spin;
mod gallery;
#[path = "../examples/homogeneous.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod homogeneous;
#[path = "../examples/instancing.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod instancing;
#[path = "../examples/ndc_depth.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod ndc_depth;
#[path = "../examples/occlusion.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod occlusion;
#[path = "../examples/raster2d.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod raster2d;
#[path = "../examples/wireframe.rs"]
#[allow(dead_code, unreachable_pub, reason = "an example's main and file writing are not run here")]
mod wireframe;

use pineda::{Error, Settings, Simd, TileSize};

/// FNV-1a.
struct Hash(u64);

impl Hash {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, pixels: &[[u8; 4]]) {
        for &byte in pixels.as_flattened() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// Each SIMD level with each number of threads and each tile size.
fn all_settings() -> impl Iterator<Item = Settings> {
    Simd::available().into_iter().flat_map(|simd| {
        [(1, TileSize::T64), (2, TileSize::T16), (7, TileSize::T32)].map(|(threads, tile)| Settings {
            simd,
            threads,
            tile,
            ..Settings::default()
        })
    })
}

fn check(draw: fn(Settings) -> Result<Vec<[u8; 4]>, Error>, expected: u64) {
    for settings in all_settings() {
        let mut hash = Hash::new();
        hash.add(&draw(settings.clone()).unwrap());
        assert_eq!(hash.0, expected, "{:#018x} with {settings:?}", hash.0);
    }
}

#[test]
fn raster2d_picture() {
    check(raster2d::draw, 0x1f03_44ed_ee68_c086);
}

#[test]
fn ndc_depth_picture() {
    check(ndc_depth::draw, 0x8bef_0e38_5f9f_1729);
}

#[test]
fn homogeneous_picture() {
    check(homogeneous::draw, 0x0ac8_8cf2_5eef_24c5);
}

#[test]
fn instancing_picture() {
    check(instancing::draw, 0xbd1e_bc8f_27ca_defe);
}

#[test]
fn occlusion_picture() {
    check(occlusion::draw, 0x2fe5_117b_fb39_5c88);
    check(occlusion::draw_all, 0x2fe5_117b_fb39_5c88);
}

#[test]
fn wireframe_picture() {
    check(wireframe::draw, 0x29bb_4da9_e7ae_7cf5);
}

fn spin(settings: Settings, frames: u32) -> u64 {
    let mut hash = Hash::new();
    barycentric_spin::draw(settings, frames, |pixels| -> Result<(), Error> {
        hash.add(pixels);
        Ok(())
    })
    .unwrap();
    hash.0
}

#[test]
fn barycentric_spin_first_frames_at_every_level() {
    for settings in all_settings() {
        let hash = spin(settings.clone(), 3);
        assert_eq!(hash, 0x362a_4638_8818_654c, "{hash:#018x} with {settings:?}");
    }
}

#[test]
fn barycentric_spin_whole_turn() {
    let hash = spin(Settings::default(), barycentric_spin::FRAMES);
    assert_eq!(hash, 0xf460_9a6f_7824_6e58, "{hash:#018x}");
}

#[test]
fn gallery_of_tutorials() {
    gallery::check("raster2d", &raster2d::draw(Settings::default()).unwrap());
    gallery::check("ndc_depth", &ndc_depth::draw(Settings::default()).unwrap());
    gallery::check("homogeneous", &homogeneous::draw(Settings::default()).unwrap());
    gallery::check("instancing", &instancing::draw(Settings::default()).unwrap());
    gallery::check("occlusion", &occlusion::draw(Settings::default()).unwrap());
    gallery::check("wireframe", &wireframe::draw(Settings::default()).unwrap());
    let mut last = Vec::new();
    barycentric_spin::draw(Settings::default(), 31, |pixels| -> Result<(), Error> {
        last = pixels.to_vec();
        Ok(())
    })
    .unwrap();
    gallery::check("barycentric_spin", &last);
}
