//! Placeholder.

extern crate self as pineda;

mod lanes;
mod math;
pub mod shading;

pub use lanes::{Lanes, Packet, Scalar};
pub use math::{Bool, Mat4, Real, Rgba, Select, Splat, ToLanes, Vec2, Vec3, Vec4};
pub use pineda_macros::{Varyings, shader};
#[doc(hidden)]
pub use shading::{__Layout, __inlined};
pub use shading::{
    ClosureFragment, ClosureKind, Frag, Fragment, FragmentKind, Interpolation, MAX_VARYINGS, Native, Shader, Varyings,
};
