//! Blending and colour masks, against the equations of Vulkan 1.4 ("Blending", tables of factors and operations) and WebGPU.

use crate::common::{HEIGHT, Layer, PIXELS, WIDTH, channel, second_of, settings};
use pineda::*;
use pineda_oracle::cases::Random;
use std::sync::LazyLock;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Linear,
    Srgb,
    Float,
}

/// The equations, channel by channel.
pub(crate) fn blended(blend: &Blend, s: [f32; 4], s1: [f32; 4], d: [f32; 4]) -> [f32; 4] {
    [0, 1, 2, 3].map(|k| {
        let component = if k < 3 { blend.color } else { blend.alpha };
        let c = blend.constant;
        let saturated = if k == 3 {
            1.0
        } else if s[3] < 1.0 - d[3] {
            s[3]
        } else {
            1.0 - d[3]
        };
        let term = |factor: BlendFactor, value: f32| match factor {
            BlendFactor::Zero => 0.0,
            BlendFactor::One => value,
            BlendFactor::Source => value * s[k],
            BlendFactor::OneMinusSource => value * (1.0 - s[k]),
            BlendFactor::SourceAlpha => value * s[3],
            BlendFactor::OneMinusSourceAlpha => value * (1.0 - s[3]),
            BlendFactor::Target => value * d[k],
            BlendFactor::OneMinusTarget => value * (1.0 - d[k]),
            BlendFactor::TargetAlpha => value * d[3],
            BlendFactor::OneMinusTargetAlpha => value * (1.0 - d[3]),
            BlendFactor::SourceAlphaSaturated => value * saturated,
            BlendFactor::Constant => value * c[k],
            BlendFactor::OneMinusConstant => value * (1.0 - c[k]),
            BlendFactor::ConstantAlpha => value * c[3],
            BlendFactor::OneMinusConstantAlpha => value * (1.0 - c[3]),
            BlendFactor::Source1 => value * s1[k],
            BlendFactor::OneMinusSource1 => value * (1.0 - s1[k]),
            BlendFactor::Source1Alpha => value * s1[3],
            BlendFactor::OneMinusSource1Alpha => value * (1.0 - s1[3]),
        };
        if component == BlendComponent::REPLACE {
            return s[k];
        }
        let (source, target) = (term(component.source, s[k]), term(component.target, d[k]));
        match component.operation {
            BlendOperation::Add => source + target,
            BlendOperation::Subtract => source - target,
            BlendOperation::ReverseSubtract => target - source,
            BlendOperation::Min if d[k].is_nan() || s[k] < d[k] => s[k],
            BlendOperation::Max if d[k].is_nan() || s[k] > d[k] => s[k],
            BlendOperation::Min | BlendOperation::Max => d[k],
        }
    })
}

pub(crate) fn clamped(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) }
}

