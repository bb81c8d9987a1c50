//! Strips, fans, restarts, indices of any width and instances are the same bits as lists of the same triangles.

use crate::scene::random_state;
use pineda::*;
use pineda_oracle::cases::Random;
use pineda_proof::{Drawing, Renderers};
use std::sync::atomic::{AtomicUsize, Ordering};

const WIDTH: u32 = 90;
const HEIGHT: u32 = 60;

/// A position in clip space, and what is interpolated in each of the three ways.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    position: [f32; 4],
    values: [f32; 4],
}

varyings! {
    struct Values {
        smooth: Vec2,
        #[noperspective]
        linear: Real,
        #[flat]
        flat: Real,
    }
}

fn staged(v: &Vertex) -> (Vec4, Values) {
    let [a, b, c, d] = v.values;
    (v.position.into(), Values { smooth: [a, b].into(), linear: c.into(), flat: d.into() })
}

/// Shows the values, flat ones among them.
struct Look;

#[shader]
impl Shader for Look {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Values<L>;
    fn vertex(&self, v: &Vertex) -> (Vec4, Values) {
        staged(v)
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba { r: f.smooth.x, g: f.smooth.y, b: f.linear, a: f.flat }
    }
}

/// What is different in an instance.
#[derive(Clone, Copy, Debug)]
struct Instance {
    by: [f32; 4],
    value: f32,
}

fn moved(v: &Vertex, instance: &Instance) -> Vertex {
    let [a, b, c, d] = v.values;
    Vertex { position: [0, 1, 2, 3].map(|k| v.position[k] + instance.by[k]), values: [a, b, c, d + instance.value] }
}

/// The same for the vertices of instances.
struct InstancedLook;

#[shader]
impl Shader for InstancedLook {
    type Vertex = Instanced<Vertex, Instance>;
    type Varyings<L: Lanes> = Values<L>;
    fn vertex(&self, v: &Self::Vertex) -> (Vec4, Values) {
        staged(&moved(&v.vertex, &v.instance))
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba { r: f.smooth.x, g: f.smooth.y, b: f.linear, a: f.flat }
    }
}

/// Indices of one width.
#[derive(Clone, Debug)]
enum Row {
    Sequential,
    U8(Vec<u8>),
    U16(Vec<u16>),
    U32(Vec<u32>),
}

/// In a row as it is kept here.
const RESTART: u32 = u32::MAX;

impl Row {
    /// Of a width that is wide enough for them.
    fn new(random: &mut Random, indices: &[u32]) -> Self {
        let largest = indices.iter().filter(|&&i| i != RESTART).max().copied().unwrap_or(0);
        match random.between(0, 3) {
            0 if largest < 0xff => Self::U8(indices.iter().map(|&i| i as u8).collect()),
            0 | 1 if largest < 0xffff => Self::U16(indices.iter().map(|&i| i as u16).collect()),
            _ => Self::U32(indices.to_vec()),
        }
    }

    fn indices(&self) -> Indices<'_> {
        match self {
            Self::Sequential => Indices::Sequential,
            Self::U8(indices) => Indices::U8(indices),
            Self::U16(indices) => Indices::U16(indices),
            Self::U32(indices) => Indices::U32(indices),
        }
    }
}

/// The triangles of a row, in the order that Vulkan's chapter "Primitive Topologies" and its table of barycentric coordinates say.
fn triangles(row: &[u32], state: &DrawState) -> Vec<u32> {
    let is_last = state.provoking_vertex == ProvokingVertex::Last;
    let mut out = Vec::new();
    for v in row.split(|&i| i == RESTART && state.primitive_restart) {
        for i in 0..v.len().saturating_sub(2) {
            out.extend(match (state.topology, is_last) {
                (PrimitiveTopology::TriangleStrip, _) if i % 2 == 0 => [v[i], v[i + 1], v[i + 2]],
                (PrimitiveTopology::TriangleStrip, false) => [v[i], v[i + 2], v[i + 1]],
                (PrimitiveTopology::TriangleStrip, true) => [v[i + 1], v[i], v[i + 2]],
                (PrimitiveTopology::TriangleFan, false) => [v[i + 1], v[i + 2], v[0]],
                (PrimitiveTopology::TriangleFan, true) => [v[0], v[i + 1], v[i + 2]],
                _ if i % 3 == 0 => [v[i], v[i + 1], v[i + 2]],
                _ => continue,
            });
        }
    }
    out
}

