//! Scenes with textures: every filter, wrap mode and kind, near and far.

use crate::looks::Vertex;
use crate::scenes::{Layer, Look, RASTER};
use crate::shapes::{Shape, soup};
use pineda::*;
use std::sync::LazyLock;

/// A texture on a surface whose colours are coordinates.
pub(crate) struct Textured {
    pub(crate) camera: Mat4,
    pub(crate) show: Show,
    pub(crate) sampler: Sampler,
}

/// Which texture, and how.
#[derive(Clone, Copy)]
pub(crate) enum Show {
    /// Letters on a chequered ground.
    Letters,
    /// A chequered floor of black and white.
    Checks,
    /// Each level in a colour of its own.
    Levels,
    /// The direction.
    Cube,
    /// All three coordinates.
    Volume,
    /// The third coordinate compared with the texture.
    Compare,
}

struct Pictures {
    letters: Texture2d<'static>,
    checks: Texture2d<'static>,
    levels: Texture2d<'static>,
    cube: TextureCube<'static>,
    volume: Texture3d<'static>,
    heights: Texture2d<'static, R32F>,
}

/// An arrow with a corner: it looks the same neither turned nor mirrored.
const LETTER: [&str; 8] =
    ["........", ".#####..", ".#......", ".####...", ".#......", ".#...##.", ".#...##.", "........"];

/// 16 x 16 texels, a letter in each quarter.
fn letters(tint: [u8; 3]) -> Vec<[u8; 4]> {
    let texel = |k: usize| {
        let (x, y) = (k % 16, k / 16);
        let is_ink = LETTER[y % 8].as_bytes()[x % 8] == b'#';
        let [r, g, b] = if is_ink { [250, 245, 230] } else { tint };
        let dark = |c: u8| if (x / 8 + y / 8) % 2 == 0 || is_ink { c } else { c / 3 };
        [dark(r), dark(g), dark(b), 255]
    };
    (0..256).map(texel).collect()
}

static PICTURES: LazyLock<Pictures> = LazyLock::new(|| {
    let tints = [[200, 60, 40], [40, 130, 200], [60, 170, 70], [190, 150, 40], [150, 70, 180], [90, 160, 160]];
    let checks: Vec<[u8; 4]> =
        (0..64 * 64).map(|k| if (k / 32 % 2) ^ (k / 2048) == 0 { [255; 4] } else { [0, 0, 0, 255] }).collect();
    let levels = [[255, 0, 0], [255, 160, 0], [240, 240, 0], [0, 200, 0], [0, 200, 220], [40, 60, 255], [200, 0, 200]];
    let levels = levels.iter().enumerate().flat_map(|(level, &[r, g, b])| vec![[r, g, b, 255]; 4096 >> (2 * level)]);
    let volume = (0..8 * 8 * 8).map(|k: u32| {
        let at = [k % 8, k / 8 % 8, k / 64].map(|c| c as f32 / 7.0);
        let is_in = at.iter().map(|c| (c - 0.5) * (c - 0.5)).sum::<f32>() < 0.2;
        let [r, g, b] = if is_in { at } else { [0.02; 3] };
        [r, g, b, 1.0].map(|c| (c * 255.0) as u8)
    });
    let heights: Vec<f32> = (0..64).map(|k: u32| (k.wrapping_mul(0x9e37_79b1) >> 24) as f32 / 255.0).collect();
    let all: Vec<_> = tints.iter().flat_map(|&tint| letters(tint)).collect();
    let pictures = || -> Result<Pictures, Error> {
        Ok(Pictures {
            letters: Texture2d::new(16, 16, letters([200, 60, 40]))?.with_mips()?,
            checks: Texture2d::new(64, 64, checks)?.with_mips()?,
            levels: Texture2d::with_levels(64, 64, 7, levels.collect::<Vec<_>>())?,
            cube: TextureCube::new(16, all)?.with_mips()?,
            volume: Texture3d::new(8, 8, 8, volume.collect::<Vec<_>>())?.with_mips()?,
            heights: Texture2d::new(8, 8, heights)?,
        })
    };
    pictures().expect("valid textures")
});

