//! The package (ECMA-376, part 2): a zip file whose entries are parts, and relationships that say what a part is for.

use std::collections::HashMap;
use std::io::{self, BufReader, Cursor, Read};

use zip::ZipArchive;
use zip::read::ZipFile;

use super::xml::Xml;
use crate::Error;
use crate::limits::Budget;
use crate::resolver::{path_inside, percent_decode};
use crate::text::shown;

/// A zip file's parts.
pub(super) struct Package<'a> {
    archive: ZipArchive<Cursor<&'a [u8]>>,
    /// Entries by the parts' names, which are equal whatever their case.
    numbers: HashMap<String, usize>,
    /// Bytes that may be inflated, of which so many are left.
    limit: u64,
    left: u64,
}

/// An entry's bytes.
pub(super) type Inflated<'p, 'a> = BufReader<Bounded<'p, ZipFile<'p, Cursor<&'a [u8]>>>>;

impl<'a> Package<'a> {
    pub(super) fn open(bytes: &'a [u8], budget: &Budget) -> Result<Self, Error> {
        let archive = ZipArchive::new(Cursor::new(bytes))
            .map_err(|error| wrong("zip file", format!("it cannot be opened: {error}: is it complete, and 3MF?")))?;
        let mut numbers = HashMap::new();
        for (number, name) in archive.file_names_raw().enumerate() {
            numbers.entry(name_of(&String::from_utf8_lossy(name))).or_insert(number);
        }
        let limit = budget.inflated_limit();
        Ok(Self { archive, numbers, limit, left: limit })
    }

    /// The name of the part where the model begins, as the package's own relationships say.
    pub(super) fn start(&mut self) -> Result<String, Error> {
        const RELATIONSHIPS: &str = "_rels/.rels";
        const MODEL: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
        let mut xml = self.part(RELATIONSHIPS)?;
        let mut target = None;
        // To the part's end, where its sum is looked at.
        while xml.open()?.is_some() {
            while let Some(element) = xml.open()? {
                let is_model = element.name() == "Relationship" && element.attribute("Type")?.as_deref() == Some(MODEL);
                if is_model && target.is_none() {
                    target = element.attribute("Target")?.map(|target| target.into_owned());
                }
                xml.skip()?;
            }
        }
        target.ok_or_else(|| wrong(RELATIONSHIPS, "it names no 3D model: is the file 3MF?".to_owned()))
    }

    /// The XML of a part.
    pub(super) fn part(&mut self, name: &str) -> Result<Xml<Inflated<'_, 'a>>, Error> {
        let name = shown(name.as_bytes());
        let number = self.numbers.get(&name_of(&name)).copied();
        let number = number.ok_or_else(|| wrong(&name, "the file has no such part: it is not complete".to_owned()))?;
        let file = self.archive.by_index(number);
        let inner = file.map_err(|error| wrong(&name, format!("it cannot be read: {error}")))?;
        let bounded = Bounded { inner, left: &mut self.left };
        Ok(Xml::new(BufReader::new(bounded), name, self.limit))
    }
}

/// What a part is found by: relative to the package, in lower case, without `.` and `..`.
pub(super) fn name_of(name: &str) -> String {
    let decoded = percent_decode(name).unwrap_or_else(|| name.to_owned());
    let inside = path_inside(decoded.trim_start_matches('/'));
    inside.unwrap_or(decoded).to_ascii_lowercase()
}

fn wrong(place: &str, message: String) -> Error {
    Error::threemf(place, message)
}

/// Reads no more than all of the package's parts may have together; the error is of kind [`io::ErrorKind::FileTooLarge`].
pub(super) struct Bounded<'p, R> {
    inner: R,
    left: &'p mut u64,
}

impl<R: Read> Read for Bounded<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        // One byte more than may be, so that the end is seen where it is.
        let most = usize::try_from(*self.left + 1).unwrap_or(usize::MAX).min(buffer.len());
        let count = self.inner.read(&mut buffer[..most])?;
        match self.left.checked_sub(count as u64) {
            Some(left) => *self.left = left,
            None => return Err(io::ErrorKind::FileTooLarge.into()),
        }
        Ok(count)
    }
}
