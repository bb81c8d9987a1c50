//! What draws are counted to have done, against counting by hand.

use crate::common::{HEIGHT, Layer, PIXELS, WIDTH, settings};
use crate::stencil::{Sample, random_layer};
use pineda::*;
use pineda_oracle::cases::Random;
use pineda_oracle::snap;
use pineda_proof::{Probe, ProbeVertex};

#[test]
fn samples_passed_are_those_that_passed() {
    for seed in 0..500 {
        let mut random = Random::new(seed);
        let layers: Vec<Layer> = (0..random.between(1, 5)).map(|_| random_layer(&mut random)).collect();
        let mut wanted = vec![0; layers.len()];
        for at in 0..PIXELS {
            let mut sample = Sample { color: [0.0; 4], depth: 0.5, stencil: 0, draw: NO_ID };
            for (draw, layer) in layers.iter().enumerate() {
                wanted[draw] += u64::from(sample.draw(draw, layer, at));
            }
        }
        let mut pass = Pass::new();
        pass.clear_depth = Some(0.5);
        layers.iter().for_each(|layer| layer.draw(&mut pass));
        let mut reference: Option<Vec<DrawStatistics>> = None;
        for settings in settings(seed) {
            let mut renderer = Renderer::new(settings.clone()).expect("available");
            let [mut counted, mut uncounted] = [(); 2].map(|()| vec![[0.0; 4]; PIXELS]);
            let target = Target { color: ColorBuffer::Rgba32F(&mut uncounted), ..Target::new(WIDTH, HEIGHT) };
            renderer.render(&pass, &mut { target }).expect("valid");
            let target = Target { color: ColorBuffer::Rgba32F(&mut counted), ..Target::new(WIDTH, HEIGHT) };
            let mut draws = renderer.render_counted(&pass, &mut { target }).expect("valid");
            assert!(counted == uncounted, "seed {seed}: counting changes nothing");
            let found: Vec<u64> = draws.iter().map(|draw| draw.samples_passed).collect();
            assert_eq!(found, wanted, "seed {seed}, {settings:?}");
            // The others are the same at each level and with any number of threads; and with any tiles, but for three.
            for draw in &mut draws {
                assert!(draw.tiles <= 3 && draw.fragments_shaded <= PIXELS as u64);
                assert!(draw.samples_written <= draw.samples_passed);
                (draw.tiles, draw.fragments_shaded, draw.samples_written) = (0, 0, 0);
            }
            assert_eq!(*reference.get_or_insert_with(|| draws.clone()), draws, "seed {seed}, {settings:?}");
        }
    }
}

/// Blocks of 4 x 4 pixels reach over the border of a picture that four does not divide: once, samples there were counted.
#[test]
fn samples_beyond_the_border_are_not_counted() {
    let (width, height) = (37, 26);
    for size in [30.0, 400.0] {
        let vertices = [[20.5, 12.0], [20.5 + size, 12.0], [20.5, 12.0 + size]];
        for depth in [DepthState::OFF, DepthState::default()] {
            let mut pass = Pass::new();
            let mesh = Mesh { vertices: &vertices, indices: Indices::Sequential };
            let state = DrawState { depth, space: Space::Raster, ..DrawState::default() };
            pass.draw_with(mesh, state, |&[x, y]: &[f32; 2]| (Vec4::from([x, y, 0.5, 1.0]), ()), |f| Rgba::gray(f.z()));
            for settings in settings(0) {
                let mut hits = vec![0; (width * height) as usize];
                let mut target = Target { hits: Some(&mut hits), ..Target::new(width, height) };
                let draws =
                    Renderer::new(settings).expect("available").render_counted(&pass, &mut target).expect("valid");
                let covered: u64 = hits.iter().map(|&hits| u64::from(hits)).sum();
                assert_eq!(draws[0].samples_passed, covered, "{size} pixels, {depth:?}");
            }
        }
    }
}

/// Of opaque draws only what is seen is shaded; of others all that passes.
#[test]
fn fragments_shaded_are_those_that_must_be() {
    let layer = |z: f32, state: DrawState| Layer::new(state, || ([0.5; 4], z, true));
    let opaque = DrawState::default();
    let blended = DrawState { blend: Blend::ALPHA, ..opaque };
    let unseen = DrawState { color_mask: ColorMask::NONE, ..opaque };
    let layers =
        [layer(0.75, opaque), layer(0.5, opaque), layer(0.6, opaque), layer(0.25, blended), layer(0.125, unseen)];
    let mut pass = Pass::new();
    layers.iter().for_each(|layer| layer.draw(&mut pass));
    let mut color = vec![[0; 4]; PIXELS];
    for settings in settings(0) {
        let target = Target { color: ColorBuffer::Rgba8(&mut color), ..Target::new(WIDTH, HEIGHT) };
        let draws =
            Renderer::new(settings.clone()).and_then(|mut r| r.render_counted(&pass, &mut { target })).expect("valid");
        let all = PIXELS as u64;
        assert_eq!(draws.iter().map(|draw| draw.fragments_shaded).collect::<Vec<_>>(), [0, all, 0, all, 0]);
        assert_eq!(draws.iter().map(|draw| draw.samples_passed).collect::<Vec<_>>(), [all, all, 0, all, all]);
        let written = |draws: &[DrawStatistics]| draws.iter().map(|draw| draw.samples_written).collect::<Vec<_>>();
        assert_eq!(written(&draws), [0, all, 0, all, all]);
        // Without a picture nothing is shaded, and depths are written all the same.
        let target = Target::new(WIDTH, HEIGHT);
        let draws = Renderer::new(settings).and_then(|mut r| r.render_counted(&pass, &mut { target })).expect("valid");
        assert_eq!(written(&draws), [0, all, 0, all, all]);
        assert!(draws.iter().all(|draw| draw.fragments_shaded == 0));
        assert!(draws.iter().all(|draw| draw.vertices_shaded == 3 * all && draw.triangles == all));
    }
}

