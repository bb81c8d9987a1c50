//! Impostors: balls that are squares. The fragment stage casts a ray, and writes the depth of where it hits.
//!
//! A ball of triangles is either angular or thousands of triangles. Here each is two of them, turned towards the eye and just large enough for the ball's outline; what of the square the ray
//! misses is discarded. Since depth is written, balls cut each other, and the floor, where balls do, to the last bit: no sorting, no seams. Molecules and particles are drawn like this (Tarini, Cignoni
//! and Montani 2006, "Ambient Occlusion and Edge Cueing to Enhance Real Time Molecular Visualization").
//!
//! `cargo run --release -p pineda --example impostors [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

const EYE: [f32; 3] = [0.4, 1.2, 7.5];
const LIGHT: [f32; 3] = [0.48, 0.64, 0.6];

/// A ball.
#[derive(Clone, Copy)]
pub struct Ball {
    middle: [f32; 3],
    radius: f32,
    color: [f32; 3],
}

varyings! {
    struct Ray {
        /// From the eye to the square: as long as it comes.
        direction: Vec3,
        #[flat]
        middle: Vec3,
        #[flat]
        radius: Real,
        #[flat]
        color: Vec3,
    }
}

struct Balls {
    camera: Mat4,
}

#[shader]
impl Shader for Balls {
    type Vertex = Instanced<[f32; 2], Ball>;
    type Varyings<L: Lanes> = Ray<L>;
    const DISCARDS: bool = true;
    const WRITES_DEPTH: bool = true;

    fn vertex(&self, v: &Self::Vertex) -> (Vec4, Ray) {
        let (Ball { middle, radius, color }, [x, y]) = (v.instance, v.vertex);
        let to_middle = Vec3::from(middle) - EYE;
        let (away, forward) = (to_middle.length(), to_middle.normalize());
        let right = forward.cross([0.0, 1.0, 0.0]).normalize();
        let up = right.cross(forward);
        // The cone around the ball is wider than the ball at its middle.
        let half = away * radius / (away * away - radius * radius).sqrt();
        let direction = to_middle + (right * x + up * y) * half;
        let ray = Ray { direction, middle: middle.into(), radius: radius.into(), color: color.into() };
        (self.camera * (direction + EYE).extend(1.0), ray)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (direction, to_middle) = (f.direction.normalize(), f.middle - EYE);
        let nearest = direction.dot(to_middle);
        let inside = nearest * nearest - to_middle.length_squared() + f.radius * f.radius;
        f.discard(inside.lt(0.0));
        let place = direction * (nearest - inside.max(0.0).sqrt()) + EYE;
        let clip = self.camera * place.extend(1.0);
        f.set_depth(clip.z / clip.w);

        let normal = (place - f.middle) / f.radius;
        let shine = direction.reflect(normal).dot(LIGHT).max(0.0).powi(24);
        Rgba::opaque(f.color * lit(normal) + shine * 0.25)
    }
}

/// A floor of ordinary triangles.
struct Floor {
    camera: Mat4,
}

#[shader]
impl Shader for Floor {
    type Vertex = [f32; 3];
    type Varyings<L: Lanes> = Vec3<L>;

    fn vertex(&self, &position: &[f32; 3]) -> (Vec4, Vec3) {
        let position = Vec3::from(position);
        (self.camera * position.extend(1.0), position)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let light = 1.0 / (1.0 + f.length_squared() * 0.06);
        Rgba::opaque(f.splat([0.32, 0.36, 0.42]) * light)
    }
}

/// How much light a surface gets: a little from below, more from above, most from where the lamp is.
#[shader]
fn lit<L: Lanes>(normal: Vec3<L>) -> Real<L> {
    normal.y * 0.12 + 0.2 + normal.dot(LIGHT).max(0.0) * 0.8
}

/// A double helix: two strands, and rungs between them; neighbours are nearer to each other than their radii.
fn helix() -> Vec<Ball> {
    const PAIRS: [[[f32; 3]; 2]; 4] = [
        [[0.85, 0.25, 0.15], [0.95, 0.75, 0.2]],
        [[0.2, 0.6, 0.25], [0.25, 0.4, 0.85]],
        [[0.95, 0.75, 0.2], [0.85, 0.25, 0.15]],
        [[0.25, 0.4, 0.85], [0.2, 0.6, 0.25]],
    ];
    let mut balls = Vec::new();
    for step in 0..60u32 {
        let turn = Mat4::rotation_y(0.21 * step as f32);
        let height = 0.1 * step as f32 - 2.6;
        let place = |x: f32| {
            let Vec4 { x, z, .. } = turn * Vec4::from([x, 0.0, 0.0, 0.0]);
            [x.into(), height, z.into()]
        };
        for side in [-1.25, 1.25] {
            balls.push(Ball { middle: place(side), radius: 0.26, color: [0.62, 0.64, 0.7] });
        }
        if step % 5 == 2 {
            let [left, right] = PAIRS[(step / 5 * 7 % 4) as usize];
            for k in 0..8 {
                let x = 0.26 * (k as f32 - 3.5);
                balls.push(Ball { middle: place(x), radius: 0.17, color: if k < 4 { left } else { right } });
            }
        }
    }
    balls
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let camera = Mat4::perspective(0.75, 1.0, 0.5, 40.0) * Mat4::look_at(EYE, [0.0, 0.05, 0.0], [0.0, 1.0, 0.0]);
    let (balls, floor, helix) = (Balls { camera }, Floor { camera }, helix());
    let ground = [[-30.0, -2.2, 8.0], [30.0, -2.2, 8.0], [30.0, -2.2, -30.0], [-30.0, -2.2, -30.0]];
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let indices = Indices::U8(&[0, 1, 2, 0, 2, 3]);
    let mut pass = Pass::new();
    pass.clear_color = Some([0.01, 0.012, 0.018, 1.0]);
    pass.draw(&floor, Mesh { vertices: &ground, indices }, DrawState::default());
    // Each sample casts a ray of its own: outlines, and seams between balls, are as smooth as borders of triangles.
    let state = DrawState { sampling: Sampling::Sample, ..DrawState::default() };
    pass.draw_instanced(&balls, Mesh { vertices: &square, indices }, &helix, state);
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let color = ColorBuffer::Rgba8Srgb(&mut pixels);
    let mut target = Target { samples: Samples::Four, color, ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("impostors.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
