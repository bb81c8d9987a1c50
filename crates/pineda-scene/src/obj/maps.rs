//! The images of MTL materials: which become which textures.
//!
//! MTL has an image for each property, glTF some properties in the channels of one: opacity is the alpha of the base
//! colour, roughness and metalness are green and blue. Images of one size are put together.

use std::collections::HashMap;
use std::sync::Arc;

use super::mtl::{Entry, Map};
use crate::image::{Encoded, ImageStore, read_file};
use crate::limits::Budget;
use crate::resolver::{SideFiles, path_inside};
use crate::{AlphaMode, Image, Material, Resolver, Sampler, Scene, Texels, Texture, TextureRef, Wrap};

/// What has been made of the libraries' images so far.
#[derive(Default)]
pub(super) struct Maps {
    /// By folder and name; `None` for one that cannot be had, which has been said.
    loaded: HashMap<(String, String), Option<Arc<Image>>>,
    textures: Vec<Texture>,
    images: Vec<Arc<Image>>,
    /// Images put together, by what each channel is taken from.
    merged: HashMap<[Option<Source>; 4], Arc<Image>>,
    /// Counts their pixels, too.
    store: ImageStore,
    notes: Vec<String>,
}

/// Where a channel of an image is taken from.
type Channel<'a> = (Option<&'a Image>, usize);

/// The same for comparisons: an image's address, and the channel there.
type Source = (*const Image, usize);

