//! Barycentric coordinates in the fragment stage: what targets hold, what varyings are interpolated with, and the same whatever the order of the vertices.

use pineda::*;
use pineda_oracle::cases::{Random, orders};

const SIZE: [u32; 2] = [97, 61];

/// Both kinds of coordinates.
struct Shows;

/// The same, of a shader that may discard.
struct ShowsWithHoles;

macro_rules! shows {
    ($shader:ident, $discards:literal, |$f:ident| {$($first:stmt;)?}) => {
        #[shader]
        impl Shader for $shader {
            type Vertex = Instanced<[f32; 4], [f32; 2]>;
            type Varyings<L: Lanes> = Vec2<L>;
            const BARYCENTRICS: bool = true;
            const DISCARDS: bool = $discards;
            fn vertex(&self, v: &Self::Vertex) -> (Vec4, Vec2) {
                let ([x, y, z, w], [dx, dy]) = (v.vertex, v.instance);
                (Vec4::from([x + dx * w, y + dy * w, z, w]), Vec2::from([x, y]))
            }
            fn fragment<L: Lanes>(&self, $f: &mut Fragment<L, Self>) -> (Rgba<L>, Rgba<L>) {
                $($first;)?
                (Rgba::opaque($f.barycentrics()), Rgba::opaque($f.barycentrics_noperspective()))
            }
        }
    };
}

shows!(Shows, false, |f| {});
shows!(ShowsWithHoles, true, |f| {
    f.discard((f.x() * 0.37).fract().lt(0.25));
});

/// A soup in clip space: some of it behind the eye, some across the near plane.
fn soup(random: &mut Random, corners: usize) -> Vec<[f32; 4]> {
    let mut number = |low: i64, high: i64| random.between(low, high) as f32 / 64.0;
    (0..corners).map(|_| [number(-96, 96), number(-96, 96), number(-16, 64), number(-8, 96)]).collect()
}

/// By sample, or with one: there a fragment is shaded where the target's coordinates are of.
#[test]
fn fragments_are_told_the_coordinates_that_targets_hold() {
    for (samples, sampling) in [(Samples::One, Sampling::Centroid), (Samples::Four, Sampling::Sample)] {
        let mut seen = Vec::new();
        for (memory, threads) in [(1 << 29, 1), (1 << 14, 3)] {
            let mut random = Random::new(11);
            let topologies = [
                PrimitiveTopology::TriangleList,
                PrimitiveTopology::TriangleStrip,
                PrimitiveTopology::TriangleFan,
                PrimitiveTopology::LineStrip,
                PrimitiveTopology::PointList,
                PrimitiveTopology::TriangleList,
                PrimitiveTopology::TriangleList,
            ];
            let meshes: Vec<_> = topologies.map(|_| soup(&mut random, 90)).into();
            let instances = [[0.0, 0.0], [0.4, 0.1], [-0.3, 0.5]];
            let mut pass = Pass::new();
            for (k, (vertices, topology)) in meshes.iter().zip(topologies).enumerate() {
                let polygon_mode = [PolygonMode::Fill, PolygonMode::Line, PolygonMode::Point][k.saturating_sub(4)];
                let state = DrawState {
                    topology,
                    polygon_mode,
                    line_width: 2.0,
                    point_size: 5.0,
                    sampling,
                    provoking_vertex: [ProvokingVertex::First, ProvokingVertex::Last][k / 2 % 2],
                    ..DrawState::default()
                };
                let mesh = Mesh { vertices: &vertices[..], indices: Indices::Sequential };
                if k % 2 == 0 {
                    pass.draw_instanced(&Shows, mesh, &instances[..1 + k / 3], state);
                } else {
                    pass.draw_instanced(&ShowsWithHoles, mesh, &instances, state);
                }
            }
            let pixels = samples.count() * (SIZE[0] * SIZE[1]) as usize;
            let (mut with, mut without, mut told) =
                (vec![[0.0; 4]; pixels], vec![[0.0; 4]; pixels], vec![[0.0; 3]; pixels]);
            let mut target = Target {
                samples,
                color: ColorBuffer::Rgba32F(&mut with),
                more_colors: vec![ColorBuffer::Rgba32F(&mut without)],
                barycentrics: Some(&mut told),
                ..Target::new(SIZE[0], SIZE[1])
            };
            let settings = Settings { memory, threads, ..Settings::default() };
            Renderer::new(settings).and_then(|mut renderer| renderer.render(&pass, &mut target)).expect("it draws");
            let mut count = 0;
            for (at, (&[x, y, z, a], told)) in with.iter().zip(&told).enumerate() {
                assert_eq!([x, y, z].map(f32::to_bits), told.map(f32::to_bits), "{samples:?}, {at}");
                count += usize::from(a == 1.0);
                // The bound that is documented; clipped triangles' may be far beyond 1 without perspective.
                let sum = |[x, y, z, _]: [f32; 4]| (f64::from(x) + f64::from(y)) + f64::from(z);
                let (largest, off) = (without[at].iter().fold(1.0f32, |m, c| m.max(c.abs())), 2f64.powi(-22));
                assert!(a == 0.0 || (sum(with[at]) - 1.0).abs() <= off, "{:?}", with[at]);
                assert!(a == 0.0 || (sum(without[at]) - 1.0).abs() <= off * f64::from(largest), "{:?}", without[at]);
            }
            assert!(count > pixels / 2);
            seen.push((with, without));
        }
        assert!(seen[0] == seen[1], "{samples:?}: threads or flushes change coordinates");
    }
}

