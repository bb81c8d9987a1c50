//! What a fragment stage receives.

use super::Shader;
use crate::lanes::Lanes;
use crate::math::{Bool, Real, Splat};
use core::marker::PhantomData;
use core::ops::Deref;

/// What the fragment stage of the shader `Sh` receives; see [`Frag`].
pub type Fragment<L, Sh> = Frag<L, <Sh as Shader>::Varyings<L>, Sh>;

/// Up to sixteen fragments that are shaded together, one per lane.
///
/// It derefs to the varyings, interpolated at each pixel's centre: `f.normal`, `f.uv`. Where the varyings are a single
/// number or vector, [`f.varyings()`](Self::varyings) is it.
///
/// `V` is the varyings' type, `K` says what the stage may do: [`Fragment<L, Sh>`](Fragment) is the name to write.
#[derive(Debug)]
pub struct Frag<L: Lanes, V, K> {
    parts: FragParts<L, V>,
    kind: PhantomData<fn() -> K>,
}

/// The parts that a fragment is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FragParts<L: Lanes, V> {
    /// The varyings at the pixel's centre.
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
    /// Whether the triangle shows its front.
    pub(crate) front_facing: Bool<L>,
    /// The lanes that cover something, less those that the stage discards.
    pub(crate) alive: Bool<L>,
}

/// What a fragment stage may do, known when it is compiled.
///
/// Every [`Shader`] says so by its constants; closures may do neither.
#[diagnostic::on_unimplemented(message = "`{Self}` is not a shader")]
pub trait FragmentKind {
    /// See [`Shader::DISCARDS`].
    const DISCARDS: bool;
    /// See [`Shader::DERIVATIVES`].
    const DERIVATIVES: bool;
}

impl<Sh: Shader> FragmentKind for Sh {
    const DISCARDS: bool = Sh::DISCARDS;
    const DERIVATIVES: bool = Sh::DERIVATIVES;
}

impl<L: Lanes, V: Copy, K> Frag<L, V, K> {
    /// Fragments about to be shaded.
    #[inline(always)]
    pub(crate) fn new(parts: FragParts<L, V>) -> Self {
        Self { parts, kind: PhantomData }
    }

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

    /// The pixel's centre, in pixels from the target's left border: 0.5, 1.5, 2.5, ...
    #[inline(always)]
    pub fn x(&self) -> Real<L> {
        self.parts.x
    }

    /// The pixel's centre, in pixels from the target's top border: 0.5, 1.5, 2.5, ...
    #[inline(always)]
    pub fn y(&self) -> Real<L> {
        self.parts.y
    }

    /// The fragment's depth, 0 (near) to 1 (far): what the depth test compares.
    #[inline(always)]
    pub fn z(&self) -> Real<L> {
        self.parts.z
    }

    /// Whether the triangle turns its front to the viewer, as the draw's `front_face` has it.
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
    /// How much each varying changes from a pixel to its right-hand neighbour: the derivative at the pixel's centre, by
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
