//! Textures: memory that shaders look up, filtered.
//!
//! A texture is a field of a shader, and so is its [`Sampler`]; it borrows its texels or owns them. The format is part of its type: `Texture2d<'a, Rgba8Srgb>`.
//!
//! # Where texels come from
//!
//! From slices, without a copy; with the crate `image`, `Texture2d::<Rgba8Srgb>::from_channels(picture.width(), picture.height(), &picture)` is all. `.with_mips()` makes a
//! chain of levels, without which a texture that is seen from afar flickers.
//!
//! From what was drawn before: a target's buffer is a texture in one line, when the pass is done.
//!
//! ```
//! # use pineda::*;
//! # let (shadow_pass, mut renderer, mut depth) = (Pass::new(), Renderer::new(Settings::default())?, vec![0f32; 64 * 64]);
//! let mut target = Target { depth: DepthBuffer::D32F(&mut depth), ..Target::new(64, 64) };
//! renderer.render(&shadow_pass, &mut target)?;
//! let shadow_map = Texture2d::<R32F>::new(64, 64, &depth)?;
//! # Ok::<(), Error>(())
//! ```
//!
//! While a buffer is drawn to, no texture of it can be looked up: the target borrows it mutably. What other interfaces forbid as feedback does not compile here.
//!
//! ```compile_fail,E0502
//! # use pineda::*;
//! # let (mut pixels, mut renderer) = (vec![[0u8; 4]; 64 * 64], Renderer::new(Settings::default())?);
//! let picture = Texture2d::<Rgba8>::new(64, 64, &pixels)?;
//! let mut target = Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(64, 64) };
//! let pass = Pass::new(); // with a draw that looks the picture up
//! renderer.render(&pass, &mut target)?;
//! drop(picture);
//! # Ok::<(), Error>(())
//! ```
//!
//! # How they are looked up
//!
//! - `texture.sample(&sampler, uv)`: the level of detail follows from the derivatives of `uv`, which it must know: `f.dual().uv`, or whatever is computed of that; see
//!   [`Dual`](crate::Dual);
//! - `sample_level`, `sample_grad`: with the level of detail or the derivatives given, in vertex stages and closures, too;
//! - `sample_compare`: for shadow maps;
//! - `fetch`: one texel by its place, as it is. That is all that formats of integers have.
//!
//! Coordinates may be anything: huge, infinite, NaN. They always mean some texel.
//!
//! # What is exact
//!
//! All of it is the same bits on every machine. A texel that is not filtered is exactly what it stands for: an 8-bit code over 255, rounded once; an sRGB code decoded and rounded
//! once. Filtering is linear interpolation in f32, in linear light; its weights are what the coordinate times the size leaves behind the point: 23 bits less those of the place, so 13 bits or more in
//! a texture of 1,024 texels, 9 in the largest. An f32 coordinate itself is no better.

mod address;
mod cube;
mod filter;
mod format;
mod image;
mod lod;
mod lookup;
mod mipmap;
mod sampler;
mod textures;

#[cfg(test)]
mod conformance;

pub use format::{
    Filterable, R8, R8Srgb, R16, R16F, R32F, R32I, R32U, Rg8, Rg8Srgb, Rg16, Rg16F, Rg32F, Rg32I, Rg32U, Rgba8,
    Rgba8Srgb, Rgba16, Rgba16F, Rgba32F, Rgba32I, Rgba32U, TextureFormat,
};
pub use image::{MAX_TEXTURE_LAYERS, MAX_TEXTURE_SIZE, MAX_TEXTURE_SIZE_3D};
pub use sampler::{Filter, MipFilter, Sampler, Wrap};
pub use textures::{Texture2d, Texture2dArray, Texture3d, TextureCube};
