use pineda_scene::{Bounds, Error, Format, Framing, Limits, View, load, load_with};

use crate::read;

#[test]
fn bounds_are_of_vertices_that_triangles_name() {
    let loaded = read(Format::Obj, "v 0 0 0\nv 1 0 0\nv 1 2 -3\nv 99 99 99\nv nan 0 0\nf 1 2 3\nf 1 2 5\n").unwrap();
    let bounds = Bounds::of(&loaded.scene).unwrap();
    assert_eq!(bounds, Bounds { min: [0.0, 0.0, -3.0], max: [1.0, 2.0, 0.0] });
    assert_eq!(bounds.center(), [0.5, 1.0, -1.5]);
    assert_eq!(bounds.radius(), 14f64.sqrt() / 2.0);
}

#[test]
fn bounds_of_nothing() {
    assert_eq!(Bounds::of(&pineda_scene::Scene::default()), None);
}

#[test]
fn framing_of_a_loaded_scene_holds_every_vertex() {
    let scene = pineda_scene::demo();
    let bounds = Bounds::of(&scene).unwrap();
    let framing = Framing::new(&bounds, &View::default()).unwrap();
    let sub = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let axis = sub(framing.target, framing.eye);
    let distance = dot(axis, axis).sqrt();
    for vertex in scene.objects.iter().flat_map(|o| &o.vertices) {
        let from_eye = sub(vertex.position.map(f64::from), framing.eye);
        let depth = dot(from_eye, axis) / distance;
        assert!(framing.near < depth && depth < framing.far);
        let off_axis = (dot(from_eye, from_eye) - depth * depth).max(0.0).sqrt();
        assert!(off_axis / depth < libm::tan(20f64.to_radians()));
    }
}

#[test]
fn load_errors_name_the_file() {
    let folder = env!("CARGO_MANIFEST_DIR");
    let missing = load(format!("{folder}/missing.obj")).unwrap_err();
    assert!(missing.to_string().contains("missing.obj: cannot be read"), "{missing}");
    let is_folder = load(folder).unwrap_err().to_string();
    assert!(is_folder.contains("cannot be read"), "{is_folder}");
    let unknown = load(format!("{folder}/Cargo.toml")).unwrap_err().to_string();
    assert!(unknown.contains("Cargo.toml: is of no known format"), "{unknown}");
    let limits = Limits { file_bytes: 10, ..Limits::default() };
    let large = load_with(format!("{folder}/Cargo.toml"), &limits).unwrap_err();
    let Error::File { error, .. } = &large else { panic!("{large}") };
    assert!(matches!(**error, Error::Limit { field: "Limits::file_bytes", .. }), "{large}");
}
