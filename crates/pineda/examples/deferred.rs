//! Deferred shading: 49 balls on a floor in the light of 60 lamps.
//!
//! The first pass lights nothing. It fills a "G-buffer" of four colour buffers with what lies behind each pixel: albedo, normal, place and the ball's
//! number, each in a format of its own. The second pass is one triangle over the whole picture that reads them, so that the lamps are added up
//! once for each pixel, however many balls lie behind it. Where the numbers of neighbours differ it draws an outline.
//!
//! `cargo run --release -p pineda --example deferred [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;
const PIXELS: usize = (SIZE * SIZE) as usize;

/// Balls along each side of the floor; squares along each from pole to pole, and around.
const SIDE: usize = 7;
const RINGS: u32 = 24;
const SEGMENTS: u32 = 48;

/// A place and a normal.
type Vertex = [[f32; 3]; 2];

/// A mesh somewhere, larger or smaller.
#[derive(Clone, Copy)]
struct Body {
    middle: [f32; 3],
    size: f32,
    albedo: [f32; 3],
    number: u32,
}

outputs! {
    struct Surface {
        albedo: Vec3,
        normal: Vec3,
        place: Vec3,
        number: Uint,
    }
}

varyings! {
    struct Place {
        place: Vec3,
        normal: Vec3,
        #[flat]
        albedo: Vec3,
        number: Uint,
    }
}

struct Fill {
    camera: Mat4,
}

#[shader]
impl Shader for Fill {
    type Vertex = Instanced<Vertex, Body>;
    type Varyings<L: Lanes> = Place<L>;

    fn vertex(&self, v: &Self::Vertex) -> (Vec4, Place) {
        let ([place, normal], body) = (v.vertex.map(Vec3::from), v.instance);
        let place = place * body.size + body.middle;
        let (albedo, number) = (body.albedo.into(), body.number.into());
        (self.camera * place.extend(1.0), Place { place, normal, albedo, number })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Surface<L> {
        Surface { albedo: f.albedo, normal: f.normal.normalize(), place: f.place, number: f.number }
    }
}

/// What the first pass leaves, pixel by pixel.
struct GBuffer {
    albedo: Vec<[u8; 4]>,
    /// 16-bit floats.
    normal: Vec<[u16; 4]>,
    place: Vec<[f32; 4]>,
    number: Vec<u32>,
}

struct Lamp {
    place: [f32; 3],
    color: [f32; 3],
}

struct Light {
    surface: GBuffer,
    lamps: Vec<Lamp>,
}

#[shader]
impl Shader for Light {
    type Vertex = [f32; 2];
    type Varyings<L: Lanes> = ();

    fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
        ([x, y, 0.0, 1.0].into(), ())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let GBuffer { albedo, normal, place, number } = &self.surface;
        let albedo = fetch(f, |at| [0, 1, 2].map(|k| f32::from(albedo[at][k]) / 255.0));
        let normal = fetch(f, |at| [0, 1, 2].map(|k| f16_to_f32(normal[at][k])));
        let place = fetch(f, |at| [0, 1, 2].map(|k| place[at][k]));
        let outline = fetch(f, |at| {
            let differs = |other: usize| number.get(other).is_some_and(|&other| other != number[at]);
            let right = (at + 1) % SIZE as usize != 0 && differs(at + 1);
            [if right || differs(at + SIZE as usize) { 0.25 } else { 1.0 }; 3]
        });
        let mut light = f.splat([0.01, 0.01, 0.02]);
        for lamp in &self.lamps {
            let way = lamp.place - place;
            let squared = way.dot(way);
            let towards = normal.dot(way).max(0.0) / squared.sqrt();
            light += f.splat(lamp.color) * (towards / (0.1 + squared * squared));
        }
        // So that bright places keep their hue.
        let color = albedo * light;
        Rgba::opaque(color / (1.0 + color) * outline.x)
    }
}

/// Three numbers that depend on the pixel.
#[shader]
fn fetch<L: Lanes>(f: &Fragment<L, Light>, pixel: impl Fn(usize) -> [f32; 3]) -> Vec3<L> {
    let (mut x, mut y, mut rows) = ([0.0; 16], [0.0; 16], [[0.0; 16]; 3]);
    f.x().store(&mut x);
    f.y().store(&mut y);
    for lane in 0..L::N {
        // Some lanes may lie outside of the triangle, and of the picture.
        let [column, row] = [x[lane], y[lane]].map(|v| (v as usize).min(SIZE as usize - 1));
        let numbers = pixel(row * SIZE as usize + column);
        for axis in 0..3 {
            rows[axis][lane] = numbers[axis];
        }
    }
    let [x, y, z] = [0, 1, 2].map(|axis| Real::load(f.lanes(), &rows[axis]));
    Vec3::new(x, y, z)
}

