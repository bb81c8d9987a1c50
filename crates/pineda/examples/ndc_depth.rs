//! Tutorial 2: triangles in normalised device coordinates, with the depth buffer that its section 3 needs z for.
//!
//! Two triangles pass through each other: each has a corner nearer to the eye than the other's, so whichever is drawn
//! last, neither may cover the other. Depth is interpolated with the same barycentric coordinates as the colours, and
//! each pixel keeps what is nearest.
//!
//! `cargo run --release -p pineda --example ndc_depth [OUT.png]`

use pineda::{
    ColorBuffer, DepthBuffer, DrawState, Error, Indices, Mesh, Pass, Renderer, Rgba, Settings, Target, Vec3, Vec4,
};
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

struct Corner {
    /// x right and y up from -1 to 1, z from 0 (near) to 1 (far).
    ndc: [f32; 3],
    color: [f32; 3],
}

const TRIANGLES: [Corner; 6] = [
    Corner { ndc: [-0.92, -0.62, 0.9], color: [0.35, 0.02, 0.10] },
    Corner { ndc: [0.80, -0.30, 0.1], color: [1.00, 0.62, 0.12] },
    Corner { ndc: [-0.36, 0.90, 0.5], color: [0.90, 0.10, 0.16] },
    Corner { ndc: [0.92, -0.78, 0.9], color: [0.03, 0.05, 0.25] },
    Corner { ndc: [0.46, 0.86, 0.5], color: [0.08, 0.28, 0.75] },
    Corner { ndc: [-0.86, -0.06, 0.1], color: [0.25, 0.90, 0.80] },
];

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut depth = vec![0.0; pixels.len()];
    let mut pass = Pass::new();
    pass.clear_color = Some([0.01, 0.01, 0.015, 1.0]);
    pass.draw_with(
        Mesh { vertices: &TRIANGLES, indices: Indices::Sequential },
        DrawState::default(), // clip space, of which NDC is the part with w = 1; nearer fragments win
        |corner: &Corner| {
            let [x, y, z] = corner.ndc;
            (Vec4::from([x, y, z, 1.0]), Vec3::from(corner.color))
        },
        |f| Rgba::opaque(f.varyings()),
    );
    let color = ColorBuffer::Rgba8Srgb(&mut pixels);
    let mut target = Target { color, depth: DepthBuffer::D32F(&mut depth), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("ndc_depth.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
