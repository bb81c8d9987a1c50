//! What is touched and what is covered whole, in pictures, and against exact areas.

#![allow(missing_docs, reason = "a test")]

use pineda_oracle::cases::{Case, Space, orders};
use pineda_oracle::{
    Rational, Triangle, Winding, contains, covered_area, covers, covers_whole, picture, touches, winding,
};

fn drawn(triangle: Triangle, covers: fn(Triangle, [i64; 2]) -> bool) -> String {
    let pixels = (0..4).flat_map(|j| (0..6).map(move |i| [i, j]));
    picture(&pixels.map(|pixel| covers(triangle, pixel)).collect::<Vec<_>>(), 6)
}

#[test]
fn borders_and_corners_are_touched() {
    // Corners on corners of pixels, legs along borders, the long side through corners.
    let triangle = [[256, 256], [768, 256], [256, 768]];
    assert_eq!(drawn(triangle, touches), "####..\n####..\n###...\n##....\n");
    assert_eq!(drawn(triangle, covers_whole), "......\n.#....\n......\n......\n");
    // Within a pixel, and away from its borders.
    let triangle = [[300, 300], [500, 310], [310, 500]];
    assert_eq!(drawn(triangle, touches), "......\n.#....\n......\n......\n");
    assert_eq!(drawn(triangle, covers_whole), "......\n......\n......\n......\n");
    // One corner reaches the corner of four pixels, and no further.
    let triangle = [[512, 512], [300, 500], [500, 300]];
    assert_eq!(drawn(triangle, touches), "......\n.##...\n.##...\n......\n");
}

#[test]
fn without_area_there_is_nothing() {
    for triangle in [[[0, 0], [700, 700], [300, 300]], [[256, 256]; 3], [[0, 256], [900, 256], [100, 256]]] {
        assert!(!drawn(triangle, touches).contains('#'));
        assert!(!drawn(triangle, covers_whole).contains('#'));
    }
}

#[test]
fn exact_areas_say_the_same() {
    let mut checked = [0; 3];
    for seed in 0..1_200 {
        let case = Case::from_seed(seed);
        if case.space != Space::Raster || case.triangles.len() != 1 {
            continue;
        }
        for triangle in case.snapped().into_iter().filter(|&t| winding(t) != Winding::Degenerate) {
            let [a, b, c] = triangle;
            let clockwise = if winding(triangle) == Winding::Clockwise { [a, b, c] } else { [a, c, b] };
            let turned = orders([0, 1, 2])[seed as usize % 6].map(|k| triangle[k as usize]);
            for pixel in (0..12).flat_map(|j| (0..12).map(move |i| [i, j])) {
                let area = covered_area(&clockwise, pixel);
                let (touched, whole) = (touches(turned, pixel), covers_whole(turned, pixel));
                assert!(touched || area == Rational::ZERO, "seed {seed}, {pixel:?}");
                assert_eq!(whole, area == Rational::ONE, "seed {seed}, {pixel:?}");
                assert!(touched || !covers(triangle, pixel), "seed {seed}, {pixel:?}");
                assert!(covers(triangle, pixel) || !whole, "seed {seed}, {pixel:?}");
                checked[0] += i32::from(whole);
                checked[1] += i32::from(touched && !whole);
                // Touched from outside: then a corner or an edge of one lies on the other's border.
                checked[2] += i32::from(touched && area == Rational::ZERO);
            }
            assert!(triangle.iter().all(|&corner| contains(triangle, corner)));
        }
    }
    assert!(checked.iter().all(|&count| count > 20), "{checked:?}");
}
