//! The sRGB curve (IEC 61966-2-1) between 8-bit codes and linear light: exact both ways, so an average of equal codes is that code.

use std::sync::LazyLock;

/// Both directions as tables.
pub(crate) static SRGB: LazyLock<Srgb> = LazyLock::new(Srgb::new);

pub(crate) struct Srgb {
    decoded: [f32; 256],
    /// Where each code's successor begins: the light of the code plus a half. 255 has none.
    thresholds: [f32; 256],
    /// For each 4096th of the range the code that it begins with. Codes are at least 1 / (12.92 x 255) wide, which is more: at most one begins within it.
    start: [u8; Self::STEPS + 1],
}

impl Srgb {
    const STEPS: usize = 4096;

    fn new() -> Self {
        let mut thresholds: [f32; 256] = std::array::from_fn(|code| linear(code as f64 + 0.5) as f32);
        thresholds[255] = f32::INFINITY;
        Self {
            decoded: std::array::from_fn(|code| linear(code as f64) as f32),
            thresholds,
            start: std::array::from_fn(|step| {
                thresholds.partition_point(|&threshold| threshold <= step as f32 / Self::STEPS as f32) as u8
            }),
        }
    }

    /// The light of a code, 0 to 1.
    #[inline]
    pub(crate) fn decode(&self, code: u8) -> f32 {
        self.decoded[usize::from(code)]
    }

    /// The nearest code to a light, which is clamped to 0 to 1.
    #[inline]
    pub(crate) fn encode(&self, light: f32) -> u8 {
        // A cast of NaN or of a negative number gives 0.
        let step = ((light * Self::STEPS as f32) as usize).min(Self::STEPS);
        let code = self.start[step];
        // 255, whose threshold is infinite, is the most that the table has; infinite light must not go beyond.
        code.saturating_add(u8::from(light >= self.thresholds[usize::from(code)]))
    }
}

/// The light of a code; `code` need not be whole.
fn linear(code: f64) -> f64 {
    let x = code / 255.0;
    if x <= 0.04045 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_codes_come_back() {
        for code in 0..=255 {
            assert_eq!(SRGB.encode(SRGB.decode(code)), code);
        }
    }

    #[test]
    fn srgb_encodes_to_the_nearest_code_and_clamps() {
        for code in 0..255u8 {
            let threshold = SRGB.thresholds[usize::from(code)];
            assert_eq!(SRGB.encode(threshold), code + 1);
            assert_eq!(SRGB.encode(threshold.next_down()), code);
        }
        assert_eq!([-1.0, f32::NAN, 2.0, f32::INFINITY].map(|x| SRGB.encode(x)), [0, 0, 255, 255]);
    }
}
