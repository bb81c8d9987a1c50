//! From a mesh's primitive, as one node shows it, to an object.

use super::accessor::Accessors;
use super::attributes::{Attributes, Wanted};
use super::buffers::again;
use super::draco::DracoMeshes;
use super::mode::{Elements, Mode};
use super::schema::{Primitive, Root, Semantic};
use super::skin::Skinning;
use super::transform::Affine;
use crate::limits::Budget;
use crate::text::shown;
use crate::vector::{each, unit_or_zero};
use crate::{Error, Normals, Object, Vertex};

/// Reads primitives one after the other.
pub(super) struct PrimitiveReader<'a> {
    pub(super) accessors: Accessors<'a>,
    draco: &'a DracoMeshes,
    /// Index into the materials of what has none.
    default_material: usize,
    variant: Option<usize>,
    /// For each material how many sets of texture coordinates its textures name.
    uv_sets: Vec<u8>,
    /// For each of an accessor's elements the vertex that was made of it; all unused between two primitives.
    vertex_of: Vec<u32>,
    /// Primitives without positions.
    pub(super) skipped: usize,
}

/// A mesh as a node shows it.
pub(super) struct Shown<'a> {
    /// The number of the mesh.
    pub(super) mesh: usize,
    /// For a mesh without a name.
    pub(super) node_name: &'a str,
    pub(super) world: Affine,
    /// Morph targets' weights.
    pub(super) weights: &'a [f64],
    /// The joints' matrices, if there is a skin: then `world` does not count.
    pub(super) skin: Option<&'a [Affine]>,
}

const UNUSED: u32 = u32::MAX;

/// Sets of texture coordinates that are read at most.
const UV_SETS: u64 = 8;

impl<'a> PrimitiveReader<'a> {
    pub(super) fn new(
        root: &'a Root,
        accessors: Accessors<'a>,
        draco: &'a DracoMeshes,
        variant: Option<usize>,
    ) -> Self {
        let uv_sets = |material: &super::schema::Material| {
            let sets = material.textures().map(|info| info.uv_set().0.saturating_add(1).min(UV_SETS) as u8);
            sets.max().unwrap_or(0)
        };
        Self {
            accessors,
            draco,
            default_material: root.materials.len(),
            variant,
            uv_sets: root.materials.iter().map(uv_sets).collect(),
            vertex_of: Vec::new(),
            skipped: 0,
        }
    }

    /// The object that primitive `number` of a mesh is; `None` if it is empty.
    pub(super) fn read(
        &mut self,
        shown_mesh: &Shown<'_>,
        number: usize,
        budget: &mut Budget,
    ) -> Result<Option<Object>, Error> {
        let place = format!("mesh {}, primitive {number}", shown_mesh.mesh);
        let wrong = |message: String| Err(Error::gltf(place.as_str(), message));
        let mesh = &self.accessors.root.meshes[shown_mesh.mesh];
        let primitive = &mesh.primitives[number];
        let Some(mode) = Mode::of(primitive.mode) else {
            return wrong(format!("mode {} does not exist: expected 0 to 6", primitive.mode.unwrap_or_default()));
        };
        let Some(position) = primitive.attributes.get(Semantic::Position) else {
            self.skipped += 1;
            return Ok(None);
        };
        let draco = match self.draco.get(shown_mesh.mesh, number) {
            Some(draco) => Some(draco.as_ref().map_err(again)?),
            None => None,
        };
        let material = self.material(primitive, &place)?;
        let wanted = Wanted {
            weights: shown_mesh.weights,
            // The first set also for those who show coordinates themselves.
            uv_sets: self.uv_sets.get(material).map_or(1, |&sets| sets.max(1)),
            is_skinned: shown_mesh.skin.is_some(),
            draco,
        };
        let attributes = Attributes::new(&self.accessors, primitive, position, &wanted, &place, budget)?;
        let mut elements = match draco {
            Some(draco) => {
                budget.triangles(draco.triangles.len() as u64)?;
                Elements::Triangles(draco.triangles.clone())
            }
            None => self.elements(primitive, mode, attributes.count, &place, budget)?,
        };
        if elements.indices().is_empty() {
            return Ok(None);
        }
        let used = self.used(&mut elements, attributes.count, budget)?;
        let skinning = shown_mesh.skin.filter(|_| !attributes.influences.is_empty());
        let skinning = skinning.map(|matrices| Skinning { matrices, influences: &attributes.influences });
        let builder = Builder { attributes: &attributes, skinning, world: &shown_mesh.world, place: &place };
        let mut object = builder.object(&used, budget)?;
        match elements {
            Elements::Triangles(triangles) => object.triangles = triangles,
            Elements::Lines(lines) => object.lines = lines,
            Elements::Points(points) => object.points = points,
        }
        builder.turn(&used, &mut object);
        object.name = shown(mesh.name.as_deref().unwrap_or(shown_mesh.node_name).as_bytes()).into();
        object.material = material;
        Ok(Some(object))
    }

