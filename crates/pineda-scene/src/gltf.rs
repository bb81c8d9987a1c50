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
//!                  -> images     theirs, not yet decoded
//! each pose:       -> animation  transforms and morph weights at a time
//!                  -> nodes      where each node of the scene is
//!                  -> skin       where joints take vertices
//!                  -> primitive  accessors -> an Object each
//!                  -> images, materials   those that objects show
//! ```

mod accessor;
mod animation;
mod attributes;
mod buffers;
mod bystanders;
mod draco;
mod extensions;
mod glb;
mod images;
mod instances;
mod materials;
mod meshopt;
mod mode;
mod nodes;
mod primitive;
mod schema;
mod skin;
mod transform;

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::sync::Arc;

use crate::image::ImageStore;
use crate::limits::Budget;
use crate::model::{Animation, Contents, ResolvedPose};
use crate::note::counted;
use crate::resolver::SideFiles;
use crate::text::shown;
use crate::{Error, Loaded, Material, Object, Resolver, Scene};
use accessor::Accessors;
use animation::AnimatedNodes;
use buffers::Buffers;
use draco::DracoMeshes;
use images::Textures;
use nodes::Nodes;
use primitive::{PrimitiveReader, Shown};
use schema::{Root, Whole};
pub(crate) use transform::Affine;

/// A glTF file that has been read, and the files that it names.
#[derive(Debug)]
pub(crate) struct Document {
    root: Root,
    buffers: Buffers,
    draco: DracoMeshes,
    images: ImageStore,
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
        let mut files = SideFiles::new(files);
        let buffers = Buffers::read(&mut root, binary, &mut files, &mut budget);
        let draco = DracoMeshes::read(&root, &buffers, &mut budget);
        let images = images::read(&mut root, &mut files, &mut budget);
        Ok(Self { root, buffers, draco, images, budget })
    }

    /// What there is to choose from.
    pub(crate) fn contents(&self) -> Contents {
        let root = &self.root;
        let name = |name: &Option<String>| -> Arc<str> { shown(name.as_deref().unwrap_or_default().as_bytes()).into() };
        let accessors = Accessors::new(root, &self.buffers);
        let mut budget = self.budget.clone();
        let animations = root.animations.iter().map(|animation| Animation {
            name: name(&animation.name),
            duration: animation::duration(animation, &accessors, &mut budget),
        });
        let animations = animations.collect();
        let variants = root.extensions.variants.iter().flat_map(|variants| variants.variants.iter());
        Contents {
            scenes: root.scenes.iter().map(|scene| name(&scene.name)).collect(),
            default_scene: root.scene.map_or(0, Whole::index),
            animations,
            variants: variants.map(|variant| name(&variant.name)).collect(),
        }
    }

    /// The scene in a pose, not yet cleaned of what cannot be drawn.
    pub(crate) fn scene(&self, pose: &ResolvedPose) -> Result<Loaded, Error> {
        let root = &self.root;
        let mut budget = self.budget.clone();
        let accessors = Accessors::new(root, &self.buffers);
        let animated = match pose.animation {
            Some(animation) => animation::at(root, animation, pose.time, &accessors, &mut budget)?,
            None => AnimatedNodes::new(),
        };
        let (mut nodes, order) = Nodes::of_scene(root, &animated, pose.scene, budget.nesting())?;
        let skins = Skins::new(root, &mut nodes, &order)?;
        let mut posing = Posing {
            root,
            animated: &animated,
            nodes: &nodes,
            skins,
            reader: PrimitiveReader::new(root, accessors, &self.draco, pose.variant),
            missing: None,
            notes: Vec::new(),
        };
        let mut scene = Scene::default();
        for &node in &order {
            let world = nodes.world(node).unwrap_or(Affine::IDENTITY);
            scene.cameras.extend(bystanders::camera(root, &root.nodes[node], &world));
            scene.lights.extend(bystanders::light(root, &root.nodes[node], &world));
            posing.mesh(node, &world, &mut scene.objects, &mut budget)?;
        }
        let Posing { reader, missing, mut notes, .. } = posing;
        if let (Some(error), true) = (missing, scene.objects.is_empty()) {
            return Err(error);
        }
        if reader.skipped > 0 {
            notes.push(format!("{} without positions skipped", counted(reader.skipped, "primitive", "primitives")));
        }
        notes.extend(self.dress(&mut scene, pose.without_textures));
        notes.extend(extensions::note(root));
        Ok(Loaded { scene, notes })
    }

    /// Gives the scene the materials of its objects, with their textures; what is missing is a note each.
    fn dress(&self, scene: &mut Scene, without_textures: bool) -> Vec<String> {
        let root = &self.root;
        let mut is_drawn = vec![false; root.materials.len()];
        let mut needs_default = false;
        for object in &scene.objects {
            match is_drawn.get_mut(object.material) {
                Some(is_drawn) => *is_drawn = true,
                None => needs_default = true,
            }
        }
        let drawn = root.materials.iter().zip(&is_drawn).filter(|&(_, &is_drawn)| is_drawn && !without_textures);
        let wanted: BTreeSet<usize> = drawn.flat_map(|(m, _)| m.textures()).map(|info| info.index.index()).collect();
        let textures = Textures::new(root, wanted.iter().copied(), &self.images, &self.buffers);
        scene.materials = materials::materials(root, &is_drawn, &textures);
        if needs_default {
            scene.materials.push(Material::gltf());
        }
        scene.textures = textures.textures;
        scene.images = textures.images;
        textures.notes
    }
}

