//! The textures themselves: of two dimensions, arrays of such, cubes, of three dimensions.

use super::cube;
use super::filter::{AsIs, Compared, Cube, Flat, Lookup, Place, Volume};
use super::format::{Filterable, Rgba8Srgb, TextureFormat};
use super::image::{Extent, Image};
use super::lod::Gradient;
use super::lookup::{self, color};
use super::sampler::Sampler;
use crate::Error;
use crate::lanes::{Dual, Lanes};
use crate::math::{Int, Real, Rgba, ToLanes, Vec2, Vec3};
use std::borrow::Cow;

/// What all kinds of textures have.
macro_rules! common {
    ($name:ident($($size:ident),+), $extent:expr) => {
        impl<'a, F: TextureFormat> $name<'a, F> {
            /// A texture of one level, from its texels: row by row from the top, slice by slice.
            ///
            /// A slice is borrowed, not copied, and holds as long as the texture; a `Vec` is taken over. Errors: a size of 0 or beyond what there can be, or another number of texels than the size says.
            pub fn new($($size: u32,)+ texels: impl Into<Cow<'a, [F::Texel]>>) -> Result<Self, Error> {
                Self::with_levels($($size,)+ 1, texels)
            }

            /// A texture with levels of its own: those of level 0 first. Each level is half as large as the one before, rounded down, and at least 1.
            ///
            /// Errors as with [`new`](Self::new), and where there can be no such number of levels.
            pub fn with_levels($($size: u32,)+ levels: u32, texels: impl Into<Cow<'a, [F::Texel]>>) -> Result<Self, Error> {
                Ok(Self { image: Image::new($extent, levels, texels.into())? })
            }

            /// As [`new`](Self::new), from plain numbers: the channels of the first texel, then of the second, ... This is what the crate `image` holds.
            pub fn from_channels($($size: u32,)+ channels: &'a [F::Channel]) -> Result<Self, Error> {
                Ok(Self { image: Image::of_channels($extent, channels)? })
            }

            /// The number of levels, at least 1.
            pub fn levels(&self) -> u32 {
                self.image.count
            }

            /// The texels of a level, as they are stored; none if there is no such level.
            pub fn texels(&self, level: u32) -> &[F::Texel] {
                let texels = |level| self.image.extent.level(level).texels() as usize;
                let first = (0..level.min(self.image.count)).map(texels).sum();
                if level < self.image.count { &self.image.texels[first..first + texels(level)] } else { &[] }
            }
        }

        impl<F: Filterable> $name<'_, F> {
            /// A copy with a full chain of levels, made from level 0: each texel the mean of what it covers in the level before, in linear light.
            ///
            /// Errors: no memory for it, or more than 2^31 texels.
            pub fn with_mips(&self) -> Result<$name<'static, F>, Error> {
                Ok($name { image: self.image.with_mips::<false>()? })
            }

            /// The same with colours weighted by their alpha, so that those of transparent texels do not bleed into others: for leaves, fences, sprites. Alpha must not be
            /// multiplied into the colours already.
            pub fn with_alpha_weighted_mips(&self) -> Result<$name<'static, F>, Error> {
                Ok($name { image: self.image.with_mips::<true>()? })
            }
        }
    };
}

/// A texture of two dimensions, in the format `F`.
///
/// u runs from 0 to 1 from the left border to the right one, v from the top to the bottom, as rows lie in memory.
///
/// ```
/// use pineda::{Rgba8Srgb, Texture2d};
/// // As the crate `image` has it: `Texture2d::<Rgba8Srgb>::from_channels(picture.width(), picture.height(), &picture)`.
/// let checks: Vec<u8> = (0..8 * 8).flat_map(|k| [[40; 3], [220; 3]][(k + k / 8) % 2]).flat_map(|gray| [gray; 1]).collect();
/// # let checks: Vec<u8> = checks.chunks(3).flat_map(|c| [c[0], c[1], c[2], 255]).collect();
/// let texture = Texture2d::<Rgba8Srgb>::from_channels(8, 8, &checks)?.with_mips()?;
/// assert_eq!((texture.size(0), texture.levels()), ([8, 8], 4));
/// # Ok::<(), pineda::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Texture2d<'a, F: TextureFormat = Rgba8Srgb> {
    image: Image<'a, F>,
}

/// Textures of two dimensions, all of one size and format, chosen between by number.
#[derive(Clone, Debug)]
pub struct Texture2dArray<'a, F: TextureFormat = Rgba8Srgb> {
    image: Image<'a, F>,
}