#[shader]
impl Shader for Textured {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec3<L>;
    const DERIVATIVES: bool = true;
    fn vertex(&self, v: &Vertex) -> (Vec4, Vec3) {
        let [u, v_, w, _] = v.color;
        (self.camera * Vec4::from(v.position), [u, v_, w].into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (at, sampler, pictures) = (f.dual(), &self.sampler, &*PICTURES);
        let flat = match self.show {
            Show::Checks => &pictures.checks,
            Show::Levels => &pictures.levels,
            _ => &pictures.letters,
        };
        match self.show {
            Show::Letters | Show::Checks | Show::Levels => flat.sample(sampler, at.xy()),
            Show::Cube => pictures.cube.sample(sampler, at),
            Show::Volume => pictures.volume.sample(sampler, at),
            Show::Compare => Rgba::gray(pictures.heights.sample_compare(sampler, f.xy(), f.z)),
        }
    }
}

/// A rectangle in pixels with coordinates at its corners: upper left, upper right, lower right, lower left.
fn rectangle([x, y, width, height]: [f32; 4], coordinates: [[f32; 3]; 4], show: Show, sampler: Sampler) -> Layer {
    let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
    let vertex = |k: usize| Vertex {
        position: [corners[k][0], corners[k][1], 0.5, 1.0],
        color: [coordinates[k][0], coordinates[k][1], coordinates[k][2], 1.0],
        ..Vertex::default()
    };
    let shape = Shape { vertices: (0..4).map(vertex).collect(), indices: vec![0, 1, 2, 0, 2, 3] };
    Layer { shape, look: Look::Textured(Textured { camera: Mat4::IDENTITY, show, sampler }), state: RASTER }
}

/// Coordinates from (low, low) to (high, high), the third the same.
fn square(low: f32, high: f32, third: f32) -> [[f32; 3]; 4] {
    [[low, low, third], [high, low, third], [high, high, third], [low, high, third]]
}

/// A floor from below the eye to the horizon, coordinates as large as places.
fn floor([x, width]: [f32; 2], show: Show, sampler: Sampler) -> Layer {
    let viewport = Viewport { x, y: 4.0, width, height: 195.0, min_depth: 0.0, max_depth: 1.0 };
    let camera = Mat4::perspective(0.9, width / 195.0, 0.1, 500.0)
        * Mat4::look_at([0.0, 1.0, 0.0], [0.1, 0.82, -1.0], [0.0, 1.0, 0.0]);
    let corners = [[-300.0, 300.0], [300.0, 300.0], [300.0, -400.0], [-300.0, -400.0]];
    let vertex = |[x, z]: [f32; 2]| Vertex {
        position: [x, 0.0, z, 1.0],
        color: [0.5 * x, 0.5 * z, 0.0, 1.0],
        ..Vertex::default()
    };
    let shape = Shape { vertices: corners.map(vertex).into(), indices: vec![0, 1, 2, 0, 2, 3] };
    let state = DrawState { viewport: Some(viewport), ..DrawState::default() };
    Layer { shape, look: Look::Textured(Textured { camera, show, sampler }), state }
}

/// Nearest, bilinear, trilinear and anisotropic: large above, small below.
pub(crate) fn filters() -> Vec<Layer> {
    let samplers = [Sampler::NEAREST, Sampler::BILINEAR, Sampler::TRILINEAR, Sampler::ANISOTROPIC];
    let mut layers = Vec::new();
    for (k, sampler) in samplers.into_iter().enumerate() {
        let x = 3.0 + 78.5 * k as f32;
        layers.push(rectangle([x, 4.0, 75.0, 75.0], square(0.05, 0.6, 0.0), Show::Letters, sampler));
        // As many texels as pixels at the left, eight times as many at the right.
        let narrowing = [[0.0, 0.0, 0.0], [20.0, 0.0, 0.0], [12.0, 6.0, 0.0], [0.0, 2.0, 0.0]];
        layers.push(rectangle([x, 83.0, 75.0, 56.0], narrowing, Show::Letters, sampler));
        let flat = [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 40.0, 0.0], [0.0, 40.0, 0.0]];
        layers.push(rectangle([x, 143.0, 75.0, 56.0], flat, Show::Letters, sampler));
    }
    layers
}

/// Repeat, mirror, clamp and border, from two textures left to two right: nearest above, linear below.
pub(crate) fn wraps() -> Vec<Layer> {
    let mut layers = Vec::new();
    for (row, sampler) in [Sampler::NEAREST, Sampler::TRILINEAR].into_iter().enumerate() {
        for (k, wrap) in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp, Wrap::Border].into_iter().enumerate() {
            let sampler = Sampler { wrap: [wrap; 3], border: [0.1, 0.3, 0.8, 1.0], ..sampler };
            let place = [3.0 + 78.5 * k as f32, 4.0 + 99.0 * row as f32, 75.0, 96.0];
            layers.push(rectangle(place, square(-1.3, 2.3, 0.0), Show::Letters, sampler));
        }
    }
    layers
}

