//! The statements of an OBJ file, one by one; what they mean together is `build`'s business.

use std::collections::HashMap;

use super::Names;
use crate::limits::Budget;
use crate::polygon::Polygons;
use crate::text::{Syntax, Text, float32, integer, shown};
use crate::{Error, Format};

/// An OBJ file's content, with indices from 0.
#[derive(Default)]
pub(super) struct File {
    pub(super) positions: Vec<[f32; 3]>,
    /// Parallel to `positions`, as stored; empty if no vertex has a colour, NaN where one has none.
    pub(super) colors: Vec<[f32; 4]>,
    pub(super) normals: Vec<[f32; 3]>,
    /// As stored: v goes up.
    pub(super) uvs: Vec<[f32; 2]>,
    /// The names after `mtllib`, line by line.
    pub(super) libraries: Vec<String>,
    /// The names after `usemtl`.
    pub(super) materials: Vec<String>,
    pub(super) groups: Vec<Group>,
    /// Free-form curves and surfaces.
    pub(super) skipped: usize,
}

/// Faces, lines and points of one object or group and of one material.
pub(super) struct Group {
    pub(super) name: String,
    /// Index into [`File::materials`].
    pub(super) material: Option<usize>,
    pub(super) faces: Polygons<Corner>,
    pub(super) lines: Vec<[Corner; 2]>,
    pub(super) points: Vec<Corner>,
    /// Where the group's first element is.
    pub(super) line: usize,
}

/// A corner of a face, an end of a line, a point.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Corner {
    /// Index into [`File::positions`], not yet known to be in range: files may name a vertex before they define it.
    pub(super) position: u32,
    /// The same for [`File::normals`]; [`Corner::NONE`] for none.
    pub(super) normal: u32,
    /// The same for [`File::uvs`]; [`Corner::NONE`] for none.
    pub(super) uv: u32,
}

impl Corner {
    pub(super) const NONE: u32 = u32::MAX;
    /// In range of nothing.
    const NO_SUCH: u32 = u32::MAX - 1;
}

pub(super) fn parse(bytes: &[u8], budget: &mut Budget) -> Result<File, Error> {
    let mut parser = Parser::new(bytes);
    loop {
        if let Some(keyword) = parser.text.word() {
            parser.statement(keyword, budget)?;
        }
        if !parser.text.next_line() {
            parser.file.materials = parser.materials.names;
            return Ok(parser.file);
        }
    }
}

struct Parser<'a> {
    text: Text<'a>,
    file: File,
    materials: Names,
    object: String,
    group: String,
    material: Option<usize>,
    /// The group that faces go to now; `None` after a change of object, group or material.
    current: Option<usize>,
    groups: HashMap<(String, Option<usize>), usize>,
    corners: Vec<Corner>,
}

