//! Conservative rasterization beyond what `coverage.rs` judges pixel by pixel: the promises of [`Conservative`].

use pineda::*;
use pineda_oracle::cases::{Case, Family, Random};
use pineda_oracle::{coverage, covers_whole, picture, touches};
use pineda_proof::{Drawing, Probe, ProbeVertex, Renderers, draw_case};

const BOTH: [Conservative; 2] = [Conservative::Overestimate, Conservative::Underestimate];

fn raster(conservative: Conservative) -> DrawState {
    DrawState { conservative, space: Space::Raster, depth: DepthState::OFF, ..DrawState::DEFAULT }
}

/// Hits of triangles in raster space.
fn hits(vertices: &[[f32; 2]], size: [u32; 2], state: DrawState, settings: &Settings) -> (Vec<u32>, Statistics) {
    let mut pass = Pass::new();
    let mesh = Mesh { vertices, indices: Indices::Sequential };
    pass.draw_with(mesh, state, |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), ()), |f| Rgba::gray(f.z()));
    let mut hits = vec![0; (size[0] * size[1]) as usize];
    let mut target = Target { hits: Some(&mut hits), ..Target::new(size[0], size[1]) };
    let statistics = Renderer::new(settings.clone()).expect("available").render(&pass, &mut target).expect("valid");
    (hits, statistics)
}

#[track_caller]
fn check(vertices: [[f32; 2]; 3], state: DrawState, expected: [&str; 2]) {
    let shown = BOTH.map(|conservative| {
        let (hits, _) = hits(&vertices, [6, 6], DrawState { conservative, ..state }, &Settings::default());
        picture(&hits.iter().map(|&hits| hits > 0).collect::<Vec<_>>(), 6).replace('\n', " ")
    });
    assert_eq!(shown, expected.map(|rows| format!("{rows} ")), "{vertices:?}");
}

#[test]
fn corners_and_borders_count() {
    let plain = raster(Conservative::Off);
    // Along borders and through corners.
    let expected = ["####.. ####.. ###... ##.... ...... ......", "...... .#.... ...... ...... ...... ......"];
    check([[1.0, 1.0], [3.0, 1.0], [1.0, 3.0]], plain, expected);
    // Within one pixel, which has no sample of it; and with a corner on the corner of four.
    let nothing = ["......"; 6].join(" ");
    let expected = ["...... ...... ...#.. ...... ...... ......", &nothing];
    check([[3.1, 2.1], [3.3, 2.2], [3.2, 2.4]], plain, expected);
    let expected = ["...... ..##.. ..##.. ...... ...... ......", &nothing];
    check([[3.0, 2.0], [3.3, 2.2], [3.2, 2.4]], plain, expected);
    // A needle: shifting its edges outwards alone would make it much longer.
    let expected = ["...... .####. ...... ...... ...... ......", &nothing];
    check([[1.5, 1.25], [4.25, 1.5], [1.5, 1.75]], plain, expected);
    // Of a scissor rectangle only the inside.
    let scissor = Some(Scissor { x: 2, y: 1, width: 3, height: 2 });
    let expected = ["...... ..###. ..###. ...... ...... ......", "...... ..##.. ..#... ...... ...... ......"];
    check([[0.0, 0.0], [6.0, 0.0], [0.0, 6.0]], DrawState { scissor, ..plain }, expected);
}

#[test]
fn without_area_nothing_is_covered() {
    let vertices =
        [[1.0, 1.0], [5.0, 5.0], [3.0, 3.0], [2.5, 2.5], [2.5, 2.5], [2.5, 2.5], [0.0, 3.0], [4.0, 3.0], [9.0, 3.0]];
    for conservative in BOTH {
        let (hits, statistics) = hits(&vertices, [6, 6], raster(conservative), &Settings::default());
        assert_eq!((hits.iter().sum::<u32>(), statistics.triangles), (0, 3), "{conservative:?}");
    }
}

