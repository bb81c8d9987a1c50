//! The stencil test and its operations, against Vulkan 1.4's ("Stencil Test"), one sample after the other.

use crate::common::{HEIGHT, Layer, PIXELS, WIDTH, passes, settings};
use pineda::*;
use pineda_oracle::cases::Random;

fn operated(operation: StencilOperation, stored: u8, reference: u8) -> u8 {
    match operation {
        StencilOperation::Keep => stored,
        StencilOperation::Zero => 0,
        StencilOperation::Replace => reference,
        StencilOperation::IncrementClamp => stored.saturating_add(1),
        StencilOperation::DecrementClamp => stored.saturating_sub(1),
        StencilOperation::Invert => !stored,
        StencilOperation::IncrementWrap => stored.wrapping_add(1),
        StencilOperation::DecrementWrap => stored.wrapping_sub(1),
    }
}

/// What a pixel holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    pub(crate) color: [f32; 4],
    pub(crate) depth: f32,
    pub(crate) stencil: u8,
    pub(crate) draw: u32,
}

impl Sample {
    /// One fragment more. Whether it passed.
    pub(crate) fn draw(&mut self, draw: usize, layer: &Layer, at: usize) -> bool {
        let (state, color, z) = (&layer.state, layer.colors[at], layer.depths[at]);
        if layer.discards && color[3] < 0.25 {
            return false;
        }
        let depth_passes = passes(state.depth.compare, z, self.depth);
        let mut all_pass = depth_passes;
        if let Some(stencil) = state.stencil {
            let is_front = layer.clockwise[at] == (state.front_face == FrontFace::Clockwise);
            let face = if is_front { stencil.front } else { stencil.back };
            let read = |value: u8| f32::from(value & face.read_mask);
            let stencil_passes = passes(face.compare, read(face.reference), read(self.stencil));
            let operation = match (stencil_passes, depth_passes) {
                (false, _) => face.fail,
                (true, false) => face.depth_fail,
                (true, true) => face.pass,
            };
            let new = operated(operation, self.stencil, face.reference);
            self.stencil = (self.stencil & !face.write_mask) | (new & face.write_mask);
            all_pass = stencil_passes && depth_passes;
        }
        if all_pass {
            self.draw = draw as u32;
            if state.depth.write {
                self.depth = z;
            }
            if state.color_mask == ColorMask::ALL {
                let sum = [0, 1, 2, 3].map(|k| self.color[k] + color[k]);
                self.color = if state.blend == Blend::ADD { sum } else { color };
            }
        }
        all_pass
    }
}

fn random_face(random: &mut Random) -> StencilFace {
    let mask = |random: &mut Random| random.pick(&[0xff, 0xff, 0x0f, 0x81, 0]);
    let operation = |random: &mut Random| random.pick(&StencilOperation::ALL);
    StencilFace {
        compare: random.pick(&Compare::ALL),
        fail: operation(random),
        depth_fail: operation(random),
        pass: operation(random),
        read_mask: mask(random),
        write_mask: mask(random),
        reference: random.pick(&[0, 1, 2, 128, 254, 255]),
    }
}

pub(crate) fn random_layer(random: &mut Random) -> Layer {
    let depth = DepthState { compare: random.pick(&Compare::ALL), write: random.one_in(2) };
    let state = DrawState {
        depth,
        stencil: (!random.one_in(4)).then(|| StencilState { front: random_face(random), back: random_face(random) }),
        blend: random.pick(&[Blend::OPAQUE, Blend::ADD]),
        color_mask: random.pick(&[ColorMask::ALL, ColorMask::ALL, ColorMask::NONE]),
        front_face: random.pick(&[FrontFace::Clockwise, FrontFace::CounterClockwise]),
        ..DrawState::default()
    };
    let mut layer =
        Layer::new(state, || ([1.0, 0.5, 0.0, random.unit()], random.between(0, 4) as f32 / 4.0, random.one_in(2)));
    layer.discards = random.one_in(3);
    layer
}