/// Vertices that lie close to their neighbours in the buffer, some of them outside of the picture, near the eye or behind it.
fn vertices(random: &mut Random, count: usize, size: f32) -> Vec<Vertex> {
    let mut at = [0.0, 0.0];
    let vertex = |_| {
        at = at.map(|x| if random.one_in(15) { random.real(-1.0, 1.0) } else { x + random.real(-size, size) });
        let at = at.map(|x: f32| x.clamp(-1.5, 1.5));
        let w = if random.one_in(3) { random.real(-0.2, 2.0) } else { 1.0 };
        let position = [at[0] * w, at[1] * w, random.between(-1, 9) as f32 / 8.0 * w, w];
        Vertex { position, values: [0; 4].map(|_| random.real(-1.0, 1.0)) }
    };
    (0..count).map(vertex).collect()
}

/// A random state, and a row for its topology. Mostly each index is near the one before.
fn case(random: &mut Random, vertices: usize, length: usize, restarts: u64) -> (DrawState, Vec<u32>) {
    let topologies =
        [PrimitiveTopology::TriangleList, PrimitiveTopology::TriangleStrip, PrimitiveTopology::TriangleFan];
    let topology = random.pick(&topologies);
    let primitive_restart = topology != PrimitiveTopology::TriangleList && random.one_in(2);
    let provoking_vertex = random.pick(&[ProvokingVertex::First, ProvokingVertex::Last]);
    let mut base = if random.one_in(2) { DrawState::default() } else { random_state(random) };
    base.cull = random.pick(&[Cull::None, Cull::None, Cull::Front, Cull::Back]);
    let state = DrawState { topology, primitive_restart, provoking_vertex, space: Space::Clip, ..base };
    let length = if topology == PrimitiveTopology::TriangleList { length / 3 * 3 } else { length };
    let all_over = random.one_in(4);
    let index = |k: usize| {
        let near = (k * vertices / length) as i64 + random.between(-3, 3);
        if primitive_restart && random.one_in(restarts) {
            RESTART
        } else if all_over {
            (random.bits() % vertices as u64) as u32
        } else {
            near.rem_euclid(vertices as i64) as u32
        }
    };
    (state, (0..length).map(index).collect())
}

fn drawn(renderer: &mut Renderer, vertices: &[Vertex], indices: Indices<'_>, state: DrawState) -> Drawing {
    let mut pass = Pass::new();
    pass.draw(&Look, Mesh { vertices, indices }, state);
    Drawing::of(renderer, &pass, WIDTH, HEIGHT).expect("valid")
}

/// A list in the order of the state's provoking vertex.
fn drawn_as_list(vertices: &[Vertex], list: &[u32], state: DrawState) -> Drawing {
    let state = DrawState { topology: PrimitiveTopology::TriangleList, primitive_restart: false, ..state };
    let mut renderer = Renderer::new(Settings { threads: 1, ..Settings::default() }).expect("the best level");
    drawn(&mut renderer, vertices, Indices::U32(list), state)
}

fn same(seed: u64, what: &str, mut whole: Drawing, mut other: Drawing) {
    // Each flush counts.
    (whole.statistics.flushes, other.statistics.flushes) = (1, 1);
    assert_eq!(whole.statistics, other.statistics, "seed {seed}, {what}");
    assert_eq!(whole.difference(&other), None, "seed {seed}, {what}");
}

#[test]
fn every_topology_is_the_same_bits_as_a_list() {
    let (mut renderers, mut covering, mut clipping) = (Renderers::default(), 0, 0);
    for seed in 0..600 {
        let mut random = Random::new(seed);
        let count = random.between(3, 200) as usize;
        let vertices = vertices(&mut random, count, 0.3);
        let length = random.between(0, 300) as usize;
        let (state, row) = case(&mut random, count, length, 12);
        let list = drawn_as_list(&vertices, &triangles(&row, &state), state);
        let indices = Row::new(&mut random, &row);
        let found = drawn(renderers.nth(random.bits()), &vertices, indices.indices(), state);
        covering += usize::from(found.hits.iter().any(|&hits| hits > 0));
        clipping += usize::from(found.statistics.clipped > 0);
        same(seed, &format!("{state:?} {indices:?}"), list, found);
    }
    assert!(covering > 400 && clipping > 200, "{covering} cover pixels, {clipping} are clipped");
}

