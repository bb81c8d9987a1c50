//! Shadow volumes: every shadow is a body of its own, and the stencil buffer counts in how many of them a pixel lies.
//!
//! What hides the light is extruded away from it to infinity: front faces towards the light are the near end of the volume, the same faces at infinity are the
//! far end, and its sides rise from the *silhouette*, the edges between faces that see the light and faces that do not. A pixel is in shadow if behind it
//! more volumes end than begin. That is counting from behind, "depth fail" (Bilodeau and Songy 1999; Carmack 2000), which is right even if the eye is in a
//! shadow. It is one draw: each face of the volume has an operation of its own, and they wrap around, so that their order does not matter.
//!
//! Two things must hold. A volume may have no holes, which *depth clamp* sees to: without it the far plane would cut its end off. And where two faces share an edge
//! each pixel must be counted once, which the rasterizer promises.
//!
//! `cargo run --release -p pineda --example shadow_volume [OUT.png]`

use pineda::*;
use std::collections::HashSet;
use std::f32::consts::TAU;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;
const LIGHT: [f32; 3] = [-2.6, 4.6, 2.2];

/// A position, the normal of its triangle, and a colour.
type Vertex = [[f32; 3]; 3];

varyings! {
    struct Surface {
        place: Vec3,
        #[flat]
        normal: Vec3,
        #[flat]
        albedo: Vec3,
    }
}

/// Surfaces in what comes from everywhere, and in what comes from the light.
struct Stone {
    camera: Mat4,
    ambient: f32,
    light: f32,
}

#[shader]
impl Shader for Stone {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Surface<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Surface) {
        let [place, normal, albedo] = vertex.map(Vec3::from);
        (self.camera * place.extend(1.0), Surface { place, normal, albedo })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let way = LIGHT - f.place;
        let squared = way.dot(way);
        let diffuse = f.normal.dot(way).max(0.0) / squared.sqrt() * self.light / (1.0 + 0.08 * squared);
        let ambient = self.ambient * (0.75 + 0.25 * f.normal.y);
        Rgba::opaque(f.albedo * (diffuse + ambient))
    }
}

/// A ring with corners: a closed mesh. Seen from outside, its triangles run counter-clockwise.
struct Ring {
    points: Vec<Vec3>,
    triangles: Vec<[usize; 3]>,
    albedo: [f32; 3],
}

impl Ring {
    /// Corners along and around, the thickness of a ring whose radius is 1, where it stands and how it is turned.
    fn new([along, around]: [usize; 2], thickness: f32, place: Mat4, albedo: [f32; 3]) -> Self {
        // libm's, not std's: the same bits on every machine.
        let turn = |k: usize, of: usize| [libm::cosf, libm::sinf].map(|f| f((k as f32 + 0.5) / of as f32 * TAU));
        let point = |(i, j)| {
            let ([cos, sin], [out, up]) = (turn(i, along), turn(j, around));
            let away = 1.0 + thickness * out;
            (place * Vec4::from([away * cos, away * sin, thickness * up, 1.0])).xyz()
        };
        let at = |i: usize, j: usize| i % along * around + j % around;
        let cells = || (0..along).flat_map(|i| (0..around).map(move |j| (i, j)));
        let halves = |(i, j)| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]];
        Self { points: cells().map(point).collect(), triangles: cells().flat_map(halves).collect(), albedo }
    }

    fn normal(&self, triangle: [usize; 3]) -> Vec3 {
        let [a, b, c] = triangle.map(|k| self.points[k]);
        (b - a).cross(c - a).normalize()
    }

    fn surface(&self) -> impl Iterator<Item = Vertex> {
        self.triangles.iter().flat_map(|&triangle| {
            let normal = self.normal(triangle).into();
            triangle.map(|k| [self.points[k].into(), normal, self.albedo])
        })
    }

    /// The volume of its shadow, in homogeneous coordinates: w is 0 for what is infinitely far away.
    fn shadow(&self) -> Vec<[f32; 4]> {
        let near = |k: usize| -> [f32; 4] { self.points[k].extend(1.0).into() };
        let far = |k: usize| (self.points[k] - LIGHT).extend(0.0).into();
        let sees_light = |&&t: &&[usize; 3]| f32::from(self.normal(t).dot(LIGHT - self.points[t[0]])) > 0.0;
        let lit: Vec<[usize; 3]> = self.triangles.iter().filter(sees_light).copied().collect();
        let edges: HashSet<[usize; 2]> = lit.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        let mut volume = Vec::new();
        for &[a, b, c] in &lit {
            volume.extend([near(a), near(b), near(c), far(c), far(b), far(a)]);
            for [a, b] in [[a, b], [b, c], [c, a]] {
                if !edges.contains(&[b, a]) {
                    volume.extend([near(b), near(a), far(a), near(b), far(a), far(b)]);
                }
            }
        }
        volume
    }
}