/// Six square textures, the faces of a cube seen from its middle: what is looked up is a direction.
///
/// The faces, in order, are those that the axes +x, -x, +y, -y, +z, -z meet. Seen from the middle, with +y up (for the faces of y: with -z and +z up), each face's first row is the
/// upper one; its left column is the one on the left where x, y, z is a *left*-handed system, as cube maps have it since RenderMan (Vulkan 1.4, 16.5.4; D3D11.3). Lookups go on across edges: no seam
/// shows, but where levels of detail differ.
#[derive(Clone, Debug)]
pub struct TextureCube<'a, F: TextureFormat = Rgba8Srgb> {
    image: Image<'a, F>,
}

/// A texture of three dimensions.
#[derive(Clone, Debug)]
pub struct Texture3d<'a, F: TextureFormat = Rgba8Srgb> {
    image: Image<'a, F>,
}

common!(Texture2d(width, height), Extent { width, height, slices: 1, is_volume: false });
common!(Texture2dArray(width, height, layers), Extent { width, height, slices: layers, is_volume: false });
common!(TextureCube(size), Extent { width: size, height: size, slices: 6, is_volume: false });
common!(Texture3d(width, height, depth), Extent { width, height, slices: depth, is_volume: true });

/// The same from coordinates that know their derivatives.
#[inline(always)]
fn gradient2<L: Lanes>(uv: Vec2<Dual<L>>) -> Gradient<L> {
    gradient2_of(uv.dx(), uv.dy())
}

#[inline(always)]
fn gradient2_of<L: Lanes>(dx: Vec2<L>, dy: Vec2<L>) -> Gradient<L> {
    Gradient { dx: [dx.x, dx.y, dx.x], dy: [dy.x, dy.y, dy.x] }
}

#[inline(always)]
fn gradient3_of<L: Lanes>(dx: Vec3<L>, dy: Vec3<L>) -> Gradient<L> {
    Gradient { dx: [dx.x, dx.y, dx.z], dy: [dy.x, dy.y, dy.z] }
}

#[inline(always)]
fn place2<L: Lanes>(uv: Vec2<L>, slice: Int<L>) -> Place<L> {
    Place { at: [uv.x, uv.y, uv.x], slice }
}

#[inline(always)]
fn place3<L: Lanes>(uvw: Vec3<L>) -> Place<L> {
    Place { at: [uvw.x, uvw.y, uvw.z], slice: Int::new(uvw.lanes(), 0) }
}

impl<F: TextureFormat> Texture2d<'_, F> {
    /// Width and height of a level in texels; of a level that there is not, those that it would have.
    pub fn size(&self, level: u32) -> [u32; 2] {
        let extent = self.image.extent.level(level);
        [extent.width, extent.height]
    }

    /// The texel in column `x` of row `y` of a level, as it is; beyond the borders, and of a level that there is not, 0 in all channels that the format has. WGSL's
    /// `textureLoad`.
    #[inline(always)]
    pub fn fetch<L: Lanes>(&self, x: Int<L>, y: Int<L>, level: impl ToLanes<L, Int<L>>) -> F::Color<L> {
        let lanes = x.lanes();
        let level = level.to_lanes(lanes);
        lookup::fetch(&self.image, [x, y, Int::new(lanes, 0)], level)
    }
}

