//! Samples to pixels.

use crate::srgb::SRGB;
use crate::values::Size;

/// Averages squares of `oversampling` x `oversampling` samples in linear light. Samples are covered (alpha 255) or not:
/// a pixel's alpha is the covered part of it, and its colour the mean of that part.
pub(crate) fn average(samples: &[[u8; 4]], size: Size, oversampling: u32) -> Vec<[u8; 4]> {
    let srgb = &*SRGB;
    let (side, width) = (oversampling as usize, size.width as usize);
    let stride = width * side;
    let mut pixels = Vec::with_capacity(size.pixels());
    for rows in samples.chunks_exact(stride * side) {
        for x in 0..width {
            let mut sum = [0.0f32; 3];
            let mut covered = 0u32;
            for row in rows.chunks_exact(stride) {
                for &[r, g, b, a] in &row[x * side..(x + 1) * side] {
                    if a != 0 {
                        covered += 1;
                        sum[0] += srgb.decode(r);
                        sum[1] += srgb.decode(g);
                        sum[2] += srgb.decode(b);
                    }
                }
            }
            if covered == 0 {
                pixels.push([0; 4]);
            } else {
                let [r, g, b] = sum.map(|light| srgb.encode(light / covered as f32));
                let all = oversampling * oversampling;
                pixels.push([r, g, b, ((covered * 255 + all / 2) / all) as u8]);
            }
        }
    }
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: Size = Size { width: 1, height: 1 };

    #[test]
    fn resolve_of_equal_samples_is_the_sample() {
        for code in 0..=255 {
            let sample = [code, 255 - code, 7, 255];
            assert_eq!(average(&[sample; 4], ONE, 2), [sample]);
            assert_eq!(average(&[sample; 16], ONE, 4), [sample]);
        }
    }

    #[test]
    fn resolve_is_linear_in_light_and_keeps_edges_free_of_background() {
        let (black, white, none) = ([0, 0, 0, 255], [255; 4], [0; 4]);
        assert_eq!(average(&[black, white, white, black], ONE, 2), [[188, 188, 188, 255]]);
        assert_eq!(average(&[none, white, none, none], ONE, 2), [[255, 255, 255, 64]]);
        assert_eq!(average(&[none; 4], ONE, 2), [none]);
        let two = Size { width: 2, height: 1 };
        assert_eq!(average(&[white, white, none, black, white, white, none, none], two, 2), [[255; 4], [0, 0, 0, 64]]);
    }
}
