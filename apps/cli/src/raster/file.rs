//! The JSON file of `pineda raster`, read and checked; docs/raster-json.md describes it.

use crate::failure::Failure;
use crate::values::Size;
use pineda::{Cull, FrontFace, Space};
use pineda_scene::read_file;
use serde::Deserialize;
use std::io;
use std::path::Path;

/// What a file describes, with everything in range.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drawing {
    pub(crate) size: Size,
    pub(crate) space: Space,
    pub(crate) vertices: Vec<Vertex>,
    /// Every index names a vertex.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) cull: Cull,
    pub(crate) front_face: FrontFace,
    pub(crate) depth_test: bool,
    pub(crate) background: [f32; 3],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vertex {
    /// In the drawing's space; of NDC already multiplied by w, so that it is clip space.
    pub(crate) position: [f32; 4],
    pub(crate) color: [f32; 4],
}

/// A file has at most so many bytes.
const MOST_BYTES: u64 = 1 << 30;

/// More triangles than `--show id` has numbers for.
const MAX_TRIANGLES: usize = (1 << 24) - 1;

impl Drawing {
    /// The triangle of tutorial 1, "The Rasterization Stage" of scratchapixel.com: what its raster2d.cpp draws.
    pub(crate) fn of_tutorial_1() -> Self {
        let vertex = |x, y, [r, g, b]: [f32; 3]| Vertex { position: [x, y, 0.0, 1.0], color: [r, g, b, 1.0] };
        Self {
            size: Size { width: 512, height: 512 },
            space: Space::Raster,
            vertices: vec![
                vertex(491.407, 411.407, [1.0, 0.0, 0.0]),
                vertex(148.593, 68.5928, [0.0, 1.0, 0.0]),
                vertex(148.593, 411.407, [0.0, 0.0, 1.0]),
            ],
            triangles: vec![[0, 1, 2]],
            cull: Cull::None,
            front_face: FrontFace::CounterClockwise,
            depth_test: false,
            background: [0.0; 3],
        }
    }
}

/// Reads and checks a file.
pub(crate) fn read(path: &Path) -> Result<Drawing, Failure> {
    let unreadable = |error: io::Error| {
        Failure::data(format_args!("the file cannot be read: {error}"))
            .at(path.display())
            .help("without a file, `pineda raster -o OUT.png` draws tutorial 1's triangle")
    };
    let text = read_file(path, MOST_BYTES).map_err(unreadable)?;
    parse(&text).map_err(|failure| match failure {
        Wrong::Json(error) => {
            let (line, column) = (error.line(), error.column());
            // serde_json repeats the place at the end of its message.
            let message = error.to_string();
            let message = message.rsplit_once(" at line ").map_or(&*message, |(message, _)| message);
            Failure::data(message)
                .at(format_args!("{}, line {line}, column {column}", path.display()))
                .help("`pineda raster --help` shows what the file looks like")
        }
        Wrong::Value { place, what } => Failure::data(what).at(format_args!("{}, {place}", path.display())),
    })
}

/// Why a file is no drawing.
#[derive(Debug)]
pub(crate) enum Wrong {
    /// It is not JSON, or not of the right shape.
    Json(serde_json::Error),
    /// It is of the right shape, but a value in it is out of range.
    Value { place: String, what: String },
}

fn wrong<T>(place: impl Into<String>, what: impl Into<String>) -> Result<T, Wrong> {
    Err(Wrong::Value { place: place.into(), what: what.into() })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    size: SizeField,
    #[serde(default)]
    space: SpaceField,
    vertices: Vec<VertexField>,
    triangles: Option<Vec<[u32; 3]>>,
    #[serde(default)]
    cull: CullField,
    #[serde(default)]
    front_face: FrontFaceField,
    depth_test: Option<bool>,
    #[serde(default)]
    background: [f32; 3],
}

#[derive(Deserialize)]
#[serde(try_from = "[u32; 2]")]
struct SizeField(Size);

impl TryFrom<[u32; 2]> for SizeField {
    type Error = String;

    fn try_from([width, height]: [u32; 2]) -> Result<Self, String> {
        Size::new(width, height).map(Self)
    }
}

