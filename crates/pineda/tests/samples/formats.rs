//! Colour buffers of every format, by references that know nothing of how the rasterizer stores them.

use crate::blending::{blended, clamped, linear, srgb_code};
use crate::common::{PIXELS, channel};
use pineda::*;
use pineda_oracle::cases::Random;

/// How a channel is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    Unorm8,
    Srgb8,
    Unorm16,
    Half,
    Float,
    Uint,
    Int,
}

use Encoding::{Float, Half, Int, Srgb8, Uint, Unorm8, Unorm16};

/// An encoding, and how many channels there are.
pub(crate) type Format = (Encoding, usize);

pub(crate) const FLOATS: [Encoding; 5] = [Unorm8, Srgb8, Unorm16, Half, Float];

/// What a fragment stage returns for a buffer: numbers, or the bits of integers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Value {
    Floats([f32; 4]),
    Bits([u32; 4]),
}

/// A colour buffer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture {
    pub(crate) format: Format,
    /// Two words of 64 bits for each pixel are enough for any format, and aligned for it.
    data: Vec<u64>,
}

impl Picture {
    /// Codes of any kind. Floats are seldom bits of any kind, which would mostly be out of all proportion.
    pub(crate) fn random(random: &mut Random, format: Format) -> Self {
        let mut this = Self { format, data: vec![0; 2 * PIXELS] };
        for at in 0..PIXELS {
            for k in 0..format.1 {
                let code = match format.0 {
                    Float if random.one_in(4) => random.bits() as u32,
                    Float => channel(random).to_bits(),
                    Half if random.one_in(4) => random.bits() as u32,
                    Half => half::f16::from_f32(channel(random)).to_bits().into(),
                    _ => random.bits() as u32,
                };
                this.set(at, k, code);
            }
        }
        this
    }

    /// As the rasterizer takes it.
    pub(crate) fn buffer(&mut self) -> ColorBuffer<'_> {
        fn pixels<T: bytemuck::Pod>(data: &mut [u64]) -> &mut [T] {
            &mut bytemuck::cast_slice_mut(data)[..PIXELS]
        }
        let data = &mut self.data;
        match self.format {
            (Unorm8, 1) => ColorBuffer::R8(pixels(data)),
            (Unorm8, 2) => ColorBuffer::Rg8(pixels(data)),
            (Unorm8, _) => ColorBuffer::Rgba8(pixels(data)),
            (Srgb8, 1) => ColorBuffer::R8Srgb(pixels(data)),
            (Srgb8, 2) => ColorBuffer::Rg8Srgb(pixels(data)),
            (Srgb8, _) => ColorBuffer::Rgba8Srgb(pixels(data)),
            (Unorm16, 1) => ColorBuffer::R16(pixels(data)),
            (Unorm16, 2) => ColorBuffer::Rg16(pixels(data)),
            (Unorm16, _) => ColorBuffer::Rgba16(pixels(data)),
            (Half, 1) => ColorBuffer::R16F(pixels(data)),
            (Half, 2) => ColorBuffer::Rg16F(pixels(data)),
            (Half, _) => ColorBuffer::Rgba16F(pixels(data)),
            (Float, 1) => ColorBuffer::R32F(pixels(data)),
            (Float, 2) => ColorBuffer::Rg32F(pixels(data)),
            (Float, _) => ColorBuffer::Rgba32F(pixels(data)),
            (Uint, 1) => ColorBuffer::R32U(pixels(data)),
            (Uint, 2) => ColorBuffer::Rg32U(pixels(data)),
            (Uint, _) => ColorBuffer::Rgba32U(pixels(data)),
            (Int, 1) => ColorBuffer::R32I(pixels(data)),
            (Int, 2) => ColorBuffer::Rg32I(pixels(data)),
            (Int, _) => ColorBuffer::Rgba32I(pixels(data)),
        }
    }

    fn code(&self, at: usize, k: usize) -> u32 {
        let place = at * self.format.1 + k;
        match self.format.0 {
            Unorm8 | Srgb8 => bytemuck::cast_slice::<u64, u8>(&self.data)[place].into(),
            Unorm16 | Half => bytemuck::cast_slice::<u64, u16>(&self.data)[place].into(),
            Float | Uint | Int => bytemuck::cast_slice::<u64, u32>(&self.data)[place],
        }
    }

    fn set(&mut self, at: usize, k: usize, code: u32) {
        let place = at * self.format.1 + k;
        match self.format.0 {
            Unorm8 | Srgb8 => bytemuck::cast_slice_mut::<u64, u8>(&mut self.data)[place] = code as u8,
            Unorm16 | Half => bytemuck::cast_slice_mut::<u64, u16>(&mut self.data)[place] = code as u16,
            Float | Uint | Int => bytemuck::cast_slice_mut::<u64, u32>(&mut self.data)[place] = code,
        }
    }

    /// A pixel's codes.
    pub(crate) fn codes(&self, at: usize) -> Vec<u32> {
        (0..self.format.1).map(|k| self.code(at, k)).collect()
    }

    fn decoded(&self, at: usize) -> [f32; 4] {
        let mut color = [0.0, 0.0, 0.0, 1.0];
        for (k, value) in color.iter_mut().enumerate().take(self.format.1) {
            let code = self.code(at, k);
            *value = match self.format.0 {
                Srgb8 if k < 3 => linear(f64::from(code)) as f32,
                Unorm8 | Srgb8 => code as f32 / 255.0,
                Unorm16 => code as f32 / 65_535.0,
                Half => half::f16::from_bits(code as u16).to_f32(),
                _ => f32::from_bits(code),
            };
        }
        color
    }

    /// What a channel's value is stored as.
    fn encoded(&self, k: usize, x: f32) -> u32 {
        let unit = clamped(x);
        match self.format.0 {
            Srgb8 if k < 3 => srgb_code(unit).into(),
            Unorm8 | Srgb8 => (unit * 255.0 + 0.5) as u32,
            Unorm16 => {
                // Exactly: 24 bits of mantissa times 16 bits.
                let exact = f64::from(unit) * 65_535.0;
                let (below, rest) = (exact.floor(), exact - exact.floor());
                below as u32 + u32::from(rest > 0.5 || (rest == 0.5 && below as u32 % 2 == 1))
            }
            Half if x.is_nan() => 0x7e00,
            Half => half::f16::from_f32(x).to_bits().into(),
            _ if x.is_nan() => 0x7fc0_0000,
            _ => x.to_bits(),
        }
    }

    /// Stores a value, blended and masked.
    pub(crate) fn draw(&mut self, at: usize, value: Value, second: [f32; 4], state: &ColorState) {
        let ColorMask { r, g, b, a } = state.mask;
        let mask = [r, g, b, a];
        let codes: [u32; 4] = match value {
            Value::Bits(bits) => bits,
            Value::Floats(source) => {
                let there = self.decoded(at);
                let color = if matches!(self.format.0, Half | Float) {
                    blended(&state.blend, source, second, there)
                } else {
                    let blend = Blend { constant: state.blend.constant.map(clamped), ..state.blend };
                    blended(&blend, source.map(clamped), second.map(clamped), there)
                };
                [0, 1, 2, 3].map(|k| self.encoded(k, color[k]))
            }
        };
        (0..self.format.1).filter(|&k| mask[k]).for_each(|k| self.set(at, k, codes[k]));
    }

    /// Starts with a colour. A float goes to float buffers bit by bit.
    pub(crate) fn clear(&mut self, color: ClearColor) {
        for at in 0..PIXELS {
            for k in 0..self.format.1 {
                let code = match color {
                    ClearColor::Float(_) if matches!(self.format.0, Uint | Int) => 0,
                    ClearColor::Float(color) if self.format.0 == Float => color[k].to_bits(),
                    ClearColor::Float(color) => self.encoded(k, color[k]),
                    ClearColor::Uint(color) => color[k],
                    ClearColor::Int(color) => color[k] as u32,
                };
                self.set(at, k, code);
            }
        }
    }
}

