//! Blending: every pair of factors that WebGPU has with every operation, colour masks, on each format.
//!
//! Within one code of 8 bits; halves that are neighbours, for Vulkan allows both ("Floating-Point Format Conversions"); of f32 within five roundings of what is added ([`Exact::sizes`]). Where two answers are further apart, the equation in f64 says which is right.

use super::Bench;
use super::depth::cells;
use super::sheet::{Colors, Draw, Interpolation, Sheet, Vertex, clip_position};
use super::tally::{Row, Tally};
use anyhow::Result;
use pineda::{
    Blend, BlendComponent, BlendFactor, BlendOperation, ColorMask, DepthState, DrawState, f16_to_f32, f32_to_f16,
};
use pineda_oracle::cases::Random;

const SIDE: u32 = 512;
/// 529 cells: as many as there are pairs of factors with operations, and a few.
const CELL: u32 = 22;
/// Roundings of f32: 1 - factor, two products, the sum; one more of the constant, which is given as f64.
const ROUNDINGS: f64 = 5.0 / 16_777_216.0;

/// What WebGPU has: not `ConstantAlpha`, for its constant is one for both.
const FACTORS: [BlendFactor; 13] = [
    BlendFactor::Zero,
    BlendFactor::One,
    BlendFactor::Source,
    BlendFactor::OneMinusSource,
    BlendFactor::SourceAlpha,
    BlendFactor::OneMinusSourceAlpha,
    BlendFactor::Target,
    BlendFactor::OneMinusTarget,
    BlendFactor::TargetAlpha,
    BlendFactor::OneMinusTargetAlpha,
    BlendFactor::SourceAlphaSaturated,
    BlendFactor::Constant,
    BlendFactor::OneMinusConstant,
];

/// Linear codes.
pub(crate) fn unorm8(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    blending(bench, tally, Format::Unorm8)
}

/// sRGB codes, blended in linear light.
pub(crate) fn srgb8(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    blending(bench, tally, Format::Srgb8)
}

/// Halves, which are not clamped.
pub(crate) fn float16(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    blending(bench, tally, Format::Float16)
}

/// Floats, which are not clamped.
pub(crate) fn float32(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    if bench.theirs.blends_floats() { blending(bench, tally, Format::Float32) } else { Ok(()) }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Unorm8,
    Srgb8,
    Float16,
    Float32,
}

