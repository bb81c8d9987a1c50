//! Placeholder.

extern crate self as pineda;

mod camera;
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
mod tile;
mod transpose;

pub use error::Error;
pub use pass::{
    Blend, Compare, Cull, DepthState, DrawState, FrontFace, Indices, Mesh, Pass, Renderer, Space, Statistics, Viewport,
};
pub use settings::{Settings, Simd, TileSize, UnknownSimd};
pub use target::{ColorBuffer, MAX_SIZE, NO_ID, Target};

pub use lanes::{Lanes, Packet, Scalar};
pub use math::{Bool, Mat4, Real, Rgba, Select, Splat, ToLanes, Vec2, Vec3, Vec4};
pub use pineda_macros::{Varyings, shader};
#[doc(hidden)]
pub use shading::{__Layout, __inlined};
pub use shading::{
    ClosureFragment, ClosureKind, Frag, Fragment, FragmentKind, Interpolation, MAX_VARYINGS, Native, Shader, Varyings,
};