/// Slices of a volume; a cube from outside, by direction; comparisons, nearest and filtered.
pub(crate) fn kinds() -> Vec<Layer> {
    let mut layers = Vec::new();
    for slice in 0..8u8 {
        let third = (f32::from(slice) + 0.5) / 8.0;
        let place = [3.0 + 39.0 * f32::from(slice % 4), 4.0 + 64.0 * f32::from(slice / 4), 37.0, 60.0];
        layers.push(rectangle(place, square(0.0, 1.0, third), Show::Volume, Sampler::TRILINEAR));
    }
    // Three faces, their edges and their corner; and one across two edges only, seen large.
    let directions = [[-1.0, 1.2, 1.0], [1.2, 1.0, -1.0], [1.0, -1.2, 1.2], [-1.2, -1.0, 1.3]];
    layers.push(rectangle([161.0, 4.0, 153.0, 124.0], directions, Show::Cube, Sampler::BILINEAR));
    let corner = [[0.6, 1.0, 0.8], [1.0, 1.0, 0.6], [1.0, 0.6, 1.0], [0.8, 0.8, 1.2]];
    layers.push(rectangle([161.0, 132.0, 74.0, 67.0], corner, Show::Cube, Sampler::BILINEAR));
    let nearest = Sampler { mag_filter: Filter::Nearest, ..Sampler::SHADOW };
    for (x, sampler) in [(3.0, nearest), (82.0, Sampler::SHADOW)] {
        let slope = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [1.0, 1.0, 1.0], [0.0, 1.0, 0.8]];
        layers.push(rectangle([x, 132.0, 75.0, 67.0], slope, Show::Compare, sampler));
    }
    layers.push(rectangle([239.0, 132.0, 75.0, 67.0], square(0.0, 14.0, 0.5), Show::Volume, Sampler::TRILINEAR));
    layers
}

/// Each level in its colour: to the nearest level, trilinear, anisotropic.
pub(crate) fn levels() -> Vec<Layer> {
    let samplers = [Sampler::BILINEAR, Sampler::TRILINEAR, Sampler::ANISOTROPIC];
    let floors = samplers.into_iter().enumerate();
    floors.map(|(k, sampler)| floor([3.0 + 105.0 * k as f32, 101.0], Show::Levels, sampler)).collect()
}

/// A chequered floor: trilinear on the left, anisotropic on the right.
pub(crate) fn checks() -> Vec<Layer> {
    vec![
        floor([3.0, 154.0], Show::Checks, Sampler::TRILINEAR),
        floor([160.0, 154.0], Show::Checks, Sampler::ANISOTROPIC),
    ]
}

/// Triangles with texels of all sizes, w at random: at the lowest sample that they cover, at pixels' centres, and once a sample. Above as they are, below added to each other.
pub(crate) fn samples() -> Vec<Layer> {
    let mut layers = Vec::new();
    for (column, sampling) in [Sampling::Centroid, Sampling::Center, Sampling::Sample].into_iter().enumerate() {
        for (row, blend) in [Blend::OPAQUE, Blend::ADD].into_iter().enumerate() {
            let mut shape = soup(43, 14, 30.0, [94.0, 90.0]);
            for (k, vertex) in shape.vertices.iter_mut().enumerate() {
                vertex.position[0] += 5.0 + 103.0 * column as f32;
                vertex.position[1] += 4.0 + 101.0 * row as f32;
                let size = [1.0, 3.0, 12.0, 0.3][k / 3 % 4];
                vertex.color = vertex.color.map(|c| c * size);
            }
            let sampler = [Sampler::TRILINEAR, Sampler::ANISOTROPIC][column % 2];
            let look = Textured { camera: Mat4::IDENTITY, show: Show::Letters, sampler };
            let depth = if row == 0 { DepthState::default() } else { DepthState::OFF };
            let state = DrawState { sampling, blend, depth, ..RASTER };
            layers.push(Layer { shape, look: Look::Textured(look), state });
        }
    }
    layers
}

/// All samples of that scene shaded by sample, the raster moved so that a place of a pixel, in 1/16, lies where its centre was.
fn shaded_by_sample(samples: Samples, [x, y]: [u8; 2], settings: Settings) -> Vec<[u32; 4]> {
    let mut layers = self::samples();
    for layer in &mut layers {
        layer.state.sampling = Sampling::Sample;
        for vertex in &mut layer.shape.vertices {
            // Exact in subpixels, moved or not.
            vertex.position[0] = (vertex.position[0] * 256.0).round() / 256.0 - (f32::from(x) - 8.0) / 16.0;
            vertex.position[1] = (vertex.position[1] * 256.0).round() / 256.0 - (f32::from(y) - 8.0) / 16.0;
        }
    }
    let mut pass = Pass::new();
    layers.iter().for_each(|layer| layer.draw(&mut pass));
    let mut pixels = vec![[0.0; 4]; 317 * 203 * samples.count()];
    let mut target = Target { samples, color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(317, 203) };
    Renderer::new(settings).expect("an available level").render(&pass, &mut target).expect("a valid scene");
    pixels.into_iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

/// Opaque or blended, with levels of detail from derivatives: a sample is looked up as the centre of a pixel that lies there is.
#[test]
fn textured_samples_are_as_many_pictures_of_the_moved_scene() {
    let settings = |threads, tile| Settings { threads, tile, ..Settings::default() };
    for samples in [Samples::Two, Samples::Eight] {
        let all = shaded_by_sample(samples, [8, 8], settings(2, TileSize::T16));
        for (picture, &position) in all.chunks(317 * 203).zip(samples.positions()) {
            let moved = shaded_by_sample(Samples::One, position, settings(1, TileSize::T64));
            let different = picture.iter().zip(&moved).position(|(a, b)| a != b);
            assert_eq!(different, None, "{samples:?} at {position:?}");
        }
    }
}