    /// The variant's material, or else the primitive's own.
    fn material(&self, primitive: &Primitive, place: &str) -> Result<usize, Error> {
        let mappings = primitive.extensions.variants.iter().flat_map(|variants| variants.mappings.iter());
        let of_variant = self.variant.and_then(|variant| {
            let mut mappings = mappings;
            mappings.find(|mapping| mapping.variants.iter().any(|v| v.index() == variant)).map(|m| m.material)
        });
        match of_variant.or(primitive.material) {
            None => Ok(self.default_material),
            Some(material) if material.index() < self.default_material => Ok(material.index()),
            Some(material) => Err(Error::gltf(place, format!("its material {material} does not exist"))),
        }
    }

    /// Triangles, lines or points, with indices into the attributes that are in range.
    fn elements(
        &self,
        primitive: &Primitive,
        mode: Mode,
        count: usize,
        place: &str,
        budget: &mut Budget,
    ) -> Result<Elements, Error> {
        let Some(number) = primitive.indices else {
            budget.triangles(mode.count(count) as u64)?;
            // At most u32::MAX elements are in any budget, but there may be none and any count of vertices.
            return Ok(mode.elements(count, |i| i as u32));
        };
        let indices = self.accessors.get(number, &format!("{place}, indices"), budget)?;
        let wrong = |message: String| Err(Error::gltf(format!("{place}, accessor {number}"), message));
        if !indices.is_index_list() {
            return wrong("indices must be single numbers of component type 5121, 5123 or 5125".to_owned());
        }
        budget.triangles(mode.count(indices.count) as u64)?;
        let elements = mode.elements(indices.count, |i| indices.index(i));
        match elements.indices().iter().find(|&&index| index as usize >= count) {
            Some(index) => wrong(format!("index {index}, but there are only {count} vertices")),
            None => Ok(elements),
        }
    }

    /// The attributes' elements that become vertices: all, or only those that are named; then the elements are numbered
    /// anew.
    fn used(&mut self, elements: &mut Elements, count: usize, budget: &mut Budget) -> Result<Used, Error> {
        if elements.indices().len() >= count {
            budget.vertices(count as u64)?;
            return Ok(Used::All(count));
        }
        // Exporters let many small primitives point into one large list of vertices.
        let largest = elements.indices().iter().copied().max().unwrap_or(0) as usize;
        if self.vertex_of.len() <= largest {
            self.vertex_of.resize(largest + 1, UNUSED);
        }
        let mut used = Vec::new();
        for index in elements.indices_mut() {
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
        Ok(Used::These(used))
    }
}

/// Which of an accessor's elements become vertices.
enum Used {
    All(usize),
    These(Vec<u32>),
}

impl Used {
    fn len(&self) -> usize {
        match self {
            Self::All(count) => *count,
            Self::These(used) => used.len(),
        }
    }

