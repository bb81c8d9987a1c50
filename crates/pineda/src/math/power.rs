//! The logarithm to base 2, powers and the cube root.
//!
//! A power is 2^(n log2 x), and an exponential turns the absolute error of its argument, here up to 128, into a relative one: for a result that is
//! right to the last place the logarithm needs 2^-34. So it is computed in `f64`, by the series of the area tangent: with
//! s = (m - 1) / (m + 1), ln m = 2 (s + s³/3 + s⁵/5 + ...), cut off after five terms that `tools/minimax.py` fits. Special values: `exponential.rs`.

use super::double::{Double, polynomial};
use super::exponential::ROUND;
use super::{Real, ToLanes};
use crate::lanes::Lanes;
use crate::shader;
use core::f32::consts::{LN_2, LOG2_E};

impl<L: Lanes> Real<L> {
    /// The logarithm to base 2, to 0.51 ULP, and exact for powers of two. -infinity of 0 (and -0), NaN below 0.
    #[shader(apart)]
    pub fn log2(self) -> Self {
        let (exponent, x) = self.split();
        self.logarithm_in_range(log2_of_product(exponent, x, x.double()).round()).with_slope(self, LOG2_E / self)
    }

    /// `self` to the power of `n`, to 1 ULP. For a whole `n` that is known beforehand, [`powi`](Self::powi) is quicker.
    ///
    /// As IEEE 754's powr, but never NaN for `n` = 0: 1 where `n` is 0, whatever `self`; otherwise 0 to a positive power is 0 and to a negative
    /// one infinity, infinity the other way round, and a negative number gives NaN (use [`powi`](Self::powi)). 1 to an infinite power is NaN.
    /// Results below 2^-126 are 0.
    #[shader(apart)]
    pub fn powf(self, n: impl ToLanes<L, Self>) -> Self {
        let n = n.to_lanes(self.lanes());
        // Of -0 the logarithm would else be a positive number, and with a huge `n` infinite.
        let (exponent, x) = self.abs().split();
        let logarithm = log2_of_product(exponent, x, x.double());
        let t = n.double() * logarithm;
        let rounded = t.round();
        let shifted = rounded + ROUND;
        let fraction = (t - (shifted - ROUND).double()).round();
        let power = fraction.exp2_of_fraction().times_power_of_two(shifted).or_flushed();
        // For 0 and infinity, t has the right sign already; infinity of that sign, or NaN, makes the rest.
        let special = self.logarithm_in_range(Self::new(self.lanes(), 0.0));
        let power = n.eq(0.0).select(1.0, (rounded + special.times_sign_of(n)).in_range(-127.0, 129.0, power));
        // Where nothing is left of a number, its derivatives are 0, too, instead of 0 / 0.
        let vanishes = power.eq(0.0);
        let by_self = vanishes.select(0.0, power * n / self);
        let by_n = vanishes.select(0.0, power * (logarithm.round() * LN_2));
        power.with_slopes([self, n], [by_self, by_n])
    }

    /// The cube root, to 0.51 ULP; -0 and infinities stay what they are.
    #[shader(apart)]
    pub fn cbrt(self) -> Self {
        /// Puts a third of the exponent where the exponent belongs, so that the guess is within 4 % (Kahan 1991, "Computing a real cube root").
        const OFFSET: i32 = 709_958_130;
        let lanes = self.lanes();
        let size = self.abs();
        let subnormal = size.lt(f32::MIN_POSITIVE);
        let a = subnormal.select(size * 16_777_216.0, size); // 2^24
        let third = L::to_i((Self(L::to_f(L::f_bits(a.0))) * (1.0 / 3.0)).0);
        // Halley's iteration cubes the error.
        let guess = Self(L::bits_f(L::iadd(third, lanes.int(OFFSET)))).double();
        let root = halley(halley(guess, a.double()), a.double()).round() * subnormal.select(0.003_906_25, 1.0); // 2^-8
        let is_number = size.lt(f32::INFINITY) & size.gt(0.0);
        let root = is_number.select(root, size).times_sign_of(self);
        root.with_slope(self, 1.0 / (root * root * 3.0))
    }

    /// Infinity where a positive number's bits say more than that, 0 where they are those of a subnormal one.
    #[inline(always)]
    pub(super) fn or_flushed(self) -> Self {
        let lanes = self.lanes();
        let bits = L::f_bits(self.0);
        let (infinity, smallest) = (f32::INFINITY.to_bits(), f32::MIN_POSITIVE.to_bits());
        let fits = L::ilt(bits, lanes.int(infinity.cast_signed()));
        let bits = L::iselect(fits, bits, lanes.int(infinity.cast_signed()));
        let vanishes = L::ilt(bits, lanes.int(smallest.cast_signed()));
        Self(L::bits_f(L::iselect(vanishes, lanes.int(0), bits)))
    }

    /// `self`, its sign turned where that of `b` is negative; -0 and NaN have one, too.
    #[inline(always)]
    pub(super) fn times_sign_of(self, b: Self) -> Self {
        const ONE: i32 = 1.0f32.to_bits().cast_signed();
        let sign = L::iand(L::f_bits(b.0), self.lanes().int(i32::MIN));
        let turned = Self(L::bits_f(L::ixor(L::f_bits(self.0), sign)));
        turned.with_slope(self, Self(L::bits_f(L::ior(sign, self.lanes().int(ONE)))))
    }
}

#[inline(always)]
fn halley<L: Lanes>(root: Double<L>, a: Double<L>) -> Double<L> {
    let cube = root * root * root;
    root * (cube + a + a) / (cube + cube + a)
}

/// log2(2^exponent (1 + x)), with a relative error of 2^-37, for 1 + x from √½ to √2; `near` is x rounded.
#[inline(always)]
pub(super) fn log2_of_product<L: Lanes>(exponent: Real<L>, near: Real<L>, x: Double<L>) -> Double<L> {
    let divisor = x + 2.0;
    // A quotient of floats, and what it is wrong by: quicker than a division of doubles.
    let reciprocal = (1.0 / (near + 2.0)).double();
    let quotient = x * reciprocal;
    let s = quotient + (x - quotient * divisor) * reciprocal;
    let z = s * s;
    let series = polynomial!(
        z; 2.885_390_081_790_087, 0.961_796_673_341_399_8, 0.577_083_585_007_046, 0.411_672_717_458_062,
        0.340_730_124_957_856_04
    );
    s * series + exponent.double()
}

/// 2 to the power of `t`, as a whole exponent and a double from √½ to √2, with a relative error of 2^-34. `t` must be within 2^22 of 0.
#[inline(always)]
pub(super) fn exp2_of_double<L: Lanes>(t: Double<L>) -> (Real<L>, Double<L>) {
    let shifted = t.round() + ROUND;
    let x = t - (shifted - ROUND).double();
    let power = polynomial!(
        x; 0.999_999_999_961_680_2, 0.693_147_180_728_398_6, 0.240_226_511_981_748_7, 0.055_504_103_535_500_54,
        0.009_618_027_251_774_313, 0.001_333_392_249_861_936, 0.000_154_692_916_480_835_02, 1.520_193_442_378_478_9e-5
    );
    (shifted, power)
}
