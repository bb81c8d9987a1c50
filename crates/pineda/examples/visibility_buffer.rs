//! Deferred shading from the visibility buffer: an island, shaded by a plain loop over the picture.
//!
//! The pass runs no fragment stage at all. It leaves the number of the triangle that each pixel shows, and where in the triangle the pixel's centre lies: four
//! words a pixel, whatever the vertices carry. With these, who has the mesh can find out anything else, in code of its own and with any library, once for each
//! pixel. (Burns and Hunt, "The Visibility Buffer", JCGT 2013.)
//!
//! `cargo run --release -p pineda --example visibility_buffer [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Squares along each side of the ground.
const SIDE: u32 = 160;

/// Height of the ground, between a shore and hills; below 0 there is water.
fn height(x: f32, z: f32) -> f32 {
    let wave = |a: f32, b: f32, shift: f32| libm::sinf(a * x + b * z + shift);
    let hills = wave(3.1, 1.3, 0.4) + wave(-1.9, 3.7, 2.0) + 0.5 * wave(6.3, -4.1, 1.0) + 0.25 * wave(9.7, 11.3, 0.0);
    0.34 + 0.13 * hills - 0.42 * (x * x + z * z)
}

/// The ground, and two triangles of water.
fn island() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let at = |k: u32| 3.0 * k as f32 / SIDE as f32 - 1.5;
    let places = (0..=SIDE).flat_map(|row| (0..=SIDE).map(move |column| [at(column), at(row)]));
    let mut points: Vec<[f32; 3]> = places.map(|[x, z]| [x, height(x, z), z]).collect();
    let squares = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| row * (SIDE + 1) + column));
    let mut triangles: Vec<[u32; 3]> =
        squares.flat_map(|a| [[a, a + SIDE + 1, a + SIDE + 2], [a, a + SIDE + 2, a + 1]]).collect();
    let first = points.len() as u32;
    points.extend([[-9.0, 0.0, -9.0], [-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0]]);
    triangles.extend([[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(|k| first + k)));
    (points, triangles)
}

/// Colour of a place, in linear light: this could be anything.
fn shade([x, y, z]: [f32; 3], is_water: bool) -> [f32; 3] {
    let step = 0.002;
    let [dx, dz] = [height(x + step, z) - height(x - step, z), height(x, z + step) - height(x, z - step)];
    let (mut normal, mut color) = ([-dx, 2.0 * step, -dz], [0.10, 0.20, 0.05]);
    if is_water {
        // Darker with the depth below.
        let shallow = (1.0 + 6.0 * height(x, z)).clamp(0.0, 1.0);
        (normal, color) = ([0.0, 1.0, 0.0], [0.02, 0.12, 0.20].map(|c: f32| c + 0.16 * shallow * shallow));
    } else if y < 0.035 {
        color = [0.62, 0.50, 0.28];
    } else if y > 0.42 {
        color = [0.75, 0.77, 0.80];
    } else if y > 0.30 {
        color = [0.23, 0.19, 0.15];
    }
    let [a, b, c] = normal;
    let light = (0.62 * a + 0.62 * b + 0.48 * c).max(0.0) / (a * a + b * b + c * c).sqrt();
    // A contour line for each step of height, as thin as the ground is flat.
    let above = 20.0 * y;
    let line = if !is_water && (above - above.round()).abs() < 0.07 { 0.72 } else { 1.0 };
    color.map(|channel| channel * line * (0.10 + 1.10 * light))
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let (points, triangles) = island();
    let view = Mat4::look_at([0.9, 1.7, 2.5], [0.0, 0.05, 0.1], [0.0, 1.0, 0.0]);
    let camera = Mat4::perspective(0.75, 1.0, 0.1, 20.0) * view;
    let mut pass = Pass::new();
    pass.draw_with(
        Mesh { vertices: &points, indices: Indices::U32(triangles.as_flattened()) },
        DrawState { color_mask: ColorMask::NONE, ..DrawState::default() },
        |&point| (camera * Vec3::from(point).extend(1.0), ()),
        |f| Rgba::gray(f.splat(0.0)),
    );
    let size = (SIZE * SIZE) as usize;
    let (mut ids, mut weights) = (vec![NO_ID; size], vec![[0.0; 3]; size]);
    let mut target =
        Target { triangle_ids: Some(&mut ids), barycentrics: Some(&mut weights), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;

    let color = |(&id, weights): (&u32, &[f32; 3])| {
        let Some(triangle) = triangles.get(id as usize) else { return [0.55, 0.70, 0.90] };
        let corners = triangle.map(|k| points[k as usize]);
        let place = [0, 1, 2]
            .map(|axis| weights[0] * corners[0][axis] + weights[1] * corners[1][axis] + weights[2] * corners[2][axis]);
        shade(place, id >= 2 * SIDE * SIDE)
    };
    // By the square root, which is near enough to sRGB's curve for an island.
    let encode = |x: f32| (255.0 * x.sqrt()).round() as u8;
    let colors = ids.iter().zip(&weights).map(color);
    Ok(colors.map(|[r, g, b]| [encode(r), encode(g), encode(b), 255]).collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("visibility_buffer.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
