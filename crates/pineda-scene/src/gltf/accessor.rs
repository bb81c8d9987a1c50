//! Accessors: numbers in a buffer, checked once, then read one element at a time.
//!
//! ```text
//! accessor -> buffer view -> buffer           element i is at view.byteOffset + accessor.byteOffset + i * stride
//!    |
//!    +------> sparse: indices, values         elements that are elsewhere
//! ```

use std::cell::Cell;

use super::buffers::Buffers;
use super::schema::{Accessor as Definition, Root, Sparse, Whole};
use crate::Error;
use crate::limits::Budget;

/// An accessor all of whose elements exist.
pub(super) struct Accessor<'a> {
    pub(super) count: usize,
    /// Numbers of an element: 1 to 4, or a matrix' 4, 9 or 16, column by column.
    pub(super) channels: usize,
    /// Numbers of a column: all, unless it is a matrix.
    rows: usize,
    /// Bytes from a column to the next.
    column: usize,
    component: Component,
    normalized: bool,
    /// `None`: zeros.
    dense: Option<Elements<'a>>,
    sparse: Option<Overlay<'a>>,
}

/// Elements at equal distances.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
}

/// The elements of a sparse accessor that differ from the dense ones.
struct Overlay<'a> {
    count: usize,
    component: Component,
    /// Strictly increasing.
    indices: Elements<'a>,
    values: Elements<'a>,
}

impl<'a> Overlay<'a> {
    /// Indices increase and are below `count`.
    fn check(&self, count: u64) -> Result<(), String> {
        let indices = || (0..self.count).map(|at| self.index(at));
        if !indices().is_sorted_by(|a, b| a < b) {
            return Err("its sparse indices do not increase".to_owned());
        }
        match indices().next_back() {
            Some(last) if u64::from(last) >= count => {
                Err(format!("sparse index {last}, but there are {count} elements"))
            }
            _ => Ok(()),
        }
    }

    fn index(&self, at: usize) -> u32 {
        self.component.read(&self.indices.bytes[at * self.indices.stride..]) as u32
    }

    /// The bytes of element `index`, if it is here.
    fn find(&self, index: usize) -> Option<&'a [u8]> {
        let (mut from, mut to) = (0, self.count);
        while from < to {
            let middle = from.midpoint(to);
            if (self.index(middle) as usize) < index { from = middle + 1 } else { to = middle }
        }
        (from < self.count && self.index(from) as usize == index)
            .then(|| &self.values.bytes[from * self.values.stride..])
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    pub(super) fn of(code: Whole) -> Option<Self> {
        Some(match code.0 {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number at the beginning of `bytes`.
    fn read(self, bytes: &[u8]) -> f64 {
        match self {
            Self::I8 => f64::from(bytes[0] as i8),
            Self::U8 => f64::from(bytes[0]),
            Self::I16 => f64::from(i16::from_le_bytes([bytes[0], bytes[1]])),
            Self::U16 => f64::from(u16::from_le_bytes([bytes[0], bytes[1]])),
            Self::U32 => f64::from(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])),
            Self::F32 => f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])),
        }
    }

    /// Adds the number, which is one of its own, as bytes.
    pub(super) fn write(self, number: f32, bytes: &mut Vec<u8>) {
        match self {
            Self::I8 => bytes.extend((number as i8).to_le_bytes()),
            Self::U8 => bytes.extend((number as u8).to_le_bytes()),
            Self::I16 => bytes.extend((number as i16).to_le_bytes()),
            Self::U16 => bytes.extend((number as u16).to_le_bytes()),
            Self::U32 => bytes.extend((number as u32).to_le_bytes()),
            Self::F32 => bytes.extend(number.to_le_bytes()),
        }
    }

    /// A normalised integer as the number that it stands for (specification, 3.6.2.2).
    fn normalize(self, number: f64) -> f64 {
        let signed = |largest: f64| if number < -largest { -1.0 } else { number / largest };
        match self {
            Self::I8 => signed(127.0),
            Self::I16 => signed(32767.0),
            Self::U8 => number / 255.0,
            Self::U16 => number / 65535.0,
            Self::U32 => number / 4_294_967_295.0,
            Self::F32 => number,
        }
    }
}

