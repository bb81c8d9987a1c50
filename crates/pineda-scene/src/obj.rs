//! Wavefront OBJ and its MTL material libraries.
//!
//! Own readers: `tobj` 4.0 fans concave polygons, refuses the line continuation `\`, comments behind a face and files
//! in which only some vertices have colours, and its errors do not name a line.

mod build;
mod maps;
mod mtl;
mod parse;

use std::collections::{HashMap, HashSet};

use crate::image::read_file;
use crate::limits::Budget;
use crate::resolver::{SideFiles, path_inside};
use crate::{Error, Loaded, Resolver};
use mtl::Library;

/// Reads an OBJ file and the material libraries that it names.
///
/// A library that is not there, or not where it may be, costs the colours, not the picture.
pub(crate) fn read(bytes: &[u8], files: &dyn Resolver, budget: &mut Budget) -> Result<Loaded, Error> {
    let file = parse::parse(bytes, budget)?;
    let mut notes = Vec::new();
    let mut library = Library::default();
    let mut side_files = SideFiles::new(files);
    // A library is read once, however often it is named.
    let mut known = HashSet::new();
    for names in &file.libraries {
        for name in library_names(names, &mut side_files, budget) {
            let path = path_inside(&name);
            if !known.insert(path.clone().unwrap_or_else(|| name.clone())) {
                continue;
            }
            let outside = || "is outside the model's folder, so it is not read".to_owned();
            match path.ok_or_else(outside).and_then(|path| read_file(&path, &mut side_files, budget)) {
                Ok(bytes) => library.parse(&name, &bytes),
                Err(reason) => notes.push(format!("material library '{name}' {reason}")),
            }
        }
    }
    build::build(file, library, notes, files, budget)
}

/// `mtllib` takes several names, but exporters also write one name with spaces in it: that one, if it is there.
fn library_names(names: &str, files: &mut SideFiles<'_>, budget: &mut Budget) -> Vec<String> {
    let mut is_there = |name: &str| path_inside(name).is_some_and(|path| files.read(&path, budget).is_ok());
    if !names.contains(char::is_whitespace) || is_there(names) {
        vec![names.to_owned()]
    } else {
        names.split_whitespace().map(str::to_owned).collect()
    }
}

/// Numbers names in the order in which they come.
#[derive(Default)]
struct Names {
    numbers: HashMap<String, usize>,
    names: Vec<String>,
}

impl Names {
    fn number(&mut self, name: String) -> usize {
        *self.numbers.entry(name).or_insert_with_key(|name| {
            self.names.push(name.clone());
            self.names.len() - 1
        })
    }
}
