//! Skins, morph targets, animations, scenes, cameras and lights: positions against answers that are closed.

use pineda_scene::{
    Error, Format, LightKind, Limits, Loaded, Model, NoFiles, Pose, Projection, Scene, Select, load_bytes,
};
use serde_json::{Value, json};

use crate::gltf_file::{File, push};
use crate::{models, only, positions};

fn model(file: &File) -> Model {
    Model::from_bytes(file.text().as_bytes(), Format::Gltf, &NoFiles, &Limits::default()).unwrap()
}

fn at(model: &Model, time: f64) -> Loaded {
    model.scene(&Pose { animation: Some(0.into()), time, ..Pose::default() }).unwrap()
}

/// The first vertex' position at a time.
fn first_at(model: &Model, time: f64) -> [f32; 3] {
    only(&at(model, time).clone()).vertices[0].position
}

/// A triangle whose corners follow joint 0, joint 1, and both by halves; node 0 has the mesh, 1 and 2 are the joints.
fn skinned() -> File {
    let mut file = File::triangle();
    let joints = file.accessor(&[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0], 5121, "VEC4", 3);
    let weights = file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0]);
    file.attribute("JOINTS_0", joints);
    file.attribute("WEIGHTS_0", weights);
    file.json["nodes"] = json!([{"mesh": 0, "skin": 0}, {"translation": [10, 0, 0]}, {"translation": [0, 20, 0]}]);
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    file.json["skins"] = json!([{"joints": [1, 2]}]);
    file
}

#[test]
fn gltf_skin_moves_vertices_with_their_joints() {
    let mut file = skinned();
    let expected = [[10.0, 0.0, 0.0], [1.0, 20.0, 0.0], [5.0, 11.0, 0.0]];
    assert_eq!(positions(only(&file.loaded())), expected);
    // The mesh's own node does not count, wherever it is.
    file.node()["translation"] = json!([100, 200, 300]);
    file.node()["scale"] = json!([-3, 2, 1]);
    assert_eq!(positions(only(&file.loaded())), expected);
    // Nor need the joints be in the scene, and their parents count.
    file.json["scenes"][0]["nodes"] = json!([0]);
    push(&mut file.json["nodes"], json!({"children": [1, 2], "translation": [0, 0, 7]}));
    assert_eq!(positions(only(&file.loaded())), expected.map(|[x, y, _]| [x, y, 7.0]));
}

#[test]
fn gltf_skin_with_inverse_bind_matrices() {
    let mut file = skinned();
    // Joint 0 was bound at x = 10: the vertex stays. Joint 1 was bound at the origin and twice the size.
    let matrices = file.floats(
        "MAT4",
        &[
            [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -10.0, 0.0, 0.0, 1.0],
            [0.5, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 1.0],
        ]
        .concat(),
    );
    file.json["skins"][0]["inverseBindMatrices"] = json!(matrices);
    assert_eq!(positions(only(&file.loaded())), [[0.0; 3], [0.5, 20.0, 0.0], [0.0, 10.75, 0.0]]);
    file.json["accessors"][matrices]["count"] = json!(1);
    file.fails(&["skin 0", "2 joints need as many inverse bind matrices"]);
}

#[test]
fn gltf_skin_weights_of_all_types_and_sums() {
    let with_weights = |component: u32, bytes: &[u8]| {
        let mut file = skinned();
        let weights = file.accessor(bytes, component, "VEC4", 3);
        file.attribute("WEIGHTS_0", weights);
        positions(only(&file.loaded()))
    };
    let expected = [[10.0, 0.0, 0.0], [1.0, 20.0, 0.0], [5.0, 11.0, 0.0]];
    assert_eq!(with_weights(5121, &[255, 0, 0, 0, 255, 0, 0, 0, 100, 100, 0, 0]), expected);
    let shorts: Vec<u8> =
        [65535u16, 0, 0, 0, 65535, 0, 0, 0, 9, 9, 0, 0].iter().flat_map(|n| n.to_le_bytes()).collect();
    assert_eq!(with_weights(5123, &shorts), expected);
    let floats: Vec<u8> =
        [2f32, 0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 4.0, 4.0, 0.0, 0.0].iter().flat_map(|n| n.to_le_bytes()).collect();
    assert_eq!(with_weights(5126, &floats), expected);
    // Without any weight: the first joint.
    assert_eq!(with_weights(5121, &[0; 12]), [[10.0, 0.0, 0.0], [11.0, 0.0, 0.0], [10.0, 1.0, 0.0]]);
}

