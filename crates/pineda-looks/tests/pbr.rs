//! Physically based pictures of balls of many materials, by hash of the raw pixels: the same at every SIMD level, with any number of threads and any tile size.
//!
//! `PINEDA_PICTURES=1 cargo test -p pineda-looks --test pbr` writes the pictures to `target/tmp/pbr.png`, `pbr-large.png` and `pbr-lamps.png`.

#![allow(missing_docs, reason = "a test")]

use pineda::{Error, MAX_SIZE, Renderer, Samples, Settings, Simd, TileSize};
use pineda_looks::Stage;
use pineda_looks::pbr::{self, Environment, PbrSettings, ToneMapping};
use pineda_scene::{
    AlphaMode, Anisotropy, Bounds, Clearcoat, Framing, Image, Iridescence, Light, LightKind, Material, Normals, Object,
    Sampler, Scene, Sheen, Specular, SpecularGlossiness, Texels, Texture, TextureRef, Transmission, Vertex, View,
    Volume,
};
use std::sync::Arc;

const SIZE: u32 = 160;

/// A ball by square roots alone: an octahedron, its upper and lower pyramid blown up.
fn ball(center: [f32; 3], material: usize) -> Object {
    const STEPS: i32 = 10;
    let mut object = Object { material, normals: Normals::Given, uvs: vec![vec![]], ..Object::default() };
    for j in -STEPS..=STEPS {
        for i in -STEPS..=STEPS {
            let (x, z) = (i as f32 / STEPS as f32, j as f32 / STEPS as f32);
            for side in [1.0, -1.0] {
                let y = side * (1.0 - if x.abs() > z.abs() { x.abs() } else { z.abs() });
                let length = (x * x + y * y + z * z).sqrt();
                let normal = [x, y, z].map(|c| c / length);
                let position = [0, 1, 2].map(|axis| center[axis] + 0.45 * normal[axis]);
                object.vertices.push(Vertex { normal, ..Vertex::at(position) });
                object.uvs[0].push([2.0 * x, 2.0 * z]);
            }
        }
    }
    let at = |i: i32, j: i32, side: u32| (((j + STEPS) * (2 * STEPS + 1) + i + STEPS) as u32) * 2 + side;
    for (j, i) in (-STEPS..STEPS).flat_map(|j| (-STEPS..STEPS).map(move |i| (j, i))) {
        let corners = |side| [at(i, j, side), at(i + 1, j, side), at(i + 1, j + 1, side), at(i, j + 1, side)];
        let ([a, b, c, d], [e, f, g, h]) = (corners(0), corners(1));
        object.triangles.extend([[a, c, b], [a, d, c], [e, f, g], [e, g, h]]);
    }
    object
}

/// Checkers: red and green say roughness and what else those channels say, blue metalness; every other field is a hole.
fn checkers() -> Arc<Image> {
    let texel = |k: u32| if (k % 16 / 2 + k / 32).is_multiple_of(2) { [255, 200, 60, 255] } else { [120, 60, 255, 40] };
    let texels = Texels::Rgba8((0..16 * 16).map(texel).collect());
    Arc::new(Image { name: "".into(), width: 16, height: 16, texels })
}

/// Bumps of 16 bits.
fn bumps() -> Arc<Image> {
    let code = |x: f32| (x * 32767.0 + 32768.0) as u16;
    let texel = |k: u32| {
        let [x, y] = [k % 16, k / 16].map(|c| (c % 8) as f32 / 3.5 - 1.0);
        let length = (x * x + y * y + 1.0).sqrt();
        [code(x / length), code(-y / length), code(1.0 / length), 65535]
    };
    let texels = Texels::Rgba16((0..16 * 16).map(texel).collect());
    Arc::new(Image { name: "".into(), width: 16, height: 16, texels })
}

