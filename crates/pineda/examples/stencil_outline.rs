//! An outline around a shape, as editors show what is selected: the stencil buffer remembers where the shape is.
//!
//! First the shape is drawn, and every pixel that it shows is marked with 1. Then it is drawn again in one colour, each vertex pushed out along its
//! normal, and only where there is no mark.
//!
//! `cargo run --release -p pineda --example stencil_outline [OUT.png]`

use pineda::*;
use std::f32::consts::{PI, TAU};
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// A position on a torus; its normal.
type Vertex = ([f32; 3], [f32; 3]);

varyings! { struct Lit { normal: Vec3 } }

/// Lambert's law.
struct Clay {
    camera: Mat4,
}

#[shader]
impl Shader for Clay {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Lit<L>;

    fn vertex(&self, &(position, normal): &Vertex) -> (Vec4, Lit) {
        (self.camera * Vec3::from(position).extend(1.0), Lit { normal: normal.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let light = f.normal.normalize().dot([0.36, 0.48, 0.8]).max(0.0);
        Rgba::opaque(f.splat([0.8, 0.35, 0.2]) * (0.1 + 0.9 * light))
    }
}

/// One colour, pushed out along the normals.
struct Outline {
    camera: Mat4,
    thickness: f32,
}

#[shader]
impl Shader for Outline {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = ();

    fn vertex(&self, &(position, normal): &Vertex) -> (Vec4, ()) {
        let pushed = Vec3::from(position) + Vec3::from(normal) * self.thickness;
        (self.camera * pushed.extend(1.0), ())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::opaque(f.splat([1.0, 0.75, 0.0]))
    }
}

fn torus() -> Vec<Vertex> {
    let (along, around) = (64, 24);
    let vertex = |i: usize, j: usize| {
        let (t, a) = (i as f32 / along as f32 * TAU, j as f32 / around as f32 * TAU + PI);
        // libm's, not std's: the same bits on every machine.
        let ([ct, st], [ca, sa]) = ([libm::cosf(t), libm::sinf(t)], [libm::cosf(a), libm::sinf(a)]);
        let normal = [ct * ca, sa, st * ca];
        ([ct + 0.35 * normal[0], 0.35 * normal[1], st + 0.35 * normal[2]], normal)
    };
    let corners = [[0, 0], [0, 1], [1, 1], [0, 0], [1, 1], [1, 0]];
    let cells = (0..along * around).map(|k| (k / around, k % around));
    cells.flat_map(|(i, j)| corners.map(|[a, b]| vertex(i + a, j + b))).collect()
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let camera = Mat4::perspective(0.7, 1.0, 0.1, 20.0) * Mat4::look_at([0.0, 2.6, 3.4], [0.0; 3], [0.0, 1.0, 0.0]);
    let vertices = torus();
    let mesh = Mesh { vertices: &vertices, indices: Indices::Sequential };
    let mark = StencilFace { pass: StencilOperation::Replace, reference: 1, ..StencilFace::IGNORE };
    let unmarked = StencilFace { compare: Compare::NotEqual, ..mark };
    let state = |face| DrawState { stencil: Some(StencilState::both(face)), ..DrawState::default() };

    let (clay, outline) = (Clay { camera }, Outline { camera, thickness: 0.04 });
    let mut pass = Pass::new();
    pass.clear_color = Some([0.02, 0.03, 0.05, 1.0]);
    pass.draw(&clay, mesh, state(mark));
    pass.draw(&outline, mesh, DrawState { depth: DepthState::OFF, ..state(unmarked) });
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("stencil_outline.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
