//! What a fragment stage knows of samples, and which of them it lets be written.

use super::{Frag, FragmentKind};
use crate::lanes::Lanes;
use crate::math::{ToLanes, Uint};

impl<L: Lanes, V: Copy, K: FragmentKind> Frag<L, V, K> {
    /// The number of the sample that is shaded, as [`Samples::positions`](crate::Samples::positions) has them; 0 where pixels have one.
    ///
    /// Where they have several, the draw must be shaded [by sample](crate::Sampling::Sample): it is an [error](crate::Error::SampleIndex) otherwise. (Elsewhere
    /// such a shader is run once a sample without being asked to, which is as dear as it is easily overlooked.) The shader must say that it asks; it is an error when it is
    /// compiled otherwise.
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Numbers;
    ///
    /// #[shader]
    /// impl Shader for Numbers {
    ///     type Vertex = [f32; 2];
    ///     type Varyings<L: Lanes> = ();
    ///     const SAMPLE_INDEX: bool = true;
    ///     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
    ///         (Vec4::from([x, y, 0.0, 1.0]), ())
    ///     }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Uint<L> {
    ///         f.sample_index()
    ///     }
    /// }
    ///
    /// let corners = [[0.0, 0.0], [0.0, 2.0], [2.0, 0.0]];
    /// let mesh = Mesh { vertices: &corners, indices: Indices::Sequential };
    /// let mut numbers = [9; 4];
    /// let mut draw = |sampling| {
    ///     let mut pass = Pass::new();
    ///     pass.draw(&Numbers, mesh, DrawState { sampling, space: Space::Raster, ..DrawState::default() });
    ///     let mut target = Target { samples: Samples::Four, color: ColorBuffer::R32U(&mut numbers), ..Target::new(1, 1) };
    ///     Renderer::new(Settings::default())?.render(&pass, &mut target).map(drop)
    /// };
    /// assert_eq!(draw(Sampling::Centroid), Err(Error::SampleIndex { draw: 0 }));
    /// draw(Sampling::Sample)?;
    /// assert_eq!(numbers, [0, 1, 2, 3]);
    /// # Ok::<(), Error>(())
    /// ```
    #[inline(always)]
    pub fn sample_index(&self) -> Uint<L> {
        const {
            assert!(
                K::SAMPLE_INDEX,
                "this fragment stage reads f.sample_index(): add `const SAMPLE_INDEX: bool = true;` to its `impl Shader` \
                 (a closure has no sample index: implement `Shader` instead)"
            );
        }
        self.parts.sample_index
    }

    /// The samples of its pixel that the fragment covers, bit k for sample k: those that the triangle (line, point) covers and the draw's
    /// [`sample_mask`](crate::DrawState::sample_mask) lets through, before they are tested for depth and stencil. Shaded [by sample](crate::Sampling::Sample), a fragment covers that sample only. 1 where
    /// pixels have one sample.
    ///
    /// A triangle has one fragment in a pixel, and neighbours that share an edge have a fragment each there: two masks without a common bit. This is Vulkan's and Direct3D's input coverage
    /// (`SampleMaskIn`, `SV_Coverage`).
    ///
    /// The shader must say that it asks; it is an error when it is compiled otherwise. How much of each pixel a triangle covers:
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Covered;
    ///
    /// #[shader]
    /// impl Shader for Covered {
    ///     type Vertex = [f32; 2];
    ///     type Varyings<L: Lanes> = ();
    ///     const SAMPLE_MASK: bool = true;
    ///     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
    ///         (Vec4::from([x, y, 0.0, 1.0]), ())
    ///     }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Uint<L> {
    ///         f.sample_mask()
    ///     }
    /// }
    ///
    /// let corners = [[0.0, 0.0], [0.0, 6.0], [6.0, 0.0]];
    /// let mut pass = Pass::new();
    /// let state = DrawState { space: Space::Raster, ..DrawState::default() };
    /// pass.draw(&Covered, Mesh { vertices: &corners, indices: Indices::Sequential }, state);
    /// let mut masks = [0; 6 * 6];
    /// let mut target = Target { samples: Samples::Four, color: ColorBuffer::R32U(&mut masks), ..Target::new(6, 6) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(masks[..6], [0b1111, 0b1111, 0b1111, 0b1111, 0b1111, 0b0101]);
    /// # Ok::<(), Error>(())
    /// ```
    #[inline(always)]
    pub fn sample_mask(&self) -> Uint<L> {
        const {
            assert!(
                K::SAMPLE_MASK,
                "this fragment stage reads f.sample_mask(): add `const SAMPLE_MASK: bool = true;` to its `impl Shader` \
                 (a closure has no sample mask: implement `Shader` instead)"
            );
        }
        self.parts.sample_mask
    }

    /// Takes away the samples whose bits are 0, of those that the fragment covers: they write neither colour nor depth. None is added. Bits beyond the target's samples are ignored; shaded
    /// [by sample](crate::Sampling::Sample), all but that sample's are. The last call counts; without any, all stay. With [alpha to coverage](crate::DrawState::alpha_to_coverage) both count.
    ///
    /// The shader must say that it writes a mask; it is an error when it is compiled otherwise. Transparency as a pattern of samples, without an order:
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Screen { mask: u32 }
    ///
    /// #[shader]
    /// impl Shader for Screen {
    ///     type Vertex = [f32; 2];
    ///     type Varyings<L: Lanes> = ();
    ///     const WRITES_SAMPLE_MASK: bool = true;
    ///     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
    ///         (Vec4::from([x, y, 0.0, 1.0]), ())
    ///     }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         // Every other column the other way round.
    ///         let is_odd = (f.x().to_uint() & 1).eq(1);
    ///         f.set_sample_mask(is_odd.select(f.splat(!self.mask), f.splat(self.mask)));
    ///         Rgba::gray(f.splat(1.0))
    ///     }
    /// }
    ///
    /// let corners = [[0.0, 0.0], [0.0, 4.0], [4.0, 0.0]];
    /// let mut pass = Pass::new();
    /// let state = DrawState { space: Space::Raster, ..DrawState::default() };
    /// pass.draw(&Screen { mask: 0b0001 }, Mesh { vertices: &corners, indices: Indices::Sequential }, state);
    /// let mut pixels = [[0.0; 4]; 2];
    /// let mut target = Target { samples: Samples::Four, color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(2, 1) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(pixels, [[0.25; 4], [0.75; 4]]);
    /// # Ok::<(), Error>(())
    /// ```
    #[inline(always)]
    pub fn set_sample_mask(&mut self, mask: impl ToLanes<L, Uint<L>>) {
        const {
            assert!(
                K::WRITES_SAMPLE_MASK,
                "this fragment stage calls f.set_sample_mask(..): add `const WRITES_SAMPLE_MASK: bool = true;` to its `impl Shader` \
                 (a closure cannot write a sample mask: implement `Shader` instead)"
            );
        }
        self.parts.written_mask = mask.to_lanes(self.lanes());
    }
}
