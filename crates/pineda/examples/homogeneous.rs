//! Tutorial 3: triangles in homogeneous coordinates, one of them with a corner behind the eye.
//!
//! The page's first triangle has w = 1 throughout; its point is that the same edge functions work for any w. The floor
//! here is a single triangle: two corners far ahead, and one *behind* the eye, where w is negative and dividing by it
//! would put the corner above the horizon. The rasterizer cuts at the near plane, where w is still positive, so
//! that the floor runs on below the picture's border, and its tiles come out in perspective.
//!
//! `cargo run --release -p pineda --example homogeneous [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Corners on the floor y = 0, as (x, z): far left, far right, and behind the eye, which stands at (0, 0).
const FLOOR: [[f32; 2]; 3] = [[-160.0, -100.0], [160.0, -100.0], [0.0, 40.0]];

/// The page's triangle, (x, y, w), with y upwards here; it floats before the horizon.
const HELLO: [[f32; 3]; 3] = [[-0.5, 0.2, 1.0], [0.5, 0.2, 1.0], [0.0, 0.9, 1.0]];

const SKY: [f32; 3] = [0.55, 0.70, 0.90];

struct Floor {
    camera: Mat4,
}

#[shader]
impl Shader for Floor {
    type Vertex = [f32; 2];
    type Varyings<L: Lanes> = Vec2<L>;

    fn vertex(&self, &[x, z]: &[f32; 2]) -> (Vec4, Vec2) {
        (self.camera * Vec4::from([x, 0.0, z, 1.0]), [x, z].into())
    }

    /// Tiles of one unit, fading into the sky with the distance.
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let place = f.varyings();
        let odd = ((place.x.floor() + place.y.floor()) * 0.5).fract().gt(0.25);
        let tile = odd.select([0.10, 0.16, 0.22], f.splat([0.75, 0.66, 0.50]));
        let distance = place.length();
        let haze = distance / (distance + 9.0);
        Rgba::opaque(tile.mix(SKY, haze * haze))
    }
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let view = Mat4::look_at([0.0, 1.0, 0.0], [0.0, 0.65, -1.0], [0.0, 1.0, 0.0]);
    let floor = Floor { camera: Mat4::perspective(1.1, 1.0, 0.1, 200.0) * view };
    let mut pass = Pass::new();
    pass.clear_color = Some([SKY[0], SKY[1], SKY[2], 1.0]);
    pass.draw(&floor, Mesh { vertices: &FLOOR, indices: Indices::Sequential }, DrawState::default());
    pass.draw_with(
        Mesh { vertices: &HELLO, indices: Indices::Sequential },
        DrawState::default(),
        |&[x, y, w]| (Vec4::from([x, y, 0.5, w]), ()),
        |f| Rgba::opaque(f.splat([0.80, 0.04, 0.04])),
    );
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("homogeneous.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
