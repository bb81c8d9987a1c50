//! Every format of textures: a contact sheet of formats by samplers, wraps and dimensions.
//!
//! Each tile shows its texture twice: large on the left, and on the right so small, and smaller down than across, that levels and anisotropy count. Gradients are explicit, so that closures can look them up: these
//! are compiled once, and not for every SIMD level.

use crate::looks::Vertex;
use crate::scenes::{Layer, Look, RASTER};
use crate::shapes::Shape;
use pineda::*;
use std::sync::LazyLock;

/// A texture, how it is sampled, and by how much coordinates change a pixel right and a pixel down.
#[derive(Clone, Copy)]
pub(crate) struct Tile {
    texture: &'static Source,
    sampler: Sampler,
    dx: [f32; 2],
    dy: [f32; 2],
}

type DrawTile = Box<dyn for<'a> Fn(&mut Pass<'a>, Mesh<'a, Vertex>, DrawState, Tile) + Send + Sync>;

/// A texture with its format's code.
struct Source(DrawTile);

impl Tile {
    pub(crate) fn draw<'a>(self, pass: &mut Pass<'a>, mesh: Mesh<'a, Vertex>, state: DrawState) {
        (self.texture.0)(pass, mesh, state, self);
    }
}

/// What all vertex stages here are.
fn place(v: &Vertex) -> (Vec4, Vec2) {
    (v.position.into(), Vec2::from([v.color[0], v.color[1]]))
}

/// Texels of a side.
const SIDE: u32 = 16;

/// A hook with a corner, on a ground whose red grows to the right and whose green grows downwards; `third` is its blue.
fn numbers(k: u32, side: u32, third: f32) -> [f32; 4] {
    let [x, y] = [k % side, k / side % side].map(|c| c as f32 / side as f32);
    let is_ink = (x - 0.3).abs() < 0.1 && (y - 0.5).abs() < 0.35 || (y - 0.2).abs() < 0.1 && x > 0.2 && x < 0.8;
    if is_ink { [1.0, 0.75, 0.5, 1.0] } else { [x, y, third, 0.25 + 0.5 * x] }
}

/// `slices` pictures, one after the other.
fn texels<F: Filterable>(side: u32, slices: u32) -> Vec<F::Texel> {
    (0..side * side * slices).map(|k| F::nearest(numbers(k, side, (k / (side * side)) as f32 / 6.0))).collect()
}

macro_rules! source {
    ($texture:expr, |$tile:ident, $t:ident, $uv:ident, $dx:ident, $dy:ident| $lookup:expr) => {{
        let texture = $texture.expect("a valid texture");
        let texture: &'static _ = Box::leak(Box::new(texture));
        Source(Box::new(move |pass, mesh, state, $tile: Tile| {
            pass.draw_with(mesh, state, place, move |f| {
                let ($t, $uv, $dx, $dy) = (texture, f.varyings(), f.splat($tile.dx), f.splat($tile.dy));
                $lookup
            });
        }))
    }};
}

fn flat<F: Filterable>() -> Source {
    let texture = Texture2d::<F>::new(SIDE, SIDE, texels::<F>(SIDE, 1)).and_then(|t| t.with_mips());
    source!(texture, |tile, t, uv, dx, dy| t.sample_grad(&tile.sampler, uv, dx, dy))
}

/// Three layers: the middle one.
fn layers<F: Filterable>() -> Source {
    let texture = Texture2dArray::<F>::new(SIDE, SIDE, 3, texels::<F>(SIDE, 3)).and_then(|t| t.with_mips());
    source!(texture, |tile, t, uv, dx, dy| {
        let layer = Int::new(uv.x.lanes(), 1);
        t.sample_grad(&tile.sampler, uv, layer, dx, dy)
    })
}

/// Over an edge and near a corner.
fn cube<F: Filterable>() -> Source {
    let texture = TextureCube::<F>::new(SIDE, texels::<F>(SIDE, 6)).and_then(|t| t.with_mips());
    source!(texture, |tile, t, uv, dx, dy| {
        let direction = Vec3::new(uv.x * 2.0 - 0.2, uv.y * 2.0 - 0.6, Real::new(uv.x.lanes(), 1.0));
        t.sample_grad(&tile.sampler, direction, (dx * 2.0).extend(0.0), (dy * 2.0).extend(0.0))
    })
}

/// Deeper from left to right.
fn volume<F: Filterable>() -> Source {
    let texture = Texture3d::<F>::new(8, 8, 8, texels::<F>(8, 8)).and_then(|t| t.with_mips());
    source!(texture, |tile, t, uv, dx, dy| {
        t.sample_grad(&tile.sampler, uv.extend(uv.x * 0.5), dx.extend(dx.x * 0.5), dy.extend(dy.x * 0.5))
    })
}

/// Integers are fetched: here from 0 to 255.
macro_rules! integers {
    ($format:ident, $plain:ty) => {{
        let texel = |k: u32| {
            let all = numbers(k, SIDE, 0.5).map(|c| (c * 255.0) as $plain);
            <$format as TextureFormat>::Texel::of(all)
        };
        let texture = Texture2d::<$format>::new(SIDE, SIDE, (0..SIDE * SIDE).map(texel).collect::<Vec<_>>());
        source!(texture, |_tile, t, uv, _dx, _dy| {
            let [x, y] = [uv.x, uv.y].map(|c| (c * SIDE as f32).to_int());
            let color = t.fetch(x, y, Int::new(x.lanes(), 0));
            let [r, g, b, a] = [color.r, color.g, color.b, color.a].map(|c| c.to_real() * (1.0 / 255.0));
            Rgba { r, g, b, a }
        })
    }};
}

