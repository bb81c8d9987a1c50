//! From the bytes of PNG, JPEG and WebP files to pixels.
//!
//! The decoders are those of the crate `image`, without it: it would bring colour management along, and JPEG's SIMD
//! code, which rounds colours differently from one processor to the next. The scalar code is the same everywhere.
//!
//! A header says how large a picture is before memory is taken for it; the limits count pixels then.

mod decode;
mod store;

pub(crate) use store::{Encoded, ImageStore};

use std::io;
use std::sync::Arc;

use crate::limits::Budget;
use crate::resolver::SideFiles;

/// The bytes of an image's file, or why not, as the end of a sentence that begins with its name.
pub(crate) fn read_file(path: &str, files: &mut SideFiles<'_>, budget: &mut Budget) -> Result<Arc<Vec<u8>>, String> {
    files.read(path, budget).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => "not found".to_owned(),
        _ => format!("cannot be read: {error}"),
    })
}
