//! How near the functions of `pineda`'s shaders come to the true values: `cargo xtask ulp`, and in short a test.
//!
//! The judge is the crate `libm` in `f64`: its functions are within one unit of the last of 53 bits, which is 2^-29 of an `f32`'s.
//! Where a true value and a result differ by more than what a function's documentation admits, it fails. A NaN must be a NaN, an infinity one, and a zero have
//! its sign. Of the functions that say that they give 0 instead of subnormal results, 0 is taken for right there.

use pineda::{Real, Scalar};

/// A function of one number.
#[derive(Debug)]
pub struct Function {
    /// Its name, as in `Real`.
    pub name: &'static str,
    /// What its documentation admits, in ULP.
    pub admitted: f64,
    /// The least and the greatest argument that its documentation speaks of; NaN counts, too.
    pub range: [f32; 2],
    /// Whether subnormal results are 0.
    pub flushes: bool,
    /// The function.
    pub ours: fn(Real) -> Real,
    /// The true function.
    pub exact: fn(f64) -> f64,
}

/// A function of two numbers.
#[derive(Debug)]
pub struct Function2 {
    /// Its name, as in `Real`.
    pub name: &'static str,
    /// What its documentation admits, in ULP.
    pub admitted: f64,
    /// Whether subnormal results are 0.
    pub flushes: bool,
    /// Arguments from 64 random bits.
    pub arguments: fn(u64) -> [f32; 2],
    /// The function.
    pub ours: fn(Real, Real) -> Real,
    /// The true function.
    pub exact: fn(f64, f64) -> f64,
}

const EVERYTHING: [f32; 2] = [f32::NEG_INFINITY, f32::INFINITY];

macro_rules! functions {
    ($($name:ident $admitted:literal $range:expr, $flushes:literal, $exact:expr;)+) => {
        [$(Function {
            name: stringify!($name),
            admitted: $admitted,
            range: $range,
            flushes: $flushes,
            ours: Real::$name,
            exact: $exact,
        }),+]
    };
}

/// Every function of one number whose accuracy is stated.
pub const FUNCTIONS: [Function; 15] = functions! {
    sqrt 0.5 EVERYTHING, false, f64::sqrt;
    inverse_sqrt 1.5 [f32::MIN_POSITIVE, f32::INFINITY], false, |x| 1.0 / x.sqrt();
    cbrt 0.51 EVERYTHING, false, libm::cbrt;
    exp 1.0 EVERYTHING, true, libm::exp;
    exp2 0.8 EVERYTHING, true, libm::exp2;
    log 1.0 EVERYTHING, false, |x| if x == 0.0 { f64::NEG_INFINITY } else { libm::log(x) };
    log2 0.51 EVERYTHING, false, |x| if x == 0.0 { f64::NEG_INFINITY } else { libm::log2(x) };
    sin 0.51 EVERYTHING, false, libm::sin;
    cos 0.51 EVERYTHING, false, libm::cos;
    tan 0.51 EVERYTHING, false, libm::tan;
    asin 0.51 EVERYTHING, false, libm::asin;
    acos 0.51 EVERYTHING, false, libm::acos;
    atan 0.51 EVERYTHING, false, libm::atan;
    linear_to_srgb 0.51 EVERYTHING, false, linear_to_srgb;
    srgb_to_linear 0.51 EVERYTHING, false, srgb_to_linear;
};

/// Every function of two numbers whose accuracy is stated.
pub const FUNCTIONS_2: [Function2; 2] = [
    Function2 {
        name: "powf",
        admitted: 1.0,
        flushes: true,
        arguments: power_arguments,
        ours: |x, n| x.powf(n),
        exact: powr,
    },
    Function2 {
        name: "atan2",
        admitted: 0.51,
        flushes: false,
        arguments: |bits| [f32::from_bits(bits as u32), f32::from_bits((bits >> 32) as u32)],
        ours: |y, x| y.atan2(x),
        exact: libm::atan2,
    },
];

/// What was found of a function.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst {
    /// The largest error, in ULP.
    pub ulps: f64,
    /// The bits of the argument or arguments.
    pub at: [f32; 2],
    /// Arguments that were tried.
    pub tried: u64,
    /// Results that were not the nearest float to the true value.
    pub not_nearest: u64,
}