/// Large pictures: what is near the guard band's border and in many tiles, by the oracle.
#[test]
fn large_triangles_cover_what_the_oracle_says() {
    let (width, height) = (421, 333);
    let mut random = Random::new(0xc0);
    for case in 0..60 {
        let far = random.pick(&[1 << 23, 1 << 18, 150_000, 40_000, 31_000]);
        let middle = [random.between(0, 421 * 256), random.between(0, 333 * 256)];
        let grid = random.pick(&[1, 1, 128, 256]);
        let corners =
            [0; 3].map(|_| middle.map(|v| (v + random.between(-far, far)).clamp(-(1 << 23), 1 << 23) / grid * grid));
        let vertices = corners.map(|p| p.map(|v| v as f32 / 256.0));
        for conservative in BOTH {
            let settings = Settings { threads: 1 + case % 3, tile: TileSize::ALL[case % 3], ..Settings::default() };
            let (hits, _) = hits(&vertices, [width, height], raster(conservative), &settings);
            for (at, &hits) in hits.iter().enumerate() {
                let pixel = [at as i64 % i64::from(width), at as i64 / i64::from(width)];
                let expected = match conservative {
                    Conservative::Underestimate => covers_whole(corners, pixel),
                    _ => touches(corners, pixel),
                };
                assert_eq!(hits, u32::from(expected), "{conservative:?}: pixel {pixel:?} of {corners:?}");
            }
        }
    }
}

/// A clipped triangle is several triangles that share edges: each pixel is hit once nevertheless, and what lies across such an edge can be covered whole.
#[test]
fn clipped_triangles_cover_a_pixel_once() {
    let (mut renderers, mut clipped) = (Renderers::default(), 0);
    let families =
        [Family::NearPlane, Family::FarPlane, Family::BeyondGuardBand, Family::Homogeneous, Family::OnPlanes];
    for n in 0..400 {
        let case = Case::of_family(families[n as usize % 5], n);
        let [over, ordinary, under] =
            [Conservative::Overestimate, Conservative::Off, Conservative::Underestimate].map(|conservative| {
                let state = DrawState { conservative, depth: DepthState::OFF, ..DrawState::default() };
                draw_case(renderers.nth(n), &case, n as usize % 6, state).expect("valid")
            });
        for ((over, ordinary), under) in over.hits.iter().zip(&ordinary.hits).zip(&under.hits) {
            assert!(*over <= 1 && ordinary <= over && under <= ordinary, "{over} {ordinary} {under}\n{case}");
        }
        assert_eq!(over.statistics, ordinary.statistics, "{case}");
        clipped += ordinary.statistics.clipped;
    }
    assert!(clipped > 100, "{clipped}");
}

/// A square of pixels that both halves of a polygon have a part in, clipped at the near plane, is covered whole.
#[test]
fn the_edges_within_a_clipped_triangle_are_none_of_its() {
    // Behind the near plane lies the lower corner; what is left is a quadrilateral as high as the picture's upper half and wider than it.
    let corners = [[-8.0, 1.0, 0.5, 1.0], [8.0, 1.0, 0.5, 1.0], [0.0, -1.0, -0.5, 1.0f32]];
    for conservative in BOTH {
        let mut pass = Pass::new();
        let mesh = Mesh { vertices: &corners, indices: Indices::Sequential };
        let state = DrawState { conservative, ..DrawState::default() };
        pass.draw_with(mesh, state, |&p| (Vec4::from(p), ()), |f| Rgba::gray(f.z()));
        let mut hits = vec![0; 64 * 64];
        let mut target = Target { hits: Some(&mut hits), ..Target::new(64, 64) };
        let statistics =
            Renderer::new(Settings::default()).expect("the best").render(&pass, &mut target).expect("valid");
        assert_eq!(statistics.clipped, 1);
        let rows = if conservative == Conservative::Overestimate { 33 } else { 32 };
        let expected: Vec<u32> = (0..64 * 64).map(|at| u32::from(at < 64 * rows)).collect();
        assert_eq!(hits, expected, "{conservative:?}");
    }
}

