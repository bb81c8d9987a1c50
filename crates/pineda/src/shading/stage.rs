//! A fragment stage at one width: any shader at any width, or a closure at the native one.

use super::{Frag, FragmentKind, Outputs, Shader, Varyings};
use crate::lanes::{Lanes, Packet};
use core::marker::PhantomData;
use fearless_simd::Level;

/// What runs for a packet of fragments of width `L`.
pub(crate) trait FragmentStage<L: Lanes> {
    /// The varyings at this width.
    type V: Varyings<L>;
    /// What the stage may do.
    type Kind: FragmentKind;
    /// What the stage returns.
    type Out: Outputs<L>;
    /// Whether lanes may be discarded.
    const DISCARDS: bool = <Self::Kind as FragmentKind>::DISCARDS;
    /// Whether `dx` and `dy` must be filled in.
    const DERIVATIVES: bool = <Self::Kind as FragmentKind>::DERIVATIVES;
    /// Whether `point_coord` must be filled in.
    const POINT_COORD: bool = <Self::Kind as FragmentKind>::POINT_COORD;
    /// Whether ids must be filled in.
    const IDS: bool = <Self::Kind as FragmentKind>::IDS;
    /// Whether barycentric coordinates must be filled in.
    const BARYCENTRICS: bool = <Self::Kind as FragmentKind>::BARYCENTRICS;
    /// Whether it leaves a depth.
    const WRITES_DEPTH: bool = <Self::Kind as FragmentKind>::WRITES_DEPTH;
    /// Whether the sample's number must be filled in.
    const SAMPLE_INDEX: bool = <Self::Kind as FragmentKind>::SAMPLE_INDEX;
    /// Whether covered samples must be filled in.
    const SAMPLE_MASK: bool = <Self::Kind as FragmentKind>::SAMPLE_MASK;
    /// Whether it leaves a mask of samples.
    const WRITES_SAMPLE_MASK: bool = <Self::Kind as FragmentKind>::WRITES_SAMPLE_MASK;
    /// The colours of the fragments in `f`.
    fn run(&self, f: &mut Frag<L, Self::V, Self::Kind>) -> Self::Out;
}

impl<L: Lanes, Sh: Shader> FragmentStage<L> for Sh {
    type V = Sh::Varyings<L>;
    type Kind = Sh;
    type Out = Sh::Output<L>;
    #[inline(always)]
    fn run(&self, f: &mut Frag<L, Self::V, Sh>) -> Sh::Output<L> {
        self.fragment(f)
    }
}

/// What a closure may do as a fragment stage: neither discard nor read derivatives.
#[derive(Clone, Copy, Debug)]
pub enum ClosureKind {}

impl FragmentKind for ClosureKind {
    const DISCARDS: bool = false;
    const DERIVATIVES: bool = false;
    const POINT_COORD: bool = false;
    const IDS: bool = false;
    const BARYCENTRICS: bool = false;
    const WRITES_DEPTH: bool = false;
    const SAMPLE_INDEX: bool = false;
    const SAMPLE_MASK: bool = false;
    const WRITES_SAMPLE_MASK: bool = false;
}

/// What a fragment stage asks for and does beyond varyings and colours, for those who do not know its type.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StageUses {
    pub(crate) discards: bool,
    pub(crate) ids: bool,
    pub(crate) writes_depth: bool,
    pub(crate) sample_index: bool,
    pub(crate) sample_mask: bool,
    pub(crate) writes_sample_mask: bool,
}

impl StageUses {
    pub(crate) const fn of<K: FragmentKind>() -> Self {
        Self {
            discards: K::DISCARDS,
            ids: K::IDS,
            writes_depth: K::WRITES_DEPTH,
            sample_index: K::SAMPLE_INDEX,
            sample_mask: K::SAMPLE_MASK,
            writes_sample_mask: K::WRITES_SAMPLE_MASK,
        }
    }

    /// Whether it has a say in which samples pass, so that tests have to wait for it.
    #[inline(always)]
    pub(crate) fn decides(&self) -> bool {
        self.discards | self.leaves_more()
    }

    /// Whether it leaves more than colours.
    #[inline(always)]
    pub(crate) fn leaves_more(&self) -> bool {
        self.writes_depth | self.writes_sample_mask
    }
}

/// What a fragment closure with the varyings `V` receives: sixteen fragments at the width [`Native`].
pub type ClosureFragment<V> = Frag<Native, V, ClosureKind>;

/// A closure as a fragment stage. A closure is not generic, so it has one width only: [`Native`].
pub(crate) struct Closure<F, V, O> {
    fragment: F,
    varyings: PhantomData<fn(V) -> O>,
}

impl<F: Fn(&mut ClosureFragment<V>) -> O, V: Varyings<Native>, O: Outputs<Native>> Closure<F, V, O> {
    pub(crate) fn new(fragment: F) -> Self {
        Self { fragment, varyings: PhantomData }
    }
}

impl<F: Fn(&mut ClosureFragment<V>) -> O, V: Varyings<Native>, O: Outputs<Native>> FragmentStage<Native>
    for Closure<F, V, O>
{
    type V = V;
    type Kind = ClosureKind;
    type Out = O;
    #[inline(always)]
    fn run(&self, f: &mut ClosureFragment<V>) -> O {
        (self.fragment)(f)
    }
}

/// The SIMD level that this target has without asking the CPU.
macro_rules! native_level {
    ($([$condition:meta] $level:ty, $as_level:ident);+ $(;)?) => {$(
        #[cfg($condition)]
        mod native {
            /// The token of the target's baseline level.
            pub(super) type Token = $level;
            /// The token itself: the baseline is known to be there when the program is compiled.
            #[inline(always)]
            pub(super) fn token() -> Token {
                super::Level::baseline().$as_level().expect("the target's baseline level")
            }
        }
    )+};
}

native_level! {
    [all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2", target_feature = "fxsr")]
        fearless_simd::x86::Sse2, as_sse2;
    [all(target_arch = "aarch64", target_feature = "neon")] fearless_simd::aarch64::Neon, as_neon;
    [all(target_arch = "wasm32", target_feature = "simd128")] fearless_simd::wasm32::WasmSimd128, as_wasm_simd128;
}

/// Targets without a baseline level run closures on plain arrays.
#[cfg(not(any(
    all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2", target_feature = "fxsr"),
    all(target_arch = "aarch64", target_feature = "neon"),
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
mod native {
    pub(super) type Token = fearless_simd::Fallback;
    #[inline(always)]
    pub(super) fn token() -> Token {
        let super::Level::Fallback(token) = super::Level::baseline() else {
            unreachable!("this target has no level without asking the CPU")
        };
        token
    }
}

/// The width that closures run at: sixteen lanes at the level which the target has without asking the CPU. That is SSE2
/// on x86-64, NEON on ARM, simd128 on WebAssembly where it is switched on.
pub type Native = Packet<native::Token>;

/// The permission to use [`Native`].
#[inline(always)]
pub(crate) fn native() -> Native {
    Packet(native::token())
}