varyings! {
    struct Units {
        with: Vec3,
        #[noperspective]
        without: Vec3,
    }
}

/// The differences between the coordinates and varyings that are 1 at one vertex and 0 at the others.
struct Differs;

#[shader]
impl Shader for Differs {
    type Vertex = ([f32; 4], [f32; 3]);
    type Varyings<L: Lanes> = Units<L>;
    const BARYCENTRICS: bool = true;
    fn vertex(&self, &(position, unit): &Self::Vertex) -> (Vec4, Units) {
        (position.into(), Units { with: unit.into(), without: unit.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> (Rgba<L>, Rgba<L>) {
        let (with, without) = (f.barycentrics(), f.barycentrics_noperspective());
        let largest = |v: Vec3<L>| v.x.abs().max(v.y.abs()).max(v.z.abs()).max(1.0);
        (Rgba::new(with - f.with, largest(with)), Rgba::new(without - f.without, largest(without)))
    }
}

/// Wherever fragments are shaded, the centres and borders of multisampled pixels among it.
#[test]
fn coordinates_are_what_varyings_are_interpolated_with() {
    for (seed, samples) in [(0, Samples::One), (1, Samples::Four), (2, Samples::Eight)] {
        for sampling in [Sampling::Centroid, Sampling::Center, Sampling::Sample] {
            let mut random = Random::new(seed);
            let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let vertices: Vec<_> = soup(&mut random, 120).into_iter().zip(units.into_iter().cycle()).collect();
            let mut pass = Pass::new();
            let mesh = Mesh { vertices: &vertices[..], indices: Indices::Sequential };
            pass.draw(&Differs, mesh, DrawState { sampling, ..DrawState::default() });
            let pixels = samples.count() * (SIZE[0] * SIZE[1]) as usize;
            let (mut with, mut without) = (vec![[0.0; 4]; pixels], vec![[0.0; 4]; pixels]);
            let mut target = Target {
                samples,
                color: ColorBuffer::Rgba32F(&mut with),
                more_colors: vec![ColorBuffer::Rgba32F(&mut without)],
                ..Target::new(SIZE[0], SIZE[1])
            };
            Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("it draws");
            for &[x, y, z, largest] in with.iter().chain(&without) {
                let bound = largest * 2f32.powi(-21);
                assert!([x, y, z].iter().all(|c| c.abs() <= bound), "{samples:?}, {sampling:?}: {x} {y} {z} {largest}");
            }
        }
    }
}

/// All six orders, and so both windings: the numbers change places, and no bit.
#[test]
fn no_order_of_the_vertices_changes_a_bit_of_the_coordinates() {
    let mut random = Random::new(5);
    let vertices = soup(&mut random, 90);
    let drawn = |order: usize| {
        let indices: Vec<u32> = (0..30).flat_map(|t| orders([3 * t, 3 * t + 1, 3 * t + 2])[order]).collect();
        let mut pass = Pass::new();
        let mesh = Mesh { vertices: &vertices[..], indices: Indices::U32(&indices) };
        pass.draw_instanced(&Shows, mesh, &[[0.0; 2]], DrawState::default());
        let pixels = (SIZE[0] * SIZE[1]) as usize;
        let (mut with, mut without, mut ids) = (vec![[0.0; 4]; pixels], vec![[0.0; 4]; pixels], vec![0; pixels]);
        let mut target = Target {
            color: ColorBuffer::Rgba32F(&mut with),
            more_colors: vec![ColorBuffer::Rgba32F(&mut without)],
            triangle_ids: Some(&mut ids),
            ..Target::new(SIZE[0], SIZE[1])
        };
        Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("it draws");
        // Back to the order of the vertices.
        let back = |[x, y, z, _]: [f32; 4]| {
            let mut numbers = [0; 3];
            for (number, vertex) in [x, y, z].into_iter().zip(orders([0, 1, 2])[order]) {
                numbers[vertex as usize] = number.to_bits();
            }
            numbers
        };
        (with.into_iter().map(back).collect::<Vec<_>>(), without.into_iter().map(back).collect::<Vec<_>>(), ids)
    };
    let first = drawn(0);
    assert!(first.2.iter().any(|&id| id != NO_ID));
    for order in 1..6 {
        assert!(first == drawn(order), "order {order}");
    }
}

/// Where nothing is clipped, and nothing extrapolated.
#[test]
fn coordinates_in_a_triangle_lie_in_0_to_1() {
    let mut random = Random::new(3);
    let mut number = |low: i64, high: i64| random.between(low, high) as f32 / 8.0;
    let vertices: Vec<[f32; 4]> = (0..90).map(|_| [number(-100, 900), number(-100, 600), 0.5, number(1, 90)]).collect();
    let mut pass = Pass::new();
    let mesh = Mesh { vertices: &vertices[..], indices: Indices::Sequential };
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    pass.draw_instanced(&Shows, mesh, &[[0.0; 2]], state);
    let pixels = (SIZE[0] * SIZE[1]) as usize;
    let (mut with, mut without) = (vec![[0.0; 4]; pixels], vec![[0.0; 4]; pixels]);
    let mut target = Target {
        color: ColorBuffer::Rgba32F(&mut with),
        more_colors: vec![ColorBuffer::Rgba32F(&mut without)],
        ..Target::new(SIZE[0], SIZE[1])
    };
    Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("it draws");
    assert!(with.iter().chain(&without).flatten().all(|c| (0.0..=1.0).contains(c)));
    assert!(with.iter().filter(|color| color[3] == 1.0).count() > pixels / 2);
}
