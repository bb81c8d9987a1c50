//! What a fragment stage returns: a value for each of the target's colour buffers.

use crate::lanes::Lanes;
use crate::math::{Int, Real, Rgba, RgbaI, RgbaU, Uint, Vec2, Vec3, Vec4};
use core::fmt;

/// Four rows of up to sixteen lanes: what goes to one colour buffer. Of integers, their bits.
#[doc(hidden)]
pub type Row4 = [[f32; 16]; 4];

/// The kind of numbers that a colour buffer holds, and a fragment stage returns for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OutputKind {
    /// Floats and fixed-point numbers: [`Rgba`], [`Real`] and vectors.
    Float,
    /// Unsigned integers: [`Uint`], [`RgbaU`].
    Uint,
    /// Signed integers: [`Int`], [`RgbaI`].
    Int,
}

impl fmt::Display for OutputKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Float => "floats",
            Self::Uint => "unsigned integers",
            Self::Int => "signed integers",
        })
    }
}

/// What goes to one colour buffer: [`Rgba`], [`RgbaU`] or [`RgbaI`]; or fewer numbers, of which green and blue are then 0 and alpha 1.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be stored in a colour buffer",
    note = "Rgba, Real, Vec2, Vec3, Vec4, RgbaU, Uint, RgbaI and Int can"
)]
pub trait Output<L: Lanes>: Copy {
    /// What numbers these are.
    const KIND: OutputKind;
    /// To the first lanes of the rows.
    #[doc(hidden)]
    fn write(self, rows: &mut Row4);
}

/// All that a fragment stage returns: one [`Output`], or a tuple or an array of them, one for each of the target's colour buffers, in order; or
/// a struct that [`outputs!`](crate::outputs) declares; or [`DualSource`]; or `()` for no colour at all.
///
/// ```
/// use pineda::*;
/// struct Numbered { number: u32 }
///
/// #[shader]
/// impl Shader for Numbered {
///     type Vertex = [f32; 2];
///     type Varyings<L: Lanes> = ();
///
///     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
///         (Vec4::from([x, y, 0.0, 1.0]), ())
///     }
///
///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> (Rgba<L>, Uint<L>) {
///         (Rgba::gray(f.x() / 16.0), f.splat(self.number))
///     }
/// }
///
/// let corners = [[0.0, 0.0], [16.0, 0.0], [0.0, 16.0]];
/// let state = DrawState { space: Space::Raster, ..DrawState::default() };
/// let mut pass = Pass::new();
/// pass.draw(&Numbered { number: 0xffff_fffe }, Mesh { vertices: &corners, indices: Indices::Sequential }, state);
///
/// let (mut colors, mut numbers) = (vec![[0; 4]; 16 * 16], vec![0; 16 * 16]);
/// let mut target = Target {
///     color: ColorBuffer::Rgba8Srgb(&mut colors),
///     more_colors: vec![ColorBuffer::R32U(&mut numbers)],
///     ..Target::new(16, 16)
/// };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// assert_eq!((numbers[0], numbers[16 * 16 - 1]), (0xffff_fffe, 0));
/// # Ok::<(), Error>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is nothing that a fragment stage can return",
    note = "an `Rgba<L>` can be, a `Uint<L>`, ..., a tuple of them, or a struct declared with `outputs! {{ ... }}`"
)]
pub trait Outputs<L: Lanes>: Copy {
    /// What each of them is made of.
    const KINDS: &'static [OutputKind];
    /// Whether there is a second source for blending.
    const HAS_SECOND_SOURCE: bool = false;
    /// To the first lanes of the rows: the first output, then all others.
    #[doc(hidden)]
    fn write(self, first: &mut Row4, more: &mut [Row4]);
}