/// A case is a state, in a cell: each pixel a triangle of its own with a colour of its own, on a colour of its own.
fn blending(bench: &mut Bench, tally: &mut Tally, format: Format) -> Result<()> {
    for seed in bench.seed..bench.seed + 4 * bench.times {
        let mut random = Random::new(seed);
        let mut sheet = Sheet::new(SIDE);
        let pixels = sheet.pixels();
        let mut floats = |count: usize| -> Vec<[f32; 4]> {
            (0..count).map(|_| [0; 4].map(|_| channel(&mut random, format))).collect()
        };
        let sources = floats(pixels);
        sheet.colors = match format {
            Format::Float16 => Colors::Float16(floats(pixels).into_iter().map(|color| color.map(f32_to_f16)).collect()),
            Format::Float32 => Colors::Float32(floats(pixels)),
            Format::Unorm8 => Colors::Unorm8((0..pixels).map(|_| [0; 4].map(|_| random.bits() as u8)).collect()),
            Format::Srgb8 => Colors::Srgb8((0..pixels).map(|_| [0; 4].map(|_| random.bits() as u8)).collect()),
        };
        let components = components();
        // The same states every time, on other colours: lavapipe keeps a thousand shaders and is slow with more.
        let mut random = Random::new(bench.seed);
        let states: Vec<DrawState> = cells(SIDE, CELL)
            .enumerate()
            .map(|(n, _)| {
                let color = components[n % components.len()];
                let alpha = if n < components.len() { color } else { random.pick(&components) };
                let constant = [0; 4].map(|_| random.unit());
                let mask = [0; 4].map(|_| !random.one_in(3));
                let is_masked = random.one_in(3);
                let [r, g, b, a] = if is_masked { mask } else { [true; 4] };
                DrawState {
                    blend: Blend { color, alpha, constant },
                    color_mask: ColorMask { r, g, b, a },
                    depth: DepthState::OFF,
                    ..DrawState::DEFAULT
                }
            })
            .collect();
        for (state, [left, top]) in states.iter().zip(cells(SIDE, CELL)) {
            let mut vertices = Vec::new();
            for (y, x) in (top..top + CELL).flat_map(|y| (left..left + CELL).map(move |x| (y, x))) {
                vertices.extend(pixel(&sheet, [x, y], sources[sheet.at([x, y])]));
            }
            sheet.draws.push(Draw { vertices, indices: None, interpolation: Interpolation::Flat, state: *state });
        }
        tally.cases += states.len() as u64;
        let [ours, theirs] = bench.draw(&sheet)?;
        let inside = SIDE / CELL * CELL;
        for [x, y] in (0..inside).flat_map(|y| (0..inside).map(move |x| [x, y])) {
            let at = sheet.at([x, y]);
            tally.pixels += 1;
            tally.drawn += 1;
            let state = &states[(y / CELL * (SIDE / CELL) + x / CELL) as usize];
            let [there, our, their] = [&sheet.colors, &ours.colors, &theirs.colors].map(|colors| stored(colors, at));
            let exact = Exact::new(format, Arithmetic::Exact, state, sources[at], there);
            for k in 0..4 {
                let rounding = exact.sizes[k] * ROUNDINGS;
                let unit = match format {
                    Format::Unorm8 | Format::Srgb8 => 1.0,
                    Format::Float16 => rounding + half_step(exact.stored[k]),
                    Format::Float32 => rounding,
                };
                let half = half_step(exact.stored[k]);
                let is_nearest = (our[k] - exact.stored[k]).abs() <= rounding + 0.5 * half;
                // llvmpipe rounds to halves towards zero (`lp_build_float_to_half`), as D3D11.3 has it.
                let is_towards_zero = their[k].abs() <= exact.stored[k].abs() + rounding;
                if format == Format::Float16 && !(is_nearest && is_towards_zero) {
                    tally.differs(None, || {
                        let exact = exact.stored[k];
                        format!(
                            "seed {seed}, halves, channel {k}: pineda {}, lavapipe {}, exact {exact}",
                            our[k], their[k]
                        )
                    });
                }
                let difference = (our[k] - their[k]).abs();
                if difference <= unit {
                    tally.allow(if difference > 0.0 { difference / unit } else { 0.0 });
                    continue;
                }
                let row = match format {
                    Format::Unorm8 => Some(Row::EightBitBlending),
                    Format::Srgb8 if k < 3 => Some(Row::SrgbPolynomial),
                    Format::Srgb8 | Format::Float16 | Format::Float32 => None,
                };
                // Ours must be the nearest code, and theirs what their arithmetic gives, within a code.
                let model = Exact::new(format, Arithmetic::Lavapipe, state, sources[at], there);
                let row =
                    row.filter(|_| (our[k] - exact.stored[k]).abs() < 0.51 && (their[k] - model.stored[k]).abs() < 1.0);
                tally.differs(row, || {
                    format!(
                        "seed {seed}, {format:?}, channel {k}: pineda {}, lavapipe {}, exact {}; source {:?} on {there:?}, {:?}, {:?}",
                        our[k], their[k], exact.stored[k], sources[at], state.blend, state.color_mask
                    )
                });
            }
        }
    }
    Ok(())
}

/// Every pair of factors with every operation that has factors, and the two that have none.
fn components() -> Vec<BlendComponent> {
    use BlendOperation::{Add, Max, Min, ReverseSubtract, Subtract};
    let mut components = Vec::new();
    for operation in [Add, Subtract, ReverseSubtract] {
        for source in FACTORS {
            components.extend(FACTORS.map(|target| BlendComponent { source, operation, target }));
        }
    }
    // WebGPU wants factors of one where they do not matter.
    let without = |operation| BlendComponent { source: BlendFactor::One, operation, target: BlendFactor::One };
    components.extend([Min, Max].map(without));
    components
}

/// A channel of a source: 8-bit targets clamp it, so that it may lie outside of 0 to 1 there, too.
fn channel(random: &mut Random, format: Format) -> f32 {
    match random.between(0, 5) {
        0 => random.pick(&[0.0, 1.0, 0.5]),
        1 => random.between(0, 255) as f32 / 255.0,
        2 if format == Format::Float32 => random.sign() * random.magnitude(-10, 10),
        // Products stay below 65504.
        2 if format == Format::Float16 => random.sign() * random.magnitude(-10, 6),
        2 => random.real(-1.0, 2.0),
        _ => random.unit(),
    }
}

/// A triangle that covers one pixel.
fn pixel(sheet: &Sheet, [x, y]: [u32; 2], color: [f32; 4]) -> [Vertex; 3] {
    let [x, y] = [x, y].map(|x| 256 * i64::from(x));
    // Its corners lie in the pixel, around the centre.
    [[x, y], [x, y + 256], [x + 256, y + 120]].map(|corner| {
        let position = clip_position(&sheet.viewport(), corner, 0.5, 1.0);
        Vertex { position, color }
    })
}

fn stored(colors: &Colors, at: usize) -> [f64; 4] {
    match colors {
        Colors::Unorm8(codes) | Colors::Srgb8(codes) => codes[at].map(f64::from),
        Colors::Float16(colors) => colors[at].map(|bits| f16_to_f32(bits).into()),
        Colors::Float32(colors) => colors[at].map(f64::from),
    }
}

