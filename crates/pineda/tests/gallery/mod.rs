//! The pictures of docs/examples.md are what the examples draw, half as large.
//!
//! `PINEDA_BLESS=1 cargo test --release -p pineda --test example_pictures --test tutorials` writes them anew.

use png::{BitDepth, ColorType, Compression, Decoder, Encoder};
use std::fs::{File, read_to_string};
use std::io::BufReader;
use std::path::PathBuf;

/// Pixels across and down of what examples draw.
const SIZE: usize = 512;

fn docs() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

/// That an example has its place in the gallery, and its picture there is this one.
pub(crate) fn check(name: &str, pixels: &[[u8; 4]]) {
    let page = read_to_string(docs().join("examples.md")).expect("docs/examples.md");
    assert!(page.contains(&format!("](examples/{name}.png)")), "docs/examples.md does not show {name}");
    let path = docs().join(format!("examples/{name}.png"));
    let picture = halved(pixels);
    if std::env::var_os("PINEDA_BLESS").is_some() {
        let mut png = Encoder::new(File::create(&path).expect("a file"), SIZE as u32 / 2, SIZE as u32 / 2);
        png.set_color(ColorType::Rgb);
        png.set_compression(Compression::High);
        png.write_header().and_then(|mut png| png.write_image_data(&picture)).expect("a picture");
    }
    let file = File::open(&path).unwrap_or_else(|error| panic!("{}: {error}: bless it", path.display()));
    let mut png = Decoder::new(BufReader::new(file)).read_info().expect("a PNG");
    assert_eq!(png.info().color_type, ColorType::Rgb);
    assert_eq!(png.info().bit_depth, BitDepth::Eight);
    let mut shown = vec![0; png.output_buffer_size().expect("small")];
    png.next_frame(&mut shown).expect("a PNG");
    assert!(shown == picture, "{} is not what the example {name} draws: look, and bless it", path.display());
}

/// Red, green and blue; each pixel the mean of four.
fn halved(pixels: &[[u8; 4]]) -> Vec<u8> {
    assert_eq!(pixels.len(), SIZE * SIZE);
    let mut picture = Vec::new();
    for (y, x) in (0..SIZE).step_by(2).flat_map(|y| (0..SIZE).step_by(2).map(move |x| (y, x))) {
        let four = [0, 1, SIZE, SIZE + 1].map(|next| pixels[y * SIZE + x + next]);
        picture.extend([0, 1, 2].map(|k| (four.iter().map(|pixel| u32::from(pixel[k])).sum::<u32>() / 4) as u8));
    }
    picture
}
