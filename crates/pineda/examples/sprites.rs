//! Sprites from an atlas: one texture with all the pictures, one rectangle for each sprite.
//!
//! Where a sprite lies, how it is turned and which picture it shows is its instance's. The atlas's levels are made with colours weighted by alpha, so that small leaves
//! keep their colour to the border instead of turning dark.
//!
//! `cargo run --release -p pineda --example sprites [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Texels of a picture in the atlas, and pictures along each side.
const PICTURE: u32 = 64;
const SIDE: u32 = 2;

/// Where a sprite is.
#[derive(Clone, Copy)]
pub struct Sprite {
    middle: [f32; 2],
    size: f32,
    /// Cosine and sine.
    turned: [f32; 2],
    /// Column and row in the atlas.
    picture: [f32; 2],
    tint: [f32; 3],
}

varyings! {
    struct Leaf {
        uv: Vec2,
        #[flat]
        tint: Vec3,
    }
}

struct Sprites<'a> {
    atlas: Texture2d<'a>,
    sampler: Sampler,
}

#[shader]
impl Shader for Sprites<'_> {
    type Vertex = Instanced<[f32; 2], Sprite>;
    type Varyings<L: Lanes> = Leaf<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, v: &Self::Vertex) -> (Vec4, Leaf) {
        let (sprite, [x, y]) = (&v.instance, v.vertex);
        let [cos, sin] = sprite.turned;
        let half = 0.5 * sprite.size;
        let place = [(cos * x - sin * y) * half + sprite.middle[0], (sin * x + cos * y) * half + sprite.middle[1]];
        let uv = [x, y].map(|s| 0.5 * s + 0.5);
        let uv = [(sprite.picture[0] + uv[0]) / SIDE as f32, (sprite.picture[1] + uv[1]) / SIDE as f32];
        ([place[0], place[1], 0.5, 1.0].into(), Leaf { uv: uv.into(), tint: sprite.tint.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let color = self.atlas.sample(&self.sampler, f.dual().uv);
        Rgba::new(color.rgb() * f.tint, color.a)
    }
}

/// Four leaves: an ellipse, one with a notched border, one of lobes, a drop; each with its veins.
fn atlas() -> Result<Texture2d<'static>, Error> {
    let size = SIDE * PICTURE;
    let texel = |k: u32| {
        let (x, y) = (k % size, k / size);
        let picture = x / PICTURE + SIDE * (y / PICTURE);
        let [u, v] = [x, y].map(|s| 2.0 * ((s % PICTURE) as f32 + 0.5) / PICTURE as f32 - 1.0);
        let along = (0.92 - v * v).max(0.0).sqrt();
        let wave = |n: f32| (v * n - (v * n).floor() - 0.5).abs();
        let width = match picture {
            0 => 0.55 * along,
            1 => along * (0.5 + 0.25 * wave(6.0)),
            2 => along * (0.25 + 1.1 * wave(2.0)),
            _ => 0.6 * along * (0.5 + 0.5 * v),
        };
        let is_vein = u.abs() < 0.03 || (u.abs() * 0.8 + v) * 6.0 - ((u.abs() * 0.8 + v) * 6.0).floor() < 0.12;
        match (u.abs() < width, is_vein) {
            (true, true) => [235, 235, 200, 255],
            (true, false) => [200, 205, 190, 255],
            (false, _) => [0, 0, 0, 0],
        }
    };
    Texture2d::new(size, size, (0..size * size).map(texel).collect::<Vec<_>>())?.with_alpha_weighted_mips()
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    const TINTS: [[f32; 3]; 4] = [[0.9, 0.35, 0.05], [0.8, 0.1, 0.05], [0.95, 0.65, 0.1], [0.35, 0.4, 0.08]];
    let leaves: Vec<Sprite> = (0..700u32)
        .map(|k| {
            let hash = (k + 1).wrapping_mul(0x9e37_79b1).wrapping_mul(k | 1);
            let part = |bits: u32| (hash >> bits & 255) as f32 / 255.0;
            let (cos, sin) = (2.0 * part(3) - 1.0, 2.0 * part(11) - 1.0);
            let length = (cos * cos + sin * sin).sqrt().max(0.01);
            let near = k as f32 / 700.0;
            Sprite {
                middle: [part(24) * 512.0, part(16) * 512.0],
                size: 8.0 + 110.0 * near * near * near,
                turned: [cos / length, sin / length],
                picture: [(hash >> 5 & 1) as f32, (hash >> 6 & 1) as f32],
                tint: TINTS[(hash >> 13) as usize % 4].map(|c| c * (0.35 + 0.65 * near)),
            }
        })
        .collect();
    let sprites = Sprites { atlas: atlas()?, sampler: Sampler { wrap: [Wrap::Clamp; 3], ..Sampler::TRILINEAR } };
    let rectangle = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mesh = Mesh { vertices: &rectangle, indices: Indices::U8(&[0, 1, 2, 0, 2, 3]) };
    let state = DrawState { space: Space::Raster, blend: Blend::ALPHA, depth: DepthState::OFF, ..DrawState::default() };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.03, 0.022, 0.015, 1.0]);
    pass.draw_instanced(&sprites, mesh, &leaves, state);
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("sprites.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
