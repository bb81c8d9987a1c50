//! The element `vertex`: positions, normals, colours, texture coordinates.

use super::header::{Element, Kind};
use super::source::Source;
use crate::color::{float_scale, srgb_to_linear, srgb8_table};
use crate::limits::Budget;
use crate::vector::unit_or_zero;
use crate::{Error, Format, Vertex};

/// What a vertex can have: places in a row of numbers.
const NAMES: [&[&str]; 12] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx", "normal_x"],
    &["ny", "normal_y"],
    &["nz", "normal_z"],
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
    &["alpha", "a", "diffuse_alpha"],
    &["s", "u", "texture_u", "texture_s", "u1"],
    &["t", "v", "texture_v", "texture_t", "v1"],
];
const RED: usize = 6;
const ALPHA: usize = 9;
const U: usize = 10;

/// What the file says of its vertices.
#[derive(Default)]
pub(super) struct Vertices {
    pub(super) vertices: Vec<Vertex>,
    pub(super) has_normals: bool,
    /// As many, or none at all; v goes down.
    pub(super) uvs: Vec<[f32; 2]>,
}

/// The vertices.
pub(super) fn read<S: Source>(element: &Element, source: &mut S, budget: &mut Budget) -> Result<Vertices, Error> {
    let place_of = |name: &str| NAMES.iter().position(|names| names.contains(&name));
    // For each property its place in the row, if it has one. The first property of a kind counts.
    let mut kinds: [Option<Kind>; NAMES.len()] = [None; NAMES.len()];
    let mut places = Vec::with_capacity(element.properties.len());
    for property in &element.properties {
        let place = place_of(&property.name).filter(|&place| property.count.is_none() && kinds[place].is_none());
        if let Some(place) = place {
            kinds[place] = Some(property.kind);
        }
        places.push(place);
    }
    let all = |range: std::ops::Range<usize>| kinds[range].iter().all(Option::is_some);
    if element.count > 0 && !all(0..3) {
        let message = "the element 'vertex' has no properties 'x', 'y' and 'z'";
        return Err(Error::text(Format::Ply, element.line, message));
    }
    let (has_normals, has_colors, has_uvs) = (all(3..6), all(RED..ALPHA), all(U..U + 2));
    budget.vertices(element.count)?;
    let mut vertices = Vec::with_capacity(element.count as usize);
    let mut uvs = Vec::with_capacity(if has_uvs { element.count as usize } else { 0 });
    for _ in 0..element.count {
        let mut row = [0.0; NAMES.len()];
        for (property, place) in element.properties.iter().zip(&places) {
            match place {
                Some(place) => row[*place] = source.number(property.kind)?,
                None => {
                    let count = source.list_count(property)?;
                    source.skip(property.kind, count)?;
                }
            }
        }
        if has_uvs {
            // PLY's v goes up.
            uvs.push([row[U] as f32, (1.0 - row[U + 1]) as f32]);
        }
        vertices.push(Vertex {
            position: [row[0] as f32, row[1] as f32, row[2] as f32],
            normal: if has_normals { unit_or_zero([row[3], row[4], row[5]]) } else { [0.0; 3] },
            color: if has_colors {
                std::array::from_fn(|i| channel(row[RED + i], kinds[RED + i]))
            } else {
                Vertex::WHITE
            },
        });
    }
    if has_colors {
        linearize(&mut vertices, [kinds[RED], kinds[RED + 1], kinds[RED + 2], kinds[ALPHA]]);
    }
    Ok(Vertices { vertices, has_normals, uvs })
}

/// A colour channel as stored: floats as they are, whole numbers as parts of their type's largest.
fn channel(stored: f64, kind: Option<Kind>) -> f32 {
    let largest = match kind {
        // Only alpha can be missing.
        None => return 1.0,
        Some(Kind::F32 | Kind::F64) => return stored as f32,
        // Codes stay codes, for the table.
        Some(Kind::U8) => return stored as f32,
        Some(Kind::I8) => f64::from(i8::MAX),
        Some(Kind::I16) => f64::from(i16::MAX),
        Some(Kind::U16) => f64::from(u16::MAX),
        Some(Kind::I32) => f64::from(i32::MAX),
        Some(Kind::U32) => f64::from(u32::MAX),
    };
    (stored / largest) as f32
}

/// From sRGB as [`channel`] leaves it to linear light.
fn linearize(vertices: &mut [Vertex], kinds: [Option<Kind>; 4]) {
    let is_float = kinds.map(|kind| matches!(kind, Some(Kind::F32 | Kind::F64)));
    let floats =
        vertices.iter().flat_map(|v| v.color.into_iter().zip(is_float).filter(|c| c.1).map(|c| f64::from(c.0)));
    let scale = float_scale(floats);
    let table = srgb8_table();
    for vertex in vertices {
        for (i, channel) in vertex.color.iter_mut().enumerate() {
            let stored = *channel;
            let value = if is_float[i] { f64::from(stored) / scale } else { f64::from(stored) };
            *channel = match kinds[i] {
                // In an ASCII file a code can be anything; a cast to u8 saturates.
                Some(Kind::U8) if i == 3 => stored.clamp(0.0, 255.0) / 255.0,
                Some(Kind::U8) => table[usize::from(stored as u8)],
                _ if i == 3 => value as f32,
                _ => srgb_to_linear(value),
            };
        }
    }
}
