//! 3MF: files made here, part by part.

use std::io::{Cursor, Write};

use pineda_scene::{AlphaMode, Error, Format, Limits, Loaded, NoFiles, Normals, load_bytes};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use crate::{corners, only, positions};

pub(crate) const RELATIONSHIPS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/Metadata/thumbnail.png" Id="rel0" Type="http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail"/>
<Relationship Target="/3D/3dmodel.model" Id="rel1" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>"#;

/// A zip file, deflated.
pub(crate) fn zipped(parts: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in parts {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// A file with this model part.
pub(crate) fn file(model: &str) -> Vec<u8> {
    zipped(&[("_rels/.rels", RELATIONSHIPS.as_bytes()), ("3D/3dmodel.model", model.as_bytes())])
}

/// A model with these resources and this build; `attributes` are the root's.
pub(crate) fn model(attributes: &str, resources: &str, build: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" {attributes}>\n<metadata name=\"Title\">a &amp; b</metadata>\n<resources>{resources}</resources>\n<build>{build}</build>\n</model>"
    )
}

const VERTICES: &str = r#"<vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices>"#;

/// Object 1, of two triangles: with these attributes, and those of its triangles.
fn object(attributes: &str, [first, second]: [&str; 2]) -> String {
    format!(
        r#"<object id="1" type="model" {attributes}><mesh>{VERTICES}<triangles><triangle v1="0" v2="2" v3="1" {first}/><triangle v1="0" v2="1" v3="3" {second}/></triangles></mesh></object>"#
    )
}

fn plain() -> String {
    object(r#"name="part""#, ["", ""])
}

fn read(attributes: &str, resources: &str, build: &str) -> Loaded {
    crate::read(Format::ThreeMf, file(&model(attributes, resources, build))).unwrap()
}

#[track_caller]
fn fails(resources: &str, build: &str, says: &[&str]) {
    crate::fails(Format::ThreeMf, file(&model("", resources, build)), says);
}

const ITEM: &str = r#"<item objectid="1"/>"#;

#[test]
fn threemf_meshes_stand_upright() {
    let loaded = read("", &plain(), ITEM);
    let object = only(&loaded);
    // z becomes y.
    assert_eq!(positions(object), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]);
    assert_eq!(object.triangles, [[0, 2, 1], [0, 1, 3]]);
    assert_eq!((&*object.name, object.normals), ("part", Normals::Absent));
    assert!(loaded.scene.materials[0].double_sided && loaded.notes.is_empty());
}

#[test]
fn threemf_is_known_by_its_beginning() {
    let bytes = file(&model("", &plain(), ITEM));
    assert_eq!(Format::from_content(&bytes), Some(Format::ThreeMf));
}

#[test]
fn threemf_items_and_components_have_places() {
    let assembly = r#"<object id="2"><components><component objectid="1" transform="2 0 0 0 2 0 0 0 2 10 0 0"/><component objectid="1"/></components></object>"#;
    let build = r#"<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 0 0 5"/><item objectid="1"/>"#;
    let loaded = read("", &(plain() + assembly), build);
    let at = |object: usize| positions(&loaded.scene.objects[object]);
    // First twice as large and 10 to the right, then a quarter turn about z (x to y) and 5 up: in the file.
    assert_eq!(at(0)[..2], [[0.0, 5.0, -10.0], [0.0, 5.0, -12.0]]);
    assert_eq!(at(1)[..2], [[0.0, 5.0, 0.0], [0.0, 5.0, -1.0]]);
    assert_eq!(at(2)[..2], [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    assert_eq!(loaded.scene.objects.len(), 3);
}

/// A mirror keeps the outside out.
#[test]
fn threemf_mirrored_triangles_turn_around() {
    let loaded = read("", &plain(), r#"<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>"#);
    assert_eq!(only(&loaded).triangles, [[0, 1, 2], [0, 3, 1]]);
}

#[test]
fn threemf_colours() {
    let groups = r##"<basematerials id="5"><base name="red" displaycolor="#FF0000"/><base name="blue" displaycolor="#0000FF"/></basematerials><m:colorgroup id="6"><m:color color="#00FF00"/><m:color color="#FFFFFF"/><m:color color="#00000080"/></m:colorgroup>"##;
    let materials = r#"xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02" requiredextensions="m""#;
    let [white, red, blue, green] = [[1.0; 4], [1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0], [0.0, 1.0, 0.0, 1.0]];
    let colors = |attributes: &str, triangles: [&str; 2]| {
        let loaded = read(materials, &(groups.to_owned() + &object(attributes, triangles)), ITEM);
        let object = only(&loaded);
        let colors: Vec<_> = object.triangles.iter().map(|t| t.map(|v| object.vertices[v as usize].color)).collect();
        (colors, object.vertices.len(), loaded)
    };
    // Of the whole object, without a vertex more.
    assert_eq!((colors(r#"pid="5" pindex="1""#, ["", ""]).0, 4), (vec![[blue; 3]; 2], 4));
    // A triangle's own; what it does not say is its first corner's, or the object's.
    let (of, count, loaded) = colors(r#"pid="5" pindex="0""#, [r#"p1="1""#, ""]);
    assert_eq!((of, count), (vec![[blue; 3], [red; 3]], 7));
    assert!(loaded.notes.is_empty());
    let (of, count, _) = colors("", [r#"pid="6" p1="0" p2="1" p3="0""#, ""]);
    assert_eq!((of, count), (vec![[green, white, green], [white; 3]], 6));
    // Alpha blends.
    let loaded = colors("", ["", r#"pid="6" p1="2""#]).2;
    assert_eq!(loaded.scene.materials[only(&loaded).material].alpha_mode, AlphaMode::Blend);
    assert_eq!(loaded.scene.objects[0].vertices[4].color, [0.0, 0.0, 0.0, 128.0 / 255.0]);
    // What is not there, or of another kind, is white and said.
    for attributes in [r#"pid="7" p1="0""#, r#"pid="5" p1="9""#] {
        let (of, _, loaded) = colors("", [attributes, ""]);
        assert_eq!(of, [[white; 3]; 2]);
        assert!(loaded.notes[0].starts_with("1 triangle drawn white"), "{:?}", loaded.notes);
    }
}

/// The production extension, as slicers write it.
#[test]
fn threemf_objects_of_other_parts() {
    let production =
        r#"xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="p""#;
    let assembly = r#"<object id="1" p:UUID="x"><components><component p:path="/3D/Objects/a.model" objectid="1" transform="1 0 0 0 1 0 0 0 1 3 0 0"/></components></object>"#;
    let start = model(production, assembly, ITEM);
    let other = model("", &plain(), "");
    let parts = |other_name| {
        zipped(&[
            ("_rels/.rels", RELATIONSHIPS.as_bytes()),
            ("3D/3dmodel.model", start.as_bytes()),
            (other_name, other.as_bytes()),
        ])
    };
    // Names are equal whatever their case.
    let loaded = crate::read(Format::ThreeMf, parts("3d/objects/A.model")).unwrap();
    assert_eq!(corners(only(&loaded))[0], [[3.0, 0.0, 0.0], [3.0, 0.0, -1.0], [4.0, 0.0, 0.0]]);
    crate::fails(Format::ThreeMf, parts("3D/b.model"), &["3d/objects/a.model", "no such part"]);
}

#[test]
fn threemf_extensions() {
    let with = |attributes: &str| file(&model(attributes, &plain(), ITEM));
    let beams = r#"requiredextensions="b" xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02""#;
    crate::fails(
        Format::ThreeMf,
        with(beams),
        &["<model>", "requires the extension http://", "beamlattice", "without"],
    );
    crate::fails(Format::ThreeMf, with(r#"requiredextensions="x""#), &["requires the extension x"]);
    let lattice = plain().replace("</mesh>", "<b:beamlattice><b:beams/></b:beamlattice></mesh>");
    assert_eq!(read("", &lattice, ITEM).notes, ["passed over: b:beamlattice"]);
}

#[test]
fn threemf_packages_that_are_not_whole() {
    let good = file(&model("", &plain(), ITEM));
    let fails = |bytes: &[u8], says: &[&str]| crate::fails(Format::ThreeMf, bytes, says);
    let rels = |text: &str| zipped(&[("_rels/.rels", text.as_bytes()), ("3D/3dmodel.model", b"<model/>")]);
    fails(b"", &["3MF, zip file", "complete"]);
    fails(&good[..good.len() / 2], &["3MF, zip file"]);
    fails(&zipped(&[]), &["_rels/.rels", "no such part"]);
    fails(&rels("<Relationships/>"), &["_rels/.rels", "no 3D model"]);
    fails(&rels(&RELATIONSHIPS.replace("/3D/", "/2D/")), &["2d/3dmodel.model", "no such part"]);
    fails(&rels(&RELATIONSHIPS.replace("/3D/", "/../../etc/")), &["etc/3dmodel.model", "no such part"]);
    fails(&rels(RELATIONSHIPS), &["nothing to draw"]);
    // Bytes in the middle of what is deflated.
    let mut damaged = good.clone();
    let at = good.windows(16).position(|w| w == b"3D/3dmodel.model").unwrap() + 40;
    damaged[at..at + 8].fill(0x55);
    fails(&damaged, &["3MF, 3d/3dmodel.model, byte"]);
}

#[test]
fn threemf_xml_that_is_wrong() {
    let fails = |text: &str, says: &[&str]| crate::fails(Format::ThreeMf, file(text), says);
    let good = model("", &plain(), ITEM);
    fails("", &["3d/3dmodel.model", "no <model>"]);
    fails("Dear Sir or Madam", &["no <model>"]);
    fails("<html></html>", &["<html>", "expected <model>"]);
    fails(&good[..good.len() / 2], &["3d/3dmodel.model, byte"]);
    fails(&good.replace("</mesh>", "</mash>"), &["byte", "mash"]);
    fails(&good.replace("x=\"1\"", "x=\"one\""), &["<vertex>", "x is 'one': expected a number"]);
    fails(&good.replace("x=\"1\"", ""), &["<vertex>", "it has no x"]);
    fails(&good.replace("v1=\"0\"", "v1=\"-1\""), &["<triangle>", "v1 is '-1': expected a whole number"]);
    fails(&good.replace("v2=\"2\"", "v2=\"4\""), &["object 1, triangle 0", "vertex 4", "4 vertices"]);
    fails(&good.replace("id=\"1\" type", "type"), &["<object>", "it has no id"]);
    fails(&good.replace("x=\"1\"", "x=\"&a;\""), &["<vertex>", "the attribute 'x' cannot be read"]);
    // Entities that would double with each line.
    let bomb = good.replace("?>\n", "?>\n<!DOCTYPE model [<!ENTITY a \"1\"><!ENTITY b \"&a;&a;\">]>\n");
    fails(&bomb, &["a document type, which 3MF does not allow"]);
    fails("\u{feff}\u{feff}<model", &["3d/3dmodel.model"]);
}

#[test]
fn threemf_builds_that_are_wrong() {
    fails(&plain(), "", &["nothing to draw"]);
    fails(&plain(), r#"<item objectid="2"/>"#, &["object 2 of 3d/3dmodel.model", "does not exist"]);
    fails(&plain(), r#"<item/>"#, &["<item>", "no objectid"]);
    fails(&plain(), r#"<item objectid="1" transform="1 2 3"/>"#, &["<item>", "expected twelve numbers"]);
    let cycle = r#"<object id="1"><components><component objectid="2"/></components></object><object id="2"><components><component objectid="1"/></components></object>"#;
    fails(cycle, ITEM, &["object 1 of", "a component of itself"]);
    let nan = plain().replace("x=\"1\"", "x=\"nan\"");
    fails(&nan, ITEM, &["nothing to draw", "2 triangles dropped"]);
}

/// Few bytes that ask for very much.
#[test]
fn threemf_bombs() {
    let field = |bytes: &[u8], limits: &Limits| match load_bytes(bytes, Format::ThreeMf, &NoFiles, limits) {
        Err(Error::Limit { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    // Each object is the one before twice.
    let component = |id: usize| format!(r#"<component objectid="{id}"/>"#).repeat(2);
    let doubled = |id: usize| format!("<object id=\"{id}\"><components>{}</components></object>", component(id - 1));
    let doubling: String = (2..40).map(doubled).collect();
    let file_of = |build: &str| file(&model("", &(plain() + &doubling), build));
    assert_eq!(field(&file_of(r#"<item objectid="39"/>"#), &Limits::default()), "Limits::objects");
    assert!(crate::read(Format::ThreeMf, file_of(r#"<item objectid="5"/>"#)).is_ok());
    let deep: String = (2..2000)
        .map(|id| format!("<object id=\"{id}\"><components><component objectid=\"{}\"/></components></object>", id - 1))
        .collect();
    let deep = file(&model("", &(plain() + &deep), r#"<item objectid="1999"/>"#));
    assert_eq!(field(&deep, &Limits::default()), "Limits::nesting");
    // What deflates a thousandfold.
    let spaces = model("", &plain(), ITEM) + &" ".repeat(1 << 20);
    let limits = Limits { inflated: 1 << 17, ..Limits::default() };
    assert_eq!(field(&file(&spaces), &limits), "Limits::inflated");
    assert!(load_bytes(&file(&spaces), Format::ThreeMf, &NoFiles, &Limits::default()).is_ok());
}
