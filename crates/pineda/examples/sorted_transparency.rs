//! Transparency that depends on order: panes of coloured glass, drawn from the farthest to the nearest.
//!
//! "Over" is not commutative: whichever pane is drawn last looks as if it were in front. So panes are sorted by their distance from the eye,
//! the farthest first. What is opaque comes before all of them, and panes test depth but do not write it, so that the pillar hides what
//! stands behind it. The left half of the picture is drawn in the order of the list, for comparison: there it is wrong.
//!
//! `cargo run --release -p pineda --example sorted_transparency [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;
const EYE: [f32; 3] = [1.5, 1.2, 5.0];

/// A rectangle that stands upright: where its foot is, its turn about the vertical, half its width, its height, its colour and alpha.
struct Pane {
    foot: [f32; 2],
    turn: [f32; 2],
    height: f32,
    color: [f32; 4],
}

const PILLAR: Pane = Pane { foot: [0.1, -0.2], turn: [0.15, -0.05], height: 2.2, color: [0.5, 0.45, 0.4, 1.0] };
const PANES: [Pane; 4] = [
    Pane { foot: [0.0, 1.6], turn: [0.7, 0.1], height: 0.9, color: [0.9, 0.1, 0.1, 0.6] },
    Pane { foot: [-0.3, -1.5], turn: [1.3, -0.1], height: 1.9, color: [0.1, 0.2, 0.9, 0.6] },
    Pane { foot: [0.3, 0.8], turn: [0.8, -0.3], height: 1.3, color: [0.1, 0.7, 0.1, 0.6] },
    Pane { foot: [0.0, -0.6], turn: [1.0, 0.2], height: 1.6, color: [0.9, 0.8, 0.1, 0.6] },
];

impl Pane {
    fn triangles(&self) -> [[f32; 3]; 6] {
        let ([x, z], [dx, dz]) = (self.foot, self.turn);
        let corner = |side: f32, y: f32| [x + side * dx, y, z + side * dz];
        let [a, b] = [corner(-1.0, 0.0), corner(1.0, 0.0)];
        let [c, d] = [corner(1.0, self.height), corner(-1.0, self.height)];
        [a, b, c, a, c, d]
    }

    /// Its square, which sorts as well.
    fn distance(&self) -> f32 {
        let [dx, dz] = [self.foot[0] - EYE[0], self.foot[1] - EYE[2]];
        dx * dx + dz * dz
    }
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let camera = Mat4::perspective(0.7, 0.5, 0.1, 20.0) * Mat4::look_at(EYE, [0.1, 0.8, 0.0], [0.0, 1.0, 0.0]);
    let half = SIZE as f32 / 2.0;
    let halves = [0.0, half].map(|x| Viewport { x, width: half, ..Viewport::whole(SIZE, SIZE) });
    let mut sorted: Vec<&Pane> = PANES.iter().collect();
    sorted.sort_by(|a, b| b.distance().total_cmp(&a.distance()));
    let orders = [PANES.iter().collect(), sorted];

    let opaque = DrawState::default();
    let glass = DrawState {
        blend: Blend::ALPHA,
        depth: DepthState { write: false, ..DepthState::default() },
        ..DrawState::default()
    };
    let mut draws = Vec::new();
    for (viewport, panes) in halves.into_iter().zip(orders) {
        let panes = panes.into_iter().map(|pane| (pane, glass));
        for (pane, state) in [(&PILLAR, opaque)].into_iter().chain(panes) {
            draws.push((pane.triangles(), pane.color, DrawState { viewport: Some(viewport), ..state }));
        }
    }

    let mut pass = Pass::new();
    pass.clear_color = Some([0.9, 0.9, 0.9, 1.0]);
    for (triangles, color, state) in &draws {
        pass.draw_with(
            Mesh { vertices: triangles, indices: Indices::Sequential },
            *state,
            move |&[x, y, z]: &[f32; 3]| (camera * Vec4::from([x, y, z, 1.0]), ()),
            move |f| Rgba::new(f.splat([color[0], color[1], color[2]]), color[3]),
        );
    }
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("sorted_transparency.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
