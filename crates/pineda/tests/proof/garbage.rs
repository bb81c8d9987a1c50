//! Nothing panics, whatever the bits: this is compiled with overflow checks.

use pineda::*;
use pineda_oracle::cases::Random;
use pineda_proof::{Drawing, Probe, ProbeVertex, Renderers};

const CASES: u64 = if cfg!(debug_assertions) { 100_000 } else { 400_000 };

/// Any float: any bits, mostly, or one of those that are known for trouble.
fn float(random: &mut Random) -> f32 {
    match random.between(0, 3) {
        0 => f32::from_bits(random.bits() as u32),
        1 => random.sign() * random.magnitude(-8, 16),
        2 => random.pick(&[0.0, -0.0, 1.0, 0.5, f32::MIN_POSITIVE, 1e-45, f32::MAX, f32::NAN, f32::INFINITY, 32_768.0]),
        _ => random.real(-2.0, 40.0),
    }
}

fn floats<const N: usize>(random: &mut Random) -> [f32; N] {
    [0; N].map(|_| float(random))
}

#[test]
fn garbage_is_drawn_without_a_panic() {
    let mut renderers = Renderers::default();
    let (mut covered, mut dropped, mut refused) = (0, 0, 0);
    for seed in 0..CASES {
        let mut random = Random::new(seed);
        let (width, height) = (random.between(1, 24) as u32, random.between(1, 24) as u32);
        let count = 3 * random.between(1, 4);
        let vertex = |random: &mut Random| ProbeVertex {
            position: floats(random),
            smooth: floats(random),
            linear: floats(random),
        };
        let vertices: Vec<ProbeVertex> = (0..count).map(|_| vertex(&mut random)).collect();
        let viewport = random.one_in(3).then(|| {
            let [x, y, width, height, min_depth, max_depth] = floats(&mut random);
            let depth = |z: f32| if random.one_in(2) { z.clamp(0.0, 1.0) } else { z };
            let [min_depth, max_depth] = [min_depth, max_depth].map(depth);
            Viewport { x, y, width, height, min_depth, max_depth }
        });
        let state = DrawState {
            space: random.pick(&[Space::Clip, Space::Raster]),
            cull: random.pick(&[Cull::None, Cull::Front, Cull::Back]),
            front_face: random.pick(&[FrontFace::Clockwise, FrontFace::CounterClockwise]),
            depth: DepthState { compare: random.pick(&Compare::ALL), write: random.one_in(2) },
            blend: random.pick(&[Blend::OPAQUE, Blend::ALPHA, Blend::PREMULTIPLIED]),
            viewport,
            conservative: random.pick(&[Conservative::Off, Conservative::Overestimate, Conservative::Underestimate]),
            ..DrawState::default()
        };
        let mut pass = Pass::new();
        pass.clear_color = random.one_in(2).then(|| floats(&mut random));
        pass.clear_depth = random.one_in(2).then(|| float(&mut random));
        pass.draw(&Probe, Mesh { vertices: &vertices, indices: Indices::Sequential }, state);
        // Mostly one thread: starting seven takes longer than the drawing.
        let settings = if random.one_in(20) { random.bits() } else { random.bits() / 9 * 9 % renderers.count() };
        match Drawing::of(renderers.nth(settings), &pass, width, height) {
            Ok(drawing) => {
                covered += u64::from(drawing.hits.iter().any(|&hits| hits > 0));
                dropped += drawing.statistics.non_finite;
                let is_depth = |z: &f32| (0.0..=1.0).contains(z);
                assert!(drawing.depth.iter().all(is_depth), "seed {seed}: {:?}", drawing.depth);
                let not_finite = |v: &&[ProbeVertex]| v.iter().any(|v| v.position.iter().any(|x| !x.is_finite()));
                let expected = vertices.chunks(3).filter(not_finite).count() as u64;
                assert_eq!(drawing.statistics.non_finite, expected, "seed {seed}");
            }
            Err(Error::Viewport { .. }) => refused += 1,
            Err(error) => panic!("seed {seed}: {error}"),
        }
    }
    println!("{CASES} cases: {covered} cover pixels, {dropped} triangles dropped, {refused} viewports refused");
    assert!(covered > CASES / 25 && dropped > CASES / 4 && refused > CASES / 10);
}