/// A texel of one, two or four integers.
trait Texel<T> {
    fn of(numbers: [T; 4]) -> Self;
}

macro_rules! texels_of {
    ($($plain:ty)+) => {$(
        impl Texel<$plain> for $plain {
            fn of([r, ..]: [$plain; 4]) -> Self { r }
        }
        impl Texel<$plain> for [$plain; 2] {
            fn of([r, g, ..]: [$plain; 4]) -> Self { [r, g] }
        }
        impl Texel<$plain> for [$plain; 4] {
            fn of(numbers: [$plain; 4]) -> Self { numbers }
        }
    )+};
}

texels_of!(u32 i32);

/// All that can be filtered, as 2D textures.
static FLAT: LazyLock<[Source; 15]> = LazyLock::new(|| {
    [
        flat::<R8>(),
        flat::<Rg8>(),
        flat::<Rgba8>(),
        flat::<R8Srgb>(),
        flat::<Rg8Srgb>(),
        flat::<Rgba8Srgb>(),
        flat::<R16>(),
        flat::<Rg16>(),
        flat::<Rgba16>(),
        flat::<R16F>(),
        flat::<Rg16F>(),
        flat::<Rgba16F>(),
        flat::<R32F>(),
        flat::<Rg32F>(),
        flat::<Rgba32F>(),
    ]
});

/// Of other dimensions one format of each width of a channel.
static OTHERS: LazyLock<[Source; 12]> = LazyLock::new(|| {
    [
        layers::<R8>(),
        layers::<Rgba8Srgb>(),
        layers::<Rg16F>(),
        layers::<Rgba32F>(),
        cube::<R8>(),
        cube::<Rgba8Srgb>(),
        cube::<Rg16F>(),
        cube::<Rgba32F>(),
        volume::<R8>(),
        volume::<Rgba8Srgb>(),
        volume::<Rg16F>(),
        volume::<Rgba32F>(),
    ]
});

static INTEGERS: LazyLock<[Source; 6]> = LazyLock::new(|| {
    [
        integers!(R32U, u32),
        integers!(Rg32U, u32),
        integers!(Rgba32U, u32),
        integers!(R32I, i32),
        integers!(Rg32I, i32),
        integers!(Rgba32I, i32),
    ]
});

/// Both halves of the tile in a column and a row.
fn tile(layers: &mut Vec<Layer>, column: usize, row: usize, texture: &'static Source, sampler: Sampler) {
    let corner = [3.0 + 26.0 * column as f32, 4.0 + 13.0 * row as f32];
    // Where a half begins, its coordinates there, and how they change: a third of a texel a pixel; three across and eight down.
    for (x, first, dx, dy) in [
        (0.0, [-0.1, -0.1], [0.35 / 16.0 * 4.0, 0.01], [-0.01, 0.35 / 16.0 * 4.0]),
        (12.0, [0.1, 0.0], [3.0 / 16.0, 0.5 / 16.0], [1.0 / 16.0, 8.0 / 16.0]),
    ] {
        let vertex = |[i, j]: [f32; 2]| Vertex {
            position: [corner[0] + x + i, corner[1] + j, 0.5, 1.0],
            color: [first[0] + i * dx[0] + j * dy[0], first[1] + i * dx[1] + j * dy[1], 0.0, 1.0],
            ..Vertex::default()
        };
        let vertices = [[0.0, 0.0], [12.0, 0.0], [12.0, 12.0], [0.0, 12.0]].map(vertex).into();
        let shape = Shape { vertices, indices: vec![0, 1, 2, 0, 2, 3] };
        layers.push(Layer { shape, look: Look::Tile(Tile { texture, sampler, dx, dy }), state: RASTER });
    }
}

/// A row for each format. Columns: nearest, bilinear, trilinear, anisotropic; anisotropic repeated, mirrored, clamped, with a border; then the same four samplers on arrays, cubes and volumes, and below them integers.
pub(crate) fn sheet() -> Vec<Layer> {
    let samplers = [Sampler::NEAREST, Sampler::BILINEAR, Sampler::TRILINEAR, Sampler::ANISOTROPIC];
    let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp, Wrap::Border];
    let mut layers = Vec::new();
    for (row, texture) in FLAT.iter().enumerate() {
        for (k, (sampler, wrap)) in samplers.into_iter().zip(wraps).enumerate() {
            tile(&mut layers, k, row, texture, sampler);
            let wrapped = Sampler { wrap: [wrap; 3], border: [0.1, 0.3, 0.8, 1.0], ..Sampler::ANISOTROPIC };
            tile(&mut layers, 4 + k, row, texture, wrapped);
        }
    }
    for (row, texture) in OTHERS.iter().enumerate() {
        for (k, sampler) in samplers.into_iter().enumerate() {
            tile(&mut layers, 8 + k, row, texture, sampler);
        }
    }
    for (k, texture) in INTEGERS.iter().enumerate() {
        tile(&mut layers, 8 + k % 3, 12 + k / 3, texture, Sampler::NEAREST);
    }
    layers
}
