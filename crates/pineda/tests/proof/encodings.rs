//! 8-bit colours against an independent reference in f64, and what a target that is loaded gives back.

use pineda::*;
use pineda_oracle::cases::Random;

/// The sRGB curve of IEC 61966-2-1, from linear light to 0 to 1; std's functions are good enough to judge by.
fn encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

fn clamped(x: f32) -> f64 {
    if x.is_nan() { 0.0 } else { f64::from(x).clamp(0.0, 1.0) }
}

/// Values that are worth trying: all over, at and next to the borders between codes, out of range and not numbers.
fn values() -> Vec<f32> {
    let mut random = Random::new(1);
    let mut values: Vec<f32> = (0..60_000).map(|_| random.unit()).collect();
    values.extend((0..20_000).map(|_| random.magnitude(-20, 2) * random.sign()));
    for code in 0..255 {
        let middle = (f64::from(code) + 0.5) / 255.0;
        let linear = if middle <= 0.040_45 { middle / 12.92 } else { ((middle + 0.055) / 1.055).powf(2.4) };
        for border in [middle as f32, linear as f32] {
            values.extend((-3..=3).map(|step: i32| f32::from_bits((border.to_bits() as i32 + step) as u32)));
        }
    }
    values.extend([f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, 0.0, -0.0, 1.0, 1e-45]);
    values
}

fn pixels(srgb: bool, simd: Simd, values: &[f32]) -> Vec<[u8; 4]> {
    let width = 256;
    let height = values.len().div_ceil(width);
    let mut color = vec![[0.0; 4]; width * height];
    // Each channel starts elsewhere in the list.
    for (k, pixel) in color.iter_mut().enumerate() {
        *pixel = [0, 1, 2, 3].map(|channel| values[(k + channel * 7919) % values.len()]);
    }
    // The shader looks its colour up: one triangle a pixel would say the same, but takes longer.
    let rows: Vec<[[f32; 4]; 3]> = color.iter().map(|&c| [c; 3]).collect();
    let mut vertices = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let (x, y) = ((k % width) as f32, (k / width) as f32);
        vertices.push(([x - 0.5, y], row[0]));
        vertices.push(([x + 1.5, y], row[1]));
        vertices.push(([x + 0.5, y + 1.0], row[2]));
    }
    let mut pass = Pass::new();
    pass.draw(
        &Constant,
        Mesh { vertices: &vertices, indices: Indices::Sequential },
        DrawState { space: Space::Raster, ..DrawState::default() },
    );
    let mut pixels = vec![[0; 4]; width * height];
    let target = Target::new(width as u32, height as u32);
    let color = if srgb { ColorBuffer::Rgba8Srgb(&mut pixels) } else { ColorBuffer::Rgba8(&mut pixels) };
    let mut renderer = Renderer::new(Settings { simd, ..Settings::default() }).expect("available");
    renderer.render(&pass, &mut Target { color, ..target }).expect("valid");
    pixels
}

varyings! {
    struct Plain {
        #[flat]
        color: Rgba,
    }
}

/// The first vertex's colour, bit by bit.
struct Constant;

#[shader]
impl Shader for Constant {
    type Vertex = ([f32; 2], [f32; 4]);
    type Varyings<L: Lanes> = Plain<L>;
    fn vertex(&self, &([x, y], color): &Self::Vertex) -> (Vec4, Plain) {
        ([x, y, 0.0, 1.0].into(), Plain { color: color.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        f.color
    }
}

#[test]
fn linear_codes_are_the_nearest() {
    let values = values();
    for simd in Simd::available() {
        for (k, pixel) in pixels(false, simd, &values).iter().enumerate() {
            for (channel, &code) in pixel.iter().enumerate() {
                let value = values[(k + channel * 7919) % values.len()];
                let exact = clamped(value) * 255.0;
                // 255 x + 1/2 is computed in f32: next to a tie it may go either way, by less than a rounding.
                let error = (f64::from(code) - exact).abs();
                assert!(error <= 0.5 + 2e-5, "{simd}: {value:?} became {code}, which is {error} codes off");
            }
        }
    }
}

#[test]
fn srgb_codes_are_the_nearest_on_the_curve() {
    let values = values();
    for simd in Simd::available() {
        for (k, pixel) in pixels(true, simd, &values).iter().enumerate() {
            for (channel, &code) in pixel.iter().enumerate() {
                let value = clamped(values[(k + channel * 7919) % values.len()]);
                // Alpha is linear. Thresholds are exact to the last bit of f32, so that only f64's own error is left.
                let exact = 255.0 * if channel == 3 { value } else { encoded(value) };
                let error = (f64::from(code) - exact).abs();
                let allowed = if channel == 3 { 0.5 + 2e-5 } else { 0.5 + 2e-6 };
                assert!(error <= allowed, "{simd}: {value:?} became {code}, which is {error} codes off");
            }
        }
    }
}

#[test]
fn what_is_loaded_is_stored_again() {
    // Drawing nothing over a picture must not change a code, and a fully transparent layer neither.
    let all: Vec<[u8; 4]> = (0..=255).map(|code| [code, code ^ 0x55, 255 - code, code]).collect();
    let layer = [([-9.0, -9.0], [0.3, 0.7, 1.0, 0.0]), ([99.0, -9.0], [0.0; 4]), ([-9.0, 99.0], [0.0; 4])];
    for srgb in [false, true] {
        for simd in Simd::available() {
            let mut pixels = all.clone();
            let mut pass = Pass::new();
            pass.clear_color = None;
            pass.draw(
                &Constant,
                Mesh { vertices: &layer, indices: Indices::Sequential },
                DrawState { space: Space::Raster, blend: Blend::ALPHA, ..DrawState::default() },
            );
            let color = if srgb { ColorBuffer::Rgba8Srgb(&mut pixels) } else { ColorBuffer::Rgba8(&mut pixels) };
            let mut renderer = Renderer::new(Settings { simd, ..Settings::default() }).expect("available");
            renderer.render(&pass, &mut Target { color, ..Target::new(16, 16) }).expect("valid");
            assert_eq!(pixels, all, "{simd}, sRGB: {srgb}");
        }
    }
}

/// Quotients of 0 and 0: x86 makes a negative NaN of them, ARM a positive one.
struct NotANumber;

#[shader]
impl Shader for NotANumber {
    type Vertex = [f32; 2];
    type Varyings<L: Lanes> = Real<L>;

    fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, Real) {
        (Vec4::from([x, y, 0.0, 1.0]), 0.0.into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let nan = f.varyings() / f.varyings();
        Rgba::new(Vec3::new(nan, -nan, nan.sqrt()), nan * nan)
    }
}

#[test]
fn there_is_one_nan() {
    let corners = [[-9.0, -9.0], [99.0, -9.0], [-9.0, 99.0]];
    for blend in [Blend::OPAQUE, Blend::ALPHA] {
        for simd in Simd::available() {
            let mut pixels = [[0.0; 4]; 64];
            let mut pass = Pass::new();
            let state = DrawState { space: Space::Raster, blend, ..DrawState::default() };
            pass.draw(&NotANumber, Mesh { vertices: &corners, indices: Indices::Sequential }, state);
            let mut renderer = Renderer::new(Settings { simd, ..Settings::default() }).expect("available");
            let color = ColorBuffer::Rgba32F(&mut pixels);
            renderer.render(&pass, &mut Target { color, ..Target::new(8, 8) }).expect("valid");
            for value in pixels.as_flattened() {
                assert_eq!(value.to_bits(), 0x7fc0_0000, "{simd}, {blend:?}");
            }
        }
    }
}
