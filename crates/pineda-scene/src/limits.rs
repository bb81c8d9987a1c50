//! What a file may ask for.

use crate::Error;

/// Bounds on what one model may ask for, whatever its format: so that no file, however made, takes all memory or all
/// day. The defaults let through every model that is drawn in practice and keep a small hostile one below 1 GiB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of the file and of all files that it names. Default 2 GiB.
    pub file_bytes: u64,
    /// Vertices of the scene. Default 2^26 (2.5 GiB); a quarter of that where pointers have 32 bits, as on the web.
    pub vertices: u64,
    /// Triangles, lines and points of the scene. Default 2^27 (1.5 GiB); a quarter of that where pointers have 32 bits.
    pub triangles: u64,
    /// Vertices, and triangles, that the file's bytes do not hold one by one: meshes that several nodes draw, accessors
    /// without data. A scene may hold this many more of either than the files have bytes. Default 2^21: a renderer that
    /// gives each triangle corners of its own takes some 280 bytes for it.
    pub expanded: u64,
    /// Objects of the scene. Default 2^19.
    pub objects: u64,
    /// Depth of a node below its scene's root. Default 1024.
    pub nesting: u64,
    /// Bytes that the parts of a 3MF file may have, inflated, beyond 64 for each byte of the file. Default 2^26.
    pub inflated: u64,
    /// Pixels of any one image. Default 2^26 (8192 x 8192). An image with more is left out.
    pub image_pixels: u64,
    /// Pixels of all images together, those of 16 bits a channel counted twice. Default 2^29 (2 GiB); a quarter of that
    /// where pointers have 32 bits. The images beyond are left out.
    pub pixels: u64,
    /// Pixels that images may have beyond 32 for each byte of theirs: a file of a few bytes can hold a picture of any
    /// size. Default 2^25: with smaller levels, and once as colours and once as numbers, some 20 bytes each.
    pub expanded_pixels: u64,
}

impl Limits {
    /// Elements of any one list in glTF's JSON. The parser enforces it, so it is the same for everybody: an empty JSON
    /// object takes three bytes in the file but some two hundred in memory.
    pub const JSON_LIST: usize = 1 << 20;

    /// Bytes in memory of all lists in glTF's JSON, beyond 8 for each byte of JSON. The parser enforces it, too.
    pub const JSON_BYTES: usize = 1 << 27;
}

impl Default for Limits {
    fn default() -> Self {
        let quarters = if usize::BITS < 64 { 1 } else { 4 };
        Self {
            file_bytes: 2 << 30,
            vertices: quarters << 24,
            triangles: quarters << 25,
            expanded: 1 << 21,
            objects: 1 << 19,
            nesting: 1024,
            inflated: 1 << 26,
            image_pixels: 1 << 26,
            pixels: quarters << 27,
            expanded_pixels: 1 << 25,
        }
    }
}

/// What is left of the limits while a model is read. Asked *before* memory is taken.
#[derive(Clone, Debug)]
pub(crate) struct Budget {
    limits: Limits,
    bytes: u64,
    vertices: u64,
    triangles: u64,
    objects: u64,
    elements: u64,
    attributes: u64,
    /// Steps that triangulating polygons may still take, see [`crate::polygon`].
    pub(crate) polygon_steps: u64,
}

impl Budget {
    /// For a model whose main file has `bytes` bytes.
    pub(crate) fn new(limits: &Limits, bytes: usize) -> Result<Self, Error> {
        let polygon_steps = crate::polygon::steps_allowed(bytes);
        let mut budget = Self {
            limits: *limits,
            bytes: 0,
            vertices: 0,
            triangles: 0,
            objects: 0,
            elements: 0,
            attributes: 0,
            polygon_steps,
        };
        budget.add_bytes(bytes as u64)?;
        Ok(budget)
    }

    pub(crate) fn limits(&self) -> &Limits {
        &self.limits
    }

    pub(crate) fn nesting(&self) -> u64 {
        self.limits.nesting
    }