fn materials() -> Vec<Material> {
    let (checkers, bumps) = (Some(TextureRef::new(0)), Some(TextureRef::new(1)));
    let gold = Material { base_color_factor: [1.0, 0.76, 0.34, 1.0], roughness_factor: 0.25, ..Material::gltf() };
    let paint = |color: [f32; 3], roughness_factor| {
        let [r, g, b] = color;
        Material { base_color_factor: [r, g, b, 1.0], metallic_factor: 0.0, roughness_factor, ..Material::gltf() }
    };
    vec![
        Material { roughness_factor: 0.0, base_color_factor: [0.95, 0.95, 0.95, 1.0], ..Material::gltf() },
        gold.clone(),
        Material { metallic_roughness_texture: checkers, normal_texture: bumps, ..gold.clone() },
        Material { anisotropy: Some(Anisotropy { strength: 0.9, ..Anisotropy::default() }), ..gold },
        Material {
            clearcoat: Some(Clearcoat { factor: 1.0, normal_texture: bumps, ..Clearcoat::default() }),
            ..paint([0.7, 0.02, 0.03], 0.7)
        },
        Material {
            sheen: Some(Sheen { color_factor: [0.9, 0.5, 0.9], roughness_factor: 0.4, ..Sheen::default() }),
            ..paint([0.15, 0.02, 0.2], 0.9)
        },
        Material {
            transmission: Some(Transmission { factor: 1.0, texture: None }),
            volume: Some(Volume {
                thickness_factor: 0.6,
                attenuation_distance: 0.7,
                attenuation_color: [0.3, 0.8, 0.6],
                ..Volume::default()
            }),
            ..paint([1.0; 3], 0.05)
        },
        Material {
            iridescence: Some(Iridescence { factor: 1.0, ..Iridescence::default() }),
            specular: Some(Specular { color_factor: [0.9, 0.9, 1.0], ..Specular::default() }),
            ..paint([0.02, 0.02, 0.03], 0.15)
        },
        Material {
            base_color_texture: checkers,
            occlusion_texture: checkers,
            alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
            double_sided: true,
            ..paint([0.9; 3], 0.5)
        },
        Material { alpha_mode: AlphaMode::Blend, ..paint([0.2, 0.4, 0.9], 0.3) },
        Material { emissive_factor: [1.0, 0.35, 0.05], emissive_strength: 1.5, ..paint([0.1; 3], 0.5) },
        Material {
            specular_glossiness: Some(SpecularGlossiness {
                diffuse_factor: [0.1, 0.5, 0.2, 1.0],
                specular_factor: [0.3; 3],
                glossiness_factor: 0.8,
                ..SpecularGlossiness::default()
            }),
            ..Material::gltf()
        },
        Material { unlit: true, ..paint([0.9, 0.8, 0.1], 0.5) },
        paint([0.8; 3], 1.0),
    ]
}

/// One of each kind.
fn lights() -> Vec<Light> {
    let sun = Light {
        name: "".into(),
        color: [1.0, 0.9, 0.7],
        intensity: 1.0,
        range: f32::INFINITY,
        position: [0.0; 3],
        direction: [0.6, -0.8, 0.0],
        kind: LightKind::Directional,
    };
    let place = Light { position: [-1.0, 1.6, 1.0], range: 3.0, intensity: 3.0, kind: LightKind::Point, ..sun.clone() };
    let kind = LightKind::Spot { inner_cone_angle: 0.25, outer_cone_angle: 0.5 };
    let cone = Light { position: [0.8, 2.0, 0.0], direction: [0.0, -1.0, 0.0], intensity: 12.0, kind, ..sun.clone() };
    vec![sun, place, cone]
}

/// A ball of each material on a plate.
fn balls() -> Scene {
    let mut materials = materials();
    let mut objects: Vec<Object> =
        (0..materials.len() - 1).map(|k| ball([(k % 4) as f32 - 1.5, 0.45, (k / 4) as f32 - 1.5], k)).collect();
    materials[9].base_color_factor[3] = 0.5;
    let corners = [[-2.1, 0.0, -2.1], [-2.1, 0.0, 2.1], [2.1, 0.0, 2.1], [2.1, 0.0, -2.1]];
    objects.push(Object {
        vertices: corners.map(Vertex::at).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material: materials.len() - 1,
        ..Object::default()
    });
    let texture = |image| Texture { name: "".into(), image, sampler: Sampler::default() };
    Scene {
        objects,
        materials,
        textures: vec![texture(0), texture(1)],
        images: vec![checkers(), bumps()],
        lights: lights(),
        ..Scene::default()
    }
}

fn draw(environment: &Environment, settings: &PbrSettings, renderer: &mut Renderer) -> Vec<[f32; 4]> {
    draw_sized(SIZE, environment, settings, renderer)
}

