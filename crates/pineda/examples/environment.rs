//! A cube map as environment: a chrome ball mirrors a room of six walls.
//!
//! Each fragment looks the room up in the direction that the eye's ray is mirrored to. How far that direction turns from one pixel to the next follows from the expression itself, for it is
//! made of numbers that know their derivatives (`f.dual()`): towards the ball's rim, where a pixel sees half of the room, the texture's smaller levels come in, and nothing flickers.
//!
//! `cargo run --release -p pineda --example environment [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Texels of a wall, across and down.
const WALL: u32 = 256;

const EYE: [f32; 3] = [0.0, 0.0, 3.2];

varyings! {
    struct Ray {
        position: Vec3,
        normal: Vec3,
    }
}

/// The ball mirrors the room.
struct Chrome<'a> {
    camera: Mat4,
    room: &'a TextureCube<'a>,
}

#[shader]
impl Shader for Chrome<'_> {
    type Vertex = [f32; 3];
    type Varyings<L: Lanes> = Ray<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, position: &[f32; 3]) -> (Vec4, Ray) {
        let position = Vec3::from(*position);
        (self.camera * position.extend(1.0), Ray { position, normal: position })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let f = f.dual();
        let (normal, ray) = (f.normal.normalize(), (f.position - EYE).normalize());
        let mirrored = self.room.sample(&Sampler::TRILINEAR, ray.reflect(normal));
        // Schlick's approximation of Fresnel's law.
        let edge = (normal.dot(ray) + 1.0).max(0.0).powi(5).value();
        Rgba::opaque(mirrored.rgb() * ([0.75, 0.77, 0.80] * (1.0 - edge) + edge))
    }
}

/// The room itself, behind everything.
struct Walls<'a> {
    camera: Mat4,
    room: &'a TextureCube<'a>,
}

#[shader]
impl Shader for Walls<'_> {
    type Vertex = [f32; 3];
    type Varyings<L: Lanes> = Vec3<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, position: &[f32; 3]) -> (Vec4, Vec3) {
        let position = Vec3::from(*position);
        (self.camera * (position * 40.0).extend(1.0), position)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        self.room.sample(&Sampler::TRILINEAR, f.dual())
    }
}

/// Six walls: tiles in six tints, a lamp above.
fn room() -> Result<TextureCube<'static>, Error> {
    const TINTS: [[u8; 3]; 6] =
        [[220, 90, 60], [60, 150, 200], [235, 235, 230], [120, 85, 60], [230, 190, 80], [90, 170, 110]];
    let mut texels = Vec::new();
    for (face, tint) in TINTS.iter().enumerate() {
        for k in 0..WALL * WALL {
            let (x, y) = (k % WALL, k / WALL);
            let is_joint = x % 32 < 2 || y % 32 < 2;
            let from_middle = x.abs_diff(WALL / 2).max(y.abs_diff(WALL / 2));
            let shade = if is_joint { 90 } else { 200 + 40 * ((x / 32 + y / 32) % 2) } - from_middle / 3;
            let is_lamp = face == 2 && from_middle < 60;
            let [r, g, b] = if is_lamp { [255; 3] } else { tint.map(|c| (u32::from(c) * shade / 255) as u8) };
            texels.push([r, g, b, 255]);
        }
    }
    TextureCube::new(WALL, texels)?.with_mips()
}

/// A cube's faces cut into squares, each pushed out to the sphere.
fn ball() -> Vec<[f32; 3]> {
    const CUTS: u32 = 48;
    let mut corners = Vec::new();
    for k in 0..6 * CUTS * CUTS {
        let (face, i, j) = (k / (CUTS * CUTS), k / CUTS % CUTS, k % CUTS);
        let corner = |i: u32, j: u32| {
            let [u, v] = [i, j].map(|k| 2.0 * k as f32 / CUTS as f32 - 1.0);
            let (axis, sign) = (face as usize / 2, if face % 2 == 0 { 1.0 } else { -1.0 });
            let mut point = [0.0; 3];
            (point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]) = (sign, u * sign, v);
            <[f32; 3]>::from(Vec3::from(point).normalize())
        };
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        corners.extend([a, b, c, a, c, d]);
    }
    corners
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let (room, corners) = (room()?, ball());
    let camera = Mat4::perspective(0.9, 1.0, 0.5, 100.0) * Mat4::look_at(EYE, [0.0; 3], [0.0, 1.0, 0.0]);
    let (chrome, walls) = (Chrome { camera, room: &room }, Walls { camera, room: &room });
    let mesh = Mesh { vertices: &corners, indices: Indices::Sequential };
    let mut pass = Pass::new();
    pass.draw(&chrome, mesh, DrawState { cull: Cull::Back, ..DrawState::default() });
    pass.draw(&walls, mesh, DrawState { cull: Cull::Front, ..DrawState::default() });
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("environment.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
