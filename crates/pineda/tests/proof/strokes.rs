//! Lines and points: coverage against the oracle, pixel by pixel; what is interpolated; and that they are the same bits whichever way they are given or drawn.

use pineda::*;
use pineda_oracle::cases::Random;
use pineda_oracle::{covered_area, line_covers, picture, point_covers};
use pineda_proof::{Drawing, Renderers};

const WIDTH: u32 = 71;
const HEIGHT: u32 = 53;
const LINES: DrawState = DrawState {
    topology: PrimitiveTopology::LineList,
    space: Space::Raster,
    depth: DepthState::OFF,
    ..DrawState::DEFAULT
};
const POINTS: DrawState = DrawState { topology: PrimitiveTopology::PointList, ..LINES };

/// A place in subpixels, depth, w and some values.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    position: [f32; 4],
    values: [f32; 3],
}

varyings! {
    struct Values {
        smooth: Real,
        #[noperspective]
        linear: Real,
        #[flat]
        flat: Real,
    }
}

/// Shows the values: smooth, linear, flat, and 1 where it is front-facing.
struct Look;

#[shader]
impl Shader for Look {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Values<L>;
    fn vertex(&self, v: &Vertex) -> (Vec4, Values) {
        let [smooth, linear, flat] = v.values.map(Real::from);
        (v.position.into(), Values { smooth, linear, flat })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba { r: f.smooth, g: f.linear, b: f.flat, a: f.front_facing().select(f.splat(1.0), f.splat(0.0)) }
    }
}

/// Shows nothing but white; it interpolates nothing, and so takes other ways than [`Look`].
struct White;

