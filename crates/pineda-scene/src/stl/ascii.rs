//! ASCII STL:
//!
//! ```text
//! solid NAME
//!   facet normal x y z
//!     outer loop
//!       vertex x y z        three times; more are a polygon
//!     endloop
//!   endfacet
//! endsolid NAME
//! ```
//!
//! Keywords in any case, any white space between words, several solids in a file. The name is optional and may have
//! several words.

use crate::limits::Budget;
use crate::polygon::{self, Polygons};
use crate::text::{Syntax, Text, float32, shown};
use crate::{Error, Format, Loaded, Material, Object, Scene, Vertex};

pub(super) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Loaded, Error> {
    let mut reader = Reader { text: Text::new(bytes, Syntax::Plain), solids: Vec::new(), facet: Vec::new() };
    while let Some(keyword) = reader.text.word_on_any_line() {
        reader.statement(keyword, budget)?;
    }
    let mut notes = Vec::new();
    let (mut too_small, mut gave_up) = (0, 0);
    let mut objects = Vec::new();
    for Solid { name, positions, facets } in reader.solids {
        too_small += facets.too_small;
        if facets.is_empty() {
            continue;
        }
        budget.objects(1)?;
        let (triangles, fans) = facets.triangulate(|i: u32| positions[i as usize], budget)?;
        gave_up += fans;
        let vertices = positions.into_iter().map(Vertex::at).collect();
        objects.push(Object { name: name.into(), vertices, triangles, ..Object::default() });
    }
    polygon::notes(too_small, gave_up, &mut notes);
    Ok(Loaded { scene: Scene { objects, materials: vec![Material::default()], ..Scene::default() }, notes })
}

/// A word in lower case, in `buffer`; nothing if it is longer than any keyword.
fn lowercase<'b>(word: &[u8], buffer: &'b mut [u8; 8]) -> &'b [u8] {
    let Some(lower) = buffer.get_mut(..word.len()) else { return b"" };
    lower.copy_from_slice(word);
    lower.make_ascii_lowercase();
    lower
}

struct Reader<'a> {
    text: Text<'a>,
    solids: Vec<Solid>,
    /// The vertices of the facet that is being read.
    facet: Vec<[f32; 3]>,
}

#[derive(Default)]
struct Solid {
    name: String,
    positions: Vec<[f32; 3]>,
    facets: Polygons<u32>,
}

impl Reader<'_> {
    fn statement(&mut self, keyword: &[u8], budget: &mut Budget) -> Result<(), Error> {
        match lowercase(keyword, &mut [0; 8]) {
            b"solid" => {
                let name = self.solid_name();
                self.solids.push(Solid { name, ..Solid::default() });
                self.facet.clear();
            }
            b"facet" => self.facet.clear(),
            b"vertex" => {
                let position = self.position()?;
                budget.vertices(1)?;
                self.facet.push(position);
            }
            b"endloop" => self.end_facet(),
            b"endsolid" => {
                // The name, unless the next solid is on the same line. Should "solid" be part of the name, that makes a
                // solid without facets, which is passed over.
                while let Some(word) = self.text.word() {
                    if word.eq_ignore_ascii_case(b"solid") {
                        return self.statement(word, budget);
                    }
                }
            }
            // "outer loop", "endfacet" and a facet's normal.
            b"outer" | b"loop" | b"endfacet" | b"normal" => {}
            _ if float32(keyword).is_some() => {}
            _ => {
                let expected = "expected solid, facet, outer loop, vertex, endloop, endfacet or endsolid";
                let message = format!("'{}' is not a word of STL: {expected}", shown(keyword));
                return Err(Error::text(Format::Stl, self.text.line(), message));
            }
        }
        Ok(())
    }

    /// The words up to the end of the line, or up to `facet normal` if the whole file is on one line.
    fn solid_name(&mut self) -> String {
        let mut name = Vec::new();
        while let Some(word) = self.text.word() {
            if word.eq_ignore_ascii_case(b"normal")
                && name.last().is_some_and(|last: &&[u8]| last.eq_ignore_ascii_case(b"facet"))
            {
                name.pop();
                break;
            }
            name.push(word);
        }
        shown(&name.join(&b' '))
    }

    fn position(&mut self) -> Result<[f32; 3], Error> {
        let mut position = [0.0; 3];
        for coordinate in &mut position {
            let word = self.text.word_on_any_line();
            *coordinate = word.and_then(float32).ok_or_else(|| {
                let found = word.map_or("the end of the file".to_owned(), |w| format!("'{}'", shown(w)));
                let message = format!("a vertex needs three numbers, found {found}");
                Error::text(Format::Stl, self.text.line(), message)
            })?;
        }
        Ok(position)
    }

    fn end_facet(&mut self) {
        if self.solids.is_empty() {
            self.solids.push(Solid::default());
        }
        let solid = self.solids.last_mut().expect("pushed where there was none");
        let first = solid.positions.len() as u32;
        solid.positions.append(&mut self.facet);
        solid.facets.push(first..solid.positions.len() as u32);
    }
}