/// What an element consists of.
pub(super) struct Shape {
    pub(super) component: Component,
    /// Numbers of a column: all, unless it is a matrix.
    rows: usize,
    /// Numbers in all.
    pub(super) channels: usize,
    /// Bytes from a column to the next.
    column: usize,
    /// Bytes in all.
    size: usize,
}

impl Shape {
    pub(super) fn of(definition: &Definition) -> Result<Self, String> {
        let code = definition.component_type;
        let component = Component::of(code).ok_or_else(|| format!("component type {code} does not exist"))?;
        let (columns, rows) = match definition.kind.as_str() {
            "SCALAR" => (1, 1),
            "VEC2" => (1, 2),
            "VEC3" => (1, 3),
            "VEC4" => (1, 4),
            "MAT2" => (2, 2),
            "MAT3" => (3, 3),
            "MAT4" => (4, 4),
            kind => {
                let kind = crate::text::shown(kind.as_bytes());
                return Err(format!("its type is {kind}: expected SCALAR, VEC2 to VEC4 or MAT2 to MAT4"));
            }
        };
        // A matrix' columns begin at multiples of four bytes (specification, 3.6.2.4).
        let column = if columns > 1 { (rows * component.size()).next_multiple_of(4) } else { rows * component.size() };
        Ok(Self { component, rows, channels: columns * rows, column, size: columns * column })
    }
}

/// What accessors are resolved against.
pub(super) struct Accessors<'a> {
    pub(super) root: &'a Root,
    buffers: &'a Buffers,
    /// The accessors whose elements have been counted and whose sparse indices have been looked at, so that a node
    /// more costs no more.
    known: Vec<Cell<bool>>,
}

impl<'a> Accessors<'a> {
    pub(super) fn new(root: &'a Root, buffers: &'a Buffers) -> Self {
        Self { root, buffers, known: vec![Cell::new(false); root.accessors.len()] }
    }

