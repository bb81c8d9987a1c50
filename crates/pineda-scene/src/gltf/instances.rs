//! EXT_mesh_gpu_instancing: one node that has its mesh many times.

use super::accessor::{Accessor, Accessors};
use super::schema::{Instancing, Node};
use super::transform::Affine;
use crate::Error;
use crate::limits::Budget;

/// Where the node, which is at `world`, has its mesh: each instance has a transform of its own before the node's.
pub(super) fn places(
    node: &Node,
    number: usize,
    world: &Affine,
    accessors: &Accessors<'_>,
    budget: &mut Budget,
) -> Result<Vec<Affine>, Error> {
    // A skin says itself where its vertices are.
    let Some(Instancing { attributes }) = node.extensions.instancing.as_ref().filter(|_| node.skin.is_none()) else {
        return Ok(vec![*world]);
    };
    let place = format!("node {number}, EXT_mesh_gpu_instancing");
    let mut count = None;
    let mut get = |name: &str, accessor, channels: usize| -> Result<Option<Accessor<'_>>, Error> {
        let Some(accessor) = accessor else { return Ok(None) };
        let accessor = accessors.get(accessor, &format!("{place}, {name}"), budget)?;
        if accessor.channels != channels || *count.get_or_insert(accessor.count) != accessor.count {
            let message = format!("{name} needs {channels} numbers for each instance, and all as many instances");
            return Err(Error::gltf(place.as_str(), message));
        }
        Ok(Some(accessor))
    };
    let translations = get("TRANSLATION", attributes.translation, 3)?;
    let rotations = get("ROTATION", attributes.rotation, 4)?;
    let scales = get("SCALE", attributes.scale, 3)?;
    let count = count.unwrap_or_default();
    budget.check_objects(count as u64)?;
    let at = |i: usize| {
        let translation = translations.as_ref().map_or([0.0; 3], |t| t.element(i, 0.0));
        let rotation = rotations.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |r| r.element(i, 0.0));
        let scale = scales.as_ref().map_or([1.0; 3], |s| s.element(i, 1.0));
        world.after(&Affine::from_parts(translation, rotation, scale))
    };
    Ok((0..count).map(at).collect())
}
