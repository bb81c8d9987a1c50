//! Formats of the depth buffer, and how depths get into them and out again.
//!
//! In a tile depths are always the bits of an f32. Those of a unorm format are f32s, too: the nearest to `code / steps`. No two of up to 2^24 codes
//! share one (they lie more than a unit in the last place apart), and so comparing the f32s compares the codes.

use crate::wide::{Simd, f32x16, f64x8};

/// The depth buffer and its format.
///
/// In the unorm formats a depth z is stored as `round(z (2^bits - 1))`, halves to even, exactly; the depth test compares what would be stored.
///
/// ```
/// use pineda::{DepthBuffer, Target};
/// let mut depth = vec![0u16; 640 * 480];
/// let target = Target { depth: DepthBuffer::D16(&mut depth), ..Target::new(640, 480) };
/// ```
#[derive(Debug, Default)]
pub enum DepthBuffer<'a> {
    /// None: depths are tested as in [`DepthBuffer::D32F`], and forgotten.
    #[default]
    None,
    /// Depth in 0 to 1 as f32.
    D32F(&'a mut [f32]),
    /// 24 bits, in the low ones of a word. The high ones are ignored when it is loaded, and 0 when it is stored.
    D24(&'a mut [u32]),
    /// 16 bits.
    D16(&'a mut [u16]),
}

impl<'a> From<&'a mut [f32]> for DepthBuffer<'a> {
    fn from(depths: &'a mut [f32]) -> Self {
        Self::D32F(depths)
    }
}

impl<'a> DepthBuffer<'a> {
    /// The same buffer, for a shorter while.
    pub(crate) fn reborrow(&mut self) -> DepthBuffer<'_> {
        match self {
            Self::None => DepthBuffer::None,
            Self::D32F(depths) => DepthBuffer::D32F(depths),
            Self::D24(depths) => DepthBuffer::D24(depths),
            Self::D16(depths) => DepthBuffer::D16(depths),
        }
    }

    pub(crate) fn format(&self) -> DepthFormat {
        match self {
            Self::None | Self::D32F(_) => DepthFormat::FLOAT,
            Self::D24(_) => DepthFormat::D24,
            Self::D16(_) => DepthFormat::D16,
        }
    }

    /// Stretches of so many pixels.
    pub(crate) fn into_chunks(self, length: usize) -> Box<dyn Iterator<Item = Self> + 'a> {
        match self {
            Self::None => Box::new(std::iter::empty()),
            Self::D32F(depths) => Box::new(depths.chunks_mut(length).map(Self::D32F)),
            Self::D24(depths) => Box::new(depths.chunks_mut(length).map(Self::D24)),
            Self::D16(depths) => Box::new(depths.chunks_mut(length).map(Self::D16)),
        }
    }

    pub(crate) fn is_none(&self) -> bool {
        matches!(self, Self::None)
    }

    /// Its elements; `None` without a buffer.
    pub(crate) fn length(&self) -> Option<usize> {
        match self {
            Self::None => None,
            Self::D32F(depths) => Some(depths.len()),
            Self::D24(depths) => Some(depths.len()),
            Self::D16(depths) => Some(depths.len()),
        }
    }
}

/// A format of [`DepthBuffer`]: the largest code of a unorm format, `None` for f32.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DepthFormat {
    steps: Option<u32>,
}

impl DepthFormat {
    pub(crate) const FLOAT: Self = Self { steps: None };
    pub(crate) const D24: Self = Self { steps: Some((1 << 24) - 1) };
    pub(crate) const D16: Self = Self { steps: Some((1 << 16) - 1) };

    pub(crate) fn is_float(self) -> bool {
        self.steps.is_none()
    }

    /// The least difference of two stored depths, of a unorm format.
    pub(crate) fn step(self) -> Option<f32> {
        self.steps.map(|steps| (1.0 / f64::from(steps)) as f32)
    }

    /// What is compared of a depth in 0 to 1.
    #[inline(always)]
    pub(crate) fn rounded(self, z: f32) -> f32 {
        if self.steps.is_some() { self.decoded(self.code(z)) } else { z }
    }

    /// A unorm format's code for a depth in 0 to 1. The product is exact in f64: 24 bits times 24.
    pub(crate) fn code(self, z: f32) -> u32 {
        (f64::from(z) * f64::from(self.steps.unwrap_or(0))).round_ties_even() as u32
    }

    /// The depth of a unorm format's code.
    pub(crate) fn decoded(self, code: u32) -> f32 {
        let steps = self.steps.unwrap_or(1);
        (code & steps) as f32 / steps as f32
    }

    /// [`Self::rounded`] in the lanes.
    #[inline(always)]
    pub(crate) fn rounded_lanes<S: Simd>(self, s: S, z: f32x16<S>) -> f32x16<S> {
        // Adding 1.5 * 2^52 leaves no bits for a fraction.
        const MAGIC: f64 = 6_755_399_441_055_744.0;
        let Some(steps) = self.steps else { return z };
        let (low, high) = z.widen();
        let scale = f64x8::splat(s, f64::from(steps));
        let low = (low * scale + MAGIC) - MAGIC;
        let high = (high * scale + MAGIC) - MAGIC;
        low.narrow(high) / f32x16::splat(s, steps as f32)
    }
}

/// A depth of the caller's, as bits. They are compared as integers, which is right for 0 to 1 only. NaN becomes 0.
pub(crate) fn loaded_depth(z: f32) -> i32 {
    if z > 0.0 { z.min(1.0).to_bits() as i32 } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::conformance::levels;
    use crate::wide::dispatch;

    #[test]
    fn every_code_is_read_back_and_no_two_share_a_depth() {
        for format in [DepthFormat::D16, DepthFormat::D24] {
            let mut before = -1.0;
            for code in 0..=format.steps.unwrap_or(0) {
                let z = format.decoded(code);
                assert!(z > before && format.code(z) == code, "{code}");
                before = z;
            }
            assert_eq!(before, 1.0);
        }
    }

    #[test]
    fn lanes_round_as_numbers_do() {
        for level in levels() {
            for format in [DepthFormat::FLOAT, DepthFormat::D16, DepthFormat::D24] {
                for k in 0..5_000u32 {
                    // All over, halves between two codes of 16 bits among them.
                    let z = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15].map(|lane: u32| match lane {
                        0 => 0.5,
                        1 => 1.0,
                        2 => 0.0,
                        _ => (k * 13 + lane) as f32 / 65_015.0 * if lane < 9 { 1.0 } else { 0.001 },
                    });
                    let mut found = [0.0; 16];
                    dispatch!(level, s => format.rounded_lanes(s, f32x16::simd_from(s, z)).store_slice(&mut found));
                    assert_eq!(found.map(f32::to_bits), z.map(|z| format.rounded(z).to_bits()), "{z:?}");
                }
            }
        }
    }
}
