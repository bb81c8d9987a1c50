//! One benchmark a stage, by scenes in which that stage is nearly all that there is; one thread, 1920 x 1080.

mod common;

use common::{BlinnPhong, EYE, Gouraud, HEIGHT, Scene, Vertex, WIDTH, grid_strips, knot, micro};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pineda::{
    Blend, ColorBuffer, Cull, DepthBuffer, DrawState, Indices, Mat4, Mesh, Pass, PrimitiveTopology, Renderer, Rgba,
    Settings, Shader, Space, Target, Vec3, Vec4,
};

/// What is drawn to.
#[derive(Clone, Copy)]
enum Output {
    Color,
    Srgb,
    Depth,
    Ids,
}

fn bench<Sh: Shader<Vertex = Vertex>>(
    criterion: &mut Criterion,
    name: &str,
    elements: u64,
    scene: &Scene,
    shader: &Sh,
    state: DrawState,
    output: Output,
) {
    let count = (WIDTH * HEIGHT) as usize;
    let mut pixels = vec![[0u8; 4]; count];
    let mut depth = vec![0f32; count];
    let (mut ids, mut barycentrics) = (vec![0u32; count], vec![[0f32; 3]; count]);
    let mut renderer =
        Renderer::new(Settings { threads: 1, ..Settings::default() }).expect("the default level is there");
    let mut pass = Pass::new();
    pass.draw(shader, Mesh { vertices: &scene.vertices, indices: Indices::U32(&scene.indices) }, state);
    let mut group = criterion.benchmark_group("stages");
    group.sample_size(20).throughput(Throughput::Elements(elements));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            let mut target = Target::new(WIDTH, HEIGHT);
            match output {
                Output::Color => target.color = ColorBuffer::Rgba8(&mut pixels),
                Output::Srgb => target.color = ColorBuffer::Rgba8Srgb(&mut pixels),
                Output::Depth => target.depth = DepthBuffer::D32F(&mut depth),
                Output::Ids => {
                    target.triangle_ids = Some(&mut ids);
                    target.barycentrics = Some(&mut barycentrics);
                }
            }
            renderer.render(&pass, &mut target).expect("the scene is valid")
        });
    });
    group.finish();
}

/// Triangles of `size` pixels' side, all over the picture, `layers` deep.
fn triangles(size: f32, layers: u32) -> Scene {
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    let (columns, rows) = ((WIDTH as f32 / size) as u32, (HEIGHT as f32 / size) as u32);
    for layer in 0..layers {
        for cell in 0..columns * rows {
            let (x, y) = ((cell % columns) as f32 * size + 0.3, (cell / columns) as f32 * size + 0.6);
            let first = vertices.len() as u32;
            for (dx, dy) in [(0.0, 0.0), (size, 0.1 * size), (0.2 * size, size)] {
                let position = [
                    (x + dx) / WIDTH as f32 * 2.0 - 1.0,
                    1.0 - (y + dy) / HEIGHT as f32 * 2.0,
                    0.9 - 0.5 * layer as f32 / layers as f32,
                ];
                vertices.push(Vertex { position, normal: [0.0, 0.0, 1.0], color: [0.2, 0.5, 0.8] });
            }
            indices.extend([first, first + 1, first + 2]);
        }
    }
    Scene { vertices, indices, camera: Mat4::IDENTITY }
}

fn stages(criterion: &mut Criterion) {
    let pixels = u64::from(WIDTH * HEIGHT);
    let plain = Gouraud { camera: Mat4::IDENTITY };
    let state = DrawState::default();

    let nothing = Scene { vertices: Vec::new(), indices: Vec::new(), camera: Mat4::IDENTITY };
    bench(criterion, "clear_and_copy_out", pixels, &nothing, &plain, state, Output::Color);

    // No triangle at all: what is left is the vertex stage.
    let mut scene = micro();
    scene.indices = vec![0, 0, scene.vertices.len() as u32 - 1];
    bench(criterion, "vertex", scene.vertices.len() as u64, &scene, &plain, state, Output::Depth);

    // All culled: setup up to the decision; then all binned.
    let scene = micro();
    let count = scene.indices.len() as u64 / 3;
    let culled = |cull| DrawState { cull, ..state };
    bench(criterion, "setup_culled_one_way", count, &scene, &plain, culled(Cull::Front), Output::Depth);
    bench(criterion, "setup_culled_other_way", count, &scene, &plain, culled(Cull::Back), Output::Depth);
    bench(criterion, "coverage_small", count, &scene, &plain, state, Output::Depth);

    for (name, size, layers) in [("coverage_mid", 40.0, 8), ("coverage_large", 400.0, 64)] {
        let scene = triangles(size, layers);
        bench(criterion, name, scene.indices.len() as u64 / 3, &scene, &plain, state, Output::Depth);
    }

    let scene = triangles(400.0, 1);
    let lit = BlinnPhong { camera: Mat4::IDENTITY, eye: EYE, light: [0.4, 0.5, 0.768], shininess: 32.0 };
    bench(criterion, "shade_gouraud", pixels / 2, &scene, &plain, state, Output::Color);
    bench(criterion, "shade_blinn_phong", pixels / 2, &scene, &lit, state, Output::Color);
    bench(criterion, "encode_srgb", pixels / 2, &scene, &plain, state, Output::Srgb);
    let blended = DrawState { blend: Blend::ALPHA, ..state };
    bench(criterion, "blend", pixels / 2, &scene, &plain, blended, Output::Color);

    let scene = knot();
    let lit = BlinnPhong { camera: scene.camera, eye: EYE, light: [0.4, 0.5, 0.768], shininess: 32.0 };
    bench(criterion, "visibility_buffer", pixels, &scene, &lit, culled(Cull::Back), Output::Ids);
}

