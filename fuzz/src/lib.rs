//! What every reader promises, whatever the bytes.

use pineda_scene::{Bounds, Format, Framing, Limits, NoFiles, Normals, View, load_bytes, smooth_normals};

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

/// Reads `bytes`: an error, or a scene that can be drawn.
pub fn read(format: Format, bytes: &[u8]) {
    let Ok(mut loaded) = load_bytes(bytes, format, &NoFiles, &LIMITS) else { return };
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
    }
    let bounds = Bounds::of(&loaded.scene).expect("a loaded scene is not empty");
    Framing::new(&bounds, &View::default()).expect("the default view sees every box");
}
