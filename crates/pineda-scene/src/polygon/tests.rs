use super::flatten::{Point, area_x2};
use super::*;
use crate::Limits;

/// The triangles of one polygon in the plane z = 0.
fn cut(points: &[[i32; 2]]) -> Vec<[usize; 3]> {
    let mut polygons = Polygons::default();
    polygons.push(0..points.len());
    let position = |i: usize| [points[i][0] as f32, points[i][1] as f32, 0.0];
    let mut budget = Budget::new(&Limits::default(), 1 << 20).unwrap();
    let (triangles, gave_up) = polygons.triangulate(position, &mut budget).unwrap();
    assert_eq!(gave_up, 0);
    triangles
}

fn areas(points: &[[i32; 2]], triangles: &[[usize; 3]]) -> Vec<f64> {
    let point = |i: usize| -> Point { points[i].map(f64::from) };
    triangles.iter().map(|t| area_x2(point(t[0]), point(t[1]), point(t[2]))).collect()
}

fn polygon_area(points: &[[i32; 2]]) -> f64 {
    let fan: Vec<_> = (1..points.len() - 1).map(|i| [0, i, i + 1]).collect();
    areas(points, &fan).iter().sum()
}

/// n - 2 triangles that all turn as the polygon does, use every corner, and fill it without overlap.
fn check(points: &[[i32; 2]]) {
    let triangles = cut(points);
    let areas = areas(points, &triangles);
    let area = polygon_area(points);
    assert_eq!(triangles.len(), points.len() - 2, "{points:?}");
    assert!(areas.iter().all(|a| a * area > 0.0), "{points:?}: {triangles:?}");
    assert_eq!(areas.iter().sum::<f64>(), area, "{points:?}: {triangles:?}");
    for corner in 0..points.len() {
        assert!(triangles.iter().flatten().any(|&i| i == corner), "{points:?}: corner {corner} is in no triangle");
    }
}

/// Both windings, all rotations.
fn check_all(points: &[[i32; 2]]) {
    let mut points = points.to_vec();
    for _ in 0..2 {
        for _ in 0..points.len() {
            check(&points);
            points.rotate_left(1);
        }
        points.reverse();
    }
}