#[test]
fn gltf_skin_of_eight_influences() {
    let mut file = File::triangle();
    for (set, joints) in [("0", [0, 1, 2, 3]), ("1", [4, 5, 6, 7])] {
        let accessor = file.accessor(&joints.repeat(3), 5121, "VEC4", 3);
        file.attribute(&format!("JOINTS_{set}"), accessor);
        let accessor = file.floats("VEC4", &[0.125; 12]);
        file.attribute(&format!("WEIGHTS_{set}"), accessor);
    }
    let joints: Vec<Value> = (0..8).map(|joint| json!({"translation": [1 << joint, 0, 0]})).collect();
    file.json["nodes"] = json!([vec![json!({"mesh": 0, "skin": 0})], joints].concat());
    file.json["skins"] = json!([{"joints": [1, 2, 3, 4, 5, 6, 7, 8]}]);
    assert_eq!(positions(only(&file.loaded()))[0], [255.0 / 8.0, 0.0, 0.0]);
}

#[test]
fn gltf_skin_turns_normals_and_mirrored_faces() {
    let mut file = skinned();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    file.attribute("NORMAL", normals);
    let of = |file: &File| {
        let loaded = file.loaded();
        (only(&loaded).vertices[0].normal, only(&loaded).triangles[0])
    };
    assert_eq!(of(&file), ([0.0, 0.0, 1.0], [0, 1, 2]));
    // A quarter turn about x takes z to -y.
    file.json["nodes"][1]["rotation"] = json!([1, 0, 0, 1]);
    assert_eq!(of(&file).0, [0.0, -1.0, 0.0]);
    for joint in [1, 2] {
        file.json["nodes"][joint] = json!({"scale": [1, 1, -2]});
    }
    assert_eq!(of(&file), ([0.0, 0.0, -1.0], [0, 2, 1]));
}

#[test]
fn gltf_skin_errors() {
    let mut file = skinned();
    file.json["skins"][0]["joints"] = json!([1]);
    file.fails(&["mesh 0, primitive 0", "joint 1, but its skin has only 1"]);
    file.json["skins"][0]["joints"] = json!([1, 9]);
    file.fails(&["skin 0", "joint, node 9, does not exist"]);
    file.json["skins"] = json!([]);
    file.fails(&["skin 0", "does not exist"]);
    // Joints that are their own ancestors.
    let mut file = skinned();
    file.json["scenes"][0]["nodes"] = json!([0]);
    file.json["nodes"][1] = json!({"children": [2]});
    file.json["nodes"][2] = json!({"children": [1]});
    file.fails(&["Limits::nesting"]);
}

/// Two targets for all attributes of a triangle.
fn morphing() -> File {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    let tangents = file.floats("VEC4", &[1.0, 0.0, 0.0, -1.0].repeat(3));
    let uvs = file.floats("VEC2", &[0.5, 0.5].repeat(3));
    let colors = file.accessor(&[51; 9], 5121, "VEC3", 3);
    for (name, accessor) in [("NORMAL", normals), ("TANGENT", tangents), ("TEXCOORD_0", uvs), ("COLOR_0", colors)] {
        file.attribute(name, accessor);
    }
    let up = file.floats("VEC3", &[0.0, 0.0, 2.0].repeat(3));
    let right = file.floats("VEC3", &[4.0, 0.0, 0.0].repeat(3));
    let less = file.floats("VEC3", &[0.0, 0.0, -2.0].repeat(3));
    let turn = file.floats("VEC3", &[-1.0, 1.0, 0.0].repeat(3));
    let shift = file.floats("VEC2", &[0.25, -0.5].repeat(3));
    let brighter = file.floats("VEC3", &[0.4, 4.0, -4.0].repeat(3));
    file.primitive()["targets"] = json!([
        {"POSITION": up, "NORMAL": less, "TANGENT": turn, "TEXCOORD_0": shift, "COLOR_0": brighter},
        {"POSITION": right},
    ]);
    file
}

