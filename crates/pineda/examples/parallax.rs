//! Parallax occlusion mapping: a flat wall whose bricks stand out, hide each other, and throw shadows.
//!
//! A texture says how deep the surface lies at each texel. The fragment stage follows the ray of the eye into the wall, step by step, to where it first lies below the surface, and takes colour and
//! normal from there (Tatarchuk 2006, "Dynamic Parallax Occlusion Mapping with Approximate Soft Shadows"); a second walk, from there towards the lamp, finds the shadow. On the left the same
//! wall without depth: normals alone.
//!
//! `cargo run --release -p pineda --example parallax [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Texels of the maps, across and down.
const MAP: u32 = 256;

/// Steps along a ray into the wall, and back to the lamp.
const STEPS: u32 = 32;
const SHADOW_STEPS: u32 = 16;

const EYE: [f32; 3] = [-0.2, -2.1, 1.15];

varyings! {
    struct Wall {
        position: Vec3,
        uv: Vec2,
    }
}

#[derive(Clone, Copy)]
struct Bricks<'a> {
    camera: Mat4,
    lamp: [f32; 3],
    /// How deep the deepest texels lie; the wall is two units to a repetition of the texture.
    depth: f32,
    /// The normal, and the depth in alpha, 0 to 1.
    relief: &'a Texture2d<'a, Rgba8>,
    albedo: &'a Texture2d<'a, Rgba8Srgb>,
    sampler: Sampler,
}

#[shader]
impl Bricks<'_> {
    /// How deep the wall is at a place.
    fn depth_at<L: Lanes>(&self, at: Vec2<L>, dx: Vec2<L>, dy: Vec2<L>) -> Real<L> {
        self.relief.sample_grad(&Sampler::TRILINEAR, at, dx, dy).a
    }
}

#[shader]
impl Shader for Bricks<'_> {
    type Vertex = ([f32; 3], [f32; 2]);
    type Varyings<L: Lanes> = Wall<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, (position, uv): &Self::Vertex) -> (Vec4, Wall) {
        let position = Vec3::from(*position);
        (self.camera * position.extend(1.0), Wall { position, uv: (*uv).into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (dx, dy, start) = (f.dx().uv, f.dy().uv, f.uv);
        // By how much a ray moves on the texture while it goes as deep as the deepest texels. u is x / 2, v is -y / 2.
        let to_eye = -f.position + EYE;
        let along = Vec2::new(-to_eye.x, to_eye.y) * 0.5 * self.depth / to_eye.z;
        // How far the ray is above the surface at the last step that was, and where it has ended.
        let (mut above, mut reached) = (self.depth_at(start, dx, dy), f.splat(1.0));
        let mut is_below = above.le(0.0);
        reached = is_below.select(0.0, reached);
        for k in 1..=STEPS {
            let ray = k as f32 / STEPS as f32;
            let now = self.depth_at(start + along * ray, dx, dy) - ray;
            // Between two steps the surface is taken for straight.
            let crossing = (above / (above - now) - 1.0) / STEPS as f32 + ray;
            let ends = now.le(0.0) & !is_below;
            reached = ends.select(crossing, reached);
            is_below |= ends;
            above = is_below.select(above, now);
        }
        let at = start + along * reached;

        let place = f.position - to_eye * (reached * self.depth / to_eye.z);
        let to_lamp = -place + self.lamp;
        let back = Vec2::new(to_lamp.x, -to_lamp.y) * 0.5 * (reached * self.depth) / to_lamp.z;
        let mut hidden = f.splat(0.0);
        for k in 1..SHADOW_STEPS {
            let part = k as f32 / SHADOW_STEPS as f32;
            let over = reached * (1.0 - part) - self.depth_at(at + back * part, dx, dy);
            // What is far from the surface it falls on throws a softer shadow.
            hidden = hidden.max(over * (1.0 - part));
        }
        let shadow = (hidden * 8.0).clamp(0.0, 1.0) * if self.depth > 0.0 { 1.0 } else { 0.0 };

        let map = self.relief.sample_grad(&self.sampler, at, dx, dy).rgb() * 2.0 - 1.0;
        let light = map.normalize().dot(to_lamp.normalize()).max(0.0) * 8.0 / to_lamp.length_squared();
        let albedo = self.albedo.sample_grad(&self.sampler, at, dx, dy).rgb();
        Rgba::opaque(albedo * ([1.0, 0.85, 0.65] * (light * (1.0 - shadow)) + [0.03, 0.035, 0.05]))
    }
}

/// How deep a texel lies, 0 to 1, and its brick: four rows of two, every other row moved by half a brick.
fn depth(x: u32, y: u32) -> (f32, u32) {
    const HIGH: u32 = MAP / 8;
    const WIDE: u32 = MAP / 4;
    let row = y / HIGH;
    let shifted = (x + row % 2 * (WIDE / 2)) % MAP;
    let brick = row * 8 + shifted / WIDE;
    let from_border = |at: u32, size: u32| (at % size).min(size - 1 - at % size) as f32;
    let inside = from_border(shifted, WIDE).min(from_border(y, HIGH));
    let face = ((inside - 2.0) / 3.0).clamp(0.0, 1.0);
    let tilt = (brick * 37 % 16) as f32 / 60.0;
    let rough = (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca6b)).wrapping_mul(0xc2b2_ae35) >> 24;
    (1.0 - face * (1.0 - tilt) + rough as f32 / 255.0 * 0.03, brick)
}

