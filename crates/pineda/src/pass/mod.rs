//! Passes: what is to be drawn, recorded first and executed afterwards.

pub(crate) mod assembly;
mod blend;
mod colors;
mod conservative;
mod depth_state;
pub(crate) mod draw_call;
mod input;
pub(crate) mod kept;
mod memory;
mod multisample;
pub(crate) mod plan;
mod polygon_mode;
mod primitives;
mod render;
mod state;
mod statistics;
mod stencil;
pub(crate) mod strokes;
mod validate;
mod viewport;

pub use blend::{Blend, BlendComponent, BlendFactor, BlendOperation, ColorMask};
pub use colors::{ClearColor, ColorOps, ColorState, Load, Store};
pub use conservative::Conservative;
pub use depth_state::{Compare, DepthBias, DepthState};
pub use multisample::Sampling;
pub use polygon_mode::{MAX_LINE_WIDTH, MAX_POINT_SIZE, PolygonMode};
pub use primitives::{Indices, Instanced, PrimitiveTopology, ProvokingVertex};
pub use render::Renderer;
pub use state::{Cull, DrawState, FrontFace, Space};
pub use statistics::{DrawStatistics, Statistics};
pub use stencil::{StencilFace, StencilOperation, StencilState};
pub use viewport::{Scissor, Viewport};

use crate::lanes::Scalar;
use crate::math::Vec4;
use crate::shading::{Closure, ClosureFragment, Native, Outputs, Shader, Varyings};
use draw_call::{ClosureDraw, DrawCall, ShaderDraw};
use input::{Instances, Vertices};
use std::fmt;

