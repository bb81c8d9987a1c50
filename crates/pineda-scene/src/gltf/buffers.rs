//! The bytes of buffers: from files, data URIs or the GLB's binary chunk, each when it is first asked for.

use std::borrow::Cow;
use std::cell::OnceCell;

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::schema::Buffer;
use crate::limits::Budget;
use crate::resolver::{path_inside, percent_decode, percent_decode_bytes};
use crate::text::shown;
use crate::{Error, Resolver};

pub(super) struct Buffers<'a> {
    definitions: &'a [Buffer],
    binary: Option<&'a [u8]>,
    files: &'a dyn Resolver,
    loaded: Vec<OnceCell<Cow<'a, [u8]>>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(definitions: &'a [Buffer], binary: Option<&'a [u8]>, files: &'a dyn Resolver) -> Self {
        Self { definitions, binary, files, loaded: definitions.iter().map(|_| OnceCell::new()).collect() }
    }

    /// A buffer's bytes: those that there are, which may be more or fewer than it says.
    pub(super) fn get(&self, number: usize, budget: &mut Budget) -> Result<&[u8], Error> {
        let Some(cell) = self.loaded.get(number) else {
            return Err(Error::gltf(format!("buffer {number}"), "a buffer view names it, but it does not exist"));
        };
        if let Some(bytes) = cell.get() {
            return Ok(bytes);
        }
        let bytes = self.load(number, budget)?;
        Ok(cell.get_or_init(|| bytes))
    }

    fn load(&self, number: usize, budget: &mut Budget) -> Result<Cow<'a, [u8]>, Error> {
        let wrong = |message: String| Error::gltf(format!("buffer {number}"), message);
        let Some(uri) = &self.definitions[number].uri else {
            return match self.binary {
                Some(binary) if number == 0 => Ok(Cow::Borrowed(binary)),
                _ => Err(wrong(
                    "it has neither a URI nor a GLB's binary chunk: its bytes are not in the file".to_owned(),
                )),
            };
        };
        if let Some(data) = data_uri(uri) {
            return data.map(Cow::Owned).map_err(wrong);
        }
        let Some(path) = percent_decode(uri).as_deref().and_then(path_inside) else {
            return Err(Error::OutsideFolder { uri: shown(uri.as_bytes()) });
        };
        let side_file = |error| Error::SideFile { uri: shown(uri.as_bytes()), error };
        let bytes = self.files.read(&path, budget.bytes_left()).map_err(side_file)?;
        budget.add_bytes(bytes.len() as u64)?;
        Ok(Cow::Owned(bytes))
    }
}

/// `data:[type][;base64],...` decoded; `None` if it is another kind of URI.
fn data_uri(uri: &str) -> Option<Result<Vec<u8>, String>> {
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