#[test]
fn vertices_without_indices_are_the_same_bits() {
    let mut renderers = Renderers::default();
    for seed in 0..200 {
        let mut random = Random::new(!seed);
        let count = random.between(0, 60) as usize * 3;
        let vertices = vertices(&mut random, count, 0.3);
        let (state, _) = case(&mut random, 1, 3, 12);
        let row: Vec<u32> = (0..count as u32).collect();
        let list = drawn_as_list(&vertices, &triangles(&row, &state), state);
        let found = drawn(renderers.nth(random.bits()), &vertices, Row::Sequential.indices(), state);
        same(seed, &format!("{state:?}"), list, found);
    }
}

#[test]
fn the_provoking_vertex_decides_flat_values_alone() {
    for seed in 0..100 {
        let mut random = Random::new(900 + seed);
        let vertices = vertices(&mut random, 60, 0.4);
        let (state, row) = case(&mut random, 60, 90, 12);
        let state = DrawState { provoking_vertex: ProvokingVertex::Last, ..state };
        // Turned so that the provoking vertex comes first, but drawn with the first one provoking.
        let mut list = triangles(&row, &state);
        list.as_chunks_mut::<3>().0.iter_mut().for_each(|corners| corners.rotate_right(1));
        let mut turned =
            drawn_as_list(&vertices, &list, DrawState { provoking_vertex: ProvokingVertex::First, ..state });
        turned.barycentrics.iter_mut().for_each(|weights| weights.rotate_left(1));
        let indices = Row::new(&mut random, &row);
        let mut renderer = Renderer::new(Settings::default()).expect("the best level");
        same(seed, "turned", turned, drawn(&mut renderer, &vertices, indices.indices(), state));
    }
}

#[test]
fn long_strips_are_cut_like_lists() {
    for seed in 0..if cfg!(debug_assertions) { 8 } else { 24 } {
        let mut random = Random::new(4_000 + seed);
        let count = random.pick(&[200, 9_000, 40_000]);
        let vertices = vertices(&mut random, count, 0.05);
        let restarts = random.pick(&[20, 3_000, 9_000]);
        let (state, row) = case(&mut random, count, 30_000, restarts);
        let list = drawn_as_list(&vertices, &triangles(&row, &state), state);
        for settings in [
            Settings { memory: 0, threads: 1, ..Settings::default() },
            Settings { memory: 3 << 19, threads: 2, tile: TileSize::T16, ..Settings::default() },
            Settings { memory: 0, threads: 7, simd: Simd::Scalar, ..Settings::default() },
        ] {
            let indices = Row::new(&mut random, &row);
            let mut renderer = Renderer::new(settings).expect("available");
            let found = drawn(&mut renderer, &vertices, indices.indices(), state);
            assert!(state.topology == PrimitiveTopology::TriangleList || found.statistics.flushes > 1);
            same(seed, &format!("{state:?}"), list.clone(), found);
        }
        let mut renderer = Renderer::new(Settings { memory: 0, ..Settings::default() }).expect("the best level");
        let in_order: Vec<u32> = (0..count as u32 / 3 * 3).collect();
        let list = drawn_as_list(&vertices, &triangles(&in_order, &state), state);
        let found = drawn(&mut renderer, &vertices[..in_order.len()], Indices::Sequential, state);
        same(seed, &format!("{state:?} in order"), list, found);
    }
}

fn instances(random: &mut Random, count: usize) -> Vec<Instance> {
    let instance = |_| Instance {
        by: [random.real(-0.5, 0.5), random.real(-0.5, 0.5), random.between(0, 4) as f32 / 16.0, 0.0],
        value: random.real(-1.0, 1.0),
    };
    (0..count).map(instance).collect()
}

