//! Snapping, projection and interpolation against values worked out by hand, and by another road.

use pineda_oracle::cases::{Case, Family, Random, Space};
use pineda_oracle::{
    Rational, barycentrics, clip_space_barycentrics, covers, error, error_in_ulps, interpolate, perspective,
    project_exact, project_snapped, rational, snap, snap_exact, snap_unambiguous, snapped_within,
};

fn ratio(numerator: i64, denominator: u32) -> Rational {
    Rational::from_parts(numerator.into(), denominator.into())
}

#[test]
fn snap_rounds_ties_to_even() {
    // Halves of 1/256 pixel.
    for (halves, snapped) in [(0, 0), (1, 0), (2, 1), (3, 2), (5, 2), (7, 4), (-1, 0), (-3, -2), (-5, -2), (-7, -4)] {
        assert_eq!(snap(f64::from(halves) / 512.0), Some(snapped), "{halves}/512 px");
        assert_eq!(snap_exact(&ratio(halves.into(), 512)), snapped.into(), "{halves}/512 px");
    }
    // One bit to either side of a tie.
    assert_eq!(snap((1.5f64 / 256.0).next_down()), Some(1));
    assert_eq!(snap((2.5f64 / 256.0).next_up()), Some(3));
}

#[test]
fn snap_takes_every_float_in_range() {
    assert_eq!(snap(f64::from(f32::MIN_POSITIVE)), Some(0));
    assert_eq!(snap(f64::from_bits(1)), Some(0));
    assert_eq!(snap(-0.0), Some(0));
    assert_eq!(snap(32768.0), Some(1 << 23));
    assert_eq!(snap(2f64.powi(48).next_down()), Some((1 << 56) - 8));
    for outside in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 2f64.powi(48), -2f64.powi(48), f64::MAX] {
        assert_eq!(snap(outside), None, "{outside}");
    }
}

#[test]
fn snap_agrees_with_rationals() {
    let mut random = Random::new(1);
    for _ in 0..20_000 {
        let x = f64::from(random.sign()) * f64::from(random.magnitude(-20, 20)) * (1.0 + f64::from(random.unit()));
        let exact = Rational::try_from(x).expect("finite");
        assert_eq!(snap(x).map(Into::into), Some(snap_exact(&exact)), "{x:e}");
    }
}

#[test]
fn snap_tolerance_matters_only_next_to_a_tie() {
    let (tie, beside) = (ratio(3, 512), ratio(3, 512) + ratio(1, 1 << 20));
    assert_eq!(snap_unambiguous(&tie, 1e-6), None);
    assert_eq!(snap_unambiguous(&beside, 1e-6), None);
    assert_eq!(snap_unambiguous(&beside, 1e-7), Some(2));
    for (candidate, possible) in [(0, false), (1, true), (2, true), (3, false)] {
        assert_eq!(snapped_within(candidate, &beside, 1e-6), possible, "{candidate}");
        assert_eq!(snapped_within(candidate, &beside, 0.0), candidate == 2, "{candidate}");
    }
}

#[test]
fn projection_is_exact() {
    // 1/3 and -2/3 of the way from the centre of a 40 x 30 picture to its border; y up becomes y down.
    let corner = [1.0, -2.0, 0.0, 3.0];
    assert_eq!(project_exact(corner, 40, 30), Some([ratio(80, 3), ratio(25, 1)]));
    assert_eq!(project_snapped(corner, 40, 30, 1e-6), Some([6827, 6400])); // 6826.67 subpixels
    // Behind the eye the same place is met by the opposite ray.
    assert_eq!(project_exact(corner.map(|x| -x), 40, 30), Some([ratio(80, 3), ratio(25, 1)]));
    assert_eq!(project_exact([1.0, 1.0, 1.0, 0.0], 40, 30), None);
    assert_eq!(project_exact([f32::NAN, 1.0, 1.0, 1.0], 40, 30), None);
    // The depth has no say in it.
    assert!(project_exact([1.0, 1.0, f32::NAN, 1.0], 40, 30).is_some());
}

#[test]
fn projection_in_f64_snaps_alike() {
    // The rasterizer's own formula stays within 2^-20 px for everything near the picture.
    let mut compared = 0;
    for case in (0..2_000).map(|n| Case::of_family(Family::InFront, n)) {
        for corner in case.corners().flatten() {
            let [x, y, _, w] = corner.map(f64::from);
            let (half_width, half_height, r) = (f64::from(case.width) / 2.0, f64::from(case.height) / 2.0, 1.0 / w);
            let floats = [x * r * half_width + half_width, half_height - y * r * half_height];
            if let Some(exact) = project_snapped(corner, case.width, case.height, 2f64.powi(-20)) {
                assert_eq!(floats.map(snap), exact.map(Some), "{case}");
                compared += 1;
            }
        }
    }
    assert!(compared > 5_900, "{compared} of 6000 corners are away from ties");
}

