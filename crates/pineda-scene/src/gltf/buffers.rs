//! The bytes of buffers: from files, data URIs or the GLB's binary chunk.

use std::collections::HashMap;
use std::sync::Arc;

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::meshopt;
use super::schema::{Meshopt, Root, Whole};
use crate::Error;
use crate::limits::Budget;
use crate::resolver::{SideFiles, path_inside, percent_decode, percent_decode_bytes};
use crate::text::shown;

/// Each buffer's bytes, or why they are not there.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    loaded: Vec<Option<Result<Arc<Vec<u8>>, Error>>>,
    /// The bytes of those views that are compressed.
    decoded: HashMap<usize, Result<Vec<u8>, Error>>,
}

impl Buffers {
    /// Reads those buffers that buffer views name. A buffer that cannot be read is an error for who needs it.
    pub(super) fn read(
        root: &mut Root,
        binary: Option<Vec<u8>>,
        files: &mut SideFiles<'_>,
        budget: &mut Budget,
    ) -> Self {
        let mut is_named = vec![false; root.buffers.len()];
        for view in root.buffer_views.iter() {
            // Of a view that is compressed, the buffer of its own is a copy for others.
            let buffer = view.meshopt().map_or(view.buffer, |meshopt| meshopt.buffer);
            if let Some(is_named) = is_named.get_mut(buffer.index()) {
                *is_named = true;
            }
        }
        let mut binary = binary;
        let mut loaded = Vec::with_capacity(root.buffers.len());
        for (number, (buffer, is_named)) in root.buffers.iter_mut().zip(is_named).enumerate() {
            // Not needed twice, and data URIs are long.
            let uri = buffer.uri.take();
            loaded.push(is_named.then(|| match uri {
                Some(uri) => load(number, &uri, files, budget),
                None => match binary.take() {
                    Some(binary) if number == 0 => Ok(Arc::new(binary)),
                    _ => Err(wrong(
                        number,
                        "it has neither a URI nor a GLB's binary chunk: its bytes are not in the file".to_owned(),
                    )),
                },
            }));
        }
        let mut this = Self { loaded, decoded: HashMap::new() };
        for (number, view) in root.buffer_views.iter().enumerate() {
            if let Some(meshopt) = view.meshopt() {
                let decoded = this.decode(number, meshopt, budget);
                this.decoded.insert(number, decoded);
            }
        }
        this
    }

    fn decode(&self, number: usize, layout: &Meshopt, budget: &mut Budget) -> Result<Vec<u8>, Error> {
        let place = format!("buffer view {number}");
        let bytes = self.slice(&place, layout.buffer, layout.byte_offset, layout.byte_length)?;
        budget.elements(layout.count.0.saturating_mul(layout.byte_stride.0) / BYTES_PER_ELEMENT)?;
        meshopt::decode(bytes, layout).map_err(|message| Error::gltf(place, message))
    }

    /// A buffer's bytes: those that there are, which may be more or fewer than it says.
    pub(super) fn get(&self, number: usize) -> Result<&[u8], Error> {
        match self.loaded.get(number) {
            Some(Some(Ok(bytes))) => Ok(bytes),
            Some(Some(Err(error))) => Err(again(error)),
            _ => Err(wrong(number, "a buffer view names it, but it does not exist".to_owned())),
        }
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, root: &Root, view: Whole) -> Result<&[u8], Error> {
        let place = format!("buffer view {view}");
        let Some(definition) = root.buffer_views.get(view.index()) else {
            return Err(Error::gltf(place, "it does not exist"));
        };
        match self.decoded.get(&view.index()) {
            Some(decoded) => decoded.as_deref().map_err(again),
            None => self.slice(&place, definition.buffer, definition.byte_offset, definition.byte_length),
        }
    }

    fn slice(&self, place: &str, buffer: Whole, offset: Whole, length: Whole) -> Result<&[u8], Error> {
        let bytes = self.get(buffer.index())?;
        let end = offset.0.saturating_add(length.0);
        if end > bytes.len() as u64 {
            let message =
                format!("it ends at byte {end}, but buffer {buffer} has only {} bytes: it is cut short", bytes.len());
            return Err(Error::gltf(place, message));
        }
        Ok(&bytes[offset.0 as usize..end as usize])
    }
}

/// What is decompressed counts like an accessor without data, whose elements are vectors mostly.
pub(super) const BYTES_PER_ELEMENT: u64 = 12;

fn wrong(number: usize, message: String) -> Error {
    Error::gltf(format!("buffer {number}"), message)
}

fn load(number: usize, uri: &str, files: &mut SideFiles<'_>, budget: &mut Budget) -> Result<Arc<Vec<u8>>, Error> {
    if let Some(data) = data_uri(uri) {
        return data.map(Arc::new).map_err(|message| wrong(number, message));
    }
    let Some(path) = percent_decode(uri).as_deref().and_then(path_inside) else {
        return Err(Error::OutsideFolder { uri: shown(uri.as_bytes()) });
    };
    files.read(&path, budget).map_err(|error| Error::SideFile { uri: shown(uri.as_bytes()), error })
}

/// The same error once more; system errors cannot be cloned.
pub(super) fn again(error: &Error) -> Error {
    match error {
        Error::SideFile { uri, error } => {
            Error::SideFile { uri: uri.clone(), error: std::io::Error::new(error.kind(), error.to_string()) }
        }
        Error::OutsideFolder { uri } => Error::OutsideFolder { uri: uri.clone() },
        Error::Limit { what, count, limit, field } => Error::Limit { what, count: *count, limit: *limit, field },
        Error::Gltf { place, message } => Error::gltf(place.as_str(), message.as_str()),
        other => Error::gltf("buffers", other.to_string()),
    }
}

/// `data:[type][;base64],...` decoded; `None` if it is another kind of URI.
pub(super) fn data_uri(uri: &str) -> Option<Result<Vec<u8>, String>> {
    let scheme = uri.get(..5)?;
    if !scheme.eq_ignore_ascii_case("data:") {
        return None;
    }
    let Some((media_type, data)) = uri[5..].split_once(',') else {
        return Some(Err("its data URI has no comma".to_owned()));
    };
    if !media_type.to_ascii_lowercase().ends_with(";base64") {
        return Some(Ok(percent_decode_bytes(data)));
    }
    // Some exporters leave the padding out, some have bits left over.
    let config = GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true);
    let decoded = GeneralPurpose::new(&STANDARD, config).decode(data);
    Some(decoded.map_err(|error| format!("its data URI is not base64: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_uris() {
        let of = |uri: &str| data_uri(uri).unwrap();
        assert_eq!(of("data:application/octet-stream;base64,AAEC"), Ok(vec![0, 1, 2]));
        assert_eq!(of("DATA:;BASE64,AAE="), Ok(vec![0, 1]));
        assert_eq!(of("data:;base64,AAE"), Ok(vec![0, 1]), "padding may be missing");
        assert_eq!(of("data:,a%00b"), Ok(vec![b'a', 0, b'b']));
        assert!(of("data:;base64,A*").is_err());
        assert!(of("data:nothing").is_err());
        assert!(data_uri("a.bin").is_none());
        assert!(data_uri("dät").is_none());
    }
}
