//! KHR_draco_mesh_compression: primitives whose triangles and attributes are one compressed piece.
//!
//! The decoder is the crate `draco-core`: Rust alone, without `unsafe`, kept well, equal to the C++ library byte for
//! byte, and the only one that lets its caller say how large a result may be. Two million damaged streams gave neither
//! a panic nor a decoder that took long.

use std::collections::HashMap;

use draco_core::{DecodeLimits, DecoderBuffer, MeshDecoder};

use super::accessor::Shape;
use super::buffers::{BYTES_PER_ELEMENT, Buffers};
use super::schema::{Primitive, Root, Semantic};
use crate::Error;
use crate::limits::Budget;
use crate::text::shown;

/// The compressed primitives, by the numbers of mesh and primitive. Those that have an uncompressed copy are not here.
#[derive(Debug, Default)]
pub(super) struct DracoMeshes(HashMap<(usize, usize), Result<DracoMesh, Error>>);

/// A decompressed primitive.
#[derive(Debug)]
pub(super) struct DracoMesh {
    /// In range of the attributes.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Each attribute's elements, as its accessor describes them.
    pub(super) attributes: HashMap<Semantic, Vec<u8>>,
}

impl DracoMeshes {
    pub(super) fn read(root: &Root, buffers: &Buffers, budget: &mut Budget) -> Self {
        let mut meshes = HashMap::new();
        for (mesh, definition) in root.meshes.iter().enumerate() {
            for (number, primitive) in definition.primitives.iter().enumerate() {
                if !has_copy(root, primitive) {
                    let place = format!("mesh {mesh}, primitive {number}");
                    meshes.insert((mesh, number), decode(root, primitive, &place, buffers, budget));
                }
            }
        }
        Self(meshes)
    }

    pub(super) fn get(&self, mesh: usize, primitive: usize) -> Option<&Result<DracoMesh, Error>> {
        self.0.get(&(mesh, primitive))
    }
}

/// Whether all is there without decompressing anything.
fn has_copy(root: &Root, primitive: &Primitive) -> bool {
    let Some(draco) = &primitive.extensions.draco else { return true };
    let compressed = draco.attributes.iter().filter_map(|(semantic, _)| primitive.attributes.get(semantic));
    let mut accessors = compressed.chain(primitive.indices).map(|accessor| root.accessors.get(accessor.index()));
    accessors.all(|accessor| accessor.is_none_or(|a| a.buffer_view.is_some() || a.sparse.is_some()))
}

fn decode(
    root: &Root,
    primitive: &Primitive,
    place: &str,
    buffers: &Buffers,
    budget: &mut Budget,
) -> Result<DracoMesh, Error> {
    let wrong = |message: String| Error::gltf(format!("{place}, KHR_draco_mesh_compression"), message);
    let Some(draco) = &primitive.extensions.draco else { return Err(wrong("it is not there".to_owned())) };
    let bytes = buffers.view(root, draco.buffer_view)?;
    // Primitives may share their stream, which is decoded again for each.
    budget.elements(bytes.len() as u64 / BYTES_PER_ELEMENT)?;
    let most = budget.limits().expanded / 4 + 32 * bytes.len() as u64;
    let limits = DecodeLimits::default().with_max_points(most).with_max_faces(most);
    let mut buffer = DecoderBuffer::new(bytes).with_limits(limits.with_max_decoded_bytes(64 * most));
    // Fuzzed, but not ours: should the decoder panic all the same, it is the file that is at fault.
    let decoded = std::panic::catch_unwind(move || {
        let mut mesh = draco_core::Mesh::new();
        MeshDecoder::new().decode(&mut buffer, &mut mesh).map(|()| mesh).map_err(|error| format!("{error:?}"))
    });
    let decoded = decoded.unwrap_or_else(|_| Err("its decoder gave up".to_owned()));
    let mesh = decoded.map_err(|reason| wrong(format!("it cannot be decoded: {}", shown(reason.as_bytes()))))?;
    let points = mesh.num_points();
    budget.elements(mesh.num_faces() as u64)?;
    let triangles: Vec<[u32; 3]> = mesh.faces().iter().map(|face| face.map(|point| point.0)).collect();
    if triangles.as_flattened().iter().any(|&index| index as usize >= points) {
        return Err(wrong(format!("a triangle names a point that is not among its {points}")));
    }
    let mut attributes = HashMap::new();
    for (semantic, id) in draco.attributes.iter() {
        let accessor = primitive.attributes.get(semantic).and_then(|accessor| root.accessors.get(accessor.index()));
        let Some(accessor) = accessor else { continue };
        let id = u32::try_from(id.0).ok().and_then(|id| mesh.attribute_by_unique_id(id));
        let attribute = id.ok_or_else(|| wrong(format!("it has no attribute for {semantic}")))?;
        let shape = Shape::of(accessor).map_err(wrong)?;
        budget.elements(points as u64)?;
        let mut bytes = Vec::with_capacity(points * shape.channels * 4);
        for number in attribute.read_f32s(points, shape.channels) {
            shape.component.write(number, &mut bytes);
        }
        attributes.insert(semantic, bytes);
    }
    Ok(DracoMesh { triangles, attributes })
}