#[test]
fn gltf_morph_targets_of_all_attributes() {
    let mut file = morphing();
    let at_rest = only(&file.loaded()).clone();
    assert_eq!(at_rest.vertices[1].position, [1.0, 0.0, 0.0]);
    file.json["meshes"][0]["weights"] = json!([1, 0.5]);
    let loaded = file.loaded();
    let object = only(&loaded);
    assert_eq!(object.vertices[1].position, [3.0, 0.0, 2.0]);
    assert_eq!(object.vertices[1].normal, [0.0, 0.0, -1.0]);
    assert_eq!(object.tangents[1], [0.0, 1.0, 0.0, -1.0]);
    assert_eq!(object.uvs[0][1], [0.75, 0.0]);
    // Clamped, and 0.2 + 0.4 in double precision, rounded once.
    assert_eq!(object.vertices[1].color, [(0.2 + f64::from(0.4f32)) as f32, 1.0, 0.0, 1.0]);
    // A node's weights come before the mesh's; too many or too few are no error.
    file.node()["weights"] = json!([0, 0.25, 7]);
    assert_eq!(only(&file.loaded()).vertices[1].position, [2.0, 0.0, 0.0]);
    file.node()["weights"] = json!([]);
    assert_eq!(only(&file.loaded()), &at_rest);
}

#[test]
fn gltf_morph_errors_and_bombs() {
    let mut file = morphing();
    let few = file.floats("VEC3", &[0.0; 6]);
    file.json["meshes"][0]["weights"] = json!([1]);
    file.primitive()["targets"][0]["POSITION"] = json!(few);
    file.fails(&["2 elements in POSITION, but 3 in POSITION"]);
    file.primitive()["targets"][0]["POSITION"] = json!(0);
    file.primitive()["targets"][0]["NORMAL"] = json!(99);
    file.fails(&["NORMAL, accessor 99", "does not exist"]);
    // Very many targets of one accessor: time, not memory.
    let mut file = File::new();
    let positions = file.floats("VEC3", &[0.5; 30_000]);
    file.attribute("POSITION", positions);
    file.primitive()["targets"] = json!(vec![json!({"POSITION": positions}); 100_000]);
    file.json["meshes"][0]["weights"] = json!(vec![1; 100_000]);
    let loaded = load_bytes(file.text().as_bytes(), Format::Gltf, &NoFiles, &Limits::default());
    assert!(matches!(loaded, Err(Error::Limit { field: "Limits::expanded", .. })), "{loaded:?}");
}

