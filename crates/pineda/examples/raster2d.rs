//! Tutorials 1 and 4: a triangle in raster space, its corners red, green and blue, as PPM and as PNG.
//!
//! The page's program tests three edge functions at every pixel of the picture. Here the rasterizer does it, in exact
//! integers and with the top-left rule that the page leaves out; the rest is the same: a corner has a place in pixels
//! (x right, y down) and a colour, and each pixel's colour is the mean of the corners', weighted by its barycentric
//! coordinates.
//!
//! `cargo run --release -p pineda --example raster2d [OUT.ppm]`

use pineda::{ColorBuffer, DrawState, Error, Indices, Mesh, Pass, Renderer, Rgba, Settings, Space, Target, Vec3, Vec4};
use std::fs::{self, File};
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

struct Corner {
    position: [f32; 2],
    color: [f32; 3],
}

const TRIANGLE: [Corner; 3] = [
    Corner { position: [491.407, 411.407], color: [1.0, 0.0, 0.0] },
    Corner { position: [148.593, 68.5928], color: [0.0, 1.0, 0.0] },
    Corner { position: [148.593, 411.407], color: [0.0, 0.0, 1.0] },
];

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut pass = Pass::new();
    pass.clear_color = Some([0.0, 0.0, 0.0, 1.0]);
    pass.draw_with(
        Mesh { vertices: &TRIANGLE, indices: Indices::Sequential },
        DrawState { space: Space::Raster, ..DrawState::default() },
        |corner: &Corner| {
            let [x, y] = corner.position;
            (Vec4::from([x, y, 0.0, 1.0]), Vec3::from(corner.color))
        },
        |f| Rgba::opaque(f.varyings()),
    );
    let mut target = Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("raster2d.ppm".into(), PathBuf::from);
    let pixels = draw(Settings::default())?;

    let mut ppm = format!("P6\n{SIZE} {SIZE}\n255\n").into_bytes();
    ppm.extend(pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
    fs::write(&path, ppm)?;

    let mut png = png::Encoder::new(File::create(path.with_extension("png"))?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(pixels.as_flattened())?;
    Ok(())
}
