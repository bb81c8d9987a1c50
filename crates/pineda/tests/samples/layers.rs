//! Triangles over many blocks, blended one after the other: they have a quick way of their own, which counted passes do not take.

use crate::common::{channel, settings};
use pineda::*;
use pineda_oracle::cases::Random;

const WIDTH: u32 = 150;
const HEIGHT: u32 = 101;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;

/// Colours with perspective, and the rest of what a fragment is told.
struct Tinted;

#[shader]
impl Shader for Tinted {
    type Vertex = ([f32; 4], [f32; 4]);
    type Varyings<L: Lanes> = Rgba<L>;
    fn vertex(&self, &(position, color): &Self::Vertex) -> (Vec4, Rgba) {
        (position.into(), color.into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let front = f.front_facing().select(0.0, 0.125);
        Rgba { r: f.r + front, g: f.g * f.z(), b: f.b + (f.x() + f.y()) / 1024.0, a: f.a }
    }
}

/// A pass of a few triangles, and what the target holds before it.
struct Case {
    vertices: Vec<([f32; 4], [f32; 4])>,
    draws: Vec<DrawState>,
    colors: Vec<[f32; 4]>,
    depths: Vec<f32>,
    format: u64,
}

/// What it holds afterwards, as bits, and the triangle that each pixel shows.
type Picture = (Vec<u32>, Vec<u32>, Vec<u32>);

impl Case {
    fn random(seed: u64) -> Self {
        let random = &mut Random::new(seed);
        let is_opaque = random.one_in(2);
        let is_usual = random.one_in(2);
        let colors = (0..PIXELS).map(|_| {
            [channel(random), channel(random), channel(random), if is_opaque { 1.0 } else { channel(random) }]
        });
        let colors = colors.collect();
        let depths = (0..PIXELS).map(|_| random.unit()).collect();
        let (mut vertices, mut draws) = (vec![], vec![]);
        for _ in 0..3 {
            for _ in 0..3 {
                triangle(random, &mut vertices);
            }
            let depth = DepthState { compare: random.pick(&Compare::ALL), write: random.one_in(2) };
            let blend = random.pick(&[
                Blend::ALPHA,
                Blend::PREMULTIPLIED,
                Blend::ADD,
                Blend::MULTIPLY,
                Blend::MAX,
                Blend::OPAQUE,
            ]);
            let color_mask = random.pick(&[ColorMask::ALL, ColorMask::ALL, ColorMask::COLOR, ColorMask::NONE]);
            let usual = DrawState { blend: Blend::ALPHA, depth, ..DrawState::default() };
            draws.push(if is_usual { usual } else { DrawState { blend, color_mask, ..usual } });
        }
        Self { vertices, draws, colors, depths, format: if is_usual { 0 } else { random.bits() % 3 } }
    }

    fn render(&self, settings: Settings, is_counted: bool) -> Picture {
        let mut pass = Pass::new();
        pass.clear_color = None;
        pass.clear_depth = None;
        for (vertices, &state) in self.vertices.chunks(9).zip(&self.draws) {
            pass.draw(&Tinted, Mesh { vertices, indices: Indices::Sequential }, state);
        }
        let code = |c: f32| (c.clamp(0.0, 1.0) * 255.0) as u8;
        let mut bytes: Vec<[u8; 4]> = self.colors.iter().map(|color| color.map(code)).collect();
        let mut floats = self.colors.clone();
        let (mut depths, mut ids) = (self.depths.clone(), vec![0; PIXELS]);
        let color = match self.format {
            0 => ColorBuffer::Rgba8(&mut bytes),
            1 => ColorBuffer::Rgba8Srgb(&mut bytes),
            _ => ColorBuffer::Rgba32F(&mut floats),
        };
        let depth = DepthBuffer::D32F(&mut depths);
        let mut target = Target { color, depth, triangle_ids: Some(&mut ids), ..Target::new(WIDTH, HEIGHT) };
        let mut renderer = Renderer::new(settings).unwrap();
        if is_counted {
            renderer.render_counted(&pass, &mut target).unwrap();
        } else {
            renderer.render(&pass, &mut target).unwrap();
        }
        let colors = match self.format {
            2 => floats.as_flattened().iter().map(|c| c.to_bits()).collect(),
            _ => bytes.iter().map(|&bytes| u32::from_le_bytes(bytes)).collect(),
        };
        (colors, depths.iter().map(|z| z.to_bits()).collect(), ids)
    }
}

/// One triangle: from a few blocks to far beyond the picture, on the pixels' corners or anywhere, in perspective or not.
fn triangle(random: &mut Random, vertices: &mut Vec<([f32; 4], [f32; 4])>) {
    let (reach, grid) = (random.pick(&[40, 300, 3000, 12_000]), random.pick(&[1, 128, 256]));
    let is_flat = random.one_in(2);
    let one_color = [channel(random), channel(random), channel(random), random.unit()];
    for _ in 0..3 {
        let w = if is_flat { 1.0 } else { random.real(0.5, 2.0) };
        let place = |random: &mut Random, size: u32| {
            let center = i64::from(size) * 128;
            (random.between(center - reach * 256, center + reach * 256) / grid * grid) as f32 / 256.0
        };
        let (x, y) = (place(random, WIDTH), place(random, HEIGHT));
        let (x, y) = (2.0 * x / WIDTH as f32 - 1.0, 2.0 * y / HEIGHT as f32 - 1.0);
        let mut color = one_color;
        let which = random.between(0, 4) as usize;
        if which < 4 {
            color[which] = channel(random);
        }
        vertices.push(([x * w, y * w, random.real(0.1, 0.9) * w, w], color));
    }
}

#[test]
fn layers_are_the_same_bits_whether_they_are_counted_or_not() {
    let cases = if cfg!(debug_assertions) { 24 } else { 160 };
    let mut shows = 0;
    for seed in 0..cases {
        let case = Case::random(seed);
        let slow = Settings { simd: Simd::available()[0], threads: 1, tile: TileSize::T32, ..Settings::default() };
        let expected = case.render(slow, true);
        shows += expected.2.iter().filter(|&&id| id != 0).count();
        for settings in settings(seed) {
            let name = format!("case {seed}, {settings:?}");
            assert!(case.render(settings, false) == expected, "{name}");
        }
    }
    assert!(shows > cases as usize * PIXELS / 4, "{shows} pixels");
}

/// What `src/shading/over.rs` relies on: opaque stays opaque, and no sum is above 1.
#[test]
fn an_alpha_and_what_is_left_of_one_are_one() {
    let all = 0..=1.0f32.to_bits();
    for a in all.step_by(if cfg!(debug_assertions) { 4001 } else { 257 }).map(f32::from_bits).chain([1.0]) {
        assert_eq!(a + (1.0 - a), 1.0, "{a}");
    }
}
