//! How shaders are written.
//!
//! A shader is a type with a vertex stage and a fragment stage. Its fields are the uniforms. The vertex stage maps one
//! vertex to a position and to what is to be interpolated, the varyings; the fragment stage maps the interpolated values
//! to a colour. Gouraud shading, colours at the corners and nothing else, as a whole program:
//!
//! ```
//! use pineda::*;
//!
//! pub struct Vertex { position: [f32; 3], color: [f32; 3] }
//!
//! varyings! { pub struct Colored { color: Vec3 } }
//!
//! pub struct Gouraud { pub camera: Mat4 }
//!
//! #[shader]
//! impl Shader for Gouraud {
//!     type Vertex = Vertex;
//!     type Varyings<L: Lanes> = Colored<L>;
//!
//!     fn vertex(&self, v: &Vertex) -> (Vec4, Colored) {
//!         (self.camera * Vec3::from(v.position).extend(1.0), Colored { color: v.color.into() })
//!     }
//!
//!     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
//!         Rgba::opaque(f.color)
//!     }
//! }
//!
//! let triangle = [
//!     Vertex { position: [-1.0, -1.0, 0.0], color: [1.0, 0.0, 0.0] },
//!     Vertex { position: [1.0, -1.0, 0.0], color: [0.0, 1.0, 0.0] },
//!     Vertex { position: [0.0, 1.0, 0.0], color: [0.0, 0.0, 1.0] },
//! ];
//! let view = Mat4::look_at([0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
//! let shader = Gouraud { camera: Mat4::perspective(0.8, 1.0, 0.1, 10.0) * view };
//!
//! let mut pixels = vec![[0; 4]; 64 * 64];
//! let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(64, 64) };
//! let mut pass = Pass::new();
//! pass.draw(&shader, Mesh { vertices: &triangle, indices: Indices::Sequential }, DrawState::default());
//! Renderer::new(Settings::default())?.render(&pass, &mut target)?;
//! assert_eq!(pixels[32 * 64 + 32][3], 255, "the centre is covered");
//! # Ok::<(), Error>(())
//! ```
//!
//! With a light it is Lambert's law, and still fifteen lines:
//!
//! ```
//! # use pineda::*;
//! # pub struct Vertex { position: [f32; 3], normal: [f32; 3] }
//! varyings! { pub struct Lit { normal: Vec3 } }
//!
//! pub struct Lambert { pub camera: Mat4, pub light: [f32; 3], pub albedo: [f32; 3] }
//!
//! #[shader]
//! impl Shader for Lambert {
//!     type Vertex = Vertex;
//!     type Varyings<L: Lanes> = Lit<L>;
//!
//!     fn vertex(&self, v: &Vertex) -> (Vec4, Lit) {
//!         (self.camera * Vec3::from(v.position).extend(1.0), Lit { normal: v.normal.into() })
//!     }
//!
//!     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
//!         let light = f.normal.normalize().dot(self.light).max(0.0);
//!         Rgba::opaque(self.albedo * (0.1 + 0.9 * light))
//!     }
//! }
//! ```
//!
//! # One source, sixteen fragments
//!
//! The fragment stage is generic over its width `L`: it shades one fragment at a time or a packet of sixteen, from one
//! source and with the same bits. Its numbers are [`Real<L>`](crate::Real), its vectors [`Vec2<L>`](crate::Vec2),
//! [`Vec3<L>`](crate::Vec3) and [`Vec4<L>`](crate::Vec4). Constants and uniforms stay `f32` and `[f32; 3]`: they go with
//! those on either side of `+ - * /` and as arguments of every method. Without the parameter, as in the vertex stage, the
//! types have one lane.
//!
//! Sixteen fragments cannot take different branches. Instead of `if`, compute both values and choose:
//!
//! ```
//! # use pineda::*;
//! #[shader]
//! fn toon<L: Lanes>(light: Real<L>) -> Real<L> {
//!     light.lt(0.3).select(0.2, light.lt(0.7).select(0.6, 1.0))
//! }
//! # assert_eq!(toon(Real::from(0.5)), 0.6.into());
//! ```
//!
//! `if light > 0.5 { ... }` does not compile: there is no one answer. Branches and loops over uniforms are ordinary Rust:
//! `for light in &self.lights { sum += ... }`, starting from `f.splat([0.0; 3])`.
//!
//! # What a fragment stage may ask for
//!
//! [`f.x()`](Frag::x), [`f.y()`](Frag::y), [`f.z()`](Frag::z): where it is; [`f.front_facing()`](Frag::front_facing).
//! [`f.dx()`](Frag::dx) and [`f.dy()`](Frag::dy), the varyings' derivatives per pixel, want
//! `const DERIVATIVES: bool = true;` in the impl; [`f.discard(mask)`](Frag::discard) wants `const DISCARDS: bool = true;`;
//! [`f.set_depth(z)`](Frag::set_depth) `const WRITES_DEPTH: bool = true;`;
//! [`f.sample_index()`](Frag::sample_index), [`f.sample_mask()`](Frag::sample_mask) and [`f.set_sample_mask(mask)`](Frag::set_sample_mask) want `SAMPLE_INDEX`, `SAMPLE_MASK` and
//! `WRITES_SAMPLE_MASK`;
//! [`f.barycentrics()`](Frag::barycentrics) wants `const BARYCENTRICS: bool = true;`;
//! [`f.point_coord()`](Frag::point_coord), the place in a point's square, `const POINT_COORD: bool = true;`;
//! [`f.triangle_id()`](Frag::triangle_id), `f.instance_id()` and `f.draw_id()` `const IDS: bool = true;`.
//! They cost time where they are switched on, so none is unless asked for, and using one without its constant is an
//! error with that advice. A disc with a smooth edge:
//!
//! ```
//! # use pineda::*;
//! # pub struct Disc { pub color: [f32; 3] }
//! #[shader]
//! impl Shader for Disc {
//!     type Vertex = [f32; 2];
//!     type Varyings<L: Lanes> = Vec2<L>;
//!     const DERIVATIVES: bool = true;
//!     const DISCARDS: bool = true;
//!
//!     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, Vec2) {
//!         ([x, y, 0.0, 1.0].into(), [x, y].into())
//!     }
//!
//!     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
//!         let pixel = f.dx().length().max(f.dy().length());
//!         let coverage = ((1.0 - f.length()) / pixel + 0.5).clamp(0.0, 1.0);
//!         f.discard(coverage.le(0.0));
//!         Rgba::new(f.splat(self.color), coverage)
//!     }
//! }
//! ```
//!
//! # Textures, and derivatives of anything
//!
//! Textures and their samplers are fields like any other uniform: `self.albedo.sample(&self.sampler, f.dual().uv)`; see [`texture`](crate::texture). [`f.dual()`](Frag::dual) is the
//! varyings as numbers that know their derivatives, and so does whatever is computed from them: see [`Dual`](crate::Dual).
//!
//! # Varyings
//!
//! [`varyings!`](crate::varyings) declares a struct; a single number or vector needs none
//! (`type Varyings<L: Lanes> = Vec2<L>`), and nothing at all is `()`. They are interpolated with perspective;
//! `#[flat]` above a field takes the [provoking vertex](crate::ProvokingVertex)'s value, `#[noperspective]` interpolates on the screen.
//! [`MAX_VARYINGS`] numbers are the limit.
//!
//! # More than one colour, and integers
//!
//! A target may have up to eight colour buffers, and a fragment stage returns a value for each: a tuple, an array, or a struct that
//! [`outputs!`](crate::outputs) declares. `-> (Rgba<L>, Vec3<L>, Uint<L>)` is a colour, a normal and a number; [`Outputs`] tells all of it. Closures
//! return the same.
//!
//! [`Uint<L>`](crate::Uint) and [`Int<L>`](crate::Int) are whole numbers: from a uniform (`f.splat(self.id)`), from a varying (they are flat of themselves),
//! or from a number (`f.x().to_uint()`). Buffers of integers take them bit by bit.
//!
//! # Closures, the short way
//!
//! [`Pass::draw_with`](crate::Pass::draw_with) takes two closures instead of a shader. They run at the level that all
//! machines of a kind have ([`Native`]), so on a new one a shader is two or three times as fast; the bits are the same.
//! They can neither discard nor have derivatives or point coordinates.
//!
//! # What makes a shader slow
//!
//! The picture is right in all these cases; only a profile shows them. The figures are nanoseconds a pixel of a physically
//! based shader that takes 19 when all is well, with AVX2.
//!
//! * **A helper function without `#[shader]`** (68). It is not inlined, and so compiled without the level's instructions.
//!   Put the attribute on every function, impl or module that a fragment stage calls into. On `impl Shader` it cannot be
//!   forgotten: without it the impl does not compile.
//! * **Closures and iterator chains in lane code** (150). `#[shader]` helps closures that are bound with `let` or passed to
//!   your own functions; `map`, `fold` and `array::map` of the standard library it cannot. Write loops.
//! * **Debug builds.** Without inlining nothing is left of the speed: `[profile.dev] opt-level = 1` gets most of it back.
//!
//! # What makes a picture differ between machines
//!
//! One thing only: **`sin`, `powf`, `exp` and their like on plain `f32`**, which are the standard library's and differ in
//! their last bits from platform to platform. `self.roughness.powf(2.2)` in a shader is one of them. Compute such things
//! with `libm`, once, when the shader is made; or write `f.splat(self.roughness).powf(2.2)`: the methods of
//! [`Real`](crate::Real) are the same everywhere. (`+ - * /`, `sqrt`, `abs`, `floor` and comparisons of plain `f32` are
//! safe; `min` and `max` are, but for the sign of a zero.)
//!
//! # Mistakes that the compiler catches
//!
//! The attribute is missing:
//!
//! ```compile_fail,E0046
//! # use pineda::*;
//! # struct Plain;
//! impl Shader for Plain {
//!     type Vertex = ();
//!     type Varyings<L: Lanes> = ();
//!     fn vertex(&self, _: &()) -> (Vec4, ()) { Default::default() }
//!     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> { Rgba::gray(f.z()) }
//! }
//! ```
//!
//! A plain number as a varying (write `Real`):
//!
//! ```compile_fail,E0277
//! # use pineda::*;
//! #[derive(Varyings)]
//! struct Fading<L: Lanes = Scalar> { normal: Vec3<L>, age: f32 }
//! ```
//!
//! A branch that depends on the fragment:
//!
//! ```compile_fail,E0308
//! # use pineda::*;
//! #[shader]
//! fn toon<L: Lanes>(light: Real<L>) -> Real<L> {
//!     if light.lt(0.5) { light * 0.5 } else { light }
//! }
//! ```
//!
//! A number of another kind:
//!
//! ```compile_fail,E0277
//! # use pineda::*;
//! #[shader]
//! fn brighter<L: Lanes>(light: Real<L>) -> Real<L> {
//!     light.max(1.0_f64)
//! }
//! ```

