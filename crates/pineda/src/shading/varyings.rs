//! What the vertex stage hands to the fragment stage.

use crate::lanes::{Dual, Lanes};
use crate::math::{Real, Rgba, Vec2, Vec3, Vec4};

/// The most numbers that a shader's varyings may have together: a `Vec3` counts as three.
pub const MAX_VARYINGS: usize = 32;

/// How a varying gets from the three vertices to a fragment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// Linear on the triangle or line in space, as perspective shows it. The default.
    #[default]
    Perspective,
    /// Not at all: the value of the triangle's [provoking vertex](crate::ProvokingVertex), bit by bit. `#[flat]` on a field.
    Flat,
    /// Linear on the screen, w disregarded. `#[noperspective]` on a field.
    NoPerspective,
}

/// What the vertex stage hands to the fragment stage: a struct that can be taken apart into a row of numbers.
///
/// Numbers, vectors and colours are varyings, `()` is no varyings at all, and [`varyings!`](crate::varyings) makes a
/// struct of them:
///
/// ```
/// # use pineda::*;
/// varyings! {
///     /// What a lit surface needs.
///     pub struct Surface {
///         pub normal: Vec3,
///         pub uv: Vec2,
///         /// The same all over the triangle.
///         #[flat]
///         pub material: Real,
///     }
/// }
/// ```
///
/// A struct that spells its width out can `#[derive(Varyings)]` instead, which is all that the macro does. There is
/// no reason to implement this trait by hand.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a set of varyings at this width",
    label = "cannot go from the vertex stage to the fragment stage",
    note = "declare the struct with `varyings! {{ struct Name {{ normal: Vec3, uv: Vec2 }} }}`",
    note = "its fields may be Real, Vec2, Vec3, Vec4, Rgba, Int, Uint or other varyings; plain `f32` and `[f32; 3]` may not"
)]
pub trait Varyings<L: Lanes>: Copy {
    /// The same varyings at another width.
    type At<M: Lanes>: Varyings<M>;
    /// The number of numbers, at most [`MAX_VARYINGS`].
    const LEN: usize;
    /// How each of the [`LEN`](Self::LEN) numbers is interpolated.
    const INTERPOLATION: &'static [Interpolation];
    /// From the first [`LEN`](Self::LEN) numbers of `rows`: all lanes of the first number, then of the second, and so on.
    fn read(lanes: L, rows: &[f32]) -> Self;
    /// To the first [`LEN`](Self::LEN) numbers of `rows`.
    fn write(self, rows: &mut [f32]);
    /// These values, with the derivatives that `dx` and `dy` hold; of integers, the values.
    fn with_derivatives(self, dx: Self, dy: Self) -> Self::At<Dual<L>>;
}

impl<L: Lanes> Varyings<L> for () {
    type At<M: Lanes> = ();
    const LEN: usize = 0;
    const INTERPOLATION: &'static [Interpolation] = &[];
    #[inline(always)]
    fn read(_: L, _: &[f32]) {}
    #[inline(always)]
    fn write(self, _: &mut [f32]) {}
    #[inline(always)]
    fn with_derivatives(self, (): (), (): ()) {}
}

impl<L: Lanes> Varyings<L> for Real<L> {
    type At<M: Lanes> = Real<M>;
    const LEN: usize = 1;
    const INTERPOLATION: &'static [Interpolation] = &[Interpolation::Perspective];
    #[inline(always)]
    fn read(lanes: L, rows: &[f32]) -> Self {
        Self(lanes.load(rows))
    }
    #[inline(always)]
    fn write(self, rows: &mut [f32]) {
        L::store(self.0, rows);
    }
    #[inline(always)]
    fn with_derivatives(self, dx: Self, dy: Self) -> Real<Dual<L>> {
        self.with_derivatives(dx, dy)
    }
}