impl<F: Filterable> Texture2d<'_, F> {
    /// The colour at `uv`, filtered as the sampler says, at the level of detail that the derivatives of `uv` ask for. WGSL's `textureSample`.
    ///
    /// The level of detail is log2 of how many texels of level 0 a step of one pixel, right or down, moves over, whichever moves farther. With
    /// [`anisotropy`](Sampler::anisotropy), it is that of the shorter side of the pixel's footprint, for which several lookups are made along the longer side. Derivatives are
    /// exact (see [`Dual`]), so the level is, too: to within 2^-18, and the same bits wherever the pixel lies.
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Textured<'a> { camera: Mat4, albedo: Texture2d<'a>, sampler: Sampler }
    ///
    /// #[shader]
    /// impl Shader for Textured<'_> {
    ///     type Vertex = ([f32; 3], [f32; 2]);
    ///     type Varyings<L: Lanes> = Vec2<L>;
    ///     const DERIVATIVES: bool = true;
    ///
    ///     fn vertex(&self, (position, uv): &Self::Vertex) -> (Vec4, Vec2) {
    ///         (self.camera * Vec3::from(*position).extend(1.0), (*uv).into())
    ///     }
    ///
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         self.albedo.sample(&self.sampler, f.dual() * 4.0)
    ///     }
    /// }
    /// # let texels = [[255, 0, 0, 255], [0, 0, 255, 255]];
    /// # let albedo = Texture2d::new(2, 1, &texels)?.with_mips()?;
    /// # let shader = Textured { camera: Mat4::IDENTITY, albedo, sampler: Sampler::TRILINEAR };
    /// # let corners = [([-1.0, -1.0, 0.0], [0.0, 0.0]), ([3.0, -1.0, 0.0], [2.0, 0.0]), ([-1.0, 3.0, 0.0], [0.0, 2.0])];
    /// # let mut pass = Pass::new();
    /// # pass.draw(&shader, Mesh { vertices: &corners, indices: Indices::Sequential }, DrawState::default());
    /// # let mut pixels = vec![[0; 4]; 32 * 32];
    /// # let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(32, 32) };
    /// # Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// # assert!(pixels.iter().any(|p| p[0] > 200) && pixels.iter().any(|p| p[2] > 200));
    /// # Ok::<(), Error>(())
    /// ```
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, sampler: &Sampler, uv: Vec2<Dual<L>>) -> Rgba<L> {
        self.sample_bias(sampler, uv, 0.0)
    }

    /// [`sample`](Self::sample) with `bias` added to the level of detail.
    #[inline(always)]
    pub fn sample_bias<L: Lanes>(
        &self,
        sampler: &Sampler,
        uv: Vec2<Dual<L>>,
        bias: impl ToLanes<L, Real<L>>,
    ) -> Rgba<L> {
        self.by_gradient(sampler, uv.value(), gradient2(uv), bias.to_lanes(uv.value().lanes()))
    }

    /// [`sample`](Self::sample) with the derivatives of `uv` given: by how much it grows from a pixel to the next one, right and down. WGSL's `textureSampleGrad`.
    #[inline(always)]
    pub fn sample_grad<L: Lanes>(&self, sampler: &Sampler, uv: Vec2<L>, dx: Vec2<L>, dy: Vec2<L>) -> Rgba<L> {
        self.by_gradient(sampler, uv, gradient2_of(dx, dy), Real::new(uv.lanes(), 0.0))
    }

    /// The colour at `uv` at a level of detail, to which [`lod_bias`](Sampler::lod_bias) is added: 0 is the largest level. Wants no derivatives, so closures and vertex stages can do it,
    /// too. WGSL's `textureSampleLevel`.
    #[inline(always)]
    pub fn sample_level<L: Lanes>(&self, sampler: &Sampler, uv: Vec2<L>, level: impl ToLanes<L, Real<L>>) -> Rgba<L> {
        let lanes = uv.lanes();
        let lod = level.to_lanes(lanes);
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                let place = place2(uv, Int::new(lanes, 0));
                color::<L, F>(lookup.at_lod::<L, Flat, AsIs>(place, sampler.in_range(lod), AsIs))
            },
        )
    }

    /// How much of what is around `uv` passes [`Sampler::compare`] with `reference`, 0 to 1: each texel of level 0 is compared first (its first channel), then the answers are filtered.
    /// This is how shadow maps are read: `reference` is the distance to the light. WGSL's `textureSampleCompareLevel`.
    #[inline(always)]
    pub fn sample_compare<L: Lanes>(
        &self,
        sampler: &Sampler,
        uv: Vec2<L>,
        reference: impl ToLanes<L, Real<L>>,
    ) -> Real<L> {
        let lanes = uv.lanes();
        let reference = reference.to_lanes(lanes);
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                let place = place2(uv, Int::new(lanes, 0));
                let lod = sampler.in_range(Real::new(lanes, 0.0));
                let mapping = Compared { compare: sampler.compare, reference };
                lookup.at_lod::<L, Flat, Compared<L>>(place, lod, mapping)[0]
            },
        )
    }

    #[inline(always)]
    fn by_gradient<L: Lanes>(&self, sampler: &Sampler, uv: Vec2<L>, gradient: Gradient<L>, bias: Real<L>) -> Rgba<L> {
        let lanes = uv.lanes();
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                let place = place2(uv, Int::new(lanes, 0));
                color::<L, F>(lookup.at_gradient::<L, Flat, AsIs, 2>(place, &gradient, bias, AsIs))
            },
        )
    }
}

