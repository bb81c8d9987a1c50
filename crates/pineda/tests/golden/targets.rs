//! Golden pictures of every format, of several colour buffers at once, of dual-source blending, and of passes that go on from one another.
//!
//! Their hashes are in `targets.txt`; for the rest see `main.rs`. Pictures are PNG, the buffers of a scene side by side.

use crate::shapes::{Shape, rectangle, soup};
use pineda::*;
use std::fmt::Write as _;
use std::path::Path;

const HASHES: &str = include_str!("targets.txt");
const WIDTH: usize = 96;
const HEIGHT: usize = 64;
const PIXELS: usize = WIDTH * HEIGHT;

/// The words of one colour buffer, whatever its format.
#[derive(Clone, Debug, PartialEq)]
struct Buffer {
    format: &'static str,
    data: Vec<u64>,
}

/// Every format by its name: the variant, the type of a pixel, and what a pixel looks like.
macro_rules! formats {
    ($($name:ident: $pixel:ty, |$p:ident| $look:expr;)+) => {
        const FORMATS: &[&str] = &[$(stringify!($name)),+];

        impl Buffer {
            fn color(&mut self) -> ColorBuffer<'_> {
                match self.format {
                    $(stringify!($name) => {
                        ColorBuffer::$name(&mut bytemuck::cast_slice_mut::<u64, $pixel>(&mut self.data)[..PIXELS])
                    })+
                    _ => ColorBuffer::None,
                }
            }

            /// Red, green and blue in linear light, for people.
            fn look(&self, at: usize) -> [f32; 3] {
                match self.format {
                    $(stringify!($name) => {
                        let $p = bytemuck::cast_slice::<u64, $pixel>(&self.data)[at];
                        $look
                    })+
                    _ => [0.0; 3],
                }
            }

            /// In little endian, whatever the machine has.
            fn bytes(&self) -> Vec<u8> {
                match self.format {
                    $(stringify!($name) => {
                        let pixels = &bytemuck::cast_slice::<u64, $pixel>(&self.data)[..PIXELS];
                        pixels.iter().flat_map(|pixel| pixel.bytes()).collect()
                    })+
                    _ => Vec::new(),
                }
            }
        }
    };
}

/// A pixel's bytes in little endian.
trait Bytes {
    fn bytes(self) -> Vec<u8>;
}

macro_rules! bytes {
    ($($number:ty)+) => {$(
        impl Bytes for $number {
            fn bytes(self) -> Vec<u8> {
                self.to_le_bytes().to_vec()
            }
        }
    )+};
}

bytes!(u8 u16 u32 i32 f32);

impl<T: Bytes, const N: usize> Bytes for [T; N] {
    fn bytes(self) -> Vec<u8> {
        self.into_iter().flat_map(Bytes::bytes).collect()
    }
}

fn unit<T: Into<f64>>(code: T, most: f64) -> f32 {
    (code.into() / most) as f32
}

fn srgb(code: u8) -> f32 {
    unit(code, 255.0).powf(2.2)
}

fn low_byte(x: u32) -> f32 {
    unit(x & 255, 255.0)
}

