//! An exact, deterministic, fast CPU triangle rasterizer: vertices in, pixels out, no GPU, no driver, no display.
//!
//! Named after Juan Pineda, on whose edge functions (1988) it is built. Three promises, each of them tested:
//!
//! - **Exact.** Coverage is decided in integers, with the top-left rule: no pixel of a mesh is missed or hit twice. Neither the rotation nor
//!   the winding of a triangle's vertices changes a bit.
//! - **The same bytes everywhere**: on any CPU, at any SIMD level, with any number of threads and any tile size.
//! - **Fast**: a tile of the picture at a time, sixteen lanes at a time, each visible pixel shaded once.
//!
//! # A first picture
//!
//! A *shader* says where a vertex is and what colour a fragment has; a *pass* holds draws of meshes with shaders; a *target* is a set of
//! buffers of yours; a *renderer* draws a pass to a target.
//!
//! ```
//! use pineda::*;
//!
//! // What the vertex stage hands to the fragment stage.
//! varyings! { struct Gouraud { color: Vec3 } }
//!
//! // A shader's fields are its uniforms.
//! struct Spin { camera: Mat4 }
//!
//! #[shader]
//! impl Shader for Spin {
//!     type Vertex = ([f32; 3], [f32; 3]);
//!     type Varyings<L: Lanes> = Gouraud<L>;
//!
//!     fn vertex(&self, (position, color): &Self::Vertex) -> (Vec4, Gouraud) {
//!         (self.camera * Vec3::from(*position).extend(1.0), Gouraud { color: (*color).into() })
//!     }
//!
//!     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
//!         Rgba::opaque(f.color)
//!     }
//! }
//!
//! let vertices = [
//!     ([-0.8, -0.6, 0.0], [1.0, 0.0, 0.0]),
//!     ([0.8, -0.6, 0.0], [0.0, 1.0, 0.0]),
//!     ([0.0, 0.8, 0.0], [0.0, 0.0, 1.0]),
//! ];
//! let shader = Spin { camera: Mat4::rotation_z(0.2) };
//! let mut pass = Pass::new();
//! pass.draw(&shader, Mesh { vertices: &vertices, indices: Indices::Sequential }, DrawState::default());
//!
//! let (width, height) = (320, 240);
//! let mut pixels = vec![[0; 4]; 320 * 240];
//! let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(width, height) };
//! let mut renderer = Renderer::new(Settings::default())?;
//! renderer.render(&pass, &mut target)?;
//! # assert!(pixels.iter().any(|p| p[3] == 255));
//! # Ok::<(), Error>(())
//! ```
//!
//! The short way, with two closures, is [`Pass::draw_with`]. How shaders are written is told in [`shading`].
//!
//! # Spaces
//!
//! Positions are in clip space (x right, y up, visible where `-w <= x, y <= w` and `0 <= z <= w`), of which normalised device coordinates are the case
//! w = 1, or in raster space: see [`Space`]. [`Mat4`] has the usual cameras.
//!
//! Vertices are snapped to 1/256 pixel. Triangles are clipped by the near and the far plane, and by a guard band of 32,768 pixels to each side of
//! the target's corner: as wide as 32-bit edge functions in a tile allow. Inside it, coverage is exactly that of the snapped triangle; nothing is clipped at
//! the picture's border.
//!
//! # What goes in
//!
//! Lists of triangles, strips and fans, lines and points ([`PrimitiveTopology`]), with or without [`Indices`], with [restarts](DrawState::primitive_restart), and meshes
//! in many [instances](Pass::draw_instanced). The same triangles are the same bits, whichever way they are given.
//!
//! Lines are one pixel wide by the diamond exit rule, [wide](DrawState::line_width) or [smooth](DrawState::smooth_lines), points of
//! [any size](DrawState::point_size); triangles are drawn as their [edges or corners](PolygonMode), if one likes, and cover by their pixels' centres or
//! [conservatively](Conservative).
//!
//! # What comes out
//!
//! With [several samples a pixel](Target::samples), all of it is each sample's own, and pictures are their averages.
//!
//! Colour (8 bits linear or sRGB, 16 bits, half floats, f32, integers; up to eight [things at once](Outputs)), depth, and, for those who shade elsewhere, the visibility buffer: triangle, instance and draw ids, barycentric coordinates,
//! and how often each pixel was covered. See [`Target`].
//!
//! Examples with their pictures are in the repository's `docs/examples.md`.
//!
//! # What shaders compute with
//!
//! Numbers in lanes ([`Real`], [`Int`], [`Uint`]), vectors ([`Vec3`]), matrices ([`Mat3`]), with the functions of shading languages: powers, angles, sRGB, [`noise`]. Their bits are the same
//! everywhere, too; most of the functions are right to 0.51 units of the last place, none is off by more than 1.5.
//!
//! # What cannot happen
//!
//! No mesh, number or setting makes it panic; what is wrong is an [`Error`] before anything is drawn. A triangle, line or point with a NaN or infinite position is dropped
//! and [counted](Statistics::non_finite). Working memory is bounded whatever the number of triangles ([`Settings::memory`]). What a *shader* does is up to the
//! shader: if it panics, so does the renderer.

