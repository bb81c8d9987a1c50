//! glTF: skins, morph targets, animations.

use super::make::{AMOUNTS, BIND, Gltf, TIMES, TURNS, WEIGHTS};
use super::{Blank, Case, Error, Picture, Wanted, case};
use serde_json::{Value, json};

pub(super) fn cases() -> Vec<Case> {
    [skins(), targets(), animations()].into_iter().flatten().collect()
}

fn with(name: &'static str, place: &str, value: Value, wanted: Wanted) -> Case {
    case(name, "a.glb", Gltf::good().set(place, value).glb(), wanted)
}

fn skins() -> Vec<Case> {
    let attribute = "/meshes/0/primitives/0/attributes";
    let good = Gltf::good;
    vec![
        with("skin-joint-missing", "/skins/0/joints", json!([1, 99]), Error(&["skin 0", "joint, node 99"])),
        with("skin-without-joints", "/skins/0/joints", json!([]), Error(&["joint"])),
        with("skin-more-joints-than-matrices", "/skins/0/joints", json!([1, 2, 1]), Error(&["skin 0", "3 joints"])),
        with("skin-matrices-are-colours", "/skins/0/inverseBindMatrices", json!(11), Error(&["skin 0", "MAT4"])),
        with("skin-weights-missing", attribute, json!({"POSITION": 0, "JOINTS_0": 4}), Picture(&[])),
        with("skin-joints-are-weights", &format!("{attribute}/JOINTS_0"), json!(5), Picture(&[])),
        case(
            "skin-joint-index",
            "a.glb",
            {
                let mut file = good();
                let offset = file.json["bufferViews"][4]["byteOffset"].as_u64().unwrap() as usize;
                file.binary[offset] = 200;
                file.glb()
            },
            Error(&["mesh 0, primitive 0", "joint 200"]),
        ),
        case(
            "skin-weight-nan",
            "a.glb",
            good().number(WEIGHTS, 0, f32::NAN).glb(),
            Error(&["nothing to draw", "triangles dropped"]),
        ),
        case(
            "skin-weight-infinite",
            "a.glb",
            good().number(WEIGHTS, 4, f32::INFINITY).glb(),
            Picture(&["triangle dropped"]),
        ),
        case(
            "skin-weights-zero",
            "a.glb",
            (0..16).fold(good(), |file, at| file.number(WEIGHTS, at, 0.0)).glb(),
            Picture(&[]),
        ),
        case("skin-bind-matrix-nan", "a.glb", good().number(BIND, 0, f32::NAN).glb(), Error(&["nothing to draw"])),
        case("skin-bind-matrix-huge", "a.glb", good().number(BIND, 0, 3e38).glb(), Blank(&[])),
    ]
}

fn targets() -> Vec<Case> {
    let good = Gltf::good();
    let weights = |count: usize| json!(vec![0.5; count]);
    vec![
        with(
            "target-missing",
            "/meshes/0/primitives/0/targets/0/POSITION",
            json!(99),
            Error(&["POSITION, accessor 99"]),
        ),
        with(
            "target-of-another-size",
            "/meshes/0/primitives/0/targets/0/POSITION",
            json!(8),
            Error(&["primitive 0", "accessor 8"]),
        ),
        with("target-weights-too-many", "/meshes/0/weights", weights(1000), Picture(&[])),
        with(
            "target-weight-huge",
            "/meshes/0/weights",
            json!([1e300]),
            Error(&["nothing to draw", "2 triangles dropped"]),
        ),
        case(
            "targets-many-of-one",
            "a.glb",
            good.set("/meshes/0/primitives/0/targets", json!(vec![json!({"POSITION": 9}); 1 << 20]))
                .set("/meshes/0/weights", weights(1 << 20))
                .glb(),
            Picture(&[]),
        ),
    ]
}

fn animations() -> Vec<Case> {
    const AT_ONE: &[&str] = &["--shading", "unlit", "--time", "1"];
    let moved = |name, place: &str, value, wanted| with(name, place, value, wanted).options(AT_ONE);
    let number = |name, accessor, at, number, wanted| {
        case(name, "a.glb", Gltf::good().number(accessor, at, number).glb(), wanted).options(AT_ONE)
    };
    vec![
        moved("animation-good", "/asset/generator", json!("by hand"), Picture(&[])),
        moved(
            "animation-without-times",
            "/accessors/7/count",
            json!(0),
            Error(&["animation 0, channel 0", "at least one"]),
        ),
        moved(
            "animation-times-huge",
            "/accessors/7/count",
            json!(u64::MAX),
            Error(&["animation 0, channel 0, input, accessor 7"]),
        ),
        moved(
            "animation-times-from-nowhere",
            "/accessors/7",
            json!({"componentType": 5126, "type": "SCALAR", "count": 4_000_000_000u64}),
            Error(&["accessor elements", "Limits::expanded"]),
        ),
        moved(
            "animation-values-too-few",
            "/accessors/8/count",
            json!(1),
            Error(&["animation 0, channel 0", "1 values", "2 times"]),
        ),
        moved(
            "animation-values-of-another-kind",
            "/animations/0/samplers/0/output",
            json!(10),
            Error(&["expected 1 for each, of 4 numbers"]),
        ),
        moved(
            "animation-spline-too-few",
            "/animations/0/samplers/0/interpolation",
            json!("CUBICSPLINE"),
            Error(&["expected 3 for each"]),
        ),
        moved(
            "animation-interpolation-unknown",
            "/animations/0/samplers/0/interpolation",
            json!("WOBBLE"),
            Picture(&[]),
        ),
        moved(
            "animation-sampler-missing",
            "/animations/0/channels/0/sampler",
            json!(9),
            Error(&["animation 0, channel 0", "sampler 9"]),
        ),
        moved(
            "animation-node-missing",
            "/animations/0/channels/0/target/node",
            json!(99),
            Error(&["animation 0, channel 0", "node 99"]),
        ),
        moved("animation-path-unknown", "/animations/0/channels/0/target/path", json!("colour"), Picture(&[])),
        moved("animation-input-missing", "/animations/0/samplers/0/input", json!(99), Error(&["input, accessor 99"])),
        moved("animation-missing", "/animations", json!([]), Error(&["no animation 0", "no animations"])),
        number("animation-times-unsorted", TIMES, 0, 3.0, Picture(&[])),
        number("animation-times-nan", TIMES, 0, f32::NAN, Picture(&[])),
        number("animation-times-infinite", TIMES, 1, f32::INFINITY, Picture(&[])),
        number("animation-rotation-nan", TURNS, 4, f32::NAN, Picture(&[])),
        number("animation-weight-nan", AMOUNTS, 1, f32::NAN, Error(&["nothing to draw", "2 triangles dropped"])),
        moved("animation-long-after", "/asset/generator", json!(""), Picture(&[])).options(&[
            "--shading",
            "unlit",
            "--time",
            "1e300",
        ]),
        moved("animation-long-before", "/asset/generator", json!(""), Picture(&[])).options(&[
            "--shading",
            "unlit",
            "--time",
            "-1e300",
        ]),
    ]
}
