use std::io;

use pineda_scene::{AlphaMode, Error, Format, Limits, Loaded, Normals, Texels, TextureRef, Wrap, load_bytes};
use png::{BitDepth, ColorType};

use crate::images::png;
use crate::{corners, only, positions};

fn read(obj: &str) -> Loaded {
    crate::read(Format::Obj, obj).unwrap()
}

fn with_files(obj: &str, files: &'static [(&'static str, &'static str)]) -> Loaded {
    let resolver = move |path: &str, _max: u64| -> io::Result<Vec<u8>> {
        let found = files.iter().find(|(name, _)| *name == path);
        found.map(|(_, text)| text.as_bytes().to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into())
    };
    load_bytes(obj.as_bytes(), Format::Obj, &resolver, &Limits::default()).unwrap()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn obj_triangle_is_flat_white_and_double_sided() {
    let loaded = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let object = only(&loaded);
    assert_eq!(positions(object), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(object.triangles, [[0, 1, 2]]);
    assert_eq!(object.normals, Normals::Absent);
    assert!(object.vertices.iter().all(|v| v.color == [1.0; 4] && v.normal == [0.0; 3]));
    let material = &loaded.scene.materials[object.material];
    assert!(
        material.double_sided && material.base_color_factor == [1.0; 4] && material.alpha_mode == AlphaMode::Opaque
    );
    assert!(loaded.notes.is_empty());
}

#[test]
fn obj_corners_of_all_four_kinds_and_negative_indices() {
    let normal = "vn 0 0 2\nvt 0 0\nvt 1 1\n";
    for (face, normals) in [
        ("f 1 2 3 4", Normals::Absent),
        ("f 1/1 2/2 3/1 4/2", Normals::Absent),
        ("f 1//1 2//1 3//1 4//1", Normals::Given),
        ("f 1/2/1 2/1/1 3/2/1 4/1/1", Normals::Given),
        ("f -4 -3 -2 -1", Normals::Absent),
        ("f -4//-1 -3//-1 -2//-1 -1//-1", Normals::Given),
        ("f 1/ 2/ 3/ 4/", Normals::Absent),
        // Texture coordinates are not looked at, so they need not exist.
        ("f 1/99 2/99 3/99 4/99", Normals::Absent),
    ] {
        let loaded = read(&format!("{SQUARE}{normal}{face}\n"));
        let object = only(&loaded);
        assert_eq!(object.triangles, [[0, 1, 2], [0, 2, 3]], "{face}");
        assert_eq!(object.normals, normals, "{face}");
        if normals == Normals::Given {
            assert!(object.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]), "normals have length 1");
        }
    }
}

#[test]
fn obj_vertices_are_split_by_normal_and_shared_otherwise() {
    let loaded = read(&format!("{SQUARE}vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//1 3//2 4//2\nf 1//1 3//2 4//2\n"));
    let object = only(&loaded);
    assert_eq!(object.vertices.len(), 5);
    assert_eq!(object.triangles, [[0, 1, 2], [0, 3, 4], [0, 3, 4]]);
    assert_eq!(object.vertices[3].normal, [1.0, 0.0, 0.0]);
}

#[test]
fn obj_faces_without_normals_among_faces_with_are_flat() {
    let loaded = read(&format!("{SQUARE}vn 0 1 0\nf 1//1 2//1 3//1\nf 1 3 4\n"));
    let object = only(&loaded);
    assert_eq!(object.normals, Normals::Given);
    assert_eq!(object.vertices.len(), 6);
    let normal = |v: u32| object.vertices[v as usize].normal;
    assert_eq!(object.triangles[0].map(normal), [[0.0, 1.0, 0.0]; 3]);
    assert_eq!(object.triangles[1].map(normal), [[0.0, 0.0, 1.0]; 3]);
}