#[shader]
impl Shader for White {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Real<L>;
    fn vertex(&self, v: &Vertex) -> (Vec4, Real) {
        (v.position.into(), v.values[0].into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::gray(f.varyings())
    }
}

/// A vertex at a place on the grid of 1/256 pixel.
fn at([x, y]: [i64; 2]) -> Vertex {
    Vertex { position: [x as f32 / 256.0, y as f32 / 256.0, 0.5, 1.0], values: [1.0; 3] }
}

fn drawn(renderer: &mut Renderer, vertices: &[Vertex], indices: Indices<'_>, state: DrawState) -> Drawing {
    let mut pass = Pass::new();
    pass.draw(&Look, Mesh { vertices, indices }, state);
    Drawing::of(renderer, &pass, WIDTH, HEIGHT).expect("a valid pass")
}

fn pixels() -> impl Iterator<Item = [i64; 2]> {
    (0..i64::from(HEIGHT)).flat_map(|j| (0..i64::from(WIDTH)).map(move |i| [i, j]))
}

fn check(found: &[u32], expected: &[u32], what: &str) {
    if found != expected {
        let shown = |hits: &[u32]| picture(&hits.iter().map(|&hits| hits > 0).collect::<Vec<_>>(), WIDTH);
        panic!("{what}:\n{}instead of\n{}", shown(found), shown(expected));
    }
}

/// Two places, near or far, with the tricky ones among them: corners and centres of pixels, corners of diamonds, 45 degrees.
fn ends(random: &mut Random) -> [[i64; 2]; 2] {
    let far = if random.one_in(5) { 1 << 23 } else { 12_000 };
    let grid = random.pick(&[1, 1, 32, 64, 128]);
    let mut place = || {
        [WIDTH, HEIGHT].map(|size| {
            let v = random.between(-far, far.max(256 * i64::from(size))).clamp(-(1 << 23), 1 << 23);
            v / grid * grid
        })
    };
    let [a, mut b] = [place(), place()];
    match random.between(0, 7) {
        0 => b[0] = a[0],
        1 => b[1] = a[1],
        2 => b[1] = (a[1] + b[0] - a[0]).clamp(-(1 << 23), 1 << 23),
        3 => b[1] = (a[1] - b[0] + a[0]).clamp(-(1 << 23), 1 << 23),
        4 => {
            b = [a[0] + random.between(-300, 300), a[1] + random.between(-300, 300)]
                .map(|v| v.clamp(-(1 << 23), 1 << 23));
        }
        _ => {}
    }
    if random.one_in(40) { [a, a] } else { [a, b] }
}

#[test]
fn thin_lines_cover_what_the_oracle_says() {
    let (mut renderers, mut random) = (Renderers::default(), Random::new(1));
    for case in 0..600 {
        let count = random.pick(&[1, 1, 2, 20]);
        let lines: Vec<_> = (0..count).map(|_| ends(&mut random)).collect();
        let mut expected = vec![0; (WIDTH * HEIGHT) as usize];
        for &line in &lines {
            expected.iter_mut().zip(pixels()).for_each(|(hits, pixel)| *hits += u32::from(line_covers(line, pixel)));
        }
        let vertices: Vec<_> = lines.as_flattened().iter().map(|&p| at(p)).collect();
        let drawing = drawn(renderers.nth(case), &vertices, Indices::Sequential, LINES);
        check(&drawing.hits, &expected, &format!("{lines:?}"));
        assert_eq!(drawing.statistics.lines, count);
    }
}

#[test]
fn a_closed_line_of_points_to_the_right_and_down_hits_each_joint_once() {
    let mut renderers = Renderers::default();
    // A square and a diamond, as loops: each corner's pixel once.
    let square = [[10, 10], [60, 10], [60, 40], [10, 40]].map(|p| at(p.map(|v| 256 * v + 128)));
    let diamond = [[35, 5], [55, 25], [35, 45], [15, 25]].map(|p| at(p.map(|v| 256 * v + 128)));
    for (corners, count) in [(square, 2 * 50 + 2 * 30), (diamond, 4 * 20)] {
        let state = DrawState { topology: PrimitiveTopology::LineLoop, ..LINES };
        let drawing = drawn(renderers.nth(0), &corners, Indices::Sequential, state);
        assert!(drawing.hits.iter().all(|&hits| hits < 2));
        assert_eq!(drawing.hits.iter().sum::<u32>(), count);
    }
}

#[test]
fn points_cover_what_the_oracle_says() {
    let (mut renderers, mut random) = (Renderers::default(), Random::new(2));
    for case in 0..400 {
        let size = match random.between(0, 3) {
            0 => random.between(0, 600),
            1 => 256 * random.between(0, 40),
            2 => random.between(0, 20_000),
            _ => random.between(0, 1 << 21),
        };
        let reach = size / 2 + 300;
        let mut place = || {
            [WIDTH, HEIGHT]
                .map(|side| random.between(-reach, 256 * i64::from(side) + reach) / if case % 3 == 0 { 128 } else { 1 })
        };
        let middles = [place(), place(), place()];
        let mut expected = vec![0; (WIDTH * HEIGHT) as usize];
        for &middle in &middles {
            let covers = |pixel| u32::from(point_covers(middle, size, pixel));
            expected.iter_mut().zip(pixels()).for_each(|(hits, pixel)| *hits += covers(pixel));
        }
        let state = DrawState { point_size: size as f32 / 256.0, ..POINTS };
        let drawing = drawn(renderers.nth(case), &middles.map(at), Indices::Sequential, state);
        check(&drawing.hits, &expected, &format!("{middles:?}, {size} large"));
        assert_eq!((drawing.statistics.points, drawing.statistics.lines), (3, 0));
    }
}

/// The corners that a wide line's rectangle has, clockwise in the picture.
fn rectangle([a, b]: [[i64; 2]; 2], width: f32) -> [[i64; 2]; 4] {
    let [dx, dy] = [0, 1].map(|axis| (b[axis] - a[axis]) as f64);
    let length = (dx * dx + dy * dy).sqrt();
    let half = f64::from(width) * 256.0 * 0.5 / length;
    let [nx, ny] = [-dy * half, dx * half].map(|v| v.round_ties_even() as i64);
    [[a[0] + nx, a[1] + ny], [a[0] - nx, a[1] - ny], [b[0] - nx, b[1] - ny], [b[0] + nx, b[1] + ny]]
}

#[test]
fn wide_lines_cover_their_rectangles() {
    let (mut renderers, mut random) = (Renderers::default(), Random::new(3));
    for case in 0..300 {
        let line = ends(&mut random).map(|p| p.map(|v| v.clamp(-4_000_000, 4_000_000)));
        if line[0] == line[1] {
            continue;
        }
        let width = random.pick(&[1.5, 2.0, 3.0, 7.25, 40.0]);
        let [p, q, r, s] = rectangle(line, width);
        let expected = pineda_oracle::hits(&[[p, q, r], [p, r, s]], WIDTH, HEIGHT);
        let state = DrawState { line_width: width, ..LINES };
        let drawing = drawn(renderers.nth(case), &line.map(at), Indices::Sequential, state);
        check(&drawing.hits, &expected, &format!("{line:?}, {width} wide"));
    }
}

#[test]
fn smooth_lines_are_as_opaque_as_they_cover() {
    let (mut renderers, mut random) = (Renderers::default(), Random::new(4));
    for case in 0..60 {
        let line = ends(&mut random).map(|p| p.map(|v| v.clamp(-4_000_000, 4_000_000)));
        if line[0] == line[1] {
            continue;
        }
        let width = random.pick(&[1.0, 1.5, 3.0, 12.0]);
        let corners = rectangle(line, width);
        let state = DrawState { line_width: width, smooth_lines: true, ..LINES };
        let vertices = line.map(at);
        let mut pass = Pass::new();
        pass.clear_color = Some([7.0; 4]);
        pass.draw(&White, Mesh { vertices: &vertices, indices: Indices::Sequential }, state);
        let drawing = Drawing::of(renderers.nth(case), &pass, WIDTH, HEIGHT).expect("a valid pass");
        for (at, pixel) in pixels().enumerate() {
            let exact = covered_area(&corners, pixel).to_f64().value();
            let found = drawing.color[at];
            let expected_hits = u32::from(exact > 0.0);
            assert_eq!(drawing.hits[at], expected_hits, "{pixel:?} of {line:?}, {width} wide");
            if exact > 0.0 {
                assert!((f64::from(found[3]) - exact).abs() < 1e-7, "{pixel:?} of {line:?}: {} not {exact}", found[3]);
                assert_eq!(found[0], 1.0);
            } else {
                assert_eq!(found, [7.0; 4]);
            }
        }
    }
}

#[test]
fn what_is_interpolated_lies_between_the_ends() {
    let (mut renderers, mut random) = (Renderers::default(), Random::new(5));
    for case in 0..300 {
        let line = ends(&mut random).map(|p| p.map(|v| v.clamp(-300_000, 300_000)));
        let length = [0, 1].map(|axis| (line[1][axis] - line[0][axis]) as f64);
        if length[0].abs().max(length[1].abs()) < 1_500.0 {
            continue;
        }
        let mut vertices = line.map(at);
        for v in &mut vertices {
            v.values = [random.real(-1.0, 1.0), random.real(-1.0, 1.0), random.real(-1.0, 1.0)];
            (v.position[2], v.position[3]) = (random.unit(), random.magnitude(-1, 1));
        }
        let line_width = random.pick(&[1.0, 1.0, 5.0]);
        let provoking_vertex = random.pick(&[ProvokingVertex::First, ProvokingVertex::Last]);
        let state = DrawState { line_width, provoking_vertex, ..LINES };
        let state = DrawState { depth: DepthState { compare: Compare::Always, write: true }, ..state };
        let drawing = drawn(renderers.nth(case), &vertices, Indices::Sequential, state);
        let [a, b] =
            vertices.map(|v| (v.values.map(f64::from), f64::from(v.position[2]), 1.0 / f64::from(v.position[3])));
        for (at, [i, j]) in pixels().enumerate().filter(|&(at, _)| drawing.hits[at] > 0) {
            let from_start = [256 * i + 128 - line[0][0], 256 * j + 128 - line[0][1]].map(|v| v as f64);
            let squared = length[0] * length[0] + length[1] * length[1];
            let t = (from_start[0] * length[0] + from_start[1] * length[1]) / squared;
            let (wa, wb) = ((1.0 - t) * a.2, t * b.2);
            let smooth = (wa * a.0[0] + wb * b.0[0]) / (wa + wb);
            let linear = (1.0 - t) * a.0[1] + t * b.0[1];
            let flat = if provoking_vertex == ProvokingVertex::First { a.0[2] } else { b.0[2] };
            let depth = ((1.0 - t) * a.1 + t * b.1).clamp(0.0, 1.0);
            let found = drawing.color[at].map(f64::from);
            // Extrapolated, weights may be small differences.
            let tolerance = 2e-5;
            let what = format!("{line:?} at ({i}, {j}), t = {t}");
            assert!((found[0] - smooth).abs() < tolerance, "{what}: {} not {smooth}", found[0]);
            assert!((found[1] - linear).abs() < tolerance, "{what}: {} not {linear}", found[1]);
            assert_eq!((found[2], found[3]), (flat, 1.0), "{what}");
            assert!((f64::from(drawing.depth[at]) - depth).abs() < 2e-4, "{what}: {} not {depth}", drawing.depth[at]);
            let [first, second, third] = drawing.barycentrics[at].map(f64::from);
            assert!(
                (first - wa / (wa + wb)).abs() < tolerance && (second - wb / (wa + wb)).abs() < tolerance,
                "{what}"
            );
            assert_eq!((third, drawing.triangle_ids[at]), (0.0, 0));
        }
    }
}

/// The lines or points of a row, by the book.
fn listed(row: &[u32], state: &DrawState) -> Vec<u32> {
    let mut out = Vec::new();
    for v in row.split(|&i| i == u32::MAX && state.primitive_restart) {
        let lines = match state.topology {
            PrimitiveTopology::LineStrip => v.len().saturating_sub(1),
            PrimitiveTopology::LineLoop if v.len() > 1 => v.len(),
            PrimitiveTopology::LineLoop => 0,
            _ => return row.to_vec(),
        };
        (0..lines).for_each(|i| out.extend([v[i], v[(i + 1) % v.len()]]));
    }
    out
}

#[test]
fn strips_loops_and_lists_are_the_same_bits_with_every_setting() {
    let (mut renderers, mut random) = (Renderers::default(), Random::new(6));
    for case in 0..150 {
        let topology = random.pick(&[
            PrimitiveTopology::LineStrip,
            PrimitiveTopology::LineLoop,
            PrimitiveTopology::LineList,
            PrimitiveTopology::PointList,
        ]);
        let is_list = matches!(topology, PrimitiveTopology::LineList | PrimitiveTopology::PointList);
        let state = DrawState {
            space: Space::Clip,
            topology,
            primitive_restart: !is_list && random.one_in(2),
            provoking_vertex: random.pick(&[ProvokingVertex::First, ProvokingVertex::Last]),
            line_width: random.pick(&[1.0, 1.0, 4.5]),
            smooth_lines: random.one_in(4),
            point_size: random.pick(&[1.0, 3.5, 30.0]),
            blend: random.pick(&[Blend::OPAQUE, Blend::ALPHA]),
            depth: DepthState::default(),
            ..DrawState::default()
        };
        let vertices: Vec<_> = (0..120)
            .map(|_| {
                let w = if random.one_in(3) { random.real(-0.3, 2.0) } else { 1.0 };
                let mut position =
                    [random.real(-1.3, 1.3) * w, random.real(-1.3, 1.3) * w, random.real(-0.1, 1.1) * w, w];
                if random.one_in(30) {
                    position[random.between(0, 3) as usize] = random.pick(&[f32::NAN, f32::INFINITY, 1e30, -1e30, 0.0]);
                }
                Vertex { position, values: [random.unit(), random.unit(), random.unit()] }
            })
            .collect();
        let row: Vec<u32> = (0..200)
            .map(|_| if state.primitive_restart && random.one_in(6) { u32::MAX } else { random.between(0, 119) as u32 })
            .collect();
        let shorts: Vec<u16> = row.iter().map(|&i| i as u16).collect();
        let bytes: Vec<u8> = row.iter().map(|&i| i as u8).collect();
        let indices = [Indices::U8(&bytes), Indices::U16(&shorts), Indices::U32(&row)][case as usize % 3];
        let first = drawn(renderers.nth(case), &vertices, indices, state);
        let list = listed(&row, &state);
        let list_state = DrawState {
            topology: if topology == PrimitiveTopology::PointList { topology } else { PrimitiveTopology::LineList },
            primitive_restart: false,
            ..state
        };
        let second = drawn(renderers.nth(random.bits()), &vertices, Indices::U32(&list), list_state);
        assert_eq!(first.difference(&second), None, "case {case}: {state:?}");
        assert_eq!(first.statistics, second.statistics, "case {case}: {state:?}");
        assert!(first.statistics.lines + first.statistics.points > 0);
    }
}

/// The same for instances, each moved and in a value of its own.
struct InstancedLook;

#[shader]
impl Shader for InstancedLook {
    type Vertex = Instanced<Vertex, [f32; 3]>;
    type Varyings<L: Lanes> = Values<L>;
    fn vertex(&self, v: &Self::Vertex) -> (Vec4, Values) {
        Look.vertex(&moved(&v.vertex, v.instance))
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba { r: f.smooth, g: f.linear, b: f.flat, a: f.front_facing().select(f.splat(1.0), f.splat(0.0)) }
    }
}

fn moved(v: &Vertex, [x, y, value]: [f32; 3]) -> Vertex {
    let [vx, vy, z, w] = v.position;
    Vertex { position: [vx + x, vy + y, z, w], values: [v.values[0], v.values[1], value] }
}

#[test]
fn instances_of_lines_and_points_are_what_they_are_one_by_one() {
    let (mut renderers, mut random) = (Renderers::default(), Random::new(9));
    for case in 0..60 {
        let topologies = [PrimitiveTopology::LineLoop, PrimitiveTopology::PointList, PrimitiveTopology::TriangleFan];
        let state = DrawState {
            topology: topologies[case as usize % 3],
            polygon_mode: random.pick(&[PolygonMode::Line, PolygonMode::Point]),
            line_width: random.pick(&[1.0, 2.0]),
            point_size: 3.0,
            ..LINES
        };
        let corners: Vec<_> = (0..7).map(|_| at([0; 2].map(|_| random.between(-1_500, 1_500)))).collect();
        let instances: Vec<_> =
            (0..40).map(|k| [random.between(0, 71) as f32, random.between(0, 53) as f32, k as f32]).collect();
        let mut pass = Pass::new();
        let mesh = Mesh { vertices: &corners, indices: Indices::Sequential };
        pass.draw_instanced(&InstancedLook, mesh, &instances, state);
        let together = Drawing::of(renderers.nth(case), &pass, WIDTH, HEIGHT).expect("a valid pass");
        let all: Vec<Vec<_>> = instances.iter().map(|&i| corners.iter().map(|v| moved(v, i)).collect()).collect();
        let mut pass = Pass::new();
        for vertices in &all {
            pass.draw(&Look, Mesh { vertices, indices: Indices::Sequential }, state);
        }
        let apart = Drawing::of(renderers.nth(random.bits()), &pass, WIDTH, HEIGHT).expect("a valid pass");
        assert_eq!((&together.hits, &together.instance_ids), (&apart.hits, &apart.draw_ids), "case {case}");
        assert_eq!((&together.color, &together.triangle_ids), (&apart.color, &apart.triangle_ids), "case {case}");
        assert_eq!(together.statistics, apart.statistics);
    }
}

#[test]
fn little_memory_changes_no_bit() {
    let mut random = Random::new(7);
    let vertices: Vec<_> =
        (0..30_000).map(|_| at([WIDTH, HEIGHT].map(|side| random.between(-500, 256 * i64::from(side))))).collect();
    for topology in [PrimitiveTopology::LineLoop, PrimitiveTopology::PointList, PrimitiveTopology::TriangleStrip] {
        for line_width in [1.0, 2.5] {
            let state = DrawState { topology, line_width, polygon_mode: PolygonMode::Line, ..LINES };
            let draw = |memory| {
                let mut renderer = Renderer::new(Settings { memory, ..Settings::default() }).expect("the best level");
                drawn(&mut renderer, &vertices, Indices::Sequential, state)
            };
            let (much, little) = (draw(1 << 30), draw(1));
            assert_eq!(much.difference(&little), None, "{topology:?}");
            assert!(much.statistics.flushes == 1 && little.statistics.flushes > 3);
        }
    }
}

#[test]
fn what_is_not_finite_is_dropped_and_counted() {
    let mut renderers = Renderers::default();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..4 {
            let mut vertices = [at([1_000, 1_000]), at([9_000, 5_000]), at([3_000, 7_000]), at([5_000, 1_000])];
            vertices[0].position[axis] = bad;
            let drawing = drawn(renderers.nth(axis as u64), &vertices, Indices::Sequential, LINES);
            assert_eq!((drawing.statistics.lines, drawing.statistics.non_finite), (2, 1));
            assert_eq!(drawing.triangle_ids.iter().filter(|&&id| id == 0).count(), 0);
            assert!(drawing.triangle_ids.contains(&1));
            let drawing = drawn(renderers.nth(axis as u64), &vertices, Indices::Sequential, POINTS);
            assert_eq!((drawing.statistics.points, drawing.statistics.non_finite), (4, 1));
            assert_eq!(drawing.hits.iter().sum::<u32>(), 3);
        }
    }
}

