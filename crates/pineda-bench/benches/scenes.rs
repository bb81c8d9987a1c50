//! Whole scenes at 1920 x 1080, with the picture in memory at the end. `cargo run --release` in `compare/` draws the same kinds of scenes
//! with other rasterizers, too.

mod common;

use common::{BlinnPhong, Gouraud, HEIGHT, Scene, WIDTH, fill, knot, micro};
use criterion::{Criterion, criterion_group, criterion_main};
use pineda::{
    ColorBuffer, Compare, Cull, DepthState, DrawState, Indices, Mesh, Pass, Renderer, Settings, Shader, Target,
};

fn scenes(criterion: &mut Criterion) {
    let gouraud = |camera| Gouraud { camera };
    let mut group = criterion.benchmark_group("scenes");
    group.sample_size(20);
    for threads in [1, 2] {
        let mut draw = |name: &str, scene: &Scene, state: DrawState| {
            let shader = gouraud(scene.camera);
            bench(&mut group, &format!("{name}/{threads}"), threads, scene, &shader, state);
        };
        draw("fill_front_to_back", &fill(true), DrawState::default());
        draw("fill_back_to_front", &fill(false), DrawState::default());
        draw("fill_front_to_back_reversed_z", &reversed(fill(true)), REVERSED);
        draw("fill_back_to_front_reversed_z", &reversed(fill(false)), REVERSED);
        draw("micro", &micro(), DrawState::default());
        let scene = knot();
        let shader = BlinnPhong { camera: scene.camera, eye: common::EYE, light: [0.4, 0.5, 0.768], shininess: 32.0 };
        let state = DrawState { cull: Cull::Back, ..DrawState::default() };
        bench(&mut group, &format!("medium/{threads}"), threads, &scene, &shader, state);
    }
    group.finish();
}

/// Near is 1, far is 0, and what is farther away from 0 is seen.
const REVERSED: DrawState =
    DrawState { depth: DepthState { compare: Compare::Greater, write: true }, ..DrawState::DEFAULT };

/// The scene for [`REVERSED`].
fn reversed(mut scene: Scene) -> Scene {
    scene.vertices.iter_mut().for_each(|vertex| vertex.position[2] = 1.0 - vertex.position[2]);
    scene
}

fn bench<Sh: Shader<Vertex = common::Vertex>>(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    name: &str,
    threads: usize,
    scene: &Scene,
    shader: &Sh,
    state: DrawState,
) {
    let mut pixels = vec![[0u8; 4]; (WIDTH * HEIGHT) as usize];
    let settings = Settings { threads, ..Settings::default() };
    let mut renderer = Renderer::new(settings).expect("the default level is there");
    let mut pass = Pass::new();
    pass.clear_depth = Some(if state.depth.compare == Compare::Greater { 0.0 } else { 1.0 });
    pass.draw(shader, Mesh { vertices: &scene.vertices, indices: Indices::U32(&scene.indices) }, state);
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            let mut target = Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(WIDTH, HEIGHT) };
            renderer.render(&pass, &mut target).expect("the scene is valid")
        });
    });
}

criterion_group!(benches, scenes);
criterion_main!(benches);
