//! The sRGB curve (IEC 61966-2-1), exactly: encoding gives the code whose decoded value is nearest on the curve.
//!
//! Between codes k and k + 1 lies the threshold `decode(k + 1/2)`; the code of a value is the number of thresholds that it reaches. The
//! high bits of an f32 (exponent and seven bits of mantissa) leave at most one threshold to compare with.

use std::sync::LazyLock;

/// The curve's tables; a few kilobytes, computed on first use.
#[derive(Debug)]
pub(crate) struct Srgb {
    /// The linear value of each code, to the nearest f32.
    decoded: [f32; 256],
    /// The smallest f32 that is nearer to code k + 1 than to code k; the last is never reached.
    thresholds: [f32; 256],
    /// By the high bits of a value, the code of the smallest value that has them.
    codes: Vec<u8>,
}

/// The tables.
pub(crate) static SRGB: LazyLock<Srgb> = LazyLock::new(Srgb::new);

/// Below 2^-13 every value has code 0: the first threshold is 0.5 / 255 / 12.92, a little more.
const SMALLEST: u32 = (127 - 13) << 23;
const HIGH_BITS_SHIFT: u32 = 16;

impl Srgb {
    fn new() -> Self {
        let mut decoded = [0.0; 256];
        let mut thresholds = [f32::INFINITY; 256];
        for code in 0..256u16 {
            decoded[code as usize] = curve(f64::from(code)) as f32;
            if code < 255 {
                thresholds[code as usize] = round_up(curve(f64::from(code) + 0.5));
            }
        }
        let count = (1.0f32.to_bits() - SMALLEST) >> HIGH_BITS_SHIFT;
        let first = |k: u32| f32::from_bits(SMALLEST + (k << HIGH_BITS_SHIFT));
        let code = |x: f32| thresholds.iter().filter(|&&t| x >= t).count() as u8;
        let codes = (0..=count).map(|k| code(first(k))).collect();
        Self { decoded, thresholds, codes }
    }

    /// The linear value of a code.
    #[inline(always)]
    pub(crate) fn decode(&self, code: u8) -> f32 {
        self.decoded[usize::from(code)]
    }

    /// The linear values of all codes.
    pub(crate) fn decoded(&self) -> &[f32; 256] {
        &self.decoded
    }

    /// The nearest code; of a value below 0 or NaN 0, of a value above 1 255.
    #[inline(always)]
    pub(crate) fn encode(&self, linear: f32) -> u8 {
        // Written so that NaN becomes 0.
        let x = if linear > 0.0 { linear } else { 0.0 };
        let x = if x < 1.0 { x } else { 1.0 };
        let bits = if x.to_bits() > SMALLEST { x.to_bits() } else { SMALLEST };
        let code = self.codes[((bits - SMALLEST) >> HIGH_BITS_SHIFT) as usize];
        code + u8::from(x >= self.thresholds[usize::from(code)])
    }
}

/// From a code, or what lies between two, to linear light.
fn curve(code: f64) -> f64 {
    let v = code / 255.0;
    if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
}

/// The smallest f32 that is not below a value.
fn round_up(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) < x { f32::from_bits(nearest.to_bits() + 1) } else { nearest }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_read_back() {
        for code in 0..=255 {
            assert_eq!(SRGB.encode(SRGB.decode(code)), code);
        }
    }

    #[test]
    fn every_threshold_separates_two_codes() {
        for code in 0..255u8 {
            let threshold = SRGB.thresholds[usize::from(code)];
            assert_eq!(SRGB.encode(threshold), code + 1);
            assert_eq!(SRGB.encode(f32::from_bits(threshold.to_bits() - 1)), code);
        }
    }

    #[test]
    fn no_two_thresholds_share_their_high_bits() {
        for pair in SRGB.thresholds[..255].windows(2) {
            assert!(pair[0].to_bits() >> HIGH_BITS_SHIFT < pair[1].to_bits() >> HIGH_BITS_SHIFT);
        }
    }

    #[test]
    fn values_out_of_range_have_the_end_codes() {
        for (x, code) in [(f32::NAN, 0), (-1.0, 0), (-0.0, 0), (f32::MIN_POSITIVE, 0), (2.0, 255), (f32::INFINITY, 255)]
        {
            assert_eq!(SRGB.encode(x), code, "{x}");
        }
    }
}
