//! The models of `../shared/models`, where that folder is.

use std::path::{Path, PathBuf};

use pineda_scene::{Bounds, Framing, Object, View, load};

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

/// Without a word: what these files have is all there, and read.
#[test]
fn models_all_load_without_notes() {
    let Some(folder) = folder() else { return };
    let files = files(&folder);
    assert!(files.len() > 50);
    for path in files {
        let loaded = load(&path).unwrap();
        let scene = &loaded.scene;
        let framing = Framing::new(&Bounds::of(scene).unwrap(), &View::default()).unwrap();
        assert!(framing.eye.iter().all(|c| c.is_finite()), "{path:?}");
        for object in &scene.objects {
            assert!(object.material < scene.materials.len(), "{path:?}");
            assert!(object.indices().all(|v| (v as usize) < object.vertices.len()), "{path:?}");
            assert!(object.uvs.iter().all(|uvs| uvs.len() == object.vertices.len()), "{path:?}");
        }
        assert!(loaded.notes.is_empty(), "{path:?}: {:?}", loaded.notes);
    }
}

/// What the table says of textures, cameras, lights and points.
#[test]
fn models_have_what_the_table_says() {
    let Some(folder) = folder() else { return };
    let scene = |file: &str| load(folder.join(file)).unwrap().scene;
    let bottle = scene("WaterBottle/WaterBottle.gltf");
    assert!(bottle.images.len() == 4 && bottle.images.iter().all(|image| (image.width, image.height) == (2048, 2048)));
    assert_eq!(bottle.objects[0].tangents.len(), bottle.objects[0].vertices.len());
    let lamp = scene("LightsPunctualLamp/LightsPunctualLamp.gltf");
    assert_eq!((lamp.lights.len(), lamp.images.len()), (5, 7));
    assert!(lamp.materials.iter().any(|material| material.transmission.is_some()));
    let vase = scene("GlassVaseFlowers/GlassVaseFlowers.glb");
    assert!(vase.materials.iter().any(|material| material.volume.is_some()));
    assert_eq!(scene("Cameras/Cameras.gltf").cameras.len(), 2);
    assert_eq!(scene("TextureTransformTest/TextureTransformTest.gltf").images.len(), 5);
    let modes = scene("MeshPrimitiveModes/MeshPrimitiveModes.gltf");
    let sum = |count: fn(&Object) -> usize| modes.objects.iter().map(count).sum::<usize>();
    assert_eq!((sum(|o| o.points.len()), sum(|o| o.lines.len())), (7, 19));
    assert!(scene("extra/unlit.gltf").materials[0].unlit);
    let strengths = scene("EmissiveStrengthTest/EmissiveStrengthTest.glb");
    assert!(strengths.materials.iter().any(|material| material.emissive_strength == 16.0));
    assert_eq!(scene("spot/spot_textured.obj").images[0].width, 1024);
    assert_eq!(scene("trimesh-ply/points_ascii.ply").objects[0].points.len(), 5);
    assert!(!scene("trimesh-ply/cube_blender_uv.ply").objects[0].uvs.is_empty());
}

/// Each transform of the test model takes its mark, where the right answer is to be seen, to the arrow's tip.
#[test]
fn models_texture_transforms_point_at_their_marks() {
    let Some(folder) = folder() else { return };
    let scene = load(folder.join("TextureTransformTest/TextureTransformTest.gltf")).unwrap().scene;
    let object = |name: &str| scene.objects.iter().find(|object| &*object.name == name).unwrap();
    // The mark lies on the quad of half a unit to each side; v goes down.
    let at = |name: &str, x: f32, y: f32| {
        let transform = scene.materials[object(name).material].base_color_texture.unwrap().transform;
        let (u, v) = (x + 0.5, 0.5 - y);
        transform.map(|[a, b, c]| a * u + b * v + c)
    };
    for (name, x, y) in [("Rotation", -0.079_048_224, -0.516_267_5), ("Scale", 0.018_544_973, -0.018_544_973)] {
        let [u, v] = at(name, x, y);
        assert!((u - v).abs() < 1e-6 && (0.7..0.8).contains(&u), "{name}: {u} {v}");
    }
    let [u, v] = at("All", -0.07, -0.25);
    assert!((u - 0.77).abs() < 0.05 && (v - 0.77).abs() < 0.05, "{u} {v}");
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
