//! Image warping: a picture on a mesh whose vertices have been moved.
//!
//! The mesh is a grid that is twisted around its middle, and swollen there; the picture goes where its cells go. Towards the rim it is squeezed in one direction and stretched in the other, which
//! is what anisotropic filtering is for. On the left the picture is filtered with it, on the right it is looked up texel by texel: what flickers there when the mesh moves.
//!
//! `cargo run --release -p pineda --example warp [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Texels of the picture, across and down.
const TEXELS: u32 = 1024;

/// Cells of the grid, across and down.
const CELLS: u32 = 64;

struct Warp<'a> {
    /// By how much the middle is turned, in radians.
    twist: f32,
    picture: &'a Texture2d<'a, Rgba8Srgb>,
    sampler: Sampler,
}

#[shader]
impl Shader for Warp<'_> {
    /// A place on the picture, 0 to 1.
    type Vertex = [f32; 2];
    type Varyings<L: Lanes> = Vec2<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, &uv: &[f32; 2]) -> (Vec4, Vec2) {
        let from_middle = Vec2::from(uv.map(|c| 2.0 * c - 1.0));
        // 1 in the middle, 0 from the circle on that touches the picture's sides.
        let near = (1.0 - from_middle.length()).max(0.0);
        let near = near * near * (3.0 - near * 2.0);
        let angle = near * self.twist;
        let (sin, cos) = (angle.sin(), angle.cos());
        let Vec2 { x, y } = from_middle * (near * 0.7 + 0.96);
        let place = Vec2::new(cos * x - sin * y, sin * x + cos * y);
        (Vec4::new(place.x, -place.y, Real::from(0.5), Real::from(1.0)), uv.into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        self.picture.sample(&self.sampler, f.dual())
    }
}

/// A sun over hills, on squared paper.
fn picture() -> Vec<[u8; 4]> {
    let texel = |k: u32| {
        let [x, y] = [k % TEXELS, k / TEXELS].map(|c| (c as f32 + 0.5) / TEXELS as f32);
        let hill = |middle: f32, top: f32, width: f32| y > top + (x - middle) * (x - middle) * width;
        let [dx, dy] = [x - 0.62, y - 0.36];
        let from_sun = (dx * dx + dy * dy).sqrt();
        let ray = ((dx.abs() - dy.abs()).abs() * 16.0).min(dx.abs().min(dy.abs()) * 22.0);
        let color = match () {
            () if hill(0.25, 0.62, 0.8) => [46, 92, 58],
            () if hill(0.85, 0.55, 0.6) => [66, 128, 72],
            () if from_sun < 0.11 => [255, 214, 92],
            () if from_sun < 0.25 && ray < 0.35 => [255, 190, 80],
            () => [120, 178, 226],
        };
        let line = |c: f32| (c * 32.0 - (c * 32.0).floor() - 0.5).abs() > 0.44;
        let [r, g, b] = if line(x) || line(y) { color.map(|c: u8| c - c / 3) } else { color };
        [r, g, b, 255]
    };
    (0..TEXELS * TEXELS).map(texel).collect()
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let picture = Texture2d::new(TEXELS, TEXELS, picture())?.with_mips()?;
    let sampler = Sampler { wrap: [Wrap::Clamp; 3], ..Sampler::ANISOTROPIC };
    let filtered = Warp { twist: 2.6, picture: &picture, sampler };
    let texel_by_texel = Warp { sampler: Sampler { wrap: [Wrap::Clamp; 3], ..Sampler::NEAREST }, ..filtered };
    let corner = |k: u32| [k % (CELLS + 1), k / (CELLS + 1)].map(|c| c as f32 / CELLS as f32);
    let grid: Vec<[f32; 2]> = (0..(CELLS + 1) * (CELLS + 1)).map(corner).collect();
    let cell = |k: u32| {
        let first = k / CELLS * (CELLS + 1) + k % CELLS;
        [first, first + CELLS + 1, first + 1, first + 1, first + CELLS + 1, first + CELLS + 2]
    };
    let indices: Vec<u32> = (0..CELLS * CELLS).flat_map(cell).collect();
    let mut pass = Pass::new();
    pass.clear_color = Some([0.02, 0.02, 0.025, 1.0]);
    for (warp, x) in [(&filtered, 0), (&texel_by_texel, SIZE as i32 / 2)] {
        let half = Scissor { x, y: 0, width: SIZE / 2, height: SIZE };
        let state = DrawState { scissor: Some(half), ..DrawState::default() };
        pass.draw(warp, Mesh { vertices: &grid, indices: Indices::U32(&indices) }, state);
    }
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("warp.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
