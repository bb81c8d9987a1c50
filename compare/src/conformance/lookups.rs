//! What both renderers are given where textures are looked up one place at a time: a texture, a sampler, places; and what `pineda` finds there.

use super::sheet::Vertex;
use anyhow::Result;
use bytemuck::Pod;
use pineda::{
    ColorBuffer, DepthState, DrawState, Filterable, Fragment, Indices, Int, Lanes, Mesh, Pass, R8, R16, R16F, R32F,
    Real, Renderer, Rg8, Rgba, Rgba8, Rgba8Srgb, Rgba16F, Rgba32F, Sampler, Scalar, Shader, Target, Texture2d,
    Texture2dArray, Texture3d, TextureCube, Vec2, Vec3, Vec4, shader,
};

/// A texture, how it is looked up, and where.
#[derive(Clone, Debug)]
pub(crate) struct Lookups {
    pub(crate) texture: Texture,
    pub(crate) sampler: Sampler,
    pub(crate) how: How,
    pub(crate) places: Vec<Place>,
}

/// Levels of texels: those of level 0 first, row by row, slice by slice.
#[derive(Clone, Debug)]
pub(crate) struct Texture {
    pub(crate) kind: Kind,
    pub(crate) format: Format,
    /// Width, height, and layers, faces or depth.
    pub(crate) size: [u32; 3],
    pub(crate) levels: u32,
    pub(crate) bytes: Vec<u8>,
}

#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub(crate) enum Kind {
    Flat,
    Array,
    Cube,
    Volume,
}

#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub(crate) enum Format {
    R8,
    Rg8,
    Rgba8,
    Rgba8Srgb,
    R16F,
    Rgba16F,
    R32F,
    Rgba32F,
    /// Compared only: of WebGPU's depth formats the one that can be uploaded.
    Depth16,
}

#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub(crate) enum How {
    /// At [`Place::extra`] as level of detail.
    Level,
    /// With gradients.
    Gradient,
    /// Compared with [`Place::extra`].
    Compare,
}

/// A place, with what else a lookup wants.
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Place {
    /// Coordinates, or a direction.
    pub(crate) at: [f32; 3],
    /// The level of detail, or what is compared.
    pub(crate) extra: f32,
    /// By how much coordinates grow from a pixel to the next one on the right.
    pub(crate) right: [f32; 3],
    /// A whole number.
    pub(crate) layer: f32,
    /// And to the one below.
    pub(crate) down: [f32; 3],
    pub(crate) padding: f32,
}

impl Format {
    pub(crate) fn channels(self) -> usize {
        match self {
            Self::R8 | Self::R16F | Self::R32F | Self::Depth16 => 1,
            Self::Rg8 => 2,
            Self::Rgba8 | Self::Rgba8Srgb | Self::Rgba16F | Self::Rgba32F => 4,
        }
    }

    /// Bytes of a channel.
    pub(crate) fn channel_size(self) -> usize {
        match self {
            Self::R8 | Self::Rg8 | Self::Rgba8 | Self::Rgba8Srgb => 1,
            Self::R16F | Self::Rgba16F | Self::Depth16 => 2,
            Self::R32F | Self::Rgba32F => 4,
        }
    }
}

impl Texture {
    /// Width, height and slices of a level.
    pub(crate) fn extent(&self, level: u32) -> [u32; 3] {
        let [width, height, slices] = self.size;
        let halved = |size: u32| (size >> level).max(1);
        [halved(width), halved(height), if self.kind == Kind::Volume { halved(slices) } else { slices }]
    }

    /// How many texels lie before a level.
    pub(crate) fn texels_before(&self, level: u32) -> usize {
        (0..level).map(|level| self.extent(level).map(|size| size as usize).iter().product::<usize>()).sum()
    }
}

/// What `pineda` finds.
pub(crate) fn ours(lookups: &Lookups) -> Result<Vec<[f32; 4]>> {
    match lookups.texture.format {
        Format::R8 => found::<R8>(lookups),
        Format::Rg8 => found::<Rg8>(lookups),
        Format::Rgba8 => found::<Rgba8>(lookups),
        Format::Rgba8Srgb => found::<Rgba8Srgb>(lookups),
        Format::R16F => found::<R16F>(lookups),
        Format::Rgba16F => found::<Rgba16F>(lookups),
        Format::R32F => found::<R32F>(lookups),
        Format::Rgba32F => found::<Rgba32F>(lookups),
        Format::Depth16 => found::<R16>(lookups),
    }
}