#[test]
fn lines_are_clipped_at_the_near_plane_and_points_by_their_middle() {
    let mut renderers = Renderers::default();
    let vertex = |x: f32, z: f32, w: f32| Vertex { position: [x * w, 0.0, z * w, w], values: [x, x, z] };
    let state = DrawState { space: Space::Clip, ..LINES };
    // From z = -1 at the left border to z = 1 at the right one: the right half is there, and it shows what the whole line would.
    let line = [vertex(-1.0, -1.0, 1.0), vertex(1.0, 1.0, 1.0)];
    let drawing = drawn(renderers.nth(3), &line, Indices::Sequential, state);
    assert_eq!(drawing.statistics.clipped, 1);
    let row = HEIGHT / 2 * WIDTH;
    // The line ends in the last pixel's diamond, at its right corner.
    for x in 0..WIDTH - 1 {
        let at = (row + x) as usize;
        let there = (x as f32 + 0.5) / WIDTH as f32 * 2.0 - 1.0;
        if there > 0.03 {
            assert!((drawing.color[at][0] - there).abs() < 1e-4 && (drawing.color[at][1] - there).abs() < 1e-4, "{x}");
            assert_eq!(drawing.color[at][2], -1.0, "the start provokes, although it is cut off");
        } else if there < -0.03 {
            assert_eq!(drawing.hits[at], 0);
        }
    }
    // Through the eye: what lies behind it is not there.
    let line = [vertex(0.5, 0.5, 1.0), Vertex { position: [0.0, 0.0, -1.0, -1.0], values: [3.0; 3] }];
    let drawing = drawn(renderers.nth(4), &line, Indices::Sequential, state);
    assert!(drawing.hits.iter().sum::<u32>() > 2);
    assert!(drawing.color.iter().flatten().all(|v| v.is_finite()));

    let points = [vertex(0.0, -0.01, 1.0), vertex(0.5, 0.5, 1.0), vertex(-0.99, 1.0, 1.0), vertex(1.01, 0.5, 1.0)];
    let state = DrawState { point_size: 9.0, ..DrawState { space: Space::Clip, ..POINTS } };
    let drawing = drawn(renderers.nth(5), &points, Indices::Sequential, state);
    assert_eq!(drawing.statistics.outside, 1);
    let shown = [0, 1, 2, 3].map(|id| drawing.triangle_ids.iter().filter(|&&shown| shown == id).count());
    assert_eq!(shown[..2], [0, 81], "the middle of the first lies before the near plane");
    assert!(shown[2] >= 36 && shown[3] >= 27, "a part of the others is in the picture: {shown:?}");
}

