//! From an OBJ file's statements to objects: polygons cut into triangles, triples of indices turned into vertices.

use std::collections::HashMap;

use super::maps::Maps;
use super::mtl::Library;
use super::parse::{Corner, File, Group};
use crate::color::{float_scale, srgb_to_linear};
use crate::limits::Budget;
use crate::vector::{area_vector_x2, unit_or_zero, widen};
use crate::{Error, Format, Loaded, Material, Normals, Object, Resolver, Scene, Vertex, note, polygon};

pub(super) fn build(
    mut file: File,
    library: Library,
    mut notes: Vec<String>,
    files: &dyn Resolver,
    budget: &mut Budget,
) -> Result<Loaded, Error> {
    let default_material = file.materials.len();
    let groups = std::mem::take(&mut file.groups);
    let mut scene = Scene::default();
    materials(&file, &groups, library, &mut scene, &mut notes, files, budget);
    let skipped = file.skipped;
    let mut sources = Sources::new(file);
    let (mut too_small, mut gave_up) = (0, 0);
    scene.objects.reserve(groups.len());
    for group in groups {
        sources.check(&group)?;
        too_small += group.faces.too_small;
        let position = |corner: Corner| sources.positions[corner.position as usize];
        let (triangles, fans) = group.faces.triangulate(position, budget)?;
        gave_up += fans;
        let Group { name, material, faces, lines, points, .. } = group;
        drop(faces);
        let mut object = sources.assemble(&triangles, &lines, &points, budget)?;
        object.name = name.as_str().into();
        object.material = material.unwrap_or(default_material);
        scene.objects.push(object);
    }
    polygon::notes(too_small, gave_up, &mut notes);
    if sources.missing_uvs > 0 {
        let vertices = note::counted(sources.missing_uvs, "vertex names", "vertices name");
        notes.push(format!("{vertices} texture coordinates that the file does not have"));
    }
    if skipped > 0 {
        let skipped = note::counted(skipped, "free-form curve or surface", "free-form curves and surfaces");
        notes.push(format!("{skipped} skipped"));
    }
    Ok(Loaded { scene, notes })
}

/// The file's materials in its order, with their textures, and, where something has none, a default one behind them.
fn materials(
    file: &File,
    groups: &[Group],
    library: Library,
    scene: &mut Scene,
    notes: &mut Vec<String>,
    files: &dyn Resolver,
    budget: &mut Budget,
) {
    let mut missing = Vec::new();
    let mut is_drawn = vec![false; file.materials.len()];
    groups.iter().filter_map(|group| group.material).for_each(|material| is_drawn[material] = true);
    let drawn = file.materials.iter().zip(&is_drawn).filter(|&(_, &is_drawn)| is_drawn);
    let mut maps = Maps::new(drawn.filter_map(|(name, _)| library.get(name)), files, budget);
    for (name, is_drawn) in file.materials.iter().zip(is_drawn) {
        let material = match library.get(name) {
            Some(entry) if is_drawn => maps.dress(entry),
            Some(entry) => entry.material.clone(),
            None => {
                missing.push(format!("'{name}'"));
                Material { name: name.as_str().into(), ..Material::default() }
            }
        };
        scene.materials.push(material);
    }
    if groups.iter().any(|group| group.material.is_none()) {
        scene.materials.push(Material::default());
    }
    notes.extend(library.notes);
    // If the library itself is missing, that has been said.
    if !missing.is_empty() && notes.is_empty() {
        notes.push(format!(
            "materials that no library defines drawn white: {}",
            crate::text::shown(missing.join(", ").as_bytes())
        ));
    }
    maps.finish(scene, notes);
}

/// What corners point into.
struct Sources {
    positions: Vec<[f32; 3]>,
    /// Linear; parallel to `positions` or empty.
    colors: Vec<[f32; 4]>,
    /// Unit length, or zero.
    normals: Vec<[f32; 3]>,
    /// v goes down.
    uvs: Vec<[f32; 2]>,
    /// Vertices with texture coordinates that the file does not have.
    missing_uvs: usize,
    /// For each position the corner and number of the vertex that was made of it first, in the object now built.
    first_use: Vec<(Corner, u32)>,
}

impl Sources {
    const UNUSED: u32 = u32::MAX;

    fn new(file: File) -> Self {
        let scale = float_scale(file.colors.iter().flatten().map(|&c| f64::from(c)));
        let linear = |[r, g, b, a]: [f32; 4]| {
            if [r, g, b, a].iter().any(|c| c.is_nan()) {
                return Vertex::WHITE;
            }
            let alpha = if a == 1.0 { 1.0 } else { (f64::from(a) / scale) as f32 };
            let [r, g, b] = [r, g, b].map(|c| srgb_to_linear(f64::from(c) / scale));
            [r, g, b, alpha]
        };
        Self {
            first_use: vec![
                (Corner { position: 0, normal: Corner::NONE, uv: Corner::NONE }, Self::UNUSED);
                file.positions.len()
            ],
            positions: file.positions,
            colors: file.colors.into_iter().map(linear).collect(),
            normals: file.normals.into_iter().map(|n| unit_or_zero(widen(n))).collect(),
            missing_uvs: 0,
            uvs: file.uvs.into_iter().map(|[u, v]| [u, 1.0 - v]).collect(),
        }
    }

