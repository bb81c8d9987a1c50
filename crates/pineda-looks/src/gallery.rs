//! The textures of a scene, ready to be looked up: levels made, formats known.

use pineda::{Dual, Error, Filter, Lanes, MipFilter, Rgba, Rgba8, Rgba8Srgb, Rgba16, Sampler, Texture2d, Vec2, Wrap};
use pineda_scene::{Scene, Texels, TextureRef};
use std::collections::HashMap;
use std::sync::Arc;

/// What a scene's materials look up, each texture made ready once.
#[derive(Debug)]
pub struct Gallery<'s> {
    scene: &'s Scene,
    pictures: HashMap<Key, Arc<Picture<'s>>>,
}

/// An image, by number, as it is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Key {
    image: usize,
    is_srgb: bool,
    has_mips: bool,
}

/// In the format that it is stored in.
#[derive(Debug)]
enum Picture<'s> {
    Linear8(Texture2d<'s, Rgba8>),
    Srgb8(Texture2d<'s, Rgba8Srgb>),
    Linear16(Texture2d<'s, Rgba16>),
}

/// A material's texture: which, how it is sampled, and where on the surface.
#[derive(Clone, Debug)]
pub struct Map<'s> {
    picture: Arc<Picture<'s>>,
    sampler: Sampler,
    uv_set: usize,
    transform: Option<[[f32; 3]; 2]>,
}

/// How many sets of texture coordinates the shaders know. Others are taken for the last.
pub(crate) const UV_SETS: usize = 2;

impl<'s> Gallery<'s> {
    /// Makes nothing yet. `scene` must hold whatever is asked for.
    #[must_use]
    pub fn new(scene: &'s Scene) -> Self {
        Self { scene, pictures: HashMap::new() }
    }

    /// A texture whose numbers are light or data, or, with `is_srgb`, colours on the sRGB curve. Without `mipmaps` it is looked up bilinearly in the full-size image, however
    /// small it gets.
    ///
    /// Errors: no memory for the smaller levels. A reference to what the scene has not gives `None`.
    pub fn map(
        &mut self,
        reference: Option<&TextureRef>,
        is_srgb: bool,
        mipmaps: bool,
    ) -> Result<Option<Map<'s>>, Error> {
        let scene = self.scene;
        let Some(reference) = reference else { return Ok(None) };
        let Some(texture) = scene.textures.get(reference.texture) else { return Ok(None) };
        let Some(image) = scene.images.get(texture.image) else { return Ok(None) };
        let sampler = sampler(&texture.sampler, mipmaps);
        let has_mips = sampler.mip_filter != MipFilter::Base;
        let key = Key { image: texture.image, is_srgb, has_mips };
        let picture = match self.pictures.get(&key) {
            Some(picture) => Arc::clone(picture),
            None => {
                let made = Arc::new(Picture::new(image, is_srgb, has_mips)?);
                self.pictures.insert(key, Arc::clone(&made));
                made
            }
        };
        let transform = (!reference.is_identity()).then_some(reference.transform);
        Ok(Some(Map { picture, sampler, uv_set: reference.uv_set, transform }))
    }
}

impl<'s> Picture<'s> {
    fn new(image: &'s pineda_scene::Image, is_srgb: bool, has_mips: bool) -> Result<Self, Error> {
        let (width, height) = (image.width, image.height);
        Ok(match &image.texels {
            Texels::Rgba8(texels) if is_srgb => {
                let texture = Texture2d::new(width, height, &texels[..])?;
                Self::Srgb8(if has_mips { texture.with_mips()? } else { texture })
            }
            Texels::Rgba8(texels) => {
                let texture = Texture2d::new(width, height, &texels[..])?;
                Self::Linear8(if has_mips { texture.with_mips()? } else { texture })
            }
            Texels::Rgba16(texels) => {
                let texture = if is_srgb {
                    // There is no such format: decoded, what 16 bits cannot tell apart is darker than anything that 8 can show.
                    let decoded = |&[r, g, b, a]: &[u16; 4]| [decoded(r), decoded(g), decoded(b), a];
                    Texture2d::new(width, height, texels.iter().map(decoded).collect::<Vec<_>>())?
                } else {
                    Texture2d::new(width, height, &texels[..])?
                };
                Self::Linear16(if has_mips { texture.with_mips()? } else { texture })
            }
        })
    }
}

/// IEC 61966-2-1.
fn decoded(code: u16) -> u16 {
    let v = f64::from(code) / 65535.0;
    let linear = if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) };
    (linear * 65535.0 + 0.5) as u16
}

fn sampler(theirs: &pineda_scene::Sampler, mipmaps: bool) -> Sampler {
    let filter = |filter| match filter {
        pineda_scene::Filter::Nearest => Filter::Nearest,
        pineda_scene::Filter::Linear => Filter::Linear,
    };
    let wrap = |wrap| match wrap {
        pineda_scene::Wrap::Repeat => Wrap::Repeat,
        pineda_scene::Wrap::MirroredRepeat => Wrap::Mirror,
        pineda_scene::Wrap::ClampToEdge => Wrap::Clamp,
    };
    let wrap = [wrap(theirs.wrap_s), wrap(theirs.wrap_t), Wrap::Repeat];
    if !mipmaps {
        return Sampler { wrap, mip_filter: MipFilter::Base, ..Sampler::TRILINEAR };
    }
    Sampler {
        wrap,
        mag_filter: filter(theirs.mag_filter),
        min_filter: filter(theirs.min_filter),
        mip_filter: match theirs.mip_filter {
            None => MipFilter::Base,
            Some(pineda_scene::Filter::Nearest) => MipFilter::Nearest,
            Some(pineda_scene::Filter::Linear) => MipFilter::Linear,
        },
        ..Sampler::TRILINEAR
    }
}

impl Map<'_> {
    /// Where in the texture a place on a surface is looked up.
    #[inline(always)]
    pub fn coordinates<L: Lanes>(&self, uvs: [Vec2<Dual<L>>; UV_SETS]) -> Vec2<Dual<L>> {
        self.transformed(self.chosen(uvs))
    }

    /// The texture's numbers, in linear light, at a place on a surface.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, uvs: [Vec2<Dual<L>>; UV_SETS]) -> Rgba<L> {
        let uv = self.chosen(uvs);
        // Shaders look up many maps: compiled once, not once for each.
        uv.value().lanes().apart(
            #[inline(always)]
            || self.sample_here(uv),
        )
    }

    #[inline(always)]
    fn chosen<L: Lanes>(&self, [first, second]: [Vec2<Dual<L>>; UV_SETS]) -> Vec2<Dual<L>> {
        if self.uv_set == 0 { first } else { second }
    }

    #[inline(always)]
    fn transformed<L: Lanes>(&self, uv: Vec2<Dual<L>>) -> Vec2<Dual<L>> {
        match self.transform {
            Some([[a, b, c], [d, e, f]]) => Vec2::new(uv.x * a + uv.y * b + c, uv.x * d + uv.y * e + f),
            None => uv,
        }
    }

    #[inline(always)]
    fn sample_here<L: Lanes>(&self, uv: Vec2<Dual<L>>) -> Rgba<L> {
        let uv = self.transformed(uv);
        match &*self.picture {
            Picture::Linear8(texture) => texture.sample(&self.sampler, uv),
            Picture::Srgb8(texture) => texture.sample(&self.sampler, uv),
            Picture::Linear16(texture) => texture.sample(&self.sampler, uv),
        }
    }
}