/// A triangle with an animation of one channel: keys at 1, 2 and 4 seconds.
fn animated(path: &str, interpolation: &str, kind: &str, values: &[f32]) -> File {
    let mut file = morphing();
    let input = file.floats("SCALAR", &[1.0, 2.0, 4.0]);
    let output = file.floats(kind, values);
    file.json["animations"] = json!([{
        "name": "move",
        "samplers": [{"input": input, "output": output, "interpolation": interpolation}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": path}}],
    }]);
    file
}

#[test]
fn gltf_animation_steps() {
    let file = animated("translation", "STEP", "VEC3", &[1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0, 0.0, 0.0]);
    let model = model(&file);
    let animations = &model.contents().animations;
    assert_eq!((&*animations[0].name, animations[0].duration), ("move", 4.0));
    let x = |time: f64| first_at(&model, time)[0];
    assert_eq!([0.0, 1.0, 1.9, 2.0, 3.9, 4.0, 9.0].map(x), [1.0, 1.0, 1.0, 2.0, 2.0, 4.0, 4.0]);
    assert_eq!([f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(x).map(|x| x > 0.0), [true; 3]);
    // As stored without the animation.
    assert_eq!(only(&model.scene(&Pose::default()).unwrap()).vertices[0].position, [0.0; 3]);
}

#[test]
fn gltf_animation_of_lines() {
    let model = model(&animated("translation", "LINEAR", "VEC3", &[1.0, 0.0, 0.0, 2.0, 8.0, 0.0, 4.0, 0.0, 0.0]));
    let of = |time: f64| first_at(&model, time);
    assert_eq!(of(0.0), [1.0, 0.0, 0.0]);
    assert_eq!(of(1.25), [1.25, 2.0, 0.0]);
    assert_eq!(of(2.0), [2.0, 8.0, 0.0]);
    assert_eq!(of(3.5), [3.5, 2.0, 0.0]);
    assert_eq!(of(99.0), [4.0, 0.0, 0.0]);
    // Nothing said is linear.
    let scale = [1.0, 1.0, 1.0, 3.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    let mut file = animated("scale", "LINEAR", "VEC3", &scale);
    file.json["animations"][0]["samplers"][0].as_object_mut().unwrap().remove("interpolation");
    let model = self::model(&file);
    assert_eq!(only(&at(&model, 1.5)).vertices[1].position, [2.0, 0.0, 0.0]);
}

#[test]
fn gltf_animation_of_cubic_splines() {
    // Tangent in, value, tangent out, for each key. Flat tangents make a smooth step; a tangent of the line's own slope
    // makes a line.
    let flat = [[0.0; 9], [0.0, 0.0, 0.0, 8.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 9]].concat();
    let smooth = model(&animated("translation", "CUBICSPLINE", "VEC3", &flat));
    let x = |time: f64| first_at(&smooth, time)[0];
    assert_eq!([0.0, 1.0, 1.25, 1.5, 1.75, 2.0, 3.0, 4.0].map(x), [0.0, 0.0, 1.25, 4.0, 6.75, 8.0, 4.0, 0.0]);
    let slopes = [
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 0.0],
        [3.0, 0.0, 0.0, 4.0, 0.0, 0.0, -2.0, 0.0, 0.0],
        [-2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ]
    .concat();
    let straight = model(&animated("translation", "CUBICSPLINE", "VEC3", &slopes));
    let x = |time: f64| first_at(&straight, time)[0];
    // Tangents are per second: the second span is two seconds long.
    assert_eq!([1.25, 1.5, 2.5, 3.0, 3.5].map(x), [1.75, 2.5, 3.0, 2.0, 1.0]);
}

#[test]
fn gltf_animation_of_rotations_takes_the_shorter_way() {
    // About z: 0, then 90 degrees as its own negative, then 180 degrees.
    let half = 0.5f32.sqrt();
    let turns = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -half, -half, 0.0, 0.0, 1.0, 0.0];
    let model = model(&animated("rotation", "LINEAR", "VEC4", &turns));
    let of = |time: f64| only(&at(&model, time)).vertices[1].position;
    for (time, degrees) in [(0.0, 0.0f64), (1.0, 0.0), (1.5, 45.0), (1.0 + 1.0 / 3.0, 30.0), (2.0, 90.0), (3.0, 135.0)]
    {
        let [x, y, z] = of(time);
        let (sin, cos) = (degrees.to_radians().sin(), degrees.to_radians().cos());
        assert!((f64::from(x) - cos).abs() < 1e-7 && (f64::from(y) - sin).abs() < 1e-7 && z == 0.0, "{time}: {x} {y}");
    }
    // The same twice is no division by zero.
    let model = self::model(&animated("rotation", "LINEAR", "VEC4", &[0.0, 0.0, 0.0, 1.0].repeat(3)));
    assert_eq!(only(&at(&model, 1.3)).vertices[1].position, [1.0, 0.0, 0.0]);
}

#[test]
fn gltf_animation_of_normalized_integers() {
    let mut file = animated("rotation", "STEP", "VEC4", &[0.0, 0.0, 0.0, 1.0].repeat(3));
    let turns = file.accessor(&[0, 0, 0, 127, 0, 0, 90, 90, 0, 0, 127, 0], 5120, "VEC4", 3);
    file.json["accessors"][turns]["normalized"] = json!(true);
    file.json["animations"][0]["samplers"][0]["output"] = json!(turns);
    assert_eq!(only(&at(&model(&file), 2.0)).vertices[1].position, [0.0, 1.0, 0.0]);
}

#[test]
fn gltf_animation_of_weights() {
    let x = |file: &File, time: f64| {
        let position = only(&at(&model(file), time)).vertices[0].position;
        [position[0], position[2]]
    };
    // Two weights for each key; the first target moves along z by 2, the second along x by 4.
    let linear = animated("weights", "LINEAR", "SCALAR", &[0.0, 1.0, 1.0, 0.0, 0.0, 0.5]);
    assert_eq!(
        [0.0, 1.25, 2.0, 3.0, 5.0].map(|t| x(&linear, t)),
        [[4.0, 0.0], [3.0, 0.5], [0.0, 2.0], [1.0, 1.0], [2.0, 0.0]]
    );
    let step = animated("weights", "STEP", "SCALAR", &[0.0, 1.0, 1.0, 0.0, 0.0, 0.5]);
    assert_eq!(x(&step, 1.9), [4.0, 0.0]);
    // Of a spline: both tangents in, both values, both tangents out.
    let spline = animated(
        "weights",
        "CUBICSPLINE",
        "SCALAR",
        &[[0.0, 0.0, 0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0, 0.0], [0.0; 6]].concat(),
    );
    assert_eq!([1.0, 1.5, 2.0].map(|t| x(&spline, t)), [[4.0, 0.0], [2.0, 1.0], [0.0, 2.0]]);
}

#[test]
fn gltf_animation_of_a_node_with_a_matrix_replaces_it() {
    let mut file = animated("translation", "STEP", "VEC3", &[5.0, 0.0, 0.0].repeat(3));
    file.node()["matrix"] = json!([2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 9, 1]);
    let model = model(&file);
    assert_eq!(only(&model.scene(&Pose::default()).unwrap()).vertices[1].position, [2.0, 0.0, 9.0]);
    assert_eq!(only(&at(&model, 1.0)).vertices[1].position, [6.0, 0.0, 0.0]);
}

#[test]
fn gltf_animation_errors() {
    let fails = |change: &dyn Fn(&mut Value), says: &str| {
        let mut file = animated("translation", "LINEAR", "VEC3", &[0.0; 9]);
        change(&mut file.json);
        let model = model(&file);
        // Only for who asks for it.
        model.scene(&Pose::default()).unwrap();
        let pose = Pose { animation: Some("move".into()), ..Pose::default() };
        let error = model.scene(&pose).unwrap_err().to_string();
        assert!(error.contains("animation 0, channel 0") && error.contains(says), "{error}");
    };
    let (channel, sampler) = ("/animations/0/channels/0", "/animations/0/samplers/0");
    let set = |json: &mut Value, pointer: &str, value: Value| *json.pointer_mut(pointer).unwrap() = value;
    fails(&|json| set(json, &format!("{channel}/sampler"), json!(3)), "sampler 3 does not exist");
    fails(&|json| set(json, &format!("{channel}/target/node"), json!(3)), "node 3 does not exist");
    fails(&|json| set(json, &format!("{sampler}/input"), json!(99)), "accessor 99");
    fails(&|json| set(json, &format!("{sampler}/input"), json!(0)), "single numbers");
    fails(&|json| set(json, &format!("{sampler}/output"), json!(2)), "expected 1 for each, of 3 numbers");
    fails(&|json| set(json, &format!("{sampler}/interpolation"), json!("CUBICSPLINE")), "expected 3 for each");
    // Channels of other extensions, and without a node, say nothing.
    let mut file = animated("pointer", "LINEAR", "VEC3", &[0.0; 9]);
    push(&mut file.json["animations"][0]["channels"], json!({"sampler": 77, "target": {"path": "translation"}}));
    assert_eq!(first_at(&model(&file), 1.0), [0.0; 3]);
}

#[test]
fn gltf_scenes_by_name_and_number() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0]}]);
    file.json["scenes"] = json!([{"nodes": [0], "name": "1"}, {"nodes": [1], "name": "other"}, {"nodes": []}]);
    file.json["scene"] = json!(1);
    let model = model(&file);
    let scene = |scene: Option<Select>| model.scene(&Pose { scene, ..Pose::default() });
    let x = |select: Option<Select>| only(&scene(select).unwrap()).vertices[0].position[0];
    assert_eq!(model.contents().default_scene, 1);
    assert_eq!([x(None), x(Some(0.into())), x(Some("other".into()))], [1.0, 0.0, 1.0]);
    // A name comes before a number; a text that is no name may be one.
    assert_eq!([x(Some("1".into())), x(Some(1.into())), x(Some("0".into()))], [0.0, 1.0, 0.0]);
    let error = |select: Select| scene(Some(select)).unwrap_err().to_string();
    assert_eq!(error("none".into()), "has no scene 'none': it has 0 '1', 1 'other', 2");
    assert_eq!(error(3.into()), "has no scene 3: it has 0 '1', 1 'other', 2");
    assert!(error(2.into()).contains("nothing to draw"));
}