/// A colour and the second source of the blend factors [`Source1`](crate::BlendFactor::Source1) and its like: by which the target's colour can be
/// multiplied channel by channel, as behind coloured glass. For targets with one colour buffer.
///
/// ```
/// use pineda::*;
/// let corners = [[0.0, 0.0], [9.0, 0.0], [0.0, 9.0]];
/// let target = BlendComponent { target: BlendFactor::Source1, ..BlendComponent::REPLACE };
/// let state = DrawState { space: Space::Raster, blend: Blend::both(target), ..DrawState::default() };
/// let mut pass = Pass::new();
/// pass.clear_color = Some([1.0, 0.5, 0.25, 1.0]);
/// // Lets red through and no blue, and shines a little itself.
/// pass.draw_with(
///     Mesh { vertices: &corners, indices: Indices::Sequential },
///     state,
///     |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
///     |f| DualSource { color: f.splat([0.125, 0.0, 0.0, 0.0]).into(), factor: f.splat([0.5, 0.5, 0.0, 1.0]).into() },
/// );
/// let mut pixels = [[0.0; 4]; 64];
/// let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(8, 8) };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// assert_eq!(pixels[0], [0.625, 0.25, 0.0, 1.0]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DualSource<L: Lanes> {
    /// What is blended.
    pub color: Rgba<L>,
    /// What the factors take.
    pub factor: Rgba<L>,
}

