//! Homogeneous coverage in pictures, and against clipping and projecting in exact arithmetic.

use pineda_oracle::cases::{Case, Family, Random};
use pineda_oracle::{Rational, Visible, coverage, picture, rational};

fn pixels(width: u32, height: u32) -> impl Iterator<Item = [i64; 2]> {
    (0..i64::from(height)).flat_map(move |j| (0..i64::from(width)).map(move |i| [i, j]))
}

#[track_caller]
fn check<const N: usize>(corners: [[f32; 4]; N], expected: [&str; 8]) {
    let visible = Visible::new(&corners, 8, 8).expect("finite");
    assert_eq!(picture(&visible.coverage(), 8).lines().collect::<Vec<_>>(), expected);
}

/// A road that starts in front of the eye and whose far end is behind it: z = w - near. Projected, its third corner would
/// be upside down, below the picture; what is seen is the road widening upwards until the near plane cuts it off.
fn road(near: f32) -> [[f32; 4]; 3] {
    [[-0.25, -1.0, 1.0], [0.25, -1.0, 1.0], [0.0, 3.0, -1.0]].map(|[x, y, w]| [x, y, w - near, w])
}

#[test]
fn behind_the_eye_is_not_seen() {
    let seen = ["..####..", "..####..", "..####..", "..####..", "...##...", "...##...", "...##...", "...##..."];
    check(road(0.25), seen);
    let [a, b, c] = road(0.25);
    check([c, b, a], seen);
    check([b, c, a], seen);
}

#[test]
fn near_plane_cuts_off() {
    // w >= 1/2 is reached at the middle of the picture.
    check(road(0.5), ["........", "........", "........", "........", "...##...", "...##...", "...##...", "...##..."]);
}

#[test]
fn far_plane_cuts_off() {
    // A wall with w = 1 whose depth grows from 0 at the left to 2 at the right; pixel centres at depth 1 would be visible.
    let wall = [[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 2.0, 1.0], [1.0, 1.0, 2.0, 1.0], [-1.0, 1.0, 0.0, 1.0]];
    check(wall, ["####...."; 8]);
    check(wall.map(|[x, y, z, w]| [x, y, z - 1.0, w]), ["....####"; 8]);
}

#[test]
fn edge_on_and_behind_cover_nothing() {
    check([[0.0, 0.0, 1.0, 1.0], [0.5, 0.5, 1.0, 2.0], [1.0, 1.0, 1.0, 3.0]], ["........"; 8]);
    let behind = [[-1.0, -1.0, 0.0, -1.0], [3.0, -1.0, 0.0, -1.0], [-1.0, 3.0, 0.0, -1.0]];
    check(behind, ["........"; 8]);
    check(behind.map(|corner| corner.map(|x| -x)), ["########"; 8]);
}

#[test]
fn not_finite_is_not_judged() {
    for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut corners = road(0.25);
        corners[1][2] = x;
        assert!(Visible::new(&corners, 8, 8).is_none());
    }
}

#[test]
fn margin_is_a_distance_in_pixels() {
    // A square from (2, 2) to (6, 6) px.
    let square = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(|[x, y]| [x, y, 0.5, 1.0]);
    let visible = Visible::new(&square, 8, 8).expect("finite");
    for ([i, j], margin) in
        [([2, 2], 0.5), ([3, 4], 1.5), ([5, 3], 0.5), ([1, 3], -0.5), ([3, 7], -1.5), ([0, 0], -1.5)]
    {
        assert_eq!(visible.margin([i, j]), margin, "({i}, {j})");
    }
    // A picture that is not square: its diagonal falls one pixel in two, and (4, 1) has its centre 3/4 px above.
    let half = [[-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]].map(|[x, y]| [x, y, 0.5, 1.0]);
    let visible = Visible::new(&half, 16, 8).expect("finite");
    let error = visible.margin([4, 1]) - 1.5 / 5f64.sqrt();
    assert!(error.abs() < 1e-15, "off by {error}");
    // The near plane is an edge too: depth grows from -1 to 1 over 8 px, so it cuts at x = 4 px.
    let wall = [[-1.0, -1.0, -1.0, 1.0], [1.0, -1.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0], [-1.0, 1.0, -1.0, 1.0]];
    let visible = Visible::new(&wall, 8, 8).expect("finite");
    assert_eq!([3, 4, 5].map(|i| visible.margin([i, 4])), [-0.5, 0.5, 1.5]);
    // Edge-on: the distance from the line that it is seen as.
    let line =
        Visible::new(&[[0.0, -1.0, 0.5, 1.0], [0.0, 1.0, 0.5, 1.0], [0.0, 0.0, 0.5, 2.0]], 8, 8).expect("finite");
    assert_eq!([3, 4, 7].map(|i| line.margin([i, 0])), [-0.5, -0.5, -3.5]);
    // Two of its corners seen at one place: still that line. All three: nothing is known.
    let (a, b) = ([0.0, -1.0, 0.5, 1.0], [0.0, 1.0, 0.5, 1.0]);
    let line = Visible::new(&[a, b, b.map(|x| 2.0 * x)], 8, 8).expect("finite");
    assert_eq!([3, 4, 7].map(|i| line.margin([i, 0])), [-0.5, -0.5, -3.5]);
    let point = Visible::new(&[a, a, a.map(|x| 2.0 * x)], 8, 8).expect("finite");
    assert_eq!(point.margin([7, 0]), 0.0);
}

