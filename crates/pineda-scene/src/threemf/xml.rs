//! A part's elements, one after the other. Text, comments and instructions say nothing in 3MF; a document type, which
//! could define entities, is refused.

use std::borrow::Cow;
use std::io::{self, BufRead};

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use crate::Error;
use crate::text::{float32, shown};

/// A part while it is read.
pub(super) struct Xml<R> {
    reader: Reader<R>,
    buffer: Vec<u8>,
    /// For messages.
    part: String,
    /// Bytes that all parts may have, for a message.
    limit: u64,
}

/// An element that has just been opened.
pub(super) struct Element<'b> {
    start: BytesStart<'b>,
    part: &'b str,
    at: u64,
}

impl<R: BufRead> Xml<R> {
    pub(super) fn new(reader: R, part: String, limit: u64) -> Self {
        let mut reader = Reader::from_reader(reader);
        reader.config_mut().expand_empty_elements = true;
        Self { reader, buffer: Vec::new(), part, limit }
    }

    /// The next child of the element that is open; `None` once that is closed, or at the end of the part.
    pub(super) fn open(&mut self) -> Result<Option<Element<'_>>, Error> {
        loop {
            self.buffer.clear();
            match self.reader.read_event_into(&mut self.buffer) {
                Ok(Event::Start(start)) => {
                    // A copy: what is borrowed and given away would be borrowed in the other branches, too.
                    let start = start.into_owned();
                    return Ok(Some(Element { start, part: &self.part, at: self.reader.buffer_position() }));
                }
                Ok(Event::End(_) | Event::Eof) => return Ok(None),
                Ok(Event::DocType(_)) => return Err(self.wrong("a document type, which 3MF does not allow")),
                Ok(_) => {}
                Err(error) => return Err(self.broken(&error)),
            }
        }
    }

    /// Passes over what is in the element that was opened last, to its end.
    pub(super) fn skip(&mut self) -> Result<(), Error> {
        let mut depth = 1u64;
        while depth > 0 {
            self.buffer.clear();
            match self.reader.read_event_into(&mut self.buffer) {
                Ok(Event::Start(_)) => depth += 1,
                Ok(Event::End(_)) => depth -= 1,
                Ok(Event::Eof) => return Err(self.wrong("it ends within an element: it is cut short")),
                Ok(Event::DocType(_)) => return Err(self.wrong("a document type, which 3MF does not allow")),
                Ok(_) => {}
                Err(error) => return Err(self.broken(&error)),
            }
        }
        Ok(())
    }

    pub(super) fn wrong(&self, message: &str) -> Error {
        Error::threemf(format!("{}, byte {}", self.part, self.reader.buffer_position()), message)
    }

    fn broken(&self, error: &quick_xml::Error) -> Error {
        match error {
            quick_xml::Error::Io(error) if error.kind() == io::ErrorKind::FileTooLarge => Error::Limit {
                what: "bytes, inflated",
                count: self.limit.saturating_add(1),
                limit: self.limit,
                field: "Limits::inflated",
            },
            quick_xml::Error::Io(error) => self.wrong(&format!("it cannot be inflated: {error}")),
            error => self.wrong(&shown(error.to_string().as_bytes())),
        }
    }
}

impl Element<'_> {
    /// Without its prefix. Prefixes are an author's choice, and what other extensions have within the elements that are
    /// looked at is called otherwise.
    pub(super) fn name(&self) -> &str {
        self.start.local_name().into_inner()
    }

    /// With its prefix, for people.
    pub(super) fn full_name(&self) -> &str {
        self.start.name().into_inner()
    }

    /// An attribute by its name without a prefix.
    pub(super) fn attribute(&self, name: &str) -> Result<Option<Cow<'_, str>>, Error> {
        // Names that come twice are not looked for: that takes the square of their number.
        for attribute in self.start.attributes().with_checks(false) {
            let attribute = attribute.map_err(|error| self.wrong(shown(error.to_string().as_bytes())))?;
            if attribute.key.local_name().into_inner() == name {
                let value = attribute.normalized_value(XmlVersion::Explicit1_0);
                return value.map(Some).map_err(|error| {
                    self.wrong(format!(
                        "the attribute '{name}' cannot be read: {}",
                        shown(error.to_string().as_bytes())
                    ))
                });
            }
        }
        Ok(None)
    }

    /// What a prefix stands for, by the element's own declarations.
    pub(super) fn namespace(&self, prefix: &str) -> Result<Option<Cow<'_, str>>, Error> {
        for attribute in self.start.attributes().with_checks(false) {
            let attribute = attribute.map_err(|error| self.wrong(shown(error.to_string().as_bytes())))?;
            if attribute.key.into_inner().strip_prefix("xmlns:") == Some(prefix) {
                return Ok(Some(attribute.value));
            }
        }
        Ok(None)
    }

    /// What an attribute stands for; `what` is what it should be.
    pub(super) fn parsed<T>(
        &self,
        name: &str,
        what: &str,
        parse: impl Fn(&str) -> Option<T>,
    ) -> Result<Option<T>, Error> {
        let Some(value) = self.attribute(name)? else { return Ok(None) };
        let wrong = || self.wrong(format!("{name} is '{}': expected {what}", shown(value.as_bytes())));
        parse(value.trim()).map(Some).ok_or_else(wrong)
    }

    /// The same of an attribute that must be there.
    pub(super) fn needed<T>(&self, name: &str, what: &str, parse: impl Fn(&str) -> Option<T>) -> Result<T, Error> {
        let missing = || self.wrong(format!("it has no {name}: expected {what}"));
        self.parsed(name, what, parse)?.ok_or_else(missing)
    }

    /// A whole number that is not negative.
    pub(super) fn index(&self, name: &str) -> Result<Option<u32>, Error> {
        self.parsed(name, INDEX, |text| text.parse().ok())
    }

    pub(super) fn needed_index(&self, name: &str) -> Result<u32, Error> {
        self.needed(name, INDEX, |text| text.parse().ok())
    }

    pub(super) fn needed_number(&self, name: &str) -> Result<f32, Error> {
        self.needed(name, "a number", |text| float32(text.as_bytes()))
    }

    pub(super) fn wrong(&self, message: String) -> Error {
        let place = format!("{}, byte {}, <{}>", self.part, self.at, shown(self.full_name().as_bytes()));
        Error::threemf(place, message)
    }
}

const INDEX: &str = "a whole number, 0 or more";