/// The first pass.
fn fill(renderer: &mut Renderer) -> Result<GBuffer, Error> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for ring in 0..=RINGS {
        for segment in 0..=SEGMENTS {
            let turn = |part: u32, of: u32| Real::from(std::f32::consts::TAU * part as f32 / of as f32);
            let (down, around) = (turn(ring, 2 * RINGS), turn(segment, SEGMENTS));
            let place = Vec3::new(down.sin() * around.cos(), down.cos(), down.sin() * around.sin());
            vertices.push([place.into(); 2]);
            if ring < RINGS && segment < SEGMENTS {
                let a = ring * (SEGMENTS + 1) + segment;
                let b = a + SEGMENTS + 1;
                triangles.extend([a, a + 1, b + 1, a, b + 1, b]);
            }
        }
    }
    let colors = [[0.9, 0.9, 0.85], [0.9, 0.35, 0.3], [0.3, 0.55, 0.9], [0.95, 0.75, 0.3], [0.4, 0.8, 0.5]];
    let ball = |k: usize| {
        let [x, z] = [k % SIDE, k / SIDE].map(|place| 1.2 * (place as f32 - (SIDE / 2) as f32));
        let size = 0.28 + 0.07 * (k * 5 % 4) as f32;
        Body { middle: [x, size, z], size, albedo: colors[k * k % 5], number: k as u32 }
    };
    let balls: Vec<Body> = (0..SIDE * SIDE).map(ball).collect();
    let square = [[-1.0, 1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|[x, z]| [[x, 0.0, z], [0.0, 1.0, 0.0]]);
    let floor = [Body { middle: [0.0; 3], size: 30.0, albedo: [0.7; 3], number: 49 }];
    let view = Mat4::look_at([4.6, 5.2, 7.6], [0.0, 0.0, 0.4], [0.0, 1.0, 0.0]);
    let shader = Fill { camera: Mat4::perspective(0.75, 1.0, 1.0, 60.0) * view };
    let state = DrawState { cull: Cull::Back, ..DrawState::default() };
    let strip = DrawState { topology: PrimitiveTopology::TriangleStrip, ..state };
    let mut pass = Pass::new();
    pass.color_ops[3].load = Load::Clear([NO_ID; 4].into());
    pass.draw_instanced(&shader, Mesh { vertices: &vertices, indices: Indices::U32(&triangles) }, &balls, state);
    pass.draw_instanced(&shader, Mesh { vertices: &square, indices: Indices::Sequential }, &floor, strip);

    let mut surface = GBuffer {
        albedo: vec![[0; 4]; PIXELS],
        normal: vec![[0; 4]; PIXELS],
        place: vec![[0.0; 4]; PIXELS],
        number: vec![0; PIXELS],
    };
    let mut target = Target {
        color: ColorBuffer::Rgba8(&mut surface.albedo),
        more_colors: vec![
            ColorBuffer::Rgba16F(&mut surface.normal),
            ColorBuffer::Rgba32F(&mut surface.place),
            ColorBuffer::R32U(&mut surface.number),
        ],
        ..Target::new(SIZE, SIZE)
    };
    renderer.render(&pass, &mut target)?;
    Ok(surface)
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let mut renderer = Renderer::new(settings)?;
    let surface = fill(&mut renderer)?;
    let lamp = |k: usize| {
        // A spiral of lamps by the golden angle.
        let (angle, away) = (Real::from(2.399_963 * k as f32), Real::from(k as f32 + 0.5).sqrt() * 0.62);
        let place = Vec3::new(angle.cos() * away, (0.5 + 0.25 * (k % 3) as f32).into(), angle.sin() * away);
        let color = [[1.0, 0.35, 0.1], [0.15, 0.5, 1.0], [0.8, 0.2, 0.7], [0.9, 0.8, 0.5]][k % 4];
        Lamp { place: place.into(), color: color.map(|x| 0.8 * x) }
    };
    let light = Light { surface, lamps: (0..60).map(lamp).collect() };
    let corners = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
    let mut pass = Pass::new();
    pass.draw(&light, Mesh { vertices: &corners, indices: Indices::Sequential }, DrawState::default());
    let mut pixels = vec![[0; 4]; PIXELS];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    renderer.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("deferred.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