formats! {
    R8: u8, |p| [unit(p, 255.0); 3];
    Rg8: [u8; 2], |p| [unit(p[0], 255.0), unit(p[1], 255.0), 0.0];
    Rgba8: [u8; 4], |p| [unit(p[0], 255.0), unit(p[1], 255.0), unit(p[2], 255.0)];
    R8Srgb: u8, |p| [srgb(p); 3];
    Rg8Srgb: [u8; 2], |p| [srgb(p[0]), srgb(p[1]), 0.0];
    Rgba8Srgb: [u8; 4], |p| [srgb(p[0]), srgb(p[1]), srgb(p[2])];
    R16: u16, |p| [unit(p, 65_535.0); 3];
    Rg16: [u16; 2], |p| [unit(p[0], 65_535.0), unit(p[1], 65_535.0), 0.0];
    Rgba16: [u16; 4], |p| [unit(p[0], 65_535.0), unit(p[1], 65_535.0), unit(p[2], 65_535.0)];
    R16F: u16, |p| [f16_to_f32(p); 3];
    Rg16F: [u16; 2], |p| [f16_to_f32(p[0]), f16_to_f32(p[1]), 0.0];
    Rgba16F: [u16; 4], |p| [f16_to_f32(p[0]), f16_to_f32(p[1]), f16_to_f32(p[2])];
    R32F: f32, |p| [p; 3];
    Rg32F: [f32; 2], |p| [p[0], p[1], 0.0];
    Rgba32F: [f32; 4], |p| [p[0], p[1], p[2]];
    R32U: u32, |p| [low_byte(p); 3];
    Rg32U: [u32; 2], |p| [low_byte(p[0]), low_byte(p[1]), 0.0];
    Rgba32U: [u32; 4], |p| [low_byte(p[0]), low_byte(p[1]), low_byte(p[2])];
    R32I: i32, |p| [low_byte(p as u32); 3];
    Rg32I: [i32; 2], |p| [low_byte(p[0] as u32), low_byte(p[1] as u32), 0.0];
    Rgba32I: [i32; 4], |p| [low_byte(p[0] as u32), low_byte(p[1] as u32), low_byte(p[2] as u32)];
}

/// Draws the corners' colours, and what else can be made of them.
macro_rules! looks {
    ($($name:ident: |$f:ident| -> $output:ty $do:block)+) => {$(
        struct $name;

        #[shader]
        impl Shader for $name {
            type Vertex = crate::looks::Vertex;
            type Varyings<L: Lanes> = Rgba<L>;
            fn vertex(&self, v: &Self::Vertex) -> (Vec4, Rgba) {
                (v.position.into(), v.color.into())
            }
            fn fragment<L: Lanes>(&self, $f: &mut Fragment<L, Self>) -> $output $do
        }
    )+};
}

outputs! {
    struct Eight {
        color: Rgba,
        turned: Rgba,
        red: Real,
        two: Vec2,
        codes: RgbaU,
        signed: RgbaI,
        number: Uint,
        three: Vec3,
    }
}

looks! {
    Plain: |f| -> Rgba<L> { f.varyings() }
    Unsigned: |f| -> RgbaU<L> { codes(f.varyings()) }
    Signed: |f| -> RgbaI<L> { signed(codes(f.varyings())) }
    Glass: |f| -> DualSource<L> {
        let c = f.varyings();
        DualSource { color: c * 0.1, factor: c }
    }
    Three: |f| -> [Rgba<L>; 3] { [f.varyings(); 3] }
    Many: |f| -> Eight<L> {
        let c = f.varyings();
        Eight {
            color: c,
            turned: Rgba { r: c.b, g: c.r, b: c.g, a: c.a },
            red: c.r,
            two: Vec2::new(c.g, c.b),
            codes: codes(c),
            signed: signed(codes(c)),
            number: codes(c).r ^ (f.x().to_uint() & f.y().to_uint()),
            three: c.rgb(),
        }
    }
}

/// Numbers beyond what an f32 holds exactly, the picture in their low bytes.
#[shader]
fn codes<L: Lanes>(c: Rgba<L>) -> RgbaU<L> {
    let code = |x: Real<L>| (x.clamp(0.0, 1.0) * 255.0).to_uint() | 0x8765_4300;
    RgbaU { r: code(c.r), g: code(c.g), b: code(c.b), a: code(c.a) }
}

#[shader]
fn signed<L: Lanes>(c: RgbaU<L>) -> RgbaI<L> {
    RgbaI { r: c.r.to_int(), g: c.g.to_int(), b: c.b.to_int(), a: c.a.to_int() }
}

/// A gradient over the whole picture, and triangles.
fn shapes() -> [Shape; 2] {
    let (width, height) = (WIDTH as f32, HEIGHT as f32);
    let corners = [[0.9, 0.1, 0.1, 1.0], [0.1, 0.9, 0.2, 0.8], [0.1, 0.2, 0.9, 0.6], [0.9, 0.9, 0.1, 0.4]];
    [rectangle([4.0, 4.0, width - 4.0, height - 4.0], 0.5, corners), soup(5, 14, 24.0, [width, height])]
}

