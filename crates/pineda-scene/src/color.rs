//! sRGB to linear light (IEC 61966-2-1).
//!
//! Vertex colours in OBJ, STL and PLY files and `Kd` in MTL files are what their authors picked on a screen, so they
//! are read as sRGB, as three.js, Blender and MeshLab show them. glTF's are linear by its specification.

use std::sync::OnceLock;

/// `encoded` in 0..=1; below 0 it goes on linearly, above 1 by the same power.
pub(crate) fn srgb_to_linear(encoded: f64) -> f32 {
    if encoded <= 0.04045 { (encoded / 12.92) as f32 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) as f32 }
}

/// All 256 codes of an 8-bit channel, in linear light.
pub(crate) fn srgb8_table() -> &'static [f32; 256] {
    static TABLE: OnceLock<[f32; 256]> = OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(|code| srgb_to_linear(code as f64 / 255.0)))
}

/// What the colours of a whole file, stored as floats, count to: 1 normally, 255 if any is beyond 1.
///
/// Both habits are common in OBJ and PLY files, and neither format says.
pub(crate) fn float_scale(channels: impl IntoIterator<Item = f64>) -> f64 {
    if channels.into_iter().any(|c| c.is_finite() && c > 1.0) { 255.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_ends_and_middle() {
        let table = srgb8_table();
        assert_eq!((table[0], table[255]), (0.0, 1.0));
        assert_eq!(table[1], (1.0 / 255.0 / 12.92) as f32);
        assert!((table[188] - 0.5).abs() < 0.003, "{}", table[188]);
        assert!(table.windows(2).all(|w| w[0] < w[1]));
    }

    #[test]
    fn float_scale_by_the_largest() {
        assert_eq!(float_scale([0.0, 1.0, f64::NAN]), 1.0);
        assert_eq!(float_scale([0.0, 2.0]), 255.0);
    }
}
