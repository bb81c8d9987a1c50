//! What a fragment stage receives.

mod samples;
mod triangle;

use super::{Shader, Varyings};
use crate::lanes::{Dual, Lanes};
use crate::math::{Bool, Real, Splat, ToLanes, Uint, Vec2, Vec3};
use core::marker::PhantomData;
use core::ops::Deref;

/// What the fragment stage of the shader `Sh` receives; see [`Frag`].
pub type Fragment<L, Sh> = Frag<L, <Sh as Shader>::Varyings<L>, Sh>;

/// Up to sixteen fragments that are shaded together, one per lane.
///
/// It derefs to the varyings, interpolated at each pixel's centre (of multisampled pixels see [`Sampling`](crate::Sampling)): `f.normal`, `f.uv`. Where the varyings are a single
/// number or vector, [`f.varyings()`](Self::varyings) is it.
///
/// `V` is the varyings' type, `K` says what the stage may do: [`Fragment<L, Sh>`](Fragment) is the name to write.
#[derive(Debug)]
pub struct Frag<L: Lanes, V, K> {
    pub(crate) parts: FragParts<L, V>,
    pub(crate) kind: PhantomData<fn() -> K>,
}

/// The parts that a fragment is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FragParts<L: Lanes, V> {
    /// The varyings where the fragment is shaded.
    pub(crate) varyings: V,
    /// How much the varyings change per pixel to the right; anything if the stage declares no derivatives.
    pub(crate) dx: V,
    /// How much the varyings change per pixel downwards; anything if the stage declares no derivatives.
    pub(crate) dy: V,
    /// The pixel's centre, in pixels from the left.
    pub(crate) x: Real<L>,
    /// The pixel's centre, in pixels from the top.
    pub(crate) y: Real<L>,
    /// Depth, 0 to 1.
    pub(crate) z: Real<L>,
    /// The place in a point's square; anything if the stage does not ask for it.
    pub(crate) point_coord: Vec2<L>,
    /// Triangle, instance and draw; anything if the stage does not ask for them.
    pub(crate) ids: [Uint<L>; 3],
    /// With perspective, and without; anything if the stage does not ask for them.
    pub(crate) barycentrics: [Vec3<L>; 2],
    /// The depth that the stage writes; anything if it writes none.
    pub(crate) depth: Real<L>,
    /// The sample that is shaded, the samples that the fragment covers, and those that the stage lets it cover; anything if it does not ask for them, or leaves them.
    pub(crate) sample_index: Uint<L>,
    pub(crate) sample_mask: Uint<L>,
    pub(crate) written_mask: Uint<L>,
    /// Whether the triangle shows its front.
    pub(crate) front_facing: Bool<L>,
    /// The lanes that cover something, less those that the stage discards.
    pub(crate) alive: Bool<L>,
}

/// What a fragment stage may do, known when it is compiled.
///
/// Every [`Shader`] says so by its constants; closures may do none of it.
#[diagnostic::on_unimplemented(message = "`{Self}` is not a shader")]
pub trait FragmentKind {
    /// See [`Shader::DISCARDS`].
    const DISCARDS: bool;
    /// See [`Shader::DERIVATIVES`].
    const DERIVATIVES: bool;
    /// See [`Shader::POINT_COORD`].
    const POINT_COORD: bool;
    /// See [`Shader::IDS`].
    const IDS: bool;
    /// See [`Shader::BARYCENTRICS`].
    const BARYCENTRICS: bool;
    /// See [`Shader::WRITES_DEPTH`].
    const WRITES_DEPTH: bool;
    /// See [`Shader::SAMPLE_INDEX`].
    const SAMPLE_INDEX: bool;
    /// See [`Shader::SAMPLE_MASK`].
    const SAMPLE_MASK: bool;
    /// See [`Shader::WRITES_SAMPLE_MASK`].
    const WRITES_SAMPLE_MASK: bool;
}

