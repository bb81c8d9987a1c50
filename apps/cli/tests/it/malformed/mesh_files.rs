//! OBJ with MTL, STL, PLY.

use super::make::{cut, floats, patched, utf16};
use super::{Blank, Case, Error, Picture, Wanted, case};

pub(super) fn cases() -> Vec<Case> {
    [obj(), mtl(), stl(), ply()].into_iter().flatten().collect()
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn obj() -> Vec<Case> {
    let of = |name, text: &str, wanted| case(name, "a.obj", text, wanted);
    let more = |name, text: &str, wanted| case(name, "a.obj", format!("{TRIANGLE}f 1 2 3\n{text}"), wanted);
    // A comb: not convex, and as slow to cut up as can be.
    let mut comb = String::new();
    for i in 0..20_000 {
        comb += &format!("v {i} {} 0\n", if i % 2 == 0 { 0 } else { 1000 + i });
    }
    comb += &(1..=20_000).fold("f".to_owned(), |face, i| format!("{face} {i}"));
    vec![
        of("obj-empty", "", Error(&["nothing to draw"])),
        of("obj-comments", "# nothing\n#\n", Error(&["nothing to draw"])),
        of("obj-without-faces", TRIANGLE, Error(&["nothing to draw"])),
        of("obj-cut-short", "v 0 0 0\nv 1 0 0\nv 0 1", Error(&["OBJ, line 3"])),
        more("obj-index-0", "f 0 1 2\n", Error(&["OBJ, line 5", "count from 1"])),
        more("obj-index-too-large", "f 1 2 4\n", Error(&["OBJ, line 4: face 2", "vertex 4", "has 3"])),
        more("obj-index-too-negative", "f -1 -2 -4\n", Error(&["OBJ, line 5"])),
        more("obj-index-overflows", "f 1 2 99999999999999999999\n", Error(&["OBJ, line 5", "99999999999999999999"])),
        more("obj-index-of-words", "f one two three\n", Error(&["OBJ, line 5", "one"])),
        more("obj-face-of-two", "f 1 2\n", Picture(&["1 face with fewer than three corners"])),
        more("obj-number-nan", "v nan 0 0\nf 1 2 4\n", Picture(&["1 triangle dropped"])),
        more("obj-number-infinite", "v 1e999 0 0\nf 1 2 4\n", Picture(&["1 triangle dropped"])),
        more("obj-number-strange", "v 1,5 0 0\n", Error(&["OBJ, line 5", "1,5"])),
        more("obj-continued-for-ever", &"\\\n".repeat(100_000), Picture(&[])),
        more("obj-line-long", &format!("o {}\n", "x".repeat(1 << 20)), Picture(&[])),
        more("obj-many-groups", &"g a\ng b\n".repeat(100_000), Picture(&[])),
        more("obj-many-materials", &"usemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n".repeat(20_000), Picture(&["'a', 'b'"])),
        of("obj-of-zeros", &"\0".repeat(1000), Error(&["nothing to draw"])),
        case("obj-utf16", "a.obj", utf16("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), Error(&["OBJ, line 1", "UTF-16"])),
        case("obj-comb", "a.obj", comb, Picture(&[])),
        case("obj-is-png", "a.obj", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec(), Error(&["nothing to draw"])),
    ]
}

fn mtl() -> Vec<Case> {
    let with = |name, mtl: &[u8], wanted| {
        let obj = format!("mtllib a.mtl\n{TRIANGLE}vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
        case(name, "a.obj", obj, wanted).beside("a.mtl", mtl)
    };
    let library = |name, library: &str, wanted| {
        case(name, "a.obj", format!("mtllib {library}\n{TRIANGLE}usemtl a\nf 1 2 3\n"), wanted)
    };
    vec![
        with("mtl-empty", b"", Picture(&["'a'"])),
        with("mtl-colour-nan", b"newmtl a\nKd nan inf -inf\nd nan\nNs 1e999\n", Picture(&["line 2: not understood"])),
        with("mtl-colour-missing", b"newmtl a\nKd\nd\nmap_Kd\n", Picture(&["line 2: not understood"])),
        with("mtl-options-without-end", b"newmtl a\nmap_Kd -s 1 2 3 -o -bm\n", Picture(&["line 2: not understood"])),
        with("mtl-scale-huge", b"newmtl a\nmap_Kd -s 1e999 nan 0 gone.png\n", Picture(&["gone.png"])),
        with(
            "mtl-image-outside",
            b"newmtl a\nmap_Kd ../../../etc/passwd\n",
            Picture(&["image '../../../etc/passwd' not found"]),
        ),
        with("mtl-image-absolute", b"newmtl a\nmap_Kd /etc/passwd\n", Picture(&["image '/etc/passwd' not found"])),
        with("mtl-of-bytes", &[0xfe; 5000], Picture(&["'a'"])),
        with("mtl-twice", b"newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\n", Picture(&[])),
        library("mtllib-missing", "gone.mtl", Picture(&["gone.mtl", "not found"])),
        library("mtllib-outside", "../../a.mtl", Picture(&["outside the model's folder"])),
        library("mtllib-of-windows", "C:\\a.mtl", Picture(&["outside the model's folder"])),
        library("mtllib-is-the-model", "a.obj", Picture(&["'a'"])),
        library("mtllib-many-times", &"gone.mtl ".repeat(5000), Picture(&["not found"])),
    ]
}

fn binary_stl(positions: &[[f32; 9]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((positions.len() as u32).to_le_bytes());
    for corners in positions {
        bytes.extend([0; 12]);
        bytes.extend(floats(corners));
        bytes.extend([0; 2]);
    }
    bytes
}

fn stl() -> Vec<Case> {
    const FACET: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.5];
    let good = binary_stl(&[FACET, FACET]);
    let of = |name, bytes: Vec<u8>, wanted| case(name, "a.stl", bytes, wanted);
    let text = |name, text: &str, wanted| case(name, "a.stl", text, wanted);
    let ascii = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.5\nendloop\nendfacet\nendsolid a\n";
    vec![
        of("stl-empty", Vec::new(), Error(&["STL, byte 0"])),
        of("stl-header-cut-short", cut(good.clone(), 83), Error(&["STL, byte 83"])),
        of("stl-cut-short", cut(good.clone(), 150), Error(&["STL, byte 80", "2 facets", "bytes for 1"])),
        of("stl-count-huge", patched(good.clone(), 80, &[255; 4]), Error(&["4294967295 facets"])),
        of("stl-count-0", patched(good.clone(), 80, &[0; 4]), Error(&["nothing to draw"])),
        of("stl-bytes-behind", [&good[..], &[0; 7]].concat(), Picture(&["7 bytes behind the last facet"])),
        of("stl-nan", binary_stl(&[FACET, [f32::NAN; 9]]), Picture(&["1 triangle dropped"])),
        of("stl-all-nan", binary_stl(&[[f32::NAN; 9]]), Error(&["nothing to draw", "1 triangle dropped"])),
        of("stl-without-area", binary_stl(&[[1.0; 9]]), Blank(&[])),
        text("stl-text-good", ascii, Picture(&[])),
        text("stl-text-cut-short", &ascii[..60], Error(&["STL, line", "three numbers"])),
        text("stl-text-words", "solid a\nfacet of something else\n", Error(&["STL, line 2", "'of'"])),
        text("stl-text-numbers", &ascii.replace("0.5", "0,5"), Error(&["STL, line 6", "0,5"])),
        text("stl-text-nan", &ascii.replace("0.5", "nan"), Error(&["nothing to draw"])),
        text("stl-text-empty", "solid a\nendsolid a\n", Error(&["nothing to draw"])),
        text("stl-text-solids", &"solid a\nendsolid a\n".repeat(50_000), Error(&["nothing to draw"])),
    ]
}

fn ply() -> Vec<Case> {
    let header = |encoding: &str, vertices: &str, faces: &str| {
        format!(
            "ply\nformat {encoding} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let ascii = |name, vertices: &str, faces: &str, body: &str, wanted| {
        case(name, "a.ply", header("ascii", vertices, faces) + body, wanted)
    };
    let binary = |big: bool, face: &[i32]| {
        let order = |bytes: [u8; 4]| if big { [bytes[3], bytes[2], bytes[1], bytes[0]] } else { bytes };
        let mut bytes = header(if big { "binary_big_endian" } else { "binary_little_endian" }, "3", "1").into_bytes();
        for number in [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
            bytes.extend(order(number.to_le_bytes()));
        }
        bytes.push(face.len() as u8);
        face.iter().for_each(|index| bytes.extend(order(index.to_le_bytes())));
        bytes
    };
    let little = binary(false, &[0, 1, 2]);
    let as_little =
        String::from_utf8_lossy(&header("binary_big_endian", "3", "1").replace("big", "little").into_bytes())
            .into_owned();
    let swapped =
        [as_little.as_bytes(), &binary(true, &[0, 1, 2])[header("binary_big_endian", "3", "1").len()..]].concat();
    let of = |name, bytes: Vec<u8>, wanted: Wanted| case(name, "a.ply", bytes, wanted);
    let with_element =
        |element: &str| header("ascii", "3", "1").replace("element face", &format!("{element}\nelement face")) + body;
    vec![
        ascii("ply-good", "3", "1", body, Picture(&[])),
        of("ply-empty", Vec::new(), Error(&["PLY, line 1"])),
        of("ply-header-cut-short", b"ply\nformat ascii 1.0\nelement vertex 3\n".to_vec(), Error(&["'end_header'"])),
        of("ply-without-format", b"ply\nelement vertex 0\nend_header\n".to_vec(), Error(&["PLY, line 2", "format"])),
        of("ply-format-unknown", header("middle_endian", "3", "1").into_bytes(), Error(&["line 2", "'middle_endian'"])),
        of(
            "ply-type-unknown",
            header("ascii", "3", "1").replace("uchar int", "uchar word").into_bytes(),
            Error(&["line 8", "'word' is no type"]),
        ),
        ascii("ply-count-negative", "-3", "1", body, Error(&["line 3", "needs a count"])),
        ascii("ply-count-huge", "4000000000", "1", body, Error(&["line 3", "cut short"])),
        ascii("ply-count-overflows", "18446744073709551615", "1", body, Error(&["line 3"])),
        ascii("ply-faces-huge", "3", "4000000000", body, Error(&["line 7", "cut short"])),
        ascii("ply-cut-short", "3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1", Error(&["cut short"])),
        ascii(
            "ply-index-out-of-range",
            "3",
            "1",
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
            Error(&["face 0", "vertex 3", "3 vertices"]),
        ),
        ascii("ply-index-negative", "3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", Error(&["names vertex -1"])),
        ascii(
            "ply-index-fraction",
            "3",
            "1",
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
            Error(&["1.5 is not a whole number"]),
        ),
        ascii(
            "ply-list-negative",
            "3",
            "1",
            "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n",
            Error(&["list 'vertex_indices' of -3"]),
        ),
        ascii("ply-list-huge", "3", "1", "0 0 0\n1 0 0\n0 1 0\n9000000000000000000 0 1 2\n", Error(&["cut short"])),
        ascii("ply-number-of-words", "3", "1", &body.replace("1 0 0", "one 0 0"), Error(&["'one' is not a number"])),
        ascii(
            "ply-nan",
            "3",
            "1",
            &body.replace("1 0 0", "nan 0 0"),
            Error(&["nothing to draw", "1 triangle dropped"]),
        ),
        ascii(
            "ply-face-of-two",
            "3",
            "1",
            "0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
            Error(&["nothing to draw", "1 face with fewer"]),
        ),
        of("ply-element-of-nothing", with_element("element dust 18000000000").into_bytes(), Picture(&[])),
        of(
            "ply-vertices-of-nothing",
            b"ply\nformat ascii 1.0\nelement vertex 9000000000000000000\nend_header\n".to_vec(),
            Error(&["line 3"]),
        ),
        of("ply-binary-good", little.clone(), Picture(&[])),
        of("ply-binary-cut-short", cut(little.clone(), little.len() - 3), Error(&["PLY", "cut short"])),
        of(
            "ply-binary-list-long",
            {
                let at = little.len() - 13;
                patched(little.clone(), at, &[255])
            },
            Error(&["cut short"]),
        ),
        of("ply-binary-index", binary(false, &[0, 1, 77]), Error(&["names vertex 77"])),
        of("ply-big-endian-good", binary(true, &[0, 1, 2]), Picture(&[])),
        of("ply-big-endian-called-little", swapped, Error(&["names vertex"])),
        of(
            "ply-header-long",
            ("ply\nformat ascii 1.0\n".to_owned() + &"comment dust\n".repeat(100_000)).into_bytes(),
            Error(&["'end_header'"]),
        ),
        of(
            "ply-properties-many",
            header("ascii", "3", "1").replace("property float z", &"property float z\n".repeat(100_000)).into_bytes(),
            Error(&["cut short"]),
        ),
        case(
            "ply-image-outside",
            "a.ply",
            header("ascii", "3", "1")
                .replace("element vertex", "comment TextureFile ../../a.png\nelement vertex")
                .replace("property float z", "property float z\nproperty float s\nproperty float t")
                + "0 0 0 0 0\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 2\n",
            Picture(&["outside the model's folder"]),
        ),
    ]
}
