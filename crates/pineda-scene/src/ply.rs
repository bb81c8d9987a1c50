//! PLY 1.0 (Turk 1994), ASCII and binary of both byte orders.
//!
//! An own reader: `ply-rs` 0.1 is no longer kept, and its successor `ply-rs-bw` 4 makes a hash map of every vertex,
//! which takes 0.4 s for a file that is read here in a few hundredths.
//!
//! The header says which elements follow, and of which properties each consists; what is not needed is skipped.
//! Colours are read as sRGB.

mod header;
mod source;
mod vertices;

use std::collections::HashMap;

use crate::image::{Encoded, ImageStore, read_file};
use crate::limits::Budget;
use crate::polygon::{self, Polygons};
use crate::resolver::{SideFiles, path_inside};
use crate::{Error, Format, Loaded, Material, Normals, Object, Resolver, Sampler, Scene, Texture, TextureRef, Vertex};
use header::{Element, Encoding, Header};
use source::{Ascii, Binary, Source};
use vertices::Vertices;

/// Reads a PLY file, and the image that it names.
pub(crate) fn read(bytes: &[u8], files: &dyn Resolver, budget: &mut Budget) -> Result<Loaded, Error> {
    let header = header::parse(bytes)?;
    let body = match header.encoding {
        Encoding::Ascii => Body::read(&header, Ascii::new(bytes, &header), budget)?,
        Encoding::BinaryLittleEndian => Body::read(&header, Binary::<false>::new(bytes, &header), budget)?,
        Encoding::BinaryBigEndian => Body::read(&header, Binary::<true>::new(bytes, &header), budget)?,
    };
    body.build(header, files, budget)
}

/// What the file's elements hold.
#[derive(Default)]
struct Body {
    vertices: Vertices,
    faces: Polygons<u32>,
    /// For each of the faces' corners its texture coordinates, as MeshLab writes them; or empty. v goes down.
    wedges: Vec<[f32; 2]>,
}

impl Body {
    fn read<S: Source>(header: &Header, mut source: S, budget: &mut Budget) -> Result<Self, Error> {
        let mut body = Self::default();
        for element in &header.elements {
            source.check_count(element)?;
            match element.name.as_str() {
                "vertex" if body.vertices.vertices.is_empty() => {
                    body.vertices = vertices::read(element, &mut source, budget)?;
                }
                "face" => body.read_faces(element, &["vertex_indices", "vertex_index"], &mut source)?,
                "tristrips" => body.read_faces(element, &["vertex_indices"], &mut source)?,
                _ => skip(element, &mut source)?,
            }
        }
        Ok(body)
    }

    /// Faces, or strips of triangles, with -1 between two strips.
    fn read_faces<S: Source>(&mut self, element: &Element, names: &[&str], source: &mut S) -> Result<(), Error> {
        let is_strips = element.name == "tristrips";
        let indices = element.properties.iter().position(|p| names.contains(&p.name.as_str()) && p.count.is_some());
        if element.count > 0 && indices.is_none() {
            let message = format!("the element '{}' has no list '{}'", element.name, names.join("' or '"));
            return Err(Error::text(Format::Ply, element.line, message));
        }
        if !is_strips {
            // At least one byte each is there, as has been checked.
            self.faces.reserve(element.count as usize);
        }
        let wedges = element.properties.iter().position(|p| p.name == "texcoord" && p.count.is_some() && !is_strips);
        let mut list: Vec<i64> = Vec::new();
        let mut uvs: Vec<f32> = Vec::new();
        for row in 0..element.count {
            for (number, property) in element.properties.iter().enumerate() {
                let count = source.list_count(property)?;
                if Some(number) == indices {
                    list.clear();
                    for _ in 0..count {
                        list.push(source.integer(property.kind)?);
                    }
                } else if Some(number) == wedges {
                    uvs.clear();
                    for _ in 0..count {
                        uvs.push(source.number(property.kind)? as f32);
                    }
                } else {
                    source.skip(property.kind, count)?;
                }
            }
            if wedges.is_some() && list.len() >= 3 {
                let pairs = uvs.as_chunks().0.iter().map(|&[u, v]| [u, 1.0 - v]);
                self.wedges.extend(pairs.chain(std::iter::repeat([0.0; 2])).take(list.len()));
            }
            if is_strips {
                list.split(|&i| i == -1).try_for_each(|strip| self.push_strip(strip))
            } else {
                self.push_face(&list)
            }
            .map_err(|index| {
                source.error(format!("{} {row} names vertex {index}: indices count from 0", element.name))
            })?;
        }
        Ok(())
    }