extern crate self as pineda;

mod camera;
mod depth_pyramid;
mod error;
mod geometry;
mod lanes;
mod math;
mod parallel;
mod pass;
mod raster;
mod settings;
pub mod shading;
mod target;
pub mod texture;
mod tile;
mod transpose;
mod wide;

pub use depth_pyramid::DepthPyramid;
pub use error::Error;
pub use pass::{
    Blend, BlendComponent, BlendFactor, BlendOperation, ClearColor, ColorMask, ColorOps, ColorState, Compare,
    Conservative, Cull, DepthBias, DepthState, DrawState, DrawStatistics, FrontFace, Indices, Instanced, Load,
    MAX_LINE_WIDTH, MAX_POINT_SIZE, Mesh, Pass, PolygonMode, PrimitiveTopology, ProvokingVertex, Renderer, Sampling,
    Scissor, Space, Statistics, StencilFace, StencilOperation, StencilState, Store, Viewport,
};
pub use raster::samples::Samples;
pub use settings::{Settings, Simd, TileSize, UnknownSimd};
pub use target::{ColorBuffer, DepthBuffer, MAX_COLORS, MAX_SIZE, NO_ID, Target, f16_to_f32, f32_to_f16};
pub use texture::{
    Filter, Filterable, MAX_TEXTURE_LAYERS, MAX_TEXTURE_SIZE, MAX_TEXTURE_SIZE_3D, MipFilter, R8, R8Srgb, R16, R16F,
    R32F, R32I, R32U, Rg8, Rg8Srgb, Rg16, Rg16F, Rg32F, Rg32I, Rg32U, Rgba8, Rgba8Srgb, Rgba16, Rgba16F, Rgba32F,
    Rgba32I, Rgba32U, Sampler, Texture2d, Texture2dArray, Texture3d, TextureCube, TextureFormat, Wrap,
};

pub use lanes::{Dual, DualF, Lanes, Packet, Scalar};
pub use math::noise;
pub use math::{Bool, Int, Mat2, Mat3, Mat4, Real, Rgba, RgbaI, RgbaU, Select, Splat, ToLanes, Uint, Vec2, Vec3, Vec4};
pub use pineda_macros::{Varyings, shader};
#[doc(hidden)]
pub use shading::{__Layout, __Row4, __inlined};
pub use shading::{
    ClosureFragment, ClosureKind, DualSource, Frag, Fragment, FragmentKind, Interpolation, MAX_CLIP_DISTANCES,
    MAX_VARYINGS, Native, Output, OutputKind, Outputs, Shader, Varyings,
};
