//! Wireframe over solid: a trefoil knot, its edges as smooth lines, its corners as points.
//!
//! One mesh is drawn three times. The solid's depths are moved back a little by a depth bias, so that its own edges, which are drawn with the very same
//! vertices, lie in front of it everywhere, and behind it nowhere.
//!
//! `cargo run --release -p pineda --example wireframe [OUT.png]`

use core::f32::consts::TAU;
use libm::{cosf, sinf};
use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Squares along the knot's tube, and around it.
const ALONG: u32 = 144;
const AROUND: u32 = 14;

/// A place and a normal.
type Vertex = ([f32; 3], [f32; 3]);

varyings! {
    struct Surface { place: Vec3, normal: Vec3 }
}

/// Shades a little, between two colours.
struct Knot {
    camera: Mat4,
    dark: [f32; 4],
    bright: [f32; 4],
}

#[shader]
impl Shader for Knot {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Surface<L>;

    fn vertex(&self, &(place, normal): &Vertex) -> (Vec4, Surface) {
        let place = Vec3::from(place);
        (self.camera * place.extend(1.0), Surface { place, normal: normal.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let light = f.normal.normalize().dot([0.36, 0.48, 0.8]) * 0.5 + 0.5;
        let near = (f.place.z * 0.25 + 0.5).clamp(0.0, 1.0);
        let mixed = f.splat(self.dark).mix(self.bright, light * (0.35 + 0.65 * near));
        Rgba { r: mixed.x, g: mixed.y, b: mixed.z, a: mixed.w }
    }
}

/// A tube along a trefoil knot.
fn knot() -> (Vec<Vertex>, Vec<u32>) {
    let center = |t: f32| {
        Vec3::from([(2.0 + cosf(3.0 * t)) * cosf(2.0 * t), (2.0 + cosf(3.0 * t)) * sinf(2.0 * t), sinf(3.0 * t)])
    };
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    for i in 0..ALONG {
        let t = i as f32 / ALONG as f32 * TAU;
        let forward = (center(t + 0.01) - center(t)).normalize();
        let side = forward.cross([0.0, 0.0, 1.0]).normalize();
        let up = side.cross(forward);
        for j in 0..AROUND {
            let a = j as f32 / AROUND as f32 * TAU;
            let normal = side * cosf(a) + up * sinf(a);
            vertices.push(((center(t) + normal * 0.62).into(), normal.into()));
            let at = |i: u32, j: u32| i % ALONG * AROUND + j % AROUND;
            let [p, q, r, s] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            indices.extend([p, q, r, p, r, s]);
        }
    }
    (vertices, indices)
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let (vertices, indices) = knot();
    let mesh = Mesh { vertices: &vertices, indices: Indices::U32(&indices) };
    let view = Mat4::look_at([1.5, 2.0, 10.4], [0.0; 3], [0.0, 1.0, 0.0]);
    let camera = Mat4::perspective(0.72, 1.0, 1.0, 30.0) * view;
    let look = |dark, bright| Knot { camera, dark, bright };
    let solid = look([0.002, 0.004, 0.012, 1.0], [0.02, 0.06, 0.16, 1.0]);
    let edges = look([0.02, 0.08, 0.25, 0.15], [0.15, 0.70, 0.85, 0.9]);
    let corners = look([0.2, 0.05, 0.01, 1.0], [1.0, 0.75, 0.3, 1.0]);

    let culled = DrawState { cull: Cull::Back, front_face: FrontFace::Clockwise, ..DrawState::default() };
    let behind = DrawState { depth_bias: DepthBias { constant: 4.0, slope: 2.0, clamp: 0.0 }, ..culled };
    let lines = DrawState {
        polygon_mode: PolygonMode::Line,
        smooth_lines: true,
        blend: Blend::ALPHA,
        depth: DepthState { write: false, ..DepthState::default() },
        ..culled
    };
    let points = DrawState { polygon_mode: PolygonMode::Point, point_size: 3.0, ..culled };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.003, 0.004, 0.008, 1.0]);
    pass.draw(&solid, mesh, behind).draw(&edges, mesh, lines).draw(&corners, mesh, points);

    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("wireframe.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
