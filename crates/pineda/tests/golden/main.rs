//! Golden scenes: the same bits at every SIMD level, with 1, 2 and 7 threads, with two tile sizes, in debug and in release.
//!
//! What is compared is one hash a scene, of the raw bytes of all that a target holds; the hashes are in `hashes.txt`.
//!
//! - `PINEDA_BLESS=1 cargo test -p pineda --test golden` writes them anew: look at every picture that changed first.
//! - `PINEDA_PICTURES=1 cargo test -p pineda --test golden` writes the pictures, as PPM, to `target/tmp/golden`.

mod conservative;
mod floor;
mod formats;
mod functions;
mod looks;
mod multisample;
mod primitives;
mod scenes;
mod shapes;
mod strokes;
mod targets;
mod textures;

use pineda::{ColorBuffer, DepthBuffer, NO_ID, Pass, Renderer, Settings, Simd, Target, TileSize};
use scenes::{Format, Scene};
use std::fmt::Write as _;
use std::path::Path;

/// One `name hash` a line.
const HASHES: &str = include_str!("hashes.txt");

#[test]
fn scenes_are_the_same_bits_everywhere() {
    let mut found = String::new();
    for scene in scenes::all() {
        let reference = Frame::drawn(&scene, Settings { simd: Simd::Scalar, threads: 1, ..Settings::default() });
        let bytes = reference.bytes();
        for simd in Simd::available() {
            for threads in [1, 2, 7] {
                for tile in [TileSize::T16, TileSize::T64] {
                    let frame = Frame::drawn(&scene, Settings { simd, threads, tile, ..Settings::default() });
                    let same = frame.bytes() == bytes;
                    assert!(same, "{}: {simd}, {threads} threads and {tile:?} give other bits", scene.name);
                }
            }
        }
        if std::env::var_os("PINEDA_PICTURES").is_some() {
            reference.write_picture(&scene);
        }
        writeln!(found, "{} {:016x}", scene.name, fnv1a(&bytes)).expect("a string grows");
    }
    if std::env::var_os("PINEDA_BLESS").is_some() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/hashes.txt");
        std::fs::write(path, &found).expect("the repository can be written to");
        return;
    }
    let changed: Vec<_> = found.lines().filter(|line| !HASHES.lines().any(|known| known == *line)).collect();
    assert!(
        changed.is_empty() && found.lines().count() == HASHES.lines().count(),
        "these scenes are not what crates/pineda/tests/golden/hashes.txt says:\n{}\nif that is meant, look at them \
         (PINEDA_PICTURES=1) and bless them (PINEDA_BLESS=1)",
        changed.join("\n")
    );
}

/// All that a target holds.
struct Frame {
    width: u32,
    bytes: Vec<[u8; 4]>,
    float: Vec<[f32; 4]>,
    depth: Vec<f32>,
    /// Empty if no draw has a stencil test.
    stencil: Vec<u8>,
    triangle_ids: Vec<u32>,
    instance_ids: Vec<u32>,
    draw_ids: Vec<u32>,
    barycentrics: Vec<[f32; 3]>,
    hits: Vec<u32>,
}

impl Frame {
    fn drawn(scene: &Scene, settings: Settings) -> Self {
        let (width, height) = (scene.width, scene.height);
        let pixels = (width * height) as usize;
        // All samples of everything but the picture, which holds their averages.
        let samples = pixels * scene.samples.count();
        let mut frame = Self {
            width,
            bytes: vec![[0; 4]; if scene.format == Format::Float { 0 } else { pixels }],
            float: vec![[0.0; 4]; if scene.format == Format::Float { pixels } else { 0 }],
            depth: vec![0.0; samples],
            stencil: vec![0; if scene.has_stencil() { samples } else { 0 }],
            triangle_ids: vec![0; samples],
            instance_ids: vec![0; samples],
            draw_ids: vec![0; samples],
            barycentrics: vec![[0.0; 3]; samples],
            hits: vec![0; samples],
        };
        let mut pass = Pass::new();
        pass.clear_color = Some(scene.clear);
        pass.clear_depth = Some(scene.clear_depth);
        scene.layers.iter().for_each(|layer| layer.draw(&mut pass));
        let (mut d16, mut d24) = (vec![0u16; samples], vec![0u32; samples]);
        let mut target = Target {
            color: match scene.format {
                Format::Linear => ColorBuffer::Rgba8(&mut frame.bytes),
                Format::Srgb => ColorBuffer::Rgba8Srgb(&mut frame.bytes),
                Format::Float => ColorBuffer::Rgba32F(&mut frame.float),
            },
            depth: match scene.depth_bits {
                16 => DepthBuffer::D16(&mut d16),
                24 => DepthBuffer::D24(&mut d24),
                _ => DepthBuffer::D32F(&mut frame.depth),
            },
            stencil: scene.has_stencil().then_some(&mut frame.stencil),
            triangle_ids: Some(&mut frame.triangle_ids),
            instance_ids: Some(&mut frame.instance_ids),
            draw_ids: Some(&mut frame.draw_ids),
            barycentrics: Some(&mut frame.barycentrics),
            hits: Some(&mut frame.hits),
            samples: scene.samples,
            ..Target::new(width, height)
        };
        let mut renderer = Renderer::new(settings).expect("an available level");
        renderer.render(&pass, &mut target).expect("a valid scene");
        // All codes are f32s, too.
        match scene.depth_bits {
            16 => frame.depth = d16.into_iter().map(f32::from).collect(),
            24 => frame.depth = d24.into_iter().map(|code| code as f32).collect(),
            _ => {}
        }
        frame
    }

    fn bytes(&self) -> Vec<u8> {
        let mut all = self.bytes.clone();
        let mut words = |words: &[u32]| all.extend(words.iter().map(|word| word.to_le_bytes()));
        words(&self.triangle_ids);
        // Scenes without instances are older than these.
        if self.instance_ids.iter().any(|&instance| instance != 0 && instance != NO_ID) {
            words(&self.instance_ids);
        }
        words(&self.draw_ids);
        words(&self.hits);
        let floats = [self.float.as_flattened(), &self.depth, self.barycentrics.as_flattened()];
        for floats in floats {
            all.extend(floats.iter().map(|float| float.to_bits().to_le_bytes()));
        }
        let mut all = all.into_flattened();
        all.extend(&self.stencil);
        all
    }

    /// For people to look at: binary PPM, without alpha, floats as they are on an sRGB screen of gamma 2.2.
    fn write_picture(&self, scene: &Scene) {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden");
        std::fs::create_dir_all(&folder).expect("the target folder can be written to");
        let mut file =
            format!("P6 {} {} 255\n", self.width, self.bytes.len().max(self.float.len()) / self.width as usize)
                .into_bytes();
        match scene.format {
            Format::Float => {
                let code = |&x: &f32| (x.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8;
                file.extend(self.float.iter().flat_map(|pixel| pixel[..3].iter().map(code)));
            }
            _ => file.extend(self.bytes.iter().flat_map(|pixel| &pixel[..3])),
        }
        std::fs::write(folder.join(format!("{}.ppm", scene.name)), file).expect("the target folder can be written to");
    }
}

/// FNV-1a, 64 bits.
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
// x
