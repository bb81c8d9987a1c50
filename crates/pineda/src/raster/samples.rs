//! Multisampling: where the samples of a pixel lie, and which of them a draw covers.
//!
//! A sample is set up as a pixel's centre is, on a raster that is moved by as much as the sample lies off the centre: so every rule that holds for centres (the
//! fill rule, shared edges, exactness) holds for every sample, and there is one coverage kernel for all of them. Each sample has a *plane* of its own in a
//! tile's buffers: blocks of that sample of 4 x 4 pixels.

use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};

/// How many samples a pixel of a target has; their places are those of Vulkan's and Direct3D's standard patterns.
///
/// ```
/// use pineda::Samples;
/// assert_eq!(Samples::Four.count(), 4);
/// assert_eq!(Samples::Two.positions(), [[12, 12], [4, 4]]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Samples {
    /// The pixel's centre: no multisampling.
    #[default]
    One,
    /// Two.
    Two,
    /// Four: the usual choice.
    Four,
    /// Eight.
    Eight,
    /// Sixteen.
    Sixteen,
}

/// The most samples that a pixel may have.
pub(crate) const MAX_SAMPLES: usize = 16;

impl Samples {
    /// Every number of samples.
    pub const ALL: [Self; 5] = [Self::One, Self::Two, Self::Four, Self::Eight, Self::Sixteen];

    /// How many there are: 1, 2, 4, 8 or 16.
    #[must_use]
    pub const fn count(self) -> usize {
        1 << self as usize
    }

    /// Where they lie, by their numbers: in sixteenths of a pixel from its upper left corner (Vulkan 1.4, 26.6 "Multisampling"; D3D11.3, 19.2.4).
    #[must_use]
    pub const fn positions(self) -> &'static [[u8; 2]] {
        match self {
            Self::One => &[[8, 8]],
            Self::Two => &[[12, 12], [4, 4]],
            Self::Four => &[[6, 2], [14, 6], [2, 10], [10, 14]],
            Self::Eight => &[[9, 5], [7, 11], [13, 9], [5, 3], [3, 13], [1, 7], [11, 15], [15, 1]],
            Self::Sixteen => &[
                [9, 9],
                [7, 5],
                [5, 10],
                [12, 7],
                [3, 6],
                [10, 13],
                [13, 11],
                [11, 3],
                [6, 14],
                [8, 1],
                [4, 2],
                [2, 12],
                [0, 8],
                [15, 4],
                [14, 15],
                [1, 0],
            ],
        }
    }

    pub(crate) fn is_one(self) -> bool {
        self == Self::One
    }

    /// How far sample `k` lies off the pixel's centre, in subpixels: -128 to 112.
    #[inline(always)]
    pub(crate) fn offset(self, k: usize) -> [i32; 2] {
        let [x, y] = self.positions()[k];
        [i32::from(x) * (SUBPIXELS / 16) - HALF_PIXEL, i32::from(y) * (SUBPIXELS / 16) - HALF_PIXEL]
    }
}

/// A sample that a draw covers: its number, and how far it lies off the pixel's centre, in subpixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) plane: u32,
    pub(crate) offset: [i32; 2],
}

/// The samples of a pixel that a draw may cover.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampleSet {
    pub(crate) samples: Samples,
    /// A bit for each.
    pub(crate) mask: u32,
}

impl SampleSet {
    pub(crate) fn new(samples: Samples, mask: u32) -> Self {
        Self { samples, mask: mask & ((1 << samples.count()) - 1) }
    }

    /// The next of those in `rest`, which it is taken out of; `rest` begins as the mask.
    #[inline(always)]
    pub(crate) fn take(&self, rest: &mut u32) -> Option<Sample> {
        if *rest == 0 {
            return None;
        }
        let plane = rest.trailing_zeros();
        *rest &= *rest - 1;
        Some(Sample { plane, offset: self.samples.offset(plane as usize) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What multisampling takes for granted: a triangle that covers all samples of a pixel covers its centre.
    #[test]
    fn the_centre_lies_within_the_hull_of_the_samples() {
        for samples in Samples::ALL {
            let offsets: Vec<[i32; 2]> = (0..samples.count()).map(|k| samples.offset(k)).collect();
            // No direction has all samples strictly on one side; those along differences suffice, turned by a right angle.
            for a in &offsets {
                for b in offsets.iter().chain([&[0, 0]]) {
                    let normal = [a[1] - b[1], b[0] - a[0]];
                    let sides = |sign: i32| offsets.iter().any(|p| sign * (p[0] * normal[0] + p[1] * normal[1]) >= 0);
                    assert!(sides(1) && sides(-1), "{samples:?}, across {a:?} to {b:?}");
                }
            }
        }
    }
}
