//! What is behind the model.

use crate::picture::Pixels;
use crate::srgb::SRGB;
use crate::values::{Background, Size};

/// Light of the studio's paper where it is brightest and where it is darkest: greys with a little blue, between which
/// white things stand out as well as dark ones.
const BRIGHT: [f32; 3] = [0.60, 0.62, 0.65];
const DARK: [f32; 3] = [0.19, 0.21, 0.245];

/// Puts a background behind pixels with straight alpha, in linear light.
pub(crate) fn behind(pixels: Vec<[u8; 4]>, size: Size, background: Background) -> Pixels {
    match background {
        Background::Transparent => Pixels::Rgba8(pixels),
        Background::Color(color) => {
            let light = color.map(|code| SRGB.decode(code));
            Pixels::Rgb8(pixels.into_iter().map(|pixel| over(pixel, light)).collect())
        }
        Background::Studio => {
            let rows = pixels.chunks_exact(size.width as usize).enumerate();
            let mut out = Vec::with_capacity(pixels.len());
            for (y, row) in rows {
                let y = (y as f32 + 0.5) / size.height as f32;
                for (x, &pixel) in row.iter().enumerate() {
                    let x = (x as f32 + 0.5) / size.width as f32;
                    out.push(if pixel[3] == 255 { [pixel[0], pixel[1], pixel[2]] } else { over(pixel, paper(x, y)) });
                }
            }
            Pixels::Rgb8(out)
        }
    }
}

/// A paper sweep lit from above: a wide pool of light a little above the middle. `x` and `y` go from 0 to 1.
fn paper(x: f32, y: f32) -> [f32; 3] {
    let (dx, dy) = ((x - 0.5) * 1.1, y - 0.42);
    let distance_squared = dx * dx + dy * dy;
    // 1 in the middle, with a soft foot.
    let pool = 1.0 / (1.0 + 2.6 * distance_squared);
    [0, 1, 2].map(|c| DARK[c] + (BRIGHT[c] - DARK[c]) * (pool * pool))
}

fn over([r, g, b, a]: [u8; 4], behind: [f32; 3]) -> [u8; 3] {
    match a {
        255 => [r, g, b],
        _ => {
            let alpha = f32::from(a) / 255.0;
            let light = [r, g, b].map(|code| SRGB.decode(code));
            [0, 1, 2].map(|c| SRGB.encode(light[c] * alpha + behind[c] * (1.0 - alpha)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn background_colors_come_out_as_given() {
        for code in 0..=255 {
            let Pixels::Rgb8(out) =
                behind(vec![[9, 9, 9, 0], [1, 2, 3, 255]], Size { width: 2, height: 1 }, Background::Color([code; 3]))
            else {
                panic!("a coloured background is opaque")
            };
            assert_eq!(out, [[code; 3], [1, 2, 3]]);
        }
    }
}
