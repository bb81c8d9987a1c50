//! A yes or no per lane, and choosing by it.

use super::{Real, Rgba, ToLanes, Vec2, Vec3, Vec4};
use crate::lanes::{Lanes, Scalar};
use core::ops::{BitAnd, BitAndAssign, BitOr, BitOrAssign, BitXor, BitXorAssign, Not};

/// A yes or no per lane: what comparing two [`Real`]s gives.
///
/// There is no `if` over sixteen answers at once: compute both values and [`select`](Self::select) between them. Masks
/// combine with `&`, `|`, `^` and `!`.
pub struct Bool<L: Lanes = Scalar>(pub(crate) L::M);

impl<L: Lanes> Bool<L> {
    /// `a` in the lanes that are set, `b` in the others. Either may be plain: `x.lt(0.0).select(0.0, x)`.
    #[inline(always)]
    pub fn select<A: Select<L, B>, B>(self, a: A, b: B) -> A::Output {
        A::select(self, a, b)
    }

    /// Whether any lane is set. Lanes that lie outside the triangle count too, so use it only to skip work that
    /// cannot show, never to decide what is drawn.
    #[inline(always)]
    pub fn any(self) -> bool {
        L::any(self.0)
    }
}

impl<L: Lanes> Clone for Bool<L> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<L: Lanes> Copy for Bool<L> {}

impl<L: Lanes> core::fmt::Debug for Bool<L> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0.fmt(f)
    }
}

impl From<bool> for Bool<Scalar> {
    #[inline(always)]
    fn from(b: bool) -> Self {
        Self(b)
    }
}
impl From<Bool<Scalar>> for bool {
    #[inline(always)]
    fn from(b: Bool<Scalar>) -> Self {
        b.0
    }
}

macro_rules! mask_operator {
    ($($operator:ident $function:ident $lanes:ident $assign:ident $assign_function:ident),+) => {$(
        impl<L: Lanes> $operator for Bool<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: Self) -> Self {
                Self(L::$lanes(self.0, b.0))
            }
        }
        impl<L: Lanes> $assign for Bool<L> {
            #[inline(always)]
            fn $assign_function(&mut self, b: Self) {
                self.0 = L::$lanes(self.0, b.0);
            }
        }
    )+};
}

mask_operator!(
    BitAnd bitand and BitAndAssign bitand_assign,
    BitOr bitor or BitOrAssign bitor_assign,
    BitXor bitxor xor BitXorAssign bitxor_assign
);

impl<L: Lanes> Not for Bool<L> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(L::not(self.0))
    }
}

/// What [`Bool::select`] chooses between: two values of one lane type, or such a value and a plain one, or two plain
/// ones (`f32`, `[f32; 3]`).
#[diagnostic::on_unimplemented(message = "cannot select between `{Self}` and `{B}`")]
pub trait Select<L: Lanes, B>: Copy {
    /// The lane type.
    type Output;
    /// `a` in the lanes of `m`, `b` in the others.
    fn select(m: Bool<L>, a: Self, b: B) -> Self::Output;
}

impl<L: Lanes> Select<L, Self> for Bool<L> {
    type Output = Self;
    #[inline(always)]
    fn select(m: Self, a: Self, b: Self) -> Self {
        Self(L::or(L::and(m.0, a.0), L::and(L::not(m.0), b.0)))
    }
}

macro_rules! select {
    ($(($($field:ident)*) $out:ident: $a:ty, $b:ty);+ $(;)?) => {$(
        impl<L: Lanes> Select<L, $b> for $a {
            type Output = $out<L>;
            #[inline(always)]
            fn select(m: Bool<L>, a: Self, b: $b) -> $out<L> {
                let lanes = L::of_mask(m.0);
                let (a, b): ($out<L>, $out<L>) = (a.to_lanes(lanes), b.to_lanes(lanes));
                select!(@ m a b $out $($field)*)
            }
        }
    )+};
    (@ $m:ident $a:ident $b:ident Real) => { Real(L::select($m.0, $a.0, $b.0)) };
    (@ $m:ident $a:ident $b:ident $vector:ident $($field:ident)+) => {
        $vector { $($field: Real(L::select($m.0, $a.$field.0, $b.$field.0))),+ }
    };
}

select! {
    () Real: Real<L>, Real<L>;
    () Real: Real<L>, f32;
    () Real: f32, Real<L>;
    () Real: f32, f32;
    (x y) Vec2: Vec2<L>, Vec2<L>;
    (x y) Vec2: Vec2<L>, [f32; 2];
    (x y) Vec2: [f32; 2], Vec2<L>;
    (x y) Vec2: [f32; 2], [f32; 2];
    (x y z) Vec3: Vec3<L>, Vec3<L>;
    (x y z) Vec3: Vec3<L>, [f32; 3];
    (x y z) Vec3: [f32; 3], Vec3<L>;
    (x y z) Vec3: [f32; 3], [f32; 3];
    (x y z w) Vec4: Vec4<L>, Vec4<L>;
    (x y z w) Vec4: Vec4<L>, [f32; 4];
    (x y z w) Vec4: [f32; 4], Vec4<L>;
    (r g b a) Rgba: Rgba<L>, Rgba<L>;
    (r g b a) Rgba: Rgba<L>, [f32; 4];
    (r g b a) Rgba: [f32; 4], Rgba<L>;
}