mod fragment;
mod outputs;
mod shader;
mod stage;
mod varyings;
pub(crate) mod visible_packets;

mod barycentric;
mod blend;
mod by_lane;
pub(crate) mod cached;
mod centroid;
pub(crate) mod coordinates;
pub(crate) mod distinct;
mod few;
mod in_full;
pub(crate) mod interpolate;
pub(crate) mod multisample;
mod over;
pub(crate) mod packet;
mod parts;
pub(crate) mod run;
pub(crate) mod sample_packets;
pub(crate) mod shade;
pub(crate) mod single;
pub(crate) mod stencil;
pub(crate) mod strokes;
pub(crate) mod weights;

pub(crate) use fragment::FragParts;
pub use fragment::{Frag, Fragment, FragmentKind};
pub(crate) use outputs::OutputLayout;
#[doc(hidden)]
pub use outputs::Row4 as __Row4;
pub use outputs::{DualSource, Output, OutputKind, Outputs};
pub use shader::Shader;
pub(crate) use stage::{Closure, FragmentStage, StageUses, native};
pub use stage::{ClosureFragment, ClosureKind, Native};
#[doc(hidden)]
pub use varyings::Layout as __Layout;
pub use varyings::{Interpolation, MAX_VARYINGS, Varyings};

/// The most [clip distances](Shader::clip_distances) of a vertex.
pub const MAX_CLIP_DISTANCES: usize = 8;

/// Where `#[shader]` puts a closure that is bound with `let`: only an argument of a call may carry an attribute.
#[doc(hidden)]
#[inline(always)]
pub fn __inlined<F>(closure: F) -> F {
    closure
}
