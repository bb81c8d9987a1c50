//! `pineda render`: options, errors, and the exact modes on small pictures.

use crate::workspace::{Png, Workspace};
use png::ColorType;

/// A square in the plane z = 0, its two triangles in two objects with two materials.
const SQUARE: &str = "mtllib two.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\no lower\nusemtl red\nf 1 2 3\no upper\nusemtl blue\nf 1 3 4\n";
const TWO_MATERIALS: &str = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";

/// Looks straight at the square.
const FRONT: [&str; 6] = ["--azimuth", "0", "--elevation", "0", "--size", "8x8"];

fn square(name: &str) -> Workspace {
    let folder = Workspace::new(name);
    folder.write("square.obj", SQUARE);
    folder.write("two.mtl", TWO_MATERIALS);
    folder
}

fn front(folder: &Workspace, more: &[&str]) -> Png {
    let arguments = [&["render", "square.obj", "-o", "a.png"], &FRONT[..], more].concat();
    folder.succeed(&arguments);
    folder.png("a.png")
}

#[test]
fn render_normals_are_exact() {
    let folder = square("normals");
    let png = front(&folder, &["--shading", "normals"]);
    assert_eq!(png.color, ColorType::Rgba);
    let pixels = png.pixels8::<4>();
    assert_eq!(pixels[4 * 8 + 4], [128, 128, 255, 255]);
    assert_eq!(pixels[0], [0; 4]);
    // From behind the normal is turned towards the eye.
    let png = front(&folder, &["--shading", "normals", "--azimuth=180"]);
    assert_eq!(png.pixels8::<4>()[4 * 8 + 4], [128, 128, 0, 255]);
}

#[test]
fn render_lambert_is_exact() {
    let folder = square("lambert");
    let pixels = front(&folder, &["--shading", "lambert"]).pixels8::<4>();
    // 0.25 + 0.75 * 0.8 / sqrt(1.89) = 0.68644 in linear light is sRGB code 216.
    assert_eq!(pixels[5 * 8 + 5], [216, 0, 0, 255]);
    assert_eq!(pixels[2 * 8 + 2], [0, 0, 216, 255]);
    let pixels = front(&folder, &["--shading", "lambert", "--background", "#123456"]).pixels8::<3>();
    assert_eq!([pixels[0], pixels[5 * 8 + 5]], [[0x12, 0x34, 0x56], [216, 0, 0]]);
}

#[test]
fn render_depth_is_exact() {
    let folder = square("depth-mode");
    let png = front(&folder, &["--shading", "depth"]);
    assert_eq!(png.color, ColorType::Grayscale);
    let pixels = png.pixels16::<1>();
    // The square is in the middle between near and far, whatever the field of view.
    assert_eq!([pixels[4 * 8 + 4], pixels[3 * 8 + 3], pixels[0]], [[32767], [32767], [65535]]);
    folder.succeed(&[&["render", "square.obj", "-o", "a.ppm", "--shading", "depth"], &FRONT[..]].concat());
    assert!(folder.read("a.ppm").starts_with(b"P6\n8 8\n65535\n\xff\xff"));
}

#[test]
fn render_ids_are_exact() {
    let folder = square("ids-mode");
    let png = front(&folder, &["--shading", "ids"]);
    assert_eq!(png.color, ColorType::Rgba);
    let pixels = png.pixels16::<4>();
    assert_eq!([pixels[5 * 8 + 5], pixels[2 * 8 + 2], pixels[0]], [[0, 0, 0, 65535], [1, 1, 0, 65535], [0; 4]]);
}

#[test]
fn render_exact_modes_are_not_anti_aliased_unasked() {
    let folder = Workspace::new("aliased");
    for shading in ["lambert", "normals"] {
        folder.succeed(&["render", "-o", "a.png", "--size", "40x30", "--shading", shading]);
        let pixels = folder.png("a.png").pixels8::<4>();
        assert!(pixels.iter().all(|p| p[3] == 0 && p[..3] == [0; 3] || p[3] == 255), "{shading}");
        assert!(pixels.iter().any(|p| p[3] == 255), "{shading}");
    }
    for shading in ["depth", "ids", "overdraw", "coverage"] {
        folder.fail(&["render", "-o", "a.png", "--samples", "4", "--shading", shading], 2, &["--samples"]);
    }
}

