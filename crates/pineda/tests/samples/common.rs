//! What these tests draw with: one triangle a pixel, each with a colour and a depth of its own.

use pineda::*;
use pineda_oracle::cases::Random;

/// Not a multiple of a tile's side or of a block's.
pub(crate) const WIDTH: u32 = 38;
pub(crate) const HEIGHT: u32 = 13;
pub(crate) const PIXELS: usize = (WIDTH * HEIGHT) as usize;

varyings! {
    pub(crate) struct Plain {
        #[flat]
        color: Rgba,
    }
}

/// The second source of a colour.
pub(crate) fn second_of([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    [a - 0.25, r, g * 0.5, b]
}

#[shader]
fn with_second<L: Lanes>(color: Rgba<L>) -> DualSource<L> {
    DualSource { color, factor: Rgba { r: color.a - 0.25, g: color.r, b: color.g * 0.5, a: color.b } }
}

/// The first vertex's colour, bit by bit, and its second source.
pub(crate) struct Flat;

#[shader]
impl Shader for Flat {
    type Vertex = ([f32; 3], [f32; 4]);
    type Varyings<L: Lanes> = Plain<L>;
    fn vertex(&self, &([x, y, z], color): &Self::Vertex) -> (Vec4, Plain) {
        ([x, y, z, 1.0].into(), Plain { color: color.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> DualSource<L> {
        with_second(f.color)
    }
}

/// The same, without the fragments whose alpha is below 1/4.
pub(crate) struct FlatWithHoles;

#[shader]
impl Shader for FlatWithHoles {
    type Vertex = ([f32; 3], [f32; 4]);
    type Varyings<L: Lanes> = Plain<L>;
    const DISCARDS: bool = true;
    fn vertex(&self, vertex: &Self::Vertex) -> (Vec4, Plain) {
        Flat.vertex(vertex)
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> DualSource<L> {
        f.discard(f.color.a.lt(0.25));
        with_second(f.color)
    }
}

/// A fragment for every pixel, as one triangle each.
pub(crate) struct Layer {
    pub(crate) colors: Vec<[f32; 4]>,
    pub(crate) depths: Vec<f32>,
    /// Which triangles wind clockwise on the picture.
    pub(crate) clockwise: Vec<bool>,
    pub(crate) state: DrawState,
    pub(crate) discards: bool,
    vertices: Vec<([f32; 3], [f32; 4])>,
}

impl Layer {
    pub(crate) fn new(state: DrawState, mut pixel: impl FnMut() -> ([f32; 4], f32, bool)) -> Self {
        let (mut colors, mut depths, mut clockwise, mut vertices) = (vec![], vec![], vec![], vec![]);
        for at in 0..PIXELS {
            let (x, y) = ((at % WIDTH as usize) as f32, (at / WIDTH as usize) as f32);
            let (color, z, is_clockwise) = pixel();
            let [left, right] = if is_clockwise { [-0.5, 1.5] } else { [1.5, -0.5] };
            vertices.extend([([x + left, y, z], color), ([x + right, y, z], color), ([x + 0.5, y + 1.0, z], color)]);
            colors.push(color);
            depths.push(z);
            clockwise.push(is_clockwise);
        }
        Self {
            colors,
            depths,
            clockwise,
            state: DrawState { space: Space::Raster, ..state },
            discards: false,
            vertices,
        }
    }

    pub(crate) fn draw<'a>(&'a self, pass: &mut Pass<'a>) {
        let mesh = Mesh { vertices: &self.vertices, indices: Indices::Sequential };
        if self.discards {
            pass.draw(&FlatWithHoles, mesh, self.state);
        } else {
            pass.draw(&Flat, mesh, self.state);
        }
    }
}

/// Every SIMD level, each with another number of threads and another tile size, chosen by `n`.
pub(crate) fn settings(n: u64) -> impl Iterator<Item = Settings> {
    Simd::available().into_iter().zip(n..).map(|(simd, n)| {
        let threads = [1, 2, 7][(n / 2 % 3) as usize];
        let tile = [TileSize::T16, TileSize::T64][(n % 2) as usize];
        Settings { simd, threads, tile, ..Settings::default() }
    })
}

/// A number that is worth trying as a channel.
pub(crate) fn channel(random: &mut Random) -> f32 {
    match random.between(0, 5) {
        0 => random.pick(&[0.0, -0.0, 1.0, 0.5, 2.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY]),
        1 => random.between(0, 255) as f32 / 255.0,
        2 => random.real(-1.0, 2.0),
        _ => random.unit(),
    }
}

/// Whether a comparison holds, the new value on its left.
pub(crate) fn passes<T: PartialOrd>(compare: Compare, new: T, there: T) -> bool {
    match compare {
        Compare::Never => false,
        Compare::Less => new < there,
        Compare::Equal => new == there,
        Compare::LessEqual => new <= there,
        Compare::Greater => new > there,
        Compare::NotEqual => new != there,
        Compare::GreaterEqual => new >= there,
        Compare::Always => true,
    }
}