#[test]
fn barycentrics_by_hand() {
    let triangle = [[0, 0], [0, 1024], [1024, 0]]; // 4 px legs
    assert_eq!(barycentrics(triangle, [0, 0]), Some([ratio(3, 4), ratio(1, 8), ratio(1, 8)]));
    let [a, b, c] = triangle;
    assert_eq!(barycentrics([a, c, b], [1, 0]), Some([ratio(1, 2), ratio(3, 8), ratio(1, 8)]));
    // Extrapolated outside.
    assert_eq!(barycentrics(triangle, [4, 0]), Some([ratio(-1, 4), ratio(1, 8), ratio(9, 8)]));
    assert_eq!(barycentrics([a, b, b], [0, 0]), None);
}

#[test]
fn perspective_by_hand() {
    // Halfway in the picture between w = 1 and w = 3 is a quarter of the way along the edge.
    let middle = [ratio(1, 2), ratio(1, 2), ratio(0, 1)];
    let weights = perspective(&middle, [1.0, 3.0, 1.0]).expect("positive w");
    assert_eq!(weights, [ratio(3, 4), ratio(1, 4), ratio(0, 1)]);
    assert_eq!(interpolate(&weights, [10.0, 20.0, 30.0]), Some(ratio(25, 2)));
    assert_eq!(perspective(&middle, [0.0, 3.0, 1.0]), None);
    assert_eq!(perspective(&middle, [f32::INFINITY, 3.0, 1.0]), None);
    assert_eq!(perspective(&middle, [1.0, -1.0, 1.0]), None, "on the vanishing line");
    assert_eq!(interpolate(&weights, [10.0, f32::NAN, 30.0]), None);
}

#[test]
fn weights_sum_to_one_and_are_positive_inside() {
    for case in (0..400).map(Case::from_seed).filter(|case| case.space == Space::Raster && case.dropped() == 0) {
        for (triangle, corners) in case.snapped().into_iter().zip(case.corners()).take(2) {
            for pixel in [[0, 0], [1, 3], [-7, 1000]] {
                let Some(lambda) = barycentrics(triangle, pixel) else { continue };
                assert_eq!(&lambda[0] + &lambda[1] + &lambda[2], Rational::ONE, "{case}");
                let inside = lambda.iter().all(|lambda| *lambda >= Rational::ZERO);
                assert!(inside || !covers(triangle, pixel), "{case}");
                if let Some([b0, b1, b2]) = perspective(&lambda, corners.map(|corner| corner[3])) {
                    assert_eq!(b0 + b1 + b2, Rational::ONE, "{case}");
                }
            }
        }
    }
}

/// Perspective by dividing, against homogeneous coordinates that never divide.
#[test]
fn clip_space_weights_agree_with_perspective() {
    let mut compared = 0;
    // Corners on the subpixel grid at any w: w * X is exact, so that snapping changes nothing.
    let mut random = Random::new(5);
    for _ in 0..2_000 {
        let points = [0; 3].map(|_| [0; 2].map(|_| random.between(-2048, 6144)));
        let w = [0; 3].map(|_| random.between(1, 64) as f32);
        let clip = [0, 1, 2].map(|k| {
            let [x, y] = points[k].map(|x| x as f32 / 2048.0 - 1.0); // a picture of 16 x 16
            [x * w[k], -y * w[k], 0.0, w[k]]
        });
        let pixel = [random.between(0, 15), random.between(0, 15)];
        let by_dividing = barycentrics(points, pixel).and_then(|lambda| perspective(&lambda, w));
        assert_eq!(clip_space_barycentrics(clip, 16, 16, pixel), by_dividing, "{clip:?} at {pixel:?}");
        compared += u32::from(by_dividing.is_some());
    }
    assert!(compared > 1_990);
}

#[test]
fn errors_are_measured_exactly() {
    let third = ratio(1, 3);
    assert_eq!(error_in_ulps(1.0 / 3.0, &third), 1.0 / 3.0, "0.33333334 is 1/3 + 2^-25/3, and a unit there is 2^-25");
    assert!(error_in_ulps((1.0f32 / 3.0).next_up(), &third) > 1.0);
    assert_eq!(error(1.5, &ratio(1, 1)), 0.5);
    assert_eq!(error(f32::NAN, &third), f64::INFINITY);
    assert_eq!(error_in_ulps(1.0 + f32::EPSILON, &ratio(1, 1)), 1.0);
    // Around zero a unit is the smallest float.
    assert_eq!(error_in_ulps(f32::from_bits(3), &ratio(0, 1)), 3.0);
    assert_eq!(rational(0.1f32), Some(ratio(13_421_773, 1 << 27)));
}