    /// The index that cannot be one is the error.
    fn push_face(&mut self, corners: &[i64]) -> Result<(), i64> {
        if let Some(&bad) = corners.iter().find(|&&i| u32::try_from(i).is_err()) {
            return Err(bad);
        }
        self.faces.push(corners.iter().map(|&i| i as u32));
        Ok(())
    }

    /// Every second triangle of a strip turns the other way.
    fn push_strip(&mut self, strip: &[i64]) -> Result<(), i64> {
        for (i, window) in strip.windows(3).enumerate() {
            let [a, b, c] = [window[0], window[1], window[2]];
            self.push_face(&if i % 2 == 0 { [a, b, c] } else { [b, a, c] })?;
        }
        Ok(())
    }

    fn build(self, header: Header, files: &dyn Resolver, budget: &mut Budget) -> Result<Loaded, Error> {
        let Self { vertices: Vertices { mut vertices, has_normals, mut uvs }, mut faces, wedges } = self;
        let mut notes = Vec::new();
        if let Some(at) = faces.corners().iter().position(|&i| i as usize >= vertices.len()) {
            let (face, index, count) = (faces.polygon_of_corner(at), faces.corners()[at], vertices.len());
            let message = format!("face {face} (from 0) names vertex {index}, but the file has {count} vertices");
            return Err(Error::text(Format::Ply, header.line_of("face"), message));
        }
        if uvs.is_empty() && !wedges.is_empty() && wedges.len() == faces.corners().len() {
            (vertices, uvs) = split(&vertices, faces.corners_mut(), &wedges, budget)?;
        }
        let (triangles, gave_up) = faces.triangulate(|i| vertices[i as usize].position, budget)?;
        polygon::notes(faces.too_small, gave_up, &mut notes);
        // A scan without faces is a cloud of points.
        let is_cloud = triangles.is_empty() && faces.too_small == 0;
        let points = if is_cloud { (0..vertices.len() as u32).collect() } else { Vec::new() };
        budget.triangles(points.len() as u64)?;
        if header.faces_have("red") {
            notes.push("colours of faces ignored: only vertices' are drawn".to_owned());
        }
        let mut scene = Scene { materials: vec![Material::default()], ..Scene::default() };
        if let Some(name) = header.textures.first().filter(|_| !uvs.is_empty()) {
            texture(name, &mut scene, files, budget).unwrap_or_else(|line| notes.push(line));
        }
        let uvs = if uvs.is_empty() { Vec::new() } else { vec![uvs] };
        let normals = if has_normals { Normals::Given } else { Normals::Absent };
        budget.objects(1)?;
        scene.objects.push(Object { vertices, uvs, triangles, points, normals, ..Object::default() });
        Ok(Loaded { scene, notes })
    }
}

/// Makes a vertex of each pair of vertex and texture coordinates that a corner has, in the order of the corners.
fn split(
    vertices: &[Vertex],
    corners: &mut [u32],
    wedges: &[[f32; 2]],
    budget: &mut Budget,
) -> Result<(Vec<Vertex>, Vec<[f32; 2]>), Error> {
    let mut numbers = HashMap::new();
    let (mut split, mut uvs) = (Vec::with_capacity(vertices.len()), Vec::with_capacity(vertices.len()));
    for (corner, &uv) in corners.iter_mut().zip(wedges) {
        let next = split.len() as u32;
        let number = *numbers.entry((*corner, uv.map(f32::to_bits))).or_insert(next);
        if number == next {
            budget.vertices(1)?;
            split.push(vertices[*corner as usize]);
            uvs.push(uv);
        }
        *corner = number;
    }
    Ok((split, uvs))
}

/// Gives the only material an image; the error is a line.
fn texture(name: &str, scene: &mut Scene, files: &dyn Resolver, budget: &mut Budget) -> Result<(), String> {
    let encoded = match path_inside(name) {
        Some(path) => {
            read_file(&path, &mut SideFiles::new(files), budget).map_or_else(Encoded::Missing, Encoded::Bytes)
        }
        None => Encoded::Missing("is outside the model's folder, so it is not read".to_owned()),
    };
    let store = ImageStore::new(vec![(name.into(), encoded)], budget);
    for image in store.get(&[0], |_| Err(String::new())) {
        scene.images.push(image?);
        scene.textures.push(Texture { name: "".into(), image: 0, sampler: Sampler::default() });
        scene.materials[0].base_color_texture = Some(TextureRef::new(0));
    }
    Ok(())
}

fn skip<S: Source>(element: &Element, source: &mut S) -> Result<(), Error> {
    if element.properties.is_empty() {
        // Nothing is stored, however many there are said to be.
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            let count = source.list_count(property)?;
            source.skip(property.kind, count)?;
        }
    }
    Ok(())
}
