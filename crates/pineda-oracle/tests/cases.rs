//! The generator keeps what it promises of each family, and its cases are worth trying.

use pineda_oracle::cases::{Case, Family, GUARD_BAND, Random, Space};
use pineda_oracle::{Visible, Winding, covered_exactly_once, winding};

fn of_family(family: Family, count: u64) -> impl Iterator<Item = Case> {
    (0..count).map(move |n| Case::of_family(family, n))
}

#[test]
fn random_numbers_are_splitmix64() {
    // Reference values of the published generator for seed 1234567.
    let mut random = Random::new(1_234_567);
    let expected = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
    assert_eq!([0; 3].map(|_| random.bits()), expected);
}

#[test]
fn a_seed_is_a_case() {
    for family in Family::ALL {
        for case in of_family(family, 20) {
            assert_eq!(case.family, family);
            assert_eq!(Case::from_seed(case.seed).to_string(), case.to_string());
        }
    }
    let case = Case::of_family(Family::Tiny, 3);
    let printed = case.to_string();
    assert!(printed.starts_with(&format!("Case::from_seed({}): Tiny, {} x {}", case.seed, case.width, case.height)));
}

#[test]
fn every_case_is_well_formed() {
    for case in (0..20_000).map(Case::from_seed) {
        assert!((1..=96).contains(&case.width) && (1..=96).contains(&case.height), "{case}");
        let count = case.vertices.len() as u32;
        assert!(!case.triangles.is_empty() && case.triangles.iter().flatten().all(|&index| index < count), "{case}");
        let may_be_dropped = matches!(case.family, Family::NonFinite | Family::NonFiniteClip);
        assert!(may_be_dropped || case.dropped() == 0, "{case}");
        if case.space == Space::Raster {
            let in_range = |x: &i64| x.abs() <= GUARD_BAND;
            assert!(case.snapped().iter().flatten().flatten().all(in_range), "{case}");
            for [_, _, z, w] in case.corners().flatten() {
                assert!(!z.is_finite() || (0.0..=1.0).contains(&z), "{case}");
                assert!(!w.is_finite() || w > 0.0, "{case}");
            }
        }
    }
}

/// By two roads: the sum over the triangles, and the outline alone.
#[test]
fn meshes_cover_their_region_once() {
    for family in [Family::Grid, Family::Fan, Family::Strip, Family::Subdivision] {
        for case in of_family(family, 1_000) {
            let verdict = covered_exactly_once(&case.hits(), &case.region(), case.width);
            assert_eq!(verdict, Ok(()), "{case}");
        }
    }
}

#[test]
fn clipped_grids_cover_their_region_once() {
    for case in of_family(Family::ClippedGrid, 300) {
        let visible = |corners: &[[f32; 4]]| Visible::new(corners, case.width, case.height).expect("finite");
        let outline: Vec<_> = case.outline.iter().map(|&index| case.vertices[index as usize]).collect();
        let region = visible(&outline);
        let mut hits = vec![0; (case.width * case.height) as usize];
        for corners in case.corners() {
            hits.iter_mut().zip(visible(&corners).coverage()).for_each(|(hits, covered)| *hits += u32::from(covered));
        }
        assert_eq!(covered_exactly_once(&hits, &region.coverage(), case.width), Ok(()), "{case}");
    }
}

#[test]
fn families_are_what_they_say() {
    for case in of_family(Family::Degenerate, 500) {
        assert!(case.snapped().into_iter().all(|triangle| winding(triangle) == Winding::Degenerate), "{case}");
    }
    for case in of_family(Family::NearPlane, 500) {
        let depths = case.vertices.iter().map(|[_, _, z, _]| *z);
        assert!(depths.clone().any(|z| z < 0.0) && depths.clone().any(|z| z > 0.0), "{case}");
    }
    for case in of_family(Family::FarPlane, 500) {
        assert!(case.vertices.iter().any(|[_, _, z, w]| z > w), "{case}");
    }
    for case in of_family(Family::InFront, 500).chain(of_family(Family::BeyondGuardBand, 500)) {
        assert!(case.vertices.iter().all(|[_, _, z, w]| (0.0..=*w).contains(z)), "{case}");
    }
    let share = |family, count: fn(&Case) -> bool| of_family(family, 500).filter(count).count();
    assert!(share(Family::NearPlane, |case| case.vertices.iter().any(|[.., w]| *w <= 0.0)) > 250);
    assert!(share(Family::OnPlanes, |case| case.vertices.iter().any(|[.., w]| *w == 0.0)) > 200);
    assert!(share(Family::NonFinite, |case| case.dropped() > 0) > 400);
    assert!(share(Family::NonFiniteClip, |case| case.dropped() > 0) > 400);
    assert!(share(Family::Unsnapped, |case| case.vertices.iter().any(|[x, ..]| (x * 512.0) % 2.0 == 1.0)) > 200);
}

/// Cases that nobody sees prove nothing: most families must cover pixels in a good part of their cases, and leave some.
#[test]
fn families_are_seen() {
    for family in Family::ALL {
        let (mut seen, mut left) = (0, 0);
        for case in of_family(family, 200) {
            let covered: Vec<bool> = match case.space {
                Space::Raster => case.hits().into_iter().map(|hits| hits > 0).collect(),
                Space::Clip => {
                    let triangles =
                        case.corners().filter_map(|corners| Visible::new(&corners, case.width, case.height));
                    let coverages: Vec<_> = triangles.map(|triangle| triangle.coverage()).collect();
                    let pixels = 0..(case.width * case.height) as usize;
                    pixels.map(|index| coverages.iter().any(|coverage| coverage[index])).collect()
                }
            };
            seen += u32::from(covered.contains(&true));
            left += u32::from(covered.contains(&false));
        }
        println!("{family:?}: {seen} of 200 cases cover pixels, {left} leave pixels");
        let least = match family {
            Family::Degenerate => 0,
            Family::Sliver => 30,
            _ => 50,
        };
        assert!(seen >= least, "{family:?} covers pixels in only {seen} of 200 cases");
        assert!(left >= 50, "{family:?} leaves pixels in only {left} of 200 cases");
    }
}