#[test]
fn gltf_cameras() {
    let mut file = File::triangle();
    file.json["cameras"] = json!([
        {"name": "eye", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1, "zfar": 10, "aspectRatio": 2}},
        {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1, "znear": 0, "zfar": 5}},
        {"type": "perspective", "perspective": {"yfov": 0, "znear": 1}},
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}},
    ]);
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2, 3, 4]);
    file.json["nodes"] = json!([
        {"mesh": 0},
        {"camera": 0, "translation": [1, 2, 3]},
        // A quarter turn about y, and ten times as large, which changes nothing.
        {"camera": 1, "rotation": [0, 1, 0, 1], "scale": [10, 10, 10], "name": "plan"},
        {"camera": 2},
        {"camera": 3, "rotation": [1, 0, 0, 1]},
    ]);
    let scene = file.loaded().scene;
    assert_eq!(scene.cameras.len(), 3, "one sees nothing");
    let camera = scene.camera(&"eye".into()).unwrap();
    assert_eq!((camera.eye, camera.forward, camera.up), ([1.0, 2.0, 3.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]));
    assert_eq!(
        camera.projection,
        Projection::Perspective { fov_y: 0.5, aspect: Some(2.0), near: 0.1, far: Some(10.0) }
    );
    let camera = scene.camera(&"plan".into()).unwrap();
    assert_eq!((camera.forward, camera.up), ([-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
    assert_eq!(camera.projection, Projection::Orthographic { x_mag: 2.0, y_mag: 1.0, near: 0.0, far: 5.0 });
    let camera = scene.camera(&2.into()).unwrap();
    assert_eq!((camera.forward, camera.up), ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]));
    let error = scene.camera(&"none".into()).unwrap_err().to_string();
    assert_eq!(error, "has no camera 'none': it has 0 'eye', 1 'plan', 2");
    assert_eq!(Scene::default().camera(&0.into()).unwrap_err().to_string(), "has no camera 0: it has no cameras");
}