fn draw_sized(size: u32, environment: &Environment, settings: &PbrSettings, renderer: &mut Renderer) -> Vec<[f32; 4]> {
    let mut scene = balls();
    let view = View { elevation: 38.0, ..View::default() };
    let framing = Framing::new(&Bounds::of(&scene).unwrap(), &view).unwrap();
    let stage = Stage::new(&mut scene, &framing, 1.0, 0.0).unwrap();
    pbr::draw(&stage, &scene, environment, settings, [size; 2], renderer).unwrap()
}

/// FNV-1a over the bits of all pixels.
fn hash(pixels: &[[f32; 4]]) -> u64 {
    pixels
        .as_flattened()
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, x| (hash ^ u64::from(x.to_bits())).wrapping_mul(0x0100_0000_01b3))
}

/// Over grey, so that alpha is seen.
fn write(pixels: &[[f32; 4]], size: u32, name: &str) {
    let file = std::fs::File::create(format!("{}/{name}.png", env!("CARGO_TARGET_TMPDIR"))).unwrap();
    let code = |x: f32| (x.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0 + 0.5) as u8;
    let bytes: Vec<u8> = pixels.iter().flat_map(|&[r, g, b, a]| [r, g, b].map(|c| code(c + 0.4 * (1.0 - a)))).collect();
    let mut png = png::Encoder::new(file, size, size);
    png.set_color(png::ColorType::Rgb);
    png.write_header().unwrap().write_image_data(&bytes).unwrap();
}

/// At every level, with several numbers of threads and tile sizes.
fn check(name: &str, size: u32, light: impl Fn(&mut Renderer) -> Environment, settings: &PbrSettings, wanted: u64) {
    for (simd, (threads, tile)) in
        Simd::available().into_iter().zip([(1, TileSize::T64), (3, TileSize::T16)].into_iter().cycle())
    {
        let mut renderer = Renderer::new(Settings { simd, threads, tile, ..Settings::default() }).unwrap();
        let pixels = draw_sized(size, &light(&mut renderer), settings, &mut renderer);
        if std::env::var_os("PINEDA_PICTURES").is_some() {
            write(&pixels, size, name);
        }
        let hash = hash(&pixels);
        assert_eq!(hash, wanted, "{name}: {hash:#018x} at {simd}, {threads} threads, {tile:?}");
    }
}

#[test]
fn pbr_golden() {
    let studio = |_: &mut Renderer| Environment::studio().unwrap();
    check("pbr", SIZE, studio, &PbrSettings::default(), 0xeed4_0134_1ab6_1daa);
}

/// Larger pictures have a larger map of the key light's shadow.
#[test]
fn pbr_golden_large() {
    let studio = |_: &mut Renderer| Environment::studio().unwrap();
    check("pbr-large", 288, studio, &PbrSettings::default(), 0x636c_6408_6b79_e90a);
}

#[test]
fn pbr_golden_lamps() {
    let dim = |renderer: &mut Renderer| Environment::dim_studio(renderer).unwrap();
    check("pbr-lamps", SIZE, dim, &PbrSettings { own_lights: true, ..PbrSettings::default() }, 0x8f91_e08c_556f_11df);
}

/// A panorama that is white all around, without shadows: nothing is brighter than it, and a white matt surface is as bright.
#[test]
fn pbr_neither_makes_nor_loses_light() {
    let mut renderer = Renderer::new(Settings::default()).unwrap();
    let white = Environment::panorama(8, 4, &[[1.0; 3]; 32], &mut renderer).unwrap();
    let settings = PbrSettings {
        samples: Samples::One,
        tone_mapping: ToneMapping::None,
        occlusion: false,
        ground: false,
        ..PbrSettings::default()
    };
    let mut scene = Scene {
        objects: (0..2).map(|k| ball([k as f32, 0.0, 0.0], k)).collect(),
        materials: vec![
            Material { metallic_factor: 0.0, ..Material::gltf() },
            Material { roughness_factor: 0.5, ..Material::gltf() },
        ],
        ..Scene::default()
    };
    let framing = Framing::new(&Bounds::of(&scene).unwrap(), &View::default()).unwrap();
    let stage = Stage::new(&mut scene, &framing, 1.0, 0.0).unwrap();
    let pixels = pbr::draw(&stage, &scene, &white, &settings, [SIZE; 2], &mut renderer).unwrap();
    let mut covered = 0;
    for [r, g, b, _] in pixels.into_iter().filter(|pixel| pixel[3] > 0.0) {
        covered += 1;
        assert!([r, g, b].iter().all(|light| (0.97..=1.0).contains(light)), "{r} {g} {b}");
    }
    assert!(covered > 2000, "{covered}");
}

