//! Sine, cosine and tangent, from polynomials of our own: the same bits everywhere, as in `exponential.rs`.
//!
//! The angle is brought to within an eighth of a turn of 0 by subtracting a multiple of a quarter turn (Cody and Waite, in `f64`: the
//! quarter turn comes in two parts, of which the first has so few bits that its multiples are exact), and the quadrant says which polynomial,
//! and with which sign. Angles of more than 2^18 take another way, one lane at a time: `huge_angle.rs`. The fits: `tools/minimax.py`.

use super::double::{Double, polynomial};
use super::exponential::ROUND;
use super::{Bool, Real, huge_angle};
use crate::lanes::Lanes;
use crate::shader;
use core::f32::consts::FRAC_2_PI;

/// π/2 in two parts: 33 bits, whose products with whole numbers below 2^18 are exact, and 53 more.
const QUARTER_HIGH: f64 = 1.570_796_326_734_125_6;
const QUARTER_LOW: f64 = 6.077_100_506_506_192e-11;

/// Up to here the quarter turns are counted right to a hundredth, which leaves the angle within the polynomials' range.
pub(super) const LARGEST: f32 = 262_144.0; // 2^18

impl<L: Lanes> Real<L> {
    /// The sine of `self` radians, to 0.51 ULP for every angle: from -1 to 1, -0 of -0, NaN of infinities and NaN. Beyond ±2^18 it takes
    /// longer, by a few nanoseconds for each lane.
    #[inline(always)]
    pub fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// The cosine of `self` radians, to 0.51 ULP for every angle: from -1 to 1, NaN of infinities and NaN.
    #[inline(always)]
    pub fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// Sine and cosine of `self` radians, for the price of one.
    #[shader(apart)]
    pub fn sin_cos(self) -> (Self, Self) {
        let (quadrant, x) = self.quadrant();
        let (sin, cos) = sin_cos_of_eighth(x);
        let (sin, cos) = (sin.round(), cos.round());
        let (first, second) = (quadrant.is_odd.select(cos, sin), quadrant.is_odd.select(sin, cos));
        // Quadrants 2 and 3 turn the sine's sign, 1 and 2 the cosine's: bit 1 of the quadrant, and of the next one.
        let next = L::iadd(quadrant.number, self.lanes().int(1));
        let sin_sign = Self(L::bits_f(L::ishl(quadrant.number, 30)));
        let cos_sign = Self(L::bits_f(L::ishl(next, 30)));
        let sin = first.times_sign_of(sin_sign).times_sign_of(self);
        let cos = second.times_sign_of(cos_sign);
        (sin.with_slope(self, cos), cos.with_slope(self, -sin))
    }

    /// The tangent of `self` radians, to 0.51 ULP for every angle: -0 of -0, NaN of infinities and NaN. No float is an odd multiple of a quarter
    /// turn, so it is always finite.
    #[shader(apart)]
    pub fn tan(self) -> Self {
        let (quadrant, x) = self.quadrant();
        let (sin, cos) = sin_cos_of_eighth(x);
        // In odd quadrants they change places, and the sign turns. Products with 0 and 1 are exact, where a difference that is added to one and taken from the other would leave
        // too little of a sine near 0: 0.61 ULP of the tangent of the float that is nearest to a pole.
        let odd = quadrant.is_odd.select(1.0, 0.0).double();
        let even = quadrant.is_odd.select(0.0, 1.0).double();
        let tangent = ((sin * even + cos * odd) / (cos * even + sin * odd)).round();
        let odd_sign = Self(L::bits_f(L::ishl(quadrant.number, 31)));
        let tangent = tangent.times_sign_of(odd_sign).times_sign_of(self);
        tangent.with_slope(self, tangent * tangent + 1.0)
    }

    /// The quadrant that `|self|` lies in, counted from the one around 0, and the angle from its middle: at most an eighth of a turn and a
    /// hundredth more; NaN for infinities and NaN.
    #[inline(always)]
    fn quadrant(self) -> (Quadrant<L>, Double<L>) {
        let lanes = self.lanes();
        let angle = self.abs();
        let shifted = angle * FRAC_2_PI + ROUND;
        let quarters = (shifted - ROUND).double();
        let mut number = L::f_bits(shifted.0);
        let mut x = angle.double() - quarters * QUARTER_HIGH - quarters * QUARTER_LOW;
        let huge = angle.gt(LARGEST);
        if huge.any() {
            let mut angles = [0.0; 16];
            huge.select(angle, 0.0).store(&mut angles);
            let reduced = huge_angle::reduce(angles);
            // The other lanes get 0 added to what they are, so that they do not depend on their neighbours.
            let [high, low] = [Self::load(lanes, &reduced.high), Self::load(lanes, &reduced.low)];
            x = x * huge.select(0.0, 1.0).double() + (high.double() + low.double());
            number = L::iselect(huge.0, lanes.load_int(&reduced.quadrants), number);
        }
        let one = lanes.int(1);
        (Quadrant { number, is_odd: Bool(L::ieq(L::iand(number, one), one)) }, x)
    }
}

struct Quadrant<L: Lanes> {
    /// Its lowest two bits count.
    number: L::I,
    is_odd: Bool<L>,
}

/// Sine and cosine of an angle of at most an eighth of a turn and a bit, with relative errors of 2^-36 and 2^-33.
#[inline(always)]
fn sin_cos_of_eighth<L: Lanes>(x: Double<L>) -> (Double<L>, Double<L>) {
    let z = x * x;
    let sin = x * polynomial!(
        z; 0.999_999_999_993_870_1, -0.166_666_666_207_195_28, 0.008_333_327_785_387_18, -0.000_198_389_153_925_954_9,
        2.714_806_604_994_139_3e-6
    );
    let cos = polynomial!(
        z; 0.999_999_999_923_868_1, -0.499_999_994_537_233_5, 0.041_666_602_616_974_69, -0.001_388_622_763_286_853_2,
        2.434_624_515_769_590_2e-5
    );
    (sin, cos)
}