/// Declares what a fragment stage returns for several colour buffers: a struct whose fields are `Rgba`, `RgbaU`, `RgbaI`, `Real`, `Vec2`, `Vec3`,
/// `Vec4`, `Uint` or `Int`, written without the width, in the order of the target's colour buffers.
///
/// ```
/// # use pineda::*;
/// outputs! {
///     pub struct GBuffer {
///         pub albedo: Rgba,
///         pub normal: Vec3,
///         pub id: Uint,
///     }
/// }
/// # fn fragment<L: Lanes>(color: Rgba<L>, id: Uint<L>) -> GBuffer<L> { GBuffer { albedo: color, normal: color.rgb(), id } }
/// ```
#[macro_export]
macro_rules! outputs {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident {
        $($(#[$field_attribute:meta])* $field_visibility:vis $field:ident: $type:ident),+ $(,)?
    }) => {
        $(#[$attribute])*
        $visibility struct $name<L: $crate::Lanes = $crate::Scalar> {
            $($(#[$field_attribute])* $field_visibility $field: $type<L>),+
        }

        impl<L: $crate::Lanes> ::core::clone::Clone for $name<L> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }
        impl<L: $crate::Lanes> ::core::marker::Copy for $name<L> {}

        impl<L: $crate::Lanes> $crate::Outputs<L> for $name<L> {
            const KINDS: &'static [$crate::OutputKind] = &[$(<$type<L> as $crate::Output<L>>::KIND),+];
            #[inline(always)]
            fn write(self, first: &mut $crate::__Row4, more: &mut [$crate::__Row4]) {
                let mut at = 0;
                $(
                    let rows = if at == 0 { &mut *first } else { &mut more[at - 1] };
                    $crate::Output::<L>::write(self.$field, rows);
                    at += 1;
                )+
                let _ = at;
            }
        }
    };
}

macro_rules! single_outputs {
    ($($(#[$doc:meta])* $type:ident $kind:ident: |$value:ident, $rows:ident| $write:expr;)+) => {$(
        $(#[$doc])*
        impl<L: Lanes> Output<L> for $type<L> {
            const KIND: OutputKind = OutputKind::$kind;
            #[inline(always)]
            fn write(self, $rows: &mut Row4) {
                let $value = self;
                $write
            }
        }

        impl<L: Lanes> Outputs<L> for $type<L> {
            const KINDS: &'static [OutputKind] = &[OutputKind::$kind];
            #[inline(always)]
            fn write(self, first: &mut Row4, _: &mut [Row4]) {
                Output::write(self, first);
            }
        }
    )+};
}

single_outputs! {
    Rgba Float: |color, rows| floats::<L>([color.r, color.g, color.b, color.a], rows);
    Vec4 Float: |v, rows| floats::<L>([v.x, v.y, v.z, v.w], rows);
    Vec3 Float: |v, rows| floats::<L>([v.x, v.y, v.z, Real::new(v.x.lanes(), 1.0)], rows);
    Vec2 Float: |v, rows| {
        let lanes = v.x.lanes();
        floats::<L>([v.x, v.y, Real::new(lanes, 0.0), Real::new(lanes, 1.0)], rows);
    };
    Real Float: |x, rows| {
        let (zero, one) = (Real::new(x.lanes(), 0.0), Real::new(x.lanes(), 1.0));
        floats::<L>([x, zero, zero, one], rows);
    };
    RgbaU Uint: |color, rows| integers::<L>([color.r.0, color.g.0, color.b.0, color.a.0], rows);
    RgbaI Int: |color, rows| integers::<L>([color.r.0, color.g.0, color.b.0, color.a.0], rows);
    Uint Uint: |x, rows| integers::<L>([x.0, x.lanes().int(0), x.lanes().int(0), x.lanes().int(1)], rows);
    Int Int: |x, rows| integers::<L>([x.0, x.lanes().int(0), x.lanes().int(0), x.lanes().int(1)], rows);
}

#[inline(always)]
fn floats<L: Lanes>([r, g, b, a]: [Real<L>; 4], rows: &mut Row4) {
    L::store(r.0, &mut rows[0]);
    L::store(g.0, &mut rows[1]);
    L::store(b.0, &mut rows[2]);
    L::store(a.0, &mut rows[3]);
}

/// Bits as they are: nothing here is a float.
#[inline(always)]
fn integers<L: Lanes>([r, g, b, a]: [L::I; 4], rows: &mut Row4) {
    let rows: &mut [[i32; 16]; 4] = bytemuck::must_cast_mut(rows);
    L::store_int(r, &mut rows[0]);
    L::store_int(g, &mut rows[1]);
    L::store_int(b, &mut rows[2]);
    L::store_int(a, &mut rows[3]);
}

impl<L: Lanes> Outputs<L> for () {
    const KINDS: &'static [OutputKind] = &[];
    #[inline(always)]
    fn write(self, _: &mut Row4, _: &mut [Row4]) {}
}

impl<L: Lanes> Outputs<L> for DualSource<L> {
    const KINDS: &'static [OutputKind] = &[OutputKind::Float];
    const HAS_SECOND_SOURCE: bool = true;
    #[inline(always)]
    fn write(self, first: &mut Row4, more: &mut [Row4]) {
        Output::write(self.color, first);
        Output::write(self.factor, &mut more[0]);
    }
}

impl<L: Lanes, T: Output<L>, const N: usize> Outputs<L> for [T; N] {
    const KINDS: &'static [OutputKind] = &[T::KIND; N];
    #[inline(always)]
    fn write(self, first: &mut Row4, more: &mut [Row4]) {
        let mut k = 0;
        while k < N {
            self[k].write(if k == 0 { &mut *first } else { &mut more[k - 1] });
            k += 1;
        }
    }
}

macro_rules! tuple_outputs {
    ($($first:ident $($type:ident $at:tt $before:tt)*;)+) => {$(
        impl<L: Lanes, $first: Output<L>, $($type: Output<L>),*> Outputs<L> for ($first, $($type,)*) {
            const KINDS: &'static [OutputKind] = &[$first::KIND, $($type::KIND),*];
            #[inline(always)]
            fn write(self, first: &mut Row4, _more: &mut [Row4]) {
                self.0.write(first);
                $(self.$at.write(&mut _more[$before]);)*
            }
        }
    )+};
}

tuple_outputs! {
    A;
    A B 1 0;
    A B 1 0 C 2 1;
    A B 1 0 C 2 1 D 3 2;
    A B 1 0 C 2 1 D 3 2 E 4 3;
    A B 1 0 C 2 1 D 3 2 E 4 3 F 5 4;
    A B 1 0 C 2 1 D 3 2 E 4 3 F 5 4 G 6 5;
    A B 1 0 C 2 1 D 3 2 E 4 3 F 5 4 G 6 5 H 7 6;
}

/// What a draw's fragment stage returns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutputLayout {
    pub(crate) kinds: &'static [OutputKind],
    pub(crate) has_second_source: bool,
}

impl OutputLayout {
    pub(crate) const fn of<L: Lanes, O: Outputs<L>>() -> Self {
        Self { kinds: O::KINDS, has_second_source: O::HAS_SECOND_SOURCE }
    }

    /// How many [`Row4`]s there are beside the first.
    pub(crate) const fn more(&self) -> usize {
        (self.kinds.len() + self.has_second_source as usize).saturating_sub(1)
    }
}
