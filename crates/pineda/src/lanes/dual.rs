//! Numbers with their derivatives: dual numbers (Clifford 1873; forward automatic differentiation), one derivative a pixel right, one a pixel down.
//!
//! A dual number is a value and how fast it changes. Every operation computes its result's change from those of its operands by the rules of calculus, so any
//! expression of varyings, however long, comes with its exact derivatives: no neighbouring pixel is asked, and no triangle's border is in the way. The values
//! are computed as without derivatives: the same operations, the same bits.

use super::{Lanes, sealed::Sealed};

/// Lanes whose numbers know their derivatives along x and y, in units per pixel: what a fragment stage gets from [`Frag::dual`](crate::Frag::dual).
///
/// It is a width like the others. `Real<Dual<L>>`, `Vec2<Dual<L>>`, ... have all the operators and methods that `Real<L>` and `Vec2<L>` have, and functions that
/// are generic over their width take them as they are. What comes out tells its derivatives: [`dx`](crate::Real::dx), [`dy`](crate::Real::dy),
/// [`fwidth`](crate::Real::fwidth), and its [`value`](crate::Real::value).
///
/// Plain numbers and uniforms do not change from pixel to pixel. Neither do `floor`, comparisons and whole numbers, where they are defined at all: the derivative of
/// `x.floor()` is 0, that of `x.fract()` is that of `x`, and `select` takes the derivative of the side that it chooses.
///
/// ```
/// use pineda::*;
///
/// struct Rings;
///
/// #[shader]
/// impl Shader for Rings {
///     type Vertex = [f32; 2];
///     type Varyings<L: Lanes> = Vec2<L>;
///     const DERIVATIVES: bool = true;
///     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, Vec2) {
///         ([x, y, 0.0, 1.0].into(), [x, y].into())
///     }
///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
///         // Rings that grow narrow, with borders one pixel soft however narrow they are.
///         let wave = (f.dual().length_squared() * 20.0).sin();
///         Rgba::gray((wave.value() / wave.fwidth() + 0.5).clamp(0.0, 1.0))
///     }
/// }
/// # let corners = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
/// # let mut pass = Pass::new();
/// # pass.draw(&Rings, Mesh { vertices: &corners, indices: Indices::Sequential }, DrawState::default());
/// # let mut pixels = vec![0u8; 64 * 64];
/// # let mut target = Target { color: ColorBuffer::R8(&mut pixels), ..Target::new(64, 64) };
/// # Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// # assert!(pixels.iter().any(|&p| p == 255) && pixels.iter().any(|&p| p == 0));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Dual<L: Lanes>(pub L);

/// Values and their derivatives, a lane each: the numbers of [`Dual`].
#[derive(Clone, Copy, Debug)]
pub struct DualF<L: Lanes> {
    pub(crate) value: L::F,
    pub(crate) dx: L::F,
    pub(crate) dy: L::F,
}

impl<L: Lanes> DualF<L> {
    /// What does not change.
    #[inline(always)]
    fn constant(value: L::F) -> Self {
        let zero = L::of(value).splat(0.0);
        Self { value, dx: zero, dy: zero }
    }
}

impl<L: Lanes> Sealed for Dual<L> {}

impl<L: Lanes> Lanes for Dual<L> {
    type F = DualF<L>;
    type M = L::M;
    type I = L::I;
    /// Without derivatives: functions that go this way end with `chain`, too.
    type D = L::D;

    const N: usize = L::N;

    #[inline(always)]
    fn of(a: DualF<L>) -> Self {
        Self(L::of(a.value))
    }
    #[inline(always)]
    fn of_mask(m: L::M) -> Self {
        Self(L::of_mask(m))
    }
    #[inline(always)]
    fn of_double(a: L::D) -> Self {
        Self(L::of_double(a))
    }
    #[inline(always)]
    fn apart<R>(self, f: impl FnOnce() -> R) -> R {
        self.0.apart(f)
    }