/// What goes on while a scene's meshes become objects.
struct Posing<'a> {
    root: &'a Root,
    animated: &'a AnimatedNodes,
    nodes: &'a Nodes<'a>,
    skins: Skins,
    reader: PrimitiveReader<'a>,
    /// The first file that was not there.
    missing: Option<Error>,
    notes: Vec<String>,
}

impl Posing<'_> {
    /// The objects of a node's mesh.
    fn mesh(
        &mut self,
        number: usize,
        world: &Affine,
        objects: &mut Vec<Object>,
        budget: &mut Budget,
    ) -> Result<(), Error> {
        let root = self.root;
        let node = &root.nodes[number];
        let Some(mesh_number) = node.mesh else { return Ok(()) };
        let wrong = |message: String| Error::gltf(format!("node {number}"), message);
        let Some(mesh) = root.meshes.get(mesh_number.index()) else {
            return Err(wrong(format!("its mesh {mesh_number} does not exist")));
        };
        let animated = self.animated.get(&number).and_then(|animated| animated.weights.as_deref());
        let weights = animated.or(node.weights.as_deref()).or(mesh.weights.as_deref()).unwrap_or_default();
        let places = instances::places(node, number, world, &self.reader.accessors, budget);
        let Some(places) = self.keep(places)? else { return Ok(()) };
        for world in places {
            for primitive in 0..mesh.primitives.len() {
                budget.objects(1)?;
                let read = (|| {
                    let skin = match node.skin {
                        Some(skin) => Some(self.skins.get(root, skin, self.nodes, &self.reader.accessors, budget)?),
                        None => None,
                    };
                    let node_name = node.name().unwrap_or_default();
                    let shown = Shown { mesh: mesh_number.index(), node_name, world, weights, skin };
                    self.reader.read(&shown, primitive, budget)
                })();
                objects.extend(self.keep(read)?.flatten());
            }
        }
        Ok(())
    }

    /// `None`, and a line about it, for what is in a file that is not there.
    fn keep<T>(&mut self, read: Result<T, Error>) -> Result<Option<T>, Error> {
        match read {
            Ok(read) => Ok(Some(read)),
            Err(error @ (Error::SideFile { .. } | Error::OutsideFolder { .. })) => {
                let line = format!("some of the model left out: {error}");
                if !self.notes.contains(&line) {
                    self.notes.push(line);
                }
                self.missing.get_or_insert(error);
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }
}

/// The joints' matrices of the scene's skins, each when it is first asked for.
struct Skins {
    matrices: Vec<OnceCell<Vec<Affine>>>,
}

impl Skins {
    /// Joints need not be in the scene themselves.
    fn new(root: &Root, nodes: &mut Nodes<'_>, order: &[usize]) -> Result<Self, Error> {
        let skins: BTreeSet<usize> = order.iter().filter_map(|&node| root.nodes[node].skin).map(Whole::index).collect();
        let skins = skins.into_iter().filter_map(|skin| root.skins.get(skin));
        nodes.complete(skins.flat_map(|skin| skin.joints.iter()).map(|joint| joint.index()))?;
        Ok(Self { matrices: vec![OnceCell::new(); root.skins.len()] })
    }

    fn get(
        &self,
        root: &Root,
        number: Whole,
        nodes: &Nodes<'_>,
        accessors: &Accessors<'_>,
        budget: &mut Budget,
    ) -> Result<&[Affine], Error> {
        let place = format!("skin {number}");
        let wrong = |message: String| Error::gltf(place.as_str(), message);
        let missing = || wrong("a node names it, but it does not exist".to_owned());
        let cell = self.matrices.get(number.index()).ok_or_else(missing)?;
        if let Some(matrices) = cell.get() {
            return Ok(matrices);
        }
        let world = |joint: Whole| {
            nodes.world(joint.index()).ok_or_else(|| wrong(format!("its joint, node {joint}, does not exist")))
        };
        let matrices = skin::joint_matrices(&root.skins[number.index()], &place, world, accessors, budget)?;
        Ok(cell.get_or_init(|| matrices))
    }
}
