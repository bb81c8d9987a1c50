//! What every reader promises, whatever the bytes.

use pineda_scene::{Bounds, Format, Framing, Limits, Loaded, Model, NoFiles, Normals, Pose, View, smooth_normals};

/// Small enough for thousands of runs a second.
const LIMITS: Limits = Limits {
    file_bytes: 1 << 20,
    vertices: 1 << 16,
    triangles: 1 << 16,
    expanded: 1 << 12,
    objects: 1 << 8,
    nesting: 32,
    image_pixels: 1 << 14,
    pixels: 1 << 15,
    expanded_pixels: 1 << 14,
};

/// Reads `bytes`: an error, or scenes that can be drawn, as stored and in the middle of the first animation.
pub fn read(format: Format, bytes: &[u8]) {
    let Ok(model) = Model::from_bytes(bytes, format, &NoFiles, &LIMITS) else { return };
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
