//! `pineda info`.

use crate::models::Squares;
use crate::workspace::Workspace;
use serde_json::{Value, json};

fn model(name: &str) -> Workspace {
    let folder = Workspace::new(name);
    let more = r#""animations": [{"name": "aside", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
        "samplers": [{"input": 2, "output": 3}]}],"#;
    let glass = r#"{"name": "glass", "alphaMode": "BLEND", "doubleSided": true}"#;
    Squares { more, materials: [glass, "{}"], ..Squares::default() }.write(&folder, "a");
    folder
}

#[test]
fn info_for_programs() {
    let folder = model("info-json");
    let run = folder.run(&["info", "a.gltf", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let info: Value = serde_json::from_str(&run.stdout).unwrap();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    assert_eq!([&info["file"], &info["format"]].map(text), ["a.gltf", "glTF"]);
    assert_eq!(info["scenes"], json!(["both", "second"]));
    assert_eq!(["objects", "triangles"].map(|what| info["counts"][what].as_u64().unwrap()), [2, 4]);
    assert_eq!(info["bounds"], json!([[-1.0, -1.0, 0.0], [1.0, 1.0, 0.5]]));
    assert_eq!([&info["materials"][0]["name"], &info["materials"][0]["alpha"]].map(text), ["glass", "blend"]);
    assert_eq!(info["animations"], json!([{"name": "aside", "seconds": 2.0}]));
    assert_eq!([&info["cameras"][0]["name"], &info["cameras"][0]["kind"]].map(text), ["front", "orthographic"]);
    assert_eq!(info["cameras"][0]["eye"], json!([0.0, 0.0, 5.0]));
}

#[test]
fn info_for_people() {
    let folder = model("info-text");
    let run = folder.run(&["info", "a.gltf"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for part in [
        "a.gltf, glTF",
        "4 triangles",
        "2 x 2 x 0.5, from (-1, -1, 0) to (1, 1, 0.5)",
        "scenes\n  0 both (shown)\n  1 second",
        "0 glass: blend, double sided",
        "animations\n  0 aside: 2 s",
        "0 front: orthographic, at (0, 0, 5)",
    ] {
        assert!(run.stdout.contains(part), "no {part:?} in {}", run.stdout);
    }
    folder.write("b.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let run = folder.run(&["info", "b.obj"]);
    assert!(run.stdout.contains("b.obj, OBJ\n  1 object\n  1 triangle\n  3 vertices"), "{}", run.stdout);
    assert!(run.stdout.contains("note: ") && run.stdout.contains("gone.mtl"), "{}", run.stdout);
}

#[test]
fn info_errors() {
    let folder = Workspace::new("info-errors");
    folder.fail(&["info", "missing.obj"], 1, &["cannot be read", "where: missing.obj"]);
    folder.write("empty.obj", "");
    folder.fail(&["info", "empty.obj"], 1, &["nothing to draw", "where: empty.obj"]);
    folder.fail(&["info"], 2, &["MODEL"]);
}
