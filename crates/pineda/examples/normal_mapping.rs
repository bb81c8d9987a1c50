//! Normal mapping: a flat wall that light finds to be of cobbles.
//!
//! The texture holds, for each texel, in which direction the surface points there. Which way u and v run on the surface needs no vertex attribute: it follows from how position
//! and coordinates change from pixel to pixel (Schüler 2006, "Normal Mapping without Precomputed Tangents").
//!
//! `cargo run --release -p pineda --example normal_mapping [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Texels of the maps, across and down.
const MAP: u32 = 256;

varyings! {
    struct Wall {
        position: Vec3,
        uv: Vec2,
    }
}

struct Cobbles<'a> {
    camera: Mat4,
    /// Where the lamp is.
    lamp: [f32; 3],
    normals: Texture2d<'a, Rgba8>,
    albedo: Texture2d<'a, Rgba8Srgb>,
    sampler: Sampler,
}

#[shader]
impl Shader for Cobbles<'_> {
    type Vertex = ([f32; 3], [f32; 2]);
    type Varyings<L: Lanes> = Wall<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, (position, uv): &Self::Vertex) -> (Vec4, Wall) {
        let position = Vec3::from(*position);
        (self.camera * position.extend(1.0), Wall { position, uv: (*uv).into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Wall { position, uv } = f.dual();
        // The directions in which u and v grow, by solving for them what the chain rule says of both derivatives.
        let (right, down) = (position.dx(), position.dy());
        let outward = down.cross(right).normalize();
        let (a, b) = (down.cross(outward), outward.cross(right));
        let tangent = a * uv.dx().x + b * uv.dy().x;
        let bitangent = a * uv.dx().y + b * uv.dy().y;
        let longest = tangent.length_squared().max(bitangent.length_squared()).inverse_sqrt();

        let map = self.normals.sample(&self.sampler, uv).rgb() * 2.0 - 1.0;
        let normal = (tangent * longest * map.x + bitangent * longest * map.y + outward * map.z).normalize();

        let to_lamp = self.lamp - position.value();
        let light = normal.dot(to_lamp.normalize()).max(0.0) * 9.0 / to_lamp.length_squared();
        Rgba::opaque(self.albedo.sample(&self.sampler, uv).rgb() * ([1.0, 0.82, 0.6] * light + [0.02, 0.025, 0.04]))
    }
}

/// How high the cobbles are at a texel: domes on a jittered grid of 8 x 8, the same on both sides of the border; and which cobble it is.
fn height(x: u32, y: u32) -> (f32, u32) {
    const CELL: i32 = (MAP / 8) as i32;
    let (mut nearest, mut second, mut which) = (f32::MAX, f32::MAX, 0);
    let cell = |k: u32, d: i32| k as i32 / CELL + d;
    for (j, i) in (-1..=1).flat_map(|j| (-1..=1).map(move |i| (j, i))) {
        let (row, column) = (cell(y, j), cell(x, i));
        let number = (row.rem_euclid(8) * 8 + column.rem_euclid(8)) as u32;
        let hash = number.wrapping_mul(0x9e37_79b1) ^ 0x2545_f491;
        let jitter = |bits: u32| ((hash >> bits & 255) as f32 / 255.0 - 0.5) * 0.6 * CELL as f32;
        let dx = (column * CELL + CELL / 2) as f32 + jitter(24) - x as f32;
        let dy = (row * CELL + CELL / 2) as f32 + jitter(13) - y as f32;
        let distance = (dx * dx + dy * dy).sqrt();
        if distance < nearest {
            (nearest, second, which) = (distance, nearest, number);
        } else {
            second = second.min(distance);
        }
    }
    let inside = ((second - nearest) / 9.0).min(1.0);
    (4.0 * (1.0 - (1.0 - inside) * (1.0 - inside)), which)
}

/// The normals, from how the height changes, and the colours.
fn maps() -> (Vec<[u8; 4]>, Vec<[u8; 4]>) {
    let (mut normals, mut colors) = (Vec::new(), Vec::new());
    for (y, x) in (0..MAP).flat_map(|y| (0..MAP).map(move |x| (y, x))) {
        let at = |x: u32, y: u32| height(x % MAP, y % MAP).0;
        let (dx, dy) = (at(x + 1, y) - at(x + MAP - 1, y), at(x, y + 1) - at(x, y + MAP - 1));
        let [r, g, b] = <[f32; 3]>::from(Vec3::from([-0.5 * dx, -0.5 * dy, 1.0]).normalize());
        let code = |n: f32| ((n * 0.5 + 0.5) * 255.0 + 0.5) as u8;
        normals.push([code(r), code(g), code(b), 255]);
        let (high, which) = height(x, y);
        let stone = 120 + (which * 37 % 60) as u8;
        colors.push(if high > 1.2 { [stone, stone - 8, stone - 20, 255] } else { [70, 62, 52, 255] });
    }
    (normals, colors)
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let (normals, colors) = maps();
    let cobbles = Cobbles {
        camera: Mat4::perspective(0.8, 1.0, 0.1, 50.0)
            * Mat4::look_at([-2.6, 1.0, 3.2], [0.2, 0.0, 0.0], [0.0, 1.0, 0.0]),
        lamp: [0.9, 0.7, 1.0],
        normals: Texture2d::new(MAP, MAP, normals)?.with_mips()?,
        albedo: Texture2d::new(MAP, MAP, colors)?.with_mips()?,
        sampler: Sampler::ANISOTROPIC,
    };
    let corner = |x: f32, y: f32| ([4.0 * x, 4.0 * y, 0.0], [2.0 * x, -2.0 * y]);
    let wall = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let mesh = Mesh { vertices: &wall, indices: Indices::U8(&[0, 1, 2, 0, 2, 3]) };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.0, 0.0, 0.0, 1.0]);
    pass.draw(&cobbles, mesh, DrawState::default());
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("normal_mapping.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