impl<F: TextureFormat> Texture2dArray<'_, F> {
    /// Width and height of a level in texels; of a level that there is not, those that it would have.
    pub fn size(&self, level: u32) -> [u32; 2] {
        let extent = self.image.extent.level(level);
        [extent.width, extent.height]
    }

    /// The number of layers.
    pub fn layers(&self) -> u32 {
        self.image.extent.slices
    }

    /// A texel of a layer; see [`Texture2d::fetch`]. Layers that there are not are 0, too.
    #[inline(always)]
    pub fn fetch<L: Lanes>(
        &self,
        x: Int<L>,
        y: Int<L>,
        layer: impl ToLanes<L, Int<L>>,
        level: impl ToLanes<L, Int<L>>,
    ) -> F::Color<L> {
        let lanes = x.lanes();
        lookup::fetch(&self.image, [x, y, layer.to_lanes(lanes)], level.to_lanes(lanes))
    }

    /// The layer, or the nearest that there is.
    #[inline(always)]
    fn layer<L: Lanes>(&self, lanes: L, layer: impl ToLanes<L, Int<L>>) -> Int<L> {
        let (layer, last) = (layer.to_lanes(lanes), self.layers() as i32 - 1);
        let layer = layer.lt(0).select(Int::new(lanes, 0), layer);
        layer.gt(last).select(Int::new(lanes, last), layer)
    }
}

impl<F: Filterable> Texture2dArray<'_, F> {
    /// As [`Texture2d::sample`], in a layer; a layer that there is not is the nearest that there is.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, sampler: &Sampler, uv: Vec2<Dual<L>>, layer: impl ToLanes<L, Int<L>>) -> Rgba<L> {
        self.sample_grad(sampler, uv.value(), layer, uv.dx(), uv.dy())
    }

    /// As [`Texture2d::sample_grad`], in a layer.
    #[inline(always)]
    pub fn sample_grad<L: Lanes>(
        &self,
        sampler: &Sampler,
        uv: Vec2<L>,
        layer: impl ToLanes<L, Int<L>>,
        dx: Vec2<L>,
        dy: Vec2<L>,
    ) -> Rgba<L> {
        let lanes = uv.lanes();
        let place = place2(uv, self.layer(lanes, layer));
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                let (gradient, bias) = (gradient2_of(dx, dy), Real::new(lanes, 0.0));
                color::<L, F>(lookup.at_gradient::<L, Flat, AsIs, 2>(place, &gradient, bias, AsIs))
            },
        )
    }

    /// As [`Texture2d::sample_level`], in a layer.
    #[inline(always)]
    pub fn sample_level<L: Lanes>(
        &self,
        sampler: &Sampler,
        uv: Vec2<L>,
        layer: impl ToLanes<L, Int<L>>,
        level: impl ToLanes<L, Real<L>>,
    ) -> Rgba<L> {
        let lanes = uv.lanes();
        let (place, lod) = (place2(uv, self.layer(lanes, layer)), level.to_lanes(lanes));
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                color::<L, F>(lookup.at_lod::<L, Flat, AsIs>(place, sampler.in_range(lod), AsIs))
            },
        )
    }

    /// As [`Texture2d::sample_compare`], in a layer: for cascades of shadow maps.
    #[inline(always)]
    pub fn sample_compare<L: Lanes>(
        &self,
        sampler: &Sampler,
        uv: Vec2<L>,
        layer: impl ToLanes<L, Int<L>>,
        reference: impl ToLanes<L, Real<L>>,
    ) -> Real<L> {
        let lanes = uv.lanes();
        let (place, reference) = (place2(uv, self.layer(lanes, layer)), reference.to_lanes(lanes));
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                let lod = sampler.in_range(Real::new(lanes, 0.0));
                let mapping = Compared { compare: sampler.compare, reference };
                lookup.at_lod::<L, Flat, Compared<L>>(place, lod, mapping)[0]
            },
        )
    }
}

impl<F: TextureFormat> TextureCube<'_, F> {
    /// Width and height of a face's level in texels; of a level that there is not, those that it would have.
    pub fn size(&self, level: u32) -> u32 {
        self.image.extent.level(level).width
    }

    /// A texel of a face, 0 to 5; see [`Texture2d::fetch`].
    #[inline(always)]
    pub fn fetch<L: Lanes>(
        &self,
        x: Int<L>,
        y: Int<L>,
        face: impl ToLanes<L, Int<L>>,
        level: impl ToLanes<L, Int<L>>,
    ) -> F::Color<L> {
        let lanes = x.lanes();
        lookup::fetch(&self.image, [x, y, face.to_lanes(lanes)], level.to_lanes(lanes))
    }
}

