//! Large triangles have ways of their own: many packets in a row, edge functions as sums of two f32, in 32 bits or in f64. A flat varying rules them out; it must not change a bit of the others.

use pineda::*;
use pineda_oracle::cases::Random;

const WIDTH: u32 = 200;
const HEIGHT: u32 = 150;

/// Three varyings with perspective, of which one may be the same everywhere.
struct Quick;

/// The same, and a flat one.
struct InFull;

/// [`Quick`] with derivatives, and [`InFull`].
struct QuickDerivatives;
struct InFullDerivatives;

varyings! {
    struct Varyings {
        smooth: Vec3,
        #[flat]
        flat: Real,
    }
}

type Vertex = ([f32; 4], [f32; 3]);

#[shader]
impl Shader for Quick {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec3<L>;
    fn vertex(&self, (position, values): &Vertex) -> (Vec4, Vec3) {
        ((*position).into(), (*values).into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::opaque(f.varyings())
    }
}

#[shader]
impl Shader for InFull {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Varyings<L>;
    fn vertex(&self, (position, values): &Vertex) -> (Vec4, Varyings) {
        ((*position).into(), Varyings { smooth: (*values).into(), flat: 1.0.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Varyings { smooth, flat } = f.varyings();
        Rgba { r: smooth.x, g: smooth.y, b: smooth.z, a: flat }
    }
}

#[shader]
impl Shader for QuickDerivatives {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec3<L>;
    const DERIVATIVES: bool = true;
    fn vertex(&self, (position, values): &Vertex) -> (Vec4, Vec3) {
        ((*position).into(), (*values).into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (dx, dy) = (*f.dx(), *f.dy());
        Rgba { r: dx.x, g: dy.y, b: dx.z, a: dy.z }
    }
}

#[shader]
impl Shader for InFullDerivatives {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Varyings<L>;
    const DERIVATIVES: bool = true;
    fn vertex(&self, (position, values): &Vertex) -> (Vec4, Varyings) {
        ((*position).into(), Varyings { smooth: (*values).into(), flat: 1.0.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (dx, dy) = (f.dx().smooth, f.dy().smooth);
        Rgba { r: dx.x, g: dy.y, b: dx.z, a: dy.z }
    }
}

/// The bits of what a shader draws.
fn drawn<S: Shader<Vertex = Vertex>>(
    shader: &S,
    triangle: &[Vertex],
    state: DrawState,
    renderer: &mut Renderer,
) -> Vec<[u32; 4]> {
    let mut color = vec![[0.0; 4]; (WIDTH * HEIGHT) as usize];
    let mut pass = Pass::new();
    pass.clear_color = Some([0.25, 0.5, 0.125, 1.0]);
    pass.draw(shader, Mesh { vertices: triangle, indices: Indices::Sequential }, state);
    let mut target = Target { color: ColorBuffer::Rgba32F(&mut color), ..Target::new(WIDTH, HEIGHT) };
    renderer.render(&pass, &mut target).expect("valid");
    color.into_iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

fn renderer(simd: Simd) -> Renderer {
    Renderer::new(Settings { simd, threads: 1, ..Settings::default() }).expect("available")
}

/// Where an overestimate reaches beyond a triangle, all weights together may be 0, and then what is the same at all corners is a NaN there. It had been so only where packets were not interpolated many at a time.
#[test]
fn a_constant_beyond_a_triangle_is_the_same_at_every_level_and_tile_size() {
    let triangle =
        [([0.0, 1.0, 0.5, 1.0], [0.5; 3]), ([64.0, 1.0, 0.5, 1.0], [0.5; 3]), ([32.0, 0.75, 0.5, 2.0], [0.5; 3])];
    let visible = DrawState { space: Space::Raster, conservative: Conservative::Overestimate, ..DrawState::default() };
    let ordered = DrawState { depth: DepthState { compare: Compare::Always, write: false }, ..visible };
    for state in [visible, ordered] {
        let wanted = drawn(&Quick, &triangle, state, &mut renderer(Simd::Scalar));
        assert!(f32::from_bits(wanted[20][0]).is_nan());
        for simd in Simd::available() {
            for tile in TileSize::ALL {
                let mut renderer = Renderer::new(Settings { simd, tile, ..Settings::default() }).expect("available");
                assert!(wanted == drawn(&Quick, &triangle, state, &mut renderer), "{simd}, {tile:?}");
            }
        }
    }
}

/// A triangle that covers some of the picture, as a rule most of it.
fn triangle(random: &mut Random) -> Vec<Vertex> {
    let reach = random.pick(&[70.0, 400.0, 2_000.0, 20_000.0]);
    // On pixels' centres, edge functions are multiples of 256 there.
    let is_on_centers = random.one_in(2);
    let constant = random.one_in(2);
    let turn = random.real(0.0, 6.3);
    (0..3u8)
        .map(|k| {
            let angle = turn + 2.1 * f32::from(k) + random.real(-0.3, 0.3);
            let place = [100.0 + reach * angle.cos(), 75.0 + reach * angle.sin()];
            let [x, y] = place.map(|v| if is_on_centers { v.floor() + 0.5 } else { v });
            let mut values = [random.real(-9.0, 9.0), random.real(0.0, 1.0), random.real(-1.0, 1.0)];
            if constant {
                values[1] = 0.75;
            }
            ([x, y, random.real(0.0, 1.0), random.pick(&[1.0, 1.0, 0.1, 30.0])], values)
        })
        .collect()
}

#[test]
fn a_large_triangle_has_the_bits_that_it_has_with_a_flat_varying() {
    let visible = DrawState { space: Space::Raster, ..DrawState::default() };
    let ordered = DrawState { depth: DepthState { compare: Compare::Always, write: false }, ..visible };
    let mut renderers: Vec<_> = Simd::available().into_iter().map(|simd| (simd, renderer(simd))).collect();
    for seed in 0..if cfg!(debug_assertions) { 40 } else { 400 } {
        let triangle = triangle(&mut Random::new(seed ^ 0x1a26e));
        let values = drawn(&InFull, &triangle, visible, &mut renderer(Simd::Scalar));
        let derivatives = drawn(&InFullDerivatives, &triangle, visible, &mut renderer(Simd::Scalar));
        for state in [visible, ordered] {
            for (simd, renderer) in &mut renderers {
                assert!(values == drawn(&Quick, &triangle, state, renderer), "seed {seed}: values at {simd}");
                let found = drawn(&QuickDerivatives, &triangle, state, renderer);
                assert!(derivatives == found, "seed {seed}: derivatives at {simd}");
            }
        }
    }
}

/// What all packets of a triangle share is written to a batch once; the next picture's triangle has the same number.
#[test]
fn the_next_pictures_triangle_is_not_taken_for_the_last_ones() {
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    let mut renderer = renderer(Simd::Auto);
    for value in [0.25, 0.75] {
        let corner = |x, y| ([x, y, 0.5, 1.0], [value; 3]);
        let triangle = [corner(-500.0, -500.0), corner(900.0, -500.0), corner(-500.0, 900.0)];
        let color = [value, value, value, 1.0].map(f32::to_bits);
        assert!(drawn(&Quick, &triangle, state, &mut renderer).contains(&color), "{value}");
    }
}
