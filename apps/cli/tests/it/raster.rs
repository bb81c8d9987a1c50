//! `pineda raster`, pixel by pixel where pictures are small.

use crate::workspace::Workspace;
use png::ColorType;

/// A square whose diagonal goes through pixel centres: (0.5, 0.5) to (3.5, 3.5).
const SQUARE: &str = r#"{
  "size": [4, 4],
  "vertices": [{"position": [0.5, 0.5]}, {"position": [3.5, 0.5]}, {"position": [3.5, 3.5]}, {"position": [0.5, 3.5]}],
  "triangles": [[0, 1, 2], [0, 2, 3]]
}"#;

#[test]
fn raster_without_a_file_is_tutorial_1() {
    let folder = Workspace::new("tutorial");
    folder.succeed(&["raster", "-o", "a.ppm"]);
    folder.succeed(&["raster", "-o", "a.png"]);
    let ppm = folder.read("a.ppm");
    let header = b"P6\n512 512\n255\n";
    assert!(ppm.starts_with(header));
    let png = folder.png("a.png");
    assert_eq!((png.size, png.color), ([512, 512], ColorType::Rgb));
    assert_eq!(png.data, ppm[header.len()..]);
    let pixels = png.pixels8::<3>();
    let at = |x: usize, y: usize| pixels[y * 512 + x];
    assert_eq!([at(0, 0), at(511, 511), at(300, 100)], [[0; 3]; 3]);
    // The corners' colours, one pixel inside, and just below the middle of the slope between the first two.
    assert_eq!([at(149, 410), at(149, 70), at(488, 410)], [[1, 1, 254], [1, 254, 1], [253, 1, 1]]);
    assert_eq!(at(320, 241), [128, 126, 1]);
}

#[test]
fn raster_count_of_a_shared_edge_is_one() {
    let folder = Workspace::new("count");
    folder.write("square.json", SQUARE);
    folder.succeed(&["raster", "square.json", "-o", "count.png", "--show", "count"]);
    let (o, i) = ([0, 0, 0], [40, 90, 200]);
    // Top and left borders belong to the square, bottom and right ones do not.
    assert_eq!(folder.png("count.png").pixels8::<3>(), [i, i, i, o, i, i, i, o, i, i, i, o, o, o, o, o]);
}

#[test]
fn raster_id() {
    let folder = Workspace::new("id");
    folder.write("square.json", SQUARE);
    folder.succeed(&["raster", "square.json", "-o", "id.png", "--show", "id"]);
    let (o, a, b) = ([0, 0, 0], [128, 0, 0], [0, 128, 0]);
    // The diagonal is the lower triangle's right edge and the upper one's left edge.
    assert_eq!(folder.png("id.png").pixels8::<3>(), [a, a, a, o, b, a, a, o, b, b, a, o, o, o, o, o]);
}

#[test]
fn raster_depth_and_barycentric() {
    let folder = Workspace::new("depth");
    folder.write(
        "plane.json",
        r#"{"size": [2, 2], "vertices": [
            {"position": [0, 0], "depth": 0}, {"position": [4, 0], "depth": 1}, {"position": [0, 4], "depth": 0}]}"#,
    );
    folder.succeed(&["raster", "plane.json", "-o", "depth.png", "--show", "depth"]);
    let depth = folder.png("depth.png");
    assert_eq!(depth.color, ColorType::Grayscale);
    // Depth is x / 4: 1/8 and 3/8 of 65534.
    assert_eq!(depth.pixels16::<1>(), [[8192], [24575], [8192], [24575]]);
    folder.succeed(&["raster", "plane.json", "-o", "depth.ppm", "--show", "depth"]);
    assert!(folder.read("depth.ppm").starts_with(b"P6\n2 2\n65535\n\x20\x00\x20\x00\x20\x00"));
    folder.succeed(&["raster", "plane.json", "-o", "weights.png", "--show", "barycentric"]);
    // At (0.5, 0.5): 3/4, 1/8, 1/8.
    assert_eq!(folder.png("weights.png").pixels8::<3>(), [[191, 32, 32], [128, 96, 32], [128, 32, 96], [64, 96, 96]]);
    folder.write("nothing.json", r#"{"size": [1, 1], "vertices": []}"#);
    folder.succeed(&["raster", "nothing.json", "-o", "nothing.png", "--show", "depth"]);
    assert_eq!(folder.png("nothing.png").pixels16::<1>(), [[65535]]);
}