/// The pixels along a shared edge belong to both triangles, as far as they touch them.
#[test]
fn neighbours_overlap() {
    let [a, b, c, d] = [[3.0, 2.0], [13.5, 1.0], [14.0, 11.0], [2.0, 13.25]];
    let vertices = [a, b, c, a, c, d];
    let snapped = |t: [[f32; 2]; 3]| t.map(|p| p.map(|v| (v * 256.0) as i64));
    let halves = [snapped([a, b, c]), snapped([a, c, d])];
    for conservative in BOTH {
        let (hits, _) = hits(&vertices, [16, 16], raster(conservative), &Settings::default());
        for (at, &hits) in hits.iter().enumerate() {
            let pixel = [at as i64 % 16, at as i64 / 16];
            let is_hit = if conservative == Conservative::Overestimate { touches } else { covers_whole };
            assert_eq!(hits, halves.iter().filter(|&&half| is_hit(half, pixel)).count() as u32, "{pixel:?}");
        }
    }
    assert_eq!(coverage(halves[0], 16, 16).len(), 256);
}

/// Beyond a triangle's corner an edge function exceeds the area, which fits 32 bits here, while the function does not: once it wrapped around.
#[test]
fn varyings_are_extrapolated() {
    let side = 46_340.0 / 256.0;
    let at = |x: f32, y: f32| ProbeVertex {
        position: [x, y, 0.5, 1.0],
        smooth: [x / 256.0, y / 256.0],
        linear: [x / 256.0, y / 256.0],
    };
    // With corners shortly within pixels, whose centres lie outside.
    let vertices = [at(0.75, 0.75), at(0.75 + side, 0.75), at(0.75, 0.75 + side)];
    let mut renderers = Renderers::default();
    for n in 0..renderers.count() {
        for conservative in BOTH {
            let mut pass = Pass::new();
            let mesh = Mesh { vertices: &vertices, indices: Indices::Sequential };
            pass.draw(&Probe, mesh, raster(conservative));
            let drawing = Drawing::of(renderers.nth(n), &pass, 192, 192).expect("valid");
            for (at, color) in drawing.color.iter().enumerate().filter(|&(at, _)| drawing.hits[at] > 0) {
                let expected = [at % 192, at / 192].map(|v| (v as f32 + 0.5) / 256.0);
                for (found, expected) in color.iter().zip(expected.iter().cycle()) {
                    assert!((found - expected).abs() < 1e-5, "pixel {at}: {color:?} instead of {expected:?}");
                }
                let sum: f32 = drawing.barycentrics[at].iter().sum();
                assert!((sum - 1.0).abs() < 1e-5, "pixel {at}: {:?}", drawing.barycentrics[at]);
            }
            let least = drawing.barycentrics.iter().flatten().fold(0.0, |a: f32, &b| a.min(b));
            assert_eq!(least < 0.0, conservative == Conservative::Overestimate, "{least}");
        }
    }
}

