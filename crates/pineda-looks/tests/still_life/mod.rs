//! A scene built in code: a textured floor, two cards with the same relief (with tangents and without), a leaf that is cut out, two panes of glass, a ball, lines and points.

use pineda_scene::{
    AlphaMode, Image, Material, Normals, Object, Sampler, Scene, SpecularGlossiness, Texels, Texture, TextureRef,
    Vertex,
};
use std::sync::Arc;

const FLOOR: usize = 0;
const RELIEF: usize = 1;
const LEAF: usize = 2;
const GLASS: usize = 3;
const BALL: usize = 4;
const DIFFUSE: usize = 5;

pub(crate) fn still_life() -> Scene {
    let texture = |number| Some(TextureRef::new(number));
    let material = Material { double_sided: false, ..Material::default() };
    let relief = card([-1.0, 0.0, -0.6], [0.9, 0.0, 0.0], [0.0, 0.9, 0.0], RELIEF);
    let mut with_tangents = Object {
        tangents: vec![[1.0, 0.0, 0.0, 1.0]; 4],
        normals: Normals::Given,
        ..card([0.1, 0.0, -0.6], [0.9, 0.0, 0.0], [0.0, 0.9, 0.0], RELIEF)
    };
    with_tangents.vertices.iter_mut().for_each(|vertex| vertex.normal = [0.0, 0.0, 1.0]);
    let mut objects = vec![
        card([-1.2, 0.0, 1.0], [2.4, 0.0, 0.0], [0.0, 0.0, -2.0], FLOOR),
        relief,
        with_tangents,
        card([-0.9, 0.0, 0.1], [0.7, 0.0, 0.2], [0.0, 0.8, 0.0], LEAF),
        // The nearer one first: they must be sorted.
        card([-0.3, 0.0, 0.7], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0], GLASS),
        card([-0.1, 0.0, 0.5], [0.5, 0.0, 0.0], [0.0, 0.6, 0.0], GLASS),
        ball([0.7, 0.3, 0.3], 0.3),
        card([0.3, 1.0, -0.6], [0.5, 0.0, 0.0], [0.0, 0.3, 0.0], DIFFUSE),
        strokes(),
    ];
    objects[5].vertices.iter_mut().for_each(|vertex| vertex.color = [0.2, 1.0, 0.3, 0.8]);
    Scene {
        objects,
        materials: vec![
            Material { base_color_texture: texture(0), ..material.clone() },
            Material { normal_texture: texture(1), normal_scale: 0.8, double_sided: true, ..material.clone() },
            Material {
                base_color_factor: [0.5, 0.9, 0.3, 1.0],
                base_color_texture: texture(2),
                alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
                double_sided: true,
                ..material.clone()
            },
            Material {
                base_color_factor: [0.9, 0.3, 0.2, 0.5],
                alpha_mode: AlphaMode::Blend,
                double_sided: true,
                ..material.clone()
            },
            Material { base_color_factor: [0.8, 0.6, 0.2, 1.0], ..material.clone() },
            Material {
                base_color_factor: [0.0; 4],
                specular_glossiness: Some(SpecularGlossiness {
                    diffuse_factor: [0.3, 0.3, 1.0, 1.0],
                    diffuse_texture: texture(0),
                    ..SpecularGlossiness::default()
                }),
                ..material
            },
        ],
        textures: (0..3).map(|image| Texture { name: "".into(), image, sampler: Sampler::default() }).collect(),
        images: vec![checkers(), relief_image(), holes()],
        ..Scene::default()
    }
}

