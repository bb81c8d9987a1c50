//! Where pictures are taken from.

use crate::models::Squares;
use crate::workspace::Workspace;

fn covered(folder: &Workspace, arguments: &[&str]) -> Vec<bool> {
    let all = [&["render", "a.gltf", "-o", "a.png", "--shading", "unlit"], arguments].concat();
    folder.succeed(&all);
    folder.png("a.png").pixels8::<4>().iter().map(|pixel| pixel[3] > 0).collect()
}

fn squares(name: &str) -> Workspace {
    let folder = Workspace::new(name);
    Squares { z: [0.0, 0.0], ..Squares::default() }.write(&folder, "a");
    folder
}

#[test]
fn cameras_of_the_model() {
    let folder = squares("own-camera");
    // It sees exactly the square.
    for camera in ["front", "0"] {
        let all = covered(&folder, &["--camera", camera, "--size", "8x8"]);
        assert!(all.iter().all(|&is_covered| is_covered), "{camera}");
    }
    let wide = covered(&folder, &["--camera", "front", "--size", "16x8"]);
    assert_eq!(wide.iter().filter(|&&is_covered| is_covered).count(), 64, "what is high enough is wide enough");
    folder.fail(
        &["render", "a.gltf", "-o", "b.png", "--camera", "back"],
        1,
        &["no camera 'back'", "front", "where: a.gltf"],
    );
    folder.fail(&["render", "a.gltf", "-o", "b.png", "--camera", "0", "--fov", "30"], 2, &["--camera"]);
}

#[test]
fn cameras_by_eye_and_target() {
    let folder = squares("eye");
    // At distance 2 the square of half side 1 is seen under 2 atan(1/2) = 53.13 degrees.
    let place = ["--eye", "0,0,2", "--look-at", "0,0,0", "--size", "8x8"];
    let count =
        |more: &[&str]| covered(&folder, &[&place[..], more].concat()).iter().filter(|&&is_covered| is_covered).count();
    assert_eq!([count(&["--fov", "53.13"]), count(&["--fov", "90"])], [64, 16]);
    assert_eq!(count(&["--fov", "90", "--orthographic"]), 16);
    assert_eq!(count(&["--fov", "90", "--near", "2.5"]), 0, "before the near plane");
    assert_eq!(count(&["--fov", "90", "--far", "1.5"]), 0, "beyond the far plane");
    let fails = |arguments: &[&str], part: &str| {
        folder.fail(&[&["render", "a.gltf", "-o", "b.png"], arguments].concat(), 2, &[part]);
    };
    fails(&["--eye", "0,0,2"], "--look-at");
    fails(&["--eye", "0,0,2", "--look-at", "0,0,2"], "two places");
    fails(&["--eye", "0,0,2", "--look-at", "0,0,0", "--near", "5", "--far", "5"], "before the far plane");
    fails(&["--eye", "0,0,2", "--look-at", "0,0,0", "--near", "0"], "above 0");
    fails(&["--eye", "0,0,2", "--look-at", "0,0,0", "--azimuth", "3"], "--azimuth");
    fails(&["--near", "5"], "--eye");
}

#[test]
fn cameras_frame_tightly() {
    let folder = squares("tight");
    for more in [&[][..], &["--orthographic"]] {
        let tight = ["--frame", "tight", "--azimuth", "0", "--elevation", "0", "--size", "50x100"];
        let pixels = covered(&folder, &[&tight[..], more].concat());
        // 96 % of the 50 pixels, in the middle.
        let column = |x: usize| (0..100).any(|y| pixels[y * 50 + x]);
        assert_eq!([0, 1, 48, 49].map(column), [false, true, true, false], "{more:?}");
        let rows = (0..100).filter(|y| (0..50).any(|x| pixels[y * 50 + x])).count();
        assert_eq!(rows, 48, "{more:?}");
    }
}

/// The same model with other axes looks the same, given what is up in it.
#[test]
fn cameras_know_what_is_up() {
    let folder = Workspace::new("up");
    let model = |name: &str, place: fn(f64, f64, f64) -> [f64; 3]| {
        let corners = [[0, 0, 0], [3, 0, 1], [1, 2, 0], [1, 1, 3]];
        let line = |[x, y, z]: [i32; 3]| {
            let [x, y, z] = place(x.into(), y.into(), z.into());
            format!("v {x} {y} {z}\n")
        };
        folder.write(name, corners.map(line).concat() + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    };
    model("y.obj", |x, y, z| [x, y, z]);
    model("z.obj", |x, y, z| [x, -z, y]);
    model("x.obj", |x, y, z| [y, -x, z]);
    model("down.obj", |x, y, z| [x, -y, -z]);
    for (name, up) in [("y", "y"), ("z", "z"), ("z", "0,0,7"), ("x", "x"), ("down", "-y")] {
        let arguments = ["--shading", "ids", "--size", "32x32", "--up", up];
        let (model, picture) = (format!("{name}.obj"), format!("{name}{}.png", up.len()));
        folder.succeed(&[&["render", &model, "-o", &picture], &arguments[..]].concat());
        assert_eq!(folder.png(&picture), folder.png("y1.png"), "{name} {up}");
    }
}

#[test]
fn cameras_see_a_time_and_a_scene() {
    let folder = Workspace::new("time");
    let more = r#""animations": [{"name": "aside", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
        "samplers": [{"input": 2, "output": 3}]}],"#;
    Squares { z: [0.0, 0.0], more, ..Squares::default() }.write(&folder, "a");
    let place = ["--eye", "1,0,10", "--look-at", "1,0,0", "--orthographic", "--fov", "45", "--size", "16x16"];
    let count =
        |more: &[&str]| covered(&folder, &[&place[..], more].concat()).iter().filter(|&&is_covered| is_covered).count();
    let still = count(&[]);
    // After a second the first square stands right beside the second one.
    assert_eq!([count(&["--time", "1"]), count(&["--animation", "aside", "--time", "1"])], [2 * still; 2]);
    assert_eq!(count(&["--animation", "0"]), still);
    assert_eq!(count(&["--time", "1", "--scene", "1"]), still);
    folder.fail(&["render", "a.gltf", "-o", "b.png", "--animation", "fly"], 1, &["no animation 'fly'", "aside"]);
    folder.fail(&["render", "a.gltf", "-o", "b.png", "--scene", "7"], 1, &["no scene", "second"]);
    folder.fail(&["render", "a.gltf", "-o", "b.png", "--variant", "red"], 1, &["no variant"]);
}
