//! From an OBJ file's statements to objects: polygons cut into triangles, pairs of indices turned into vertices.

use std::collections::HashMap;

use super::mtl::Library;
use super::parse::{Corner, File, Group, Skipped};
use crate::color::{float_scale, srgb_to_linear};
use crate::limits::Budget;
use crate::vector::{area_vector_x2, unit_or_zero, widen};
use crate::{AlphaMode, Error, Format, Loaded, Material, Normals, Object, Scene, Vertex, note, polygon};

pub(super) fn build(
    mut file: File,
    library: Library,
    mut notes: Vec<String>,
    budget: &mut Budget,
) -> Result<Loaded, Error> {
    let (materials, default_material) = materials(&file, library, &mut notes);
    let groups = std::mem::take(&mut file.groups);
    let mut sources = Sources::new(file);
    let (mut too_small, mut gave_up) = (0, 0);
    let mut objects = Vec::with_capacity(groups.len());
    for group in groups {
        sources.check(&group)?;
        too_small += group.faces.too_small;
        let position = |corner: Corner| sources.positions[corner.position as usize];
        let (triangles, fans) = group.faces.triangulate(position, budget)?;
        gave_up += fans;
        let material = group.material.unwrap_or(default_material);
        let name = group.name.as_str().into();
        drop(group);
        let (vertices, triangles, normals) = sources.assemble(&triangles, budget)?;
        objects.push(Object { name, vertices, triangles, material, normals, ..Object::default() });
    }
    polygon::notes(too_small, gave_up, &mut notes);
    notes.extend(
        sources.skipped.iter().map(|(what, count)| format!("{} skipped", note::counted(*count, what.one, what.many))),
    );
    Ok(Loaded { scene: Scene { objects, materials, ..Scene::default() }, notes })
}

/// The file's materials in its order and, where faces have none, a default one behind them; and the default's number.
fn materials(file: &File, library: Library, notes: &mut Vec<String>) -> (Vec<Material>, usize) {
    let (mut textures, mut blended) = (0, 0);
    let mut missing = Vec::new();
    let mut materials: Vec<Material> = file
        .materials
        .iter()
        .map(|name| match library.get(name) {
            Some(entry) => {
                textures += entry.textures;
                blended += usize::from(entry.material.alpha_mode == AlphaMode::Blend);
                entry.material.clone()
            }
            None => {
                missing.push(format!("'{name}'"));
                Material { name: name.as_str().into(), ..Material::default() }
            }
        })
        .collect();
    if file.groups.iter().any(|group| group.material.is_none()) {
        materials.push(Material::default());
    }
    notes.extend(library.notes);
    // If the library itself is missing, that has been said.
    if !missing.is_empty() && notes.is_empty() {
        notes.push(format!(
            "materials that no library defines drawn white: {}",
            crate::text::shown(missing.join(", ").as_bytes())
        ));
    }
    notes.extend(note::textures(textures));
    notes.extend(note::transparency(blended));
    (materials, file.materials.len())
}

/// What corners point into.
struct Sources {
    positions: Vec<[f32; 3]>,
    /// Linear; parallel to `positions` or empty.
    colors: Vec<[f32; 4]>,
    /// Unit length, or zero.
    normals: Vec<[f32; 3]>,
    skipped: Vec<(Skipped, usize)>,
    /// For each position the normal and number of the vertex that was made of it first, in the object now built.
    first_use: Vec<(u32, u32)>,
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
            first_use: vec![(0, Self::UNUSED); file.positions.len()],
            positions: file.positions,
            colors: file.colors.into_iter().map(linear).collect(),
            normals: file.normals.into_iter().map(|n| unit_or_zero(widen(n))).collect(),
            skipped: file.skipped,
        }
    }

    /// Every corner names what exists.
    fn check(&self, group: &Group) -> Result<(), Error> {
        let out_of_range = |corner: &Corner| {
            let Corner { position, normal } = *corner;
            if position as usize >= self.positions.len() {
                Some(("vertex", position, self.positions.len()))
            } else if normal != Corner::NO_NORMAL && normal as usize >= self.normals.len() {
                Some(("normal", normal, self.normals.len()))
            } else {
                None
            }
        };
        let corners = group.faces.corners();
        let Some((at, (what, index, count))) =
            corners.iter().enumerate().find_map(|(i, c)| Some((i, out_of_range(c)?)))
        else {
            return Ok(());
        };
        let face = group.faces.polygon_of_corner(at) + 1;
        let of = if group.name.is_empty() { String::new() } else { format!(" of '{}'", group.name) };
        let message = format!(
            "face {face}{of} (faces from here on) names {what} {}, but the file has {count}",
            u64::from(index) + 1
        );
        Err(Error::text(Format::Obj, group.line, message))
    }

    /// Vertices and triangles of one object, and whether the file gives normals for it.
    #[expect(clippy::type_complexity, reason = "the three fields of the object that is made of them")]
    fn assemble(
        &mut self,
        corners: &[[Corner; 3]],
        budget: &mut Budget,
    ) -> Result<(Vec<Vertex>, Vec<[u32; 3]>, Normals), Error> {
        let has_normals = corners.iter().flatten().any(|c| c.normal != Corner::NO_NORMAL);
        let mut vertices: Vec<Vertex> = Vec::new();
        let mut triangles = Vec::with_capacity(corners.len());
        // Pairs of position and normal beyond the first of each position.
        let mut others: HashMap<(u32, u32), u32> = HashMap::new();
        for triangle in corners {
            triangles.push([0; 3]);
            let indices = &mut triangles[..].last_mut().expect("just pushed")[..];
            for (index, corner) in indices.iter_mut().zip(triangle) {
                let next = vertices.len() as u32;
                let first = &mut self.first_use[corner.position as usize];
                let own_normal = has_normals && corner.normal == Corner::NO_NORMAL;
                *index = if own_normal {
                    next
                } else if first.1 == Self::UNUSED {
                    *first = (corner.normal, next);
                    next
                } else if first.0 == corner.normal {
                    first.1
                } else {
                    *others.entry((corner.position, corner.normal)).or_insert(next)
                };
                if *index == next {
                    budget.vertices(1)?;
                    vertices.push(self.vertex(*corner, if own_normal { Some(triangle) } else { None }));
                }
            }
        }
        for corner in corners.iter().flatten() {
            self.first_use[corner.position as usize].1 = Self::UNUSED;
        }
        Ok((vertices, triangles, if has_normals { Normals::Given } else { Normals::Absent }))
    }

    /// `face`: the triangle to take the normal from, for a corner without one among corners with.
    fn vertex(&self, corner: Corner, face: Option<&[Corner; 3]>) -> Vertex {
        let position = |c: Corner| self.positions[c.position as usize];
        let normal = match face {
            Some(face) => {
                let [a, b, c] = face.map(|c| widen(position(c)));
                unit_or_zero(area_vector_x2(a, b, c))
            }
            None if corner.normal == Corner::NO_NORMAL => [0.0; 3],
            None => self.normals[corner.normal as usize],
        };
        let color = self.colors.get(corner.position as usize).copied().unwrap_or(Vertex::WHITE);
        Vertex { position: position(corner), normal, color }
    }
}