#[test]
fn raster_spaces_agree() {
    let folder = Workspace::new("spaces");
    let drawings = [
        ("raster", "[1, 1], [7, 2], [3, 6]"),
        ("ndc", "[-0.75, 0.75], [0.75, 0.5], [-0.25, -0.5]"),
        ("clip", "[-1.5, 1.5, 0, 2], [3, 2, 0, 4], [-0.125, -0.25, 0, 0.5]"),
    ];
    for (space, positions) in drawings {
        let vertices: Vec<String> = positions
            .split_inclusive("]")
            .map(|p| format!("{{\"position\": {}}}", p.trim_start_matches(", ")))
            .collect();
        let text = format!(r#"{{"size": [8, 8], "space": "{space}", "vertices": [{}]}}"#, vertices.join(","));
        folder.write(&format!("{space}.json"), text);
        folder.succeed(&["raster", &format!("{space}.json"), "-o", &format!("{space}.ppm"), "--show", "count"]);
    }
    assert!(folder.read("raster.ppm").contains(&200));
    assert_eq!(folder.read("ndc.ppm"), folder.read("raster.ppm"));
    assert_eq!(folder.read("clip.ppm"), folder.read("raster.ppm"));
}

#[test]
fn raster_culling_blending_and_order() {
    let folder = Workspace::new("state");
    let drawing = |rest: &str, colors: [&str; 2]| {
        let triangle = |depth: f32, color: &str| {
            ["[0, 0]", "[0, 4]", "[4, 0]"]
                .map(|p| format!(r#"{{"position": {p}, "depth": {depth}, "color": {color}}}"#))
                .join(",")
        };
        let vertices = [triangle(0.25, colors[0]), triangle(0.75, colors[1])].join(",");
        folder.write("drawing.json", format!(r#"{{"size": [1, 1], {rest} "vertices": [{vertices}]}}"#));
        folder.succeed(&["raster", "drawing.json", "-o", "picture.png"]);
        folder.png("picture.png").pixels8::<3>()[0]
    };
    let (red, blue) = ("[1, 0, 0]", "[0, 0, 1]");
    assert_eq!(drawing("", [red, blue]), [255, 0, 0], "the nearer one");
    assert_eq!(drawing(r#""depth_test": false,"#, [red, blue]), [0, 0, 255], "the later one");
    assert_eq!(drawing(r#""cull": "front","#, [red, blue]), [0, 0, 0], "both are counter-clockwise on the picture");
    assert_eq!(drawing(r#""cull": "back","#, [red, blue]), [255, 0, 0]);
    assert_eq!(
        drawing(r#""cull": "back", "front_face": "clockwise", "background": [0, 1, 0],"#, [red, blue]),
        [0, 255, 0]
    );
    assert_eq!(drawing(r#""depth_test": false,"#, [red, "[0, 0, 1, 0.2]"]), [204, 0, 51], "source over");
}

#[test]
fn raster_errors_say_where() {
    let folder = Workspace::new("raster-errors");
    let fails = |content: &str, parts: &[&str]| {
        folder.write("bad.json", content);
        folder.fail(&["raster", "bad.json", "-o", "a.png"], 1, parts);
    };
    fails("", &["where: bad.json, line 1"]);
    fails("{\"size\": [4, 4],\n\"vertices\": [{\"position\": [1 2]}]}", &["line 2, column 30"]);
    fails("{\"size\": [4, 4],\n\"vertexes\": []}", &["unknown field `vertexes`", "line 2, column 10", "help: "]);
    fails(r#"{"size": [0, 4], "vertices": []}"#, &["both sides must lie in 1 to 16384"]);
    fails(r#"{"size": [20000, 20000], "vertices": []}"#, &["both sides must lie in 1 to 16384"]);
    fails(r#"{"size": [1.5, 4], "vertices": []}"#, &["1.5"]);
    fails(
        r#"{"size": [4, 4], "vertices": [], "triangles": [[0, 0, 0]]}"#,
        &["where: bad.json, triangles[0][0]", "index 0"],
    );
    fails(
        r#"{"size": [4, 4], "vertices": [{"position": [1, 1e39]}], "triangles": []}"#,
        &["number out of range", "line 1"],
    );
    folder.fail(&["raster", "missing.json", "-o", "a.png"], 1, &["cannot be read", "where: missing.json"]);
    folder.fail(&["raster", ".", "-o", "a.png"], 1, &["cannot be read", "where: ."]);
    folder.write("binary.json", [0xff, 0xfe, 0, 1]);
    folder.fail(&["raster", "binary.json", "-o", "a.png"], 1, &["line 1"]);
}

#[test]
fn raster_examples_are_drawn() {
    let folder = Workspace::new("examples");
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    for entry in std::fs::read_dir(examples).unwrap() {
        let path = entry.unwrap().path();
        folder.succeed(&["raster", path.to_str().unwrap(), "-o", "a.png"]);
        assert!(folder.png("a.png").data.iter().any(|&byte| byte != 0), "{}", path.display());
    }
}
