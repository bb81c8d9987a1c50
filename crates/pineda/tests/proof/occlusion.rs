//! What the depth pyramid calls hidden is hidden.

use pineda::*;
use pineda_oracle::cases::Random;

const WIDTH: u32 = 150;
const HEIGHT: u32 = 90;

/// A box's twelve triangles.
const TRIANGLES: [[u32; 3]; 12] = [
    [0, 1, 2],
    [1, 3, 2],
    [4, 6, 5],
    [5, 6, 7],
    [0, 4, 1],
    [1, 4, 5],
    [2, 3, 6],
    [3, 7, 6],
    [0, 2, 4],
    [2, 6, 4],
    [1, 5, 3],
    [3, 5, 7],
];

type Corners = [[f32; 4]; 8];

fn corners(transform: &Mat4, min: [f32; 3], max: [f32; 3]) -> Corners {
    std::array::from_fn(|k| {
        let corner = [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { min[axis] } else { max[axis] });
        let Vec4 { x, y, z, w } = *transform * Vec3::from(corner).extend(1.0);
        [x, y, z, w].map(f32::from)
    })
}

/// Draws boxes over what is there.
fn draw(boxes: &[Corners], compare: Compare, clear: Option<f32>, depth: &mut [f32]) {
    let mut pass = Pass::new();
    pass.clear_depth = clear;
    for corners in boxes {
        pass.draw_with(
            Mesh { vertices: corners, indices: Indices::U32(TRIANGLES.as_flattened()) },
            DrawState { depth: DepthState { compare, write: true }, ..DrawState::default() },
            |&position| (Vec4::from(position), ()),
            |f| Rgba::gray(f.splat(1.0)),
        );
    }
    let mut target = Target { depth: DepthBuffer::D32F(depth), ..Target::new(WIDTH, HEIGHT) };
    Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("valid");
}

fn random_box(random: &mut Random, reach: f32, size: f32) -> ([f32; 3], [f32; 3]) {
    let min = [0, 1, 2].map(|_| random.real(-reach, reach));
    (min, min.map(|v| v + random.real(0.0, size)))
}

/// A box that is called hidden changes no depth when it is drawn; with either direction of z. Many that are hidden are called so.
#[test]
fn hidden_boxes_draw_nothing() {
    let mut random = Random::new(7);
    let (mut hidden, mut wrongly_visible) = (0, 0);
    for case in 0..300 {
        let is_reversed = case % 2 == 1;
        let eye = [random.real(-1.0, 1.0), random.real(-1.0, 1.0), 12.0];
        let mut camera = Mat4::perspective(0.6, WIDTH as f32 / HEIGHT as f32, 1.0, 40.0)
            * Mat4::look_at(eye, [0.0; 3], [0.0, 1.0, 0.0]);
        if is_reversed {
            // z becomes w - z.
            for column in &mut camera.0 {
                column[2] = column[3] - column[2];
            }
        }
        let (compare, clear) = if is_reversed { (Compare::Greater, 0.0) } else { (Compare::Less, 1.0) };
        let occluders: Vec<_> = (0..12)
            .map(|_| {
                let (min, max) = random_box(&mut random, 5.0, 5.0);
                corners(&camera, min, max)
            })
            .collect();
        let mut depth = vec![0.0; (WIDTH * HEIGHT) as usize];
        draw(&occluders, compare, Some(clear), &mut depth);
        let build = if is_reversed { DepthPyramid::reversed } else { DepthPyramid::new };
        let pyramid = build(&depth, WIDTH, HEIGHT).expect("valid");
        for _ in 0..20 {
            let (min, max) = random_box(&mut random, 9.0, 2.0);
            let mut after = depth.clone();
            draw(&[corners(&camera, min, max)], compare, None, &mut after);
            let changes = after != depth;
            if pyramid.is_box_visible(&camera, min, max) {
                wrongly_visible += u32::from(!changes);
            } else {
                assert!(!changes, "case {case}: {min:?} to {max:?}");
                hidden += 1;
            }
        }
    }
    assert!(hidden > 2_000 && wrongly_visible < hidden, "{hidden} hidden, {wrongly_visible} were called visible");
}

/// The pyramid's answer is that of a look at every pixel of the rectangle.
#[test]
fn the_answer_is_that_of_every_pixel() {
    let mut random = Random::new(8);
    for _ in 0..400 {
        let (width, height) = (random.between(1, 70) as u32, random.between(1, 70) as u32);
        let depth: Vec<f32> = (0..width * height).map(|_| (random.unit() * 40.0).floor() / 64.0).collect();
        let pyramid = DepthPyramid::new(&depth, width, height).expect("valid");
        for _ in 0..20 {
            let (x0, y0) =
                (random.between(0, width.into()) as f32 - 0.5, random.between(0, height.into()) as f32 - 0.5);
            let (x1, y1) = (x0 + random.between(0, 30) as f32, y0 + random.between(0, 30) as f32);
            let z = random.unit();
            let ndc = |v: f32, size: u32| v / size as f32 * 2.0 - 1.0;
            let min = [ndc(x0, width), -ndc(y1, height), z];
            let max = [ndc(x1, width), -ndc(y0, height), z];
            let sees = |x: u32, y: u32| {
                let (x, y) = (x as f32, y as f32);
                x + 1.0 > x0 && x < x1 + 0.1 && y + 1.0 > y0 && y < y1 + 0.1
            };
            let expected = (0..width * height)
                .any(|k| sees(k % width, k / width) && f64::from(depth[k as usize]) >= f64::from(z) - 1.0 / 262_144.0);
            assert_eq!(
                pyramid.is_box_visible(&Mat4::IDENTITY, min, max),
                expected,
                "{width} x {height}, {min:?} {max:?}"
            );
        }
    }
}

#[test]
fn boxes_that_cannot_be_judged_are_visible_and_buffers_are_checked() {
    let pyramid = DepthPyramid::new(&[0.0; 64], 8, 8).expect("valid");
    let is_visible = |min, max| pyramid.is_box_visible(&Mat4::IDENTITY, min, max);
    assert!(!is_visible([-0.5, -0.5, 0.5], [0.5, 0.5, 0.75]));
    assert!(is_visible([-0.5, -0.5, -0.5], [0.5, 0.5, 0.75]), "it comes through the near plane");
    assert!(is_visible([-0.5, f32::NAN, 0.5], [0.5, 0.5, 0.75]));
    assert!(is_visible([-0.5, -0.5, 0.5], [f32::INFINITY, 0.5, 0.75]));
    assert!(!is_visible([1.5, -0.5, 0.5], [1.75, 0.5, 0.75]), "it lies beside the picture");
    assert!(!is_visible([-0.5, -0.5, -0.5], [0.5, 0.5, -0.25]), "it lies before the near plane");
    let length = DepthPyramid::new(&[0.0; 63], 8, 8).unwrap_err();
    assert!(matches!(length, Error::BufferLength { buffer: "depth", length: 63, expected: 64, .. }));
    assert!(matches!(DepthPyramid::new(&[], 0, 8), Err(Error::TargetSize { width: 0, height: 8 })));
}