/// What the other ways to say which triangles there are cost beside a list of 32 bit indices, to the depth of the picture.
fn primitives(criterion: &mut Criterion) {
    let scene = micro();
    let shader = Gouraud { camera: scene.camera };
    let triangles = scene.indices.len() as u64 / 3;
    let rows = grid_strips(500, 1000);
    let strip = DrawState { topology: PrimitiveTopology::TriangleStrip, ..DrawState::default() };
    let mut one_row = rows.clone();
    one_row.retain(|&index| index != u32::MAX);
    let restarts = DrawState { primitive_restart: true, ..strip };
    let mut draw = |name: &str, triangles: u64, pass: &Pass<'_>| {
        let settings = Settings { threads: 1, ..Settings::default() };
        let mut renderer = Renderer::new(settings).expect("the default level is there");
        let mut depth = vec![0f32; (WIDTH * HEIGHT) as usize];
        let mut group = criterion.benchmark_group("primitives");
        group.sample_size(20).throughput(Throughput::Elements(triangles));
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let mut target = Target { depth: DepthBuffer::D32F(&mut depth), ..Target::new(WIDTH, HEIGHT) };
                renderer.render(pass, &mut target).expect("the scene is valid")
            });
        });
        group.finish();
    };
    for (name, indices, state) in [
        ("list", &scene.indices, DrawState::default()),
        ("strip_with_restarts", &rows, restarts),
        ("strip", &one_row, strip),
    ] {
        let mut pass = Pass::new();
        pass.draw(&shader, Mesh { vertices: &scene.vertices, indices: Indices::U32(indices) }, state);
        draw(name, triangles, &pass);
    }
    // As many vertices as 16 bits can name, in a list of as many triangles.
    let narrow: Vec<u16> = scene.indices.iter().map(|&index| (index % 65_000) as u16).collect();
    let wide: Vec<u32> = narrow.iter().map(|&index| u32::from(index)).collect();
    for (name, indices) in
        [("list_of_65000_vertices", Indices::U32(&wide)), ("list_of_65000_vertices_u16", Indices::U16(&narrow))]
    {
        let mut pass = Pass::new();
        let culled = DrawState { cull: Cull::Back, ..DrawState::default() };
        pass.draw(&shader, Mesh { vertices: &scene.vertices[..65_000], indices }, culled);
        draw(name, triangles, &pass);
    }
    // A million triangles, and half a million squares.
    let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [2.0, 2.0]];
    let places: Vec<[f32; 2]> = (0..1_000_000).map(|k| [(k % 1000 * 2) as f32, (k / 1000) as f32]).collect();
    let raster = DrawState { space: Space::Raster, ..DrawState::default() };
    let squares = DrawState { topology: PrimitiveTopology::TriangleStrip, ..raster };
    for (name, corners, places, state) in [
        ("instanced_triangles", &corners[..3], &places[..], raster),
        ("instanced_squares", &corners, &places[..500_000], squares),
    ] {
        let mut pass = Pass::new();
        pass.draw_instanced_with(
            Mesh { vertices: corners, indices: Indices::Sequential },
            places,
            state,
            |v| {
                let [x, y] = [0, 1].map(|k| v.vertex[k] + v.instance[k]);
                (Vec4::from([x, y, 0.5, 1.0]), Vec3::from([x, y, 0.0]))
            },
            |f| Rgba::opaque(f.varyings()),
        );
        draw(name, 1_000_000, &pass);
    }
    // The same triangles with a vertex buffer of three million.
    let all: Vec<[f32; 2]> =
        places.iter().flat_map(|&[x, y]| [0, 1, 2].map(|k| [x + corners[k][0], y + corners[k][1]])).collect();
    let mut pass = Pass::new();
    pass.draw_with(
        Mesh { vertices: &all, indices: Indices::Sequential },
        raster,
        |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), Vec3::from([x, y, 0.0])),
        |f| Rgba::opaque(f.varyings()),
    );
    draw("triangles_not_instanced", 1_000_000, &pass);
}

criterion_group!(benches, stages, primitives);
criterion_main!(benches);