fn rings() -> [Ring; 3] {
    let at = |place, turn, lean| Mat4::translation(place) * Mat4::rotation_y(turn) * Mat4::rotation_x(lean);
    [
        Ring::new([40, 16], 0.24, at([0.0, 1.22, -0.2], 0.35, -0.1), [0.85, 0.30, 0.16]),
        Ring::new([6, 4], 0.20, at([0.9, 0.86, 0.15], 0.1, 1.15), [0.20, 0.42, 0.62]),
        Ring::new([3, 4], 0.16, at([-1.25, 0.7, 0.75], -0.9, 0.0), [0.75, 0.62, 0.14]),
    ]
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let view = Mat4::look_at([0.9, 4.0, 6.4], [0.2, 0.6, 0.0], [0.0, 1.0, 0.0]);
    let camera = Mat4::perspective(0.75, 1.0, 0.5, 20.0) * view;
    let rings = rings();
    let floor = [[-9.0, 9.0], [9.0, 9.0], [9.0, -9.0], [-9.0, 9.0], [9.0, -9.0], [-9.0, -9.0]];
    let floor = floor.map(|[x, z]| [[x, 0.0, z], [0.0, 1.0, 0.0], [0.55, 0.53, 0.50]]);
    let surfaces: Vec<Vertex> = rings.iter().flat_map(Ring::surface).chain(floor).collect();
    let volumes: Vec<[f32; 4]> = rings.iter().flat_map(Ring::shadow).collect();
    let surfaces = Mesh { vertices: &surfaces, indices: Indices::Sequential };
    let volumes = Mesh { vertices: &volumes, indices: Indices::Sequential };

    let counted = |depth_fail| StencilFace { depth_fail, ..StencilFace::IGNORE };
    let (front, back) = (counted(StencilOperation::DecrementWrap), counted(StencilOperation::IncrementWrap));
    let counting = DrawState {
        stencil: Some(StencilState { front, back }),
        depth: DepthState { write: false, ..DepthState::default() },
        depth_clamp: true,
        color_mask: ColorMask::NONE,
        ..DrawState::default()
    };
    // Where ends and beginnings cancel out, a second time: the very same triangles have the very same depths.
    let none = StencilFace { compare: Compare::Equal, reference: 0, ..StencilFace::IGNORE };
    let lighting = DrawState {
        stencil: Some(StencilState::both(none)),
        depth: DepthState { compare: Compare::Equal, write: false },
        blend: Blend::ADD,
        ..DrawState::default()
    };
    let dim = Stone { camera, ambient: 0.07, light: 0.0 };
    let lit = Stone { camera, ambient: 0.0, light: 2.6 };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.004, 0.005, 0.008, 1.0]);
    pass.draw(&dim, surfaces, DrawState::default());
    pass.draw_with(volumes, counting, |&v| (camera * Vec4::from(v), ()), |f| Rgba::gray(f.splat(0.0)));
    pass.draw(&lit, surfaces, lighting);

    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) };
    Renderer::new(settings)?.render(&pass, &mut target)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("shadow_volume.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