impl<Sh: Shader> FragmentKind for Sh {
    const DISCARDS: bool = Sh::DISCARDS;
    const DERIVATIVES: bool = Sh::DERIVATIVES;
    const POINT_COORD: bool = Sh::POINT_COORD;
    const IDS: bool = Sh::IDS;
    const BARYCENTRICS: bool = Sh::BARYCENTRICS;
    const WRITES_DEPTH: bool = Sh::WRITES_DEPTH;
    const SAMPLE_INDEX: bool = Sh::SAMPLE_INDEX;
    const SAMPLE_MASK: bool = Sh::SAMPLE_MASK;
    const WRITES_SAMPLE_MASK: bool = Sh::WRITES_SAMPLE_MASK;
}

impl<L: Lanes, V: Copy, K> Frag<L, V, K> {
    /// The lanes whose colour is to be written: those that covered something and were not discarded.
    #[inline(always)]
    pub(crate) fn alive(&self) -> Bool<L> {
        self.parts.alive
    }

    /// All varyings at once; a copy.
    #[inline(always)]
    pub fn varyings(&self) -> V {
        self.parts.varyings
    }

    /// The pixel's centre, in pixels from the target's left border: 0.5, 1.5, 2.5, ...; the sample's place, of a draw that is shaded [by sample](crate::Sampling::Sample).
    #[inline(always)]
    pub fn x(&self) -> Real<L> {
        self.parts.x
    }

    /// The same from the target's top border.
    #[inline(always)]
    pub fn y(&self) -> Real<L> {
        self.parts.y
    }

    /// The fragment's depth, 0 (near) to 1 (far): what the depth test compares. If it stands for several samples of a pixel, which are tested with depths of their own, it is
    /// that of the place where it is shaded, before depth bias.
    #[inline(always)]
    pub fn z(&self) -> Real<L> {
        self.parts.z
    }

    /// Whether the triangle turns its front to the viewer, as the draw's `front_face` has it. Lines and points always do; the edges and corners
    /// of a triangle as the triangle does.
    #[inline(always)]
    pub fn front_facing(&self) -> Bool<L> {
        self.parts.front_facing
    }

    /// The width, for [`Real::new`] in helper functions.
    #[inline(always)]
    pub fn lanes(&self) -> L {
        self.parts.x.lanes()
    }

    /// A plain number, the same in every lane, for sums and functions to start from; of an array, a vector.
    #[inline(always)]
    pub fn splat<T: Splat<L>>(&self, value: T) -> T::Output {
        value.splat(self.lanes())
    }
}

impl<L: Lanes, V: Copy, K: FragmentKind> Frag<L, V, K> {
    /// How much each varying changes from a pixel to its right-hand neighbour: the derivative where the fragment is shaded, by
    /// extrapolating the triangle's plane, so that it is right at the border too. 0 for a `#[flat]` one.
    ///
    /// The shader must say that it wants derivatives; it is an error when it is compiled otherwise:
    ///
    /// ```compile_fail
    /// # use pineda::*;
    /// # struct Edges;
    /// #[shader]
    /// impl Shader for Edges {
    ///     type Vertex = ();
    ///     type Varyings<L: Lanes> = Vec2<L>;
    ///     // const DERIVATIVES: bool = true; is missing.
    ///     fn vertex(&self, _: &()) -> (Vec4, Vec2) { Default::default() }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         Rgba::gray(f.dx().length())
    ///     }
    /// }
    /// # let stage: fn(&Edges, &mut Fragment<Scalar, Edges>) -> Rgba = Edges::fragment::<Scalar>;
    /// ```
    #[inline(always)]
    pub fn dx(&self) -> &V {
        const {
            assert!(
                K::DERIVATIVES,
                "this fragment stage reads f.dx(): add `const DERIVATIVES: bool = true;` to its `impl Shader` \
                 (a closure cannot have derivatives: implement `Shader` instead)"
            );
        }
        &self.parts.dx
    }