    /// Bytes of all files that have been read.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Bytes that compressed parts may have.
    pub(crate) fn inflated_limit(&self) -> u64 {
        self.bytes.saturating_mul(64).saturating_add(self.limits.inflated)
    }

    /// Bytes that side files may still have.
    pub(crate) fn bytes_left(&self) -> u64 {
        self.limits.file_bytes.saturating_sub(self.bytes)
    }

    /// Counts a file that has been read.
    pub(crate) fn add_bytes(&mut self, bytes: u64) -> Result<(), Error> {
        self.bytes = self.bytes.saturating_add(bytes);
        check("bytes", self.bytes, self.limits.file_bytes, "Limits::file_bytes")
    }

    pub(crate) fn vertices(&mut self, count: u64) -> Result<(), Error> {
        self.vertices = self.vertices.saturating_add(count);
        // Indices are u32, and u32::MAX means "none" in places.
        let limit = self.limits.vertices.min(u64::from(u32::MAX) - 1);
        check("vertices", self.vertices, limit, "Limits::vertices")?;
        self.check_expanded("vertices", self.vertices)
    }

    pub(crate) fn triangles(&mut self, count: u64) -> Result<(), Error> {
        self.triangles = self.triangles.saturating_add(count);
        check("triangles", self.triangles, self.limits.triangles, "Limits::triangles")?;
        self.check_expanded("triangles", self.triangles)
    }

    /// Elements of one accessor without data, or of its sparse part: both can be named again and again.
    pub(crate) fn elements(&mut self, count: u64) -> Result<(), Error> {
        self.elements = self.elements.saturating_add(count);
        self.check_expanded("accessor elements", self.elements)
    }

    /// Pairs of texture coordinates, and half tangents, which take a fifth of a vertex' memory.
    pub(crate) fn attributes(&mut self, count: u64) -> Result<(), Error> {
        self.attributes = self.attributes.saturating_add(count);
        self.check_expanded("vertex attributes", self.attributes / 4)
    }

    pub(crate) fn objects(&mut self, count: u64) -> Result<(), Error> {
        self.objects = self.objects.saturating_add(count);
        check("objects", self.objects, self.limits.objects, "Limits::objects")
    }

    /// Whether so many more would be within the limit.
    pub(crate) fn check_objects(&self, count: u64) -> Result<(), Error> {
        check("objects", self.objects.saturating_add(count), self.limits.objects, "Limits::objects")
    }

    fn check_expanded(&self, what: &'static str, count: u64) -> Result<(), Error> {
        check(what, count, self.bytes.saturating_add(self.limits.expanded), "Limits::expanded")
    }
}

fn check(what: &'static str, count: u64, limit: u64, field: &'static str) -> Result<(), Error> {
    if count > limit { Err(Error::Limit { what, count, limit, field }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_name_the_field_to_raise() {
        let limits = Limits {
            file_bytes: 10,
            vertices: 20,
            triangles: 20,
            expanded: 3,
            objects: 1,
            nesting: 1,
            ..Limits::default()
        };
        let field = |error: Error| if let Error::Limit { field, .. } = error { field } else { panic!("{error}") };
        assert_eq!(field(Budget::new(&limits, 11).err().unwrap()), "Limits::file_bytes");
        let budget = || Budget::new(&limits, 10).unwrap();
        assert_eq!(field(budget().add_bytes(1).unwrap_err()), "Limits::file_bytes");
        assert_eq!(field(budget().vertices(14).unwrap_err()), "Limits::expanded");
        assert_eq!(field(budget().vertices(u64::MAX).unwrap_err()), "Limits::vertices");
        assert_eq!(field(budget().triangles(21).unwrap_err()), "Limits::triangles");
        assert_eq!(field(budget().objects(2).unwrap_err()), "Limits::objects");
        let mut budget = budget();
        budget.vertices(10).unwrap();
        budget.vertices(3).unwrap();
        assert_eq!(field(budget.vertices(1).unwrap_err()), "Limits::expanded");
    }
}
