//! glTF 2.0, as JSON or GLB.
//!
//! An own reader on `serde_json`: `gltf` 1.4 (2024) refuses files that require KHR_mesh_quantization, reads integer
//! positions as floats, takes an accessor that is too long for its buffer for an empty one without an error, and does
//! not look for cycles among nodes. What is left once all that is done by hand is the list of fields.
//!
//! ```text
//! once:      bytes -> glb        JSON and binary chunk
//!                  -> schema     the JSON as structs
//!                  -> extensions what the file requires, against what there is
//!                  -> buffers    their bytes
//! each pose:       -> nodes      each node of the scene that has a mesh, with its world transform
//!                  -> primitive  accessors -> an Object each
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

use std::borrow::Cow;

use crate::limits::Budget;
use crate::model::{Contents, ResolvedPose};
use crate::{Error, Loaded, Resolver, Scene, note};
use buffers::Buffers;
use primitive::{PrimitiveReader, Skipped};
use schema::Root;

/// A glTF file that has been read, and the files that it names.
#[derive(Debug)]
pub(crate) struct Document {
    root: Root,
    buffers: Buffers,
    /// What the limits left after reading: where each pose begins.
    budget: Budget,
}

impl Document {
    pub(crate) fn read(bytes: Cow<'_, [u8]>, files: &dyn Resolver, mut budget: Budget) -> Result<Self, Error> {
        let container = glb::split(&bytes)?;
        let mut root = schema::parse(&bytes[container.json])?;
        extensions::check_required(&root)?;
        let binary = container.binary.map(|range| {
            let mut bytes = bytes.into_owned();
            bytes.truncate(range.end);
            bytes.drain(..range.start);
            bytes
        });
        let buffers = Buffers::read(&mut root, binary, files, &mut budget);
        Ok(Self { root, buffers, budget })
    }

    /// The scene in a pose, not yet cleaned of what cannot be drawn.
    pub(crate) fn scene(&self, pose: &ResolvedPose) -> Result<Loaded, Error> {
        let root = &self.root;
        let mut budget = self.budget.clone();
        let default_material = root.materials.len();
        let mut reader = PrimitiveReader::new(root, &self.buffers, default_material);
        let mut objects = Vec::new();
        let mut skinned = 0;
        nodes::for_each_mesh(root, pose.scene, budget.nesting(), |node, mesh, world| {
            skinned += usize::from(node.skin.is_some());
            for number in 0..root.meshes[mesh].primitives.len() {
                budget.objects(1)?;
                objects.extend(reader.read(node, mesh, number, &world, &mut budget)?);
            }
            Ok(())
        })?;
        let skipped = reader.skipped;
        let mut materials = materials::materials(root);
        if objects.iter().any(|object| object.material == default_material) {
            materials.push(crate::Material::gltf());
        }
        let notes = notes(root, &skipped, skinned);
        Ok(Loaded { scene: Scene { objects, materials, ..Scene::default() }, notes })
    }

    /// What there is to choose from.
    pub(crate) fn contents(&self) -> Contents {
        let name = |name: &Option<String>| crate::text::shown(name.as_deref().unwrap_or_default().as_bytes()).into();
        let scenes = self.root.scenes.iter().map(|scene| name(&scene.name)).collect();
        let default_scene = self.root.scene.map_or(0, |scene| scene.index());
        Contents { scenes, default_scene, ..Contents::default() }
    }
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