#[test]
fn gltf_lights() {
    let mut file = File::triangle();
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "point", "name": "bulb", "color": [1, 0.5, 0], "intensity": 20, "range": 3},
        {"type": "spot", "spot": {"outerConeAngle": 0.5}},
        {"type": "directional"},
        {"type": "candle"},
    ]}});
    let light = |number: u32, more: Value| {
        let mut node = json!({"extensions": {"KHR_lights_punctual": {"light": number}}});
        node.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        node
    };
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2, 3, 4]);
    file.json["nodes"] = json!([
        {"mesh": 0},
        light(0, json!({"translation": [1, 2, 3]})),
        light(1, json!({"rotation": [1, 0, 0, -1], "scale": [2, 2, 2], "name": "lamp"})),
        light(2, json!({})),
        light(3, json!({})),
    ]);
    let lights = file.loaded().scene.lights;
    assert_eq!(lights.len(), 3);
    let bulb = &lights[0];
    assert_eq!((&*bulb.name, bulb.color, bulb.intensity, bulb.range), ("bulb", [1.0, 0.5, 0.0], 20.0, 3.0));
    assert_eq!((bulb.kind, bulb.position), (LightKind::Point, [1.0, 2.0, 3.0]));
    let lamp = &lights[1];
    assert_eq!(
        (&*lamp.name, lamp.direction, lamp.intensity, lamp.range),
        ("lamp", [0.0, -1.0, 0.0], 1.0, f32::INFINITY)
    );
    assert_eq!(lamp.kind, LightKind::Spot { inner_cone_angle: 0.0, outer_cone_angle: 0.5 });
    assert_eq!((lights[2].kind, lights[2].direction), (LightKind::Directional, [0.0, 0.0, -1.0]));
}

