//! Numbers, vectors, colours and matrices at any width: what shaders are written with.
//!
//! [`Real<L>`] is a number per lane, [`Bool<L>`] a yes or no per lane, [`Vec2<L>`], [`Vec3<L>`], [`Vec4<L>`] and
//! [`Rgba<L>`] are made of them. Without a parameter they have one lane: `Vec3` is `Vec3<Scalar>`.
//!
//! Constants and uniforms stay plain `f32` and `[f32; N]`: every operator and every function takes them beside the lane
//! types, on either side, and spreads them over the lanes.
//!
//! Everything here gives the same bits at every SIMD level and on every platform. Where a function is not one of IEEE
//! 754's correctly rounded operations, its accuracy is stated in ULP (units in the last place of the result), and measured for every
//! float by `cargo xtask ulp`: docs/math.md has the table.
//!
//! | what | where |
//! | --- | --- |
//! | `abs`, `floor`, `clamp`, `mix`, `smoothstep`, `powi`, ... | `real.rs` |
//! | `exp`, `exp2`, `log`, `inverse_sqrt` | `exponential.rs` |
//! | `log2`, `powf`, `cbrt` | `power.rs` |
//! | `sin`, `cos`, `tan`; beyond 2^18 | `trigonometry.rs`; `huge_angle.rs` |
//! | `asin`, `acos`, `atan`, `atan2` | `inverse_trigonometry.rs` |
//! | sRGB, luminance | `srgb.rs` |
//! | vectors: `dot`, `normalize`, `refract`, ... | `vector.rs` |
//! | the functions of numbers, component by component; components in other orders | `componentwise.rs` |
//! | matrices of plain numbers; in lanes | `matrix.rs`; `small_matrix.rs` |
//! | `f64` in lanes, for what is between a function's argument and its result | `double.rs` |
//! | hashes; gradient noise and its sums | `hash.rs`; `gradient_noise.rs` |

mod boolean;
mod color;
mod componentwise;
mod derivative;
mod double;
mod exponential;
mod gradient_noise;
mod hash;
mod huge_angle;
mod integer;
mod integer_color;
mod inverse_trigonometry;
mod matrix;
pub mod noise;
mod operand;
mod power;
mod real;
mod small_matrix;
mod srgb;
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
pub use small_matrix::{Mat2, Mat3};
pub use vector::{Vec2, Vec3, Vec4};