impl Worst {
    /// The worse of the two, and the sums of the counts.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let worse = if other.ulps > self.ulps { other } else { self };
        Self { tried: self.tried + other.tried, not_nearest: self.not_nearest + other.not_nearest, ..worse }
    }

    fn add(&mut self, found: f32, exact: f64, flushes: bool, at: [f32; 2]) {
        let ulps = error(found, exact, flushes);
        self.tried += 1;
        self.not_nearest += u64::from(ulps > 0.5);
        if ulps > self.ulps {
            (self.ulps, self.at) = (ulps, at);
        }
    }
}

impl Function {
    /// The worst of the floats with the bits from `first` on, `count` of them in steps of `stride`, as far as they lie in the function's range.
    #[must_use]
    pub fn worst(&self, first: u64, count: u64, stride: usize) -> Worst {
        let mut worst = Worst::default();
        for bits in (first..first + count).step_by(stride) {
            let x = f32::from_bits(bits as u32);
            if x.is_nan() || (x >= self.range[0] && x <= self.range[1]) {
                let found = (self.ours)(Real::<Scalar>::from(x)).into();
                worst.add(found, (self.exact)(f64::from(x)), self.flushes, [x, 0.0]);
            }
        }
        worst
    }
}

impl Function2 {
    /// What it makes of a pair, by the pair's number.
    #[must_use]
    pub fn found(&self, number: u64) -> f32 {
        let [a, b] = (self.arguments)(random(number));
        (self.ours)(a.into(), b.into()).into()
    }

    /// The worst of `count` random pairs, numbered from `first` on.
    #[must_use]
    pub fn worst(&self, first: u64, count: u64) -> Worst {
        let mut worst = Worst::default();
        for number in first..first + count {
            let [a, b] = (self.arguments)(random(number));
            let found = self.found(number);
            worst.add(found, (self.exact)(f64::from(a), f64::from(b)), self.flushes, [a, b]);
        }
        worst
    }
}

/// The distance from the true value in units of the last place that an f32 of its size has.
#[must_use]
pub fn error(found: f32, exact: f64, flushes: bool) -> f64 {
    const WRONG: f64 = f64::INFINITY;
    const SMALLEST: f64 = f32::MIN_POSITIVE as f64;
    let nearest = exact as f32;
    if nearest.is_nan() || found.is_nan() {
        return if nearest.is_nan() == found.is_nan() { 0.0 } else { WRONG };
    }
    if nearest.is_infinite() || found.is_infinite() || exact == 0.0 {
        return if nearest.to_bits() == found.to_bits() { 0.0 } else { WRONG };
    }
    if flushes && exact.abs() < SMALLEST {
        return if found == 0.0 { 0.0 } else { WRONG };
    }
    let exponent = (exact.abs().max(SMALLEST).to_bits() >> 52) - 23;
    (f64::from(found) - exact).abs() / f64::from_bits(exponent << 52)
}

/// Steele et al.'s SplitMix64.
fn random(number: u64) -> u64 {
    let z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Half of them any two floats, half of them such that the power is mostly a number.
fn power_arguments(bits: u64) -> [f32; 2] {
    let (x, n) = (f32::from_bits(bits as u32), f32::from_bits((bits >> 32) as u32));
    if bits >> 63 == 0 {
        return [x, n];
    }
    let exponent = (f64::from((bits >> 32) as u32 & 0x7fff_ffff) / f64::from(1 << 30) - 1.0) * 130.0;
    let x = x.abs();
    [x, (exponent / libm::log2(f64::from(x))) as f32]
}

/// IEEE 754's powr, but 1 for n = 0.
fn powr(x: f64, n: f64) -> f64 {
    if n == 0.0 {
        1.0
    } else if x < 0.0 || (x == 1.0 && n.is_infinite()) || n.is_nan() || x.is_nan() {
        f64::NAN
    } else {
        libm::pow(x.abs(), n)
    }
}

fn linear_to_srgb(x: f64) -> f64 {
    if x <= f64::from(0.003_130_8_f32) { 12.92 * x } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 }
}

fn srgb_to_linear(x: f64) -> f64 {
    if x <= f64::from(0.040_45_f32) { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
}
