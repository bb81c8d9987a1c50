//! Every look on a ball and an open bowl, by hash of the raw pixels: the same at every SIMD level, with any number of threads
//! and any tile size.

#![allow(missing_docs, reason = "a test")]

use pineda::{ColorBuffer, DrawState, Indices, Mat4, Mesh, Pass, Renderer, Settings, Shader, Simd, Target, TileSize};
use pineda_looks::{BaseColor, Depth, Lambert, Normals, Vertex};

const SIZE: u32 = 96;
const EYE: [f32; 3] = [1.0, 1.5, 3.0];
const NEAR: f32 = 1.0;
const FAR: f32 = 6.0;

/// A sphere from an octahedron, by square roots alone: the faces with all corners at or above `lowest` before
/// subdivision, each cut into 4^`steps`.
fn ball(center: [f32; 3], lowest: f32, color: [f32; 4], steps: u32) -> Vec<Vertex> {
    let mut faces = Vec::new();
    for [x, y, z] in [[1., 1., 1.], [-1., 1., 1.], [-1., 1., -1.], [1., 1., -1.]] {
        for y in [y, -y] {
            let face = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
            faces.push(if x * y * z > 0.0 { face } else { [face[0], face[2], face[1]] });
        }
    }
    faces.retain(|face| face.iter().all(|corner| corner[1] >= lowest));
    for _ in 0..steps {
        faces = faces
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let vertex = |normal: [f32; 3]| Vertex {
        position: [0, 1, 2].map(|k| center[k] + normal[k]),
        normal,
        color,
        ..Vertex::default()
    };
    faces.into_iter().flatten().map(vertex).collect()
}

/// Half-way between two points of the unit sphere, on it.
fn middle(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    let sum = [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let length = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
    sum.map(|x| x / length)
}

fn camera() -> Mat4 {
    Mat4::perspective(0.8, 1.0, NEAR, FAR) * Mat4::look_at(EYE, [0.0; 3], [0.0, 1.0, 0.0])
}

/// Draws the ball, and below it a bowl, of which the inner side is seen.
fn draw<S: Shader<Vertex = Vertex>>(shader: &S, settings: &Settings) -> Vec<[f32; 4]> {
    let mut vertices = ball([-0.3, 0.2, 0.0], -1.0, [1.0, 0.6, 0.3, 1.0], 3);
    let mut bowl = ball([0.6, 0.0, 0.6], 0.0, [0.3, 0.6, 1.0, 1.0], 2);
    for vertex in &mut bowl {
        vertex.position[1] = 0.2 - vertex.position[1];
        vertex.normal[1] = -vertex.normal[1];
    }
    bowl.chunks_exact_mut(3).for_each(|face| face.swap(1, 2));
    vertices.append(&mut bowl);
    let mut pixels = vec![[0.0; 4]; (SIZE * SIZE) as usize];
    let mut pass = Pass::new();
    pass.draw(shader, Mesh { vertices: &vertices, indices: Indices::Sequential }, DrawState::default());
    let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings.clone()).unwrap().render(&pass, &mut target).unwrap();
    pixels
}

/// FNV-1a over the bits of all pixels.
fn check<S: Shader<Vertex = Vertex>>(shader: &S, expected: u64) {
    for simd in Simd::available() {
        for (threads, tile) in [(1, TileSize::T64), (7, TileSize::T16)] {
            let pixels = draw(shader, &Settings { simd, threads, tile, ..Settings::default() });
            let hash = pixels.as_flattened().iter().fold(0xcbf2_9ce4_8422_2325u64, |hash, x| {
                (hash ^ u64::from(x.to_bits())).wrapping_mul(0x0100_0000_01b3)
            });
            assert_eq!(hash, expected, "{hash:#018x} at {simd}, {threads} threads, {tile:?}");
        }
    }
}

#[test]
fn lambert_golden() {
    check(&Lambert::new(camera(), BaseColor::opaque([0.9, 0.8, 0.7])), 0x7986_1160_8c4e_5853);
}

#[test]
fn normals_golden() {
    check(&Normals { clip_from_world: camera() }, 0xa850_3e8e_7ca2_78f6);
}

#[test]
fn depth_golden() {
    check(&Depth::perspective(camera(), NEAR, FAR), 0x55dd_940d_ee4c_336b);
}

/// What is seen of the surface faces the eye, on both sides of it; and light does not vanish.
#[test]
fn looks_stay_in_range() {
    let settings = Settings::default();
    let lambert = draw(&Lambert::new(camera(), BaseColor::default()), &settings);
    let normals = draw(&Normals { clip_from_world: camera() }, &settings);
    let depth = draw(&Depth::perspective(camera(), NEAR, FAR), &settings);
    let mut covered = 0;
    for ((light, normal), depth) in lambert.iter().zip(&normals).zip(&depth) {
        assert_eq!([light[3], normal[3]], [depth[3]; 2]);
        if depth[3] == 0.0 {
            continue;
        }
        covered += 1;
        let [x, y, z] = [0, 1, 2].map(|k| normal[k] * 2.0 - 1.0);
        assert!((x * x + y * y + z * z - 1.0).abs() < 1e-5);
        // Towards the camera, up to what a ray off the picture's middle and the facets' own silhouette take away.
        assert!(x * EYE[0] + y * EYE[1] + z * EYE[2] > -1.6, "{normal:?}");
        assert!(light[..3].iter().all(|&c| c > 0.02 && c <= 1.0), "{light:?}");
        assert!(depth[0] > 0.0 && depth[0] < 1.0);
    }
    assert!(covered > 2000, "{covered}");
}

/// A plane at right angles to the view: its distance is known, and so is Lambert's light on it.
#[test]
fn looks_of_a_plane_are_what_the_formulas_say() {
    let corner = |x, y| Vertex {
        position: [x, y, 0.0],
        normal: [0.0, 0.0, 1.0],
        color: [0.5, 1.0, 1.0, 1.0],
        ..Vertex::default()
    };
    let plane = [corner(-4.0, -4.0), corner(4.0, -4.0), corner(0.0, 8.0)];
    let clip_from_world =
        Mat4::perspective(0.8, 1.0, 1.0, 5.0) * Mat4::look_at([0.0, 0.0, 3.0], [0.0; 3], [0.0, 1.0, 0.0]);
    fn center<S: Shader<Vertex = Vertex>>(shader: &S, plane: &[Vertex]) -> [f32; 4] {
        let mut pixel = [[0.0; 4]];
        let mut pass = Pass::new();
        pass.draw(shader, Mesh { vertices: plane, indices: Indices::Sequential }, DrawState::default());
        let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixel), ..Target::new(1, 1) };
        Renderer::new(Settings::default()).unwrap().render(&pass, &mut target).unwrap();
        pixel[0]
    }
    assert_eq!(center(&Depth::perspective(clip_from_world, 1.0, 5.0), &plane), [0.5, 0.5, 0.5, 1.0]);
    assert_eq!(center(&Normals { clip_from_world }, &plane), [0.5, 0.5, 1.0, 1.0]);
    let [r, g, b, a] = center(&Lambert::new(clip_from_world, BaseColor::opaque([1.0, 1.0, 0.5])), &plane);
    let light = 0.25 + 0.75 * 0.8 / 1.89f32.sqrt();
    assert!([r - 0.5 * light, g - light, b - 0.5 * light].iter().all(|difference| difference.abs() < 1e-6));
    assert_eq!(a, 1.0);
}
