//! KHR_meshopt_compression, and EXT_meshopt_compression, which is its older part: buffer views that are compressed.
//!
//! An own decoder by the extension's appendices: the crate `meshopt` builds C++, and `meshopt-rs` 0.1 (2021) knows the
//! first version of the format only. A stream has no length of its own; what it must have at least is checked before
//! memory is taken for what it becomes.

mod attributes;
mod filters;
mod indices;

use super::schema::Meshopt;
use crate::text::shown;

/// The bytes of a buffer view from the compressed ones; an error is the reason.
pub(super) fn decode(bytes: &[u8], layout: &Meshopt) -> Result<Vec<u8>, String> {
    let (count, stride) = (layout.count.index(), layout.byte_stride.index());
    let filter = layout.filter.as_deref().unwrap_or("NONE");
    match layout.mode.as_str() {
        "ATTRIBUTES" => {
            if stride == 0 || stride > 256 || !stride.is_multiple_of(4) {
                return Err(format!("elements of {stride} bytes: expected a multiple of 4 up to 256"));
            }
            let mut decoded = attributes::decode(bytes, count, stride)?;
            filters::apply(filter, &mut decoded, stride)?;
            Ok(decoded)
        }
        mode @ ("TRIANGLES" | "INDICES") => {
            if !matches!(stride, 2 | 4) || filter != "NONE" {
                return Err("indices have 2 or 4 bytes each, and no filter".to_owned());
            }
            let indices =
                if mode == "INDICES" { indices::sequence(bytes, count)? } else { indices::triangles(bytes, count)? };
            Ok(match stride {
                2 => indices.iter().flat_map(|&index| (index as u16).to_le_bytes()).collect(),
                _ => indices.iter().flat_map(|index| index.to_le_bytes()).collect(),
            })
        }
        mode => Err(format!("its mode {} does not exist", shown(mode.as_bytes()))),
    }
}

/// The bytes of a stream, one after the other.
struct Stream<'a>(&'a [u8]);

impl<'a> Stream<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(cut_short)?;
        self.0 = rest;
        Ok(taken)
    }

    fn byte(&mut self) -> Result<u8, String> {
        Ok(self.take(1)?[0])
    }

    /// Seven bits a byte, lowest first, the highest bit set in all but the last (unsigned LEB128).
    fn number(&mut self) -> Result<u32, String> {
        let mut number = 0;
        for shift in [0, 7, 14, 21, 28] {
            let byte = self.byte()?;
            number |= u32::from(byte & 127) << shift;
            if byte < 128 {
                return Ok(number);
            }
        }
        Err("a number of more than five bytes".to_owned())
    }

    fn end(&self) -> Result<(), String> {
        if self.0.is_empty() { Ok(()) } else { Err(format!("{} bytes too many", self.0.len())) }
    }
}

fn cut_short() -> String {
    "its compressed data are cut short".to_owned()
}

/// Signed numbers as unsigned ones: 0, -1, 1, -2, 2, ...
fn unzigzag(v: u32) -> u32 {
    (v >> 1) ^ (v & 1).wrapping_neg()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gltf::schema::Whole;
    use base64::Engine;

    /// Compressed bytes, their layout, and what they become.
    fn vectors() -> Vec<(Vec<u8>, Meshopt, Vec<u8>)> {
        let base64 = |text: &str| base64::engine::general_purpose::STANDARD.decode(text).unwrap();
        let lines = include_str!("meshopt/vectors.txt").lines().filter(|line| !line.starts_with('#'));
        let vector = |line: &str| {
            let words: Vec<&str> = line.split(' ').collect();
            let [mode, filter, count, stride, encoded, decoded] = words[..] else { panic!("{line}") };
            let number = |word: &str| Whole(word.parse().unwrap());
            let layout = Meshopt {
                buffer: Whole(0),
                byte_offset: Whole(0),
                byte_length: Whole(0),
                byte_stride: number(stride),
                count: number(count),
                mode: mode.to_owned(),
                filter: Some(filter.to_owned()),
            };
            (base64(encoded), layout, base64(decoded))
        };
        lines.map(vector).collect()
    }

    #[test]
    fn meshopt_decodes_what_the_reference_encodes() {
        let vectors = vectors();
        assert_eq!(vectors.len(), 28);
        for (number, (encoded, layout, decoded)) in vectors.iter().enumerate() {
            assert_eq!(decode(encoded, layout).as_ref(), Ok(decoded), "{number}");
        }
    }

    #[test]
    fn meshopt_streams_that_are_damaged_are_errors_or_something_else() {
        for (encoded, mut layout, decoded) in vectors() {
            for length in 0..encoded.len() {
                assert!(decode(&encoded[..length], &layout).is_err());
            }
            for at in 0..encoded.len() {
                for bits in [1, 0x10, 0xff] {
                    let mut damaged = encoded.clone();
                    damaged[at] ^= bits;
                    if let Ok(other) = decode(&damaged, &layout) {
                        assert_eq!(other.len(), decoded.len());
                    }
                }
            }
            // More than there can be is refused before memory is taken for it.
            for count in [u64::MAX, u64::MAX / 256, 3 << 40] {
                layout.count = Whole(count);
                assert!(decode(&encoded, &layout).is_err());
            }
        }
    }

    #[test]
    fn meshopt_layouts_that_do_not_exist() {
        let (encoded, layout, _) = vectors().swap_remove(0);
        let fails = |change: &dyn Fn(&mut Meshopt), says: &str| {
            let Meshopt { count, byte_stride, .. } = layout;
            let mut layout = Meshopt {
                buffer: Whole(0),
                byte_offset: Whole(0),
                byte_length: Whole(0),
                byte_stride,
                count,
                mode: "ATTRIBUTES".to_owned(),
                filter: None,
            };
            change(&mut layout);
            let error = decode(&encoded, &layout).unwrap_err();
            assert!(error.contains(says), "{error}");
        };
        fails(&|layout| layout.byte_stride = Whole(6), "multiple of 4");
        fails(&|layout| layout.byte_stride = Whole(0), "multiple of 4");
        fails(&|layout| layout.byte_stride = Whole(260), "up to 256");
        fails(&|layout| layout.mode = "SPLINES".to_owned(), "mode SPLINES");
        fails(&|layout| layout.mode = "INDICES".to_owned(), "2 or 4 bytes");
        fails(&|layout| layout.filter = Some("OCTAHEDRAL".to_owned()), "no filter OCTAHEDRAL for elements of 12");
        fails(&|layout| layout.filter = Some("BLUR".to_owned()), "no filter BLUR");
    }
}
