//! The trait that a shader implements.

use super::{Fragment, Outputs, Varyings};
use crate::lanes::{Lanes, Scalar};
use crate::math::Vec4;

/// A vertex stage and a fragment stage. The fields of the implementing type are its uniforms.
///
/// Write `#[shader]` above the `impl`; see the [guide](crate::shading) for how shaders are written.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a shader",
    note = "write `#[shader] impl Shader for {Self} {{ ... }}`, or draw with closures: `pass.draw_with(...)`"
)]
pub trait Shader: Sized + Sync {
    /// What a vertex buffer is made of: any type, `[f32; 3]` included. To be drawn in [instances](crate::Pass::draw_instanced), a shader takes
    /// [`Instanced`](crate::Instanced) vertices.
    type Vertex: Sync;

    /// What the vertex stage hands to the fragment stage; see [`varyings!`](crate::varyings).
    type Varyings<L: Lanes>: Varyings<L>;

    /// What the fragment stage returns: an [`Rgba<L>`](crate::Rgba), or whatever else goes to the target's colour buffers; see [`Outputs`]. `#[shader]` writes this
    /// line, from what the function `fragment` says that it returns.
    type Output<L: Lanes>: Outputs<L>;

    /// Whether the fragment stage reads [`f.dx()`](super::Frag::dx) or [`f.dy()`](super::Frag::dy). Derivatives are
    /// only computed on request, because they cost up to 30 % of a cheap shader's time.
    const DERIVATIVES: bool = false;

    /// Whether the fragment stage calls [`f.discard(..)`](super::Frag::discard). A shader that never does is run once per
    /// visible pixel, however many layers lie below; one that may discard is run for each layer in turn.
    const DISCARDS: bool = false;

    /// One vertex: its position in the draw's [`Space`](crate::Space), and its varyings. It must be a pure function of
    /// the vertex and the uniforms, for it may run more than once.
    fn vertex(&self, vertex: &Self::Vertex) -> (Vec4, Self::Varyings<Scalar>);

    /// The fragments of one packet: their colours. Some of the lanes may lie outside the triangle; their results are
    /// thrown away.
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Self::Output<L>;

    /// Written by `#[shader]`, which also makes the stages inline: so that forgetting the attribute is an error here
    /// rather than a picture drawn ten times slower.
    #[doc(hidden)]
    #[allow(non_upper_case_globals, reason = "the name is the error message")]
    const ADD_THE_ATTRIBUTE_shader_TO_THIS_IMPL: ();
}