fn mesh(shape: &Shape) -> Mesh<'_, crate::looks::Vertex> {
    Mesh { vertices: &shape.vertices, indices: Indices::U32(&shape.indices) }
}

const RASTER: DrawState = DrawState {
    space: Space::Raster,
    depth: DepthState { compare: Compare::Always, write: true },
    ..DrawState::DEFAULT
};

/// Executes passes on new buffers, which hold a pattern first.
fn drawn(settings: &Settings, formats: &[&'static str], passes: &[Pass<'_>]) -> Vec<Buffer> {
    let pattern = |at: usize| (at as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) & 0x3f3f_3f3f_3f3f_3f3f;
    let buffer = |&format: &&'static str| Buffer { format, data: (0..2 * PIXELS).map(pattern).collect() };
    let mut buffers: Vec<Buffer> = formats.iter().map(buffer).collect();
    let mut renderer = Renderer::new(settings.clone()).expect("an available level");
    for pass in passes {
        let mut colors = buffers.iter_mut().map(Buffer::color);
        let color = colors.next().expect("a first one");
        let more_colors = colors.collect();
        let mut target = Target { color, more_colors, ..Target::new(WIDTH as u32, HEIGHT as u32) };
        renderer.render(pass, &mut target).expect("a valid scene");
    }
    buffers
}

type Draw = Box<dyn Fn(&Settings) -> Vec<Buffer>>;

/// The pictures' names and how they are drawn.
fn scenes() -> Vec<(String, Draw)> {
    let mut scenes: Vec<(String, Draw)> = Vec::new();
    for &format in FORMATS {
        scenes.push((format!("format_{}", format.to_lowercase()), Box::new(move |s| of_format(s, format))));
    }
    scenes.push(("eight_at_once".into(), Box::new(eight_at_once)));
    scenes.push(("blended_apart".into(), Box::new(blended_apart)));
    scenes.push(("dual_source".into(), Box::new(dual_source)));
    scenes.push(("pass_after_pass".into(), Box::new(pass_after_pass)));
    scenes
}

/// A gradient, and triangles blended with it; of integers, both as they are.
fn of_format(settings: &Settings, format: &'static str) -> Vec<Buffer> {
    let [gradient, triangles] = shapes();
    let glass = DrawState { blend: Blend::ALPHA, ..RASTER };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.02, 0.05, 0.1, 1.0]);
    match format {
        "R32U" | "Rg32U" | "Rgba32U" => {
            pass.color_ops[0].load = Load::Clear([0x1234_5640u32; 4].into());
            pass.draw(&Unsigned, mesh(&gradient), RASTER).draw(&Unsigned, mesh(&triangles), RASTER);
        }
        "R32I" | "Rg32I" | "Rgba32I" => {
            pass.color_ops[0].load = Load::Clear([-64i32; 4].into());
            pass.draw(&Signed, mesh(&gradient), RASTER).draw(&Signed, mesh(&triangles), RASTER);
        }
        _ => {
            pass.draw(&Plain, mesh(&gradient), RASTER).draw(&Plain, mesh(&triangles), glass);
        }
    }
    drawn(settings, &[format], &[pass])
}

fn eight_at_once(settings: &Settings) -> Vec<Buffer> {
    let [gradient, triangles] = shapes();
    let mut glass = DrawState { blend: Blend::ALPHA, ..RASTER };
    for k in [4, 5, 6] {
        glass.colors[k] = Some(ColorState::default());
    }
    let mut pass = Pass::new();
    pass.clear_color = Some([0.02, 0.05, 0.1, 1.0]);
    pass.draw(&Many, mesh(&gradient), RASTER).draw(&Many, mesh(&triangles), glass);
    drawn(settings, &["Rgba8Srgb", "Rgba16F", "R8", "Rg16", "Rgba32U", "Rgba32I", "R32U", "Rgba32F"], &[pass])
}