/// How the equations are evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Arithmetic {
    Exact,
    /// llvmpipe's: to linear targets of 8 bits it blends codes, so that sources and constants are rounded to codes first; sRGB codes it decodes by a polynomial of the third
    /// degree (`lp_build_srgb_to_linear`).
    Lavapipe,
}

/// Vulkan's equations (1.4, "Blending") in f64.
struct Exact {
    /// What would be stored: codes with their fractions, or numbers.
    stored: [f64; 4],
    /// The sizes of the two terms, summed.
    sizes: [f64; 4],
}

impl Exact {
    fn new(format: Format, arithmetic: Arithmetic, state: &DrawState, source: [f32; 4], there: [f64; 4]) -> Self {
        let is_unorm = matches!(format, Format::Unorm8 | Format::Srgb8);
        let clamped = |x: f64| if is_unorm { x.clamp(0.0, 1.0) } else { x };
        let is_theirs = arithmetic == Arithmetic::Lavapipe;
        let rounds = is_theirs && format == Format::Unorm8;
        let given = |x: f64| if rounds { (clamped(x) * 255.0).round() / 255.0 } else { clamped(x) };
        let source = source.map(|x| given(x.into()));
        let decoded = |k: usize| match format {
            Format::Float16 | Format::Float32 => there[k],
            Format::Srgb8 if k < 3 && is_theirs => decode_by_polynomial(there[k]),
            Format::Srgb8 if k < 3 => decode(there[k]),
            Format::Unorm8 | Format::Srgb8 => there[k] / 255.0,
        };
        let target = [0, 1, 2, 3].map(decoded);
        let constant = state.blend.constant.map(|x| given(x.into()));
        let ColorMask { r, g, b, a } = state.color_mask;
        let written = [r, g, b, a];
        let mut exact = Self { stored: there, sizes: [0.0; 4] };
        for k in (0..4).filter(|&k| written[k]) {
            let component = if k < 3 { state.blend.color } else { state.blend.alpha };
            let factor = |factor| match factor {
                BlendFactor::Zero => 0.0,
                BlendFactor::One => 1.0,
                BlendFactor::Source => source[k],
                BlendFactor::OneMinusSource => 1.0 - source[k],
                BlendFactor::SourceAlpha => source[3],
                BlendFactor::OneMinusSourceAlpha => 1.0 - source[3],
                BlendFactor::Target => target[k],
                BlendFactor::OneMinusTarget => 1.0 - target[k],
                BlendFactor::TargetAlpha => target[3],
                BlendFactor::OneMinusTargetAlpha => 1.0 - target[3],
                BlendFactor::SourceAlphaSaturated if k == 3 => 1.0,
                BlendFactor::SourceAlphaSaturated => source[3].min(1.0 - target[3]),
                BlendFactor::Constant => constant[k],
                BlendFactor::ConstantAlpha => constant[3],
                BlendFactor::OneMinusConstant => 1.0 - constant[k],
                BlendFactor::OneMinusConstantAlpha => 1.0 - constant[3],
                // No case has a second source.
                BlendFactor::Source1
                | BlendFactor::OneMinusSource1
                | BlendFactor::Source1Alpha
                | BlendFactor::OneMinusSource1Alpha => f64::NAN,
            };
            let (s, t) = (source[k] * factor(component.source), target[k] * factor(component.target));
            let result = match component.operation {
                BlendOperation::Add => s + t,
                BlendOperation::Subtract => s - t,
                BlendOperation::ReverseSubtract => t - s,
                BlendOperation::Min => source[k].min(target[k]),
                BlendOperation::Max => source[k].max(target[k]),
            };
            let result = clamped(result);
            exact.sizes[k] = s.abs() + t.abs();
            exact.stored[k] = match format {
                Format::Float16 | Format::Float32 => result,
                Format::Srgb8 if k < 3 => encode(result),
                Format::Unorm8 | Format::Srgb8 => 255.0 * result,
            };
        }
        exact
    }
}

/// IEC 61966-2-1.
fn decode(code: f64) -> f64 {
    let v = code / 255.0;
    if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
}

/// What llvmpipe decodes by: up to 0.42 codes off, just good enough for every code to be read back.
fn decode_by_polynomial(code: f64) -> f64 {
    let v = code / 255.0;
    if code <= 15.0 { v / 12.6 } else { ((0.3012 * v + 0.6935) * v + 0.0030) * v + 0.0023 }
}

/// From one half to the next larger one.
fn half_step(x: f64) -> f64 {
    let exponent = x.abs().max(1.0 / 16384.0).log2().floor();
    exponent.exp2() / 1024.0
}

/// The code on the curve, with its fraction.
fn encode(linear: f64) -> f64 {
    let v = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 };
    255.0 * v
}
