use pineda_scene::{Format, Limits, Loaded, Normals, TextureRef, load_bytes};

use crate::{only, positions};

fn read(bytes: impl AsRef<[u8]>) -> Loaded {
    crate::read(Format::Ply, bytes).unwrap()
}

const XYZ: &str = "property float x\nproperty float y\nproperty float z\n";
const FACE: &str = "property list uchar int vertex_indices\n";

fn ascii(vertices: usize, vertex: &str, faces: usize, face: &str, body: &str) -> String {
    format!("ply\nformat ascii 1.0\nelement vertex {vertices}\n{vertex}element face {faces}\n{face}end_header\n{body}")
}

fn square(face: &str) -> String {
    ascii(4, XYZ, 1, FACE, &format!("0 0 0\n1 0 0\n1 1 0\n0 1 0\n{face}\n"))
}

#[test]
fn ply_ascii_square() {
    let loaded = read(square("4 0 1 2 3"));
    let object = only(&loaded);
    assert_eq!(positions(object), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(object.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(object.normals, Normals::Absent);
    assert!(object.vertices.iter().all(|v| v.color == [1.0; 4]));
    assert!(loaded.scene.materials[0].double_sided && loaded.notes.is_empty());
}

#[test]
fn ply_line_ends() {
    let plain = read(square("4 0 1 2 3"));
    for end in ["\r\n", "\r"] {
        assert_eq!(read(square("4 0 1 2 3").replace('\n', end)), plain, "{end:?}");
    }
}

/// A value for each property of [`everything`], as text and in either byte order.
struct Body {
    text: String,
    little: Vec<u8>,
    big: Vec<u8>,
}

impl Body {
    fn push(&mut self, kind: &str, value: f64) {
        let little: Vec<u8> = match kind {
            "char" => (value as i8).to_le_bytes().into(),
            "uchar" => (value as u8).to_le_bytes().into(),
            "short" => (value as i16).to_le_bytes().into(),
            "ushort" => (value as u16).to_le_bytes().into(),
            "int" => (value as i32).to_le_bytes().into(),
            "uint" => (value as u32).to_le_bytes().into(),
            "float" => (value as f32).to_le_bytes().into(),
            "double" => value.to_le_bytes().into(),
            _ => unreachable!(),
        };
        self.big.extend(little.iter().rev());
        self.little.extend(little);
        self.text += &if kind == "float" { format!("{} ", value as f32) } else { format!("{value} ") };
    }
}

/// Elements and properties that mean nothing to us before, between and behind those that do; the same in all encodings.
fn everything(index: &str, count: &str) -> [Vec<u8>; 3] {
    let header = format!(
        "comment made by hand\nobj_info x\nelement camera 2\nproperty double view_x\nproperty list uchar short extra\n\
         element vertex 4\nproperty short quality\nproperty double x\nproperty float y\nproperty int z\nproperty list uint char more\n\
         property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n\
         element face 2\nproperty char flags\nproperty list {count} {index} vertex_index\nproperty list uchar float texcoord\n\
         element nothing 99999999999\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
    );
    let mut body = Body { text: String::new(), little: Vec::new(), big: Vec::new() };
    let mut row = |values: &[(&str, f64)]| {
        for &(kind, value) in values {
            body.push(kind, value);
        }
        body.text.push('\n');
    };
    row(&[("double", 1.5), ("uchar", 0.0)]);
    row(&[("double", -1.5), ("uchar", 2.0), ("short", 300.0), ("short", -300.0)]);
    for (x, y, z) in [(0.1, 0.0, 0.0), (1.0, 0.1, 0.0), (1.0, 1.0, 2.0), (0.0, 1.0, 0.0)] {
        row(&[("short", -7.0), ("double", x), ("float", y), ("int", z), ("uint", 1.0), ("char", -1.0)]);
        row(&[
            ("float", 0.0),
            ("float", 0.0),
            ("float", 2.0),
            ("uchar", 255.0),
            ("uchar", 188.0),
            ("uchar", 0.0),
            ("uchar", 51.0),
        ]);
    }
    row(&[("char", 1.0), (count, 3.0), (index, 0.0), (index, 1.0), (index, 2.0), ("uchar", 1.0), ("float", 0.5)]);
    row(&[("char", 1.0), (count, 4.0), (index, 0.0), (index, 1.0), (index, 2.0), (index, 3.0), ("uchar", 0.0)]);
    row(&[("int", 0.0), ("int", 1.0)]);
    let file = |format: &str, body: &[u8]| [format!("ply\nformat {format} 1.0\n{header}").as_bytes(), body].concat();
    [
        file("ascii", body.text.as_bytes()),
        file("binary_little_endian", &body.little),
        file("binary_big_endian", &body.big),
    ]
}

#[test]
fn ply_encodings_and_index_types_are_equal() {
    let [text, ..] = everything("int", "uchar");
    let expected = read(&text);
    let object = only(&expected);
    assert_eq!(object.vertices[0].position, [0.1, 0.0, 0.0]);
    assert_eq!(object.vertices[2].position, [1.0, 1.0, 2.0]);
    assert_eq!(object.vertices[0].normal, [0.0, 0.0, 1.0]);
    assert_eq!(object.vertices[0].color, [1.0, 0.502_886_5, 0.0, 0.2]);
    assert_eq!((object.triangles.len(), object.normals), (3, Normals::Given));
    for index in ["char", "uchar", "short", "ushort", "int", "uint", "float", "double"] {
        for count in ["char", "uchar", "short", "ushort", "int", "uint"] {
            for bytes in everything(index, count) {
                assert_eq!(read(&bytes), expected, "{index} {count}");
            }
        }
    }
}

#[test]
fn ply_header_with_cr_before_binary_data_that_begin_with_lf() {
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement x 1\nproperty uchar y\nelement vertex 3\n{XYZ}element face 1\n{FACE}end_header\n"
    );
    for end in ["\n", "\r\n", "\r"] {
        let mut bytes = header.replace('\n', end).into_bytes();
        bytes.push(b'\n');
        bytes.extend([0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|c| c.to_le_bytes()));
        bytes.push(3);
        bytes.extend([0i32, 1, 2].iter().flat_map(|i| i.to_le_bytes()));
        assert_eq!(only(&read(bytes)).triangles, [[0, 1, 2]], "{end:?}");
    }
}

#[test]
fn ply_colours_of_all_types() {
    let color = |kind: &str, [r, g, b]: [&str; 3]| {
        let properties = format!("{XYZ}property {kind} red\nproperty {kind} green\nproperty {kind} blue\n");
        let body = format!("0 0 0 {r} {g} {b}\n1 0 0 {r} {g} {b}\n0 1 0 {r} {g} {b}\n3 0 1 2");
        only(&read(ascii(3, &properties, 1, FACE, &body))).vertices[1].color
    };
    // Half of full is 0.2140 in linear light.
    assert_eq!(color("uchar", ["255", "0", "51"]), [1.0, 0.0, 0.033_104_767, 1.0]);
    assert_eq!(color("ushort", ["65535", "0", "13107"]), [1.0, 0.0, 0.033_104_767, 1.0]);
    assert_eq!(color("float", ["1", "0", "0.5"]), [1.0, 0.0, 0.214_041_14, 1.0]);
    assert_eq!(color("double", ["255", "0", "127.5"]), [1.0, 0.0, 0.214_041_14, 1.0]);
    assert_eq!(color("uchar", ["999", "-5", "nan"]), [1.0, 0.0, 0.0, 1.0], "nonsense does no harm");
}

#[test]
fn ply_triangle_strips_with_restarts() {
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex 6\n{XYZ}element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    );
    let body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n11 0 1 2 3 4 -1 2 3 4 -1 5";
    let loaded = read(format!("{header}{body}"));
    assert_eq!(only(&loaded).triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 4], [2, 3, 4]]);
}

