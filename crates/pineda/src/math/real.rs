//! A number per lane.

use super::{Bool, ToLanes};
use crate::lanes::{Lanes, Scalar};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// One number per lane: an `f32` for each fragment of the packet.
///
/// It mixes with plain `f32` on either side of `+ - * /`, and as an argument of every method: `0.1 + 0.9 * light`,
/// `light.max(0.0)`. Only where nothing but plain numbers is at hand, such as the start of a sum, does one ask the
/// fragment for one: `f.splat(0.0)`.
///
/// Comparisons give a [`Bool`], a yes or no per lane, so there is no `if light > 0.5`; write
/// `light.gt(0.5).select(bright, dark)`.
///
/// The methods of a plain `f32` (`sin`, `powf`, `exp`, ...) are *not* those of this type: their last bits depend on the
/// platform. Where a fragment stage needs such a function of a uniform, compute it once, when the shader is made, or
/// write `f.splat(self.roughness).powf(2.2)`.
pub struct Real<L: Lanes = Scalar>(pub(crate) L::F);

impl<L: Lanes> Real<L> {
    /// `x` in every lane. Inside a fragment stage [`Frag::splat`](crate::Frag::splat) is shorter.
    #[inline(always)]
    pub fn new(lanes: L, x: f32) -> Self {
        Self(lanes.splat(x))
    }

    /// The lanes from the first `N` numbers of `a`: 1 or 16. Panics if there are fewer.
    #[inline(always)]
    pub fn load(lanes: L, a: &[f32]) -> Self {
        Self(lanes.load(a))
    }

    /// Writes the lanes to the first `N` places of `out`: 1 or 16. Panics if there are fewer.
    #[inline(always)]
    pub fn store(self, out: &mut [f32]) {
        L::store(self.0, out);
    }

    /// The width of this number.
    #[inline(always)]
    pub fn lanes(self) -> L {
        L::of(self.0)
    }

    /// The larger of the two, and `b` where `self` is NaN: so `x.max(0.0)` is never NaN. (Where only `b` is NaN the
    /// result is NaN; of 0 and -0, `b`.)
    #[inline(always)]
    pub fn max(self, b: impl ToLanes<L, Self>) -> Self {
        let b = b.to_lanes(self.lanes());
        Self(L::max(self.0, b.0))
    }

    /// The smaller of the two, and `b` where `self` is NaN.
    #[inline(always)]
    pub fn min(self, b: impl ToLanes<L, Self>) -> Self {
        let b = b.to_lanes(self.lanes());
        Self(L::min(self.0, b.0))
    }

    /// `self.max(low).min(high)`: NaN gives `low`, and `high` wins where `low > high`.
    #[inline(always)]
    pub fn clamp(self, low: impl ToLanes<L, Self>, high: impl ToLanes<L, Self>) -> Self {
        self.max(low).min(high)
    }

    /// `self` clamped to 0 and 1: 0 of NaN.
    #[inline(always)]
    pub fn saturate(self) -> Self {
        self.clamp(0.0, 1.0)
    }