#[test]
fn render_default_look() {
    let folder = Workspace::new("look");
    folder.succeed(&["render", "-o", "paper.png", "--size", "48x36"]);
    let paper = folder.png("paper.png");
    assert_eq!((paper.size, paper.color), ([48, 36], ColorType::Rgb));
    folder.succeed(&["render", "-o", "cut.png", "--size", "48x36", "--background", "transparent"]);
    let cut = folder.png("cut.png").pixels8::<4>();
    assert!(cut.iter().any(|p| (1..=254).contains(&p[3])), "outlines are anti-aliased");
    for (paper, cut) in paper.pixels8::<3>().iter().zip(&cut) {
        assert!(cut[3] < 255 || *paper == cut[..3], "what is opaque is the same on any background");
    }
    // A shadow on the ground would be soft with any number of samples.
    let sharp = ["render", "-o", "a.png", "--size", "48x36", "--ground", "off", "--background", "transparent"];
    for samples in ["1", "2", "8", "16"] {
        folder.succeed(&[&sharp[..], &["--samples", samples]].concat());
        let pixels = folder.png("a.png").pixels8::<4>();
        assert_eq!(pixels.iter().any(|p| (1..=254).contains(&p[3])), samples != "1");
    }
}

#[test]
fn render_numbers_out_of_range() {
    let folder = Workspace::new("numbers");
    let fails = |option: &str, value: &str, part: &str| {
        folder.fail(&["render", "-o", "a.png", &format!("{option}={value}")], 2, &[option, part]);
    };
    for size in ["0", "0x10", "10x0", "20000x20000", "-5x5", "NaN", "10x10x10"] {
        fails("--size", size, size);
    }
    for fov in ["0", "180", "-40", "NaN", "inf", "wide"] {
        fails("--fov", fov, fov);
    }
    for option in ["--azimuth", "--elevation"] {
        fails(option, "NaN", "must be finite");
        fails(option, "1e999", "must be finite");
        fails(option, "east", "is not a number");
    }
    fails("--smooth", "181", "0 to 180");
    fails("--samples", "3", "16");
    fails("--up", "w", "-z");
    fails("--eye", "1,2", "three numbers");
    fails("--quality", "101", "100");
    fails("--time", "later", "is not a number");
    fails("--shading", "toon", "lambert");
    fails("--background", "puce", "#rrggbb");
    folder.fail(&["render", "-o", "a.png", "--shading", "depth", "--background", "white"], 2, &["--background"]);
    folder.fail(&["render", "-o", "a.ppm", "--shading", "ids"], 2, &[".png"]);
    folder.succeed(&["render", "-o", "a.png", "--size", "9x16", "--azimuth", "-370.5", "--elevation", "90"]);
}

#[test]
fn render_of_rubbish() {
    let folder = Workspace::new("rubbish");
    let fails = |name: &str, content: &[u8], parts: &[&str]| {
        folder.write(name, content);
        folder.fail(&["render", name, "-o", "a.png"], 1, &[parts, &[&format!("where: {name}")]].concat());
    };
    fails("empty.obj", b"", &["nothing to draw"]);
    fails("empty.stl", b"", &[]);
    fails("empty.ply", b"", &[]);
    fails("empty.gltf", b"", &[]);
    fails("empty.glb", b"", &[]);
    fails("text.txt", b"Dear Sir or Madam", &["no known format"]);
    fails("range.obj", b"v 0 0 0\nf 1 2 3\n", &["line 2"]);
    fails("cut.glb", b"glTF\x02\0\0\0\xff\0\0\0", &[]);
    fails("cut.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\nend_header\n", &[]);
    fails("nan.obj", b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", &[]);
    std::fs::create_dir(folder.path("folder.obj")).unwrap();
    folder.fail(&["render", "folder.obj", "-o", "a.png"], 1, &["where: folder.obj"]);
    folder.fail(&["render", "missing.obj", "-o", "a.png"], 1, &["where: missing.obj"]);
}

#[test]
fn render_notes_are_lines_on_standard_error() {
    let folder = Workspace::new("notes");
    folder.write("a.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let run = folder.run(&["render", "a.obj", "-o", "a.png", "--size", "8x8"]);
    assert_eq!((run.code, run.stdout.as_str()), (0, ""));
    assert!(run.stderr.lines().count() > 0 && run.stderr.lines().all(|line| line.starts_with("note: ")), "{run:?}");
    assert!(run.stderr.contains("gone.mtl"), "{run:?}");
}

/// The same model, wherever it stands and however large it is.
#[test]
fn render_is_the_same_for_any_scale_and_place() {
    let folder = Workspace::new("scale");
    for (name, scale, shift) in
        [("a", 1.0, 0.0), ("b", 2f64.powi(-100), 0.0), ("c", 2f64.powi(100), 0.0), ("d", 4096.0, 65536.0)]
    {
        let corners = [[0, 0, 0], [3, 0, 1], [1, 2, 0], [1, 1, 3]];
        let lines = corners.map(|c| {
            let [x, y, z] = c.map(|k| f64::from(k) * scale + shift);
            format!("v {x:e} {y:e} {z:e}\n")
        });
        folder.write(&format!("{name}.obj"), lines.concat() + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
        folder.succeed(&["render", &format!("{name}.obj"), "-o", &format!("{name}.ppm"), "--size", "64x64"]);
        assert_eq!(folder.read(&format!("{name}.ppm")), folder.read("a.ppm"), "{name}");
    }
}
