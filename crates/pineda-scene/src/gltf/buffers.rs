//! The bytes of buffers: from files, data URIs or the GLB's binary chunk.

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::schema::{Root, Whole};
use crate::limits::Budget;
use crate::resolver::{path_inside, percent_decode, percent_decode_bytes};
use crate::text::shown;
use crate::{Error, Resolver};

/// Each buffer's bytes, or why they are not there.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    loaded: Vec<Option<Result<Vec<u8>, Error>>>,
}

impl Buffers {
    /// Reads those buffers that buffer views name. A buffer that cannot be read is an error for who needs it.
    pub(super) fn read(root: &mut Root, binary: Option<Vec<u8>>, files: &dyn Resolver, budget: &mut Budget) -> Self {
        let mut is_named = vec![false; root.buffers.len()];
        for view in root.buffer_views.iter() {
            if let Some(is_named) = is_named.get_mut(view.buffer.index()) {
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
                    Some(binary) if number == 0 => Ok(binary),
                    _ => Err(wrong(
                        number,
                        "it has neither a URI nor a GLB's binary chunk: its bytes are not in the file".to_owned(),
                    )),
                },
            }));
        }
        Self { loaded }
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
        let wrong = |message: String| Error::gltf(format!("buffer view {view}"), message);
        let definition = root.buffer_views.get(view.index()).ok_or_else(|| wrong("it does not exist".to_owned()))?;
        let buffer = self.get(definition.buffer.index())?;
        let (start, length) = (definition.byte_offset.0, definition.byte_length.0);
        let end = start.saturating_add(length);
        if end > buffer.len() as u64 {
            let (number, bytes) = (definition.buffer, buffer.len());
            return Err(wrong(format!(
                "it ends at byte {end}, but buffer {number} has only {bytes} bytes: it is cut short"
            )));
        }
        Ok(&buffer[start as usize..end as usize])
    }
}

fn wrong(number: usize, message: String) -> Error {
    Error::gltf(format!("buffer {number}"), message)
}

fn load(number: usize, uri: &str, files: &dyn Resolver, budget: &mut Budget) -> Result<Vec<u8>, Error> {
    if let Some(data) = data_uri(uri) {
        return data.map_err(|message| wrong(number, message));
    }
    let Some(path) = percent_decode(uri).as_deref().and_then(path_inside) else {
        return Err(Error::OutsideFolder { uri: shown(uri.as_bytes()) });
    };
    let side_file = |error| Error::SideFile { uri: shown(uri.as_bytes()), error };
    let bytes = files.read(&path, budget.bytes_left()).map_err(side_file)?;
    budget.add_bytes(bytes.len() as u64)?;
    Ok(bytes)
}

/// The same error once more; system errors cannot be cloned.
fn again(error: &Error) -> Error {
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