    /// The element that became vertex number `vertex`.
    fn element(&self, vertex: usize) -> usize {
        match self {
            Self::All(_) => vertex,
            Self::These(used) => used[vertex] as usize,
        }
    }
}

/// Takes vertices to the world.
struct Builder<'b> {
    attributes: &'b Attributes<'b>,
    skinning: Option<Skinning<'b>>,
    world: &'b Affine,
    place: &'b str,
}

impl Builder<'_> {
    /// An object with its vertices.
    fn object(&self, used: &Used, budget: &mut Budget) -> Result<Object, Error> {
        let attributes = self.attributes;
        let count = used.len();
        let more = attributes.uvs.len() + 2 * usize::from(attributes.tangent.is_some());
        budget.attributes((more * count) as u64)?;
        let mut object = Object {
            vertices: Vec::with_capacity(count),
            tangents: Vec::with_capacity(if attributes.tangent.is_some() { count } else { 0 }),
            normals: if attributes.normal.is_some() { Normals::Given } else { Normals::Absent },
            ..Object::default()
        };
        let rigid_normals = self.world.normal_map();
        let mut scale = self.world.mean_scale();
        for vertex in 0..count {
            let i = used.element(vertex);
            let skinned = match &self.skinning {
                Some(skinning) => Some(skinning.matrix(i).map_err(|joint| {
                    Error::gltf(self.place, format!("joint {joint}, but its skin has only {}", skinning.matrices.len()))
                })?),
                None => None,
            };
            let world = skinned.as_ref().unwrap_or(self.world);
            let skinned_normals = skinned.as_ref().map(Affine::normal_map);
            let normals = skinned_normals.as_ref().unwrap_or(&rigid_normals);
            if let (Some(skinned), 0) = (&skinned, vertex) {
                scale = skinned.mean_scale();
            }
            object.vertices.push(Vertex {
                position: each(world.point(attributes.position.element(i, 0.0)), |c| c as f32),
                normal: attributes.normal.as_ref().map_or([0.0; 3], |n| unit_or_zero(normals.apply(n.element(i, 0.0)))),
                color: attributes.color.as_ref().map_or(Vertex::WHITE, |color| {
                    let channels = color.element(i, 1.0);
                    // Morphing may leave the range (specification, 3.7.2.2).
                    let in_range = |c: f64| if color.is_morphed() { c.clamp(0.0, 1.0) } else { c };
                    channels.map(|c| in_range(c) as f32)
                }),
            });
            if let Some(tangent) = &attributes.tangent {
                let [x, y, z, w] = tangent.element(i, 0.0);
                let [x, y, z] = unit_or_zero(world.vector([x, y, z]));
                // A mirror image's bitangent is the mirrored bitangent.
                object.tangents.push([x, y, z, if (w < 0.0) == normals.is_mirrored { 1.0 } else { -1.0 }]);
            }
        }
        object.thickness_scale = scale as f32;
        object.uvs = attributes
            .uvs
            .iter()
            .map(|uvs| {
                let of = |vertex: usize| match uvs {
                    Some(uvs) => {
                        let [u, v]: [f64; 2] = uvs.element(used.element(vertex), 0.0);
                        [u as f32, v as f32]
                    }
                    None => [0.0; 2],
                };
                (0..count).map(of).collect()
            })
            .collect();
        Ok(object)
    }

    /// Mirrored triangles turn the other way: their first corner stays first, the others change places.
    fn turn(&self, used: &Used, object: &mut Object) {
        let Some(skinning) = &self.skinning else {
            if self.world.is_mirrored() {
                object.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
            }
            return;
        };
        // Rare, and costs as much as all vertices do.
        if !skinning.matrices.iter().any(Affine::is_mirrored) {
            return;
        }
        let is_mirrored = |&v: &u32| skinning.matrix(used.element(v as usize)).is_ok_and(|m| m.is_mirrored());
        for triangle in &mut object.triangles {
            if triangle.iter().filter(|v| is_mirrored(v)).count() >= 2 {
                triangle.swap(1, 2);
            }
        }
    }
}
