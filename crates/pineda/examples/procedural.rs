//! Procedural wood and marble: solid textures, computed at each fragment from where it lies in the block that the thing is carved from.
//!
//! Both are Perlin's (1985, "An image synthesizer"). Wood is rings around an axis, shaken by noise, with fibres of noise that is stretched along
//! it; marble is a sine wave that turbulence displaces. The wood's normals are bent by the slope of the noise that makes its fibres.
//!
//! `cargo run --release -p pineda --example procedural [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

const EYE: [f32; 3] = [0.0, 2.7, 7.6];

const SKY: [f32; 3] = [0.42, 0.45, 0.5];
const LIGHT: [f32; 3] = [-0.48, 0.64, 0.6];

/// A place, and a normal of any length.
type Vertex = [[f32; 3]; 2];

varyings! {
    struct Solid {
        place: Vec3,
        normal: Vec3,
    }
}

/// What a thing is made of, and where it stands.
struct Carved {
    camera: Mat4,
    middle: [f32; 3],
    is_wood: bool,
}

#[shader]
impl Shader for Carved {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Solid<L>;

    fn vertex(&self, &[place, normal]: &Vertex) -> (Vec4, Solid) {
        let place = Vec3::from(place);
        (self.camera * (place + self.middle).extend(1.0), Solid { place, normal: normal.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let normal = f.normal.normalize();
        let (color, normal, gloss) = if self.is_wood { wood(f.place, normal) } else { marble(f.place, normal) };
        let towards_eye = (EYE - (f.place + self.middle)).normalize();
        let diffuse = normal.dot(LIGHT).max(0.0);
        let shine = normal.dot((towards_eye + LIGHT).normalize()).max(0.0).powf(gloss);
        // From above a little blue, from below a little of the floor.
        let around = f.splat([0.16, 0.13, 0.10]).mix([0.22, 0.26, 0.32], normal.y * 0.5 + 0.5);
        Rgba::opaque(color * (around + 0.85 * diffuse) + 0.25 * shine)
    }
}

/// Colour, normal, and how narrow highlights are.
#[shader]
fn wood<L: Lanes>(place: Vec3<L>, normal: Vec3<L>) -> (Vec3<L>, Vec3<L>, f32) {
    // The tree stood a little oblique, and next to the block's middle.
    let tree = place + [0.35, 0.0, 0.2] + 0.12 * place.y;
    let shaken = noise::fbm3(place * [1.1, 0.5, 1.1], 3, 1) * 0.35;
    let rings = (tree.xz().length() + shaken) * 9.0;
    let ring = rings.fract();
    // Slow growth darkens the wood towards winter, and then it is spring at once.
    let winter = ring.smoothstep(0.2, 0.92) * (1.0 - ring.smoothstep(0.94, 1.0));
    let (fibre, slope) = noise::gradient3_with_slope(place * [34.0, 2.5, 34.0], 2);
    let dark = (0.55 * winter + 0.16 * fibre).saturate();
    let color = [0.62, 0.34, 0.14].splat(place.lanes()).mix([0.20, 0.075, 0.025], dark);
    (color, (normal - slope * [0.05, 0.004, 0.05]).normalize(), 30.0)
}

#[shader]
fn marble<L: Lanes>(place: Vec3<L>, normal: Vec3<L>) -> (Vec3<L>, Vec3<L>, f32) {
    let displaced = place.x + 0.7 * place.y + 2.2 * noise::turbulence3(place * 1.7, 5, 3);
    // Thin where the wave turns.
    let vein = (1.0 - (displaced * 4.2).sin().abs()).powf(5.0);
    let cloud = noise::fbm3(place * 3.0, 4, 4).smoothstep(-0.5, 0.7);
    let stone = [0.86, 0.85, 0.82].splat(place.lanes()).mix([0.62, 0.64, 0.66], cloud);
    (stone.mix([0.10, 0.12, 0.15], 0.85 * vein), normal, 120.0)
}

/// A floor with soft shadows: discs, darker towards their middles.
struct Floor {
    camera: Mat4,
    shadows: [[f32; 3]; 2],
}

#[shader]
impl Shader for Floor {
    type Vertex = [f32; 2];
    type Varyings<L: Lanes> = Vec2<L>;

    fn vertex(&self, &[x, z]: &[f32; 2]) -> (Vec4, Vec2) {
        (self.camera * Vec4::from([x, 0.0, z, 1.0]), [x, z].into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let place = f.varyings();
        let mut light = f.splat(0.8);
        for [x, z, radius] in self.shadows {
            light *= 0.25 + 0.75 * (place - [x, z]).length().smoothstep(0.2 * radius, 1.5 * radius);
        }
        let speckle = 1.0 + 0.10 * noise::fbm2(place * 5.0, 4, 5);
        let near = f.splat([0.42, 0.40, 0.37]) * (light * speckle);
        Rgba::opaque(near.mix(SKY, place.length().smoothstep(3.0, 26.0)))
    }
}

/// A surface of revolution around the y axis, from `(radius, height)` along its outline, from the top downwards.
fn turned(outline: impl Fn(f32) -> [f32; 2]) -> (Vec<Vertex>, Vec<u32>) {
    const RINGS: u32 = 96;
    const SEGMENTS: u32 = 96;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for ring in 0..=RINGS {
        let at = |shift: f32| outline((ring as f32 + shift) / RINGS as f32);
        let ([radius, height], above, below) = (at(0.0), at(-0.5), at(0.5));
        let (out, up) = (above[1] - below[1], below[0] - above[0]);
        for segment in 0..=SEGMENTS {
            let around = Real::from(std::f32::consts::TAU * segment as f32 / SEGMENTS as f32);
            let (sin, cos) = around.sin_cos();
            let (sin, cos) = (f32::from(sin), f32::from(cos));
            vertices.push([[radius * sin, height, radius * cos], [out * sin, up, out * cos]]);
            if ring < RINGS && segment < SEGMENTS {
                let a = ring * (SEGMENTS + 1) + segment;
                let b = a + SEGMENTS + 1;
                triangles.extend([a, b, b + 1, a, b + 1, a + 1]);
            }
        }
    }
    (vertices, triangles)
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let camera = Mat4::perspective(0.62, 1.0, 1.0, 40.0) * Mat4::look_at(EYE, [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
    let half_turn = std::f32::consts::PI;
    let (ball, ball_triangles) = turned(|t| {
        let (sin, cos) = Real::from(half_turn * t).sin_cos();
        [sin.into(), cos.into()]
    });
    let (vase, vase_triangles) = turned(|t| {
        // A lip, a neck, a belly and a foot.
        let [wide, narrow] = [2.0, 6.0].map(|times| f32::from(Real::from(times * half_turn * t).cos()));
        [0.53 - 0.24 * wide + 0.07 * narrow, 2.3 * (1.0 - t)]
    });
    let wooden = Carved { camera, middle: [-1.1, 1.0, 0.2], is_wood: true };
    let stone = Carved { camera, middle: [1.1, 0.0, 0.0], is_wood: false };
    let floor = Floor { camera, shadows: [[-1.1, 0.2, 1.0], [1.1, 0.0, 0.6]] };
    let corners = [[-30.0, 4.0], [30.0, 4.0], [-30.0, -30.0], [30.0, -30.0]];

    let state = DrawState { cull: Cull::Back, ..DrawState::default() };
    let mut pass = Pass::new();
    pass.clear_color = Some([SKY[0], SKY[1], SKY[2], 1.0]);
    pass.draw(&wooden, Mesh { vertices: &ball, indices: Indices::U32(&ball_triangles) }, state);
    let open = DrawState { cull: Cull::None, ..state };
    pass.draw(&stone, Mesh { vertices: &vase, indices: Indices::U32(&vase_triangles) }, open);
    let strip = DrawState { topology: PrimitiveTopology::TriangleStrip, ..open };
    pass.draw(&floor, Mesh { vertices: &corners, indices: Indices::Sequential }, strip);
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("procedural.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
