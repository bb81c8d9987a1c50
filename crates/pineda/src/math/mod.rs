//! Numbers, vectors, colours and matrices at any width: what shaders are written with.
//!
//! [`Real<L>`] is a number per lane, [`Bool<L>`] a yes or no per lane, [`Vec2<L>`], [`Vec3<L>`], [`Vec4<L>`] and
//! [`Rgba<L>`] are made of them. Without a parameter they have one lane: `Vec3` is `Vec3<Scalar>`.
//!
//! Constants and uniforms stay plain `f32` and `[f32; N]`: every operator and every function takes them beside the lane
//! types, on either side, and spreads them over the lanes.
//!
//! Everything here gives the same bits at every SIMD level and on every platform. Where a function is not one of IEEE
//! 754's correctly rounded operations, its accuracy is stated in ULP (units in the last place of the result) and tested.

mod boolean;
mod color;
mod derivative;
mod exponential;
mod integer;
mod integer_color;
mod matrix;
mod operand;
mod real;
mod trigonometry;
mod vector;

#[cfg(test)]
mod accuracy;
#[cfg(test)]
mod conformance;
#[cfg(test)]
mod edges;

pub use boolean::{Bool, Select};
pub use color::Rgba;
pub use integer::{Int, Uint};
pub use integer_color::{RgbaI, RgbaU};
pub use matrix::Mat4;
pub use operand::{Splat, ToLanes};
pub use real::Real;
pub use vector::{Vec2, Vec3, Vec4};