    /// `|self|`.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self(L::abs(self.0))
    }

    /// -1, 0 or 1; 0 for -0, NaN for NaN.
    #[inline(always)]
    pub fn sign(self) -> Self {
        let lanes = self.lanes();
        let (zero, one, minus_one) = (lanes.splat(0.0), lanes.splat(1.0), lanes.splat(-1.0));
        // NaN is neither above nor below zero, nor equal to it: it falls through to itself.
        let not_negative = L::select(L::lt(zero, self.0), one, L::select(L::eq(self.0, zero), zero, self.0));
        Self(L::select(L::lt(self.0, zero), minus_one, not_negative))
    }

    /// `|self|` with the sign of `b`, of which -0 and NaN have one, too: Rust's `copysign`.
    #[inline(always)]
    pub fn copysign(self, b: impl ToLanes<L, Self>) -> Self {
        self.abs().times_sign_of(b.to_lanes(self.lanes()))
    }

    /// The square root, correctly rounded; NaN below 0.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self(L::sqrt(self.0))
    }

    /// The largest whole number that is not above `self`.
    #[inline(always)]
    pub fn floor(self) -> Self {
        Self(L::floor(self.0))
    }

    /// The smallest whole number that is not below `self`.
    #[inline(always)]
    pub fn ceil(self) -> Self {
        Self(L::neg(L::floor(L::neg(self.0))))
    }

    /// The nearest whole number, halves away from 0, as Rust's `round`.
    #[inline(always)]
    pub fn round(self) -> Self {
        // What is left of a truncated number is exact, so a half is seen as one.
        let whole = self.trunc();
        let rest = (self - whole).abs();
        whole + rest.ge(0.5).select(1.0, 0.0).copysign(self)
    }

    /// The nearest whole number, halves to the even one: WGSL's `round`, GLSL's `roundEven`.
    #[inline(always)]
    pub fn round_ties_even(self) -> Self {
        /// From here on every float is whole; below, a sum with it has no room for a fraction.
        const WHOLE: f32 = 8_388_608.0; // 2^23
        let size = self.abs();
        // The sign last: choosing between `self` and what has its sign, LLVM 22 makes one AVX-512 instruction of both, and a wrong one.
        let whole = size.lt(WHOLE).select((size + WHOLE) - WHOLE, size).copysign(self);
        whole.with_slope(self, Self::new(self.lanes(), 0.0))
    }

    /// `self` without its fraction: the next whole number towards 0.
    #[inline(always)]
    pub fn trunc(self) -> Self {
        self.abs().floor().copysign(self)
    }

    /// `self - self.floor()`: from 0 up to 1 (which tiny negative numbers round to); NaN of an infinity.
    #[inline(always)]
    pub fn fract(self) -> Self {
        self - self.floor()
    }

    /// `self - b * (self / b).floor()`, GLSL's `mod`: for a positive `b` from 0 up to `b`, also where `self` is negative (up to rounding).
    #[inline(always)]
    pub fn modulo(self, b: impl ToLanes<L, Self>) -> Self {
        let b = b.to_lanes(self.lanes());
        self - b * (self / b).floor()
    }

    /// `self` degrees in radians.
    #[inline(always)]
    pub fn to_radians(self) -> Self {
        self * (core::f32::consts::PI / 180.0)
    }

    /// `self` radians in degrees.
    #[inline(always)]
    pub fn to_degrees(self) -> Self {
        const DEGREES: f32 = 57.295_78; // 180 / π
        self * DEGREES
    }

    /// `1 / self`, correctly rounded.
    #[inline(always)]
    pub fn recip(self) -> Self {
        1.0 / self
    }

    /// `self * self`.
    #[inline(always)]
    pub fn squared(self) -> Self {
        self * self
    }

    /// `self` to a whole power, by repeated squaring: correct to about `n / 2` ULP. 1 for `n = 0`, even of NaN.
    #[inline(always)]
    pub fn powi(self, n: u32) -> Self {
        if n == 0 {
            return Self::new(self.lanes(), 1.0);
        }
        // Squares up to the lowest set bit of n first, so that the product starts with a factor and not with 1.
        let (mut square, mut n) = (self, n);
        while n & 1 == 0 {
            square = square * square;
            n >>= 1;
        }
        let mut product = square;
        n >>= 1;
        while n > 0 {
            square = square * square;
            if n & 1 == 1 {
                product *= square;
            }
            n >>= 1;
        }
        product
    }

    /// `self + (b - self) * t`: from `self` at `t = 0` to `b` (up to rounding) at `t = 1`, and beyond for other `t`.
    #[inline(always)]
    pub fn mix(self, b: impl ToLanes<L, Self>, t: impl ToLanes<L, Self>) -> Self {
        let lanes = self.lanes();
        self + (b.to_lanes(lanes) - self) * t.to_lanes(lanes)
    }

    /// [`mix`](Self::mix) by its other name.
    #[inline(always)]
    pub fn lerp(self, b: impl ToLanes<L, Self>, t: impl ToLanes<L, Self>) -> Self {
        self.mix(b, t)
    }

    /// 0 below `edge`, 1 from it on; `x.step(edge)` is GLSL's `step(edge, x)`. 1 for NaN.
    #[inline(always)]
    pub fn step(self, edge: impl ToLanes<L, Self>) -> Self {
        self.lt(edge).select(0.0, 1.0)
    }

    /// 0 up to `low`, 1 from `high` on, and the cubic 3t² - 2t³ between; GLSL's `smoothstep(low, high, x)`. Where
    /// `low == high` it is 0 up to there and 1 above. 0 for NaN.
    #[inline(always)]
    pub fn smoothstep(self, low: impl ToLanes<L, Self>, high: impl ToLanes<L, Self>) -> Self {
        let lanes = self.lanes();
        let (low, high) = (low.to_lanes(lanes), high.to_lanes(lanes));
        let t = ((self - low) / (high - low)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }

    /// Whether it is NaN.
    #[inline(always)]
    pub fn is_nan(self) -> Bool<L> {
        self.ne(self)
    }

    /// Whether it is infinity or -infinity.
    #[inline(always)]
    pub fn is_infinite(self) -> Bool<L> {
        self.abs().eq(f32::INFINITY)
    }

    /// Whether it is neither infinite nor NaN.
    #[inline(always)]
    pub fn is_finite(self) -> Bool<L> {
        self.abs().lt(f32::INFINITY)
    }

    /// `self < b`; no where either is NaN.
    #[inline(always)]
    pub fn lt(self, b: impl ToLanes<L, Self>) -> Bool<L> {
        Bool(L::lt(self.0, b.to_lanes(self.lanes()).0))
    }

    /// `self <= b`; no where either is NaN.
    #[inline(always)]
    pub fn le(self, b: impl ToLanes<L, Self>) -> Bool<L> {
        Bool(L::le(self.0, b.to_lanes(self.lanes()).0))
    }

    /// `self > b`; no where either is NaN.
    #[inline(always)]
    pub fn gt(self, b: impl ToLanes<L, Self>) -> Bool<L> {
        Bool(L::lt(b.to_lanes(self.lanes()).0, self.0))
    }

    /// `self >= b`; no where either is NaN.
    #[inline(always)]
    pub fn ge(self, b: impl ToLanes<L, Self>) -> Bool<L> {
        Bool(L::le(b.to_lanes(self.lanes()).0, self.0))
    }

    /// `self == b`; no where either is NaN.
    #[inline(always)]
    pub fn eq(self, b: impl ToLanes<L, Self>) -> Bool<L> {
        Bool(L::eq(self.0, b.to_lanes(self.lanes()).0))
    }

    /// Not [`eq`](Self::eq): yes where either is NaN.
    #[inline(always)]
    pub fn ne(self, b: impl ToLanes<L, Self>) -> Bool<L> {
        !self.eq(b)
    }
}

