use pineda_scene::{Format, Loaded, Normals};

use crate::{corners, only};

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]];

fn read(bytes: impl AsRef<[u8]>) -> Loaded {
    crate::read(Format::Stl, bytes).unwrap()
}

fn binary(header: &[u8], attributes: &[u16]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((attributes.len() as u32).to_le_bytes());
    for attribute in attributes {
        bytes.extend([0; 12]);
        bytes.extend(TRIANGLE.iter().flatten().flat_map(|c| c.to_le_bytes()));
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

fn ascii(name: &str) -> String {
    format!(
        "solid {name}\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0.5\n  endloop\n endfacet\nendsolid {name}\n"
    )
}

#[test]
fn stl_binary() {
    let loaded = read(binary(b"", &[0, 0]));
    assert_eq!(corners(only(&loaded)), [TRIANGLE, TRIANGLE]);
    assert_eq!(only(&loaded).normals, Normals::Absent);
    assert!(only(&loaded).vertices.iter().all(|v| v.color == [1.0; 4]));
    assert!(loaded.scene.materials[0].double_sided && loaded.notes.is_empty());
}

#[test]
fn stl_binary_may_begin_with_solid() {
    assert_eq!(corners(only(&read(binary(b"solid part", &[0])))), [TRIANGLE]);
    // Also with bytes behind the last facet: zeros are no text.
    let mut bytes = binary(b"solid part", &[0]);
    bytes.extend([0; 3]);
    let loaded = read(bytes);
    assert_eq!(corners(only(&loaded)), [TRIANGLE]);
    assert_eq!(loaded.notes, ["3 bytes behind the last facet ignored"]);
}

#[test]
fn stl_binary_colours() {
    let colors = |loaded: &Loaded| only(loaded).vertices.chunks(3).map(|v| v[0].color).collect::<Vec<_>>();
    // VisCAM: bit 15 says that there is a colour; red is on top.
    let loaded = read(binary(b"", &[0x8000 | 31 << 10, 0, 0x8000 | 31]));
    assert_eq!(colors(&loaded), [[1.0, 0.0, 0.0, 1.0], [1.0; 4], [0.0, 0.0, 1.0, 1.0]]);
    // Magics: bit 15 says that the header's colour counts; red is at the bottom.
    let loaded = read(binary(b"x COLOR=\xff\xff\x00\x80 y", &[31, 0x8000, 31 << 10]));
    let alpha = 128.0 / 255.0;
    assert_eq!(colors(&loaded), [[1.0, 0.0, 0.0, alpha], [1.0, 1.0, 0.0, alpha], [0.0, 0.0, 1.0, alpha]]);
}

#[test]
fn stl_ascii() {
    let loaded = read(ascii("my part"));
    assert_eq!(corners(only(&loaded)), [TRIANGLE]);
    assert_eq!(&*only(&loaded).name, "my part");
    assert_eq!(only(&loaded).normals, Normals::Absent);
}

#[test]
fn stl_ascii_in_any_case_and_spacing() {
    let plain = read(ascii("a"));
    for text in [
        ascii("a").to_uppercase(),
        ascii("a").replace('\n', "\r\n"),
        ascii("a").replace('\n', "\r"),
        ascii("a").replace('\n', " "),
        ascii("a").replace(' ', "\t \t"),
        format!("\n\n  {}", ascii("a")),
        format!("\u{feff}{}", ascii("a")),
        ascii("a").replace("endsolid a", "endsolid"),
        ascii("a").replace("endsolid a\n", ""),
        ascii("").replace("facet normal 0 0 1", "facet"),
        // A name that could be mistaken.
        ascii("facet of a normal solid"),
    ] {
        assert_eq!(corners(only(&read(&text))), corners(only(&plain)), "{text:?}");
    }
    assert_eq!(&*only(&read(ascii("facet of a part"))).name, "facet of a part");
}

#[test]
fn stl_several_solids_become_objects() {
    let loaded = read(format!("{}{}{}", ascii("a"), "solid empty\nendsolid\n", ascii("b")));
    let names: Vec<_> = loaded.scene.objects.iter().map(|o| &*o.name).collect();
    assert_eq!(names, ["a", "b"]);
    let on_one_line = format!("{}{}", ascii("a part"), ascii("b")).replace('\n', " ");
    let names: Vec<_> = read(on_one_line).scene.objects.iter().map(|o| o.name.to_string()).collect();
    assert_eq!(names, ["a part", "b"]);
    assert_eq!(read(ascii("the solid part").repeat(2)).scene.objects.len(), 2);
}

#[test]
fn stl_facets_with_more_corners_are_polygons() {
    let text = ascii("a").replace("  endloop", "   vertex -1 1 0.5\n  endloop");
    assert_eq!(only(&read(text)).triangles, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn stl_errors() {
    let fails = |bytes: &[u8], says: &[&str]| crate::fails(Format::Stl, bytes, says);
    fails(b"", &["STL, byte 0", "ends here"]);
    fails(&binary(b"", &[])[..83], &["byte 83"]);
    fails(&binary(b"", &[]), &["nothing to draw"]);
    fails(&binary(b"", &[0, 0])[..150], &["byte 80", "2 facets", "bytes for 1"]);
    let mut huge = binary(b"", &[0]);
    huge[80..84].fill(0xff);
    fails(&huge, &["4294967295 facets"]);
    fails(ascii("a").replace("vertex 1 0 0", "vertex 1 0").as_bytes(), &["STL, line 6", "three numbers", "'vertex'"]);
    fails(b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2", &["the end of the file"]);
    fails(b"solid a\nhello", &["line 2", "'hello'", "expected solid"]);
    fails(b"solid a\nendsolid a\n", &["nothing to draw"]);
    fails(
        b"solid a\nfacet\nouter loop\nvertex 1 2 3\nendloop\nendfacet",
        &["nothing to draw", "1 face with fewer than three corners"],
    );
}