#[test]
fn edges_and_corners_are_those_of_the_triangles_that_are_not_culled() {
    let (mut renderers, mut random) = (Renderers::default(), Random::new(8));
    for case in 0..120 {
        let corners: Vec<_> = (0..30)
            .map(|_| [WIDTH, HEIGHT].map(|side| random.between(-2_000, 256 * i64::from(side) + 2_000)))
            .collect();
        let mut vertices: Vec<_> = corners.iter().map(|&p| at(p)).collect();
        vertices.iter_mut().enumerate().for_each(|(k, v)| v.values = [k as f32; 3]);
        let cull = random.pick(&[Cull::None, Cull::Front, Cull::Back]);
        let front_face = random.pick(&[FrontFace::Clockwise, FrontFace::CounterClockwise]);
        let provoking_vertex = random.pick(&[ProvokingVertex::First, ProvokingVertex::Last]);
        for polygon_mode in [PolygonMode::Line, PolygonMode::Point] {
            let topology = PrimitiveTopology::TriangleList;
            let state = DrawState { cull, front_face, provoking_vertex, polygon_mode, topology, ..LINES };
            let drawing = drawn(renderers.nth(case), &vertices, Indices::Sequential, state);
            let mut expected = vec![0; (WIDTH * HEIGHT) as usize];
            let mut shows = vec![None; expected.len()];
            for (k, triangle) in corners.chunks(3).enumerate() {
                let t = [triangle[0], triangle[1], triangle[2]];
                let is_front = match pineda_oracle::winding(t) {
                    pineda_oracle::Winding::Degenerate => continue,
                    winding => (winding == pineda_oracle::Winding::Clockwise) == (front_face == FrontFace::Clockwise),
                };
                if cull == if is_front { Cull::Front } else { Cull::Back } {
                    continue;
                }
                let flat = 3 * k + if provoking_vertex == ProvokingVertex::First { 0 } else { 2 };
                for (at, pixel) in pixels().enumerate() {
                    let hits = (0..3).filter(|&c| match polygon_mode {
                        PolygonMode::Point => point_covers(t[c], 256, pixel),
                        _ => line_covers([t[c], t[(c + 1) % 3]], pixel),
                    });
                    let hits = hits.count() as u32;
                    expected[at] += hits;
                    if hits > 0 {
                        shows[at] = Some((k as u32, flat as f32, if is_front { 1.0 } else { 0.0 }));
                    }
                }
            }
            check(&drawing.hits, &expected, &format!("case {case}: {state:?}"));
            for (at, shows) in shows.iter().enumerate() {
                let Some((id, flat, front)) = *shows else { continue };
                assert_eq!(drawing.triangle_ids[at], id);
                assert_eq!(drawing.color[at][2..], [flat, front], "case {case}: {state:?}");
                let sum: f32 = drawing.barycentrics[at].iter().sum();
                assert!((sum - 1.0).abs() < 1e-4, "{:?}", drawing.barycentrics[at]);
            }
            assert_eq!((drawing.statistics.triangles, drawing.statistics.lines), (10, 0));
        }
    }
}