    /// All varyings, as numbers that know their derivatives, and hand them on to whatever is computed from them: see [`Dual`]. What textures are
    /// [sampled](crate::Texture2d::sample) with.
    ///
    /// The shader must say that it wants derivatives, as for [`dx`](Self::dx).
    #[inline(always)]
    pub fn dual(&self) -> V::At<Dual<L>>
    where
        V: Varyings<L>,
    {
        const {
            assert!(
                K::DERIVATIVES,
                "this fragment stage calls f.dual(): add `const DERIVATIVES: bool = true;` to its `impl Shader` \
                 (a closure cannot have derivatives: implement `Shader` instead)"
            );
        }
        self.parts.varyings.with_derivatives(self.parts.dx, self.parts.dy)
    }

    /// How much each varying changes from a pixel to the one below; see [`dx`](Self::dx).
    #[inline(always)]
    pub fn dy(&self) -> &V {
        const {
            assert!(
                K::DERIVATIVES,
                "this fragment stage reads f.dy(): add `const DERIVATIVES: bool = true;` to its `impl Shader` \
                 (a closure cannot have derivatives: implement `Shader` instead)"
            );
        }
        &self.parts.dy
    }

    /// Where in a [point](crate::PrimitiveTopology::PointList)'s square the pixel's centre lies: from (0, 0) at its upper left corner to (1, 1) at its lower right
    /// one. (0, 0) in triangles and lines.
    ///
    /// The shader must say that it asks for it; it is an error when it is compiled otherwise. Discs, their borders one pixel soft:
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Discs { size: f32 }
    ///
    /// #[shader]
    /// impl Shader for Discs {
    ///     type Vertex = [f32; 2];
    ///     type Varyings<L: Lanes> = ();
    ///     const POINT_COORD: bool = true;
    ///     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
    ///         (Vec4::from([x, y, 0.0, 1.0]), ())
    ///     }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         let away = (f.point_coord() - f.splat([0.5, 0.5])).length() * self.size;
    ///         Rgba::new(f.splat([1.0, 0.8, 0.3]), (0.5 * self.size - away).clamp(0.0, 1.0))
    ///     }
    /// }
    ///
    /// let discs = Discs { size: 24.0 };
    /// let state = DrawState {
    ///     topology: PrimitiveTopology::PointList,
    ///     point_size: discs.size,
    ///     blend: Blend::ALPHA,
    ///     space: Space::Raster,
    ///     ..DrawState::default()
    /// };
    /// let mut pass = Pass::new();
    /// pass.draw(&discs, Mesh { vertices: &[[16.0, 16.0]], indices: Indices::Sequential }, state);
    /// let mut pixels = vec![[0; 4]; 32 * 32];
    /// let mut target = Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(32, 32) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!([16, 5].map(|at| pixels[32 * at + at][3]), [255, 0], "the middle, and a corner of the square");
    /// # Ok::<(), Error>(())
    /// ```
    #[inline(always)]
    pub fn point_coord(&self) -> Vec2<L> {
        const {
            assert!(
                K::POINT_COORD,
                "this fragment stage reads f.point_coord(): add `const POINT_COORD: bool = true;` to its `impl Shader` \
                 (a closure has no point coordinates: implement `Shader` instead)"
            );
        }
        self.parts.point_coord
    }

