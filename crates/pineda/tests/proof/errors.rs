//! Every error is provoked, and leaves the target as it was.

use pineda::*;

const CORNERS: [[f32; 4]; 3] = [[0.0, 0.0, 0.5, 1.0], [8.0, 0.0, 0.5, 1.0], [0.0, 8.0, 0.5, 1.0]];

fn renderer() -> Renderer {
    Renderer::new(Settings::default()).expect("the best level")
}

/// Draws one triangle or a part of one to a target of 8 x 8 and demands that an error leaves everything alone.
fn error_of(indices: Indices<'_>, corners: &[[f32; 4]], viewport: Option<Viewport>) -> Error {
    error_in(DrawState { viewport, ..DrawState::default() }, indices, corners)
}

fn error_in(state: DrawState, indices: Indices<'_>, corners: &[[f32; 4]]) -> Error {
    let mut pass = Pass::new();
    let plain = DrawState { space: Space::Raster, ..DrawState::default() };
    // A valid draw first: even that one must not be drawn.
    for (vertices, indices, state) in
        [(&CORNERS[..], Indices::Sequential, plain), (corners, indices, DrawState { space: Space::Raster, ..state })]
    {
        pass.draw_with(Mesh { vertices, indices }, state, |&p| (Vec4::from(p), ()), |f| Rgba::gray(f.x()));
    }
    let (mut pixels, mut depth, mut ids) = ([[7u8; 4]; 64], [0.125; 64], [5; 64]);
    let (mut instances, mut draws, mut barycentrics, mut hits) = ([4; 64], [6; 64], [[0.5; 3]; 64], [8; 64]);
    let mut target = Target {
        color: ColorBuffer::Rgba8(&mut pixels),
        depth: DepthBuffer::D32F(&mut depth),
        triangle_ids: Some(&mut ids),
        instance_ids: Some(&mut instances),
        draw_ids: Some(&mut draws),
        barycentrics: Some(&mut barycentrics),
        hits: Some(&mut hits),
        ..Target::new(8, 8)
    };
    let error = renderer().render(&pass, &mut target).expect_err("this is wrong");
    assert_eq!((pixels, depth, ids), ([[7; 4]; 64], [0.125; 64], [5; 64]), "{error}");
    assert_eq!((draws, barycentrics, hits), ([6; 64], [[0.5; 3]; 64], [8; 64]), "{error}");
    assert_eq!(instances, [4; 64], "{error}");
    error
}

#[test]
fn target_sizes_are_1_to_16384() {
    for (width, height) in [(0, 1), (1, 0), (16_385, 1), (1, 16_385), (u32::MAX, u32::MAX)] {
        let error = renderer().render(&Pass::new(), &mut Target::new(width, height));
        assert_eq!(error, Err(Error::TargetSize { width, height }));
    }
    for (width, height) in [(1, 1), (16_384, 1), (1, 16_384)] {
        let mut hits = vec![7; (width * height) as usize];
        let mut target = Target { hits: Some(&mut hits), ..Target::new(width, height) };
        assert!(renderer().render(&Pass::new(), &mut target).is_ok());
        assert!(hits.iter().all(|&hits| hits == 0));
    }
}

