//! The models of `../shared/models`, where that folder is.

use std::path::{Path, PathBuf};

use pineda_scene::{Bounds, Framing, View, load};

/// `None`, with a word about it, where the models are not.
pub(crate) fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models");
    if !folder.is_dir() {
        println!("skipped: no models in ../shared/models");
        return None;
    }
    Some(folder)
}

/// All model files, in order.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if pineda_scene::Format::from_extension(&path).is_some() {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// The table's rows: file, and triangles where the row gives them.
fn table(folder: &Path) -> Vec<(String, Option<usize>)> {
    let readme = std::fs::read_to_string(folder.join("README.md")).unwrap();
    let rows = readme.lines().filter_map(|line| line.strip_prefix("| `"));
    rows.map(|row| {
        let (file, rest) = row.split_once('`').unwrap();
        let words: Vec<&str> = rest.split_whitespace().collect();
        let count = words.windows(2).find(|w| w[1] == "tris;" || w[1] == "tris").and_then(|w| w[0].parse().ok());
        (file.to_owned(), count)
    })
    .collect()
}

/// The table counts each mesh of a file once, whatever scene shows it and how often.
const SHOWN_DIFFERENTLY: [(&str, usize); 3] = [
    ("MultipleScenes/MultipleScenes.gltf", 2),
    ("TextureTransformTest/TextureTransformTest.gltf", 24),
    ("GlassVaseFlowers/GlassVaseFlowers.glb", 14036),
];

#[test]
fn models_all_load_or_say_why_not() {
    let Some(folder) = folder() else { return };
    let files = files(&folder);
    assert!(files.len() > 50);
    for path in files {
        match load(&path) {
            Ok(loaded) => {
                let bounds = Bounds::of(&loaded.scene).unwrap();
                let framing = Framing::new(&bounds, &View::default()).unwrap();
                assert!(framing.eye.iter().all(|c| c.is_finite()), "{path:?}");
                for object in &loaded.scene.objects {
                    assert!(object.material < loaded.scene.materials.len(), "{path:?}");
                    assert!(
                        object.triangles.iter().flatten().all(|&v| (v as usize) < object.vertices.len()),
                        "{path:?}"
                    );
                }
                assert!(loaded.notes.iter().all(|note| !note.contains('\n')), "{path:?}");
            }
            Err(error) => {
                assert!(path.ends_with("points_ascii.ply"), "{error}");
                assert!(
                    error.to_string().ends_with("has nothing to draw (points are not drawn: 5 vertices)"),
                    "{error}"
                );
            }
        }
    }
}

#[test]
fn models_have_the_table_s_triangles() {
    let Some(folder) = folder() else { return };
    let mut compared = 0;
    for (file, count) in table(&folder) {
        let Some(count) = count else { continue };
        let expected = SHOWN_DIFFERENTLY.iter().find(|(name, _)| *name == file).map_or(count, |(_, shown)| *shown);
        let loaded = load(folder.join(&file)).unwrap();
        let triangles: usize = loaded.scene.objects.iter().map(|o| o.triangles.len()).sum();
        assert_eq!(triangles, expected, "{file}");
        compared += 1;
    }
    assert!(compared >= 20, "the table has changed: {compared} rows with triangles");
}

/// The same cow as OBJ with triangles, with quads, as STL and as PLY.
#[test]
fn models_of_one_shape_in_several_formats_are_equal() {
    let Some(folder) = folder() else { return };
    let bounds = |file: &str| Bounds::of(&load(folder.join(file)).unwrap().scene).unwrap();
    let expected = bounds("spot/spot_triangulated.obj");
    for file in ["spot/spot_quadrangulated.obj", "spot/spot_textured.obj", "extra/spot_binary.stl"] {
        assert_eq!(bounds(file), expected, "{file}");
    }
    // Printed with six digits.
    let printed = bounds("extra/spot_ascii_normals_colours.ply");
    for axis in 0..3 {
        assert!((printed.min[axis] - expected.min[axis]).abs() < 1e-5);
    }
}
