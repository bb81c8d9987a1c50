//! Tutorial 5: barycentric coordinates in a fragment shader, and a triangle that turns by one degree a frame.
//!
//! What is rasterized is the page's rectangle, two triangles that fill the picture; the spinning triangle exists in the
//! fragment stage only, which solves for its barycentric coordinates at each pixel and shows them as colours. The
//! uniforms A, B and C are the page's, as is its matrix for one degree, applied again and again in f64: so every frame has the
//! same bits everywhere, although it turns.
//!
//! `cargo run --release -p pineda --example barycentric_spin [OUT.png]` writes an animated PNG.

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;
/// One turn.
pub const FRAMES: u32 = 360;

struct Barycentric {
    a: [f32; 2],
    b: [f32; 2],
    c: [f32; 2],
}

#[shader]
impl Shader for Barycentric {
    type Vertex = [f32; 2];
    type Varyings<L: Lanes> = Vec2<L>;

    fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, Vec2) {
        (Vec4::from([x * 2.0 - 1.0, y * 2.0 - 1.0, 0.0, 1.0]), [x, y].into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let uv = Vec2::new(f.x, 1.0 - f.y);
        let v0 = f.splat(self.c) - self.a;
        let v1 = f.splat(self.b) - self.a;
        let v2 = uv - self.a;
        let (dot00, dot01, dot02) = (v0.dot(v0), v0.dot(v1), v0.dot(v2));
        let (dot11, dot12) = (v1.dot(v1), v1.dot(v2));
        let det = 1.0 / (dot00 * dot11 - dot01 * dot01);
        let u = (dot11 * dot02 - dot01 * dot12) * det;
        let v = (dot00 * dot12 - dot01 * dot02) * det;
        let inside = u.ge(0.0) & v.ge(0.0) & (u + v).le(1.0);
        inside.select(Rgba::opaque(Vec3::new(u, v, 1.0 - u - v)), [0.0, 0.0, 0.0, 1.0])
    }
}

/// A corner of the spinning triangle. The page turns it twice, around (0, 0) and around (1/2, 1/2), and takes x from the
/// one and y from the other.
#[derive(Clone, Copy)]
struct Corner {
    around_origin: [f64; 2],
    around_middle: [f64; 2],
}

impl Corner {
    /// One degree.
    fn turn(&mut self) {
        const COS: f64 = 0.999_847_695_156_391_2;
        const SIN: f64 = 0.017_452_406_437_283_51;
        let turned = |[x, y]: [f64; 2]| [COS * x - SIN * y, SIN * x + COS * y];
        self.around_origin = turned(self.around_origin);
        self.around_middle = turned(self.around_middle.map(|x| x - 0.5)).map(|x| x + 0.5);
    }

    fn uniform(&self) -> [f32; 2] {
        [self.around_origin[0], self.around_middle[1]].map(|x| if x.abs() < 1.0 { x.abs() as f32 } else { 1.0 })
    }
}

/// Draws the first `frames` frames and shows each: its pixels, row by row from the top.
pub fn draw<E: From<Error>>(
    settings: Settings,
    frames: u32,
    mut show: impl FnMut(&[[u8; 4]]) -> Result<(), E>,
) -> Result<(), E> {
    let corner = |around_origin, around_middle| Corner { around_origin, around_middle };
    let mut corners =
        [corner([0.25, 0.25], [0.25, 0.25]), corner([0.5, 0.75], [0.5, 0.75]), corner([0.9, 0.5], [1.0, 0.5])];
    let rectangle = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut renderer = Renderer::new(settings)?;
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    for _ in 0..frames {
        corners.iter_mut().for_each(Corner::turn);
        let [a, b, c] = corners.map(|corner| corner.uniform());
        let shader = Barycentric { a, b, c };
        let mut pass = Pass::new();
        pass.draw(&shader, Mesh { vertices: &rectangle, indices: Indices::Sequential }, DrawState::default());
        let mut target = Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(SIZE, SIZE) };
        renderer.render(&pass, &mut target)?;
        show(&pixels)?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("barycentric_spin.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.set_animated(FRAMES, 0)?;
    png.set_frame_delay(1, 60)?;
    let mut png = png.write_header()?;
    draw(Settings::default(), FRAMES, |pixels| -> Result<(), Box<dyn std::error::Error>> {
        Ok(png.write_image_data(pixels.as_flattened())?)
    })?;
    Ok(png.finish()?)
}
