//! The header: which elements there are, and their properties.

use crate::text::{Syntax, Text, integer, shown};
use crate::{Error, Format};

pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the first element's data begin, and on which line.
    pub(super) body: usize,
    pub(super) body_line: usize,
    /// Images named in comments, as MeshLab does.
    pub(super) textures: Vec<String>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    BinaryLittleEndian,
    BinaryBigEndian,
}

pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// Where the header names it.
    pub(super) line: usize,
}

/// A number, or a list of numbers with their count before them.
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// What a list's count is stored as.
    pub(super) count: Option<Kind>,
}

/// A type of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// In bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Header {
    pub(super) fn line_of(&self, element: &str) -> usize {
        self.elements.iter().find(|e| e.name == element).map_or(self.body_line, |e| e.line)
    }

    /// Whether faces have a property of that name.
    pub(super) fn faces_have(&self, property: &str) -> bool {
        self.elements.iter().any(|e| e.name == "face" && e.properties.iter().any(|p| p.name == property))
    }
}

/// Reads from `ply` to `end_header`.
pub(super) fn parse(bytes: &[u8]) -> Result<Header, Error> {
    let mut text = Text::new(bytes, Syntax::Plain);
    if text.word() != Some(b"ply") {
        return Err(Error::text(Format::Ply, 1, "the file does not begin with the word 'ply': it is not PLY"));
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut textures = Vec::new();
    loop {
        if !text.next_line() {
            return Err(Error::text(Format::Ply, text.line(), "the file ends before 'end_header': it is cut short"));
        }
        let line = text.line();
        let wrong = |message: String| Error::text(Format::Ply, line, message);
        let keyword = text.word().unwrap_or_default();
        match keyword {
            b"format" => encoding = Some(parse_encoding(&mut text).map_err(wrong)?),
            b"element" => elements.push(parse_element(&mut text).map_err(wrong)?),
            b"property" => {
                let element =
                    elements.last_mut().ok_or_else(|| wrong("a property without an element before it".to_owned()))?;
                element.properties.push(parse_property(&mut text).map_err(wrong)?);
            }
            b"comment" | b"obj_info" => {
                if text.word() == Some(b"TextureFile") {
                    textures.push(shown(text.rest()));
                }
            }
            b"end_header" => break,
            b"" => {}
            _ => {
                let expected = "expected format, element, property, comment or end_header";
                return Err(wrong(format!("'{}' is not a word of PLY's header: {expected}", shown(keyword))));
            }
        }
    }
    text.next_line();
    let missing = || Error::text(Format::Ply, 2, "the header has no line 'format ascii 1.0' or the like");
    let encoding = encoding.ok_or_else(missing)?;
    let body = binary_body(bytes, text.offset(), encoding);
    Ok(Header { encoding, elements, body, body_line: text.line(), textures })
}

/// Binary data can begin with the byte of a line feed, which is not part of the header if lines end with CR alone.
fn binary_body(bytes: &[u8], body: usize, encoding: Encoding) -> usize {
    let header = &bytes[..body];
    let lines_end_with_cr = header.starts_with(b"ply\r") && !header.starts_with(b"ply\r\n");
    if encoding != Encoding::Ascii && lines_end_with_cr && header.ends_with(b"\r\n") { body - 1 } else { body }
}

fn parse_encoding(text: &mut Text<'_>) -> Result<Encoding, String> {
    let name = text.word().unwrap_or_default();
    match name {
        b"ascii" => Ok(Encoding::Ascii),
        b"binary_little_endian" => Ok(Encoding::BinaryLittleEndian),
        b"binary_big_endian" => Ok(Encoding::BinaryBigEndian),
        _ => Err(format!("'{}' is no format: expected ascii, binary_little_endian or binary_big_endian", shown(name))),
    }
}

fn parse_element(text: &mut Text<'_>) -> Result<Element, String> {
    let line = text.line();
    let name = text.word().map(shown).unwrap_or_default();
    let count = text.word().and_then(integer).and_then(|count| u64::try_from(count).ok());
    let count = count.ok_or_else(|| format!("the element '{name}' needs a count, as in 'element vertex 8'"))?;
    Ok(Element { name, count, properties: Vec::new(), line })
}

fn parse_property(text: &mut Text<'_>) -> Result<Property, String> {
    let kind = |first: Option<&[u8]>| {
        let name = first.unwrap_or_default();
        Kind::named(name).ok_or_else(|| {
            format!("'{}' is no type: expected char, uchar, short, ushort, int, uint, float or double", shown(name))
        })
    };
    let first = text.word();
    let (count, kind) = if first == Some(b"list") {
        let count = kind(text.word())?;
        (Some(count), kind(text.word())?)
    } else {
        (None, kind(first)?)
    };
    Ok(Property { name: text.word().map(shown).unwrap_or_default(), kind, count })
}