/// Draws a mesh instance by instance, and as one list of all vertices moved.
fn check_instances(seed: u64, random: &mut Random, renderer: &mut Renderer, count: usize, size: [usize; 2]) -> Drawing {
    let [vertex_count, length] = size;
    let vertices = vertices(random, vertex_count, 0.1);
    // Only the middle of the buffer is used.
    let third = vertex_count / 3;
    let (state, mut row) = case(random, vertex_count - 2 * third, length, 12);
    row.iter_mut().filter(|i| **i != RESTART).for_each(|i| *i += third as u32);
    let instances = instances(random, count);
    let list = triangles(&row, &state);
    let all: Vec<Vertex> = instances.iter().flat_map(|i| vertices.iter().map(|v| moved(v, i))).collect();
    let indices = |i: usize| list.iter().map(move |&index| index + (i * vertex_count) as u32);
    let indices: Vec<u32> = (0..count).flat_map(indices).collect();
    let mut expected = drawn_as_list(&all, &indices, state);
    let each = (list.len() / 3) as u32;
    for (triangle, instance) in expected.triangle_ids.iter_mut().zip(&mut expected.instance_ids) {
        if *triangle != NO_ID {
            (*instance, *triangle) = (*triangle / each, *triangle % each);
        }
    }
    let row = Row::new(random, &row);
    let mut pass = Pass::new();
    pass.draw_instanced(&InstancedLook, Mesh { vertices: &vertices, indices: row.indices() }, &instances, state);
    let found = Drawing::of(renderer, &pass, WIDTH, HEIGHT).expect("valid");
    same(seed, &format!("{count} instances, {state:?}"), expected, found.clone());
    found
}

#[test]
fn instances_are_the_same_bits_as_draws() {
    let mut renderers = Renderers::default();
    for seed in 0..200 {
        let mut random = Random::new(7_000 + seed);
        let count = random.between(0, 20) as usize;
        let size = [random.between(3, 90) as usize, random.between(0, 60) as usize];
        let setting = random.bits();
        check_instances(seed, &mut random, renderers.nth(setting), count, size);
    }
}

#[test]
fn many_and_large_instances_are_cut() {
    // Batches of many instances, of a few, and instances of several batches. Last, some that use a few vertices of many: of indices of every width.
    let mut cases = vec![(0, 9_000, [9, 9]), (1, 40, [900, 1_800]), (2, 3, [9_000, 36_000]), (3, 3, [50_000, 30_000])];
    let last = if cfg!(debug_assertions) { 6 } else { 12 };
    cases.extend((4..last).map(|seed| (seed, 9_000, [90, 6])));
    for (seed, count, size) in cases {
        for (threads, simd) in [(1, Simd::Auto), (2, Simd::Scalar), (7, Simd::Auto)] {
            let mut random = Random::new(seed);
            let settings = Settings { memory: 0, threads, simd, ..Settings::default() };
            let mut renderer = Renderer::new(settings).expect("available");
            let found = check_instances(seed, &mut random, &mut renderer, count, size);
            assert!(found.statistics.flushes > 1, "seed {seed}: {:?}", found.statistics);
        }
    }
}

#[test]
fn instances_without_indices_go_through_the_vertex_stage_once() {
    let corners = [[0.0, 0.0], [3.0, 0.0], [0.0, 3.0], [3.0, 3.0]];
    for (topology, length, triangles_each) in
        [(PrimitiveTopology::TriangleList, 3, 1), (PrimitiveTopology::TriangleStrip, 4, 2)]
    {
        for count in [0, 1, 2, 1_000, 100_000] {
            for memory in [0, 512 << 20] {
                let (stages, state) =
                    (AtomicUsize::new(0), DrawState { topology, space: Space::Raster, ..DrawState::default() });
                let places: Vec<[f32; 2]> =
                    (0..count).map(|k| [(k % 30 * 3) as f32, (k / 30 % 20 * 3) as f32]).collect();
                let mut pass = Pass::new();
                pass.draw_instanced_with(
                    Mesh { vertices: &corners[..length], indices: Indices::Sequential },
                    &places,
                    state,
                    |v| {
                        stages.fetch_add(1, Ordering::Relaxed);
                        let [x, y] = [0, 1].map(|k| v.vertex[k] + v.instance[k]);
                        (Vec4::from([x, y, 1.0 - v.instance_id as f32 / 200_000.0, 1.0]), ())
                    },
                    |f| Rgba::gray(f.z()),
                );
                let mut renderer = Renderer::new(Settings { memory, ..Settings::default() }).expect("the best level");
                let drawing = Drawing::of(&mut renderer, &pass, WIDTH, HEIGHT).expect("valid");
                assert_eq!(stages.load(Ordering::Relaxed), count * length);
                assert_eq!(drawing.statistics.triangles as usize, count * triangles_each);
                // The last one of each place is the nearest.
                if count == 100_000 {
                    assert!(drawing.instance_ids[0] == 99_600 && drawing.instance_ids[3] == 99_601);
                    assert!(
                        drawing.triangle_ids[0] == 0 && drawing.statistics.flushes == if memory == 0 { 14 } else { 1 }
                            || memory == 0
                    );
                }
            }
        }
    }
}