#[test]
fn buffers_hold_one_element_a_pixel() {
    let (mut bytes, mut floats) = ([[0; 4]; 7], [[0.0; 4]; 7]);
    let (mut depth, mut ids, mut instances, mut draws) = ([0.0; 7], [0; 7], [0; 7], [0; 7]);
    let (mut barycentrics, mut hits) = ([[0.0; 3]; 7], [0; 7]);
    let plain = || Target::new(4, 2);
    let targets = [
        ("color", Target { color: ColorBuffer::Rgba8(&mut bytes.clone()), ..plain() }),
        ("color", Target { color: ColorBuffer::Rgba8Srgb(&mut bytes), ..plain() }),
        ("color", Target { color: ColorBuffer::Rgba32F(&mut floats), ..plain() }),
        ("depth", Target { depth: DepthBuffer::D32F(&mut depth), ..plain() }),
        ("stencil", Target { stencil: Some(&mut [0; 7]), ..plain() }),
        ("triangle_ids", Target { triangle_ids: Some(&mut ids), ..plain() }),
        ("instance_ids", Target { instance_ids: Some(&mut instances), ..plain() }),
        ("draw_ids", Target { draw_ids: Some(&mut draws), ..plain() }),
        ("barycentrics", Target { barycentrics: Some(&mut barycentrics), ..plain() }),
        ("hits", Target { hits: Some(&mut hits), ..plain() }),
    ];
    for (buffer, mut target) in targets {
        let error = renderer().render(&Pass::new(), &mut target).expect_err("one element is missing");
        assert_eq!(error, Error::BufferLength { buffer, length: 7, expected: 8, width: 4, height: 2, samples: 1 });
        let message = format!("the target's {buffer} buffer holds 7 elements, but 4 x 2 pixels need 8");
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn triangles_are_whole() {
    let error = error_of(Indices::U32(&[0, 1, 2, 0]), &CORNERS, None);
    assert_eq!(error, Error::PartialTriangle { draw: 1, count: 4, what: "indices" });
    let error = error_of(Indices::Sequential, &CORNERS[..2], None);
    assert_eq!(error, Error::PartialTriangle { draw: 1, count: 2, what: "vertices" });
    // With indices, two vertices are as good as any number.
    let mut pass = Pass::new();
    let mesh = Mesh { vertices: &CORNERS[..2], indices: Indices::U32(&[0, 1, 0]) };
    pass.draw_with(mesh, DrawState::default(), |&p| (Vec4::from(p), ()), |f| Rgba::gray(f.x()));
    assert!(renderer().render(&pass, &mut Target::new(8, 8)).is_ok());
}

#[test]
fn indices_are_in_range() {
    let error = error_of(Indices::U32(&[0, 1, 2, 2, 3, u32::MAX]), &CORNERS, None);
    assert_eq!(error, Error::IndexOutOfRange { draw: 1, index: 3, position: 4, vertices: 3 });
    let error = error_of(Indices::U32(&[0, 0, 0]), &[], None);
    assert_eq!(error, Error::IndexOutOfRange { draw: 1, index: 0, position: 0, vertices: 0 });
    // The wrong one is far behind, where another thread looks.
    let mut many = vec![0; 3 << 18];
    many[(3 << 18) - 2] = 9;
    let error = error_of(Indices::U32(&many), &CORNERS, None);
    assert_eq!(error, Error::IndexOutOfRange { draw: 1, index: 9, position: (3 << 18) - 2, vertices: 3 });
}

#[test]
fn indices_of_every_type_are_in_range() {
    let topologies =
        [PrimitiveTopology::TriangleList, PrimitiveTopology::TriangleStrip, PrimitiveTopology::TriangleFan];
    for topology in topologies {
        for primitive_restart in [false, true] {
            if primitive_restart && topology == PrimitiveTopology::TriangleList {
                continue;
            }
            let state = DrawState { topology, primitive_restart, ..DrawState::default() };
            let wrong = |position, index| Error::IndexOutOfRange { draw: 1, index, position, vertices: 3 };
            // The restart is an index like any other unless it is switched on.
            let at = if primitive_restart { 4 } else { 2 };
            let index = |restart| if primitive_restart { 3 } else { restart };
            let error = error_in(state, Indices::U8(&[0, 1, 0xff, 1, 3, 4]), &CORNERS);
            assert_eq!(error, wrong(at, index(0xff)));
            let error = error_in(state, Indices::U16(&[0, 1, 0xffff, 1, 3, 4]), &CORNERS);
            assert_eq!(error, wrong(at, index(0xffff)));
            let error = error_in(state, Indices::U32(&[0, 1, u32::MAX, 1, 3, 4]), &CORNERS);
            assert_eq!(error, wrong(at, index(u32::MAX)));
            let error = error_in(state, Indices::U16(&[0, 1, 2, 0, 0xff, 2]), &CORNERS);
            assert_eq!(error, wrong(4, 0xff));
            assert_eq!(error.to_string(), "draw 1: index 255 at position 4 is out of range: there are 3 vertices");
        }
    }
}

#[test]
fn lists_are_not_restarted() {
    let state = DrawState { primitive_restart: true, ..DrawState::default() };
    let error = error_in(state, Indices::U8(&[0, 1, 2]), &CORNERS);
    assert_eq!(error, Error::RestartInList { draw: 1 });
}

#[test]
fn only_filled_triangles_are_conservative() {
    for conservative in [Conservative::Overestimate, Conservative::Underestimate] {
        let state = DrawState { conservative, ..DrawState::default() };
        let wrong = [
            DrawState { topology: PrimitiveTopology::LineStrip, ..state },
            DrawState { topology: PrimitiveTopology::PointList, ..state },
            DrawState { polygon_mode: PolygonMode::Line, ..state },
            DrawState { polygon_mode: PolygonMode::Point, ..state },
        ];
        for state in wrong {
            let error = error_in(state, Indices::Sequential, &CORNERS);
            assert_eq!(error, Error::ConservativeStrokes { draw: 1 });
        }
    }
}

#[test]
fn instances_are_counted_in_32_bits() {
    let mut pass = Pass::new();
    let mesh = Mesh { vertices: &CORNERS, indices: Indices::Sequential };
    let state = DrawState::default();
    pass.draw_instanced_with(mesh, &COUNTLESS, state, |v| (Vec4::from(v.vertex), ()), |f| Rgba::gray(f.x()));
    let error = renderer().render(&pass, &mut Target::new(8, 8));
    assert_eq!(error, Err(Error::TooMany { draw: 0, count: 1 << 32, what: "instances" }));
}

/// Vertices without a size: as many as one likes, in no memory.
static COUNTLESS: [(); 1 << 32] = [(); 1 << 32];

#[test]
fn numbers_of_vertices_fit_32_bits() {
    let mut pass = Pass::new();
    let mesh = Mesh { vertices: &COUNTLESS[..], indices: Indices::U32(&[0, 1, 2]) };
    pass.draw_with(mesh, DrawState::default(), |&()| (Vec4::from([0.0; 4]), ()), |f| Rgba::gray(f.x()));
    let error = renderer().render(&pass, &mut Target::new(8, 8));
    assert_eq!(error, Err(Error::TooMany { draw: 0, count: 1 << 32, what: "vertices" }));
}

#[test]
fn viewports_are_usable() {
    let whole = Viewport::whole(8, 8);
    let wrong = [
        (Viewport { x: f32::NAN, ..whole }, "all of its numbers must be finite"),
        (Viewport { max_depth: f32::INFINITY, ..whole }, "all of its numbers must be finite"),
        (Viewport { width: 0.0, ..whole }, "its width must be positive and its height must not be 0"),
        (Viewport { width: -1.0, ..whole }, "its width must be positive and its height must not be 0"),
        (Viewport { height: -0.0, ..whole }, "its width must be positive and its height must not be 0"),
        (Viewport { height: -32_777.0, ..whole }, "it must lie within 32,768 pixels of the target's corner"),
        (Viewport { x: -32_769.0, ..whole }, "it must lie within 32,768 pixels of the target's corner"),
        (Viewport { height: 1e30, ..whole }, "it must lie within 32,768 pixels of the target's corner"),
        (Viewport { min_depth: -0.1, ..whole }, "its depths must lie in 0 to 1"),
        (Viewport { max_depth: 1.5, ..whole }, "its depths must lie in 0 to 1"),
    ];
    for (viewport, reason) in wrong {
        let error = error_of(Indices::Sequential, &CORNERS, Some(viewport));
        assert_eq!(error, Error::Viewport { draw: 1, reason });
    }
}

#[test]
fn simd_levels_that_are_not_there_are_errors() {
    for simd in Simd::ALL {
        let found = Renderer::new(Settings { simd, ..Settings::default() });
        if simd == Simd::Auto || Simd::available().contains(&simd) {
            assert!(found.is_ok(), "{simd}");
        } else {
            let available = Simd::available();
            assert_eq!(found.expect_err("it is not there"), Error::SimdUnavailable { asked: simd, available });
        }
    }
    assert_eq!("mmx".parse::<Simd>(), Err(UnknownSimd("mmx".to_owned())));
}

/// A triangle whose vertices stand far apart in the buffer.
fn far_apart(last: u32, settings: Settings) -> Result<Statistics, Error> {
    let indices = [0, last, 1];
    let mut pass = Pass::new();
    let mesh = Mesh { vertices: &COUNTLESS[1..], indices: Indices::U32(&indices) };
    pass.draw_with(mesh, DrawState::default(), |&()| (Vec4::from([f32::NAN; 4]), ()), |f| Rgba::gray(f.x()));
    Renderer::new(settings)?.render(&pass, &mut Target::new(8, 8))
}

#[test]
fn vertices_far_apart_take_little_memory() {
    let statistics = far_apart(u32::MAX - 2, Settings::default()).expect("three vertices are few");
    assert_eq!((statistics.triangles, statistics.non_finite), (1, 1));
}

/// With all the memory that one could ask for it is allowed to shade all vertices at once, which a process of two gigabytes cannot.
#[test]
#[cfg(target_os = "linux")]
fn memory_that_is_not_there_is_an_error() {
    let this = std::env::current_exe().expect("a test has a file");
    let limited = "ulimit -v 2000000 && exec \"$0\" --exact errors::in_two_gigabytes --ignored";
    let output = std::process::Command::new("sh").arg("-c").arg(limited).arg(this).output().expect("there is a shell");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
}

#[test]
#[ignore = "memory_that_is_not_there_is_an_error runs it with little memory"]
fn in_two_gigabytes() {
    let error = far_apart(170_000_000, Settings { memory: usize::MAX, ..Settings::default() });
    assert!(matches!(error, Err(Error::OutOfMemory { bytes, .. }) if bytes > 2_000_000_000), "{error:?}");
}