/// What is not there is transparent; a ground's shadow is black and lets light through.
#[test]
fn pbr_leaves_the_background_to_others() {
    let mut renderer = Renderer::new(Settings::default()).unwrap();
    let environment = Environment::studio().unwrap();
    let bare = draw(&environment, &PbrSettings { ground: false, ..PbrSettings::default() }, &mut renderer);
    let grounded = draw(&environment, &PbrSettings::default(), &mut renderer);
    let mut shadowed = 0;
    for (bare, grounded) in bare.iter().zip(&grounded) {
        if bare[3] == 0.0 {
            assert_eq!((*bare, &grounded[..3]), ([0.0; 4], &[0.0; 3][..]));
            shadowed += u32::from(grounded[3] > 0.0);
            assert!((0.0..1.0).contains(&grounded[3]));
        }
    }
    assert!(shadowed > 500, "{shadowed}");
}

/// Bug: the faces of a two-sided blended surface were blended in the order of its triangles. A ball has one back face and one front face at most in each pixel.
#[test]
fn pbr_blends_back_faces_before_front_faces() {
    let mut renderer = Renderer::new(Settings::default()).unwrap();
    let environment = Environment::studio().unwrap();
    let settings = PbrSettings { samples: Samples::One, ..PbrSettings::default() };
    let mut draw = |is_reversed: bool, double_sided: bool| {
        let glaze = Material {
            alpha_mode: AlphaMode::Blend,
            base_color_factor: [0.9, 0.2, 0.1, 0.5],
            double_sided,
            ..Material::gltf()
        };
        let mut object = ball([0.0; 3], 0);
        if is_reversed {
            object.triangles.reverse();
        }
        let mut scene = Scene { objects: vec![object], materials: vec![glaze], ..Scene::default() };
        let framing = Framing::new(&Bounds::of(&scene).unwrap(), &View::default()).unwrap();
        let stage = Stage::new(&mut scene, &framing, 1.0, 0.0).unwrap();
        pbr::draw(&stage, &scene, &environment, &settings, [SIZE; 2], &mut renderer).unwrap()
    };
    let two_sided = draw(false, true);
    assert!(two_sided == draw(true, true), "the order of triangles counts");
    assert!(two_sided != draw(false, false), "the back faces are not seen");
}

/// A matt plane straight from above, without perspective, so that each pixel's place is known: what falls there by KHR_lights_punctual's formulas in the scene's own units, wherever and however large the scene is.
#[test]
fn pbr_lamps_light_as_much_as_they_do_in_the_scene() {
    let mut renderer = Renderer::new(Settings::default()).unwrap();
    let black = Environment::panorama(8, 4, &[[0.0; 3]; 32], &mut renderer).unwrap();
    let settings = PbrSettings {
        samples: Samples::One,
        tone_mapping: ToneMapping::None,
        own_lights: true,
        occlusion: false,
        ground: false,
        ..PbrSettings::default()
    };
    for (unit, [x, z]) in [(1.0, [0.0, 0.0]), (64.0, [4096.0, -512.0]), (0.125, [-3.0, 8.0])] {
        let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let plane = Object {
            vertices: corners.map(|[s, t]| Vertex::at([(x + s * unit) as f32, 0.0, (z + t * unit) as f32])).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Object::default()
        };
        let matt = Material {
            metallic_factor: 0.0,
            specular: Some(Specular { factor: 0.0, ..Specular::default() }),
            ..Material::gltf()
        };
        let (inner, outer) = (0.2, 0.7);
        let lamp = Light {
            name: "".into(),
            color: [1.0, 0.5, 0.25],
            intensity: (4.0 * unit * unit) as f32,
            range: (2.0 * unit) as f32,
            position: [x + 0.25 * unit, 1.25 * unit, z - 0.5 * unit],
            direction: [0.0, -1.0, 0.0],
            kind: LightKind::Spot { inner_cone_angle: inner, outer_cone_angle: outer },
        };
        let mut scene =
            Scene { objects: vec![plane], materials: vec![matt], lights: vec![lamp.clone()], ..Scene::default() };
        let view = View { azimuth: 0.0, elevation: 90.0, orthographic: true, ..View::default() };
        let framing = Framing::new(&Bounds::of(&scene).unwrap(), &view).unwrap();
        let stage = Stage::new(&mut scene, &framing, 1.0, 0.0).unwrap();
        let pixels = pbr::draw(&stage, &scene, &black, &settings, [SIZE; 2], &mut renderer).unwrap();
        let (mut lit, mut covered) = (0, 0);
        for (k, pixel) in (0..).zip(pixels).filter(|(_, pixel)| pixel[3] > 0.0) {
            // The circle around the plane fits the picture.
            let at = |k: u32| (f64::from(2 * k + 1) / f64::from(SIZE) - 1.0) * 2f64.sqrt() * unit;
            let [to_x, to_z] = [x + at(k % SIZE) - lamp.position[0], z + at(k / SIZE) - lamp.position[2]];
            let distance = (to_x * to_x + to_z * to_z + lamp.position[1] * lamp.position[1]).sqrt();
            let cosine = lamp.position[1] / distance;
            let window = (1.0 - (distance / f64::from(lamp.range)).powi(4)).max(0.0);
            let cone = ((cosine - outer.cos()) / (inner.cos() - outer.cos())).clamp(0.0, 1.0).powi(2);
            let falls = f64::from(lamp.intensity) * cosine * window * cone / (distance * distance);
            for (ours, color) in pixel.into_iter().zip(lamp.color) {
                let theirs = (falls * f64::from(color) / std::f64::consts::PI).min(1.0);
                // Corners are snapped to 1/256 pixel, and with them what lies between by up to 3.5e-5 units; light changes by less than 2 a unit.
                assert!((f64::from(ours) - theirs).abs() < 7e-5, "pixel {k}, unit {unit}: {ours} instead of {theirs}");
            }
            lit += u32::from(falls > 0.0);
            covered += 1;
        }
        assert!(lit > 3000 && covered > lit + 500, "{lit} of {covered}");
    }
}