impl<L: Lanes> Clone for Real<L> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<L: Lanes> Copy for Real<L> {}

impl<L: Lanes> core::fmt::Debug for Real<L> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0.fmt(f)
    }
}

impl Default for Real<Scalar> {
    fn default() -> Self {
        Self(0.0)
    }
}
impl PartialEq for Real<Scalar> {
    fn eq(&self, b: &Self) -> bool {
        self.0 == b.0
    }
}
impl From<f32> for Real<Scalar> {
    #[inline(always)]
    fn from(x: f32) -> Self {
        Self(x)
    }
}
impl From<Real<Scalar>> for f32 {
    #[inline(always)]
    fn from(x: Real<Scalar>) -> Self {
        x.0
    }
}

impl<L: Lanes> Neg for Real<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(L::neg(self.0))
    }
}

macro_rules! operator {
    ($($operator:ident $function:ident $assign:ident $assign_function:ident),+) => {$(
        impl<L: Lanes> $operator for Real<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: Self) -> Self {
                Self(L::$function(self.0, b.0))
            }
        }
        impl<L: Lanes> $operator<f32> for Real<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: f32) -> Self {
                Self(L::$function(self.0, L::of(self.0).splat(b)))
            }
        }
        impl<L: Lanes> $operator<Real<L>> for f32 {
            type Output = Real<L>;
            #[inline(always)]
            fn $function(self, b: Real<L>) -> Real<L> {
                Real(L::$function(L::of(b.0).splat(self), b.0))
            }
        }
        impl<L: Lanes, B: ToLanes<L, Self>> $assign<B> for Real<L> {
            #[inline(always)]
            fn $assign_function(&mut self, b: B) {
                self.0 = L::$function(self.0, b.to_lanes(L::of(self.0)).0);
            }
        }
    )+};
}

operator!(
    Add add AddAssign add_assign,
    Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign,
    Div div DivAssign div_assign
);