#[test]
fn every_operation_and_comparison_in_submission_order() {
    for seed in 0..1_000 {
        let mut random = Random::new(seed);
        let layers: Vec<Layer> = (0..random.between(1, 4)).map(|_| random_layer(&mut random)).collect();
        let stored = |random: &mut Random| random.pick(&[0, 1, 2, 127, 128, 254, 255]);
        let given: Vec<u8> = (0..PIXELS).map(|_| stored(&mut random)).collect();
        let clear = random.one_in(3).then(|| stored(&mut random));
        let wanted: Vec<Sample> = (0..PIXELS)
            .map(|at| {
                let stencil = clear.unwrap_or(given[at]);
                let mut sample = Sample { color: [0.0; 4], depth: 0.5, stencil, draw: NO_ID };
                for (draw, layer) in layers.iter().enumerate() {
                    sample.draw(draw, layer, at);
                }
                sample
            })
            .collect();
        for settings in settings(seed) {
            let (mut color, mut depth) = (vec![[9.0; 4]; PIXELS], vec![9.0; PIXELS]);
            let (mut stencil, mut ids) = (given.clone(), vec![0; PIXELS]);
            let mut pass = Pass::new();
            (pass.clear_depth, pass.clear_stencil) = (Some(0.5), clear);
            layers.iter().for_each(|layer| layer.draw(&mut pass));
            let mut target = Target {
                color: ColorBuffer::Rgba32F(&mut color),
                depth: DepthBuffer::D32F(&mut depth),
                stencil: Some(&mut stencil),
                draw_ids: Some(&mut ids),
                ..Target::new(WIDTH, HEIGHT)
            };
            Renderer::new(settings.clone()).expect("available").render(&pass, &mut target).expect("valid");
            for at in 0..PIXELS {
                let found = Sample { color: color[at], depth: depth[at], stencil: stencil[at], draw: ids[at] };
                let states: Vec<_> = layers.iter().map(|layer| (layer.state, layer.discards)).collect();
                assert_eq!(found, wanted[at], "scene {seed}, pixel {at}, {settings:?}, {states:#?}");
            }
        }
    }
}

/// Without a buffer, stencil values live as long as the pass, also if it takes several flushes.
#[test]
fn a_target_without_a_stencil_buffer_has_one_for_the_pass() {
    let mark = StencilFace { pass: StencilOperation::IncrementWrap, ..StencilFace::IGNORE };
    let state = DrawState {
        depth: DepthState::OFF,
        color_mask: ColorMask::NONE,
        stencil: Some(StencilState::both(mark)),
        ..DrawState::default()
    };
    let marks: Vec<Layer> = (0..20).map(|_| Layer::new(state, || ([1.0; 4], 0.5, true))).collect();
    let shows = StencilFace { compare: Compare::Equal, reference: 23, ..StencilFace::IGNORE };
    let state = DrawState { stencil: Some(StencilState::both(shows)), ..DrawState::default() };
    let show = Layer::new(state, || ([0.25; 4], 0.5, true));
    let draw = |settings: Settings| {
        let mut pass = Pass::new();
        pass.clear_stencil = Some(3);
        marks.iter().chain([&show]).for_each(|layer| layer.draw(&mut pass));
        let mut color = vec![[0.0; 4]; PIXELS];
        let mut target = Target { color: ColorBuffer::Rgba32F(&mut color), ..Target::new(WIDTH, HEIGHT) };
        let statistics = Renderer::new(settings).expect("available").render(&pass, &mut target).expect("valid");
        assert!(color.iter().all(|&pixel| pixel == [0.25; 4]));
        statistics.flushes
    };
    assert_eq!(draw(Settings::default()), 1);
    assert!(draw(Settings { memory: 0, ..Settings::default() }) > 1);
}