/// Normals with depths, and colours.
fn maps() -> (Vec<[u8; 4]>, Vec<[u8; 4]>) {
    let (mut relief, mut colors) = (Vec::new(), Vec::new());
    for (y, x) in (0..MAP).flat_map(|y| (0..MAP).map(move |x| (y, x))) {
        let at = |x: u32, y: u32| depth(x % MAP, y % MAP).0;
        let (dx, dy) = (at(x + 1, y) - at(x + MAP - 1, y), at(x, y + 1) - at(x, y + MAP - 1));
        let [r, g, b] = <[f32; 3]>::from(Vec3::from([2.5 * dx, -2.5 * dy, 1.0]).normalize());
        let code = |n: f32| ((n * 0.5 + 0.5) * 255.0 + 0.5) as u8;
        let (deep, brick) = depth(x, y);
        relief.push([code(r), code(g), code(b), (deep.clamp(0.0, 1.0) * 255.0 + 0.5) as u8]);
        let shade = (brick * 29 % 40) as u8;
        let is_mortar = deep > 0.75;
        colors.push(if is_mortar { [150, 146, 138, 255] } else { [168 - shade, 84 - shade / 2, 62 - shade / 3, 255] });
    }
    (relief, colors)
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let (relief, colors) = maps();
    let relief = Texture2d::new(MAP, MAP, relief)?.with_mips()?;
    let albedo = Texture2d::new(MAP, MAP, colors)?.with_mips()?;
    let deep = Bricks {
        camera: Mat4::perspective(0.85, 1.0, 0.1, 50.0) * Mat4::look_at(EYE, [0.0, 0.1, 0.0], [0.0, 0.0, 1.0]),
        lamp: [1.2, 1.0, 1.3],
        depth: 0.07,
        relief: &relief,
        albedo: &albedo,
        sampler: Sampler::ANISOTROPIC,
    };
    let flat = Bricks { depth: 0.0, ..deep };
    let corner = |x: f32, y: f32| ([x, y, 0.0], [0.5 * x, -0.5 * y]);
    let half = |x0: f32, x1: f32| [corner(x0, -4.0), corner(x1, -4.0), corner(x1, 6.0), corner(x0, 6.0)];
    let (left, right) = (half(-6.0, 0.0), half(0.0, 6.0));
    let indices = Indices::U8(&[0, 1, 2, 0, 2, 3]);
    let mut pass = Pass::new();
    pass.clear_color = Some([0.0, 0.0, 0.0, 1.0]);
    pass.draw(&flat, Mesh { vertices: &left, indices }, DrawState::default());
    pass.draw(&deep, Mesh { vertices: &right, indices }, DrawState::default());
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("parallax.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