    /// Replaces the fragments' depth: what is tested, and stored, in place of the triangle's. Until it is called, that is [`f.z()`](Self::z).
    ///
    /// It is clamped to the viewport's range of depths and rounded to the depth buffer's format, as the triangle's would be; NaN is the range's least. No
    /// [depth bias](crate::DepthBias) is added. If the fragment stands for several samples of a pixel, all that it covers get this depth. The triangle itself is clipped by the near
    /// and the far plane as ever. This is Vulkan's `FragDepth` and WebGPU's `frag_depth`.
    ///
    /// The shader must say that it writes depth; it is an error when it is compiled otherwise. A ball on a square, which cuts another one where balls do:
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Balls;
    ///
    /// #[shader]
    /// impl Shader for Balls {
    ///     /// The middle, and the radius.
    ///     type Vertex = Instanced<[f32; 2], ([f32; 3], f32)>;
    ///     /// The place on the square, from -1 to 1; the middle's depth, and the radius.
    ///     type Varyings<L: Lanes> = Vec4<L>;
    ///     const DISCARDS: bool = true;
    ///     const WRITES_DEPTH: bool = true;
    ///     fn vertex(&self, v: &Self::Vertex) -> (Vec4, Vec4) {
    ///         let ([u, v], ([x, y, z], radius)) = (v.vertex, v.instance);
    ///         (Vec4::from([x + u * radius, y + v * radius, z, 1.0]), Vec4::from([u, v, z, radius]))
    ///     }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         let height2 = 1.0 - f.x * f.x - f.y * f.y;
    ///         f.discard(height2.lt(0.0));
    ///         let height = height2.max(0.0).sqrt();
    ///         // 64 units deep, as the picture is wide.
    ///         f.set_depth(f.z - height * f.w / 64.0);
    ///         Rgba::gray(height)
    ///     }
    /// }
    ///
    /// let square = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
    /// let balls = [([24.0, 32.0, 0.5], 16.0), ([40.0, 32.0, 0.5], 16.0)];
    /// let mesh = Mesh { vertices: &square, indices: Indices::Sequential };
    /// let state = DrawState { topology: PrimitiveTopology::TriangleStrip, space: Space::Raster, ..DrawState::default() };
    /// let mut pass = Pass::new();
    /// pass.draw_instanced(&Balls, mesh, &balls, state);
    /// let mut shown = vec![0; 64 * 64];
    /// let mut target = Target { instance_ids: Some(&mut shown), ..Target::new(64, 64) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// // The first ball to the left of the plane between them, the second to its right; in the corners of the squares nothing.
    /// assert_eq!([10, 31, 32, 50].map(|x| shown[32 * 64 + x]), [0, 0, 1, 1]);
    /// assert_eq!(shown[17 * 64 + 9], NO_ID);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// ```compile_fail
    /// # use pineda::*;
    /// # struct Flat;
    /// #[shader]
    /// impl Shader for Flat {
    ///     type Vertex = ();
    ///     type Varyings<L: Lanes> = ();
    ///     // const WRITES_DEPTH: bool = true; is missing.
    ///     fn vertex(&self, _: &()) -> (Vec4, ()) { Default::default() }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         f.set_depth(0.5);
    ///         Rgba::gray(f.z())
    ///     }
    /// }
    /// # let stage: fn(&Flat, &mut Fragment<Scalar, Flat>) -> Rgba = Flat::fragment::<Scalar>;
    /// ```
    #[inline(always)]
    pub fn set_depth(&mut self, depth: impl ToLanes<L, Real<L>>) {
        const {
            assert!(
                K::WRITES_DEPTH,
                "this fragment stage calls f.set_depth(..): add `const WRITES_DEPTH: bool = true;` to its `impl Shader` \
                 (a closure cannot write depth: implement `Shader` instead)"
            );
        }
        self.parts.depth = depth.to_lanes(self.lanes());
    }

    /// Drops the fragments in the lanes of `when`: they write neither colour nor depth. The stage goes on for the
    /// other lanes; what it returns for the dropped ones is ignored.
    ///
    /// The shader must say that it discards; it is an error when it is compiled otherwise:
    ///
    /// ```compile_fail
    /// # use pineda::*;
    /// # struct CutOut;
    /// #[shader]
    /// impl Shader for CutOut {
    ///     type Vertex = ();
    ///     type Varyings<L: Lanes> = Rgba<L>;
    ///     // const DISCARDS: bool = true; is missing.
    ///     fn vertex(&self, _: &()) -> (Vec4, Rgba) { Default::default() }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         f.discard(f.a.lt(0.5));
    ///         f.varyings()
    ///     }
    /// }
    /// # let stage: fn(&CutOut, &mut Fragment<Scalar, CutOut>) -> Rgba = CutOut::fragment::<Scalar>;
    /// ```
    #[inline(always)]
    pub fn discard(&mut self, when: Bool<L>) {
        const {
            assert!(
                K::DISCARDS,
                "this fragment stage calls f.discard(..): add `const DISCARDS: bool = true;` to its `impl Shader` \
                 (a closure cannot discard: implement `Shader` instead)"
            );
        }
        self.parts.alive &= !when;
    }
}

