//! 3MF: the zip file, the XML, and what refers to what.

use super::make::{cut, patched, utf16};
use super::{Blank, Case, Error, Picture, Wanted, case};
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

const RELATIONSHIPS: &str = r#"<Relationships><Relationship Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="/3D/a.model"/></Relationships>"#;

const GOOD: &str = r##"<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources><basematerials id="5"><base name="red" displaycolor="#ff0000"/></basematerials>
<object id="1" type="model" pid="5" pindex="0"><mesh>
<vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="0" z="1"/><vertex x="1" y="1" z="1"/></vertices>
<triangles><triangle v1="0" v2="1" v3="2"/><triangle v1="1" v2="3" v3="2" pid="5" p1="0"/></triangles></mesh></object>
<object id="2"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 0"/></components></object></resources>
<build><item objectid="2"/></build></model>"##;

fn zipped(parts: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in parts {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

fn of_model(model: &[u8]) -> Vec<u8> {
    zipped(&[("_rels/.rels", RELATIONSHIPS.as_bytes()), ("3D/a.model", model)])
}

pub(super) fn cases() -> Vec<Case> {
    [package(), model()].into_iter().flatten().collect()
}

fn package() -> Vec<Case> {
    let of = |name, bytes: Vec<u8>, wanted: Wanted| case(name, "a.3mf", bytes, wanted);
    let good = of_model(GOOD.as_bytes());
    let related =
        |relationships: &str| zipped(&[("_rels/.rels", relationships.as_bytes()), ("3D/a.model", GOOD.as_bytes())]);
    let directory = good.windows(4).position(|bytes| bytes == b"PK\x01\x02").unwrap();
    let end = good.len() - 22;
    vec![
        of("zip-good", good.clone(), Picture(&[])),
        of("zip-empty", Vec::new(), Error(&["3MF, zip file"])),
        of("zip-cut-short", cut(good.clone(), good.len() - 30), Error(&["3MF, zip file"])),
        of("zip-end-missing", cut(good.clone(), end), Error(&["3MF, zip file"])),
        of("zip-directory-elsewhere", patched(good.clone(), end + 16, &[255, 255, 255, 0]), Error(&["3MF, zip file"])),
        of("zip-many-entries", patched(good.clone(), end + 8, &[255, 254, 255, 254]), Error(&["3MF, zip file"])),
        of("zip-encrypted", patched(good.clone(), directory + 8, &[1]), Error(&["_rels/.rels", "cannot be read"])),
        of("zip-method-unknown", patched(good.clone(), directory + 10, &[99]), Error(&["_rels/.rels"])),
        of("zip-sum-wrong", patched(good.clone(), directory + 16, &[0; 4]), Error(&["_rels/.rels", "inflated"])),
        of("zip-offset-elsewhere", patched(good.clone(), directory + 42, &[200, 0, 0, 0]), Error(&["_rels/.rels"])),
        of("zip-is-stl", b"solid a\nendsolid a\n".to_vec(), Error(&["3MF, zip file"])),
        of(
            "zip-without-relationships",
            zipped(&[("3D/a.model", GOOD.as_bytes())]),
            Error(&["_rels/.rels", "no such part"]),
        ),
        of(
            "zip-without-model",
            zipped(&[("_rels/.rels", RELATIONSHIPS.as_bytes())]),
            Error(&["3d/a.model", "no such part"]),
        ),
        of(
            "zip-relationship-outside",
            related(&RELATIONSHIPS.replace("/3D/", "/../../../etc/")),
            Error(&["no such part"]),
        ),
        of("zip-relationship-to-nothing", related("<Relationships/>"), Error(&["_rels/.rels", "no 3D model"])),
        of(
            "zip-relationship-to-itself",
            related(&RELATIONSHIPS.replace("/3D/a.model", "/_rels/.rels")),
            Error(&["<Relationships>", "expected <model>"]),
        ),
    ]
}

fn model() -> Vec<Case> {
    let of = |name, text: &str, wanted: Wanted| case(name, "a.3mf", of_model(text.as_bytes()), wanted);
    let with = |name, from: &str, to: &str, wanted: Wanted| {
        assert!(GOOD.contains(from), "{from}");
        of(name, &GOOD.replacen(from, to, 1), wanted)
    };
    let entities: String = (1..60).map(|i| format!("<!ENTITY a{i} \"&a{};&a{};\">", i - 1, i - 1)).collect();
    let doubled = |id: usize| {
        format!(
            "<object id=\"{id}\"><components>{}</components></object>",
            format!("<component objectid=\"{}\"/>", id - 1).repeat(2)
        )
    };
    let doubling: String = (3..40).map(doubled).collect();
    let chain: String = (3..3000)
        .map(|id| format!("<object id=\"{id}\"><components><component objectid=\"{}\"/></components></object>", id - 1))
        .collect();
    let last = |id: usize| format!("<item objectid=\"{id}\"/>");
    let built = |name, resources: &str, item: usize, wanted| {
        of(
            name,
            &GOOD
                .replace("</resources>", &(resources.to_owned() + "</resources>"))
                .replace("<item objectid=\"2\"/>", &last(item)),
            wanted,
        )
    };
    vec![
        of("xml-empty", "", Error(&["no <model>"])),
        of("xml-text", "Dear Sir or Madam", Error(&["no <model>"])),
        of("xml-cut-short", &GOOD[..500], Error(&["3d/a.model, byte"])),
        case("xml-utf16", "a.3mf", of_model(&utf16(GOOD)), Error(&["3d/a.model"])),
        of(
            "xml-entities",
            &GOOD.replace("?>\n", &format!("?>\n<!DOCTYPE model [<!ENTITY a0 \"1\">{entities}]>")).replacen(
                "x=\"1\"",
                "x=\"&a59;\"",
                1,
            ),
            Error(&["document type"]),
        ),
        with("xml-entity-unknown", "x=\"1\"", "x=\"&one;\"", Error(&["<vertex>", "attribute 'x'"])),
        with("xml-deep", "<mesh>", &"<a>".repeat(200_000), Error(&["3d/a.model, byte"])),
        with(
            "xml-many-attributes",
            "<vertex x=\"0\"",
            &format!("<vertex {} x=\"0\"", (0..100_000).map(|i| format!("a{i}=\"\" ")).collect::<String>()),
            Picture(&[]),
        ),
        with(
            "xml-many-namespaces",
            "<model",
            &format!("<model {}", (0..50_000).map(|i| format!("xmlns:a{i}=\"b{i}\" ")).collect::<String>()),
            Picture(&[]),
        ),
        with(
            "xml-of-spaces",
            "<build>",
            &(" ".repeat(100 << 20) + "<build>"),
            Error(&["inflated", "Limits::inflated"]),
        ),
        with("3mf-other-element", "<model", "<html", Error(&["<html>", "expected <model>"])),
        with(
            "3mf-required",
            "<model",
            "<model requiredextensions=\"b\" xmlns:b=\"http://example.org/b\"",
            Error(&["requires the extension http://example.org/b"]),
        ),
        with("3mf-number", "x=\"1\"", "x=\"1,5\"", Error(&["<vertex>", "x is '1,5'"])),
        with("3mf-nan", "x=\"1\"", "x=\"nan\"", Error(&["nothing to draw", "2 triangles dropped"])),
        with(
            "3mf-infinite",
            "<vertex x=\"1\" y=\"1\"",
            "<vertex x=\"1e999\" y=\"1\"",
            Picture(&["1 triangle dropped"]),
        ),
        with("3mf-vertex-missing", "v3=\"2\"", "v3=\"4\"", Error(&["object 1, triangle 0", "vertex 4", "4 vertices"])),
        with("3mf-vertex-overflows", "v3=\"2\"", "v3=\"99999999999\"", Error(&["<triangle>", "v3 is '99999999999'"])),
        with("3mf-object-missing", "objectid=\"2\"", "objectid=\"9\"", Error(&["object 9", "does not exist"])),
        with(
            "3mf-cycle",
            "objectid=\"1\" transform",
            "objectid=\"2\" transform",
            Error(&["object 2", "a component of itself"]),
        ),
        with("3mf-transform-short", "1 0 0 0 1 0 0 0 1 0 0 0", "1 0 0", Error(&["<component>", "twelve numbers"])),
        with("3mf-transform-zero", "1 0 0 0 1 0 0 0 1 0 0 0", "0 0 0 0 0 0 0 0 0 0 0 0", Blank(&[])),
        with("3mf-transform-nan", "1 0 0 0 1 0 0 0 1 0 0 0", "nan 0 0 0 1 0 0 0 1 0 0 0", Error(&["nothing to draw"])),
        with(
            "3mf-path-outside",
            "objectid=\"1\" transform",
            "path=\"/../../a.model\" objectid=\"1\" transform",
            Error(&["no such part"]),
        ),
        with("3mf-colour", "#ff0000", "red", Error(&["<base>", "displaycolor is 'red'", "#RRGGBB"])),
        with("3mf-colour-missing", "p1=\"0\"", "p1=\"7\"", Picture(&["1 triangle drawn white"])),
        with("3mf-build-empty", "<item objectid=\"2\"/>", "", Error(&["nothing to draw"])),
        built("3mf-doubling", &doubling, 39, Error(&["objects", "Limits::objects"])),
        built("3mf-deep", &chain, 2999, Error(&["Limits::nesting"])),
        of(
            "3mf-many-items",
            &GOOD.replace("<item objectid=\"2\"/>", &last(1).repeat(600_000)),
            Error(&["objects", "Limits::objects"]),
        ),
    ]
}