impl Maps {
    /// Reads and decodes the images of these materials.
    pub(super) fn new<'e>(entries: impl Iterator<Item = &'e Entry>, files: &dyn Resolver, budget: &mut Budget) -> Self {
        let mut this = Self::default();
        let mut files = SideFiles::new(files);
        let mut names = Vec::new();
        let mut encoded = Vec::new();
        for entry in entries {
            for map in entry.maps().into_iter().flatten() {
                if this.loaded.insert(key(entry, map), None).is_none() {
                    names.push(key(entry, map));
                    encoded.push((map.file.as_str().into(), find(&entry.folder, &map.file, &mut files, budget)));
                }
            }
        }
        let numbers: Vec<usize> = (0..encoded.len()).collect();
        this.store = ImageStore::new(encoded, budget);
        for (name, image) in names.into_iter().zip(this.store.get(&numbers, |_| Err(String::new()))) {
            match image {
                Ok(image) => {
                    this.loaded.insert(name, Some(image));
                }
                Err(line) => this.notes.push(line),
            }
        }
        this
    }

    /// A material with its textures.
    pub(super) fn dress(&mut self, entry: &Entry) -> Material {
        let mut material = entry.material.clone();
        let images = entry.maps().map(|map| {
            let map = map?;
            Some((map.clone(), self.loaded.get(&key(entry, map))?.clone()?))
        });
        let [base, alpha, emissive, normal, roughness, metallic] = images;

        material.base_color_texture = match (base, alpha) {
            (base, None) => base.map(|(map, image)| self.texture(&map, image)),
            (base, Some((map, opacity))) => {
                material.alpha_mode = AlphaMode::Blend;
                let map = base.as_ref().map_or(&map, |(map, _)| map).clone();
                match base {
                    Some((_, base)) if Arc::ptr_eq(&base, &opacity) => Some(self.texture(&map, base)),
                    base => {
                        let base = base.as_ref().map(|(_, base)| &**base);
                        // The opacity is grey, or in the alpha of an image that has some.
                        let channel = (Some(&*opacity), if has_alpha(&opacity) { 3 } else { 0 });
                        self.merged(&map, [(base, 0), (base, 1), (base, 2), channel])
                    }
                }
            }
        };
        if let Some((map, image)) = emissive {
            // A map alone shines as it is.
            let is_dark = material.emissive_factor == [0.0; 3];
            material.emissive_factor = if is_dark { [1.0; 3] } else { material.emissive_factor };
            material.emissive_texture = Some(self.texture(&map, image));
        }
        if let Some((map, image)) = normal {
            if is_grey(&image) {
                self.notes.push(format!("image '{}' has heights, not normals: left out", image.name));
            } else {
                material.normal_scale = map.strength as f32;
                material.normal_texture = Some(self.texture(&map, image));
            }
        }
        if let Some(map) = roughness.as_ref().or(metallic.as_ref()).map(|(map, _)| map.clone()) {
            // What the file does not say, its map says alone.
            material.roughness_factor = if roughness.is_some() { 1.0 } else { material.roughness_factor };
            material.metallic_factor = if metallic.is_some() { 1.0 } else { material.metallic_factor };
            let [roughness, metallic] = [&roughness, &metallic].map(|part| part.as_ref().map(|(_, image)| &**image));
            material.metallic_roughness_texture =
                self.merged(&map, [(None, 0), (roughness, 0), (metallic, 0), (None, 3)]);
        }
        material
    }

    /// Hands over what has been made.
    pub(super) fn finish(self, scene: &mut Scene, notes: &mut Vec<String>) {
        scene.textures = self.textures;
        scene.images = self.images;
        for note in self.notes {
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
    }

    fn texture(&mut self, map: &Map, image: Arc<Image>) -> TextureRef {
        let image = self.images.iter().position(|known| Arc::ptr_eq(known, &image)).unwrap_or_else(|| {
            self.images.push(image);
            self.images.len() - 1
        });
        let wrap = if map.clamp { Wrap::ClampToEdge } else { Wrap::Repeat };
        let texture =
            Texture { name: "".into(), image, sampler: Sampler { wrap_s: wrap, wrap_t: wrap, ..Sampler::default() } };
        let number = self.textures.iter().position(|known| *known == texture).unwrap_or_else(|| {
            self.textures.push(texture);
            self.textures.len() - 1
        });
        // With v going down: 1 - ((1 - v) * scale + offset).
        let [[su, sv], [ou, ov]] = [map.scale, map.offset];
        let transform = [[su, 0.0, ou], [0.0, sv, 1.0 - sv - ov]].map(|row| row.map(|c| c as f32));
        TextureRef { transform, ..TextureRef::new(number) }
    }

    /// A texture of an image that takes each channel from an image's; white where there is none.
    fn merged(&mut self, map: &Map, channels: [Channel<'_>; 4]) -> Option<TextureRef> {
        let mut images = channels.iter().filter_map(|(image, _)| *image);
        let first = images.next()?;
        let (name, width, height) = (first.name.clone(), first.width, first.height);
        if let Some(other) = images.find(|other| (other.width, other.height) != (width, height)) {
            self.notes.push(format!("images '{name}' and '{}' are not of one size: left out", other.name));
            return None;
        }
        let sources = channels.map(|(image, channel)| image.map(|image| (std::ptr::from_ref(image), channel)));
        let image = match self.merged.get(&sources) {
            Some(image) => Arc::clone(image),
            None => {
                if let Err(reason) = self.store.count(width, height) {
                    self.notes.push(format!("image '{name}' together with another {reason}"));
                    return None;
                }
                let texels = (0..width as usize * height as usize).map(|at| {
                    channels.map(|(image, channel)| image.map_or(255, |image| channel_of(image, at, channel)))
                });
                let image = Arc::new(Image { name, width, height, texels: Texels::Rgba8(texels.collect()) });
                self.merged.insert(sources, Arc::clone(&image));
                image
            }
        };
        Some(self.texture(map, image))
    }
}

fn key(entry: &Entry, map: &Map) -> (String, String) {
    (entry.folder.clone(), map.file.clone())
}

/// A file by the name that a library gives it: from the library's folder, or else from the model's; or the file of that
/// name in either, for paths of the machine that it was made on.
fn find(folder: &str, name: &str, files: &mut SideFiles<'_>, budget: &mut Budget) -> Encoded {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let candidates = [format!("{folder}{name}"), name.to_owned(), format!("{folder}{last}"), last.to_owned()];
    let mut reason = None;
    for path in candidates.iter().filter_map(|candidate| path_inside(candidate)) {
        match read_file(&path, files, budget) {
            Ok(bytes) => return Encoded::Bytes(bytes),
            Err(why) => reason = reason.or(Some(why)),
        }
    }
    Encoded::Missing(reason.unwrap_or_else(|| "is outside the model's folder, so it is not read".to_owned()))
}

/// In 8 bits.
fn channel_of(image: &Image, at: usize, channel: usize) -> u8 {
    match &image.texels {
        Texels::Rgba8(texels) => texels[at][channel],
        Texels::Rgba16(texels) => (texels[at][channel] >> 8) as u8,
    }
}

fn is_grey(image: &Image) -> bool {
    match &image.texels {
        Texels::Rgba8(texels) => texels.iter().all(|[r, g, b, _]| r == g && g == b),
        Texels::Rgba16(texels) => texels.iter().all(|[r, g, b, _]| r == g && g == b),
    }
}

fn has_alpha(image: &Image) -> bool {
    match &image.texels {
        Texels::Rgba8(texels) => texels.iter().any(|texel| texel[3] != u8::MAX),
        Texels::Rgba16(texels) => texels.iter().any(|texel| texel[3] != u16::MAX),
    }
}
