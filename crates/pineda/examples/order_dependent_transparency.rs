//! What depends on the order of draws, and what does not: three panes of glass on top of each other.
//!
//! Each column draws the same three panes in another order; they differ in nothing else, and none is nearer than the others. The rows blend in three ways:
//!
//! - "Over" ([`Blend::ALPHA`]): the pane that is drawn last looks as if it lay on top. Only one order is right, the one from back to front, which
//!   the example `sorted_transparency` sorts by.
//! - Light upon light ([`Blend::ADD`]) and filter behind filter ([`Blend::MULTIPLY`]) ask for no order: sums and products are the same
//!   either way, up to their rounding.
//!
//! A pass draws in the order in which it was told to, with any number of threads: so whatever the order makes of a picture, it makes it every time.
//!
//! `cargo run --release -p pineda --example order_dependent_transparency [OUT.png]`

use pineda::*;
use std::f32::consts::TAU;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;
/// Of each of 3 x 3 pictures.
const CELL: f32 = SIZE as f32 / 3.0;

const ORDERS: [[usize; 3]; 3] = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
const ROWS: [(Blend, [f32; 3], [[f32; 4]; 3]); 3] = [
    (Blend::ALPHA, [0.85; 3], [[0.80, 0.05, 0.08, 0.85], [0.95, 0.65, 0.02, 0.85], [0.03, 0.15, 0.60, 0.85]]),
    (Blend::ADD, [0.01; 3], [[0.60, 0.05, 0.05, 0.0], [0.05, 0.45, 0.08, 0.0], [0.08, 0.12, 0.75, 0.0]]),
    (Blend::MULTIPLY, [0.90; 3], [[0.05, 0.60, 0.80, 1.0], [0.80, 0.08, 0.45, 1.0], [0.95, 0.80, 0.05, 1.0]]),
];

/// A fan around a place, given in pixels.
fn disc([x, y]: [f32; 2], radius: f32) -> Vec<[f32; 2]> {
    let corner = |k: usize| {
        let angle = k as f32 / 64.0 * TAU;
        // libm's, not std's: the same bits on every machine.
        [x + radius * libm::cosf(angle), y + radius * libm::sinf(angle)]
    };
    (0..64).map(corner).collect()
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let flat = DrawState {
        space: Space::Raster,
        topology: PrimitiveTopology::TriangleFan,
        depth: DepthState::OFF,
        ..DrawState::default()
    };
    let mut draws = Vec::new();
    for (row, (blend, ground, colors)) in ROWS.into_iter().enumerate() {
        let [top, bottom] = [row, row + 1].map(|row| row as f32 * CELL);
        let [r, g, b] = ground;
        draws.push((vec![[0.0, top], [512.0, top], [512.0, bottom], [0.0, bottom]], [r, g, b, 1.0], flat));
        for (column, order) in ORDERS.into_iter().enumerate() {
            let middle = [column, row].map(|at| (at as f32 + 0.5) * CELL);
            for pane in order {
                let angle = (pane as f32 / 3.0 - 0.25) * TAU;
                let place = [middle[0] + 30.0 * libm::cosf(angle), middle[1] + 8.0 + 30.0 * libm::sinf(angle)];
                draws.push((disc(place, 44.0), colors[pane], DrawState { blend, ..flat }));
            }
        }
    }
    let mut pass = Pass::new();
    for (corners, [r, g, b, a], state) in &draws {
        let mesh = Mesh { vertices: corners, indices: Indices::Sequential };
        let place = |&[x, y]: &[f32; 2]| (Vec4::from([x, y, 0.0, 1.0]), ());
        pass.draw_with(mesh, *state, place, move |f| Rgba::new(f.splat([*r, *g, *b]), *a));
    }
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("order_dependent_transparency.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
