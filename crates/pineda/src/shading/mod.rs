//! Shaders.

mod fragment;
mod shader;
mod stage;
mod varyings;

mod blend;
pub(crate) mod interpolate;
pub(crate) mod run;
pub(crate) mod shade;
pub(crate) mod weights;

pub(crate) use fragment::FragParts;
pub use fragment::{Frag, Fragment, FragmentKind};
pub use shader::Shader;
pub(crate) use stage::{Closure, FragmentStage, native};
pub use stage::{ClosureFragment, ClosureKind, Native};
#[doc(hidden)]
pub use varyings::Layout as __Layout;
pub use varyings::{Interpolation, MAX_VARYINGS, Varyings};

/// Where `#[shader]` puts a closure that is bound with `let`: only an argument of a call may carry an attribute.
#[doc(hidden)]
#[inline(always)]
pub fn __inlined<F>(closure: F) -> F {
    closure
}