    #[inline(always)]
    fn splat(self, x: f32) -> DualF<L> {
        DualF::constant(self.0.splat(x))
    }
    #[inline(always)]
    fn load(self, a: &[f32]) -> DualF<L> {
        DualF::constant(self.0.load(a))
    }
    #[inline(always)]
    fn store(a: DualF<L>, out: &mut [f32]) {
        L::store(a.value, out);
    }
    #[inline(always)]
    fn iota(self) -> DualF<L> {
        DualF::constant(self.0.iota())
    }

    #[inline(always)]
    fn add(a: DualF<L>, b: DualF<L>) -> DualF<L> {
        DualF { value: L::add(a.value, b.value), dx: L::add(a.dx, b.dx), dy: L::add(a.dy, b.dy) }
    }
    #[inline(always)]
    fn sub(a: DualF<L>, b: DualF<L>) -> DualF<L> {
        DualF { value: L::sub(a.value, b.value), dx: L::sub(a.dx, b.dx), dy: L::sub(a.dy, b.dy) }
    }
    #[inline(always)]
    fn mul(a: DualF<L>, b: DualF<L>) -> DualF<L> {
        DualF {
            value: L::mul(a.value, b.value),
            dx: L::add(L::mul(a.dx, b.value), L::mul(a.value, b.dx)),
            dy: L::add(L::mul(a.dy, b.value), L::mul(a.value, b.dy)),
        }
    }
    #[inline(always)]
    fn div(a: DualF<L>, b: DualF<L>) -> DualF<L> {
        // (n / d)' = (n' - (n / d) d') / d.
        let value = L::div(a.value, b.value);
        DualF {
            value,
            dx: L::div(L::sub(a.dx, L::mul(value, b.dx)), b.value),
            dy: L::div(L::sub(a.dy, L::mul(value, b.dy)), b.value),
        }
    }
    #[inline(always)]
    fn neg(a: DualF<L>) -> DualF<L> {
        DualF { value: L::neg(a.value), dx: L::neg(a.dx), dy: L::neg(a.dy) }
    }
    #[inline(always)]
    fn abs(a: DualF<L>) -> DualF<L> {
        let below = L::lt(a.value, L::of(a.value).splat(0.0));
        DualF {
            value: L::abs(a.value),
            dx: L::select(below, L::neg(a.dx), a.dx),
            dy: L::select(below, L::neg(a.dy), a.dy),
        }
    }
    #[inline(always)]
    fn sqrt(a: DualF<L>) -> DualF<L> {
        let value = L::sqrt(a.value);
        let twice = L::add(value, value);
        DualF { value, dx: L::div(a.dx, twice), dy: L::div(a.dy, twice) }
    }
    #[inline(always)]
    fn floor(a: DualF<L>) -> DualF<L> {
        DualF::constant(L::floor(a.value))
    }

    #[inline(always)]
    fn double(self, x: f64) -> L::D {
        self.0.double(x)
    }
    #[inline(always)]
    fn widen(a: DualF<L>) -> L::D {
        L::widen(a.value)
    }
    #[inline(always)]
    fn narrow(a: L::D) -> DualF<L> {
        DualF::constant(L::narrow(a))
    }
    #[inline(always)]
    fn dadd(a: L::D, b: L::D) -> L::D {
        L::dadd(a, b)
    }
    #[inline(always)]
    fn dsub(a: L::D, b: L::D) -> L::D {
        L::dsub(a, b)
    }
    #[inline(always)]
    fn dmul(a: L::D, b: L::D) -> L::D {
        L::dmul(a, b)
    }
    #[inline(always)]
    fn ddiv(a: L::D, b: L::D) -> L::D {
        L::ddiv(a, b)
    }
    #[inline(always)]
    fn dsqrt(a: L::D) -> L::D {
        L::dsqrt(a)
    }

