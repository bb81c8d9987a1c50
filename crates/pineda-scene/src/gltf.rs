//! glTF 2.0 geometry, as JSON or GLB.
//!
//! An own reader on `serde_json`: `gltf` 1.4 (2024) refuses files that require KHR_mesh_quantization, reads integer
//! positions as floats, takes an accessor that is too long for its buffer for an empty one without an error, and does
//! not look for cycles among nodes. What is left once all that is done by hand is the list of fields.
//!
//! ```text
//! bytes -> glb        JSON and binary chunk
//!       -> schema     the JSON as structs
//!       -> extensions what the file requires, against what there is
//!       -> nodes      each node of the scene that has a mesh, with its world transform
//!       -> primitive  accessors -> an Object each
//! ```

mod accessor;
mod buffers;
mod extensions;
mod glb;
mod materials;
mod nodes;
mod primitive;
mod schema;
mod transform;

use crate::limits::Budget;
use crate::{Error, Loaded, Resolver, Scene, note};
use buffers::Buffers;
use primitive::{PrimitiveReader, Skipped};
use schema::Root;

/// Reads a glTF file and the buffers that it names, as far as its geometry needs them.
pub(crate) fn read(bytes: &[u8], files: &dyn Resolver, budget: &mut Budget) -> Result<Loaded, Error> {
    let container = glb::split(bytes)?;
    let root = schema::parse(container.json)?;
    extensions::check_required(&root)?;
    let buffers = Buffers::new(&root.buffers, container.binary, files);
    let default_material = root.materials.len();
    let mut reader = PrimitiveReader::new(&root, &buffers, default_material);
    let mut objects = Vec::new();
    let mut skinned = 0;
    nodes::for_each_mesh(&root, budget.nesting(), |node, mesh, world| {
        skinned += usize::from(node.skin.is_some());
        for number in 0..root.meshes[mesh].primitives.len() {
            budget.objects(1)?;
            objects.extend(reader.read(node, mesh, number, &world, budget)?);
        }
        Ok(())
    })?;
    let skipped = reader.skipped;
    let mut materials = materials::materials(&root);
    if objects.iter().any(|object| object.material == default_material) {
        materials.push(materials::default());
    }
    let notes = notes(&root, &skipped, skinned);
    Ok(Loaded { scene: Scene { objects, materials }, notes })
}

fn notes(root: &Root, skipped: &Skipped, skinned: usize) -> Vec<String> {
    let mut notes = Vec::new();
    let mut left_out = |count: usize, before: &str, one: &str, many: &str, after: &str| {
        if count > 0 {
            notes.push(format!("{before}{}{after}", note::counted(count, one, many)));
        }
    };
    left_out(skipped.points, "", "point primitive", "point primitives", " skipped");
    left_out(skipped.lines, "", "line primitive", "line primitives", " skipped");
    left_out(skipped.without_positions, "", "primitive", "primitives", " without positions skipped");
    left_out(skinned, "skins are not applied yet: ", "mesh", "meshes", " drawn as stored");
    left_out(skipped.morphed, "morph targets are not applied yet: ", "mesh", "meshes", " drawn without");
    left_out(root.animations.len(), "animations are not read yet: ", "animation", "animations", " ignored");
    notes.extend(note::textures(if root.textures.is_empty() { 0 } else { root.images.len() }));
    notes.extend(materials::note(root));
    notes.extend(extensions::note(root));
    notes
}
