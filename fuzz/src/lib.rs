//! What every reader promises, whatever the bytes.

mod glb;
mod zipped;

// The command line is a program that nobody can depend on, so its own readers are compiled in from there.
#[allow(dead_code, reason = "the command line's")]
#[path = "../../apps/cli/src/failure.rs"]
mod failure;
#[path = "../../apps/cli/src/panorama.rs"]
mod panorama;
#[allow(dead_code, reason = "the command line's")]
#[path = "../../apps/cli/src/raster/file.rs"]
mod raster_file;
#[allow(dead_code, reason = "the command line's")]
#[path = "../../apps/cli/src/values.rs"]
mod values;

pub use glb::glb;
pub use zipped::zipped;

use pineda::{Compare, DepthState, DrawState, Indices, Mesh, Pass, Renderer, Rgba, Target, Vec4};
use pineda_scene::{
    Bounds, Format, Framing, Limits, Loaded, Model, NoFiles, Normals, Pose, Resolver, View, smooth_normals,
};
use std::io;

/// Small enough for thousands of runs a second.
const LIMITS: Limits = Limits {
    file_bytes: 1 << 20,
    vertices: 1 << 16,
    triangles: 1 << 16,
    expanded: 1 << 12,
    objects: 1 << 8,
    nesting: 32,
    inflated: 1 << 16,
    image_pixels: 1 << 14,
    pixels: 1 << 15,
    expanded_pixels: 1 << 14,
};

/// Reads `bytes`: an error, or scenes that can be drawn, as stored and in the middle of the first animation.
pub fn read(format: Format, bytes: &[u8]) {
    read_with(format, bytes, &NoFiles);
}

fn read_with(format: Format, bytes: &[u8], files: &dyn Resolver) {
    let Ok(model) = Model::from_bytes(bytes, format, files, &LIMITS) else { return };
    let moving = model.contents().animations.first().map(|animation| Pose {
        animation: Some(0.into()),
        time: animation.duration / 2.0,
        ..Pose::default()
    });
    for pose in [Some(Pose::default()), moving].into_iter().flatten() {
        if let Ok(loaded) = model.scene(&pose) {
            check(loaded);
        }
    }
}

fn check(mut loaded: Loaded) {
    for object in &mut loaded.scene.objects {
        assert!(object.material < loaded.scene.materials.len());
        if object.normals == Normals::Absent {
            smooth_normals(object, 40.0);
        }
        for v in object.indices() {
            let vertex = &object.vertices[v as usize];
            assert!(vertex.position.iter().chain(&vertex.normal).chain(&vertex.color).all(|c| c.is_finite()));
        }
        assert!(object.uvs.iter().all(|uvs| uvs.len() == object.vertices.len()));
        assert!(object.tangents.is_empty() || object.tangents.len() == object.vertices.len());
    }
    let scene = &loaded.scene;
    for reference in scene.materials.iter().flat_map(|material| material.textures()) {
        assert!(scene.textures[reference.texture].image < scene.images.len());
    }
    let bounds = Bounds::of(scene).expect("a loaded scene is not empty");
    Framing::new(&bounds, &View::default()).expect("the default view sees every box");
}

/// Reads `bytes` as an MTL file, that an OBJ file names whose faces have the materials `a` and `b`.
pub fn mtl(bytes: &[u8]) {
    const OBJ: &[u8] = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 3 2 1\n";
    let files = |path: &str, _: u64| match path {
        "a.mtl" => Ok(bytes.to_vec()),
        "a.png" => Ok(PIXEL.to_vec()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    read_with(Format::Obj, OBJ, &files);
}

/// A white pixel as PNG.
const PIXEL: &[u8] = include_bytes!("pixel.png");

/// Reads `bytes` as the file of `pineda raster`, and draws what it describes if that is small.
pub fn raster(bytes: &[u8]) {
    let Ok(drawing) = raster_file::parse(bytes) else { return };
    assert!(drawing.triangles.as_flattened().iter().all(|&v| (v as usize) < drawing.vertices.len()));
    assert!(drawing.vertices.iter().all(|vertex| vertex.position.iter().all(|c| c.is_finite())));
    if drawing.size.pixels() > 1 << 12 {
        return;
    }
    let compare = if drawing.depth_test { Compare::Less } else { Compare::Always };
    let state = DrawState {
        space: drawing.space,
        cull: drawing.cull,
        front_face: drawing.front_face,
        depth: DepthState { compare, write: true },
        ..DrawState::default()
    };
    let mut pass = Pass::new();
    pass.draw_with(
        Mesh { vertices: &drawing.vertices, indices: Indices::U32(drawing.triangles.as_flattened()) },
        state,
        |vertex: &raster_file::Vertex| (Vec4::from(vertex.position), Rgba::from(vertex.color)),
        |f| f.varyings(),
    );
    let mut colors = vec![[0; 4]; drawing.size.pixels()];
    let target = Target::new(drawing.size.width, drawing.size.height);
    let mut target = Target { color: pineda::ColorBuffer::Rgba8(&mut colors), ..target };
    let settings = pineda::Settings { threads: 1, ..Default::default() };
    let mut renderer = Renderer::new(settings).expect("settings that are always possible");
    renderer.render(&pass, &mut target).expect("a drawing that was read can be drawn");
}

/// Reads `bytes` as a panorama.
pub fn panorama(bytes: &[u8]) {
    if let Ok((width, height, pixels)) = panorama::read(bytes) {
        assert_eq!(3 * width as usize * height as usize, pixels.len());
    }
}
