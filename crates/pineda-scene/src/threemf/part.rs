//! A model part's XML: its objects, their colours, and what is to be built of them.

use std::collections::{BTreeSet, HashMap};
use std::io::BufRead;

use super::xml::{Element, Xml};
use crate::Error;
use crate::color::srgb8_table;
use crate::gltf::Affine;
use crate::text::{float, shown};

/// What a part holds.
#[derive(Default)]
pub(super) struct Part {
    pub(super) objects: HashMap<u32, Object>,
    /// Of base materials and groups of colours, by the numbers of these: linear light, straight alpha.
    pub(super) colors: HashMap<u32, Vec<[f32; 4]>>,
    /// What is to be built.
    pub(super) items: Vec<Instance>,
    /// Names of elements that were passed over, with their extensions' prefixes.
    pub(super) skipped: BTreeSet<String>,
}

#[derive(Default)]
pub(super) struct Object {
    pub(super) name: String,
    /// The colour of what has none of its own: where it is, and its number there.
    pub(super) color: (Option<u32>, u32),
    pub(super) positions: Vec<[f32; 3]>,
    /// In range of the positions.
    pub(super) triangles: Vec<[u32; 3]>,
    /// In the order of the triangles; not each has one.
    pub(super) painted: Vec<Painted>,
    /// Other objects that this one is made of.
    pub(super) components: Vec<Instance>,
}

/// The colours of a triangle's corners.
pub(super) struct Painted {
    pub(super) triangle: u32,
    /// Where they are; `None`: where the object's is.
    pub(super) colors: Option<u32>,
    pub(super) corners: [u32; 3],
}

/// An object in a place.
pub(super) struct Instance {
    /// The part that has it; `None`: this one.
    pub(super) part: Option<String>,
    pub(super) object: u32,
    pub(super) place: Affine,
}

/// Extensions without which a model can be shown as it is meant.
const SUPPORTED: [&str; 3] = [
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07",
];

impl Part {
    pub(super) fn read<R: BufRead>(mut xml: Xml<R>) -> Result<Self, Error> {
        let mut part = Self::default();
        let mut is_model = false;
        while let Some(element) = xml.open()? {
            if element.name() != "model" {
                return Err(element.wrong("expected <model>: is it 3MF?".to_owned()));
            }
            check_required(&element)?;
            is_model = true;
            part.read_model(&mut xml)?;
        }
        if is_model { Ok(part) } else { Err(xml.wrong("it has no <model>: it is cut short, or not 3MF")) }
    }

    fn read_model<R: BufRead>(&mut self, xml: &mut Xml<R>) -> Result<(), Error> {
        while let Some(element) = xml.open()? {
            match element.name() {
                "resources" => self.read_resources(xml)?,
                "build" => {
                    while let Some(element) = xml.open()? {
                        if element.name() == "item" {
                            self.items.push(instance(&element)?);
                        }
                        xml.skip()?;
                    }
                }
                "metadata" | "metadatagroup" => xml.skip()?,
                _ => self.skip(xml, None)?,
            }
        }
        Ok(())
    }

    fn read_resources<R: BufRead>(&mut self, xml: &mut Xml<R>) -> Result<(), Error> {
        while let Some(element) = xml.open()? {
            match element.name() {
                "object" => {
                    let number = element.needed_index("id")?;
                    let object = Object {
                        name: shown(element.attribute("name")?.unwrap_or_default().as_bytes()),
                        color: (element.index("pid")?, element.index("pindex")?.unwrap_or(0)),
                        ..Object::default()
                    };
                    let object = self.read_object(object, number, xml)?;
                    self.objects.insert(number, object);
                }
                "basematerials" => {
                    let number = element.needed_index("id")?;
                    let colors = read_colors(xml, "base", "displaycolor")?;
                    self.colors.insert(number, colors);
                }
                "colorgroup" => {
                    let number = element.needed_index("id")?;
                    let colors = read_colors(xml, "color", "color")?;
                    self.colors.insert(number, colors);
                }
                _ => {
                    let name = shown(element.full_name().as_bytes());
                    self.skip(xml, Some(name))?;
                }
            }
        }
        Ok(())
    }

    fn read_object<R: BufRead>(&mut self, mut object: Object, number: u32, xml: &mut Xml<R>) -> Result<Object, Error> {
        while let Some(element) = xml.open()? {
            match element.name() {
                "mesh" => self.read_mesh(&mut object, xml)?,
                "components" => {
                    while let Some(element) = xml.open()? {
                        if element.name() == "component" {
                            object.components.push(instance(&element)?);
                        }
                        xml.skip()?;
                    }
                }
                "metadatagroup" => xml.skip()?,
                _ => {
                    let name = shown(element.full_name().as_bytes());
                    self.skip(xml, Some(name))?;
                }
            }
        }
        let count = object.positions.len();
        let names_none = |triangle: &[u32; 3]| triangle.iter().copied().find(|&v| v as usize >= count);
        let bad = object.triangles.iter().enumerate().find_map(|(t, triangle)| Some((t, names_none(triangle)?)));
        match bad {
            None => Ok(object),
            Some((triangle, vertex)) => {
                let message = format!("it names vertex {vertex}, but the object has {count} vertices");
                Err(Error::threemf(format!("object {number}, triangle {triangle} (from 0)"), message))
            }
        }
    }

