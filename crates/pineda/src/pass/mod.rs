//! Passes: what is to be drawn, recorded first and executed afterwards.

mod blend;
pub(crate) mod draw_call;
pub(crate) mod plan;
mod render;
mod state;
mod statistics;
mod stencil;
mod validate;

pub use blend::{Blend, BlendComponent, BlendFactor, BlendOperation, ColorMask};
pub use render::Renderer;
pub use state::{Compare, Cull, DepthBias, DepthState, DrawState, FrontFace, Scissor, Space, Viewport};
pub use statistics::{DrawStatistics, Statistics};
pub use stencil::{StencilFace, StencilOperation, StencilState};

use crate::lanes::Scalar;
use crate::math::{Rgba, Vec4};
use crate::shading::{Closure, ClosureFragment, Native, Shader, Varyings};
use draw_call::{ClosureDraw, DrawCall, ShaderDraw};
use std::fmt;

/// Draws with their shaders, in order, and what the target is cleared to. [`Renderer::render`] executes it.
///
/// A pass is recorded first and executed as a whole, so that each pixel of opaque surfaces is shaded once however many lie on top of each
/// other, across all draws. The result is the same as if they had been drawn one after the other.
pub struct Pass<'a> {
    /// The colour that the target starts with, in linear light; `None` keeps what it holds.
    pub clear_color: Option<[f32; 4]>,
    /// The depth that the target starts with, clamped to 0 to 1; `None` keeps what it holds (a target without a depth buffer holds 1).
    pub clear_depth: Option<f32>,
    /// The stencil value that the target starts with; `None` keeps what it holds (a target without a stencil buffer holds 0).
    pub clear_stencil: Option<u8>,
    pub(crate) draws: Vec<Box<dyn DrawCall + 'a>>,
}

impl Default for Pass<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Debug for Pass<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pass")
            .field("clear_color", &self.clear_color)
            .field("clear_depth", &self.clear_depth)
            .field("clear_stencil", &self.clear_stencil)
            .field("draws", &self.draws.len())
            .finish()
    }
}

impl<'a> Pass<'a> {
    /// A pass without draws that clears to transparent black, depth 1 and stencil 0.
    #[must_use]
    pub fn new() -> Self {
        Self { clear_color: Some([0.0; 4]), clear_depth: Some(1.0), clear_stencil: Some(0), draws: Vec::new() }
    }

    /// Adds a draw. Draws are numbered from 0.
    pub fn draw<Sh: Shader>(&mut self, shader: &'a Sh, mesh: Mesh<'a, Sh::Vertex>, state: DrawState) -> &mut Self {
        self.draws.push(Box::new(ShaderDraw { shader, mesh, state }));
        self
    }

    /// Adds a draw with closures instead of a shader: the short way.
    ///
    /// The first maps a vertex to its position and what is to be interpolated, the second maps sixteen fragments to their colours, at the
    /// SIMD level that every machine of this kind has.
    ///
    /// ```
    /// use pineda::*;
    /// let corners = [([4.0, 4.0], [1.0, 0.0, 0.0]), ([60.0, 4.0], [0.0, 1.0, 0.0]), ([32.0, 60.0], [0.0, 0.0, 1.0])];
    /// let mut pass = Pass::new();
    /// pass.draw_with(
    ///     Mesh { vertices: &corners, indices: Indices::Sequential },
    ///     DrawState { space: Space::Raster, ..DrawState::default() },
    ///     |&([x, y], color)| (Vec4::from([x, y, 0.0, 1.0]), Vec3::from(color)),
    ///     |f| Rgba::opaque(f.varyings()),
    /// );
    /// let mut pixels = vec![[0; 4]; 64 * 64];
    /// let mut target = Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(64, 64) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(pixels[0], [0, 0, 0, 0]);
    /// assert_eq!(pixels[20 * 64 + 32][3], 255);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn draw_with<In, T, V, F>(&mut self, mesh: Mesh<'a, In>, state: DrawState, vertex: V, fragment: F) -> &mut Self
    where
        In: Sync,
        T: Varyings<Scalar> + 'a,
        V: Fn(&In) -> (Vec4, T) + Sync + 'a,
        F: Fn(&mut ClosureFragment<T::At<Native>>) -> Rgba<Native> + Sync + 'a,
    {
        let fragment = Closure::new(fragment);
        self.draws.push(Box::new(ClosureDraw::<In, T, V, F> { vertex, fragment, mesh, state }));
        self
    }
}

/// Vertices, and the triangles that they make.
#[derive(Debug)]
pub struct Mesh<'a, V> {
    /// Anything that the vertex stage takes.
    pub vertices: &'a [V],
    /// Which vertices make triangles.
    pub indices: Indices<'a>,
}

impl<V> Clone for Mesh<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for Mesh<'_, V> {}

/// Which vertices make triangles: three each.
#[derive(Clone, Copy, Debug, Default)]
pub enum Indices<'a> {
    /// Vertices 0, 1, 2, then 3, 4, 5, and so on.
    #[default]
    Sequential,
    /// The vertices that these name, three by three. Triangles as `[u32; 3]` are given with `as_flattened()`.
    U32(&'a [u32]),
}
