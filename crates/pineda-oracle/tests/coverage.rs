//! The top-left rule in pictures, and the oracle's two definitions of coverage against each other.

use pineda_oracle::cases::{Case, Space, orders};
use pineda_oracle::{
    Point, Triangle, Winding, coverage, covered_exactly_once, covers, hits, picture, polygon_coverage, winding,
};

/// Corners in half pixels: a corner of two odd numbers is on a pixel centre.
fn halves<const N: usize>(corners: [[i64; 2]; N]) -> [Point; N] {
    corners.map(|corner| corner.map(|x| 128 * x))
}

/// Every order of the corners covers the same.
#[track_caller]
fn check(triangle: Triangle, expected: [&str; 6]) {
    for order in orders([0, 1, 2]) {
        let turned = order.map(|k| triangle[k as usize]);
        let found = picture(&coverage(turned, 6, 6), 6);
        assert_eq!(found.lines().collect::<Vec<_>>(), expected, "{turned:?}");
    }
}

#[test]
fn top_left_keeps_top_and_left_edges() {
    // Legs through the centres of row 0 and column 0; no centre is on the long side.
    check(halves([[1, 1], [10, 1], [1, 10]]), ["#####.", "####..", "###...", "##....", "#.....", "......"]);
}

#[test]
fn top_left_gives_away_bottom_and_right_edges() {
    // Legs through the centres of row 5 and column 5; the long side is a left edge with centres on it.
    check(halves([[11, 1], [11, 11], [1, 11]]), ["......", "....#.", "...##.", "..###.", ".####.", "......"]);
}

#[test]
fn top_left_at_corners_needs_both_edges() {
    // A diamond with corners on centres, cut down the middle. Only the left corner is between two left edges.
    let [top, right, bottom, left] = halves([[5, 1], [9, 5], [5, 9], [1, 5]]);
    check([top, bottom, left], ["......", ".#....", "##....", ".#....", "......", "......"]);
    check([top, bottom, right], ["......", "..#...", "..##..", "..#...", "......", "......"]);
}

#[test]
fn top_left_on_a_fan_around_a_centre() {
    // Eight triangles meet on the centre of (2, 2): their spokes pass through many centres, each owned by one triangle.
    let hub = halves([[5, 5]])[0];
    let rim = halves([[1, 1], [5, 1], [9, 1], [9, 5], [9, 9], [5, 9], [1, 9], [1, 5]]);
    let fan: Vec<_> = (0..8).map(|k| [hub, rim[k], rim[(k + 1) % 8]]).collect();
    let counts = hits(&fan, 6, 6);
    assert_eq!(picture(&counts, 6), "####..\n####..\n####..\n####..\n......\n......\n");
    assert_eq!(covered_exactly_once(&counts, &polygon_coverage(&rim, 6, 6), 6), Ok(()));
    let owners: Vec<_> = (0..8).filter(|&k| covers(fan[k], [2, 2])).collect();
    assert_eq!(
        owners,
        [3],
        "the hub belongs to the triangle below and to the right of it: between a top and a left edge"
    );
}

#[test]
fn degenerate_triangles_cover_nothing() {
    for line in [[[1, 1], [5, 5], [9, 9]], [[1, 1], [1, 1], [9, 5]], [[3, 3], [3, 3], [3, 3]], [[1, 3], [5, 3], [9, 3]]]
    {
        check(halves(line), ["......"; 6]);
        assert_eq!(winding(halves(line)), Winding::Degenerate);
    }
}

#[test]
fn winding_is_seen_with_y_down() {
    assert_eq!(winding(halves([[0, 0], [0, 2], [2, 2]])), Winding::CounterClockwise);
    assert_eq!(winding(halves([[0, 0], [2, 2], [0, 2]])), Winding::Clockwise);
}

#[test]
fn one_subpixel_decides() {
    // The left edge of a triangle 1/256 px to the left of a column of centres, on it, and 1/256 px to the right.
    let column = |x: i64| picture(&coverage([[x, 0], [x, 768], [800, 384]], 4, 3), 4);
    assert_eq!(column(383), ".#..\n.##.\n.#..\n");
    assert_eq!(column(384), ".#..\n.##.\n.#..\n");
    assert_eq!(column(385), "....\n..#.\n....\n");
}

#[test]
fn miscounts_are_named() {
    let twice = [0, 1, 2, 1];
    let error = covered_exactly_once(&twice, &[false, true, true, true], 2).unwrap_err();
    assert_eq!(error, "pixel (0, 1) is hit 2 times instead of 1");
    let gap = covered_exactly_once(&[1, 0], &[true, true], 2).unwrap_err();
    assert_eq!(gap, "pixel (1, 0) is hit 0 times instead of 1");
}

/// [`covers`] asks what kind of edge a centre is on, [`polygon_coverage`] moves the centre and counts crossings.
#[test]
fn both_definitions_agree() {
    let mut compared = 0;
    for case in (0..40_000).map(Case::from_seed).filter(|case| case.space == Space::Raster) {
        for triangle in case.snapped().into_iter().take(4) {
            let by_rule = coverage(triangle, case.width, case.height);
            let by_crossings = polygon_coverage(&triangle, case.width, case.height);
            // A triangle without area has an outline that no moved point is inside of, either.
            assert!(by_rule == by_crossings, "{case}");
            compared += 1;
        }
    }
    assert!(compared > 40_000);
}

#[test]
fn order_of_corners_does_not_matter() {
    for case in (0..4_000).map(Case::from_seed).filter(|case| case.space == Space::Raster) {
        for triangle in case.snapped().into_iter().take(2) {
            let expected = coverage(triangle, case.width, case.height);
            for order in orders([0, 1, 2]) {
                let turned = order.map(|k| triangle[k as usize]);
                assert!(coverage(turned, case.width, case.height) == expected, "{case}");
            }
        }
    }
}