    #[inline(always)]
    fn lt(a: DualF<L>, b: DualF<L>) -> L::M {
        L::lt(a.value, b.value)
    }
    #[inline(always)]
    fn le(a: DualF<L>, b: DualF<L>) -> L::M {
        L::le(a.value, b.value)
    }
    #[inline(always)]
    fn eq(a: DualF<L>, b: DualF<L>) -> L::M {
        L::eq(a.value, b.value)
    }
    #[inline(always)]
    fn select(m: L::M, a: DualF<L>, b: DualF<L>) -> DualF<L> {
        DualF { value: L::select(m, a.value, b.value), dx: L::select(m, a.dx, b.dx), dy: L::select(m, a.dy, b.dy) }
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> L::M {
        self.0.mask(bits)
    }
    #[inline(always)]
    fn mask_bits(m: L::M) -> u32 {
        L::mask_bits(m)
    }
    #[inline(always)]
    fn and(a: L::M, b: L::M) -> L::M {
        L::and(a, b)
    }
    #[inline(always)]
    fn or(a: L::M, b: L::M) -> L::M {
        L::or(a, b)
    }
    #[inline(always)]
    fn xor(a: L::M, b: L::M) -> L::M {
        L::xor(a, b)
    }
    #[inline(always)]
    fn not(a: L::M) -> L::M {
        L::not(a)
    }
    #[inline(always)]
    fn any(a: L::M) -> bool {
        L::any(a)
    }

    #[inline(always)]
    fn int(self, x: i32) -> L::I {
        self.0.int(x)
    }
    #[inline(always)]
    fn load_int(self, a: &[i32]) -> L::I {
        self.0.load_int(a)
    }
    #[inline(always)]
    fn store_int(a: L::I, out: &mut [i32]) {
        L::store_int(a, out);
    }
    #[inline(always)]
    fn iadd(a: L::I, b: L::I) -> L::I {
        L::iadd(a, b)
    }
    #[inline(always)]
    fn isub(a: L::I, b: L::I) -> L::I {
        L::isub(a, b)
    }
    #[inline(always)]
    fn imul(a: L::I, b: L::I) -> L::I {
        L::imul(a, b)
    }
    #[inline(always)]
    fn iand(a: L::I, b: L::I) -> L::I {
        L::iand(a, b)
    }
    #[inline(always)]
    fn ior(a: L::I, b: L::I) -> L::I {
        L::ior(a, b)
    }
    #[inline(always)]
    fn ixor(a: L::I, b: L::I) -> L::I {
        L::ixor(a, b)
    }
    #[inline(always)]
    fn ishl(a: L::I, bits: u32) -> L::I {
        L::ishl(a, bits)
    }
    #[inline(always)]
    fn ishr(a: L::I, bits: u32) -> L::I {
        L::ishr(a, bits)
    }
    #[inline(always)]
    fn ieq(a: L::I, b: L::I) -> L::M {
        L::ieq(a, b)
    }
    #[inline(always)]
    fn ilt(a: L::I, b: L::I) -> L::M {
        L::ilt(a, b)
    }
    #[inline(always)]
    fn iselect(m: L::M, a: L::I, b: L::I) -> L::I {
        L::iselect(m, a, b)
    }

    #[inline(always)]
    fn to_i(a: DualF<L>) -> L::I {
        L::to_i(a.value)
    }
    #[inline(always)]
    fn to_f(a: L::I) -> DualF<L> {
        DualF::constant(L::to_f(a))
    }
    #[inline(always)]
    fn f_bits(a: DualF<L>) -> L::I {
        L::f_bits(a.value)
    }
    #[inline(always)]
    fn bits_f(a: L::I) -> DualF<L> {
        DualF::constant(L::bits_f(a))
    }
    #[inline(always)]
    fn chain(value: DualF<L>, x: DualF<L>, slope: DualF<L>) -> DualF<L> {
        DualF { value: value.value, dx: L::mul(slope.value, x.dx), dy: L::mul(slope.value, x.dy) }
    }
    #[inline(always)]
    fn chain2(value: DualF<L>, [x, y]: [DualF<L>; 2], [by_x, by_y]: [DualF<L>; 2]) -> DualF<L> {
        DualF {
            value: value.value,
            dx: L::add(L::mul(by_x.value, x.dx), L::mul(by_y.value, y.dx)),
            dy: L::add(L::mul(by_x.value, x.dy), L::mul(by_y.value, y.dy)),
        }
    }

    #[inline(always)]
    fn gather(table: &[u32], i: L::I) -> L::I {
        L::gather(table, i)
    }
    #[inline(always)]
    fn halves_of_pairs(self, pairs: &[u64]) -> (L::I, L::I) {
        self.0.halves_of_pairs(pairs)
    }
}
