//! Binary STL: 80 bytes of anything, a count, and for each facet 50 bytes: normal, three corners (twelve f32, little
//! endian) and an attribute of 16 bits, which nobody defined and two programs use for colours:
//!
//! ```text
//! bit     15     14..10  9..5   4..0
//! VisCAM  valid  red     green  blue
//! Magics  !own   blue    green  red     own = 1 where bit 15 is 0; only if the header says "COLOR=" r g b a (bytes)
//! ```

use crate::color::{srgb_to_linear, srgb8_table};
use crate::limits::Budget;
use crate::{Error, Format, Loaded, Material, Normals, Object, Scene, Vertex};

const HEADER: usize = 80;
const FACETS: usize = HEADER + 4;
const FACET: usize = 50;

/// Whether the file is exactly as long as its count of facets says.
pub(super) fn has_the_right_length(bytes: &[u8]) -> bool {
    facet_count(bytes).is_some_and(|count| count * FACET as u64 == (bytes.len() - FACETS) as u64)
}

fn facet_count(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER..FACETS)?;
    Some(u64::from(u32::from_le_bytes([count[0], count[1], count[2], count[3]])))
}

pub(super) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Loaded, Error> {
    let count = facet_count(bytes).ok_or_else(|| {
        let message =
            "the file ends here, before the 84 bytes of a binary STL file's beginning; is it complete, and STL?";
        Error::binary(Format::Stl, bytes.len(), message)
    })?;
    let facets = &bytes[FACETS..];
    let present = (facets.len() / FACET) as u64;
    if count > present {
        let message =
            format!("{count} facets are announced, but the file has bytes for {present}: it is cut short, or not STL");
        return Err(Error::binary(Format::Stl, HEADER, message));
    }
    let mut notes = Vec::new();
    let behind = facets.len() as u64 - count * FACET as u64;
    if behind > 0 {
        notes.push(format!("{behind} bytes behind the last facet ignored"));
    }
    budget.objects(1)?;
    budget.triangles(count)?;
    budget.vertices(3 * count)?;
    let facets = || facets.chunks_exact(FACET).take(count as usize);
    let colors = Colors::of_file(&bytes[..HEADER], facets().map(attribute));
    let mut vertices = Vec::with_capacity(3 * count as usize);
    for facet in facets() {
        let color = colors.color(attribute(facet));
        let mut coordinates = facet[12..48].chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        for _ in 0..3 {
            let position = std::array::from_fn(|_| coordinates.next().unwrap_or_default());
            vertices.push(Vertex { color, ..Vertex::at(position) });
        }
    }
    let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let name = "".into();
    let objects =
        vec![Object { name, vertices, triangles, material: 0, normals: Normals::Absent, ..Object::default() }];
    Ok(Loaded { scene: Scene { objects, materials: vec![Material::default()], ..Scene::default() }, notes })
}

fn attribute(facet: &[u8]) -> u16 {
    u16::from_le_bytes([facet[48], facet[49]])
}

/// How a file's attributes are to be understood.
enum Colors {
    None,
    VisCam,
    /// With the colour of facets that have none of their own; its alpha is everybody's.
    Magics([f32; 4]),
}

impl Colors {
    fn of_file(header: &[u8], mut attributes: impl Iterator<Item = u16>) -> Self {
        const KEY: &[u8] = b"COLOR=";
        let key = header.windows(KEY.len() + 4).find(|w| w.starts_with(KEY));
        if let Some([.., r, g, b, a]) = key {
            let table = srgb8_table();
            let [r, g, b] = [r, g, b].map(|&c| table[usize::from(c)]);
            return Self::Magics([r, g, b, f32::from(*a) / 255.0]);
        }
        if attributes.any(|attribute| attribute & 0x8000 != 0) { Self::VisCam } else { Self::None }
    }

    fn color(&self, attribute: u16) -> [f32; 4] {
        let channel = |shift: u16| srgb_to_linear(f64::from(attribute >> shift & 31) / 31.0);
        let set = attribute & 0x8000 != 0;
        match *self {
            Self::VisCam if set => [channel(10), channel(5), channel(0), 1.0],
            Self::Magics([.., alpha]) if !set => [channel(0), channel(5), channel(10), alpha],
            Self::Magics(whole) => whole,
            Self::None | Self::VisCam => Vertex::WHITE,
        }
    }
}
