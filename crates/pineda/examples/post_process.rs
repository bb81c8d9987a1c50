//! Post-processing: a picture is drawn, and is then the texture of the next one.
//!
//! Two passes. Lamps go into a picture of half floats, brighter than a screen can be. Its smaller levels are a glow around them; everything is seen through a lens that bends its border, and
//! brought back to what a screen shows. Between the passes nothing is copied but for the levels: a target's buffer is a texture as it is.
//!
//! `cargo run --release -p pineda --example post_process [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Points of light: position in pixels, size, colour.
struct Lamps;

type Lamp = ([f32; 2], f32, [f32; 3]);

#[shader]
impl Shader for Lamps {
    type Vertex = Lamp;
    type Varyings<L: Lanes> = Vec3<L>;
    const POINT_COORD: bool = true;

    fn vertex(&self, &([x, y], _, color): &Lamp) -> (Vec4, Vec3) {
        ([x, y, 0.5, 1.0].into(), color.into())
    }

    fn point_size(&self, &(_, size, _): &Lamp) -> Option<f32> {
        Some(size)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let from_middle = (f.point_coord() - f.splat([0.5, 0.5])).length() * 2.0;
        Rgba::new(f.varyings(), (8.0 - 8.0 * from_middle).clamp(0.0, 1.0))
    }
}

/// The whole picture, by one triangle.
struct Lens<'a> {
    picture: Texture2d<'a, Rgba16F>,
}

#[shader]
impl Shader for Lens<'_> {
    type Vertex = [f32; 2];
    type Varyings<L: Lanes> = Vec2<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, Vec2) {
        ([x, y, 0.5, 1.0].into(), [x, -y].into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let from_middle = f.dual();
        // A barrel: the farther from the middle, the more is brought in.
        let bent = from_middle * (0.8 + 0.2 * from_middle.length_squared());
        let uv = bent * 0.5 + 0.5;
        let sampler = &Sampler { wrap: [Wrap::Border; 3], ..Sampler::TRILINEAR };
        let mut light = self.picture.sample(sampler, uv).rgb();
        for level in [2.0, 3.0, 4.0, 5.0, 6.0] {
            light += self.picture.sample_level(sampler, uv.value(), level).rgb() * 0.12;
        }
        // More light than a screen has is brought back smoothly (Reinhard 2002).
        let shade = 1.0 - 0.25 * from_middle.value().length_squared();
        Rgba::opaque(light / (light + 1.0) * shade)
    }
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let mut renderer = Renderer::new(settings)?;
    let lamps: Vec<Lamp> = (0..14 * 14)
        .map(|k: u32| {
            let hash = k.wrapping_mul(0x9e37_79b1) ^ k << 7;
            let jitter = |bits: u32| (hash >> bits & 15) as f32;
            let place = [(k % 14) as f32 * 36.0 + 14.0 + jitter(8), (k / 14) as f32 * 36.0 + 14.0 + jitter(20)];
            let color = [[9.0, 3.0, 0.6], [0.5, 2.0, 8.0], [1.2, 1.0, 0.8], [0.3, 0.1, 0.4]][(hash >> 28) as usize % 4];
            (place, 5.0 + 0.8 * jitter(12), color)
        })
        .collect();
    let state = DrawState {
        topology: PrimitiveTopology::PointList,
        space: Space::Raster,
        blend: Blend::ALPHA,
        ..DrawState::default()
    };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.004, 0.006, 0.015, 1.0]);
    pass.draw(&Lamps, Mesh { vertices: &lamps, indices: Indices::Sequential }, state);
    let mut bright = vec![[0; 4]; (SIZE * SIZE) as usize];
    renderer.render(&pass, &mut Target { color: ColorBuffer::Rgba16F(&mut bright), ..Target::new(SIZE, SIZE) })?;

    let lens = Lens { picture: Texture2d::new(SIZE, SIZE, &bright)?.with_mips()? };
    let everything = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
    let mut pass = Pass::new();
    pass.draw(&lens, Mesh { vertices: &everything, indices: Indices::Sequential }, DrawState::default());
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    renderer.render(&pass, &mut Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) })?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("post_process.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
