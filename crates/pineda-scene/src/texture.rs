//! Images, and how materials look them up.

use std::sync::Arc;

/// A decoded picture, top row first. What its numbers mean, sRGB or linear, is its user's business:
/// [`Material`](crate::Material) says it of each of its textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The file's name for it, or else where it was; may be empty.
    pub name: Arc<str>,
    /// In pixels, at least 1.
    pub width: u32,
    /// In pixels, at least 1.
    pub height: u32,
    /// `width * height` of them, row by row.
    pub texels: Texels,
}

/// An image's pixels: slices that a renderer's texture can borrow.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Red, green, blue and straight alpha. Grey is given in all three, missing alpha is 255.
    Rgba8(Vec<[u8; 4]>),
    /// The same of files with 16 bits a channel; missing alpha is 65535.
    Rgba16(Vec<[u16; 4]>),
}

/// An image together with the way in which it is filtered and repeated.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The file's name for it; may be empty.
    pub name: Arc<str>,
    /// Index into [`Scene::images`](crate::Scene::images).
    pub image: usize,
    /// Filters and wrap modes.
    pub sampler: Sampler,
}

/// glTF's sampler (specification, 5.26).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// For an image that is magnified.
    pub mag_filter: Filter,
    /// Within a level, for an image that is made smaller.
    pub min_filter: Filter,
    /// Between levels: `None` looks up the full-size image however small it gets.
    pub mip_filter: Option<Filter>,
    /// To the left and right of the image.
    pub wrap_s: Wrap,
    /// Above and below the image.
    pub wrap_t: Wrap,
}

impl Default for Sampler {
    /// Linear in all respects, repeated: what a file that says nothing means.
    fn default() -> Self {
        Self {
            mag_filter: Filter::Linear,
            min_filter: Filter::Linear,
            mip_filter: Some(Filter::Linear),
            wrap_s: Wrap::Repeat,
            wrap_t: Wrap::Repeat,
        }
    }
}

/// How a value is made of those around.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The closest one.
    Nearest,
    /// The mean, weighted by distance.
    Linear,
}

/// What is beyond an image's border.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// The image again, every other one mirrored.
    MirroredRepeat,
    /// The border's texels.
    ClampToEdge,
}

/// A material's use of a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureRef {
    /// Index into [`Scene::textures`](crate::Scene::textures).
    pub texture: usize,
    /// Index into [`Object::uvs`](crate::Object::uvs). An object that has no such set is looked up at (0, 0).
    pub uv_set: usize,
    /// Two rows of an affine map, from the object's coordinates to the texture's:
    /// `u' = m[0][0] u + m[0][1] v + m[0][2]`, `v' = m[1][0] u + m[1][1] v + m[1][2]` (KHR_texture_transform).
    pub transform: [[f32; 3]; 2],
}

impl TextureRef {
    /// Coordinates as they are.
    pub const IDENTITY: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    /// A texture, looked up at the object's first set of coordinates as they are.
    pub fn new(texture: usize) -> Self {
        Self { texture, uv_set: 0, transform: Self::IDENTITY }
    }

    /// Whether coordinates are looked up as they are.
    pub fn is_identity(&self) -> bool {
        self.transform == Self::IDENTITY
    }
}