    fn read_mesh<R: BufRead>(&mut self, object: &mut Object, xml: &mut Xml<R>) -> Result<(), Error> {
        while let Some(element) = xml.open()? {
            match element.name() {
                "vertices" => {
                    while let Some(vertex) = xml.open()? {
                        if vertex.name() == "vertex" {
                            let [x, y, z] = ["x", "y", "z"].map(|name| vertex.needed_number(name));
                            object.positions.push([x?, y?, z?]);
                        }
                        xml.skip()?;
                    }
                }
                "triangles" => {
                    while let Some(triangle) = xml.open()? {
                        if triangle.name() == "triangle" {
                            read_triangle(object, &triangle)?;
                        }
                        xml.skip()?;
                    }
                }
                // Names for some of the triangles.
                "trianglesets" => xml.skip()?,
                _ => {
                    let name = shown(element.full_name().as_bytes());
                    self.skip(xml, Some(name))?;
                }
            }
        }
        Ok(())
    }

    /// Passes over an element, and remembers its name.
    fn skip<R: BufRead>(&mut self, xml: &mut Xml<R>, name: Option<String>) -> Result<(), Error> {
        /// As many as one line holds.
        const MOST: usize = 12;
        if let Some(name) = name.filter(|_| self.skipped.len() < MOST) {
            self.skipped.insert(name);
        }
        xml.skip()
    }
}

fn read_triangle(object: &mut Object, triangle: &Element<'_>) -> Result<(), Error> {
    let [a, b, c] = ["v1", "v2", "v3"].map(|name| triangle.needed_index(name));
    let corners = [a?, b?, c?];
    // What is missing is the first corner's; without that the triangle has the object's colour.
    if let Some(first) = triangle.index("p1")? {
        object.painted.push(Painted {
            triangle: object.triangles.len() as u32,
            colors: triangle.index("pid")?,
            corners: [first, triangle.index("p2")?.unwrap_or(first), triangle.index("p3")?.unwrap_or(first)],
        });
    }
    object.triangles.push(corners);
    Ok(())
}

/// The colours of a group, in its order.
fn read_colors<R: BufRead>(xml: &mut Xml<R>, name: &str, attribute: &str) -> Result<Vec<[f32; 4]>, Error> {
    let mut colors = Vec::new();
    while let Some(element) = xml.open()? {
        if element.name() == name {
            colors.push(element.needed(attribute, "a colour, #RRGGBB or #RRGGBBAA", color)?);
        }
        xml.skip()?;
    }
    Ok(colors)
}

/// sRGB codes, and alpha.
fn color(text: &str) -> Option<[f32; 4]> {
    let digits = text.strip_prefix('#')?;
    let is_whole = matches!(digits.len(), 6 | 8) && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    let code = |at: usize| u8::from_str_radix(digits.get(at..at + 2)?, 16).ok();
    let [r, g, b] = [code(0)?, code(2)?, code(4)?].map(|code| srgb8_table()[usize::from(code)]);
    let alpha = f32::from(code(6).unwrap_or(255)) / 255.0;
    is_whole.then_some([r, g, b, alpha])
}

fn instance(element: &Element<'_>) -> Result<Instance, Error> {
    let place = element.parsed("transform", "twelve numbers", transform)?;
    Ok(Instance {
        part: element.attribute("path")?.map(|path| path.into_owned()),
        object: element.needed_index("objectid")?,
        place: place.unwrap_or(Affine::IDENTITY),
    })
}

/// Four rows of three: what becomes of x, y and z, and the translation.
fn transform(text: &str) -> Option<Affine> {
    let mut words = text.split_ascii_whitespace();
    let mut columns = [0.0; 16];
    for row in 0..4 {
        for column in 0..3 {
            columns[4 * row + column] = words.next().and_then(|word| float(word.as_bytes()))?;
        }
    }
    columns[15] = 1.0;
    words.next().is_none().then(|| Affine::from_columns(&columns))
}

/// Refuses a model that requires an extension that is not supported.
fn check_required(model: &Element<'_>) -> Result<(), Error> {
    let Some(required) = model.attribute("requiredextensions")? else { return Ok(()) };
    for prefix in required.split_ascii_whitespace() {
        let namespace = model.namespace(prefix)?;
        let namespace = namespace.as_deref().unwrap_or(prefix);
        if !SUPPORTED.contains(&namespace) {
            let name = shown(namespace.as_bytes());
            let message = format!("it requires the extension {name}, which cannot be read: export it without");
            return Err(model.wrong(message));
        }
    }
    Ok(())
}