/// A parallelogram from its lower left corner, seen from where `right` is to the right and `up` is up.
fn card(corner: [f32; 3], right: [f32; 3], up: [f32; 3], material: usize) -> Object {
    let at = |u: f32, v: f32| Vertex::at([0, 1, 2].map(|axis| corner[axis] + right[axis] * u + up[axis] * v));
    Object {
        vertices: vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
        uvs: vec![vec![[0.0, 2.0], [2.0, 2.0], [2.0, 0.0], [0.0, 0.0]]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
        ..Object::default()
    }
}

/// By square roots alone.
fn ball(center: [f32; 3], radius: f32) -> Object {
    const STEPS: i32 = 8;
    let mut object = Object { material: BALL, normals: Normals::Given, uvs: vec![vec![]], ..Object::default() };
    for j in -STEPS..=STEPS {
        for i in -STEPS..=STEPS {
            // A pyramid over the square |x| + |z| <= 1, front and back, blown up to a ball.
            let (x, y) = (i as f32 / STEPS as f32, j as f32 / STEPS as f32);
            for side in [1.0, -1.0] {
                let z = side * (1.0 - if x.abs() > y.abs() { x.abs() } else { y.abs() });
                let length = (x * x + y * y + z * z).sqrt();
                let normal = [x, y, z].map(|c| c / length);
                let position = [0, 1, 2].map(|axis| center[axis] + radius * normal[axis]);
                object.vertices.push(Vertex { normal, ..Vertex::at(position) });
                object.uvs[0].push([0.5 * (x + 1.0), 0.5 * (y + 1.0)]);
            }
        }
    }
    let at = |i: i32, j: i32, side: u32| (((j + STEPS) * (2 * STEPS + 1) + i + STEPS) as u32) * 2 + side;
    for (j, i) in (-STEPS..STEPS).flat_map(|j| (-STEPS..STEPS).map(move |i| (j, i))) {
        let corners = |side| [at(i, j, side), at(i + 1, j, side), at(i + 1, j + 1, side), at(i, j + 1, side)];
        let ([a, b, c, d], [e, f, g, h]) = (corners(0), corners(1));
        object.triangles.extend([[a, b, c], [a, c, d], [e, g, f], [e, h, g]]);
    }
    object
}

/// A frame of lines, with a point at each corner.
fn strokes() -> Object {
    let corners = [[-1.1, 1.1, -0.5], [0.0, 1.1, -0.5], [0.0, 1.4, -0.5], [-1.1, 1.4, -0.5]];
    Object {
        vertices: corners.map(|at| Vertex { color: [1.0, 0.4, 0.1, 1.0], ..Vertex::at(at) }).to_vec(),
        lines: vec![[0, 1], [1, 2], [2, 3], [3, 0]],
        points: vec![0, 1, 2, 3],
        material: BALL,
        ..Object::default()
    }
}

fn image(size: u32, texel: impl Fn(f32, f32) -> [u8; 4]) -> Arc<Image> {
    let place = |k: u32| (k as f32 + 0.5) / size as f32;
    let texels = (0..size * size).map(|k| texel(place(k % size), place(k / size))).collect();
    Arc::new(Image { name: "".into(), width: size, height: size, texels: Texels::Rgba8(texels) })
}

/// Dark and bright, and red where u is small, green where v is small.
fn checkers() -> Arc<Image> {
    image(32, |u, v| {
        let is_dark = ((u * 8.0) as u32 + (v * 8.0) as u32).is_multiple_of(2);
        let bright = if is_dark { 90 } else { 220 };
        [bright - (u * 80.0) as u8, bright - (v * 80.0) as u8, bright, 255]
    })
}

/// A dome in the middle: its left side looks to the left, its upper side upwards.
fn relief_image() -> Arc<Image> {
    image(32, |u, v| {
        let (x, y) = ((u - 0.5) * 2.4, (0.5 - v) * 2.4);
        let height_squared = 1.0 - x * x - y * y;
        let [x, y, z] = if height_squared > 0.0 { [x, y, height_squared.sqrt()] } else { [0.0, 0.0, 1.0] };
        let code = |n: f32| (n * 127.0 + 128.0) as u8;
        [code(x), code(y), code(z), 255]
    })
}

/// White, with a round hole in which alpha falls to 0.
fn holes() -> Arc<Image> {
    image(32, |u, v| {
        let (x, y) = (u - 0.5, v - 0.5);
        let alpha = 6.0 * (x * x + y * y);
        [255, 255, 255, if alpha < 1.0 { (alpha * 255.0) as u8 } else { 255 }]
    })
}