impl<'a> Parser<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            text: Text::new(bytes, Syntax::Wavefront),
            file: File::default(),
            materials: Names::default(),
            object: String::new(),
            group: String::new(),
            material: None,
            current: None,
            groups: HashMap::new(),
            corners: Vec::new(),
        }
    }

    fn statement(&mut self, keyword: &[u8], budget: &mut Budget) -> Result<(), Error> {
        match keyword {
            b"v" => self.vertex()?,
            b"vn" => {
                let normal = self.numbers("a normal (vn)")?;
                self.file.normals.push(normal);
            }
            b"vt" => {
                let u = self.number("a texture coordinate (vt)")?.unwrap_or(0.0);
                let v = self.number("a texture coordinate (vt)")?.unwrap_or(0.0);
                self.file.uvs.push([u, v]);
            }
            b"f" | b"fo" => {
                let group = self.element(budget)?;
                self.file.groups[group].faces.push(self.corners.iter().copied());
            }
            b"l" => {
                let group = self.element(budget)?;
                budget.triangles(self.corners.len().saturating_sub(1) as u64)?;
                self.file.groups[group].lines.extend(self.corners.windows(2).map(|ends| [ends[0], ends[1]]));
            }
            b"p" => {
                let group = self.element(budget)?;
                budget.triangles(self.corners.len() as u64)?;
                self.file.groups[group].points.extend(&self.corners);
            }
            b"o" => {
                self.object = shown(self.text.rest());
                self.group.clear();
                self.current = None;
            }
            b"g" => {
                self.group = shown(self.text.rest());
                self.current = None;
            }
            b"usemtl" => {
                let name = shown(self.text.rest());
                self.material = Some(self.materials.number(name));
                self.current = None;
            }
            b"mtllib" => self.file.libraries.push(shown(self.text.rest())),
            b"curv" | b"curv2" | b"surf" => self.file.skipped += 1,
            // s and what describes curves, display and rendering: nothing that shapes a triangle.
            _ => {}
        }
        Ok(())
    }

    fn error(&self, message: impl Into<String>) -> Error {
        Error::text(Format::Obj, self.text.line(), message)
    }

    fn number(&mut self, what: &str) -> Result<Option<f32>, Error> {
        let Some(word) = self.text.word() else { return Ok(None) };
        let bad = || self.error(format!("'{}' in {what} is not a number", shown(word)));
        float32(word).ok_or_else(bad).map(Some)
    }

    fn numbers(&mut self, what: &str) -> Result<[f32; 3], Error> {
        let mut numbers = [0.0; 3];
        for number in &mut numbers {
            let found = self.number(what)?;
            *number = found.ok_or_else(|| self.error(format!("{what} needs three numbers")))?;
        }
        Ok(numbers)
    }

    /// `v x y z [w]` or, as MeshLab, Blender and ZBrush write it, `v x y z r g b [a]`.
    fn vertex(&mut self) -> Result<(), Error> {
        const WHAT: &str = "a vertex (v)";
        let position = self.numbers(WHAT)?;
        let mut more = [0.0; 4];
        let mut count = 0;
        while count < more.len()
            && let Some(number) = self.number(WHAT)?
        {
            more[count] = number;
            count += 1;
        }
        let color = match count {
            3 => Some([more[0], more[1], more[2], 1.0]),
            4 => Some(more),
            _ => None,
        };
        let File { positions, colors, .. } = &mut self.file;
        if color.is_some() && colors.is_empty() {
            colors.resize(positions.len(), [f32::NAN; 4]);
        }
        if !colors.is_empty() || color.is_some() {
            colors.push(color.unwrap_or([f32::NAN; 4]));
        }
        positions.push(position);
        Ok(())
    }

    /// Reads an element's corners; the number of the group that it belongs to.
    fn element(&mut self, budget: &mut Budget) -> Result<usize, Error> {
        self.corners.clear();
        while let Some(word) = self.text.word() {
            let corner = self.corner(word)?;
            self.corners.push(corner);
        }
        match self.current {
            Some(group) => Ok(group),
            None => self.open_group(budget),
        }
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &[u8]) -> Result<Corner, Error> {
        let mut parts = word.split(|&b| b == b'/');
        let position = parts.next().unwrap_or_default();
        let uv = parts.next().filter(|uv| !uv.is_empty());
        let normal = parts.next().filter(|normal| !normal.is_empty());
        let index = |part: &[u8], of: usize, what: &str| {
            let wrong =
                |why: &str| self.error(format!("'{}' in a face (f), line (l) or point (p): {why}", shown(word)));
            match integer(part) {
                None => Err(wrong("expected whole numbers as in 1, 1/2, 1//3 or 1/2/3")),
                Some(0) => Err(wrong("indices count from 1, or from -1 backwards")),
                // From the end of what there is so far.
                Some(back @ ..0) => {
                    (of as i64 + back).try_into().map_err(|_| wrong(&format!("there are only {of} {what} before it")))
                }
                Some(index) => (index - 1)
                    .try_into()
                    .ok()
                    .filter(|&i: &u32| i < u32::MAX)
                    .ok_or_else(|| wrong("the index is too large")),
            }
        };
        // What is wrong with texture coordinates costs the texture, not the model.
        let uv = match uv.map(|uv| (uv, integer(uv))) {
            None => Corner::NONE,
            Some((uv, None)) => index(uv, 0, "texture coordinates")?,
            Some((uv, Some(_))) => index(uv, self.file.uvs.len(), "texture coordinates").unwrap_or(Corner::NO_SUCH),
        };
        Ok(Corner {
            position: index(position, self.file.positions.len(), "vertices")?,
            normal: normal.map_or(Ok(Corner::NONE), |n| index(n, self.file.normals.len(), "normals"))?,
            uv,
        })
    }

    fn open_group(&mut self, budget: &mut Budget) -> Result<usize, Error> {
        let name = match (self.object.is_empty(), self.group.is_empty()) {
            (false, false) => format!("{} {}", self.object, self.group),
            (false, true) => self.object.clone(),
            _ => self.group.clone(),
        };
        let group = match self.groups.get(&(name.clone(), self.material)) {
            Some(&group) => group,
            None => {
                budget.objects(1)?;
                let group = self.file.groups.len();
                self.groups.insert((name.clone(), self.material), group);
                let (material, line) = (self.material, self.text.line());
                let (faces, lines, points) = (Polygons::default(), Vec::new(), Vec::new());
                self.file.groups.push(Group { name, material, faces, lines, points, line });
                group
            }
        };
        self.current = Some(group);
        Ok(group)
    }
}