#[test]
fn obj_line_ends_continuations_comments_and_spaces() {
    let plain = read(&format!("{SQUARE}f 1 2 3 4\n"));
    for text in [
        "# c\r\nv 0 0 0\r\nv 1 0 0 # one\r\nv\t1  1\t0\r\n  v 0 1 0\r\nf 1 2 \\\r\n 3 4\r\n".to_owned(),
        "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4".to_owned(),
        "v 0 0 0\nv 1 0 \\\n0\nv 1.0 1e0 +0\nv 0 1. -0.0e5\nf \\\n1 2 3 \\\n\\\n4 # f 1 2".to_owned(),
        format!("\u{feff}{SQUARE}\n\nf 1 2 3 4 \x0b\x0c"),
    ] {
        let loaded = read(&text);
        assert_eq!(only(&loaded).triangles, only(&plain).triangles, "{text:?}");
        assert_eq!(positions(only(&loaded)), positions(only(&plain)), "{text:?}");
    }
}

#[test]
fn obj_colours_are_srgb_in_either_range() {
    let loaded = read("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 0 1 1 0.25\nf 1 2 3\n");
    let colors: Vec<_> = only(&loaded).vertices.iter().map(|v| v.color).collect();
    assert_eq!(colors, [[1.0, 0.214_041_14, 0.0, 1.0], [1.0; 4], [0.0, 1.0, 1.0, 0.25]]);
    // The same in 0..=255.
    let loaded = read("v 0 0 0 255 127.5 0\nv 1 0 0\nv 0 1 0 0 255 255\nf 1 2 3\n");
    let colors: Vec<_> = only(&loaded).vertices.iter().map(|v| v.color).collect();
    assert_eq!(colors, [[1.0, 0.214_041_14, 0.0, 1.0], [1.0; 4], [0.0, 1.0, 1.0, 1.0]]);
    // A weight is not a colour.
    let loaded = read("v 0 0 0 0.5\nv 1 0 0 0.5\nv 0 1 0 0.5\nf 1 2 3\n");
    assert!(only(&loaded).vertices.iter().all(|v| v.color == [1.0; 4]));
}

#[test]
fn obj_concave_polygons_are_not_fanned() {
    // An arrowhead: corners 1 and 3 (from 0) do not see each other.
    let loaded = read("v 0 0 0\nv 8 0 0\nv 2 2 0\nv 0 8 0\nf 2 3 4 1\n");
    for triangle in corners(only(&loaded)) {
        assert!(triangle.contains(&[0.0, 0.0, 0.0]) && triangle.contains(&[2.0, 2.0, 0.0]));
    }
}

#[test]
fn obj_groups_objects_and_materials_become_objects() {
    let text = format!(
        "{SQUARE}o box\nusemtl a\nf 1 2 3\ng lid\nusemtl b\nf 1 3 4\nusemtl a\nf 1 2 4\nf 2 3 4\no ball\nf 1 2 3\nusemtl b\ng\n"
    );
    let loaded = read(&text);
    let objects: Vec<_> = loaded.scene.objects.iter().map(|o| (&*o.name, o.material, o.triangles.len())).collect();
    assert_eq!(objects, [("box", 0, 1), ("box lid", 1, 1), ("box lid", 0, 2), ("ball", 0, 1)]);
    let materials: Vec<_> = loaded.scene.materials.iter().map(|m| &*m.name).collect();
    assert_eq!(materials, ["a", "b"]);
    assert_eq!(loaded.notes, ["materials that no library defines drawn white: 'a', 'b'"]);
}