/// What is scaled is thicker: by the cube root of what happens to volumes.
#[test]
fn gltf_thickness_follows_the_node() {
    let mut file = File::triangle();
    assert_eq!(only(&file.loaded()).thickness_scale, 1.0);
    file.node()["scale"] = json!([2, -4, 1]);
    assert_eq!(only(&file.loaded()).thickness_scale, 2.0);
}

/// A file that is missing costs what is in it.
#[test]
fn gltf_buffers_that_are_missing_cost_their_primitives() {
    let mut file = File::square();
    push(&mut file.json["buffers"], json!({"byteLength": 36, "uri": "gone.bin"}));
    let view = push(&mut file.json["bufferViews"], json!({"buffer": 1, "byteLength": 36}));
    let accessor = json!({"bufferView": view, "componentType": 5126, "type": "VEC3", "count": 3});
    let accessor = push(&mut file.json["accessors"], accessor);
    push(&mut file.json["meshes"][0]["primitives"], json!({"attributes": {"POSITION": accessor}}));
    let loaded = file.loaded();
    assert_eq!(only(&loaded).triangles.len(), 2);
    assert_eq!(loaded.notes.len(), 1);
    assert!(loaded.notes[0].starts_with("some of the model left out: the file 'gone.bin'"), "{:?}", loaded.notes);
}

/// Poses of one model from several threads are the same as one after the other, images shared.
#[test]
fn gltf_poses_of_models_from_several_threads() {
    let Some(folder) = models::folder() else { return };
    for file in ["Fox/Fox.gltf", "InterpolationTest/InterpolationTest.glb", "AnimatedMorphCube/AnimatedMorphCube.glb"] {
        let model = Model::open(folder.join(file), &Limits::default()).unwrap();
        let pose = |number: usize| {
            let animation = &model.contents().animations[number % model.contents().animations.len()];
            let time = animation.duration * number as f64 / 7.0;
            Pose { animation: Some(number.min(model.contents().animations.len() - 1).into()), time, ..Pose::default() }
        };
        let parallel: Vec<Loaded> = std::thread::scope(|scope| {
            let (model, pose) = (&model, &pose);
            let threads: Vec<_> = (0..6).map(|n| scope.spawn(move || model.scene(&pose(n)).unwrap())).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect()
        });
        for (number, loaded) in parallel.iter().enumerate() {
            assert!(*loaded == model.scene(&pose(number)).unwrap(), "{file} {number}");
            assert!(loaded.notes.is_empty(), "{file}: {:?}", loaded.notes);
        }
        let shared = parallel.iter().all(|loaded| {
            loaded.scene.images.iter().zip(&parallel[0].scene.images).all(|(a, b)| std::sync::Arc::ptr_eq(a, b))
        });
        assert!(shared, "{file}");
        assert!(parallel[1].scene.objects != parallel[5].scene.objects, "{file}: nothing moves");
    }
}