    /// Every corner names what exists.
    fn check(&self, group: &Group) -> Result<(), Error> {
        let out_of_range = |corner: &Corner| {
            let Corner { position, normal, .. } = *corner;
            if position as usize >= self.positions.len() {
                Some(("vertex", position, self.positions.len()))
            } else if normal != Corner::NONE && normal as usize >= self.normals.len() {
                Some(("normal", normal, self.normals.len()))
            } else {
                None
            }
        };
        let of = if group.name.is_empty() { String::new() } else { format!(" of '{}'", group.name) };
        let wrong = |element: String, (what, index, count): (&str, u32, usize)| {
            let index = u64::from(index) + 1;
            let message =
                format!("{element}{of} (counted from here on) names {what} {index}, but the file has {count}");
            Err(Error::text(Format::Obj, group.line, message))
        };
        let find = |corners: &[Corner]| corners.iter().enumerate().find_map(|(i, c)| Some((i, out_of_range(c)?)));
        if let Some((at, problem)) = find(group.faces.corners()) {
            return wrong(format!("face {}", group.faces.polygon_of_corner(at) + 1), problem);
        }
        if let Some((at, problem)) = find(group.lines.as_flattened()) {
            return wrong(format!("line {}", at / 2 + 1), problem);
        }
        match find(&group.points) {
            Some((at, problem)) => wrong(format!("point {}", at + 1), problem),
            None => Ok(()),
        }
    }

    /// One object's vertices, and what is made of them.
    fn assemble(
        &mut self,
        corners: &[[Corner; 3]],
        lines: &[[Corner; 2]],
        points: &[Corner],
        budget: &mut Budget,
    ) -> Result<Object, Error> {
        let all = || corners.as_flattened().iter().chain(lines.as_flattened()).chain(points);
        let has_normals = corners.as_flattened().iter().any(|c| c.normal != Corner::NONE);
        let has_uvs = all().any(|c| c.uv != Corner::NONE);
        let normals = if has_normals { Normals::Given } else { Normals::Absent };
        let mut object = Object { normals, uvs: vec![Vec::new(); usize::from(has_uvs)], ..Object::default() };
        let mut welder = Welder { sources: self, has_normals, others: HashMap::new(), object: &mut object };
        let mut triangles = Vec::with_capacity(corners.len());
        for triangle in corners {
            let [a, b, c] = triangle;
            triangles.push([
                welder.vertex(a, Some(triangle), budget)?,
                welder.vertex(b, Some(triangle), budget)?,
                welder.vertex(c, Some(triangle), budget)?,
            ]);
        }
        let mut ends = Vec::with_capacity(lines.len());
        for [a, b] in lines {
            ends.push([welder.vertex(a, None, budget)?, welder.vertex(b, None, budget)?]);
        }
        let mut dots = Vec::with_capacity(points.len());
        for point in points {
            dots.push(welder.vertex(point, None, budget)?);
        }
        (object.triangles, object.lines, object.points) = (triangles, ends, dots);
        for corner in all() {
            self.first_use[corner.position as usize].1 = Self::UNUSED;
        }
        Ok(object)
    }

    /// `face`: the triangle to take the normal from, for a corner without one among corners with.
    fn make(&self, corner: Corner, face: Option<&[Corner; 3]>) -> Vertex {
        let position = |c: Corner| self.positions[c.position as usize];
        let normal = match face {
            Some(face) => {
                let [a, b, c] = face.map(|c| widen(position(c)));
                unit_or_zero(area_vector_x2(a, b, c))
            }
            None if corner.normal == Corner::NONE => [0.0; 3],
            None => self.normals[corner.normal as usize],
        };
        let color = self.colors.get(corner.position as usize).copied().unwrap_or(Vertex::WHITE);
        Vertex { position: position(corner), normal, color }
    }
}

/// Makes one vertex of equal corners.
struct Welder<'a> {
    sources: &'a mut Sources,
    has_normals: bool,
    /// Corners beyond the first of each position.
    others: HashMap<[u32; 3], u32>,
    object: &'a mut Object,
}

impl Welder<'_> {
    /// The number of a corner's vertex; `face` is the triangle that it is a corner of.
    fn vertex(&mut self, corner: &Corner, face: Option<&[Corner; 3]>, budget: &mut Budget) -> Result<u32, Error> {
        let next = self.object.vertices.len() as u32;
        let first = &mut self.sources.first_use[corner.position as usize];
        // A corner without a normal among corners with has its face's own.
        let own_normal = face.filter(|_| self.has_normals && corner.normal == Corner::NONE);
        let index = if own_normal.is_some() {
            next
        } else if first.1 == Sources::UNUSED {
            *first = (*corner, next);
            next
        } else if first.0 == *corner {
            first.1
        } else {
            *self.others.entry([corner.position, corner.normal, corner.uv]).or_insert(next)
        };
        if index == next {
            budget.vertices(1)?;
            self.object.vertices.push(self.sources.make(*corner, own_normal));
            if let Some(uvs) = self.object.uvs.first_mut() {
                let uv = self.sources.uvs.get(corner.uv as usize);
                self.sources.missing_uvs += usize::from(uv.is_none() && corner.uv != Corner::NONE);
                uvs.push(uv.copied().unwrap_or([0.0; 2]));
            }
        }
        Ok(index)
    }
}
