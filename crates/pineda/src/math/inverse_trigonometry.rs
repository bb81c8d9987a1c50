//! The inverse trigonometric functions, from polynomials of our own: the same bits everywhere.
//!
//! Computed in `f64` and rounded once. For the arc tangent the octant is turned to the first one, and there once more by an eighth of a turn where
//! that makes it smaller: tan(a - π/4) = (tan a - 1) / (1 + tan a). For the arc sine's upper half: asin x = π/2 - 2 asin √((1 - x) / 2). What
//! lanes choose between are numbers 0, 1, 2 that they multiply with, for that costs less than choosing between doubles. The fits: `tools/minimax.py`.

use super::double::{Double, polynomial};
use super::{Bool, Real, ToLanes};
use crate::lanes::Lanes;
use crate::shader;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// tan(π/8).
const TAN_PI_8: f32 = 0.414_213_57;

impl<L: Lanes> Real<L> {
    /// The angle whose sine `self` is, from -π/2 to π/2, to 0.51 ULP; -0 of -0, NaN beyond ±1.
    #[shader(apart)]
    pub fn asin(self) -> Self {
        let (is_upper, angle) = self.arc_of_size();
        let angle = angle * is_upper.select(-2.0, 1.0).double() + is_upper.select(1.0, 0.0).double() * FRAC_PI_2;
        let angle = angle.round().times_sign_of(self);
        angle.with_slope(self, 1.0 / (1.0 - self * self).sqrt())
    }

    /// The angle whose cosine `self` is, from 0 to π, to 0.51 ULP; NaN beyond ±1.
    #[shader(apart)]
    pub fn acos(self) -> Self {
        let (is_upper, angle) = self.arc_of_size();
        let is_negative = self.lt(0.0);
        // In units of a quarter turn: 0 + 2a from 1/2 on, 1 - a below, 1 + a and 2 - 2a on the negative side.
        let quarters = is_upper.select(is_negative.select(2.0, 0.0), 1.0);
        let factor = is_upper.select(-2.0, 1.0) * is_negative.select(1.0, -1.0);
        let angle = (angle * factor.double() + quarters.double() * FRAC_PI_2).round();
        angle.with_slope(self, -1.0 / (1.0 - self * self).sqrt())
    }

    /// The angle whose tangent `self` is, from -π/2 to π/2, to 0.51 ULP; -0 of -0, ±π/2 of ±infinity.
    #[shader(apart)]
    pub fn atan(self) -> Self {
        let size = self.abs();
        let is_steep = size.gt(1.0);
        let angle = arc_of_quotient(is_steep.select(1.0, size), is_steep.select(size.min(f32::MAX), 1.0));
        let angle = angle * is_steep.select(-1.0, 1.0).double() + is_steep.select(1.0, 0.0).double() * FRAC_PI_2;
        let angle = angle.round().times_sign_of(self);
        angle.with_slope(self, 1.0 / (self * self + 1.0))
    }

    /// The angle from the x axis to the point (`x`, `self`), from -π to π, to 0.51 ULP: `y.atan2(x)`, as in C and Rust.
    ///
    /// As C99's Annex F has it: of zeros and infinities it is the angle that their signs say, a multiple of an eighth of a turn; NaN where either is NaN.
    #[shader(apart)]
    pub fn atan2(self, x: impl ToLanes<L, Self>) -> Self {
        let lanes = self.lanes();
        let x = x.to_lanes(lanes);
        let (width, height) = (x.abs(), self.abs());
        let is_steep = height.gt(width);
        let (small, large) = (is_steep.select(width, height), is_steep.select(height, width));
        // 0 / 0 is 0 here, and infinity / infinity 1.
        let is_odd = large.eq(0.0) | large.eq(f32::INFINITY);
        let small = is_odd.select(small.eq(f32::INFINITY).select(1.0, 0.0), small);
        let angle = arc_of_quotient(small, is_odd.select(1.0, large));
        // A sign bit: of -0, too.
        let is_left = Bool(L::ilt(L::f_bits(x.0), lanes.int(0)));
        // In quarter turns: a, 1 - a, 1 + a, 2 - a, from the right to the left.
        let quarters = is_steep.select(1.0, is_left.select(2.0, 0.0));
        let factor = (is_steep ^ is_left).select(-1.0, 1.0);
        let angle = (angle * factor.double() + quarters.double() * FRAC_PI_2).round();
        let angle = (self.ne(self) | x.ne(x)).select(f32::NAN, angle.times_sign_of(self));
        let squared = x * x + self * self;
        angle.with_slopes([self, x], [x / squared, -self / squared])
    }

    /// Where `|self|` is at most 1/2, its arc sine; above, that of √((1 - |self|) / 2). NaN beyond 1.
    #[inline(always)]
    fn arc_of_size(self) -> (Bool<L>, Double<L>) {
        let size = self.abs();
        let is_upper = size.gt(0.5);
        // The difference is exact.
        let root = is_upper.select((1.0 - size) * 0.5, 0.0).double().sqrt();
        let s = root + is_upper.select(0.0, size).double();
        let z = s * s;
        let series = polynomial!(
            z; 0.999_999_999_984_904, 0.166_666_674_216_533_28, 0.074_999_381_994_733_55, 0.044_662_035_491_090_03,
            0.030_092_209_591_920_525, 0.024_711_541_946_862_772, 0.007_223_827_813_736_927, 0.034_951_557_847_716_44
        );
        (is_upper, s * series)
    }
}

/// The arc tangent of `small / large`, for 0 <= small <= large, with a relative error of 2^-35.
#[inline(always)]
fn arc_of_quotient<L: Lanes>(small: Real<L>, large: Real<L>) -> Double<L> {
    let turns = small.gt(large * TAN_PI_8).select(1.0, 0.0).double();
    let (small, large) = (small.double(), large.double());
    let t = (small - turns * large) / (large + turns * small);
    let z = t * t;
    let series = polynomial!(
        z; 0.999_999_999_979_280_6, -0.333_333_321_343_068_26, 0.199_998_863_265_663_55, -0.142_816_496_959_275_26,
        0.110_411_693_198_083_12, -0.084_596_950_575_313_68, 0.047_141_152_296_250_46
    );
    t * series + turns * FRAC_PI_4
}
