//! Numbers that are no places, directions or colours, in files that are well-formed; and shapes without any extent.

use super::make::{COLOR, Gltf, NORMAL, POSITION, TEXCOORD};
use super::{Blank, Case, Error, Picture, case};
use serde_json::json;

pub(super) fn cases() -> Vec<Case> {
    let number = |name, accessor, at: &[usize], number: f32, wanted| {
        let file = at.iter().fold(Gltf::good(), |file, &at| file.number(accessor, at, number));
        case(name, "a.glb", file.glb(), wanted)
    };
    let all: Vec<usize> = (0..12).collect();
    let lit = |case: super::Case| case.options(&["--shading", "lambert", "--normal-maps", "on"]);
    let camera = |name, yfov: f64, near: f64, wanted| {
        let perspective = json!({"yfov": yfov, "znear": near});
        case(name, "a.glb", Gltf::good().set("/cameras/0/perspective", perspective).glb(), wanted).options(&[
            "--shading",
            "unlit",
            "--camera",
            "0",
        ])
    };
    let cloud = |name, positions: &[f32], wanted| {
        let mut file = Gltf::plain();
        let position = file.floats("VEC3", positions);
        case(
            name,
            "a.glb",
            file.set("/meshes/0/primitives/0", json!({"attributes": {"POSITION": position}, "mode": 0})).glb(),
            wanted,
        )
    };
    vec![
        number("position-nan", POSITION, &[3], f32::NAN, Picture(&["1 triangle dropped"])),
        number("position-infinite", POSITION, &[9], f32::NEG_INFINITY, Picture(&["1 triangle dropped"])),
        number("positions-nan", POSITION, &all, f32::NAN, Error(&["nothing to draw", "2 triangles dropped"])),
        number("position-largest", POSITION, &[3], f32::MAX, Blank(&[])),
        number("positions-from-end-to-end", POSITION, &[0, 1], -f32::MAX, Blank(&[])),
        number("position-smallest", POSITION, &[3], 1e-45, Picture(&[])),
        number("normal-nan", NORMAL, &[0], f32::NAN, Picture(&["1 normal without a direction"])),
        lit(number("normal-zero", NORMAL, &[2], 0.0, Picture(&["1 normal without a direction"]))),
        lit(number("normal-huge", NORMAL, &[0], f32::MAX, Picture(&[]))),
        number("texcoord-nan", TEXCOORD, &[0], f32::NAN, Picture(&["1 texture coordinate replaced"])),
        number("texcoord-huge", TEXCOORD, &[0], f32::MAX, Picture(&[])),
        number("colour-nan", COLOR, &[0], f32::NAN, Picture(&["1 vertex colour replaced"])),
        number("colour-huge", COLOR, &[0], f32::MAX, Picture(&[])),
        number("colour-negative", COLOR, &[0], -1e30, Picture(&[])),
        case("factor-huge", "a.glb", Gltf::good().set("/materials/0/pbrMetallicRoughness/baseColorFactor", json!([1e300, 1e39, -1e39, 1e300])).glb(), Picture(&[])),
        case("texture-transform-huge", "a.glb", Gltf::good().set("/materials/0/pbrMetallicRoughness/baseColorTexture/extensions",
            json!({"KHR_texture_transform": {"offset": [1e300, -1e300], "scale": [1e300, 0], "rotation": 1e300}})).glb(), Picture(&[])),
        case("wireframe-of-nan", "a.glb", Gltf::good().number(POSITION, 3, f32::NAN).glb(), Picture(&["1 triangle dropped"])).options(&["--shading", "wireframe"]),
        camera("camera-0-degrees", 0.0, 0.1, Error(&["no camera '0'"])),
        camera("camera-360-degrees", 6.3, 0.1, Error(&["no camera '0'"])),
        camera("camera-near-0", 0.7, 0.0, Error(&["no camera '0'"])),
        camera("camera-near-tiny", 0.7, 1e-300, Blank(&[])),
        cloud("point", &[1.0, 2.0, 3.0], Picture(&[])),
        cloud("point-far-away", &[f32::MAX, f32::MAX, f32::MAX], Picture(&[])),
        cloud("points-far-apart", &[f32::MAX, 0.0, 0.0, -f32::MAX, 0.0, 0.0, 0.0, f32::MAX, -f32::MAX], Picture(&[])),
    ]
}