fn found<F: Filterable>(Lookups { texture, sampler, how, places }: &Lookups) -> Result<Vec<[f32; 4]>>
where
    F::Texel: Pod,
{
    let ([width, height, slices], levels) = (texture.size, texture.levels);
    let texels: Vec<F::Texel> = bytemuck::pod_collect_to_vec(&texture.bytes);
    let vec2 = |[x, y, _]: [f32; 3]| Vec2::<Scalar>::from([x, y]);
    let vec3 = Vec3::<Scalar>::from;
    // One lane and as many as there are: the same bits (`tests/textures.rs`).
    let every = |look: &dyn Fn(&Place) -> Rgba<Scalar>| {
        let numbers = |place| {
            let Rgba { r, g, b, a } = look(place);
            [r, g, b, a].map(f32::from)
        };
        places.iter().map(numbers).collect()
    };
    let passed = |part: Real<Scalar>| Rgba { r: part, g: part, b: part, a: part };
    let layer = |place: &Place| Int::<Scalar>::from(place.layer as i32);
    Ok(match texture.kind {
        Kind::Flat => {
            let texture = Texture2d::<F>::with_levels(width, height, levels, texels)?;
            match how {
                How::Level => every(&|p| texture.sample_level(sampler, vec2(p.at), p.extra)),
                How::Gradient => every(&|p| texture.sample_grad(sampler, vec2(p.at), vec2(p.right), vec2(p.down))),
                How::Compare => every(&|p| passed(texture.sample_compare(sampler, vec2(p.at), p.extra))),
            }
        }
        Kind::Array => {
            let texture = Texture2dArray::<F>::with_levels(width, height, slices, levels, texels)?;
            match how {
                How::Level => every(&|p| texture.sample_level(sampler, vec2(p.at), layer(p), p.extra)),
                How::Gradient => {
                    every(&|p| texture.sample_grad(sampler, vec2(p.at), layer(p), vec2(p.right), vec2(p.down)))
                }
                How::Compare => every(&|p| passed(texture.sample_compare(sampler, vec2(p.at), layer(p), p.extra))),
            }
        }
        Kind::Cube => {
            let texture = TextureCube::<F>::with_levels(width, levels, texels)?;
            match how {
                How::Level => every(&|p| texture.sample_level(sampler, vec3(p.at), p.extra)),
                How::Gradient => every(&|p| texture.sample_grad(sampler, vec3(p.at), vec3(p.right), vec3(p.down))),
                How::Compare => every(&|p| passed(texture.sample_compare(sampler, vec3(p.at), p.extra))),
            }
        }
        Kind::Volume => {
            let texture = Texture3d::<F>::with_levels(width, height, slices, levels, texels)?;
            match how {
                How::Level | How::Compare => every(&|p| texture.sample_level(sampler, vec3(p.at), p.extra)),
                How::Gradient => every(&|p| texture.sample_grad(sampler, vec3(p.at), vec3(p.right), vec3(p.down))),
            }
        }
    })
}

/// Textured triangles. A picture of them has as many pixels as there are places in [`Lookups`].
#[derive(Clone, Debug)]
pub(crate) struct Surfaces {
    /// Flat, in halves.
    pub(crate) texture: Texture,
    pub(crate) sampler: Sampler,
    /// Coordinates are the first two channels.
    pub(crate) vertices: Vec<Vertex>,
}

struct Textured<'a> {
    texture: Texture2d<'a, Rgba16F>,
    sampler: Sampler,
}

#[shader]
impl Shader for Textured<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec2<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, &Vertex { position, color: [u, v, ..] }: &Vertex) -> (Vec4, Vec2) {
        (position.into(), [u, v].into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        self.texture.sample(&self.sampler, f.dual())
    }
}

/// What `pineda` draws.
pub(crate) fn draw_surfaces(renderer: &mut Renderer, surfaces: &Surfaces, side: u32) -> Result<Vec<[f32; 4]>> {
    let Surfaces { texture: Texture { size: [width, height, _], levels, bytes, .. }, sampler, vertices } = surfaces;
    let texels: Vec<[u16; 4]> = bytemuck::pod_collect_to_vec(bytes);
    let shader = Textured { texture: Texture2d::with_levels(*width, *height, *levels, texels)?, sampler: *sampler };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.0; 4]);
    let state = DrawState { depth: DepthState::OFF, ..DrawState::DEFAULT };
    pass.draw(&shader, Mesh { vertices, indices: Indices::Sequential }, state);
    let mut pixels = vec![[0.0; 4]; (side * side) as usize];
    let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(side, side) };
    renderer.render(&pass, &mut target)?;
    Ok(pixels)
}