#[test]
fn ply_faces_may_come_before_vertices() {
    let text = format!(
        "ply\nformat ascii 1.0\nelement face 1\n{FACE}element vertex 3\n{XYZ}end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n"
    );
    assert_eq!(only(&read(text)).triangles, [[0, 1, 2]]);
}

#[test]
fn ply_notes() {
    let text = square("4 0 1 2 3 9").replace("end_header", "property uchar red\nend_header");
    assert_eq!(read(text).notes, ["colours of faces ignored: only vertices' are drawn"]);
    let text = square("4 0 1 2 3\n2 0 1").replace("face 1", "face 2");
    assert_eq!(read(text).notes, ["1 face with fewer than three corners skipped"]);
    // Unreferenced points may be anything.
    let loaded = read(square("3 0 1 2").replace("0 1 0\n3", "nan 1 0\n3"));
    assert!(loaded.notes.is_empty());
}

#[test]
fn ply_points_only() {
    let text = format!("ply\nformat ascii 1.0\nelement vertex 3\n{XYZ}end_header\n1 2 3\nnan 0 0\n4 5 6\n");
    let loaded = read(text);
    assert_eq!((&only(&loaded).points[..], only(&loaded).triangles.len()), (&[0, 2][..], 0));
    assert_eq!(loaded.notes, ["1 line or point dropped: infinite or not a number"]);
    // Where there are faces, the other vertices are no points.
    assert!(only(&read(square("3 0 1 2"))).points.is_empty());
    let none = format!("ply\nformat ascii 1.0\nelement vertex 0\n{XYZ}end_header\n");
    crate::fails(Format::Ply, none, &["nothing to draw"]);
}