/// What becomes of triangles: non-finite, without an area, culled, or none of these; whatever is drawn of them.
#[test]
fn triangles_are_counted_by_what_becomes_of_them() {
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let size = random.pick(&[0.01, 3.0, 60.0, 9_000.0]);
        let (mut vertices, mut wanted) = (Vec::new(), DrawStatistics::default());
        let cull = random.pick(&[Cull::None, Cull::Front, Cull::Back]);
        let polygon_mode = random.pick(&[PolygonMode::Fill, PolygonMode::Line, PolygonMode::Point]);
        for _ in 0..random.between(1, 700) {
            let middle = [random.real(-5.0, 45.0), random.real(-5.0, 20.0)];
            let mut corners = [0; 3].map(|_| middle.map(|v| v + random.real(-size, size)));
            if random.one_in(9) {
                corners[1] = corners[0];
            }
            wanted.triangles += 1;
            if random.one_in(20) {
                corners[2][0] = f32::NAN;
                wanted.non_finite += 1;
            } else {
                let [a, b, c] = corners.map(|corner| corner.map(|v| snap(v.into()).expect("near")));
                let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                let is_culled = match cull {
                    Cull::None => false,
                    Cull::Front => area < 0,
                    Cull::Back => area > 0,
                };
                wanted.degenerate += u64::from(area == 0);
                wanted.culled += u64::from(is_culled);
            }
            let vertex = |[x, y]: [f32; 2]| ProbeVertex { position: [x, y, 0.5, 1.0], ..ProbeVertex::default() };
            vertices.extend(corners.map(vertex));
        }
        wanted.vertices_shaded = vertices.len() as u64;
        let mut pass = Pass::new();
        // Before it another draw, so that shares begin in the middle of one.
        let before = Mesh { vertices: &vertices[..vertices.len() / 2 / 3 * 3], indices: Indices::Sequential };
        pass.draw(&Probe, before, DrawState { space: Space::Raster, ..DrawState::default() });
        let mesh = Mesh { vertices: &vertices, indices: Indices::Sequential };
        pass.draw(&Probe, mesh, DrawState { space: Space::Raster, cull, polygon_mode, ..DrawState::default() });
        for settings in settings(seed) {
            let mut renderer = Renderer::new(settings.clone()).expect("available");
            let found = renderer.render_counted(&pass, &mut Target::new(WIDTH, HEIGHT)).expect("valid")[1];
            (wanted.tiles, wanted.fragments_shaded) = (found.tiles, found.fragments_shaded);
            (wanted.samples_passed, wanted.samples_written) = (found.samples_passed, found.samples_written);
            assert_eq!(found, wanted, "seed {seed}, {settings:?}");
        }
    }
}

/// Lines and points are counted apart, and by what becomes of them.
#[test]
fn lines_and_points_are_counted_by_what_becomes_of_them() {
    let vertex = |position| ProbeVertex { position, ..ProbeVertex::default() };
    let inside = [[-0.5, 0.0, 0.5, 1.0], [0.5, 0.25, 0.5, 1.0]];
    let (before, beyond) = ([0.5, 0.0, -0.5, 1.0], [0.0, 0.0, 2.0, 1.0]);
    let ends = [inside, [inside[0], before], [beyond, beyond], [inside[1], [f32::NAN, 0.0, 0.5, 1.0]]];
    let vertices = ends.as_flattened().iter().copied().map(vertex).collect::<Vec<_>>();
    let mesh = Mesh { vertices: &vertices, indices: Indices::Sequential };
    let mut pass = Pass::new();
    for topology in [PrimitiveTopology::LineList, PrimitiveTopology::PointList] {
        pass.draw(&Probe, mesh, DrawState { topology, ..DrawState::default() });
    }
    for settings in settings(0) {
        let mut renderer = Renderer::new(settings.clone()).expect("available");
        let found = renderer.render_counted(&pass, &mut Target::new(WIDTH, HEIGHT)).expect("valid");
        let numbers = |draw: &DrawStatistics| {
            [draw.triangles, draw.lines, draw.points, draw.non_finite, draw.outside, draw.clipped, draw.culled]
        };
        assert_eq!(numbers(&found[0]), [0, 4, 0, 1, 1, 1, 0], "{settings:?}");
        assert_eq!(numbers(&found[1]), [0, 0, 8, 1, 3, 0, 0], "{settings:?}");
    }
}