/// Depths beyond the triangle are those of its plane, within the viewport's range.
#[test]
fn depth_is_extrapolated_and_clamped() {
    let vertices = [[8.0, 8.25, 0.25, 1.0], [16.25, 8.25, 0.75, 1.0], [8.0, 24.25, 0.25, 1.0f32]];
    for (min_depth, max_depth) in [(0.0, 1.0), (0.25, 0.75)] {
        let viewport = Some(Viewport { min_depth, max_depth, ..Viewport::whole(32, 32) });
        // In raster space the viewport maps depths, too.
        let given = vertices.map(|[x, y, z, w]| [x, y, (z - min_depth) / (max_depth - min_depth), w]);
        let mut pass = Pass::new();
        let mesh = Mesh { vertices: &given, indices: Indices::Sequential };
        let state = DrawState {
            viewport,
            space: Space::Raster,
            conservative: Conservative::Overestimate,
            depth: DepthState { compare: Compare::Always, write: true },
            ..DrawState::DEFAULT
        };
        pass.draw_with(mesh, state, |&p| (Vec4::from(p), ()), |f| Rgba::gray(f.z()));
        let (mut depth, mut hits) = (vec![0.0; 32 * 32], vec![0; 32 * 32]);
        let mut target = Target { depth: DepthBuffer::D32F(&mut depth), hits: Some(&mut hits), ..Target::new(32, 32) };
        Renderer::new(Settings::default()).expect("the best").render(&pass, &mut target).expect("valid");
        let mut outside = 0;
        for (at, &z) in depth.iter().enumerate().filter(|&(at, _)| hits[at] > 0) {
            let x = (at % 32) as f32 + 0.5;
            let plane = 0.25 + (x - 8.0) * 0.5 / 8.25;
            let expected = plane.clamp(min_depth, max_depth);
            assert!((z - expected).abs() < 1e-6, "pixel {at}: {z} instead of {expected}");
            outside += u32::from(plane != expected);
        }
        assert_eq!(outside > 0, min_depth > 0.0);
    }
}

/// Cut into flushes, culled, counted: as ordinary triangles are.
#[test]
fn all_else_works_as_ever() {
    let mut random = Random::new(7);
    let corners: Vec<[f32; 2]> = (0..3 * 2_000)
        .map(|k| [40.0, 30.0].map(|size: f32| size * ((k / 3 * 7 % 19) as f32 / 19.0) + random.real(-6.0, 6.0)))
        .collect();
    for conservative in BOTH {
        let state = raster(conservative);
        let (all, statistics) = hits(&corners, [48, 40], state, &Settings::default());
        let small = Settings { memory: 1, threads: 3, ..Settings::default() };
        let backwards: Vec<_> = corners.chunks(3).flat_map(|t| [t[0], t[2], t[1]]).collect();
        assert_eq!(hits(&backwards, [48, 40], state, &small).0, all);
        assert_eq!(statistics.triangles, 2_000);
        let [fronts, backs] =
            [Cull::Back, Cull::Front].map(|cull| hits(&corners, [48, 40], DrawState { cull, ..state }, &small).0);
        let sums: Vec<u32> = fronts.iter().zip(&backs).map(|(a, b)| a + b).collect();
        assert_eq!(sums, all);
        assert!(fronts.iter().sum::<u32>() > 500 && backs.iter().sum::<u32>() > 500);
    }
}

/// What a query counts of conservative draws, against ordinary ones.
#[test]
fn queries_count() {
    let case = Case::of_family(Family::Soup, 3);
    let vertices: Vec<_> = case.triangles.iter().flatten().map(|&k| case.vertices[k as usize]).collect();
    let mut counted = Vec::new();
    for conservative in [Conservative::Off, Conservative::Overestimate, Conservative::Underestimate] {
        let mut pass = Pass::new();
        let mesh = Mesh { vertices: &vertices, indices: Indices::Sequential };
        let state = DrawState { cull: Cull::Back, ..raster(conservative) };
        pass.draw_with(mesh, state, |&p| (Vec4::from(p), ()), |f| Rgba::gray(f.z()));
        let mut hits = vec![0; (case.width * case.height) as usize];
        let mut target = Target { hits: Some(&mut hits), ..Target::new(case.width, case.height) };
        let mut renderer = Renderer::new(Settings::default()).expect("the best");
        let draw = renderer.render_counted(&pass, &mut target).expect("valid").remove(0);
        let covered: u64 = hits.iter().map(|&hits| u64::from(hits)).sum();
        assert_eq!(draw.samples_passed, covered, "{conservative:?}");
        counted.push(draw);
    }
    let same = |draw: &DrawStatistics| (draw.triangles, draw.clipped, draw.degenerate, draw.culled, draw.outside);
    assert!(counted.iter().all(|draw| same(draw) == same(&counted[0])), "{counted:?}");
    assert!(
        counted[1].samples_passed > counted[0].samples_passed && counted[0].samples_passed > counted[2].samples_passed
    );
}
