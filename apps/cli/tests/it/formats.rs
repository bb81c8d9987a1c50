//! Pictures in each format.

use crate::workspace::Workspace;

const SMALL: [&str; 4] = ["--size", "24x16", "--shading", "unlit"];

fn draw(folder: &Workspace, output: &str, more: &[&str]) {
    folder.succeed(&[&["render", "-o", output], &SMALL[..], more].concat());
}

#[test]
fn formats_by_extension_show_the_same() {
    let folder = Workspace::new("formats");
    draw(&folder, "a.png", &["--background", "#224466"]);
    let wanted = folder.png("a.png").pixels8::<3>();

    draw(&folder, "a.ppm", &["--background", "#224466"]);
    assert_eq!(folder.read("a.ppm")[b"P6\n24 16\n255\n".len()..], *wanted.as_flattened());

    draw(&folder, "a.WEBP", &["--background", "#224466"]);
    let mut webp = image_webp::WebPDecoder::new(std::io::Cursor::new(folder.read("a.WEBP"))).unwrap();
    let mut data = vec![0; webp.output_buffer_size().unwrap()];
    webp.read_image(&mut data).unwrap();
    assert_eq!(data, wanted.as_flattened());

    for name in ["a.jpg", "b.jpeg"] {
        draw(&folder, name, &["--background", "#224466", "--quality", "100"]);
        let jpeg = image::load_from_memory(&folder.read(name)).unwrap().into_rgb8();
        let off = jpeg.as_raw().iter().zip(wanted.as_flattened()).filter(|(a, b)| a.abs_diff(**b) > 16).count();
        // Edges of colours blur a little.
        assert!(off < 24 * 16 * 3 / 20, "{off}");
    }
}

#[test]
fn formats_with_floats_have_linear_light_multiplied_by_alpha() {
    let folder = Workspace::new("exr");
    draw(&folder, "a.png", &["--samples", "4"]);
    draw(&folder, "a.exr", &["--samples", "4"]);
    let png = folder.png("a.png").pixels8::<4>();
    let exr = image::load_from_memory(&folder.read("a.exr")).unwrap();
    let exr = exr.as_rgba32f().unwrap();
    let encode = |light: f32| {
        let light = f64::from(light);
        let v = if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
        (v * 255.0).round() as u8
    };
    for (codes, light) in png.iter().zip(exr.pixels()) {
        let [r, g, b, a] = light.0;
        if codes[3] == 0 {
            assert_eq!(light.0, [0.0; 4]);
        } else {
            assert_eq!(*codes, [encode(r / a), encode(g / a), encode(b / a), (a * 255.0).round() as u8]);
        }
    }
    // Numbers come as they are: object 0 to 6, and counts.
    draw(&folder, "ids.exr", &["--shading", "ids"]);
    let ids = image::load_from_memory(&folder.read("ids.exr")).unwrap();
    assert!(ids.as_rgba32f().unwrap().pixels().all(|p| p.0[0].fract() == 0.0 && p.0[0] < 7.0));
    draw(&folder, "count.exr", &["--shading", "coverage"]);
    let counts = image::load_from_memory(&folder.read("count.exr")).unwrap();
    assert!(counts.as_rgba32f().unwrap().pixels().any(|p| p.0[0] == 2.0 || p.0[0] == 1.0));
}

#[test]
fn formats_that_cannot_hold_what_is_asked_for() {
    let folder = Workspace::new("unheld");
    let fails = |output: &str, more: &[&str], part: &str| {
        folder.fail(&[&["render", "-o", output], more].concat(), 2, &[part, "help: "]);
    };
    fails("a.jpg", &["--background", "transparent"], "cannot be transparent");
    fails("a.jpg", &["--shading", "depth"], "16 bits");
    fails("a.webp", &["--shading", "depth"], "16 bits");
    fails("a.webp", &["--shading", "ids"], "four numbers");
    fails("a.tga", &[], "--picture-format");
    // Without alpha, what would be transparent is white.
    draw(&folder, "a.jpg", &[]);
    let jpeg = image::load_from_memory(&folder.read("a.jpg")).unwrap().into_rgb8();
    assert!(jpeg.get_pixel(0, 0).0.iter().all(|&channel| channel > 250));
    // The option wins over the name.
    draw(&folder, "picture.dat", &["--picture-format", "ppm"]);
    assert!(folder.read("picture.dat").starts_with(b"P6"));
}
