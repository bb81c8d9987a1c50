//! STL, ASCII and binary. Always flat: the normals in the file are those of the facets, at best, and are not read.
//!
//! Own readers: `stl_io` 0.11 welds vertices, merges the solids of an ASCII file and drops a binary file's colours.

mod ascii;
mod binary;

use crate::limits::Budget;
use crate::{Error, Loaded};

/// Reads an STL file of either kind.
pub(crate) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Loaded, Error> {
    if is_ascii(bytes) { ascii::read(bytes, budget) } else { binary::read(bytes, budget) }
}

/// Whether a file without a known extension is STL.
pub(crate) fn looks_like_stl(bytes: &[u8]) -> bool {
    binary::has_the_right_length(bytes) || is_ascii(bytes)
}

/// Many binary files begin with "solid", too, so their length is asked first.
fn is_ascii(bytes: &[u8]) -> bool {
    /// Enough for the longest first line and white space behind it.
    const HEAD: usize = 4096;
    if binary::has_the_right_length(bytes) {
        return false;
    }
    let head = &bytes[..bytes.len().min(HEAD)];
    let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start().to_ascii_lowercase();
    head.starts_with(b"solid") && !head.contains(&0)
}