#[test]
fn disagreements_come_with_their_margin() {
    let visible = Visible::new(&road(0.5), 8, 8).expect("finite");
    let mut covered = visible.coverage();
    assert_eq!(visible.disagreements(&covered), []);
    covered[8 * 3 + 3] = true; // half a pixel above the near plane's edge
    covered[8 * 7 + 4] = false; // in the lowest row the road reaches from 2.97 to 5.03 px
    let found: Vec<_> = visible.disagreements(&covered);
    assert_eq!(found.iter().map(|(pixel, _)| *pixel).collect::<Vec<_>>(), [[3, 3], [4, 7]]);
    assert_eq!(found[0].1, -0.5);
    assert!((0.5..0.54).contains(&found[1].1), "{found:?}");
}

/// Where snapping changes nothing, the exact homogeneous answer is that for the snapped triangle: fill rule included.
#[test]
fn on_the_grid_it_agrees_with_snapped_coverage() {
    let mut random = Random::new(3);
    for _ in 0..3_000 {
        // Corners on half pixels around a picture of 16 x 8: many centres are on edges.
        let points = [0; 3].map(|_| [128 * random.between(-4, 36), 128 * random.between(-4, 20)]);
        let clip = points.map(|[x, y]| {
            let w = random.pick(&[0.5, 1.0, 3.0, 7.0]);
            [(x as f32 / 2048.0 - 1.0) * w, (1.0 - y as f32 / 1024.0) * w, 0.25 * w, w]
        });
        let visible = Visible::new(&clip, 16, 8).expect("finite");
        assert_eq!(picture(&visible.coverage(), 16), picture(&coverage(points, 16, 8), 16), "{points:?} {clip:?}");
    }
}

/// The usual road, in rationals: clip against near and far, project each corner, see whether the centre is in the polygon.
#[test]
fn clipping_exactly_gives_the_same() {
    let families = [
        (Family::InFront, 60),
        (Family::NearPlane, 120),
        (Family::FarPlane, 60),
        (Family::Homogeneous, 120),
        (Family::OnPlanes, 120),
        (Family::BeyondGuardBand, 60),
    ];
    let (mut compared, mut inside) = (0, 0);
    for case in families.into_iter().flat_map(|(family, count)| (0..count).map(move |n| Case::of_family(family, n))) {
        let corners = case.corners().next().expect("one triangle");
        let visible = Visible::new(&corners, case.width, case.height).expect("finite");
        let Some(outline) = clipped_and_projected(&corners, case.width, case.height) else { continue };
        for pixel in pixels(case.width, case.height).filter(|[i, j]| (i + j) % 3 == 0) {
            // On an edge that clipping made, the fill rule of the polygon and the visible part's may differ.
            if visible.margin(pixel) != 0.0 {
                let covered = visible.covers(pixel);
                assert_eq!(covered, is_inside(&outline, pixel), "{pixel:?} {case}");
                assert_eq!(covered, visible.margin(pixel) > 0.0, "{pixel:?} {case}");
                (compared, inside) = (compared + 1, inside + u32::from(covered));
            }
        }
    }
    assert!(compared > 100_000 && inside > 10_000, "{compared} pixels compared, {inside} inside");
}

/// Sutherland and Hodgman's clipping. `None` if a corner is left in the plane of the eye: there is no place for it.
fn clipped_and_projected(corners: &[[f32; 4]], width: u32, height: u32) -> Option<Vec<[Rational; 2]>> {
    let mut polygon: Vec<[Rational; 4]> =
        corners.iter().map(|corner| corner.map(|x| rational(x).expect("finite"))).collect();
    let near = |[_, _, z, _]: &[Rational; 4]| z.clone();
    let far = |[_, _, z, w]: &[Rational; 4]| w - z;
    for depth in [near, far] {
        let mut kept = Vec::new();
        for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
            let (depth_a, depth_b) = (depth(a), depth(b));
            if depth_a >= Rational::ZERO {
                kept.push(a.clone());
            }
            if (depth_a < Rational::ZERO) != (depth_b < Rational::ZERO) {
                let t = &depth_a / (&depth_a - &depth_b);
                kept.push([0, 1, 2, 3].map(|axis| &a[axis] + &t * (&b[axis] - &a[axis])));
            }
        }
        polygon = kept;
    }
    let half = |size: u32| Rational::from(size) / Rational::from(2);
    polygon
        .into_iter()
        .map(|[x, y, _, w]| {
            let projected =
                |w: Rational| [(x / &w + Rational::ONE) * half(width), (Rational::ONE - y / w) * half(height)];
            (!w.is_zero()).then(|| projected(w))
        })
        .collect()
}

fn is_inside(outline: &[[Rational; 2]], [i, j]: [i64; 2]) -> bool {
    let [x, y] = [i, j].map(|k| Rational::from(2 * k + 1) / Rational::from(2));
    let crosses = |(a, b): &(&[Rational; 2], &[Rational; 2])| {
        (a[1] <= y) != (b[1] <= y) && &a[0] + (&b[0] - &a[0]) * (&y - &a[1]) / (&b[1] - &a[1]) <= x
    };
    outline.iter().zip(outline.iter().cycle().skip(1)).filter(crosses).count() % 2 == 1
}