#[test]
fn obj_vertices_may_come_behind_faces() {
    let loaded = read("f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n");
    assert_eq!(only(&loaded).triangles, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn obj_material_library() {
    let obj = format!("mtllib my colours.mtl\n{SQUARE}usemtl light red\nf 1 2 3\nusemtl glass\nf 1 3 4\n");
    let mtl = "newmtl light red\nKd 1 0 0\nmap_Kd a.png\nnewmtl glass\nKd 0 1 0\nd 0.5\n";
    let loaded = with_files(&obj, Box::leak(Box::new([("my colours.mtl", mtl)])));
    let factors: Vec<_> = loaded.scene.materials.iter().map(|m| (m.base_color_factor, m.alpha_mode)).collect();
    assert_eq!(factors, [([1.0, 0.0, 0.0, 1.0], AlphaMode::Opaque), ([0.0, 1.0, 0.0, 0.5], AlphaMode::Blend)]);
    assert_eq!(loaded.notes, ["image 'a.png' not found"]);
    assert_eq!(loaded.scene.materials[0].base_color_texture, None);
}

/// A library in a folder of its own, with images of one pixel in it.
fn textured(mtl: &str, images: &[(&str, [u8; 4])]) -> Loaded {
    let images: Vec<(String, Vec<u8>)> = images
        .iter()
        .map(|(name, color)| (format!("lib/{name}"), png(ColorType::Rgba, BitDepth::Eight, 1, 1, color)))
        .collect();
    let mtl = format!("newmtl m\n{mtl}");
    let files = move |path: &str, _max: u64| match path {
        "lib/a.mtl" => Ok(mtl.clone().into_bytes()),
        path => images.iter().find(|i| i.0 == path).map(|i| i.1.clone()).ok_or(std::io::ErrorKind::NotFound.into()),
    };
    let obj = format!("mtllib lib/a.mtl\n{SQUARE}vt 0 0\nvt 1 0.25\nusemtl m\nf 1/1 2/2 3/-1\nf 1/1 3/1 4\n");
    load_bytes(obj.as_bytes(), Format::Obj, &files, &Limits::default()).unwrap()
}

fn pixels(loaded: &Loaded, reference: Option<TextureRef>) -> [u8; 4] {
    let image = loaded.scene.textures[reference.expect("a texture").texture].image;
    let Texels::Rgba8(texels) = &loaded.scene.images[image].texels else { panic!("8 bits") };
    texels[0]
}

#[test]
fn obj_texture_coordinates() {
    let loaded = textured("", &[]);
    let object = only(&loaded);
    // v goes down; corners with other coordinates are other vertices; none at all is the corner of the image.
    assert_eq!(object.uvs, [[[0.0, 1.0], [1.0, 0.75], [1.0, 0.75], [0.0, 1.0], [0.0, 0.0]]]);
    assert_eq!(object.triangles, [[0, 1, 2], [0, 3, 4]]);
    let loaded = read(&format!("{SQUARE}vt 0.5\nf 1/1 2/1 3/1\n"));
    assert_eq!(only(&loaded).uvs, [[[0.5, 1.0]; 3]]);
    assert!(only(&read(&format!("{SQUARE}vt 1 1\nf 1 2 3\n"))).uvs.is_empty());
    // Those that are not there cost the texture only.
    let loaded = read(&format!("{SQUARE}vt 0 0\nf 1/1 2/-2 3/9 4/0\n"));
    assert_eq!(only(&loaded).uvs, [[[0.0, 1.0], [0.0; 2], [0.0; 2], [0.0; 2]]]);
    assert_eq!(loaded.notes, ["3 vertices name texture coordinates that the file does not have"]);
    crate::fails(Format::Obj, format!("{SQUARE}f 1/x 2 3"), &["line 5", "'1/x'", "whole numbers"]);
}

#[test]
fn obj_images_become_textures() {
    let images: &[(&str, [u8; 4])] =
        &[("c.png", [1, 2, 3, 255]), ("e.png", [4, 5, 6, 255]), ("n.png", [128, 127, 255, 255])];
    let loaded = textured(
        "Kd 1 1 1\nmap_Kd -clamp on -s 2 3 -o 0.25 0.5 c.png\nmap_Ke C:\\somewhere\\else\\e.png\nmap_Bump -bm 0.5 n.png",
        images,
    );
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    let material = &loaded.scene.materials[0];
    assert_eq!(pixels(&loaded, material.base_color_texture), [1, 2, 3, 255]);
    assert_eq!(pixels(&loaded, material.emissive_texture), [4, 5, 6, 255]);
    assert_eq!((pixels(&loaded, material.normal_texture), material.normal_scale), ([128, 127, 255, 255], 0.5));
    assert_eq!(material.emissive_factor, [1.0; 3]);
    let base = material.base_color_texture.unwrap();
    // 1 - ((1 - v) * 3 + 0.5), with v going down.
    assert_eq!(base.transform, [[2.0, 0.0, 0.25], [0.0, 3.0, -2.5]]);
    let wrap = |reference: Option<TextureRef>| loaded.scene.textures[reference.unwrap().texture].sampler.wrap_s;
    assert_eq!(wrap(material.base_color_texture), Wrap::ClampToEdge);
    assert_eq!(wrap(material.emissive_texture), Wrap::Repeat);
}

#[test]
fn obj_images_of_one_channel_are_put_together() {
    let images: &[(&str, [u8; 4])] = &[
        ("c.png", [1, 2, 3, 255]),
        ("d.png", [77, 77, 77, 255]),
        ("both.png", [1, 2, 3, 99]),
        ("r.png", [10, 10, 10, 255]),
        ("m.png", [20, 20, 20, 255]),
    ];
    let of = |mtl: &str| {
        let loaded = textured(mtl, images);
        assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
        loaded
    };
    let alpha = |mtl: &str| {
        let loaded = of(mtl);
        assert_eq!(loaded.scene.materials[0].alpha_mode, AlphaMode::Blend);
        pixels(&loaded, loaded.scene.materials[0].base_color_texture)
    };
    assert_eq!(alpha("map_Kd c.png\nmap_d d.png"), [1, 2, 3, 77]);
    assert_eq!(alpha("map_Kd both.png\nmap_d both.png"), [1, 2, 3, 99]);
    assert_eq!(alpha("map_Kd c.png\nmap_d both.png"), [1, 2, 3, 99]);
    assert_eq!(alpha("map_d d.png"), [255, 255, 255, 77]);
    let rough = |mtl: &str| {
        let loaded = of(mtl);
        let material = &loaded.scene.materials[0];
        let [_, green, blue, _] = pixels(&loaded, material.metallic_roughness_texture);
        (green, blue, material.roughness_factor, material.metallic_factor)
    };
    assert_eq!(rough("map_Pr r.png\nmap_Pm m.png"), (10, 20, 1.0, 1.0));
    assert_eq!(rough("Pm 0.5\nmap_Pr r.png"), (10, 255, 1.0, 0.5));
    assert_eq!(rough("Pr 0.5\nmap_Pm m.png"), (255, 20, 0.5, 1.0));
    // Heights are not normals.
    let loaded = textured("bump d.png", images);
    assert_eq!(loaded.notes, ["image 'd.png' has heights, not normals: left out"]);
    assert_eq!(loaded.scene.materials[0].normal_texture, None);
}

#[test]
fn obj_images_that_cannot_be_had() {
    let note = |mtl: &str| {
        let loaded = textured(mtl, &[("a.png", [1; 4])]);
        assert!(loaded.scene.textures.is_empty());
        loaded.notes.join("; ")
    };
    assert_eq!(note("map_Kd b.png\nmap_Ke b.png"), "image 'b.png' not found");
    assert_eq!(note("map_Kd ../../b.png"), "image '../../b.png' not found");
    assert!(note("map_Kd ..").contains("outside the model's folder"));
}

#[test]
fn obj_several_material_libraries_on_a_line() {
    let files: &[_] = &[("a.mtl", "newmtl a\nKd 1 0 0"), ("sub/b.mtl", "newmtl b\nKd 0 1 0")];
    let loaded = with_files(&format!("mtllib a.mtl ./sub\\b.mtl\n{SQUARE}usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4"), files);
    assert_eq!(loaded.scene.materials[0].base_color_factor, [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(loaded.scene.materials[1].base_color_factor, [0.0, 1.0, 0.0, 1.0]);
    assert!(loaded.notes.is_empty());
}

#[test]
fn obj_missing_library_costs_the_colours_only() {
    let obj = format!("mtllib plane.mtl\n{SQUARE}usemtl a\nf 1 2 3\nf 1 3 4\n");
    let loaded = with_files(&obj, &[]);
    assert_eq!(loaded.notes, ["material library 'plane.mtl' not found"]);
    assert_eq!(&*loaded.scene.materials[0].name, "a");
    for outside in ["../a.mtl", "/a.mtl", "C:\\a.mtl"] {
        let loaded = with_files(&obj.replace("plane.mtl", outside), &[]);
        assert_eq!(
            loaded.notes,
            [format!("material library '{outside}' is outside the model's folder, so it is not read")]
        );
    }
}

#[test]
fn obj_notes_what_is_skipped() {
    let loaded = read(&format!("{SQUARE}f 1 2 3\nf 1 2\nf\ncurv 0 1 1 2\nnonsense 1\ns off\n"));
    assert_eq!(
        loaded.notes,
        ["2 faces with fewer than three corners skipped", "1 free-form curve or surface skipped",]
    );
}

#[test]
fn obj_lines_and_points() {
    let loaded = read(&format!("{SQUARE}l 1 2 3\nl -1 1\np 2 4\ng faces\nf 1 2 3\np 1\n"));
    let [strokes, faces] = &loaded.scene.objects[..] else { panic!("two groups") };
    assert_eq!((&strokes.lines[..], &strokes.points[..]), (&[[0, 1], [1, 2], [3, 0]][..], &[1, 3][..]));
    assert!(strokes.triangles.is_empty() && strokes.vertices.len() == 4);
    assert_eq!((&faces.triangles[..], &faces.points[..]), (&[[0, 1, 2]][..], &[0][..]));
    assert!(loaded.notes.is_empty());
    crate::fails(Format::Obj, format!("{SQUARE}l 1 2\nl 1 9"), &["line 5", "line 2", "vertex 9", "has 4"]);
    crate::fails(Format::Obj, format!("{SQUARE}p 1 2 9"), &["point 3", "vertex 9"]);
    let loaded = read("v 0 0 0\nv 1 0 0\nv nan 0 0\nl 1 2 3\np 3 1\n");
    assert_eq!((only(&loaded).lines.len(), only(&loaded).points.len()), (1, 1));
    assert_eq!(loaded.notes, ["2 lines and points dropped: infinite or not a number"]);
}

#[test]
fn obj_points_that_are_not_finite_drop_their_triangles() {
    let loaded =
        read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv nan 1 0\nv 1e39 0 0\nv 0 inf 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 6 2 1");
    assert_eq!(only(&loaded).triangles.len(), 1);
    assert_eq!(loaded.notes, ["3 triangles dropped: a corner is infinite or not a number"]);
}

#[test]
fn obj_normals_without_a_direction_become_the_faces() {
    let loaded = read(&format!("{SQUARE}vn 0 0 0\nvn nan 0 0\nf 1//1 2//1 3//2 4//2\n"));
    assert!(only(&loaded).vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]));
    assert_eq!(loaded.notes, ["4 normals without a direction replaced by the faces'"]);
}

#[test]
fn obj_errors_name_the_line() {
    let fails = |text: &str, says: &[&str]| crate::fails(Format::Obj, format!("{SQUARE}{text}"), says);
    fails("f 1 2 0", &["OBJ, line 5", "'0'", "from 1"]);
    fails("f 1 2 -5", &["line 5", "'-5'", "only 4 vertices"]);
    fails("f 1 2 x", &["line 5", "'x'", "whole numbers"]);
    fails("f 1 2 3//-1", &["line 5", "only 0 normals"]);
    fails("f 1 2 99999999999", &["line 5", "too large"]);
    fails("g lid\nf 1 2 3\nf 1 2 9", &["line 6", "face 2 of 'lid'", "vertex 9", "has 4"]);
    fails("f 1//1 2//1 3//1", &["line 5", "normal 1", "has 0"]);
    fails("v 1 2", &["line 5", "three numbers"]);
    fails("v 1 2 three", &["line 5", "'three'", "not a number"]);
    fails("v 1,5 2 3", &["line 5", "'1,5'"]);
    fails("vn 1", &["line 5", "vn"]);
    fails("v 0 0 \\\n\\\n x", &["line 7"]);
}

#[test]
fn obj_without_triangles_says_what_there_is() {
    crate::fails(Format::Obj, "", &["nothing to draw"]);
    crate::fails(Format::Obj, "v 0 0 0\nv 1 1 nan\nf 1 2 2", &["nothing to draw", "not a number"]);
}

#[test]
fn obj_limits() {
    let text = format!("{SQUARE}g a\nf 1 2 3 4\ng b\nf 1 2 3\n");
    let field = |limits: Limits| match load_bytes(text.as_bytes(), Format::Obj, &pineda_scene::NoFiles, &limits) {
        Err(Error::Limit { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    assert_eq!(field(Limits { vertices: 6, ..Limits::default() }), "Limits::vertices");
    assert_eq!(field(Limits { triangles: 2, ..Limits::default() }), "Limits::triangles");
    assert_eq!(field(Limits { objects: 1, ..Limits::default() }), "Limits::objects");
    assert_eq!(field(Limits { file_bytes: 10, ..Limits::default() }), "Limits::file_bytes");
}

/// A bug once: a library that is named a thousand times was read and parsed a thousand times.
#[test]
fn obj_libraries_are_read_once() {
    let reads = std::cell::Cell::new(0);
    let files = |path: &str, _: u64| {
        reads.set(reads.get() + 1);
        if path == "a.mtl" { Ok(b"newmtl a\nKd 1 0 0\n".to_vec()) } else { Err(std::io::ErrorKind::NotFound.into()) }
    };
    let names = "mtllib a.mtl\nmtllib ./a.mtl\nmtllib ./a.mtl a.mtl\n".repeat(1000);
    let obj = format!("{names}v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    let loaded = load_bytes(obj.as_bytes(), Format::Obj, &files, &Limits::default()).unwrap();
    assert_eq!(loaded.scene.materials[0].base_color_factor, [1.0, 0.0, 0.0, 1.0]);
    // The name with a space in it is looked for each time, but is not there.
    assert_eq!(reads.get(), 1 + 1000);
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
}

/// A bug once: of opacity in an image of its own each material made an image, however large, that nobody counted.
#[test]
fn obj_images_put_together_are_made_once_and_counted() {
    let image = |gray: u8| png(ColorType::Grayscale, BitDepth::Eight, 64, 64, &[gray; 64 * 64]);
    let files = |path: &str, _: u64| match path {
        "a.mtl" => {
            let material =
                |i: usize| format!("newmtl m{i}\nmap_Kd a.png\nmap_d {}.png\n", if i < 100 { "b" } else { "c" });
            Ok((0..200).map(material).collect::<String>().into_bytes())
        }
        "a.png" => Ok(image(1)),
        "b.png" => Ok(image(2)),
        _ => Ok(image(3)),
    };
    let faces: String = (0..200).map(|i| format!("usemtl m{i}\nf 1 2 3\n")).collect();
    let obj = format!("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}");
    let load =
        |pixels| load_bytes(obj.as_bytes(), Format::Obj, &files, &Limits { pixels, ..Limits::default() }).unwrap();
    assert_eq!(load(5 * 64 * 64).scene.images.len(), 2);
    let loaded = load(4 * 64 * 64);
    assert_eq!((loaded.scene.images.len(), loaded.notes.len()), (1, 1));
    assert!(loaded.notes[0].contains("Limits::pixels"), "{:?}", loaded.notes);
}

/// A bug once: a line for each of any number of things that are wrong.
#[test]
fn obj_notes_are_no_more_than_anybody_reads() {
    let names: String = (0..1000).map(|i| format!("mtllib {i}.mtl\n")).collect();
    let loaded = read(&format!("{names}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    assert_eq!((loaded.notes.len(), loaded.notes[32].as_str()), (33, "and 968 more like these"));
}
