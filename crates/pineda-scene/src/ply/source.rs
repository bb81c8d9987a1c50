//! Numbers from a PLY file's body, whatever its encoding.

use super::header::{Element, Header, Kind, Property};
use crate::text::{Syntax, Text, float, integer, shown};
use crate::{Error, Format};

/// Where an element's numbers come from.
pub(super) trait Source {
    /// Whether the file can have as many of the element as its header says: so that memory may be taken for them.
    fn check_count(&self, element: &Element) -> Result<(), Error>;

    /// The next number. All types are exact in f64.
    fn number(&mut self, kind: Kind) -> Result<f64, Error>;

    /// Passes over numbers.
    fn skip(&mut self, kind: Kind, count: u64) -> Result<(), Error>;

    /// An error at the place that has been reached.
    fn error(&self, message: String) -> Error;

    /// The next number, which must be whole.
    fn integer(&mut self, kind: Kind) -> Result<i64, Error> {
        let number = self.number(kind)?;
        let whole = number as i64;
        if whole as f64 == number { Ok(whole) } else { Err(self.error(format!("{number} is not a whole number"))) }
    }

    /// How many numbers the property has: 1, or the list's count, which is read.
    fn list_count(&mut self, property: &Property) -> Result<u64, Error> {
        let Some(kind) = property.count else { return Ok(1) };
        let count = self.integer(kind)?;
        u64::try_from(count).map_err(|_| self.error(format!("a list '{}' of {count} numbers", property.name)))
    }
}

/// What is wrong if a file has fewer numbers than its header says.
fn check_bytes(element: &Element, bytes_each: usize, bytes_left: usize) -> Result<(), Error> {
    let needed = element.count.saturating_mul(bytes_each as u64);
    if needed <= bytes_left as u64 {
        return Ok(());
    }
    let (name, count) = (&element.name, element.count);
    let message = format!(
        "{count} of the element '{name}' need at least {needed} bytes, but the file has only {bytes_left} more: it is cut short"
    );
    Err(Error::text(Format::Ply, element.line, message))
}

/// Words. Where lines end does not matter.
pub(super) struct Ascii<'a> {
    text: Text<'a>,
    line_before: usize,
}

impl<'a> Ascii<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Self {
        Self { text: Text::new(&bytes[header.body..], Syntax::Plain), line_before: header.body_line - 1 }
    }

    fn word(&mut self) -> Result<&'a [u8], Error> {
        self.text.word_on_any_line().ok_or_else(|| self.error("the file ends here: it is cut short".to_owned()))
    }
}

impl Source for Ascii<'_> {
    fn check_count(&self, element: &Element) -> Result<(), Error> {
        // A digit and a space for each number; the file's last space may be missing.
        check_bytes(element, 2 * element.properties.len(), self.text.remaining() + 1)
    }

    fn number(&mut self, kind: Kind) -> Result<f64, Error> {
        let word = self.word()?;
        // Digits are quicker than floats, and rounding to f32 once is not the same as by way of f64.
        let number = match kind {
            Kind::F32 => crate::text::float32(word).map(f64::from),
            Kind::F64 => float(word),
            _ => integer(word).map(|i| i as f64).or_else(|| float(word)),
        };
        number.ok_or_else(|| self.error(format!("'{}' is not a number", shown(word))))
    }

    fn skip(&mut self, _kind: Kind, count: u64) -> Result<(), Error> {
        for _ in 0..count {
            self.word()?;
        }
        Ok(())
    }

    fn error(&self, message: String) -> Error {
        Error::text(Format::Ply, self.line_before + self.text.line(), message)
    }
}

/// Bytes, packed without gaps, in either order.
pub(super) struct Binary<'a, const BIG_ENDIAN: bool> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a, const BIG_ENDIAN: bool> Binary<'a, BIG_ENDIAN> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Self {
        Self { bytes, at: header.body }
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let Some(bytes) = self.bytes[self.at..].first_chunk::<N>() else {
            return Err(self.error("the file ends here: it is cut short".to_owned()));
        };
        self.at += N;
        let mut bytes = *bytes;
        if BIG_ENDIAN {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<const BIG_ENDIAN: bool> Source for Binary<'_, BIG_ENDIAN> {
    fn check_count(&self, element: &Element) -> Result<(), Error> {
        let bytes_each = element.properties.iter().map(|p| p.count.unwrap_or(p.kind).size()).sum();
        check_bytes(element, bytes_each, self.bytes.len() - self.at)
    }

    fn number(&mut self, kind: Kind) -> Result<f64, Error> {
        Ok(match kind {
            Kind::I8 => f64::from(i8::from_le_bytes(self.array()?)),
            Kind::U8 => f64::from(u8::from_le_bytes(self.array()?)),
            Kind::I16 => f64::from(i16::from_le_bytes(self.array()?)),
            Kind::U16 => f64::from(u16::from_le_bytes(self.array()?)),
            Kind::I32 => f64::from(i32::from_le_bytes(self.array()?)),
            Kind::U32 => f64::from(u32::from_le_bytes(self.array()?)),
            Kind::F32 => f64::from(f32::from_le_bytes(self.array()?)),
            Kind::F64 => f64::from_le_bytes(self.array()?),
        })
    }

    fn skip(&mut self, kind: Kind, count: u64) -> Result<(), Error> {
        let bytes = count.saturating_mul(kind.size() as u64);
        if bytes > (self.bytes.len() - self.at) as u64 {
            let left = self.bytes.len() - self.at;
            return Err(
                self.error(format!("a list of {count} numbers does not fit into the {left} bytes that are left"))
            );
        }
        self.at += bytes as usize;
        Ok(())
    }

    fn error(&self, message: String) -> Error {
        Error::binary(Format::Ply, self.at, message)
    }
}
