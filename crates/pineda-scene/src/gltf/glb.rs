//! The GLB container (glTF 2.0 specification, 4):
//!
//! ```text
//! "glTF"  version  length      little-endian u32 each
//! length  "JSON"   bytes       the first chunk
//! length  "BIN\0"  bytes       the second chunk, if any: the buffer without a URI
//! ```

use std::ops::Range;

use crate::{Error, Format};

/// Where a file's parts are.
pub(super) struct Container {
    pub(super) json: Range<usize>,
    pub(super) binary: Option<Range<usize>>,
}

/// A file's JSON and binary chunk. A file that is not GLB is JSON.
pub(super) fn split(bytes: &[u8]) -> Result<Container, Error> {
    const HEADER: usize = 12;
    if !bytes.starts_with(b"glTF") {
        let mark = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        return Ok(Container { json: mark..bytes.len(), binary: None });
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
    let (kind, json) = chunk(bytes, HEADER)?;
    if &kind != b"JSON" {
        return Err(wrong(HEADER, "GLB's first chunk is not its JSON".to_owned()));
    }
    // Chunks of other kinds are an application's own.
    let mut at = json.end;
    while at < length {
        let (kind, data) = chunk(bytes, at)?;
        if &kind == b"BIN\0" {
            return Ok(Container { json, binary: Some(data) });
        }
        at = data.end;
    }
    Ok(Container { json, binary: None })
}

/// The chunk at `at`: its kind, and where its data are.
fn chunk(bytes: &[u8], at: usize) -> Result<([u8; 4], Range<usize>), Error> {
    let cut_short = |message: String| Error::binary(Format::Gltf, at, message);
    let (Some(length), Some(kind)) = (word(bytes, at), word(bytes, at + 4)) else {
        return Err(cut_short("the file ends within the header of a GLB chunk: it is cut short".to_owned()));
    };
    let start = at + 8;
    let end = start.saturating_add(length as usize);
    if end > bytes.len() {
        let more = bytes.len() - start;
        return Err(cut_short(format!("a GLB chunk of {length} bytes, but the file has {more} more: it is cut short")));
    }
    Ok((kind.to_le_bytes(), start..end))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|word| u32::from_le_bytes(*word))
}
