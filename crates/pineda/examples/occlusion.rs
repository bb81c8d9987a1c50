//! Occlusion culling: a city of boxes, of which most stand behind others.
//!
//! The houses nearest to the eye are drawn first, depth only. The finished depth buffer then says of each other house whether it can be seen at
//! all: what is hidden is neither shaded nor projected, let alone rasterized. The picture is the same to the last bit.
//!
//! `cargo run --release -p pineda --example occlusion [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Houses along each side of the city, and how many of them hide the others.
const SIDE: i32 = 96;
const OCCLUDERS: usize = 400;

const EYE: [f32; 3] = [9.3, 4.6, 55.0];
const SKY: [f32; 3] = [0.42, 0.56, 0.80];

/// A house: the smallest and largest coordinates of its box.
#[derive(Clone, Copy)]
struct House {
    min: [f32; 3],
    max: [f32; 3],
    tint: f32,
}

/// What they stand on.
const GROUND: House = House { min: [-300.0, -0.1, -300.0], max: [300.0, 0.0, 300.0], tint: 0.35 };

impl House {
    fn new(column: i32, row: i32) -> Self {
        // Taller towards the middle, and no two alike.
        let hash = (column * 73 + row * 151 + column * row * 17).rem_euclid(97) as f32 / 97.0;
        let middle = 1.0 - (((column - SIDE / 2).pow(2) + (row - SIDE / 2).pow(2)) as f32).sqrt() / SIDE as f32;
        let (left, front) = ((column - SIDE / 2) as f32, (row - SIDE / 2) as f32);
        let width = 0.55 + 0.25 * hash;
        let height = 0.3 + (0.3 + hash) * 4.5 * (middle * middle * middle);
        Self { min: [left, 0.0, front], max: [left + width, height, front + width], tint: hash }
    }

    fn distance(&self) -> f32 {
        let (x, z) = (self.min[0] - EYE[0], self.min[2] - EYE[2]);
        (x * x + z * z).sqrt()
    }
}

varyings! {
    struct Surface {
        place: Vec3,
        #[flat]
        tint: Real,
    }
}

/// A box's corners are the numbers 0 to 7, their bits x, y and z.
const CORNERS: [u8; 8] = [0, 1, 2, 3, 4, 5, 6, 7];
const STRIP: [u8; 14] = [6, 7, 4, 5, 1, 7, 3, 6, 2, 4, 0, 1, 2, 3];

struct City {
    camera: Mat4,
}

#[shader]
impl Shader for City {
    type Vertex = Instanced<u8, House>;
    type Varyings<L: Lanes> = Surface<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, v: &Self::Vertex) -> (Vec4, Surface) {
        let House { min, max, tint } = v.instance;
        let place = Vec3::from([0, 1, 2].map(|axis| if v.vertex >> axis & 1 == 0 { min[axis] } else { max[axis] }));
        (self.camera * place.extend(1.0), Surface { place, tint: tint.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let normal = f.dy().place.cross(f.dx().place).normalize();
        let light = 0.18 + 0.82 * normal.dot([0.66, 0.64, 0.40]).max(0.0);
        let wall = f.splat([0.42, 0.13, 0.07]).mix([0.85, 0.64, 0.40], f.tint) * light;
        let haze = ((f.place - EYE).length() * 0.012 - 0.15).clamp(0.0, 0.85);
        Rgba::opaque(wall.mix(SKY, haze))
    }
}

/// The picture, row by row from the top, and how many houses were drawn.
fn draw_houses(settings: Settings, culls: bool) -> Result<(Vec<[u8; 4]>, usize), Error> {
    let view = Mat4::look_at(EYE, [-2.0, 0.8, 0.0], [0.0, 1.0, 0.0]);
    let city = City { camera: Mat4::perspective(0.7, 1.0, 0.1, 300.0) * view };
    let mesh = Mesh { vertices: &CORNERS, indices: Indices::U8(&STRIP) };
    let state = DrawState {
        topology: PrimitiveTopology::TriangleStrip,
        cull: Cull::Back,
        front_face: FrontFace::Clockwise,
        ..DrawState::default()
    };
    let mut houses: Vec<House> = (0..SIDE * SIDE).map(|k| House::new(k % SIDE, k / SIDE)).collect();
    houses.sort_by(|a, b| a.distance().total_cmp(&b.distance()));
    let mut renderer = Renderer::new(settings)?;

    houses.insert(0, GROUND);
    let (near, far) = houses.split_at(OCCLUDERS);
    let mut drawn = near.to_vec();
    if culls {
        let mut depth = vec![0.0; (SIZE * SIZE) as usize];
        let mut occluders = Pass::new();
        occluders.draw_instanced(&city, mesh, near, state);
        let target = &mut Target { depth: DepthBuffer::D32F(&mut depth), ..Target::new(SIZE, SIZE) };
        renderer.render(&occluders, target)?;
        let seen = DepthPyramid::new(&depth, SIZE, SIZE)?;
        drawn.extend(far.iter().filter(|house| seen.is_box_visible(&city.camera, house.min, house.max)));
    } else {
        drawn.extend(far);
    }

    let mut pass = Pass::new();
    let [r, g, b] = SKY;
    pass.clear_color = Some([r, g, b, 1.0]);
    pass.draw_instanced(&city, mesh, &drawn, state);
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    renderer.render(&pass, &mut Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) })?;
    Ok((pixels, drawn.len()))
}

/// The picture, with what cannot be seen left out.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    Ok(draw_houses(settings, true)?.0)
}

/// The picture with every house drawn.
pub fn draw_all(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    Ok(draw_houses(settings, false)?.0)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("occlusion.png".into(), PathBuf::from);
    let (pixels, drawn) = draw_houses(Settings::default(), true)?;
    println!("{drawn} of {} boxes drawn", SIDE * SIDE + 1);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(pixels.as_flattened())?;
    Ok(())
}