/// Draws with their shaders, in order, and what the target is cleared to. [`Renderer::render`] executes it.
///
/// A pass is recorded first and executed as a whole, so that each pixel of opaque surfaces is shaded once however many lie on top of each
/// other, across all draws. The result is the same as if they had been drawn one after the other.
pub struct Pass<'a> {
    /// The colour that the target starts with, in linear light; `None` keeps what it holds.
    pub clear_color: Option<[f32; 4]>,
    /// What each of several colour buffers starts with in place of that, and whether it is stored: number 0 is for [`Target::color`](crate::Target::color), the
    /// others are for [`Target::more_colors`](crate::Target::more_colors).
    ///
    /// ```
    /// use pineda::{Load, NO_ID, Pass};
    /// let mut pass = Pass::new();
    /// pass.color_ops[2].load = Load::Clear([NO_ID; 4].into());
    /// ```
    // As `DrawState::colors`.
    pub color_ops: [ColorOps; 8],
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
            .field("color_ops", &self.color_ops)
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
        Self {
            clear_color: Some([0.0; 4]),
            color_ops: [ColorOps::default(); 8],
            clear_depth: Some(1.0),
            clear_stencil: Some(0),
            draws: Vec::new(),
        }
    }

    /// Adds a draw. Draws are numbered from 0.
    pub fn draw<Sh: Shader>(&mut self, shader: &'a Sh, mesh: Mesh<'a, Sh::Vertex>, state: DrawState) -> &mut Self {
        let input = Vertices(mesh.vertices);
        self.draws.push(Box::new(ShaderDraw { shader, input, indices: mesh.indices, state }));
        self
    }

    /// Adds a draw of a mesh once for each instance.
    ///
    /// The instances are anything that can be copied: places, matrices, colours, or `()` where the number alone is enough. The vertex stage gets
    /// each vertex together with its number and the instance's data and number, as an [`Instanced`]. The picture is that of as many draws, one after the other, at a small part of
    /// their cost: time goes with the number of vertices and triangles, and memory stays within [`Settings::memory`](crate::Settings::memory) as ever.
    ///
    /// ```
    /// use pineda::*;
    ///
    /// /// Where a square stands, and its colour.
    /// #[derive(Clone, Copy)]
    /// struct Place { offset: [f32; 2], color: [f32; 3] }
    ///
    /// struct Squares;
    ///
    /// #[shader]
    /// impl Shader for Squares {
    ///     type Vertex = Instanced<[f32; 2], Place>;
    ///     type Varyings<L: Lanes> = Vec3<L>;
    ///
    ///     fn vertex(&self, v: &Self::Vertex) -> (Vec4, Vec3) {
    ///         let ([x, y], [dx, dy]) = (v.vertex, v.instance.offset);
    ///         (Vec4::from([x + dx, y + dy, 0.0, 1.0]), v.instance.color.into())
    ///     }
    ///
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         Rgba::opaque(f.varyings())
    ///     }
    /// }
    ///
    /// let corners = [[0.0, 0.0], [0.0, 8.0], [8.0, 0.0], [8.0, 8.0]];
    /// let places = [
    ///     Place { offset: [4.0, 4.0], color: [1.0, 0.0, 0.0] },
    ///     Place { offset: [20.0, 4.0], color: [0.0, 1.0, 0.0] },
    /// ];
    /// let mesh = Mesh { vertices: &corners, indices: Indices::Sequential };
    /// let state =
    ///     DrawState { topology: PrimitiveTopology::TriangleStrip, space: Space::Raster, ..DrawState::default() };
    /// let mut pass = Pass::new();
    /// pass.draw_instanced(&Squares, mesh, &places, state);
    ///
    /// let (mut pixels, mut instances) = (vec![[0; 4]; 32 * 16], vec![0; 32 * 16]);
    /// let mut target = Target {
    ///     color: ColorBuffer::Rgba8(&mut pixels),
    ///     instance_ids: Some(&mut instances),
    ///     ..Target::new(32, 16)
    /// };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!((pixels[5 * 32 + 5], instances[5 * 32 + 5]), ([255, 0, 0, 255], 0));
    /// assert_eq!((pixels[5 * 32 + 21], instances[5 * 32 + 21]), ([0, 255, 0, 255], 1));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn draw_instanced<V, I, Sh>(
        &mut self,
        shader: &'a Sh,
        mesh: Mesh<'a, V>,
        instances: &'a [I],
        state: DrawState,
    ) -> &mut Self
    where
        V: Copy + Sync,
        I: Copy + Sync,
        Sh: Shader<Vertex = Instanced<V, I>>,
    {
        let input = Instances { vertices: mesh.vertices, instances };
        self.draws.push(Box::new(ShaderDraw { shader, input, indices: mesh.indices, state }));
        self
    }

    /// Adds a draw with closures instead of a shader: the short way.
    ///
    /// The first maps a vertex to its position and what is to be interpolated, the second maps sixteen fragments to their colours (or to [other things](Outputs)), at the
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
    pub fn draw_with<In, T, V, F, O>(
        &mut self,
        mesh: Mesh<'a, In>,
        state: DrawState,
        vertex: V,
        fragment: F,
    ) -> &mut Self
    where
        In: Sync,
        T: Varyings<Scalar> + 'a,
        V: Fn(&In) -> (Vec4, T) + Sync + 'a,
        F: Fn(&mut ClosureFragment<T::At<Native>>) -> O + Sync + 'a,
        O: Outputs<Native> + 'a,
    {
        let (input, fragment) = (Vertices(mesh.vertices), Closure::new(fragment));
        self.draws.push(Box::new(ClosureDraw::<_, T, V, F, O> {
            vertex,
            fragment,
            input,
            indices: mesh.indices,
            state,
        }));
        self
    }

    /// Adds a draw of a mesh once for each instance, with closures instead of a shader: the short way of [`draw_instanced`](Self::draw_instanced).
    ///
    /// ```
    /// use pineda::*;
    /// let triangle = [[0.0, 0.0], [7.0, 0.0], [0.0, 7.0]];
    /// let mut pass = Pass::new();
    /// pass.draw_instanced_with(
    ///     Mesh { vertices: &triangle, indices: Indices::Sequential },
    ///     &[(); 100],
    ///     DrawState { space: Space::Raster, ..DrawState::default() },
    ///     |v| {
    ///         let (row, column) = (v.instance_id / 10, v.instance_id % 10);
    ///         let [x, y] = v.vertex;
    ///         (Vec4::from([x + 8.0 * column as f32, y + 8.0 * row as f32, 0.0, 1.0]), ())
    ///     },
    ///     |f| Rgba::gray(f.splat(1.0)),
    /// );
    /// let mut hits = vec![0; 80 * 80];
    /// let mut target = Target { hits: Some(&mut hits), ..Target::new(80, 80) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(hits.iter().sum::<u32>(), 100 * 21);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn draw_instanced_with<In, I, T, V, F, O>(
        &mut self,
        mesh: Mesh<'a, In>,
        instances: &'a [I],
        state: DrawState,
        vertex: V,
        fragment: F,
    ) -> &mut Self
    where
        In: Copy + Sync,
        I: Copy + Sync,
        T: Varyings<Scalar> + 'a,
        V: Fn(&Instanced<In, I>) -> (Vec4, T) + Sync + 'a,
        F: Fn(&mut ClosureFragment<T::At<Native>>) -> O + Sync + 'a,
        O: Outputs<Native> + 'a,
    {
        let (input, fragment) = (Instances { vertices: mesh.vertices, instances }, Closure::new(fragment));
        self.draws.push(Box::new(ClosureDraw::<_, T, V, F, O> {
            vertex,
            fragment,
            input,
            indices: mesh.indices,
            state,
        }));
        self
    }
}

/// Vertices, and which of them are drawn: as a list of triangles, unless [`DrawState::topology`] says otherwise.
#[derive(Debug)]
pub struct Mesh<'a, V> {
    /// Anything that the vertex stage takes; `&[(); 3]`, if that needs no more than their [numbers](Instanced::vertex_id).
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
