//! Pictures in each format.

use crate::workspace::Workspace;
use exr::prelude::{ReadChannels, ReadLayers, Vec2, read};
use std::io::Cursor;

const SMALL: [&str; 4] = ["--size", "24x16", "--shading", "unlit"];

fn draw(folder: &Workspace, output: &str, more: &[&str]) {
    folder.succeed(&[&["render", "-o", output], &SMALL[..], more].concat());
}

/// Three channels of 8 bits.
fn jpeg(bytes: &[u8]) -> Vec<u8> {
    zune_jpeg::JpegDecoder::new(zune_core::bytestream::ZCursor::new(bytes)).decode().unwrap()
}

/// Pixels row by row.
fn exr(bytes: &[u8]) -> Vec<[f32; 4]> {
    let size = |size: Vec2<usize>, _: &_| (size.0, vec![[0.0; 4]; size.area()]);
    let set = |(width, pixels): &mut (usize, Vec<_>), at: Vec2<usize>, (r, g, b, a): (f32, f32, f32, f32)| {
        pixels[at.1 * *width + at.0] = [r, g, b, a];
    };
    let layers = read().no_deep_data().largest_resolution_level().rgba_channels(size, set).first_valid_layer();
    layers.all_attributes().from_buffered(Cursor::new(bytes)).unwrap().layer_data.channel_data.pixels.1
}

#[test]
fn formats_by_extension_show_the_same() {
    let folder = Workspace::new("formats");
    draw(&folder, "a.png", &["--background", "#224466"]);
    let wanted = folder.png("a.png").pixels8::<3>();

    draw(&folder, "a.ppm", &["--background", "#224466"]);
    assert_eq!(folder.read("a.ppm")[b"P6\n24 16\n255\n".len()..], *wanted.as_flattened());

    draw(&folder, "a.WEBP", &["--background", "#224466"]);
    let mut webp = image_webp::WebPDecoder::new(Cursor::new(folder.read("a.WEBP"))).unwrap();
    let mut data = vec![0; webp.output_buffer_size().unwrap()];
    webp.read_image(&mut data).unwrap();
    assert_eq!(data, wanted.as_flattened());

    for name in ["a.jpg", "b.jpeg"] {
        draw(&folder, name, &["--background", "#224466", "--quality", "100"]);
        let jpeg = jpeg(&folder.read(name));
        let off = jpeg.iter().zip(wanted.as_flattened()).filter(|(a, b)| a.abs_diff(**b) > 16).count();
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
    let lights = exr(&folder.read("a.exr"));
    let encode = |light: f32| {
        let light = f64::from(light);
        let v = if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
        (v * 255.0).round() as u8
    };
    for (codes, light) in png.iter().zip(lights) {
        let [r, g, b, a] = light;
        if codes[3] == 0 {
            assert_eq!(light, [0.0; 4]);
        } else {
            assert_eq!(*codes, [encode(r / a), encode(g / a), encode(b / a), (a * 255.0).round() as u8]);
        }
    }
    // Numbers come as they are: object 0 to 6, and counts.
    draw(&folder, "ids.exr", &["--shading", "ids"]);
    assert!(exr(&folder.read("ids.exr")).iter().all(|p| p[0].fract() == 0.0 && p[0] < 7.0));
    draw(&folder, "count.exr", &["--shading", "coverage"]);
    assert!(exr(&folder.read("count.exr")).iter().any(|p| p[0] == 2.0 || p[0] == 1.0));
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
    assert!(jpeg(&folder.read("a.jpg"))[..3].iter().all(|&channel| channel > 250));
    // The option wins over the name.
    draw(&folder, "picture.dat", &["--picture-format", "ppm"]);
    assert!(folder.read("picture.dat").starts_with(b"P6"));
}
