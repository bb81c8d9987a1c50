//! From a mesh's primitive, as one node shows it, to an object.

use super::accessor::{Accessor, Accessors};
use super::buffers::Buffers;
use super::schema::{Node, Primitive, Root, Whole};
use super::transform::Affine;
use crate::limits::Budget;
use crate::text::shown;
use crate::vector::unit_or_zero;
use crate::{Error, Normals, Object, Vertex};

/// Reads primitives one after the other.
pub(super) struct PrimitiveReader<'a> {
    accessors: Accessors<'a>,
    default_material: usize,
    /// For each of an accessor's elements the vertex that was made of it; all unused between two primitives.
    vertex_of: Vec<u32>,
    pub(super) skipped: Skipped,
}

/// What was not drawn, or not as the file means it.
#[derive(Default)]
pub(super) struct Skipped {
    pub(super) points: usize,
    pub(super) lines: usize,
    pub(super) without_positions: usize,
    pub(super) morphed: usize,
}

const UNUSED: u32 = u32::MAX;

impl<'a> PrimitiveReader<'a> {
    pub(super) fn new(root: &'a Root, buffers: &'a Buffers, default_material: usize) -> Self {
        Self {
            accessors: Accessors::new(root, buffers),
            default_material,
            vertex_of: Vec::new(),
            skipped: Skipped::default(),
        }
    }

    /// The object that primitive `number` of `mesh` is at `node`; `None` if it has no triangles.
    pub(super) fn read(
        &mut self,
        node: &Node,
        mesh: usize,
        number: usize,
        world: &Affine,
        budget: &mut Budget,
    ) -> Result<Option<Object>, Error> {
        let place = format!("mesh {mesh}, primitive {number}");
        let wrong = |message: String| Err(Error::gltf(place.as_str(), message));
        let root = self.accessors.root;
        let primitive = &root.meshes[mesh].primitives[number];
        let mode = match primitive.mode.unwrap_or(Whole(4)).0 {
            0 => {
                self.skipped.points += 1;
                return Ok(None);
            }
            1..=3 => {
                self.skipped.lines += 1;
                return Ok(None);
            }
            4 => Mode::Triangles,
            5 => Mode::Strip,
            6 => Mode::Fan,
            mode => return wrong(format!("mode {mode} does not exist: expected 0 to 6")),
        };
        let Some(position) = primitive.attributes.position else {
            self.skipped.without_positions += 1;
            return Ok(None);
        };
        if primitive.extensions.draco.is_some() && !self.accessors.has_data(position) {
            return Err(Error::ExtensionRequired { names: vec!["KHR_draco_mesh_compression".to_owned()] });
        }
        let material = match primitive.material {
            None => self.default_material,
            Some(material) if material.index() < root.materials.len() => material.index(),
            Some(material) => return wrong(format!("its material {material} does not exist")),
        };
        let attributes = self.attributes(primitive, position, &place, budget)?;
        let mut triangles = self.triangles(primitive, mode, attributes.position.count, &place, budget)?;
        if triangles.is_empty() {
            return Ok(None);
        }
        let weights = node.weights.as_deref().or(root.meshes[mesh].weights.as_deref()).unwrap_or_default();
        self.skipped.morphed += usize::from(!primitive.targets.is_empty() && weights.iter().any(|&w| w != 0.0));

        let vertices = self.vertices(&attributes, &mut triangles, world, budget)?;
        if world.is_mirrored() {
            // What was counter-clockwise now turns the other way; the first corner stays first.
            for triangle in &mut triangles {
                triangle.swap(1, 2);
            }
        }
        let name = root.meshes[mesh].name.as_deref().or(node.name()).unwrap_or_default();
        let normals = if attributes.normal.is_some() { Normals::Given } else { Normals::Absent };
        let name = shown(name.as_bytes()).into();
        Ok(Some(Object { name, vertices, triangles, material, normals, ..Object::default() }))
    }

