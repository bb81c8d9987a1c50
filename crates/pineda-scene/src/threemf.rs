//! 3MF (core specification 1.3, with colours of the materials extension and parts of the production extension): a zip
//! file of XML.
//!
//! Own readers on `zip` and `quick-xml`: the crates that read 3MF whole (`lib3mf`, `lib3mf-core`, `threemf2`) inflate
//! parts into memory however large they become. Here a part is never in memory as a whole, and what may be inflated is
//! limited.
//!
//! ```text
//! bytes -> package   the zip's parts by name, and which of them is the model
//!       -> xml       a part's elements, one after the other
//!       -> part      objects, colours, and what is to be built
//!       -> build     each item's meshes, put in place: a Scene
//! ```

mod build;
mod package;
mod part;
mod xml;

use crate::limits::Budget;
use crate::{Error, Loaded};
use package::Package;

/// Reads a 3MF file.
pub(crate) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Loaded, Error> {
    let mut package = Package::open(bytes, budget)?;
    let start = package.start()?;
    build::build(package, &start, budget)
}

/// Whether a file without a known extension is 3MF: it is zipped, and 3MF is the only such format here.
pub(crate) fn looks_like_3mf(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}
