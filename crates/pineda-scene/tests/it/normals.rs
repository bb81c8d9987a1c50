use pineda_scene::{Format, Normals, Object, flat_normals, smooth_normals};

use crate::{corners, only, read};

fn object(obj: &str) -> Object {
    only(&read(Format::Obj, obj).unwrap()).clone()
}

fn cube() -> Object {
    object(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
         f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n",
    )
}

/// An open tube of unit radius and `n` sides.
fn tube(n: usize) -> Object {
    let mut text = String::new();
    for i in 0..n {
        let angle = i as f64 / n as f64 * std::f64::consts::TAU;
        let (x, y) = (libm::cos(angle), libm::sin(angle));
        text += &format!("v {x} {y} 0\nv {x} {y} 1\n");
    }
    for i in 0..n {
        let j = (i + 1) % n;
        text += &format!("f {} {} {} {}\n", 2 * i + 1, 2 * j + 1, 2 * j + 2, 2 * i + 2);
    }
    object(&text)
}

fn normal_lengths_are_one(object: &Object) {
    for vertex in &object.vertices {
        let squared: f64 = vertex.normal.iter().map(|&c| f64::from(c) * f64::from(c)).sum();
        assert!((squared - 1.0).abs() < 1e-6, "{:?}", vertex.normal);
    }
}

#[test]
fn normals_flat_gives_each_triangle_its_own() {
    let mut cube = cube();
    let before = corners(&cube);
    flat_normals(&mut cube);
    assert_eq!((cube.vertices.len(), cube.normals), (36, Normals::Flat));
    assert_eq!(corners(&cube), before);
    assert!(cube.triangles[..2].iter().flatten().all(|&v| cube.vertices[v as usize].normal == [0.0, 0.0, -1.0]));
    assert!(cube.triangles[8..10].iter().flatten().all(|&v| cube.vertices[v as usize].normal == [1.0, 0.0, 0.0]));
}

#[test]
fn normals_smooth_keeps_a_cube_sharp() {
    let mut cube = cube();
    let before = corners(&cube);
    smooth_normals(&mut cube, 40.0);
    assert_eq!((cube.vertices.len(), cube.normals), (24, Normals::Smooth));
    assert_eq!(corners(&cube), before);
    assert!(cube.vertices.iter().all(|v| v.normal.iter().filter(|c| **c == 0.0).count() == 2));
}

#[test]
fn normals_smooth_without_creases_weighs_by_angle() {
    // Each corner of a cube is in three faces that are cut into one or two triangles: the weights hide that.
    let mut cube = cube();
    smooth_normals(&mut cube, 180.0);
    assert_eq!(cube.vertices.len(), 8);
    for vertex in &cube.vertices {
        let diagonal = vertex.position.map(|c| if c == 0.0 { -(1.0f32 / 3.0).sqrt() } else { (1.0f32 / 3.0).sqrt() });
        assert!(vertex.normal.iter().zip(diagonal).all(|(n, d)| (n - d).abs() < 1e-6), "{vertex:?}");
    }
}

#[test]
fn normals_smooth_rounds_a_tube() {
    let mut tube = tube(24);
    smooth_normals(&mut tube, 30.0);
    assert_eq!(tube.vertices.len(), 48);
    for vertex in &tube.vertices {
        for axis in 0..2 {
            assert!((vertex.normal[axis] - vertex.position[axis]).abs() < 1e-6, "{vertex:?}");
        }
    }
    // 15 degrees a side: sharp below that.
    let mut sharp = self::tube(24);
    smooth_normals(&mut sharp, 14.0);
    assert_eq!(sharp.vertices.len(), 96);
}

#[test]
fn normals_smooth_welds_a_soup() {
    let mut soup = tube(24);
    flat_normals(&mut soup);
    smooth_normals(&mut soup, 30.0);
    let mut shared = tube(24);
    smooth_normals(&mut shared, 30.0);
    assert_eq!(corners(&soup), corners(&shared));
    assert_eq!(soup.vertices.len(), 48);
    let normals = |object: &Object| -> Vec<_> {
        object.triangles.iter().flatten().map(|&v| object.vertices[v as usize].normal.map(f32::to_bits)).collect()
    };
    assert_eq!(normals(&soup), normals(&shared));
}

#[test]
fn normals_smooth_keeps_colours_apart() {
    let mut two = object(
        "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 0 0 0 1\nv 0 1 0 0 0 1\nv -1 0 0 0 0 1\nf 1 2 3\nf 4 5 6\n",
    );
    smooth_normals(&mut two, 40.0);
    assert_eq!(two.vertices.len(), 6);
    assert!(two.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]));
}

#[test]
fn normals_of_faces_without_area_are_finite() {
    let text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 3 3 3\n";
    for crease in [0.0, 40.0, 180.0, f64::NAN] {
        let mut object = object(text);
        smooth_normals(&mut object, crease);
        normal_lengths_are_one(&object);
        assert_eq!(object.triangles.len(), 3);
    }
    let mut object = object(text);
    flat_normals(&mut object);
    normal_lengths_are_one(&object);
}

#[test]
fn normals_of_very_small_and_very_large_objects() {
    for scale in ["e-38", "e37"] {
        let mut object = object(&format!("v 0 0 0\nv 1{scale} 0 0\nv 0 2{scale} 0\nf 1 2 3\n"));
        smooth_normals(&mut object, 40.0);
        assert!(object.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]));
    }
}

/// A cone with so many sides that directions at its tip are gathered: the result must hardly differ, and the time must
/// not grow with the square.
#[test]
fn normals_at_a_place_with_very_many_corners() {
    let n = 60_000;
    let mut text = String::from("v 0 0 1\n");
    for i in 0..n {
        let angle = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        text += &format!("v {} {} 0\n", libm::cos(angle), libm::sin(angle));
    }
    for i in 0..n {
        text += &format!("f 1 {} {}\n", i + 2, (i + 1) % n + 2);
    }
    let mut cone = object(&text);
    smooth_normals(&mut cone, 30.0);
    normal_lengths_are_one(&cone);
    for triangle in &cone.triangles {
        let [tip, rim] = [triangle[0], triangle[1]].map(|v| cone.vertices[v as usize].normal);
        let cos: f32 = (0..3).map(|axis| tip[axis] * rim[axis]).sum();
        assert!(cos > 0.98, "{tip:?} {rim:?}");
    }
}

#[test]
fn normals_bits_are_the_same_everywhere() {
    let mut tube = tube(7);
    smooth_normals(&mut tube, 60.0);
    let hash = tube
        .vertices
        .iter()
        .flat_map(|v| v.normal)
        .fold(0xcbf2_9ce4_8422_2325u64, |hash, c| (hash ^ u64::from(c.to_bits())).wrapping_mul(0x0100_0000_01b3));
    assert_eq!(hash, 0xd963_5427_2b08_50c3, "{hash:#x}");
}
