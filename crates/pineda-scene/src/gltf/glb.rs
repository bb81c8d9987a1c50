//! The GLB container (glTF 2.0 specification, 4):
//!
//! ```text
//! "glTF"  version  length      little-endian u32 each
//! length  "JSON"   bytes       the first chunk
//! length  "BIN\0"  bytes       the second chunk, if any: the buffer without a URI
//! ```

use crate::{Error, Format};

pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary: Option<&'a [u8]>,
}

/// A file's JSON and binary chunk. A file that is not GLB is JSON.
pub(super) fn split(bytes: &[u8]) -> Result<Container<'_>, Error> {
    const HEADER: usize = 12;
    if !bytes.starts_with(b"glTF") {
        let json = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        return Ok(Container { json, binary: None });
    }
    let wrong = |offset: usize, message: String| Error::binary(Format::Gltf, offset, message);
    let cut_short = || wrong(bytes.len(), "the file ends within GLB's header: it is cut short".to_owned());
    let version = word(bytes, 4).ok_or_else(cut_short)?;
    let length = word(bytes, 8).ok_or_else(cut_short)? as usize;
    if version != 2 {
        return Err(wrong(
            4,
            format!("GLB of version {version}: only version 2 can be read; export the model as glTF 2.0"),
        ));
    }
    if length > bytes.len() {
        let message = format!("the file should have {length} bytes but has {}: it is cut short", bytes.len());
        return Err(wrong(8, message));
    }
    let (kind, json, behind) = chunk(bytes, HEADER)?;
    if &kind != b"JSON" {
        return Err(wrong(HEADER, "GLB's first chunk is not its JSON".to_owned()));
    }
    // Chunks of other kinds are an application's own.
    let mut at = behind;
    while at < length {
        let (kind, data, behind) = chunk(bytes, at)?;
        if &kind == b"BIN\0" {
            return Ok(Container { json, binary: Some(data) });
        }
        at = behind;
    }
    Ok(Container { json, binary: None })
}

/// The chunk at `at`: its kind, its data, and where the next one begins.
fn chunk(bytes: &[u8], at: usize) -> Result<([u8; 4], &[u8], usize), Error> {
    let cut_short = |message: String| Error::binary(Format::Gltf, at, message);
    let (Some(length), Some(kind)) = (word(bytes, at), word(bytes, at + 4)) else {
        return Err(cut_short("the file ends within the header of a GLB chunk: it is cut short".to_owned()));
    };
    let start = at + 8;
    let end = start.saturating_add(length as usize);
    let data = bytes.get(start..end).ok_or_else(|| {
        cut_short(format!(
            "a GLB chunk of {length} bytes, but the file has {} more: it is cut short",
            bytes.len() - start
        ))
    })?;
    Ok((kind.to_le_bytes(), data, end))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|word| u32::from_le_bytes(*word))
}