#[test]
fn polygon_convex_is_a_fan() {
    assert_eq!(cut(&[[0, 0], [4, 0], [4, 4], [0, 4]]), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(cut(&[[0, 4], [4, 4], [4, 0], [0, 0]]), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(cut(&[[0, 0], [2, 0], [3, 1], [2, 2], [0, 2]]), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
}

#[test]
fn polygon_concave() {
    check_all(&[[0, 0], [8, 0], [2, 2], [0, 8]]);
    check_all(&[[0, 0], [6, 0], [6, 6], [4, 6], [4, 2], [2, 2], [2, 6], [0, 6]]);
    // A spiral.
    check_all(&[
        [0, 0],
        [9, 0],
        [9, 9],
        [2, 9],
        [2, 4],
        [5, 4],
        [5, 6],
        [4, 6],
        [4, 5],
        [3, 5],
        [3, 8],
        [8, 8],
        [8, 1],
        [0, 1],
    ]);
}

#[test]
fn polygon_with_corners_on_straight_edges() {
    check_all(&[[0, 0], [2, 0], [4, 0], [4, 4], [0, 4]]);
    check_all(&[[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [4, 4], [2, 4], [0, 4], [0, 1]]);
    check_all(&[[0, 0], [2, 0], [4, 0], [2, 2], [0, 4], [0, 2]]);
}

#[test]
fn polygon_with_a_hole_by_a_bridge() {
    // Outer square, then over a bridge around the inner one clockwise, and back.
    let ring = [[0, 0], [9, 0], [9, 9], [0, 9], [0, 0], [3, 3], [3, 6], [6, 6], [6, 3], [3, 3]];
    check_all(&ring);
}

#[test]
fn polygon_star_and_comb() {
    let comb: Vec<_> = (0..40).map(|i| [i, if i % 2 == 0 { 0 } else { 20 }]).chain([[39, -9], [0, -9]]).collect();
    check_all(&comb);
    let star: Vec<_> = (0..64)
        .map(|i| {
            let (radius, angle) =
                (if i % 2 == 0 { 100_000.0 } else { 20_000.0 }, f64::from(i) / 64.0 * std::f64::consts::TAU);
            [(radius * libm::cos(angle)) as i32, (radius * libm::sin(angle)) as i32]
        })
        .collect();
    check_all(&star);
}

#[test]
fn polygon_pentagram_is_not_taken_for_convex() {
    // Every corner turns left, but it goes around twice: a fan would be wrong, and so would an endless search.
    let pentagram = [[0, 10], [-6, -8], [10, 3], [-10, 3], [6, -8]];
    assert_eq!(cut(&pentagram).len(), 3);
}

#[test]
fn polygon_that_crosses_itself_or_has_no_area_still_gives_its_triangles() {
    assert_eq!(cut(&[[0, 0], [4, 4], [4, 0], [0, 4]]).len(), 2);
    assert_eq!(cut(&[[0, 0], [1, 1], [2, 2], [3, 3], [1, 1]]).len(), 3);
    assert_eq!(cut(&[[5, 5]; 7]).len(), 5);
    assert_eq!(cut(&[[0, 0], [0, 0], [4, 0], [4, 4], [4, 4], [0, 4]]).len(), 4);
    let zigzag: Vec<_> = (0..50).map(|i: i32| [(i * 37) % 11, (i * 53) % 13]).collect();
    assert_eq!(cut(&zigzag).len(), 48);
}

#[test]
fn polygon_planes_other_than_z() {
    // The concave arrowhead of above in every axis plane, both ways around, and askew.
    let flat = [[0.0, 0.0], [8.0, 0.0], [2.0, 2.0], [0.0, 8.0f32]];
    let planes: [fn([f32; 2]) -> [f32; 3]; 7] = [
        |[x, y]| [x, y, 5.0],
        |[x, y]| [y, x, 5.0],
        |[x, y]| [5.0, x, y],
        |[x, y]| [5.0, y, x],
        |[x, y]| [x, 5.0, y],
        |[x, y]| [y, 5.0, x],
        |[x, y]| [x + y, x - 2.0 * y, 1000.0 - x],
    ];
    for plane in planes {
        let mut polygons = Polygons::default();
        polygons.push(0..4usize);
        let mut budget = Budget::new(&Limits::default(), 0).unwrap();
        let (triangles, _) = polygons.triangulate(|i| plane(flat[i]), &mut budget).unwrap();
        // The only right cut is along 0 - 2, as the corners 1 and 3 do not see each other.
        for triangle in triangles {
            assert!(triangle.contains(&0) && triangle.contains(&2), "{triangle:?}");
        }
    }
}

#[test]
fn polygon_random_ones_are_filled_exactly() {
    // Star-shaped polygons: sorted by angle around the origin, at random radii.
    let mut state = 1u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    for case in 0..300 {
        let n = 5 + case % 60;
        let points: Vec<_> = (0..n)
            .map(|i| {
                let angle = (f64::from(i) + 0.8 * random()) / f64::from(n) * std::f64::consts::TAU;
                let radius = 1e5 * (0.05 + random());
                [(radius * libm::cos(angle)) as i32, (radius * libm::sin(angle)) as i32]
            })
            .collect();
        check(&points);
    }
}

#[test]
fn polygon_of_a_hundred_thousand_corners_is_quick() {
    let n = 100_000;
    let teeth: Vec<_> = (0..n).map(|i| [i, (i % 2) * 1000 + (i % 7)]).chain([[n - 1, -9], [0, -9]]).collect();
    check(&teeth);
}

#[test]
fn polygon_steps_run_out_in_a_fan() {
    let comb: Vec<_> = (0..400).map(|i| [i, if i % 2 == 0 { 0 } else { 20 }]).chain([[399, -9], [0, -9]]).collect();
    let mut polygons = Polygons::default();
    polygons.push(0..comb.len());
    let mut budget = Budget::new(&Limits::default(), 1 << 20).unwrap();
    budget.polygon_steps = 100;
    let position = |i: usize| [comb[i][0] as f32, comb[i][1] as f32, 0.0];
    let (triangles, gave_up) = polygons.triangulate(position, &mut budget).unwrap();
    assert_eq!((triangles.len(), gave_up), (400, 1));
}

#[test]
fn polygons_too_small_are_counted() {
    let mut polygons = Polygons::default();
    polygons.push([1, 2]);
    polygons.push([1, 2, 3]);
    polygons.push([]);
    polygons.push([4, 5, 6, 7]);
    assert_eq!((polygons.too_small, polygons.corners().len()), (2, 7));
    assert_eq!([0, 2, 3, 6].map(|at| polygons.polygon_of_corner(at)), [0, 0, 1, 1]);
}
