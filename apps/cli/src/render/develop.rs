//! From what was drawn to what a file holds: the background goes behind it, alpha is taken out of the colours again, and codes are made.
//!
//! What is drawn over transparent black, blended or with some of a pixel's samples, has its colours multiplied by alpha: that is what adds up rightly (Porter and Duff 1984). Files have them as they are ("straight"), EXR aside.

use super::plan::Plan;
use crate::picture::Pixels;
use crate::srgb::SRGB;
use crate::values::{Background, Size};

/// Light of the studio's paper where it is brightest and where it is darkest: greys with a little blue, between which
/// white things stand out as well as dark ones.
const BRIGHT: [f32; 3] = [0.60, 0.62, 0.65];
const DARK: [f32; 3] = [0.19, 0.21, 0.245];

/// Light, 0 to 1: encoded by the sRGB curve.
pub(crate) fn light(pixels: Vec<[f32; 4]>, plan: &Plan) -> Pixels {
    develop(pixels, plan, |light| SRGB.encode(light), |light| light)
}

/// Plain numbers, 0 to 1. Where a background is mixed in, its codes are taken for such numbers.
pub(crate) fn numbers(pixels: Vec<[f32; 4]>, plan: &Plan) -> Pixels {
    // A cast of NaN or of a negative number gives 0, one of more than 255 gives 255.
    let encode = |number: f32| (number * 255.0 + 0.5) as u8;
    develop(pixels, plan, encode, |light| f32::from(SRGB.encode(light)) / 255.0)
}

fn develop(mut pixels: Vec<[f32; 4]>, plan: &Plan, encode: impl Fn(f32) -> u8, behind: impl Fn(f32) -> f32) -> Pixels {
    if plan.background == Background::Transparent {
        if plan.format.is_float() {
            return Pixels::Rgba32F(pixels);
        }
        return Pixels::Rgba8(pixels.into_iter().map(|pixel| straight(pixel, &encode)).collect());
    }
    put_behind(&mut pixels, plan.size, plan.background, behind);
    if plan.format.is_float() {
        return Pixels::Rgba32F(pixels);
    }
    Pixels::Rgb8(pixels.into_iter().map(|[r, g, b, _]| [encode(r), encode(g), encode(b)]).collect())
}

/// Alpha, and colours that are no longer multiplied by it.
fn straight([r, g, b, a]: [f32; 4], encode: impl Fn(f32) -> u8) -> [u8; 4] {
    let alpha = (a * 255.0 + 0.5) as u8;
    if alpha == 0 { [0; 4] } else { [encode(r / a), encode(g / a), encode(b / a), alpha] }
}

/// Makes pixels opaque.
fn put_behind(pixels: &mut [[f32; 4]], size: Size, background: Background, behind: impl Fn(f32) -> f32) {
    let put = |pixel: &mut [f32; 4], light: [f32; 3]| {
        let free = 1.0 - pixel[3];
        if free > 0.0 {
            (0..3).for_each(|channel| pixel[channel] += behind(light[channel]) * free);
        }
        pixel[3] = 1.0;
    };
    match background {
        Background::Transparent => {}
        Background::Color(color) => {
            let light = color.map(|code| SRGB.decode(code));
            pixels.iter_mut().for_each(|pixel| put(pixel, light));
        }
        Background::Studio => {
            for (y, row) in pixels.chunks_exact_mut(size.width as usize).enumerate() {
                let y = (y as f32 + 0.5) / size.height as f32;
                for (x, pixel) in row.iter_mut().enumerate() {
                    put(pixel, paper((x as f32 + 0.5) / size.width as f32, y));
                }
            }
        }
    }
}

/// A paper sweep lit from above: a wide pool of light a little above the middle. `x` and `y` go from 0 to 1.
fn paper(x: f32, y: f32) -> [f32; 3] {
    let (dx, dy) = ((x - 0.5) * 1.1, y - 0.42);
    let distance_squared = dx * dx + dy * dy;
    // 1 in the middle, with a soft foot.
    let pool = 1.0 / (1.0 + 2.6 * distance_squared);
    let channel = |c: usize| DARK[c] + (BRIGHT[c] - DARK[c]) * (pool * pool);
    [channel(0), channel(1), channel(2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encode(light: f32) -> u8 {
        SRGB.encode(light)
    }

    #[test]
    fn develop_takes_alpha_out_of_colours() {
        for code in 0..=255 {
            let light = SRGB.decode(code);
            for alpha in [1.0, 0.5, 0.25, 1.0 / 255.0] {
                let pixel = [light * alpha, 0.0, light * alpha, alpha];
                let wanted = [code, 0, code, (alpha * 255.0 + 0.5) as u8];
                assert_eq!(straight(pixel, encode), wanted, "{code} {alpha}");
            }
        }
        assert_eq!(straight([0.001, 0.001, 0.001, 0.001], encode), [0; 4], "no colour without alpha");
    }

    #[test]
    fn develop_puts_colours_behind_as_given() {
        let size = Size { width: 2, height: 1 };
        for code in 0..=255 {
            let mut pixels = [[0.0; 4], [0.25, 0.5, 0.75, 1.0]];
            put_behind(&mut pixels, size, Background::Color([code; 3]), |light| light);
            assert_eq!(pixels[0].map(encode), [code, code, code, 255]);
            assert_eq!(pixels[1], [0.25, 0.5, 0.75, 1.0], "what is opaque stays");
        }
        // Half of white before black is half the light.
        let mut pixels = [[0.5, 0.5, 0.5, 0.5]; 2];
        put_behind(&mut pixels, size, Background::Color([0; 3]), |light| light);
        assert_eq!(pixels[0].map(encode), [188, 188, 188, 255]);
    }
}
