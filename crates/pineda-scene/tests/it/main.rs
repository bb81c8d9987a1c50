//! Tests through the public interface: files in code for each feature and each error, the models beside the
//! repository, and inputs that are damaged on purpose.

mod damaged;
mod gltf;
mod gltf_errors;
mod gltf_extensions;
mod gltf_file;
mod gltf_materials;
mod gltf_pose;
mod images;
mod models;
mod normals;
mod obj;
mod ply;
mod scene;
mod stl;
mod threemf;

use pineda_scene::{Error, Format, Limits, Loaded, NoFiles, Object, load_bytes};

/// Loads a model that is whole in itself.
fn read(format: Format, bytes: impl AsRef<[u8]>) -> Result<Loaded, Error> {
    load_bytes(bytes.as_ref(), format, &NoFiles, &Limits::default())
}

/// The one object of a file that has one.
fn only(loaded: &Loaded) -> &Object {
    assert_eq!(loaded.scene.objects.len(), 1);
    &loaded.scene.objects[0]
}

fn positions(object: &Object) -> Vec<[f32; 3]> {
    object.vertices.iter().map(|v| v.position).collect()
}

/// Each triangle's corners' positions.
fn corners(object: &Object) -> Vec<[[f32; 3]; 3]> {
    object.triangles.iter().map(|t| t.map(|v| object.vertices[v as usize].position)).collect()
}

/// The error must say all of this.
#[track_caller]
fn fails(format: Format, bytes: impl AsRef<[u8]>, says: &[&str]) {
    let error = read(format, bytes).expect_err("should fail").to_string();
    for part in says {
        assert!(error.contains(part), "'{part}' is not in: {error}");
    }
    assert!(!error.contains('\n') && error.len() < 400, "not one readable line: {error}");
}
