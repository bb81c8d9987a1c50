//! A depth prepass: depth first, then colour where the depth is equal.
//!
//! Opaque draws need none here: they are shaded once per visible pixel anyway. Blended ones do, if only the nearest layer is to be seen: on
//! the left a translucent ring of beads shows its own far side through its near side; on the right a prepass has filled the depth
//! buffer, without colour, and [`Compare::Equal`] lets only the nearest surface through. Both draws run the same vertex stage on the same vertices, so that
//! their depths are the same to the bit: that is what makes `Equal` safe.
//!
//! `cargo run --release -p pineda --example depth_prepass [OUT.png]`

use pineda::*;
use std::f32::consts::TAU;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

varyings! { struct Lit { normal: Vec3 } }

struct Ghost {
    camera: Mat4,
}

#[shader]
impl Shader for Ghost {
    type Vertex = ([f32; 3], [f32; 3]);
    type Varyings<L: Lanes> = Lit<L>;

    fn vertex(&self, &(position, normal): &Self::Vertex) -> (Vec4, Lit) {
        (self.camera * Vec3::from(position).extend(1.0), Lit { normal: normal.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let light = f.normal.normalize().dot([0.36, 0.48, 0.8]).max(0.0);
        Rgba::new(f.splat([0.3, 0.6, 1.0]) * (0.2 + 0.8 * light), 0.5)
    }
}

/// Octahedral beads on a ring: positions and flat normals.
fn beads() -> Vec<([f32; 3], [f32; 3])> {
    let mut vertices = Vec::new();
    for k in 0..14 {
        let t = k as f32 / 14.0 * TAU;
        let middle = [1.1 * libm::cosf(t), 0.0, 1.1 * libm::sinf(t)];
        for octant in 0..8 {
            let sign = [0, 1, 2].map(|axis| if octant >> axis & 1 == 0 { 0.4 } else { -0.4f32 });
            for axis in 0..3 {
                let mut position = middle;
                position[axis] += sign[axis];
                vertices.push((position, sign));
            }
        }
    }
    vertices
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let camera = Mat4::perspective(0.9, 0.5, 0.1, 20.0) * Mat4::look_at([0.0, 2.2, 3.6], [0.0; 3], [0.0, 1.0, 0.0]);
    let (shader, vertices) = (Ghost { camera }, beads());
    let mesh = Mesh { vertices: &vertices, indices: Indices::Sequential };
    let half = SIZE as f32 / 2.0;
    let [left, right] = [0.0, half].map(|x| DrawState {
        viewport: Some(Viewport { x, width: half, ..Viewport::whole(SIZE, SIZE) }),
        blend: Blend::ALPHA,
        ..DrawState::default()
    });

    let mut pass = Pass::new();
    pass.clear_color = Some([0.9, 0.85, 0.8, 1.0]);
    pass.draw(&shader, mesh, DrawState { depth: DepthState::OFF, ..left });
    pass.draw(&shader, mesh, DrawState { color_mask: ColorMask::NONE, ..right });
    pass.draw(&shader, mesh, DrawState { depth: DepthState { compare: Compare::Equal, write: false }, ..right });
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("depth_prepass.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
