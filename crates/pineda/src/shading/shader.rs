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

    /// Whether the fragment stage calls [`f.set_depth(..)`](super::Frag::set_depth). Depth is then tested after shading instead of before: such a shader is run
    /// for each layer in turn, as one that discards, and for what is hidden, too.
    const WRITES_DEPTH: bool = false;

    /// Whether the fragment stage reads [`f.sample_index()`](super::Frag::sample_index). Where pixels have several samples, such a shader is drawn
    /// [by sample](crate::Sampling::Sample).
    const SAMPLE_INDEX: bool = false;

    /// Whether the fragment stage reads [`f.sample_mask()`](super::Frag::sample_mask). It costs time where pixels have several samples: what is visible of a triangle says nothing of
    /// what it covers, so that is found again.
    const SAMPLE_MASK: bool = false;

    /// Whether the fragment stage calls [`f.set_sample_mask(..)`](super::Frag::set_sample_mask). It is then run for each layer in turn, as one that discards.
    const WRITES_SAMPLE_MASK: bool = false;

    /// Whether the fragment stage reads [`f.barycentrics()`](super::Frag::barycentrics) or [`f.barycentrics_noperspective()`](super::Frag::barycentrics_noperspective).
    const BARYCENTRICS: bool = false;

    /// How many [clip distances](Self::clip_distances) the vertex stage gives, at most [`MAX_CLIP_DISTANCES`](super::MAX_CLIP_DISTANCES).
    const CLIP_DISTANCES: usize = 0;

    /// Whether the fragment stage reads [`f.point_coord()`](super::Frag::point_coord). It takes two of the [`MAX_VARYINGS`](super::MAX_VARYINGS) numbers.
    const POINT_COORD: bool = false;

    /// Whether the fragment stage reads [`f.triangle_id()`](super::Frag::triangle_id), [`f.instance_id()`](super::Frag::instance_id) or
    /// [`f.draw_id()`](super::Frag::draw_id).
    const IDS: bool = false;

    /// The side of a vertex's square in pixels where [points](crate::PrimitiveTopology::PointList) are drawn; `None`, which it is unless a shader says otherwise, is the
    /// draw's [`point_size`](crate::DrawState::point_size). It is clamped to 0 to [`MAX_POINT_SIZE`](crate::MAX_POINT_SIZE); a point whose size is NaN is dropped, as one is
    /// whose position is not finite.
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Dots;
    ///
    /// #[shader]
    /// impl Shader for Dots {
    ///     /// x, y and the size.
    ///     type Vertex = [f32; 3];
    ///     type Varyings<L: Lanes> = ();
    ///     fn vertex(&self, &[x, y, _]: &[f32; 3]) -> (Vec4, ()) {
    ///         (Vec4::from([x, y, 0.0, 1.0]), ())
    ///     }
    ///     fn point_size(&self, &[.., size]: &[f32; 3]) -> Option<f32> {
    ///         Some(size)
    ///     }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         Rgba::gray(f.splat(1.0))
    ///     }
    /// }
    ///
    /// let dots = [[4.0, 8.0, 2.0], [10.0, 8.0, 6.0]];
    /// let state = DrawState { topology: PrimitiveTopology::PointList, space: Space::Raster, ..DrawState::default() };
    /// let mut pass = Pass::new();
    /// pass.draw(&Dots, Mesh { vertices: &dots, indices: Indices::Sequential }, state);
    /// let mut hits = vec![0; 16 * 16];
    /// let mut target = Target { hits: Some(&mut hits), ..Target::new(16, 16) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(hits.iter().sum::<u32>(), 2 * 2 + 6 * 6);
    /// # Ok::<(), Error>(())
    /// ```
    fn point_size(&self, _vertex: &Self::Vertex) -> Option<f32> {
        None
    }

    /// One vertex: its position in the draw's [`Space`](crate::Space), and its varyings. It must be a pure function of
    /// the vertex and the uniforms, for it may run more than once.
    fn vertex(&self, vertex: &Self::Vertex) -> (Vec4, Self::Varyings<Scalar>);

    /// How far a vertex lies inside of up to eight planes of the shader's own: what is at a negative distance from any of the first
    /// [`CLIP_DISTANCES`](Self::CLIP_DISTANCES) is cut off. Distances are linear over the triangle before the perspective division, as positions are.
    /// A triangle with a NaN or infinite one among them is dropped and counted, as with a position.
    ///
    /// ```
    /// use pineda::*;
    ///
    /// /// Draws what lies above a height.
    /// struct Above { height: f32 }
    ///
    /// #[shader]
    /// impl Shader for Above {
    ///     type Vertex = [f32; 2];
    ///     type Varyings<L: Lanes> = ();
    ///     const CLIP_DISTANCES: usize = 1;
    ///
    ///     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
    ///         (Vec4::from([x, y, 0.5, 1.0]), ())
    ///     }
    ///
    ///     fn clip_distances(&self, &[_, y]: &[f32; 2]) -> [f32; MAX_CLIP_DISTANCES] {
    ///         let mut distances = [0.0; MAX_CLIP_DISTANCES];
    ///         distances[0] = y - self.height;
    ///         distances
    ///     }
    ///
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         Rgba::gray(f.splat(1.0))
    ///     }
    /// }
    ///
    /// let whole_picture = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
    /// let above = Above { height: 0.25 };
    /// let mut pass = Pass::new();
    /// pass.draw(&above, Mesh { vertices: &whole_picture, indices: Indices::Sequential }, DrawState::default());
    /// let mut hits = vec![0; 16 * 16];
    /// let mut target = Target { hits: Some(&mut hits), ..Target::new(16, 16) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(hits.iter().sum::<u32>(), 6 * 16, "the upper six rows");
    /// # Ok::<(), Error>(())
    /// ```
    fn clip_distances(&self, _vertex: &Self::Vertex) -> [f32; super::MAX_CLIP_DISTANCES] {
        [0.0; super::MAX_CLIP_DISTANCES]
    }

    /// The fragments of one packet: their colours. Some of the lanes may lie outside the triangle; their results are
    /// thrown away.
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Self::Output<L>;

    /// Written by `#[shader]`, which also makes the stages inline: so that forgetting the attribute is an error here
    /// rather than a picture drawn ten times slower.
    #[doc(hidden)]
    #[allow(non_upper_case_globals, reason = "the name is the error message")]
    const ADD_THE_ATTRIBUTE_shader_TO_THIS_IMPL: ();
}
