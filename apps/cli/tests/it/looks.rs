//! What materials look like: alpha above all.

use crate::models::Squares;
use crate::workspace::Workspace;

/// Red, unlit, half transparent; and green, a quarter.
const GLASS: [&str; 2] = [
    r#"{"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5]}}"#,
    r#"{"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0, 1, 0, 0.25]}}"#,
];
const FRONT: [&str; 8] = ["-o", "a.png", "--size", "8x8", "--azimuth", "0", "--elevation", "0"];

fn middle(folder: &Workspace, model: &str, more: &[&str]) -> [u8; 4] {
    folder.succeed(&[&["render", model], &FRONT[..], more].concat());
    folder.png("a.png").pixels8::<4>()[4 * 8 + 4]
}

/// sRGB code of a light.
fn code(light: f64) -> u8 {
    let encoded = if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

#[test]
fn looks_blended_over_nothing_have_straight_alpha() {
    let folder = Workspace::new("straight");
    Squares { materials: [GLASS[0], GLASS[0]], ..Squares::default() }.write(&folder, "red");
    // Two layers of one colour are that colour, and 1 - (1 - 1/2)^2 of it.
    assert_eq!(middle(&folder, "red.gltf", &["--shading", "unlit"]), [255, 0, 0, 191]);
    assert_eq!(middle(&folder, "red.gltf", &["--shading", "unlit", "--samples", "8"]), [255, 0, 0, 191]);
    assert_eq!(middle(&folder, "red.gltf", &["--shading", "unlit", "--scene", "second"]), [255, 0, 0, 128]);
}

/// Whichever comes first in the file.
#[test]
fn looks_blended_are_sorted_from_back_to_front() {
    let folder = Workspace::new("sorted");
    // Green (1/4) before red (1/2): red counts 3/4 * 1/2, green 1/4, of 5/8.
    let wanted = [code(0.6), code(0.4), 0, 159];
    Squares { z: [0.0, 0.5], materials: GLASS, ..Squares::default() }.write(&folder, "a");
    Squares { z: [0.5, 0.0], materials: [GLASS[1], GLASS[0]], ..Squares::default() }.write(&folder, "b");
    for model in ["a.gltf", "b.gltf"] {
        assert_eq!(middle(&folder, model, &["--shading", "unlit"]), wanted, "{model}");
    }
    // From a background's point of view the same light.
    folder.succeed(&[&["render", "a.gltf"], &FRONT[..], &["--shading", "unlit", "--background", "white"]].concat());
    let over_white = folder.png("a.png").pixels8::<3>()[4 * 8 + 4];
    assert_eq!(over_white, [code(0.375 + 0.375), code(0.25 + 0.375), code(0.375)]);
}

#[test]
fn looks_blended_count_as_opaque_for_numbers() {
    let folder = Workspace::new("numbers-of-glass");
    Squares { materials: GLASS, ..Squares::default() }.write(&folder, "a");
    assert_eq!(middle(&folder, "a.gltf", &["--shading", "normals"]), [128, 128, 255, 255]);
    folder.succeed(&[&["render", "a.gltf"], &FRONT[..], &["--shading", "ids"]].concat());
    assert_eq!(folder.png("a.png").pixels16::<4>()[4 * 8 + 4][..2], [1, 1], "the nearer one");
}

#[test]
fn looks_masked_are_there_or_not() {
    let folder = Workspace::new("masked");
    let holes =
        r#"{"alphaMode": "MASK", "alphaCutoff": 0.6, "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5]}}"#;
    let whole =
        r#"{"alphaMode": "MASK", "alphaCutoff": 0.5, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 0.5]}}"#;
    Squares { materials: [whole, holes], ..Squares::default() }.write(&folder, "a");
    assert_eq!(middle(&folder, "a.gltf", &["--shading", "unlit"]), [0, 0, 255, 255], "through the hole, opaque");
    folder.succeed(&[&["render", "a.gltf"], &FRONT[..], &["--shading", "ids"]].concat());
    assert_eq!(folder.png("a.png").pixels16::<4>()[4 * 8 + 4], [0, 0, 0, 65535]);
    folder.succeed(&[&["render", "a.gltf"], &FRONT[..], &["--shading", "depth"]].concat());
    let behind = folder.png("a.png").pixels16::<1>()[4 * 8 + 4];
    folder.succeed(&[&["render", "a.gltf"], &FRONT[..], &["--shading", "depth", "--scene", "second"]].concat());
    assert_eq!(folder.png("a.png").pixels16::<1>()[4 * 8 + 4], [65535], "nothing is left of it");
    assert!(behind[0] > 32767);
}

#[test]
fn looks_that_count() {
    let folder = Workspace::new("counts");
    Squares::default().write(&folder, "a");
    for (shading, once, twice) in
        [("coverage", [40, 90, 200], [40, 170, 70]), ("overdraw", [30, 28, 92], [92, 30, 126])]
    {
        let count = |more: &[&str]| {
            folder.succeed(&[&["render", "a.gltf"], &FRONT[..], &["--shading", shading], more].concat());
            let pixels = folder.png("a.png").pixels8::<3>();
            [pixels[4 * 8 + 4], pixels[0]]
        };
        assert_eq!(count(&[]), [twice, [0; 3]], "{shading}");
        assert_eq!(count(&["--scene", "second"])[0], once, "{shading}");
        // The back of a surface with one side is not drawn.
        assert_eq!(count(&["--azimuth", "180"])[0], [0; 3], "{shading}");
    }
}

/// Every look draws them.
#[test]
fn looks_of_lines_and_points() {
    let folder = Workspace::new("strokes");
    for (name, mode) in [("points", 0), ("lines", 1)] {
        Squares { mode, ..Squares::default() }.write(&folder, name);
        for shading in ["pbr", "unlit", "lambert", "normals", "ids", "uv", "wireframe", "matcap", "overdraw"] {
            let model = format!("{name}.gltf");
            folder.succeed(&["render", &model, "-o", "a.png", "--size", "16x16", "--shading", shading]);
            let png = folder.png("a.png");
            assert!(png.data.iter().any(|&byte| byte != png.data[0]), "{name} {shading}");
        }
    }
    // Six points of which the first and the fourth, the third and the fifth are the same place: the first one is seen.
    folder.succeed(&[&["render", "points.gltf"], &FRONT[..], &["--shading", "ids", "--scene", "second"]].concat());
    let mut points: Vec<_> = folder.png("a.png").pixels16::<4>().iter().filter(|p| p[3] > 0).map(|p| p[2]).collect();
    points.sort_unstable();
    assert_eq!(points, [0, 1, 2, 5]);
}

/// A lamp of four candela at (0, 0, 5).
const LAMP: [&str; 2] = [
    r#""extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "color": [1, 0, 0], "intensity": 4}]}},"#,
    r#", "extensions": {"KHR_lights_punctual": {"light": 0}}"#,
];

#[test]
fn looks_lit_by_the_models_own_lights() {
    let folder = Workspace::new("lamps");
    let [more, front] = LAMP;
    let matt = r#"{"doubleSided": true, "pbrMetallicRoughness": {"metallicFactor": 0}}"#;
    Squares { more, front, materials: [matt; 2], ..Squares::default() }.write(&folder, "a");
    let pbr = ["--samples", "1", "--tone-mapping", "none", "--background", "transparent"];
    let studio = middle(&folder, "a.gltf", &pbr);
    assert_eq!(middle(&folder, "a.gltf", &[&pbr[..], &["--lights", "studio"]].concat()), studio);
    let lit = |more: &[&str]| middle(&folder, "a.gltf", &[&pbr[..], &["--lights", "model"], more].concat());
    let [red, green, blue, _] = lit(&[]);
    assert!(red > green && green.abs_diff(blue) < 16, "red light in a grey studio: {red} {green} {blue}");
    // The camera turned to the back: the lamp is behind the model.
    let [behind, ..] = lit(&["--azimuth", "180"]);
    assert!(behind < red, "{behind} {red}");
    // The same lamp and the same picture, wherever up is.
    let [up, ..] = lit(&["--up", "-x"]);
    assert!(up.abs_diff(red) < 16, "{up} {red}");
}

#[test]
fn looks_without_lights_say_so() {
    let folder = Workspace::new("no-lamps");
    Squares::default().write(&folder, "a");
    let asked = ["render", "a.gltf", "-o", "b.png", "--lights", "model"];
    folder.fail(&asked, 1, &["the model has no lights of its own", "where: a.gltf", "pineda info"]);
    folder.fail(&[&asked[..], &["--shading", "lambert"]].concat(), 2, &["--lights model", "--shading pbr"]);
    assert!(!folder.path("b.png").exists());
}