/// Floats all over: every 4099th, every 61st in release. (All 2^32 have been tried, once.)
#[test]
fn halves_are_the_nearest() {
    let step = if cfg!(debug_assertions) { 4099 } else { 61 };
    for bits in (0..=u32::MAX).step_by(step) {
        let x = f32::from_bits(bits);
        // How many steps from one half to the next it is away from 0: the rounding is the only one, for f64 holds the rest exactly.
        let size = f64::from(x.abs());
        let exponent = ((size.to_bits() >> 52) as i32 - 1023).max(-14);
        let steps = (size * f64::from_bits(((1023 + 10 - exponent) as u64) << 52)).round_ties_even() as u32;
        let wanted = match size {
            _ if x.is_nan() => 0x7e00,
            65_520.0.. => 0x7c00,
            // A step more than 2047 is the first of the next exponent.
            _ => ((exponent + 14) as u32 * 1024 + steps) as u16,
        };
        let sign = if x.is_sign_negative() && !x.is_nan() { 0x8000 } else { 0 };
        assert_eq!(f32_to_f16(x), sign | wanted, "{x:?} {bits:08x}");
    }
}

/// The bits of halves and of f32, all over and where it matters, as colours.
#[test]
fn values_at_the_borders_between_codes() {
    let mut random = Random::new(3);
    let mut values: Vec<f32> = [0.0, -0.0, 1.0, -1.0, 2.0, 1e-8, 6e-8, 65_504.0, 65_519.0, 65_520.0, 1e9].to_vec();
    values.extend([f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE, 1e-45]);
    for _ in 0..200 {
        // Half-way between two codes, and next to it.
        let bits = random.bits() as u16;
        let half = |bits: u16| half::f16::from_bits(bits & 0x7bff).to_f32();
        let unorm = (f64::from(bits) + 0.5) / 65_535.0;
        for middle in [(half(bits) + half(bits + 1)) / 2.0, unorm as f32] {
            values.extend(
                [-1, 0, 1].map(|step: i32| f32::from_bits((middle.to_bits() as i32).wrapping_add(step) as u32)),
            );
        }
    }
    let mut next = values.iter().copied().cycle();
    let mut colors = || [0; 4].map(|_| next.next().expect("endless"));
    for encoding in FLOATS {
        for channels in [1, 2, 4] {
            for seed in 0..3 {
                let state = DrawState::default();
                let layer = crate::common::Layer::new(state, || (colors(), 0.5, true));
                let start = Picture::random(&mut random, (encoding, channels));
                let mut wanted = start.clone();
                for at in 0..PIXELS {
                    wanted.draw(at, Value::Floats(layer.colors[at]), [0.0; 4], &ColorState::default());
                }
                for settings in crate::common::settings(seed) {
                    let mut found = start.clone();
                    let mut pass = Pass::new();
                    layer.draw(&mut pass);
                    let (color, size) = (found.buffer(), (crate::common::WIDTH, crate::common::HEIGHT));
                    let mut renderer = Renderer::new(settings.clone()).expect("available");
                    renderer.render(&pass, &mut Target { color, ..Target::new(size.0, size.1) }).expect("valid");
                    for at in 0..PIXELS {
                        let (found, wanted) = (found.codes(at), wanted.codes(at));
                        let (format, color) = ((encoding, channels), layer.colors[at]);
                        assert!(found == wanted, "{format:?} {color:?}: {found:x?}, not {wanted:x?}; {settings:?}");
                    }
                }
            }
        }
    }
}