    /// The accessor `number`; `place` is who asks, for messages.
    pub(super) fn get(&self, number: Whole, place: &str, budget: &mut Budget) -> Result<Accessor<'a>, Error> {
        let place = format!("{place}, accessor {number}");
        let wrong = |message: String| Error::gltf(place.as_str(), message);
        let definition =
            self.root.accessors.get(number.index()).ok_or_else(|| wrong("it does not exist".to_owned()))?;
        let Shape { component, rows, channels, column, size } = Shape::of(definition).map_err(wrong)?;
        let count = definition.count;
        let dense = match definition.buffer_view {
            Some(view) => Some(self.elements(view, definition.byte_offset, size, count, &place)?),
            None => None,
        };
        let sparse = match &definition.sparse {
            Some(sparse) => Some(self.overlay(sparse, size, &place)?),
            None => None,
        };
        if !self.known[number.index()].replace(true) {
            if dense.is_none() {
                budget.elements(count.0)?;
            }
            if let Some(overlay) = &sparse {
                budget.elements(overlay.count as u64)?;
                overlay.check(count.0).map_err(wrong)?;
            }
        }
        let (count, normalized) = (count.index(), definition.normalized);
        Ok(Accessor { count, channels, rows, column, component, normalized, dense, sparse })
    }

    /// The accessor `number`, whose elements are not where it says, but these.
    pub(super) fn with_bytes(&self, number: Whole, bytes: &'a [u8], place: &str) -> Result<Accessor<'a>, Error> {
        let wrong = |message: String| Error::gltf(format!("{place}, accessor {number}"), message);
        let missing = || wrong("it does not exist".to_owned());
        let definition = self.root.accessors.get(number.index()).ok_or_else(missing)?;
        let Shape { component, rows, channels, column, size } = Shape::of(definition).map_err(wrong)?;
        let (count, normalized) = (bytes.len() / size, definition.normalized);
        let dense = Some(Elements { bytes, stride: size });
        Ok(Accessor { count, channels, rows, column, component, normalized, dense, sparse: None })
    }

    /// `count` elements of `size` bytes from `offset` on in a buffer view.
    fn elements(
        &self,
        view: Whole,
        offset: Whole,
        size: usize,
        count: Whole,
        place: &str,
    ) -> Result<Elements<'a>, Error> {
        let wrong = |message: String| Error::gltf(format!("{place}, buffer view {view}"), message);
        let bytes: &'a [u8] = self.buffers.view(self.root, view).map_err(|error| match error {
            Error::Gltf { place: inner, message } => Error::gltf(format!("{place}, {inner}"), message),
            error => error,
        })?;
        let definition = &self.root.buffer_views[view.index()];
        let length = bytes.len() as u64;
        let stride = definition.byte_stride.map_or(0, |stride| stride.0);
        let stride = if stride == 0 { size as u64 } else { stride };
        let needed = match count.0 {
            0 => 0,
            count => (count - 1).saturating_mul(stride).saturating_add(size as u64).saturating_add(offset.0),
        };
        if needed > length {
            return Err(wrong(format!("{count} elements need {needed} bytes of it, but it has only {length}")));
        }
        // All in range of the view now, so of usize, too; without elements the offset is anything.
        Ok(Elements { bytes: &bytes[offset.0.min(length) as usize..], stride: stride as usize })
    }

    fn overlay(&self, sparse: &Sparse, size: usize, place: &str) -> Result<Overlay<'a>, Error> {
        let place = format!("{place}, sparse");
        let wrong = |message: String| Error::gltf(place.as_str(), message);
        let code = sparse.indices.component_type;
        let component = Component::of(code).filter(|c| matches!(c, Component::U8 | Component::U16 | Component::U32));
        let component =
            component.ok_or_else(|| wrong(format!("indices of component type {code}: expected 5121, 5123 or 5125")))?;
        let at = &sparse.indices;
        let indices = self.elements(at.buffer_view, at.byte_offset, component.size(), sparse.count, &place)?;
        let at = &sparse.values;
        let values = self.elements(at.buffer_view, at.byte_offset, size, sparse.count, &place)?;
        Ok(Overlay { count: sparse.count.index(), component, indices, values })
    }
}

impl Accessor<'_> {
    /// Element `index` (below `count`), normalised if the accessor says so; channels that it does not have are `filler`.
    pub(super) fn element<const N: usize>(&self, index: usize, filler: f64) -> [f64; N] {
        let mut element = [filler; N];
        let channels = self.channels.min(N);
        match self.bytes_of(index) {
            Some(bytes) => {
                let size = self.component.size();
                for (channel, number) in element[..channels].iter_mut().enumerate() {
                    let at = channel / self.rows * self.column + channel % self.rows * size;
                    let stored = self.component.read(&bytes[at..]);
                    *number = if self.normalized { self.component.normalize(stored) } else { stored };
                }
            }
            None => element[..channels].fill(0.0),
        }
        element
    }

    /// Element `index` of a list of indices.
    pub(super) fn index(&self, index: usize) -> u32 {
        self.bytes_of(index).map_or(0, |bytes| self.component.read(bytes) as u32)
    }

    pub(super) fn is_index_list(&self) -> bool {
        self.channels == 1 && matches!(self.component, Component::U8 | Component::U16 | Component::U32)
    }

    /// Whole numbers as colours are parts of the largest, whether or not the file says so.
    pub(super) fn normalized(self) -> Self {
        Self { normalized: true, ..self }
    }

    fn bytes_of(&self, index: usize) -> Option<&[u8]> {
        let elsewhere = self.sparse.as_ref().and_then(|overlay| overlay.find(index));
        elsewhere.or_else(|| self.dense.as_ref().map(|elements| &elements.bytes[index * elements.stride..]))
    }
}
