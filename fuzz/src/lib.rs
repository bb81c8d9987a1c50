//! What every reader promises, whatever the bytes.

use pineda_scene::{Bounds, Format, Framing, Limits, NoFiles, Normals, View, load_bytes, smooth_normals};

/// Small enough for thousands of runs a second.
const LIMITS: Limits =
    Limits { file_bytes: 1 << 20, vertices: 1 << 16, triangles: 1 << 16, expanded: 1 << 12, objects: 1 << 8, nesting: 32 };

/// Reads `bytes`: an error, or a scene that can be drawn.
pub fn read(format: Format, bytes: &[u8]) {
    let Ok(mut loaded) = load_bytes(bytes, format, &NoFiles, &LIMITS) else { return };
    for object in &mut loaded.scene.objects {
        assert!(object.material < loaded.scene.materials.len());
        if object.normals == Normals::Absent {
            smooth_normals(object, 40.0);
        }
        for &v in object.triangles.iter().flatten() {
            let vertex = &object.vertices[v as usize];
            assert!(vertex.position.iter().chain(&vertex.normal).chain(&vertex.color).all(|c| c.is_finite()));
        }
    }
    let bounds = Bounds::of(&loaded.scene).expect("a loaded scene has triangles");
    Framing::new(&bounds, &View::default()).expect("the default view sees every box");
}
