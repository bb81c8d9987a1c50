//! A fragment stage that asks which triangle, instance and draw it shades is told what the target's own buffers of ids hold.

use pineda::*;
use pineda_oracle::cases::Random;

/// Shows the ids, each a number more: 0 is where nothing was drawn.
struct Ids;

/// The same, of a shader that may discard: shaded in order.
struct IdsWithHoles;

macro_rules! shows_ids {
    ($shader:ident, $discards:literal, |$f:ident| {$($first:stmt;)?}) => {
        #[shader]
        impl Shader for $shader {
            type Vertex = Instanced<[f32; 4], [f32; 2]>;
            type Varyings<L: Lanes> = Vec2<L>;
            const IDS: bool = true;
            const DISCARDS: bool = $discards;
            fn vertex(&self, v: &Self::Vertex) -> (Vec4, Vec2) {
                let ([x, y, z, w], [dx, dy]) = (v.vertex, v.instance);
                (Vec4::from([x + dx * w, y + dy * w, z, w]), Vec2::from([x, y]))
            }
            fn fragment<L: Lanes>(&self, $f: &mut Fragment<L, Self>) -> RgbaU<L> {
                $($first;)?
                let one = Uint::new($f.lanes(), 1);
                RgbaU { r: $f.triangle_id() + one, g: $f.instance_id() + one, b: $f.draw_id() + one, a: one }
            }
        }
    };
}

shows_ids!(Ids, false, |f| {});
shows_ids!(IdsWithHoles, true, |f| {
    f.discard((f.x() * 0.37).fract().lt(0.25));
});

const SIZE: [u32; 2] = [97, 61];

/// A soup in clip space: some of it behind the eye, some across the near plane.
fn soup(random: &mut Random, corners: usize) -> Vec<[f32; 4]> {
    let mut number = |low: i64, high: i64| random.between(low, high) as f32 / 64.0;
    (0..corners).map(|_| [number(-96, 96), number(-96, 96), number(-16, 64), number(-8, 96)]).collect()
}

/// What the shader saw, and what the target says, sample by sample.
fn drawn(settings: Settings, samples: Samples, sampling: Sampling) -> [Vec<[u32; 3]>; 2] {
    let mut random = Random::new(7);
    let meshes: Vec<_> = (0..6).map(|_| soup(&mut random, 90)).collect();
    let instances = [[0.0, 0.0], [0.4, 0.1], [-0.3, 0.5]];
    let mut pass = Pass::new();
    let topologies = [
        PrimitiveTopology::TriangleList,
        PrimitiveTopology::TriangleStrip,
        PrimitiveTopology::TriangleFan,
        PrimitiveTopology::LineStrip,
        PrimitiveTopology::PointList,
        PrimitiveTopology::TriangleList,
    ];
    for (k, (vertices, topology)) in meshes.iter().zip(topologies).enumerate() {
        let polygon_mode = if k == 5 { PolygonMode::Line } else { PolygonMode::Fill };
        let state =
            DrawState { topology, polygon_mode, line_width: 2.0, point_size: 5.0, sampling, ..DrawState::default() };
        let mesh = Mesh { vertices: &vertices[..], indices: Indices::Sequential };
        if k % 2 == 0 {
            pass.draw_instanced(&Ids, mesh, &instances[..1 + k / 2], state);
        } else {
            pass.draw_instanced(&IdsWithHoles, mesh, &instances, state);
        }
    }
    let pixels = samples.count() * (SIZE[0] * SIZE[1]) as usize;
    let (mut colors, mut ids) = (vec![[0; 4]; pixels], [vec![0; pixels], vec![0; pixels], vec![0; pixels]]);
    let [triangles, instances, draws] = &mut ids;
    let mut target = Target {
        color: ColorBuffer::Rgba32U(&mut colors),
        triangle_ids: Some(triangles),
        instance_ids: Some(instances),
        draw_ids: Some(draws),
        samples,
        ..Target::new(SIZE[0], SIZE[1])
    };
    Renderer::new(settings).and_then(|mut renderer| renderer.render(&pass, &mut target)).expect("it draws");
    let seen = colors.iter().map(|&[triangle, instance, draw, _]| [triangle, instance, draw]).collect();
    // `NO_ID` is the largest number.
    let told = (0..pixels).map(|k| [0, 1, 2].map(|which| ids[which][k].wrapping_add(1))).collect();
    [seen, told]
}

#[test]
fn fragments_are_told_the_ids_that_targets_hold() {
    for samples in [Samples::One, Samples::Four] {
        for sampling in [Sampling::Centroid, Sampling::Sample] {
            let mut all = Vec::new();
            for (memory, threads) in [(512 << 20, 1), (1 << 14, 3)] {
                let settings = Settings { memory, threads, ..Settings::default() };
                let [seen, told] = drawn(settings, samples, sampling);
                assert!(seen == told, "{samples:?}, {sampling:?}, {memory} bytes");
                all.push(seen);
            }
            assert!(all[0] == all[1], "{samples:?}, {sampling:?}: flushes change ids");
            let draws: std::collections::BTreeSet<_> = all[0].iter().map(|ids| ids[2]).filter(|&id| id > 0).collect();
            let instances: std::collections::BTreeSet<_> =
                all[0].iter().map(|ids| ids[1]).filter(|&id| id > 0).collect();
            assert_eq!((draws.len(), instances.len()), (6, 3), "every draw and every instance is seen");
        }
    }
}