/// The sRGB curve from codes, or what lies between them, to linear light.
pub(crate) fn linear(code: f64) -> f64 {
    let v = code / 255.0;
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// Half-way from each code to the next.
static HALFWAY: LazyLock<[f64; 255]> = LazyLock::new(|| std::array::from_fn(|code| linear(code as f64 + 0.5)));

/// The code that is nearest on the curve.
pub(crate) fn srgb_code(x: f32) -> u8 {
    HALFWAY.iter().take_while(|&&halfway| f64::from(x) >= halfway).count() as u8
}

impl Format {
    fn decoded(self, codes: [u8; 4]) -> [f32; 4] {
        [0, 1, 2, 3].map(|k| match self {
            Self::Srgb if k < 3 => linear(f64::from(codes[k])) as f32,
            _ => f32::from(codes[k]) / 255.0,
        })
    }

    fn encoded(self, color: [f32; 4]) -> [u8; 4] {
        [0, 1, 2, 3].map(|k| {
            let x = clamped(color[k]);
            match self {
                Self::Srgb if k < 3 => srgb_code(x),
                _ => (x * 255.0 + 0.5) as u8,
            }
        })
    }
}

/// A picture in either kind of format.
#[derive(Clone, Debug)]
struct Picture {
    format: Format,
    codes: Vec<[u8; 4]>,
    floats: Vec<[f32; 4]>,
}

impl Picture {
    fn random(random: &mut Random, format: Format) -> Self {
        let codes = (0..PIXELS).map(|_| [0; 4].map(|_: u8| random.bits() as u8)).collect();
        let floats = (0..PIXELS).map(|_| [0; 4].map(|_: u8| channel(random))).collect();
        Self { format, codes, floats }
    }

    /// One layer more, as the specifications have it.
    fn blend(&mut self, layer: &Layer) {
        let DrawState { blend, color_mask: ColorMask { r, g, b, a }, .. } = layer.state;
        let mask = [r, g, b, a];
        for at in 0..PIXELS {
            let (source, second) = (layer.colors[at], second_of(layer.colors[at]));
            if layer.discards && source[3] < 0.25 {
                continue;
            }
            if self.format == Format::Float {
                let color = blended(&blend, source, second, self.floats[at]);
                for k in (0..4).filter(|&k| mask[k]) {
                    self.floats[at][k] = if color[k].is_nan() { f32::from_bits(0x7fc0_0000) } else { color[k] };
                }
            } else {
                let blend = Blend { constant: blend.constant.map(clamped), ..blend };
                let color =
                    blended(&blend, source.map(clamped), second.map(clamped), self.format.decoded(self.codes[at]));
                let codes = self.format.encoded(color);
                (0..4).filter(|&k| mask[k]).for_each(|k| self.codes[at][k] = codes[k]);
            }
        }
    }

    fn draw(&mut self, renderer: &mut Renderer, layers: &[Layer]) {
        let mut pass = Pass::new();
        pass.clear_color = None;
        layers.iter().for_each(|layer| layer.draw(&mut pass));
        let color = match self.format {
            Format::Linear => ColorBuffer::Rgba8(&mut self.codes),
            Format::Srgb => ColorBuffer::Rgba8Srgb(&mut self.codes),
            Format::Float => ColorBuffer::Rgba32F(&mut self.floats),
        };
        renderer.render(&pass, &mut Target { color, ..Target::new(WIDTH, HEIGHT) }).expect("valid");
    }
}

/// Draws layers over a random picture at every level and compares every pixel's bits.
fn check(seed: u64, layers: &[Layer], start: &Picture) {
    let mut wanted = start.clone();
    layers.iter().for_each(|layer| wanted.blend(layer));
    for settings in settings(seed) {
        let mut found = start.clone();
        found.draw(&mut Renderer::new(settings.clone()).expect("available"), layers);
        for at in 0..PIXELS {
            let [found_bits, wanted_bits] = [&found, &wanted].map(|p| p.floats[at].map(f32::to_bits));
            assert!(
                found.codes[at] == wanted.codes[at] && found_bits == wanted_bits,
                "scene {seed}, {:?}, pixel {at}: {:?} {:?} instead of {:?} {:?}, over {:?} {:?}, {settings:?}, {:?}",
                start.format,
                found.codes[at],
                found.floats[at],
                wanted.codes[at],
                wanted.floats[at],
                start.codes[at],
                start.floats[at],
                layers.iter().map(|layer| (layer.colors[at], layer.state.blend, layer.discards)).collect::<Vec<_>>(),
            );
        }
    }
}

pub(crate) fn random_blend(random: &mut Random) -> Blend {
    let component = |random: &mut Random| BlendComponent {
        source: random.pick(&BlendFactor::ALL),
        operation: random.pick(&BlendOperation::ALL),
        target: random.pick(&BlendFactor::ALL),
    };
    let (color, alpha) = (component(random), component(random));
    Blend { color, alpha, constant: [0; 4].map(|_| channel(random)) }
}

fn layer(random: &mut Random, blend: Blend, color_mask: ColorMask) -> Layer {
    let depth = DepthState { compare: Compare::Always, write: random.one_in(2) };
    let state = DrawState { blend, color_mask, depth, ..DrawState::default() };
    Layer::new(state, || ([0; 4].map(|_| channel(random)), 0.5, true))
}

const FORMATS: [Format; 3] = [Format::Linear, Format::Srgb, Format::Float];

#[test]
fn every_pair_of_factors_and_every_operation() {
    let mut seed = 0;
    for source in BlendFactor::ALL {
        for target in BlendFactor::ALL {
            for operation in BlendOperation::ALL {
                let mut random = Random::new(seed);
                let mut blend = random_blend(&mut random);
                blend.color = BlendComponent { source, operation, target };
                let layers = [layer(&mut random, blend, ColorMask::ALL)];
                let start = Picture::random(&mut random, FORMATS[(seed % 3) as usize]);
                check(seed, &layers, &start);
                seed += 1;
            }
        }
    }
}

#[test]
fn layers_of_any_states_in_submission_order() {
    for seed in 0..600 {
        let mut random = Random::new(!seed);
        let usual =
            [Blend::OPAQUE, Blend::ALPHA, Blend::PREMULTIPLIED, Blend::ADD, Blend::MULTIPLY, Blend::MIN, Blend::MAX];
        let layers: Vec<Layer> = (0..random.between(1, 4))
            .map(|_| {
                let blend = if random.one_in(2) { random.pick(&usual) } else { random_blend(&mut random) };
                let [r, g, b, a] = [0; 4].map(|_| random.one_in(2));
                let masks = [ColorMask::ALL, ColorMask::NONE, ColorMask::COLOR, ColorMask { r, g, b, a }];
                let mask = random.pick(&masks);
                let mut layer = layer(&mut random, blend, mask);
                layer.discards = random.one_in(3);
                layer
            })
            .collect();
        let start = Picture::random(&mut random, FORMATS[(seed % 3) as usize]);
        check(seed, &layers, &start);
    }
}

#[test]
fn the_usual_cases_are_what_they_are_called() {
    let (s, d) = ([0.5, 0.25, 1.0, 0.5], [0.25, 1.0, 0.5, 0.75]);
    let cases = [
        (Blend::OPAQUE, s),
        (Blend::ALPHA, [0.375, 0.625, 0.75, 0.875]),
        (Blend::PREMULTIPLIED, [0.625, 0.75, 1.25, 0.875]),
        (Blend::ADD, [0.75, 1.25, 1.5, 1.25]),
        (Blend::MULTIPLY, [0.125, 0.25, 0.5, 0.375]),
        (Blend::MIN, [0.25, 0.25, 0.5, 0.5]),
        (Blend::MAX, [0.5, 1.0, 1.0, 0.75]),
        (Blend::both(BlendComponent::KEEP), d),
    ];
    for (blend, wanted) in cases {
        let mut picture = Picture { format: Format::Float, codes: vec![[0; 4]; PIXELS], floats: vec![d; PIXELS] };
        let layer = Layer::new(DrawState { blend, ..DrawState::default() }, || (s, 0.5, true));
        picture.draw(&mut Renderer::new(Settings::default()).expect("the best level"), &[layer]);
        assert!(picture.floats.iter().all(|&found| found == wanted), "{blend:?}: {:?}", picture.floats[0]);
    }
}