#[test]
fn what_an_edge_shows_is_what_the_triangle_shows_there() {
    let mut renderers = Renderers::default();
    let mut vertices = [[2_000, 1_500], [15_000, 3_000], [7_000, 12_000]].map(at);
    for (k, v) in vertices.iter_mut().enumerate() {
        let k = k as f32;
        (v.position[2], v.position[3], v.values) = (0.2 + 0.3 * k, 1.0 + k, [k, 1.0 - k, k]);
    }
    let depth = DepthState { compare: Compare::Always, write: true };
    let bias = DepthBias { constant: 0.0, slope: 4.0, clamp: 0.0 };
    for depth_bias in [DepthBias::NONE, bias] {
        let state = DrawState { topology: PrimitiveTopology::TriangleList, depth, depth_bias, ..LINES };
        let filled = drawn(renderers.nth(1), &vertices, Indices::Sequential, state);
        let edges = drawn(
            renderers.nth(2),
            &vertices,
            Indices::Sequential,
            DrawState { polygon_mode: PolygonMode::Line, ..state },
        );
        let mut compared = 0;
        for at in (0..filled.hits.len()).filter(|&at| filled.hits[at] > 0 && edges.hits[at] > 0) {
            // A pixel's centre lies at most half a pixel from the edge.
            assert!((filled.depth[at] - edges.depth[at]).abs() < 0.02, "{} {}", filled.depth[at], edges.depth[at]);
            assert!((filled.color[at][0] - edges.color[at][0]).abs() < 0.06);
            for k in 0..3 {
                assert!((filled.barycentrics[at][k] - edges.barycentrics[at][k]).abs() < 0.06);
            }
            compared += 1;
        }
        assert!(compared > 60);
    }
}