#[test]
fn ply_texture_coordinates_and_their_image() {
    for (u, v) in [("s", "t"), ("u", "v"), ("texture_u", "texture_v")] {
        let vertex = format!("{XYZ}property float {u}\nproperty double {v}\n");
        let text = ascii(3, &vertex, 1, FACE, "0 0 0 0 0\n1 0 0 1 0.25\n0 1 0 0.5 1\n3 0 1 2\n");
        let text = text.replace("element vertex", "comment TextureFile a b.png\nelement vertex");
        let files = |path: &str, _max: u64| match path {
            "a b.png" => Ok(crate::images::pixel()),
            _ => Err(std::io::ErrorKind::NotFound.into()),
        };
        let loaded = load_bytes(text.as_bytes(), Format::Ply, &files, &Limits::default()).unwrap();
        assert_eq!(only(&loaded).uvs, [[[0.0, 1.0], [1.0, 0.75], [0.5, 0.0]]]);
        assert_eq!(loaded.scene.materials[0].base_color_texture, Some(TextureRef::new(0)));
        assert_eq!(&*loaded.scene.images[0].name, "a b.png");
        assert!(loaded.notes.is_empty());
        let loaded = read(&text);
        assert_eq!(loaded.notes, ["image 'a b.png' not found"]);
        assert_eq!(loaded.scene.materials[0].base_color_texture, None);
        assert_eq!(read(text.replace("a b.png", "../a.png")).notes.len(), 1);
    }
}

/// MeshLab's: for each corner of a face. Corners that differ in them are different vertices.
#[test]
fn ply_texture_coordinates_of_faces() {
    let text = ascii(
        4,
        XYZ,
        3,
        &format!("{FACE}property list uchar float texcoord\n"),
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1\n2 0 1 0\n3 0 2 3 6 0 0 1 1 0.5 0.75\n3 0 1 3 2 0.5 0.5\n",
    )
    .replace("face 3", "face 4");
    let loaded = read(text);
    let object = only(&loaded);
    assert_eq!(object.triangles, [[0, 1, 2], [0, 2, 3], [4, 5, 6]]);
    let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.5, 0.25], [0.5, 0.5], [0.0, 0.0], [0.0, 0.0]];
    assert_eq!(object.uvs, [uvs]);
    assert_eq!(positions(object)[4..], [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(loaded.notes, ["1 face with fewer than three corners skipped"]);
}

#[test]
fn ply_errors() {
    let fails = |text: &str, says: &[&str]| crate::fails(Format::Ply, text, says);
    fails("", &["PLY, line 1", "'ply'"]);
    fails("plywood", &["line 1"]);
    fails("ply\nformat ascii 1.0\n", &["before 'end_header'"]);
    fails("ply\nformat utf8 1.0\nend_header\n", &["line 2", "'utf8'", "expected ascii"]);
    fails("ply\nelement vertex 0\nend_header\n", &["line 2", "format"]);
    fails("ply\nformat ascii 1.0\nelement vertex many\nend_header", &["line 3", "'vertex'", "count"]);
    fails("ply\nformat ascii 1.0\nelement vertex -1\nend_header", &["line 3", "count"]);
    fails("ply\nformat ascii 1.0\nproperty int x\nend_header", &["line 3", "without an element"]);
    fails(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header",
        &["line 4", "'half'", "expected char"],
    );
    fails("ply\nformat ascii 1.0\nelement vertex 1\nhello\nend_header", &["line 4", "'hello'"]);
    fails(&square("4 0 1 2 4"), &["face 0", "vertex 4", "4 vertices"]);
    fails(&square("4 0 1 2 -1"), &["line 14", "face 0", "vertex -1"]);
    fails(&square("4 0 1 2 1.5"), &["line 14", "1.5", "whole"]);
    fails(&square("4 0 1 2 x"), &["line 14", "'x'"]);
    fails(&square("-1 0 1 2"), &["line 14", "-1"]);
    fails(&square("4 0 1 2"), &["cut short"]);
    fails(&square("99999 0 1 2"), &["cut short"]);
    fails(&square("4 0 1 2 3").replace("face 1", "face 2"), &["cut short"]);
    fails(&square("4 0 1 2 3").replace("property float y\n", ""), &["line 3", "'x', 'y' and 'z'"]);
    fails(&square("4 0 1 2 3").replace("vertex_indices", "corners"), &["'face'", "vertex_indices"]);
    fails(&square("4 0 1 2 3").replace("vertex 4", "vertex 99999999999"), &["line 3", "99999999999", "cut short"]);
    fails(&square("4 0 1 2 3").replace("vertex 4", "vertex 999999999999999999"), &["cut short"]);
}

#[test]
fn ply_binary_errors() {
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\n{XYZ}element face 1\nproperty list uint int vertex_indices\nend_header\n"
    );
    let mut bytes = header.into_bytes();
    bytes.extend([0; 36]);
    let with = |more: &[u8]| [&bytes[..], more].concat();
    crate::fails(Format::Ply, with(&[]), &["line 7", "1 of the element 'face'", "at least 4 bytes", "only 0"]);
    crate::fails(Format::Ply, with(&[255; 4]), &["PLY, byte", "cut short"]);
    crate::fails(Format::Ply, with(&[3, 0, 0, 0, 1, 0, 0, 0]), &["PLY, byte", "cut short"]);
    crate::fails(Format::Ply, with(&[1, 0, 0, 0, 255, 255, 255, 255]), &["PLY, byte", "vertex -1"]);
}
