//! From objects to a scene: what is to be built is put into place, components and all.
//!
//! In 3MF z is up, so y of a scene is the file's z, and z its -y.

use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

use super::package::{Package, name_of};
use super::part::{Instance, Object, Painted, Part};
use crate::gltf::Affine;
use crate::limits::Budget;
use crate::note::counted;
use crate::vector::widen;
use crate::{AlphaMode, Error, Loaded, Material, Scene, Vertex};

/// Everything that the start part's build names.
pub(super) fn build(package: Package<'_>, start: &str, budget: &mut Budget) -> Result<Loaded, Error> {
    let mut builder =
        Builder { package, parts: HashMap::new(), objects: Vec::new(), unpainted: 0, skipped: BTreeSet::new() };
    let start = name_of(start);
    let items = builder.part(&start)?;
    // The objects that the one at hand is a component of, from the item on.
    let mut path: Vec<(String, u32)> = Vec::new();
    let mut stack = Vec::new();
    push(&mut stack, &items.items, &start, &Affine::IDENTITY, 0);
    while let Some(Step { part: name, object: number, place, depth }) = stack.pop() {
        let part = builder.part(&name)?;
        let wrong = |message: &str| Error::threemf(format!("object {number} of {name}"), message);
        let Some(object) = part.objects.get(&number) else {
            return Err(wrong("an item or component names it, but it does not exist"));
        };
        path.truncate(depth);
        path.push((name.clone(), number));
        if path[..depth].contains(&path[depth]) {
            return Err(wrong("it is a component of itself"));
        }
        if depth as u64 > budget.nesting() {
            let what = "objects that an object is part of";
            return Err(Error::Limit { what, count: depth as u64, limit: budget.nesting(), field: "Limits::nesting" });
        }
        // Also those that have components alone: their number can double with each that has them.
        budget.objects(1)?;
        if !object.triangles.is_empty() {
            builder.mesh(object, &part, &place, budget)?;
        }
        push(&mut stack, &object.components, &name, &place, depth + 1);
    }
    Ok(builder.finish())
}

/// An object that is to be put into place.
struct Step {
    part: String,
    object: u32,
    place: Affine,
    /// How many objects it is part of.
    depth: usize,
}

/// Backwards, so that the first comes off first.
fn push(stack: &mut Vec<Step>, instances: &[Instance], part: &str, place: &Affine, depth: usize) {
    stack.extend(instances.iter().rev().map(|instance| Step {
        part: instance.part.as_deref().map_or_else(|| part.to_owned(), name_of),
        object: instance.object,
        place: place.after(&instance.place),
        depth,
    }));
}

struct Builder<'a> {
    package: Package<'a>,
    /// Those that have been read, by name.
    parts: HashMap<String, Rc<Part>>,
    objects: Vec<crate::Object>,
    /// Triangles whose colour is of a kind that is not read, or is not there.
    unpainted: usize,
    skipped: BTreeSet<String>,
}

impl Builder<'_> {
    fn part(&mut self, name: &str) -> Result<Rc<Part>, Error> {
        if let Some(part) = self.parts.get(name) {
            return Ok(Rc::clone(part));
        }
        let part = Rc::new(Part::read(self.package.part(name)?)?);
        self.skipped.extend(part.skipped.iter().cloned());
        self.parts.insert(name.to_owned(), Rc::clone(&part));
        Ok(part)
    }

    /// Adds an object's own mesh.
    fn mesh(&mut self, object: &Object, part: &Part, place: &Affine, budget: &mut Budget) -> Result<(), Error> {
        budget.triangles(object.triangles.len() as u64)?;
        budget.vertices(object.positions.len() as u64)?;
        let at = |&position: &[f32; 3]| {
            let [x, y, z] = place.point(widen(position));
            [x as f32, z as f32, -y as f32]
        };
        let (whole_in, whole) = object.color;
        let whole = whole_in.map(|group| color(part, group, whole));
        let vertices = object
            .positions
            .iter()
            .map(|position| Vertex { color: whole.flatten().unwrap_or(Vertex::WHITE), ..Vertex::at(at(position)) });
        let mut vertices: Vec<Vertex> = vertices.collect();
        let mut triangles = object.triangles.clone();
        if whole == Some(None) {
            self.unpainted += triangles.len() - object.painted.len();
        }
        let mut copies = HashMap::new();
        for Painted { triangle, colors, corners } in &object.painted {
            let colors = corners.map(|number| color(part, (*colors).or(whole_in)?, number));
            self.unpainted += usize::from(colors.contains(&None));
            for (vertex, color) in triangles[*triangle as usize].iter_mut().zip(colors) {
                let color = color.unwrap_or(Vertex::WHITE);
                if vertices[*vertex as usize].color != color {
                    *vertex = match copies.entry((*vertex, color.map(f32::to_bits))) {
                        Entry::Occupied(copy) => *copy.get(),
                        Entry::Vacant(copy) => {
                            budget.vertices(1)?;
                            vertices.push(Vertex { color, ..vertices[*vertex as usize] });
                            *copy.insert(vertices.len() as u32 - 1)
                        }
                    };
                }
            }
        }
        // The swap of axes is a rotation; the place may be none.
        if place.is_mirrored() {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let is_glass = triangles.as_flattened().iter().any(|&v| vertices[v as usize].color[3] < 1.0);
        let name = object.name.as_str().into();
        let material = usize::from(is_glass);
        self.objects.push(crate::Object { name, vertices, triangles, material, ..crate::Object::default() });
        Ok(())
    }

    fn finish(self) -> Loaded {
        let mut materials = vec![Material::default()];
        if self.objects.iter().any(|object| object.material == 1) {
            materials.push(Material { alpha_mode: AlphaMode::Blend, ..Material::default() });
        }
        let mut notes = Vec::new();
        if self.unpainted > 0 {
            let triangles = counted(self.unpainted, "triangle", "triangles");
            notes.push(format!("{triangles} drawn white: only base materials and groups of colours are read"));
        }
        if !self.skipped.is_empty() {
            let names: Vec<String> = self.skipped.into_iter().collect();
            notes.push(format!("passed over: {}", names.join(", ")));
        }
        Loaded { scene: Scene { objects: self.objects, materials, ..Scene::default() }, notes }
    }
}

/// A colour of a group; `None` if there is none.
fn color(part: &Part, group: u32, number: u32) -> Option<[f32; 4]> {
    part.colors.get(&group)?.get(number as usize).copied()
}