#[test]
fn widths_and_sizes_out_of_range_are_errors() {
    let vertices = [at([0, 0]); 3];
    let draw = |state| {
        let mut pass = Pass::new();
        pass.draw(&Look, Mesh { vertices: &vertices[..2], indices: Indices::Sequential }, state);
        Renderer::new(Settings::default()).expect("the best level").render(&pass, &mut Target::new(8, 8))
    };
    for bad in [f32::NAN, -1.0, 8_193.0, f32::INFINITY] {
        let wrong =
            |field, least| Error::LineOrPointSize { draw: 0, field, value: bad.to_string(), least, most: 8_192 };
        assert_eq!(draw(DrawState { line_width: bad, ..LINES }), Err(wrong("line_width", 1)));
        assert_eq!(draw(DrawState { point_size: bad, ..POINTS }), Err(wrong("point_size", 0)));
    }
    let message = "draw 0: a line_width of 0.5 cannot be drawn: it must lie in 1 to 8192";
    assert_eq!(draw(DrawState { line_width: 0.5, ..LINES }).expect_err("too thin").to_string(), message);
    for good in [0.0, 0.001, 8_192.0] {
        assert!(draw(DrawState { point_size: good, ..POINTS }).is_ok());
    }
    assert_eq!(
        draw(DrawState { topology: PrimitiveTopology::PointList, primitive_restart: true, ..LINES }),
        Err(Error::RestartInList { draw: 0 })
    );
    let mut pass = Pass::new();
    pass.draw(&Look, Mesh { vertices: &vertices, indices: Indices::Sequential }, LINES);
    let error = Renderer::new(Settings::default()).expect("the best level").render(&pass, &mut Target::new(8, 8));
    assert_eq!(error, Err(Error::PartialLine { draw: 0, count: 3, what: "vertices" }));
}

/// A smooth line's area multiplies alpha; of integers it once multiplied the fourth one's bits, as if they were a float's.
#[test]
fn smooth_lines_leave_integers_as_they_are() {
    let line = [[2.25, 3.5], [29.5, 11.75]];
    let mut pass = Pass::new();
    pass.clear_color = None;
    pass.draw_with(
        Mesh { vertices: &line, indices: Indices::Sequential },
        DrawState {
            topology: PrimitiveTopology::LineList,
            line_width: 3.0,
            smooth_lines: true,
            space: Space::Raster,
            ..DrawState::default()
        },
        |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), ()),
        |f| {
            let number = |x: u32| f.splat(x);
            RgbaU { r: number(1), g: number(2), b: number(3), a: number(0x1234_5678) }
        },
    );
    let mut pixels = vec![[0u32; 4]; 32 * 16];
    let mut target = Target { color: ColorBuffer::Rgba32U(&mut pixels), ..Target::new(32, 16) };
    Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("valid");
    assert!(pixels.iter().all(|&p| p == [0; 4] || p == [1, 2, 3, 0x1234_5678]), "{pixels:x?}");
    assert!(pixels.iter().any(|&p| p != [0; 4]));
}