impl<F: Filterable> TextureCube<'_, F> {
    /// The colour in a direction of any length, from the cube's middle; otherwise as [`Texture2d::sample`].
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, sampler: &Sampler, direction: Vec3<Dual<L>>) -> Rgba<L> {
        let lanes = direction.value().lanes();
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                // The quotients that project onto the face know their derivatives as well.
                let (face, uv) = cube::face(direction);
                let (place, bias) = (place2(uv.value(), Int(face.0)), Real::new(lanes, 0.0));
                color::<L, F>(lookup.at_gradient::<L, Cube, AsIs, 2>(place, &gradient2(uv), bias, AsIs))
            },
        )
    }

    /// [`sample`](Self::sample) with the derivatives of the direction given.
    #[inline(always)]
    pub fn sample_grad<L: Lanes>(&self, sampler: &Sampler, direction: Vec3<L>, dx: Vec3<L>, dy: Vec3<L>) -> Rgba<L> {
        self.sample(sampler, direction.with_derivatives(dx, dy))
    }

    /// The colour in a direction at a level of detail; see [`Texture2d::sample_level`].
    #[inline(always)]
    pub fn sample_level<L: Lanes>(
        &self,
        sampler: &Sampler,
        direction: Vec3<L>,
        level: impl ToLanes<L, Real<L>>,
    ) -> Rgba<L> {
        let lanes = direction.lanes();
        let lod = level.to_lanes(lanes);
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                let (face, uv) = cube::face(direction);
                color::<L, F>(lookup.at_lod::<L, Cube, AsIs>(place2(uv, face), sampler.in_range(lod), AsIs))
            },
        )
    }

    /// As [`Texture2d::sample_compare`], in a direction: for lights that shine all around.
    #[inline(always)]
    pub fn sample_compare<L: Lanes>(
        &self,
        sampler: &Sampler,
        direction: Vec3<L>,
        reference: impl ToLanes<L, Real<L>>,
    ) -> Real<L> {
        let lanes = direction.lanes();
        let reference = reference.to_lanes(lanes);
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                let (face, uv) = cube::face(direction);
                let lod = sampler.in_range(Real::new(lanes, 0.0));
                let mapping = Compared { compare: sampler.compare, reference };
                lookup.at_lod::<L, Cube, Compared<L>>(place2(uv, face), lod, mapping)[0]
            },
        )
    }
}

impl<F: TextureFormat> Texture3d<'_, F> {
    /// Width, height and depth of a level in texels; of a level that there is not, those that it would have.
    pub fn size(&self, level: u32) -> [u32; 3] {
        let extent = self.image.extent.level(level);
        [extent.width, extent.height, extent.slices]
    }

    /// A texel; see [`Texture2d::fetch`].
    #[inline(always)]
    pub fn fetch<L: Lanes>(&self, x: Int<L>, y: Int<L>, z: Int<L>, level: impl ToLanes<L, Int<L>>) -> F::Color<L> {
        lookup::fetch(&self.image, [x, y, z], level.to_lanes(x.lanes()))
    }
}

impl<F: Filterable> Texture3d<'_, F> {
    /// The colour at `uvw`; otherwise as [`Texture2d::sample`].
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, sampler: &Sampler, uvw: Vec3<Dual<L>>) -> Rgba<L> {
        self.sample_grad(sampler, uvw.value(), uvw.dx(), uvw.dy())
    }

    /// As [`Texture2d::sample_grad`].
    #[inline(always)]
    pub fn sample_grad<L: Lanes>(&self, sampler: &Sampler, uvw: Vec3<L>, dx: Vec3<L>, dy: Vec3<L>) -> Rgba<L> {
        let lanes = uvw.lanes();
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                let (gradient, bias) = (gradient3_of(dx, dy), Real::new(lanes, 0.0));
                color::<L, F>(lookup.at_gradient::<L, Volume, AsIs, 3>(place3(uvw), &gradient, bias, AsIs))
            },
        )
    }

    /// As [`Texture2d::sample_level`].
    #[inline(always)]
    pub fn sample_level<L: Lanes>(&self, sampler: &Sampler, uvw: Vec3<L>, level: impl ToLanes<L, Real<L>>) -> Rgba<L> {
        let lanes = uvw.lanes();
        let lod = level.to_lanes(lanes);
        lanes.apart(
            #[inline(always)]
            || {
                let lookup = Lookup { image: &self.image, sampler };
                color::<L, F>(lookup.at_lod::<L, Volume, AsIs>(place3(uvw), sampler.in_range(lod), AsIs))
            },
        )
    }
}