#[derive(Clone, Copy, Default, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum SpaceField {
    #[default]
    Raster,
    Ndc,
    Clip,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum CullField {
    #[default]
    None,
    Front,
    Back,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum FrontFaceField {
    #[default]
    CounterClockwise,
    Clockwise,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct VertexField {
    position: Row<2, 4>,
    depth: Option<f32>,
    w: Option<f32>,
    #[serde(alias = "colour")]
    color: Option<Row<3, 4>>,
}

/// `LEAST` to `MOST` numbers.
#[derive(Deserialize)]
#[serde(try_from = "Vec<f32>")]
struct Row<const LEAST: usize, const MOST: usize>(Vec<f32>);

impl<const LEAST: usize, const MOST: usize> TryFrom<Vec<f32>> for Row<LEAST, MOST> {
    type Error = String;

    fn try_from(numbers: Vec<f32>) -> Result<Self, String> {
        if (LEAST..=MOST).contains(&numbers.len()) {
            Ok(Self(numbers))
        } else {
            Err(format!("{} numbers, expected {LEAST} to {MOST}", numbers.len()))
        }
    }
}

/// A drawing, checked, from the bytes of its file.
pub(crate) fn parse(text: &[u8]) -> Result<Drawing, Wrong> {
    if text.starts_with(b"\xff\xfe") || text.starts_with(b"\xfe\xff") {
        return wrong("line 1", "the file is text in UTF-16: save it in UTF-8");
    }
    // Some editors begin with a mark.
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let file: File = serde_json::from_slice(text).map_err(Wrong::Json)?;
    let count = file.vertices.len();
    let has_depth = file.vertices.iter().any(|v| v.depth.is_some() || v.position.0.len() > 2);
    let vertices: Result<Vec<Vertex>, Wrong> =
        file.vertices.iter().enumerate().map(|(i, field)| vertex(i, field, file.space)).collect();
    let vertices = vertices?;
    let triangles = match file.triangles {
        Some(triangles) => triangles,
        None if !count.is_multiple_of(3) => {
            return wrong(
                "vertices",
                format!("{count} vertices without \"triangles\" are not whole triangles: give a multiple of three"),
            );
        }
        None => (0..count as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
    };
    if triangles.len() > MAX_TRIANGLES {
        return wrong("triangles", format!("{} triangles; {MAX_TRIANGLES} are allowed", triangles.len()));
    }
    for (t, triangle) in triangles.iter().enumerate() {
        for (corner, &index) in triangle.iter().enumerate() {
            if index as usize >= count {
                return wrong(
                    format!("triangles[{t}][{corner}]"),
                    format!("index {index} names no vertex: there are {count}, numbered from 0"),
                );
            }
        }
    }
    Ok(Drawing {
        size: file.size.0,
        space: if file.space == SpaceField::Raster { Space::Raster } else { Space::Clip },
        vertices,
        triangles,
        cull: match file.cull {
            CullField::None => Cull::None,
            CullField::Front => Cull::Front,
            CullField::Back => Cull::Back,
        },
        front_face: match file.front_face {
            FrontFaceField::CounterClockwise => FrontFace::CounterClockwise,
            FrontFaceField::Clockwise => FrontFace::Clockwise,
        },
        depth_test: file.depth_test.unwrap_or(has_depth),
        background: file.background,
    })
}

fn vertex(i: usize, field: &VertexField, space: SpaceField) -> Result<Vertex, Wrong> {
    let row = &field.position.0;
    let component = |at: usize, name: &str, apart: Option<f32>, default: f32| match (row.get(at), apart) {
        (Some(_), Some(_)) => wrong(
            format!("vertices[{i}]"),
            format!("the position has {} numbers and there is \"{name}\", too: give it once", row.len()),
        ),
        (Some(&number), None) | (None, Some(number)) => Ok(number),
        (None, None) => Ok(default),
    };
    let depth = component(2, "depth", field.depth, 0.0)?;
    let w = component(3, "w", field.w, 1.0)?;
    let position = match space {
        SpaceField::Ndc => [row[0] * w, row[1] * w, depth * w, w],
        SpaceField::Raster | SpaceField::Clip => [row[0], row[1], depth, w],
    };
    let mut color = [1.0; 4];
    if let Some(Row(given)) = &field.color {
        color[..given.len()].copy_from_slice(given);
    }
    if !position.iter().all(|number| number.is_finite()) {
        return wrong(format!("vertices[{i}]"), "the position times w is too large for 32-bit floating point");
    }
    if space != SpaceField::Clip && w <= 0.0 {
        return wrong(
            format!("vertices[{i}]"),
            format!(
                "w is {w}, but what is on the raster lies before the eye: w must be above 0; in \"clip\" space it may be anything"
            ),
        );
    }
    Ok(Vertex { position, color })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        match parse(text.as_bytes()) {
            Ok(drawing) => panic!("{drawing:?}"),
            Err(Wrong::Json(error)) => error.to_string(),
            Err(Wrong::Value { place, what }) => format!("{place}: {what}"),
        }
    }

    #[test]
    fn file_of_tutorial_1_is_the_built_in_one() {
        let text = include_str!("../../examples/tutorial1.json");
        assert_eq!(parse(text.as_bytes()).unwrap(), Drawing::of_tutorial_1());
    }

    #[test]
    fn file_defaults() {
        let drawing = parse(br#"{"size": [4, 2], "vertices": [{"position": [1, 2]}]}"#);
        assert!(matches!(drawing, Err(Wrong::Value { .. })), "one vertex is no triangle");
        let drawing = parse(br#"{"size": [4, 2], "vertices": []}"#).unwrap();
        assert_eq!(drawing.triangles, [[0; 3]; 0]);
        assert!(!drawing.depth_test && drawing.space == Space::Raster && drawing.cull == Cull::None);
    }

    #[test]
    fn file_positions() {
        let vertex = |space: &str, vertex: &str| {
            let text = format!(r#"{{"size": [1, 1], "space": "{space}", "vertices": [{vertex}], "triangles": []}}"#);
            let drawing = parse(text.as_bytes()).unwrap();
            (drawing.vertices[0].position, drawing.depth_test)
        };
        assert_eq!(vertex("raster", r#"{"position": [1, 2]}"#), ([1.0, 2.0, 0.0, 1.0], false));
        assert_eq!(vertex("raster", r#"{"position": [1, 2], "w": 3}"#), ([1.0, 2.0, 0.0, 3.0], false));
        assert_eq!(vertex("raster", r#"{"position": [1, 2], "depth": 0.5}"#), ([1.0, 2.0, 0.5, 1.0], true));
        assert_eq!(vertex("ndc", r#"{"position": [1, 2, 0.5, 4]}"#), ([4.0, 8.0, 2.0, 4.0], true));
        assert_eq!(vertex("clip", r#"{"position": [1, 2, 0.5], "w": -1}"#), ([1.0, 2.0, 0.5, -1.0], true));
    }

    #[test]
    fn file_errors_say_where() {
        assert!(message("{").contains("line 1 column 1"));
        assert!(message(r#"{"size": [0, 4], "vertices": []}"#).contains("both sides must lie in 1 to 16384"));
        assert!(message("{\"size\": [4, 4],\n \"shape\": 1}").contains("unknown field `shape`"));
        assert!(message("{\"size\": [4, 4],\n \"shape\": 1}").contains("line 2"));
        assert!(message(r#"{"size": [4, 4]}"#).contains("missing field `vertices`"));
        let vertices =
            |v: &str| message(&format!(r#"{{"size": [4, 4], "vertices": [{v}], "triangles": [[0, 0, 1]]}}"#));
        assert_eq!(
            vertices(r#"{"position": [1, 2]}"#),
            "triangles[0][2]: index 1 names no vertex: there are 1, numbered from 0"
        );
        assert!(vertices(r#"{"position": [1]}"#).contains("1 numbers, expected 2 to 4"));
        assert!(vertices(r#"{"position": [1, 2, 3], "depth": 1}"#).contains("give it once"));
        assert!(vertices(r#"{"position": [1, 2], "w": 0}"#).contains("above 0"));
        assert!(vertices(r#"{"position": [1, 1e39]}"#).contains("number out of range"));
        assert!(vertices(r#"{"position": [1, 2], "color": [1, 2]}"#).contains("expected 3 to 4"));
        let ndc = r#"{"size": [4, 4], "space": "ndc", "vertices": [{"position": [1e20, 1], "w": 1e20}]}"#;
        assert!(message(ndc).contains("vertices[0]: the position times w is too large"));
        assert!(vertices(r#"{"position": [1, NaN]}"#).contains("line 1 column"));
    }
}
