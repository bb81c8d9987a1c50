//! Instancing: a drop has fallen on a floor of 6,400 columns.
//!
//! One cube of eight vertices, as one strip of fourteen indices, is drawn once for each column. What is different from column
//! to column is the instance's: its place on the floor. The rest follows in the vertex stage, where the ripple lifts the cube; and a face's normal
//! follows from how the position changes across the picture, so that no vertex needs to be there once for each face.
//!
//! `cargo run --release -p pineda --example instancing [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Columns along each side of the floor.
const SIDE: usize = 80;

/// The cube's corners are the numbers 0 to 7, their bits x, y and z.
const CORNERS: [u8; 8] = [0, 1, 2, 3, 4, 5, 6, 7];
const STRIP: [u8; 14] = [6, 7, 4, 5, 1, 7, 3, 6, 2, 4, 0, 1, 2, 3];

varyings! {
    struct Surface {
        place: Vec3,
        #[flat]
        lift: Real,
    }
}

struct Ripple {
    camera: Mat4,
}

#[shader]
impl Shader for Ripple {
    type Vertex = Instanced<u8, [f32; 2]>;
    type Varyings<L: Lanes> = Surface<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, v: &Self::Vertex) -> (Vec4, Surface) {
        let [x, y, z] = [0, 1, 2].map(|axis| f32::from(v.vertex >> axis & 1));
        let [left, back] = v.instance;
        let away = (left * left + back * back).sqrt();
        let lift = Real::from(away * 1.1).cos() * 2.4 / (1.0 + 0.12 * away);
        let place = Vec3::new((left + 0.9 * x).into(), (lift + 3.0) * y, (back + 0.9 * z).into());
        (self.camera * place.extend(1.0), Surface { place, lift })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let normal = f.dy().place.cross(f.dx().place).normalize();
        let light = 0.25 + 0.75 * normal.dot([0.48, 0.8, 0.36]).max(0.0);
        let color = f.splat([0.0, 0.06, 0.30]).mix([0.35, 0.90, 0.75], (f.lift * 0.4 + 0.4).clamp(0.0, 1.0));
        Rgba::opaque(color * light * (f.place.y * 0.2 + 0.3).min(1.0))
    }
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let middle = SIDE as f32 / 2.0;
    let columns: Vec<[f32; 2]> =
        (0..SIDE * SIDE).map(|k| [(k % SIDE) as f32 - middle, (k / SIDE) as f32 - middle]).collect();
    let view = Mat4::look_at([22.0, 24.0, 34.0], [0.0, 0.0, 3.0], [0.0, 1.0, 0.0]);
    let ripple = Ripple { camera: Mat4::perspective(0.8, 1.0, 1.0, 200.0) * view };
    let state = DrawState {
        topology: PrimitiveTopology::TriangleStrip,
        cull: Cull::Back,
        front_face: FrontFace::Clockwise,
        ..DrawState::default()
    };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.01, 0.03, 0.08, 1.0]);
    pass.draw_instanced(&ripple, Mesh { vertices: &CORNERS, indices: Indices::U8(&STRIP) }, &columns, state);
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("instancing.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
