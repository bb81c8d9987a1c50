//! A product picture: a model, or the demo scene, in the studio.
//!
//! `cargo run --release -p pineda-looks --example product -- [MODEL [OUT.png]]`

use pineda::{Renderer, Settings};
use pineda_looks::Stage;
use pineda_looks::pbr::{self, Environment, PbrSettings};
use pineda_scene::{Bounds, Framing, View};
use std::fs::File;
use std::time::Instant;

const SIZE: u32 = 768;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut scene = match arguments.next() {
        Some(path) => pineda_scene::load(path)?.scene,
        None => pineda_scene::demo(),
    };
    let path = arguments.next().unwrap_or("product.png".into());
    let bounds = Bounds::of(&scene).ok_or("nothing to draw")?;
    let framing = Framing::new(&bounds, &View::default())?;
    let start = Instant::now();
    let mut renderer = Renderer::new(Settings::default())?;
    let environment = Environment::studio()?;
    println!("environment {:?}", start.elapsed());
    let start = Instant::now();
    let stage = Stage::new(&mut scene, &framing, 1.0, 40.0).ok_or("nothing to draw")?;
    let pixels = pbr::draw(&stage, &scene, &environment, &PbrSettings::default(), [SIZE; 2], &mut renderer)?;
    println!("picture {:?}", start.elapsed());
    let bytes: Vec<u8> = pixels
        .iter()
        .flat_map(|&[r, g, b, a]| {
            let encode = |x: f32| {
                let v = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
                (v * 255.0 + 0.5) as u8
            };
            [r, g, b].map(|c| encode(c + 0.75 * (1.0 - a)))
        })
        .collect();
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgb);
    png.write_header()?.write_image_data(&bytes)?;
    Ok(())
}