impl<L: Lanes, V, K> Deref for Frag<L, V, K> {
    type Target = V;
    #[inline(always)]
    fn deref(&self) -> &V {
        &self.parts.varyings
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::conformance::levels;
    use crate::lanes::{Packet, Scalar};
    use crate::math::Vec2;
    use crate::wide::dispatch;

    enum Anything {}

    impl Shader for Anything {
        type Vertex = ();
        type Varyings<M: Lanes> = Vec2<M>;
        type Output<M: Lanes> = crate::math::Rgba<M>;
        const DERIVATIVES: bool = true;
        const DISCARDS: bool = true;
        const ADD_THE_ATTRIBUTE_shader_TO_THIS_IMPL: () = ();
        fn vertex(&self, (): &()) -> (crate::math::Vec4, Vec2) {
            Default::default()
        }
        fn fragment<M: Lanes>(&self, f: &mut Fragment<M, Self>) -> crate::math::Rgba<M> {
            crate::math::Rgba::gray(f.x)
        }
    }

    /// Fragments whose varyings are (lane, 1), all but the last lane covered.
    #[inline(always)]
    fn fragments<L: Lanes>(lanes: L) -> Fragment<L, Anything> {
        let lane = Real(lanes.iota());
        let constant = |x: f32| Real::<L>::new(lanes, x);
        let parts = FragParts {
            varyings: Vec2::new(lane, constant(1.0)),
            dx: Vec2::new(constant(2.0), constant(3.0)),
            dy: Vec2::new(constant(4.0), constant(5.0)),
            x: lane + 0.5,
            y: constant(6.5),
            point_coord: Vec2::new(constant(0.5), constant(0.5)),
            ids: [Uint::new(lanes, 0); 3],
            barycentrics: [Vec3::new(constant(1.0), constant(0.0), constant(0.0)); 2],
            depth: constant(0.25),
            sample_index: Uint::new(lanes, 0),
            sample_mask: Uint::new(lanes, 1),
            written_mask: Uint::new(lanes, 1),
            z: constant(0.25),
            front_facing: lane.lt(4.0),
            alive: Bool(lanes.mask(0x7fff)),
        };
        Frag { parts, kind: PhantomData }
    }

    #[inline(always)]
    fn check<L: Lanes>(lanes: L) {
        let all = u32::MAX >> (32 - L::N);
        let holds = |mask: Bool<L>| L::mask_bits(mask.0) == all;
        let mut f = fragments(lanes);
        assert!(holds(f.x.eq(Real(lanes.iota()))), "derefs to the varyings");
        assert!(holds(f.varyings().y.eq(1.0)));
        assert!(holds(f.x().eq(f.x + 0.5) & f.y().eq(6.5) & f.z().eq(0.25)));
        assert!(holds(f.dx().x.eq(2.0) & f.dx().y.eq(3.0) & f.dy().x.eq(4.0) & f.dy().y.eq(5.0)));
        assert_eq!(L::mask_bits(f.front_facing().0), 0xf & all);
        assert!(holds(f.splat(7.0).eq(7.0) & f.splat([7.0, 8.0]).y.eq(8.0)));

        assert_eq!(L::mask_bits(f.alive().0), 0x7fff & all);
        f.discard(f.x.lt(1.0));
        assert_eq!(L::mask_bits(f.alive().0), 0x7ffe & all);
        f.discard(f.x.gt(13.0));
        assert_eq!(L::mask_bits(f.alive().0), 0x3ffe & all, "what is discarded stays discarded");
    }

    #[test]
    fn fragments_hand_out_their_parts_and_drop_what_is_discarded() {
        check(Scalar);
        for level in levels() {
            dispatch!(level, simd => check(Packet(simd)));
        }
    }
}