/// The same colours added, multiplied without blue, and blended by alpha.
fn blended_apart(settings: &Settings) -> Vec<Buffer> {
    let [gradient, triangles] = shapes();
    let mut state = DrawState { blend: Blend::ALPHA, ..RASTER };
    state.colors[0] = Some(ColorState { blend: Blend::ADD, ..ColorState::default() });
    state.colors[1] = Some(ColorState { blend: Blend::MULTIPLY, mask: ColorMask { b: false, ..ColorMask::ALL } });
    let mut pass = Pass::new();
    pass.color_ops[1].load = Load::Clear([1.0, 1.0, 0.5, 1.0].into());
    pass.draw(&Three, mesh(&gradient), RASTER).draw(&Three, mesh(&triangles), state);
    drawn(settings, &["Rgba8Srgb", "Rgba16F", "Rgba8"], &[pass])
}

/// Coloured glass before a gradient: each channel is let through by what the glass has of it.
fn dual_source(settings: &Settings) -> Vec<Buffer> {
    let [gradient, triangles] = shapes();
    let through = BlendComponent { target: BlendFactor::Source1, ..BlendComponent::REPLACE };
    let glass = DrawState { blend: Blend { alpha: BlendComponent::KEEP, ..Blend::both(through) }, ..RASTER };
    let mut pass = Pass::new();
    pass.clear_color = Some([1.0; 4]);
    pass.draw(&Plain, mesh(&gradient), RASTER).draw(&Glass, mesh(&triangles), glass);
    drawn(settings, &["Rgba8Srgb"], &[pass])
}

/// What was there, what the first pass left, and both passes: the middle one is not stored the second time.
fn pass_after_pass(settings: &Settings) -> Vec<Buffer> {
    let [gradient, triangles] = shapes();
    let mut first = Pass::new();
    first.color_ops[0] = ColorOps { load: Load::Keep, store: Store::Discard };
    first.color_ops[1].load = Load::Clear([0.0, 0.2, 0.2, 1.0].into());
    first.color_ops[2].load = Load::Keep;
    first.draw(&Three, mesh(&gradient), RASTER);
    let mut second = Pass::new();
    second.clear_color = None;
    second.color_ops[0].store = Store::Discard;
    second.color_ops[1].store = Store::Discard;
    second.draw(&Three, mesh(&triangles), DrawState { blend: Blend::ALPHA, ..RASTER });
    drawn(settings, &["Rgba8", "Rgba8Srgb", "Rgba8Srgb"], &[first, second])
}

#[test]
fn targets_are_the_same_bits_everywhere() {
    let mut found = String::new();
    for (name, draw) in scenes() {
        let reference = draw(&Settings { simd: Simd::Scalar, threads: 1, ..Settings::default() });
        for simd in Simd::available() {
            for threads in [1, 2, 7] {
                for tile in [TileSize::T16, TileSize::T64] {
                    let buffers = draw(&Settings { simd, threads, tile, ..Settings::default() });
                    assert!(buffers == reference, "{name}: {simd}, {threads} threads and {tile:?} give other bits");
                }
            }
        }
        if std::env::var_os("PINEDA_PICTURES").is_some() {
            write_picture(&name, &reference);
        }
        let bytes: Vec<u8> = reference.iter().flat_map(Buffer::bytes).collect();
        writeln!(found, "{name} {:016x}", crate::fnv1a(&bytes)).expect("a string grows");
    }
    if std::env::var_os("PINEDA_BLESS").is_some() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/targets.txt");
        return std::fs::write(path, &found).expect("the repository can be written to");
    }
    assert!(found == HASHES, "not what crates/pineda/tests/golden/targets.txt says:\n{found}");
}

/// The buffers side by side.
fn write_picture(name: &str, buffers: &[Buffer]) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden");
    std::fs::create_dir_all(&folder).expect("the target folder can be written to");
    let mut bytes = Vec::new();
    for y in 0..HEIGHT {
        for buffer in buffers {
            let row = (0..WIDTH).flat_map(|x| buffer.look(y * WIDTH + x));
            bytes.extend(row.map(|v| (v.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8));
        }
    }
    let file = std::fs::File::create(folder.join(format!("{name}.png"))).expect("the target folder can be written to");
    let mut png = png::Encoder::new(file, (WIDTH * buffers.len()) as u32, HEIGHT as u32);
    png.set_color(png::ColorType::Rgb);
    png.write_header().and_then(|mut png| png.write_image_data(&bytes)).expect("a picture");
}
