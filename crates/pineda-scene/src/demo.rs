//! A scene built in code, for a first picture without a model: a still life of a knot and balls on a turned plinth.
//!
//! Everything is analytic, normals and contact shadows included, and of `libm`, so the scene has the same bits on every
//! platform.

mod knot;
mod lathe;
mod occlusion;

use crate::color::srgb8_table;
use crate::vector::Vec3;
use crate::{Material, Normals, Object, Scene, Vertex};
use knot::Knot;
use lathe::{ball, plinth};
use occlusion::Occluders;

const KNOT: Knot = Knot { ring: 0.66, wave: 0.24, tube: 0.2, turn: 3.3, segments: 520, sides: 52 };

/// Radius of the plinth's level top.
const PLINTH_TOP: f64 = 1.14;

/// Name, sRGB colour, place on the plinth (x, z) and radius.
const BALLS: [(&str, [u8; 3], [f64; 2], f64); 5] = [
    ("teal ball", [0x1f, 0x8a, 0x8c], [-0.46, 0.74], 0.22),
    ("gold ball", [0xf2, 0xb1, 0x34], [0.06, 0.9], 0.13),
    ("navy ball", [0x2b, 0x3f, 0x6b], [0.78, 0.62], 0.24),
    ("coral ball", [0xf0, 0x6a, 0x55], [0.4, 0.96], 0.08),
    ("sage ball", [0xa9, 0xc2, 0x9a], [-0.88, 0.4], 0.17),
];

/// A knot whose colour runs along it, five balls, and the plinth that they stand on: some 110,000 triangles, closed
/// surfaces with normals, single sided. The plinth's top is y = 0; vertex colours hold soft contact shadows.
pub fn demo() -> Scene {
    let mut knot = KNOT.object();
    let mut plinth = plinth(PLINTH_TOP, 0.34).revolve([0.0; 3], 200);
    let mut balls = BALLS.map(|(_, _, [x, z], radius)| ball(radius, 32).revolve([x, radius, z], 64));

    let mut occluders = Occluders::default();
    occluders.add_tube(&KNOT.center_line(150), KNOT.tube);
    for (_, _, [x, z], radius) in BALLS {
        occluders.add_ball([x, radius, z], radius);
    }
    occluders.darken_floor(&mut plinth.0);
    for vertices in balls.iter_mut().map(|ball| &mut ball.0).chain([&mut knot.0]) {
        occlusion::darken_above_floor(vertices);
    }

    let mut scene = Scene::default();
    add(&mut scene, "knot", [0xff, 0xff, 0xff], knot);
    add(&mut scene, "plinth", [0xf0, 0xeb, 0xe1], plinth);
    for ((name, color, ..), ball) in BALLS.into_iter().zip(balls) {
        add(&mut scene, name, color, ball);
    }
    scene
}

/// Vertices and triangles.
type Surface = (Vec<Vertex>, Vec<[u32; 3]>);

fn add(scene: &mut Scene, name: &str, [r, g, b]: [u8; 3], (vertices, triangles): Surface) {
    let linear = |code: u8| srgb8_table()[usize::from(code)];
    scene.objects.push(Object {
        name: name.into(),
        vertices,
        triangles,
        material: scene.materials.len(),
        normals: Normals::Given,
        ..Object::default()
    });
    scene.materials.push(Material {
        name: name.into(),
        base_color_factor: [linear(r), linear(g), linear(b), 1.0],
        double_sided: false,
        ..Material::default()
    });
}

fn vertex(position: Vec3, normal: Vec3, color: [f32; 4]) -> Vertex {
    Vertex { position: position.map(|c| c as f32), normal: crate::vector::unit_or_zero(normal), color }
}

/// The triangles of a grid of vertices, row by row; counter-clockwise where columns go to the right and rows go up.
/// Columns close to a ring, rows only if `closed`.
fn grid(rows: u32, columns: u32, closed: bool) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(2 * (rows * columns) as usize);
    for row in 0..if closed { rows } else { rows - 1 } {
        for column in 0..columns {
            let at = |r: u32, c: u32| (r % rows) * columns + c % columns;
            let [a, b, c, d] = [at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{area_vector_x2, dot, length, sub, widen};

    #[test]
    fn demo_size() {
        let triangles: usize = demo().objects.iter().map(|o| o.triangles.len()).sum();
        assert!((100_000..120_000).contains(&triangles), "{triangles}");
    }

    #[test]
    fn demo_triangles_face_their_normals() {
        for object in &demo().objects {
            for &triangle in &object.triangles {
                let corners = triangle.map(|v| object.vertices[v as usize]);
                let [a, b, c] = corners.map(|v| widen(v.position));
                let area = area_vector_x2(a, b, c);
                assert!(length(area) > 0.0, "{}", object.name);
                for corner in corners {
                    let normal = widen(corner.normal);
                    assert!((length(normal) - 1.0).abs() < 1e-6, "{}", object.name);
                    // Half a step of the coarsest surface is 3 degrees; at a rim two rings meet.
                    assert!(dot(normal, area) > 0.9 * length(area), "{}: {corner:?}", object.name);
                }
            }
        }
    }

    /// Everything stands on the plinth's level top and touches nothing else.
    #[test]
    fn demo_stands() {
        let scene = demo();
        let lowest = |name: &str| {
            let object = scene.objects.iter().find(|o| &*o.name == name).unwrap();
            object.vertices.iter().fold(f32::INFINITY, |low, v| low.min(v.position[1]))
        };
        assert_eq!(lowest("knot"), 0.0);
        for (i, (name, _, [x, z], radius)) in BALLS.into_iter().enumerate() {
            let center = [x, radius, z];
            assert_eq!(lowest(name), 0.0);
            assert!((x * x + z * z).sqrt() < PLINTH_TOP, "{name}");
            for (other, _, [x, z], other_radius) in &BALLS[..i] {
                assert!(length(sub(center, [*x, *other_radius, *z])) > radius + other_radius + 0.02, "{name}, {other}");
            }
            for vertex in &scene.objects[0].vertices {
                assert!(length(sub(center, widen(vertex.position))) > radius + 0.02, "{name}");
            }
        }
        // The knot's own strands keep apart: points far from each other along it are farther than its tube is thick.
        let line = KNOT.center_line(300);
        for (i, a) in line.iter().enumerate() {
            for (j, b) in line.iter().enumerate().skip(i) {
                let along = (j - i).min(300 - (j - i));
                assert!(along < 30 || length(sub(*a, *b)) > 2.0 * KNOT.tube + 0.05, "{i} {j}");
            }
        }
    }

    #[test]
    fn demo_bits_are_the_same_everywhere() {
        let scene = demo();
        let numbers = scene
            .objects
            .iter()
            .flat_map(|o| &o.vertices)
            .flat_map(|v| [&v.position[..], &v.normal, &v.color].concat());
        let hash = numbers
            .fold(0xcbf2_9ce4_8422_2325u64, |hash, c| (hash ^ u64::from(c.to_bits())).wrapping_mul(0x0100_0000_01b3));
        assert_eq!(hash, 0xd46d_3389_2449_4b5e, "{hash:#x}");
    }
}
