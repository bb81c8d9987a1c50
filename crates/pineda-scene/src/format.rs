//! Which format a file is in.

use std::fmt;
use std::path::Path;

/// A file format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront OBJ, with its MTL material libraries.
    Obj,
    /// STL, ASCII or binary.
    Stl,
    /// PLY 1.0, ASCII or binary of either byte order.
    Ply,
    /// 3MF.
    ThreeMf,
    /// glTF 2.0, as JSON or as a GLB container.
    Gltf,
}

impl Format {
    /// By the extension, in any case: `obj`, `stl`, `ply`, `3mf`, `gltf`, `glb`.
    pub fn from_extension(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            "3mf" => Some(Self::ThreeMf),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }

    /// By what the file begins with; for STL also by its length.
    pub fn from_content(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"glTF") {
            return Some(Self::Gltf);
        }
        if crate::threemf::looks_like_3mf(bytes) {
            return Some(Self::ThreeMf);
        }
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let first_line = text.split(|b| matches!(b, b'\n' | b'\r')).next().unwrap_or_default();
        if first_line.trim_ascii() == b"ply" {
            return Some(Self::Ply);
        }
        if text.trim_ascii_start().starts_with(b"{") {
            return Some(Self::Gltf);
        }
        if crate::stl::looks_like_stl(bytes) {
            return Some(Self::Stl);
        }
        looks_like_obj(text).then_some(Self::Obj)
    }
}

/// Whether the first line that is neither empty nor a comment is a statement of an OBJ file.
fn looks_like_obj(text: &[u8]) -> bool {
    let mut lines = text.split(|b| matches!(b, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    let Some(line) = lines.find(|line| !line.is_empty() && line[0] != b'#') else { return false };
    let keyword = line.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    matches!(keyword, b"v" | b"vn" | b"vt" | b"f" | b"o" | b"g" | b"s" | b"mtllib" | b"usemtl")
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Ply => "PLY",
            Self::ThreeMf => "3MF",
            Self::Gltf => "glTF",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn format_from_extension() {
        let of = |name: &str| Format::from_extension(Path::new(name));
        assert_eq!(of("a.OBJ"), Some(Format::Obj));
        assert_eq!(of("dir.ply/b.StL"), Some(Format::Stl));
        assert_eq!(of("c.3mf"), Some(Format::ThreeMf));
        assert_eq!(of("c.gltf"), Some(Format::Gltf));
        assert_eq!(of("c.glb"), Some(Format::Gltf));
        assert_eq!(of("ply"), None);
        assert_eq!(of("c.txt"), None);
    }

    #[test]
    fn format_from_content() {
        let of = |bytes: &[u8]| Format::from_content(bytes);
        assert_eq!(of(b"glTF\x02\0\0\0"), Some(Format::Gltf));
        assert_eq!(of(b"\xef\xbb\xbf {\"asset\":"), Some(Format::Gltf));
        assert_eq!(of(b"PK\x03\x04\x14\0"), Some(Format::ThreeMf));
        assert_eq!(of(b"ply\r\nformat ascii 1.0"), Some(Format::Ply));
        assert_eq!(of(b"plywood"), None);
        assert_eq!(of(b"solid a\nfacet normal 0 0 1"), Some(Format::Stl));
        assert_eq!(of(&[0; 84]), Some(Format::Stl));
        assert_eq!(of(b"# by hand\n\n  v 1 2 3\n"), Some(Format::Obj));
        assert_eq!(of(b"hello"), None);
        assert_eq!(of(b""), None);
    }
}