    fn attributes(
        &self,
        primitive: &Primitive,
        position: Whole,
        place: &str,
        budget: &mut Budget,
    ) -> Result<Attributes<'a>, Error> {
        let mut get = |name: &str, number: Option<Whole>, channels: std::ops::RangeInclusive<usize>| {
            let Some(number) = number else { return Ok(None) };
            let accessor = self.accessors.get(number, &format!("{place}, {name}"), budget)?;
            if channels.contains(&accessor.channels) {
                return Ok(Some(accessor));
            }
            let message = format!("{name} with {} numbers each: expected {}", accessor.channels, channels.start());
            Err(Error::gltf(format!("{place}, accessor {number}"), message))
        };
        let position = get("POSITION", Some(position), 3..=3)?.expect("asked for one that is there");
        let normal = get("NORMAL", primitive.attributes.normal, 3..=3)?;
        let color = get("COLOR_0", primitive.attributes.color, 3..=4)?.map(Accessor::normalized);
        for (name, other) in [("NORMAL", &normal), ("COLOR_0", &color)] {
            if let Some(other) = other
                && other.count != position.count
            {
                let message = format!("{} elements in {name}, but {} in POSITION", other.count, position.count);
                return Err(Error::gltf(place, message));
            }
        }
        Ok(Attributes { position, normal, color })
    }

    /// The triangles, with indices into the attributes that are in range.
    fn triangles(
        &self,
        primitive: &Primitive,
        mode: Mode,
        count: usize,
        place: &str,
        budget: &mut Budget,
    ) -> Result<Vec<[u32; 3]>, Error> {
        let Some(number) = primitive.indices else {
            budget.triangles(mode.triangle_count(count) as u64)?;
            // At most u32::MAX triangles are in any budget, but there may be no triangle and any count of vertices.
            return Ok(mode.triangles(count, |i| i as u32));
        };
        let indices = self.accessors.get(number, &format!("{place}, indices"), budget)?;
        let wrong = |message: String| Err(Error::gltf(format!("{place}, accessor {number}"), message));
        if !indices.is_index_list() {
            return wrong("indices must be single numbers of component type 5121, 5123 or 5125".to_owned());
        }
        budget.triangles(mode.triangle_count(indices.count) as u64)?;
        let triangles = mode.triangles(indices.count, |i| indices.index(i));
        match triangles.iter().flatten().find(|&&index| index as usize >= count) {
            Some(index) => wrong(format!("index {index}, but there are only {count} vertices")),
            None => Ok(triangles),
        }
    }

    /// Those vertices that triangles name, in world space; the triangles are numbered anew where that is not all.
    fn vertices(
        &mut self,
        attributes: &Attributes<'_>,
        triangles: &mut [[u32; 3]],
        world: &Affine,
        budget: &mut Budget,
    ) -> Result<Vec<Vertex>, Error> {
        let count = attributes.position.count;
        let normal_map = world.normal_map();
        let vertex = |i: usize| Vertex {
            position: world.point(attributes.position.element(i, 0.0)).map(|c| c as f32),
            normal: attributes.normal.as_ref().map_or([0.0; 3], |n| unit_or_zero(normal_map.apply(n.element(i, 0.0)))),
            color: attributes.color.as_ref().map_or(Vertex::WHITE, |c| c.element(i, 1.0).map(|c: f64| c as f32)),
        };
        if 3 * triangles.len() >= count {
            budget.vertices(count as u64)?;
            return Ok((0..count).map(vertex).collect());
        }
        // Exporters let many small primitives point into one large list of vertices.
        let largest = triangles.iter().flatten().copied().max().unwrap_or(0) as usize;
        if self.vertex_of.len() <= largest {
            self.vertex_of.resize(largest + 1, UNUSED);
        }
        let mut used = Vec::new();
        for index in triangles.iter_mut().flatten() {
            let vertex_of = &mut self.vertex_of[*index as usize];
            if *vertex_of == UNUSED {
                *vertex_of = used.len() as u32;
                used.push(*index);
            }
            *index = *vertex_of;
        }
        for &index in &used {
            self.vertex_of[index as usize] = UNUSED;
        }
        budget.vertices(used.len() as u64)?;
        Ok(used.into_iter().map(|i| vertex(i as usize)).collect())
    }
}

/// Equally many elements each.
struct Attributes<'a> {
    position: Accessor<'a>,
    normal: Option<Accessor<'a>>,
    color: Option<Accessor<'a>>,
}

#[derive(Clone, Copy)]
enum Mode {
    Triangles,
    Strip,
    Fan,
}

impl Mode {
    fn triangle_count(self, corners: usize) -> usize {
        match self {
            Self::Triangles => corners / 3,
            Self::Strip | Self::Fan => corners.saturating_sub(2),
        }
    }

    /// The triangles of a row of corners, in the order of the specification (3.7.2.1). Incomplete ones are left out.
    fn triangles(self, corners: usize, index: impl Fn(usize) -> u32) -> Vec<[u32; 3]> {
        let corners_of = |i: usize| match self {
            Self::Triangles => [3 * i, 3 * i + 1, 3 * i + 2],
            Self::Strip => [i, i + 1 + i % 2, i + 2 - i % 2],
            Self::Fan => [i + 1, i + 2, 0],
        };
        (0..self.triangle_count(corners)).map(|i| corners_of(i).map(&index)).collect()
    }
}
