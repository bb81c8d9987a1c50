//! The images that materials may show, and the textures of a pose.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::buffers::{Buffers, data_uri};
use super::schema::{Root, Sampler, Whole};
use crate::image::{Encoded, ImageStore};
use crate::limits::Budget;
use crate::resolver::{SideFiles, path_inside, percent_decode};
use crate::text::shown;
use crate::{Filter, Image, Texture, Wrap};

/// Reads the files of those images that any primitive's material shows. None of them is decoded yet, and one that is
/// not there is a note for who shows it.
pub(super) fn read(root: &mut Root, files: &mut SideFiles<'_>, budget: &mut Budget) -> ImageStore {
    let is_shown = shown_images(root);
    let mut entries = Vec::with_capacity(root.images.len());
    for (number, (image, is_shown)) in root.images.iter_mut().zip(is_shown).enumerate() {
        // Not needed twice, and data URIs are long.
        let uri = image.uri.take();
        let file = uri.as_deref().filter(|uri| !is_data_uri(uri));
        let name = match (&image.name, file) {
            (_, Some(file)) => shown(percent_decode(file).as_deref().unwrap_or(file).as_bytes()),
            (Some(name), None) if !name.is_empty() => shown(name.as_bytes()),
            _ => format!("number {number}"),
        };
        let encoded = match uri {
            _ if !is_shown => Encoded::Missing("is not shown by any material".to_owned()),
            Some(uri) => load(&uri, files, budget).map_or_else(Encoded::Missing, Encoded::Bytes),
            None if image.buffer_view.is_some() => Encoded::Elsewhere,
            None => Encoded::Missing("has neither a URI nor a buffer view".to_owned()),
        };
        entries.push((name.as_str().into(), encoded));
    }
    ImageStore::new(entries, budget)
}

fn shown_images(root: &Root) -> Vec<bool> {
    let mut shown = vec![false; root.images.len()];
    for primitive in root.meshes.iter().flat_map(|mesh| mesh.primitives.iter()) {
        let variants = primitive.extensions.variants.iter().flat_map(|variants| variants.mappings.iter());
        for material in variants.map(|mapping| mapping.material).chain(primitive.material) {
            let Some(material) = root.materials.get(material.index()) else { continue };
            for info in material.textures() {
                let source = root.textures.get(info.index.index()).and_then(|texture| texture.source());
                if let Some(shown) = source.and_then(|source| shown.get_mut(source.index())) {
                    *shown = true;
                }
            }
        }
    }
    shown
}

fn is_data_uri(uri: &str) -> bool {
    uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

fn load(uri: &str, files: &mut SideFiles<'_>, budget: &mut Budget) -> Result<Arc<Vec<u8>>, String> {
    if let Some(data) = data_uri(uri) {
        return data.map(Arc::new).map_err(|message| format!("cannot be read: {message}"));
    }
    let path = percent_decode(uri).as_deref().and_then(path_inside);
    let path = path.ok_or("is outside the model's folder, so it is not read")?;
    crate::image::read_file(&path, files, budget)
}

/// The textures of one pose, numbered anew: only those that its materials show and whose image is there.
#[derive(Default)]
pub(super) struct Textures {
    pub(super) textures: Vec<Texture>,
    pub(super) images: Vec<Arc<Image>>,
    /// From the file's numbers.
    pub(super) number_of: BTreeMap<usize, usize>,
    pub(super) notes: Vec<String>,
}

impl Textures {
    /// `wanted` are the file's numbers, in increasing order.
    pub(super) fn new(
        root: &Root,
        wanted: impl Iterator<Item = usize> + Clone,
        store: &ImageStore,
        buffers: &Buffers,
    ) -> Self {
        let mut this = Self::default();
        let source = |number: usize| {
            let source = root.textures.get(number).and_then(|texture| texture.source()).map(Whole::index);
            source.filter(|&source| source < root.images.len())
        };
        let mut sources: Vec<usize> = wanted.clone().filter_map(source).collect();
        sources.sort_unstable();
        sources.dedup();
        let bytes_of = |number: usize| {
            let view = root.images[number].buffer_view.unwrap_or_default();
            buffers.view(root, view).map_err(|error| format!("cannot be read: {error}"))
        };
        let mut image_of = BTreeMap::new();
        for (&number, image) in sources.iter().zip(store.get(&sources, bytes_of)) {
            match image {
                Ok(image) => {
                    image_of.insert(number, this.images.len());
                    this.images.push(image);
                }
                Err(line) => this.notes.push(line),
            }
        }
        for number in wanted {
            match source(number) {
                None => this.notes.push(format!("texture {number} has no image that can be shown")),
                Some(source) => {
                    let Some(&image) = image_of.get(&source) else { continue };
                    this.number_of.insert(number, this.textures.len());
                    let texture = &root.textures[number];
                    let name = shown(texture.name.as_deref().unwrap_or_default().as_bytes()).into();
                    let sampler = texture.sampler.and_then(|sampler| root.samplers.get(sampler.index()));
                    let sampler = sampler.map(convert_sampler).unwrap_or_default();
                    this.textures.push(Texture { name, image, sampler });
                }
            }
        }
        this
    }
}

/// Codes that do not exist mean what nothing means.
fn convert_sampler(sampler: &Sampler) -> crate::Sampler {
    use Filter::{Linear, Nearest};
    let code = |field: Option<Whole>| field.unwrap_or_default().0;
    let wrap = |field| match code(field) {
        33071 => Wrap::ClampToEdge,
        33648 => Wrap::MirroredRepeat,
        _ => Wrap::Repeat,
    };
    let (min_filter, mip_filter) = match code(sampler.min_filter) {
        9728 => (Nearest, None),
        9729 => (Linear, None),
        9984 => (Nearest, Some(Nearest)),
        9985 => (Linear, Some(Nearest)),
        9986 => (Nearest, Some(Linear)),
        _ => (Linear, Some(Linear)),
    };
    crate::Sampler {
        mag_filter: if code(sampler.mag_filter) == 9728 { Nearest } else { Linear },
        min_filter,
        mip_filter,
        wrap_s: wrap(sampler.wrap_s),
        wrap_t: wrap(sampler.wrap_t),
    }
}