/// Bug: what a material cuts out cast shadows as if it were there, and hid light from all around.
#[test]
fn pbr_of_what_is_cut_out_is_as_if_it_was_not_there() {
    let mut renderer = Renderer::new(Settings::default()).unwrap();
    let environment = Environment::studio().unwrap();
    let mut draw = |roof: Option<AlphaMode>| {
        let matt = Material { metallic_factor: 0.0, ..Material::gltf() };
        let alpha_mode = roof.unwrap_or(AlphaMode::Opaque);
        let materials = vec![matt.clone(), Material { alpha_mode, double_sided: true, ..matt }];
        let mut scene = Scene { objects: vec![ball([0.0; 3], 0)], materials, ..Scene::default() };
        // All of it in the ball's box, so that the camera and the ground are the same.
        let corners = [[-0.4, 0.4, -0.4], [-0.4, 0.4, 0.4], [0.4, 0.4, 0.4], [0.4, 0.4, -0.4]];
        scene.objects.extend(roof.map(|_| Object {
            vertices: corners.map(Vertex::at).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            material: 1,
            ..Object::default()
        }));
        let framing = Framing::new(&Bounds::of(&scene).unwrap(), &View::default()).unwrap();
        let stage = Stage::new(&mut scene, &framing, 1.0, 0.0).unwrap();
        pbr::draw(&stage, &scene, &environment, &PbrSettings::default(), [SIZE; 2], &mut renderer).unwrap()
    };
    let (without, all) = (draw(None), draw(Some(AlphaMode::Opaque)));
    assert!(draw(Some(AlphaMode::Mask { cutoff: 1.1 })) == without, "nothing is left of it");
    assert!(draw(Some(AlphaMode::Mask { cutoff: 0.5 })) == all, "all is left of it");
    assert!(all != without);
}

#[test]
fn pbr_of_a_size_that_cannot_be_is_an_error() {
    let mut renderer = Renderer::new(Settings::default()).unwrap();
    let environment = Environment::studio().unwrap();
    let mut scene = balls();
    let framing = Framing::new(&Bounds::of(&scene).unwrap(), &View::default()).unwrap();
    let stage = Stage::new(&mut scene, &framing, 1.0, 0.0).unwrap();
    for size in [[0, 8], [8, 0], [u32::MAX, u32::MAX], [MAX_SIZE + 1, 1]] {
        let drawn = pbr::draw(&stage, &scene, &environment, &PbrSettings::default(), size, &mut renderer);
        assert!(matches!(drawn, Err(Error::TargetSize { .. })), "{size:?}: {drawn:?}");
    }
}