macro_rules! vector_varyings {
    ($($vector:ident $n:literal: $($field:ident $i:literal)+);+) => {$(
        impl<L: Lanes> Varyings<L> for $vector<L> {
            type At<M: Lanes> = $vector<M>;
            const LEN: usize = $n;
            const INTERPOLATION: &'static [Interpolation] = &[Interpolation::Perspective; $n];
            #[inline(always)]
            fn read(lanes: L, rows: &[f32]) -> Self {
                Self { $($field: Real::read(lanes, &rows[$i * L::N..])),+ }
            }
            #[inline(always)]
            fn write(self, rows: &mut [f32]) {
                $(self.$field.write(&mut rows[$i * L::N..]);)+
            }
            #[inline(always)]
            fn with_derivatives(self, dx: Self, dy: Self) -> $vector<Dual<L>> {
                self.with_derivatives(dx, dy)
            }
        }
    )+};
}

vector_varyings!(Vec2 2: x 0 y 1; Vec3 3: x 0 y 1 z 2; Vec4 4: x 0 y 1 z 2 w 3; Rgba 4: r 0 g 1 b 2 a 3);

/// Declares the varyings of a shader: a struct whose fields are `Real`, `Vec2`, `Vec3`, `Vec4`, `Rgba`, `Int` or `Uint`,
/// written without the width, and with it added behind the scenes.
///
/// `varyings! { pub struct Lit { pub normal: Vec3 } }` declares `Lit<L: Lanes = Scalar>` with the field
/// `normal: Vec3<L>`, and derives [`Varyings`] for it. In the vertex stage it is `Lit`, in the fragment stage
/// `Lit<L>`. Attributes pass through: docs, `#[flat]` and `#[noperspective]`.
///
/// At most [`MAX_VARYINGS`] numbers fit; more are an error when the shader is compiled:
///
/// ```compile_fail
/// # use pineda::*;
/// varyings! { struct TooMany { a: Vec4, b: Vec4, c: Vec4, d: Vec4, e: Vec4, f: Vec4, g: Vec4, h: Vec4, one_more: Real } }
/// const LEN: usize = <TooMany as Varyings<Scalar>>::LEN;
/// ```
#[macro_export]
macro_rules! varyings {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident {
        $($(#[$field_attribute:meta])* $field_visibility:vis $field:ident: $type:ident),* $(,)?
    }) => {
        $(#[$attribute])*
        #[derive($crate::Varyings)]
        $visibility struct $name<L: $crate::Lanes = $crate::Scalar> {
            $($(#[$field_attribute])* $field_visibility $field: $type<L>),*
        }
    };
}

/// The row of numbers that a derived struct is made of, while it is put together at compile time.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    interpolation: [Interpolation; MAX_VARYINGS],
    len: usize,
}

impl Layout {
    /// No fields yet.
    pub const EMPTY: Self = Self { interpolation: [Interpolation::Perspective; MAX_VARYINGS], len: 0 };

    /// The row with a field's numbers at its end; `all` is the field's attribute, if it has one. What is flat of itself stays flat: integers
    /// cannot be interpolated.
    pub const fn with(mut self, field: &[Interpolation], all: Option<Interpolation>) -> Self {
        assert!(
            self.len + field.len() <= MAX_VARYINGS,
            "these varyings have more than 32 numbers: pass fewer, or pack them (a Vec3 counts as three)"
        );
        let mut i = 0;
        while i < field.len() {
            self.interpolation[self.len + i] = match (field[i], all) {
                (Interpolation::Flat, _) | (_, None) => field[i],
                (_, Some(interpolation)) => interpolation,
            };
            i += 1;
        }
        self.len += field.len();
        self
    }

    /// How each number is interpolated.
    pub const fn interpolation(&self) -> &[Interpolation] {
        self.interpolation.split_at(self.len).0
    }

    /// How many numbers.
    #[expect(clippy::len_without_is_empty, reason = "generated code asks for the length alone")]
    pub const fn len(&self) -> usize {
        self.len
    }
}
