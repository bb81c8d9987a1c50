//! Derivatives of numbers that know them: those of the width [`Dual`].

use super::{Real, Rgba, Vec2, Vec3, Vec4};
use crate::lanes::{Dual, DualF, Lanes};

impl<L: Lanes> Real<L> {
    /// `self`, a function of `x` whose derivative there is `slope`. A function that takes numbers' bits apart must end with it, or [`Dual`] numbers get a derivative of 0.
    #[inline(always)]
    pub(crate) fn with_slope(self, x: Self, slope: Self) -> Self {
        Self(L::chain(self.0, x.0, slope.0))
    }

    /// The same of two numbers.
    #[inline(always)]
    pub(crate) fn with_slopes(self, [x, y]: [Self; 2], [by_x, by_y]: [Self; 2]) -> Self {
        Self(L::chain2(self.0, [x.0, y.0], [by_x.0, by_y.0]))
    }

    /// This value, with these derivatives.
    #[inline(always)]
    pub fn with_derivatives(self, dx: Self, dy: Self) -> Real<Dual<L>> {
        Real(DualF { value: self.0, dx: dx.0, dy: dy.0 })
    }
}

impl<L: Lanes> Real<Dual<L>> {
    /// The number without its derivatives.
    #[inline(always)]
    pub fn value(self) -> Real<L> {
        Real(self.0.value)
    }

    /// By how much it grows from a pixel to its right-hand neighbour: the derivative where the fragment is shaded, most often the pixel's centre. WGSL's `dpdxFine`, but exact.
    #[inline(always)]
    pub fn dx(self) -> Real<L> {
        Real(self.0.dx)
    }

    /// By how much it grows from a pixel to the one below. WGSL's `dpdyFine`, but exact.
    #[inline(always)]
    pub fn dy(self) -> Real<L> {
        Real(self.0.dy)
    }

    /// `|dx| + |dy|`: how much it changes over a pixel, at most. WGSL's `fwidthFine`.
    #[inline(always)]
    pub fn fwidth(self) -> Real<L> {
        self.dx().abs() + self.dy().abs()
    }
}

macro_rules! vectors {
    ($($vector:ident: $($field:ident)+;)+) => {$(
        impl<L: Lanes> $vector<L> {
            /// These values, with these derivatives.
            #[inline(always)]
            pub fn with_derivatives(self, dx: Self, dy: Self) -> $vector<Dual<L>> {
                $vector { $($field: self.$field.with_derivatives(dx.$field, dy.$field)),+ }
            }
        }

        impl<L: Lanes> $vector<Dual<L>> {
            /// The values without their derivatives.
            #[inline(always)]
            pub fn value(self) -> $vector<L> {
                $vector { $($field: self.$field.value()),+ }
            }

            /// By how much each grows from a pixel to its right-hand neighbour; see [`Real::dx`].
            #[inline(always)]
            pub fn dx(self) -> $vector<L> {
                $vector { $($field: self.$field.dx()),+ }
            }

            /// By how much each grows from a pixel to the one below.
            #[inline(always)]
            pub fn dy(self) -> $vector<L> {
                $vector { $($field: self.$field.dy()),+ }
            }

            /// `|dx| + |dy|` of each.
            #[inline(always)]
            pub fn fwidth(self) -> $vector<L> {
                $vector { $($field: self.$field.fwidth()),+ }
            }
        }
    )+};
}

vectors! {
    Vec2: x y;
    Vec3: x y z;
    Vec4: x y z w;
    Rgba: r g b a;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::conformance::shader_levels;
    use crate::lanes::{Packet, Scalar};
    use crate::wide::dispatch_shader;

    /// Each function of one number, at any width, and from where to where it is tried.
    macro_rules! functions {
        ($($x:ident, $from:literal..$to:literal => $function:expr, $truth:expr;)+) => {
            #[test]
            fn derivatives_are_those_of_calculus() {
                $({
                    let truth: fn(f64) -> f64 = |$x| $truth;
                    for k in 0..=1000 {
                        let at = $from + ($to - $from) * (k as f64 + 0.37) / 1001.0;
                        let x = at as f32;
                        let $x = Real::<Scalar>::from(x).with_derivatives(1.0.into(), (-2.0).into());
                        let found = $function;
                        let h = 1e-5 * f64::from(x).abs().max(1e-2);
                        let wanted = (truth(f64::from(x) + h) - truth(f64::from(x) - h)) / (2.0 * h);
                        let (dx, dy) = (f64::from(f32::from(found.dx())), f64::from(f32::from(found.dy())));
                        let scale = wanted.abs().max(0.01);
                        assert!((dx - wanted).abs() < 1e-4 * scale, "{} at {x}: {dx}, not {wanted}", stringify!($function));
                        assert!((dy + 2.0 * dx).abs() < 1e-5 * scale, "{} at {x}", stringify!($function));
                        let plain = { let $x = Real::<Scalar>::from(x); $function };
                        assert_eq!(found.value().0.to_bits(), plain.0.to_bits(), "{} at {x}: its value", stringify!($function));
                    }
                })+
            }
        };
    }

    functions! {
        x, -3.0..3.0 => x * x * 0.5 - 2.0 * x + 1.0, x * x * 0.5 - 2.0 * x + 1.0;
        x, 0.1..3.0 => 1.0 / x, 1.0 / x;
        x, -3.0..3.0 => (x + 1.0) / (x * x + 2.0), (x + 1.0) / (x * x + 2.0);
        x, 0.1..3.0 => x.sqrt(), x.sqrt();
        x, 0.1..3.0 => x.inverse_sqrt(), 1.0 / x.sqrt();
        x, -3.0..-0.01 => x.abs(), x.abs();
        x, 0.01..0.99 => x.fract(), x;
        x, 0.01..0.99 => x.modulo(0.3) + x.round_ties_even() + x.round() + x.trunc(), x;
        x, -3.0..3.0 => x.copysign(-1.0) + x.copysign(x), x - x.abs();
        x, 0.1..0.9 => x.smoothstep(0.0, 1.0), x * x * (3.0 - 2.0 * x);
        x, 0.6..2.0 => x.max(0.5).min(3.0), x;
        x, -3.0..3.0 => x.mix(2.0, 0.25), 0.75 * x + 0.5;
        x, 0.1..3.0 => x.powi(5), x.powi(5);
        x, 0.1..3.0 => x.powf(2.4), x.powf(2.4);
        x, 0.1..3.0 => (x * 0.5).powf(x), (x * 0.5).powf(x);
        x, 0.1..3.0 => x.cbrt() - (-x).cbrt(), 2.0 * x.cbrt();
        x, -3.0..3.0 => x.exp(), x.exp();
        x, -3.0..3.0 => x.exp2(), x.exp2();
        x, 0.1..3.0 => x.log(), x.ln();
        x, 0.1..3.0 => x.log2(), x.log2();
        x, -3.0..3.0 => x.sin(), x.sin();
        x, -3.0..3.0 => x.cos(), x.cos();
        x, -1.5..1.5 => x.tan(), x.tan();
        x, -0.99..0.99 => x.asin(), x.asin();
        x, -0.99..0.99 => x.acos(), x.acos();
        x, -3.0..3.0 => x.atan(), x.atan();
        x, -3.0..3.0 => (x * x + 0.1).atan2(x - 0.5), (x * x + 0.1).atan2(x - 0.5);
        x, 0.0..0.003 => x.linear_to_srgb(), 12.92 * x;
        x, 0.004..2.0 => x.linear_to_srgb(), 1.055 * x.powf(1.0 / 2.4) - 0.055;
        x, 0.0..0.04 => x.srgb_to_linear(), x / 12.92;
        x, 0.05..2.0 => x.srgb_to_linear(), ((x + 0.055) / 1.055).powf(2.4);
    }

    /// Everything that dual numbers can do.
    #[inline(always)]
    fn expression<L: Lanes>(x: Real<L>) -> Real<L> {
        let size = x.abs();
        let quotient = (size.sqrt() + 1.0) / (x * x + 0.5) - x.fract();
        quotient.abs().powf(size) + (-x).exp().min(5.0).max(x) + x.atan2(size - 1.0) + x.lt(0.5).select(x.tan(), x)
    }

    #[test]
    fn lanes_derive_as_numbers_do() {
        for level in shader_levels() {
            for k in 0..64 {
                let row: [f32; 16] = core::array::from_fn(|i| (16 * k + i) as f32 / 128.0 - 4.03);
                let (mut value, mut dx, mut dy) = ([0.0f32; 16], [0.0f32; 16], [0.0f32; 16]);
                dispatch_shader!(level, simd => {
                    let x = Real::load(Packet(simd), &row);
                    let found = expression(x.with_derivatives(x * 0.25 + 1.0, x - 3.0));
                    found.value().store(&mut value);
                    found.dx().store(&mut dx);
                    found.dy().store(&mut dy);
                });
                for i in 0..16 {
                    let x = Real::<Scalar>::from(row[i]);
                    let wanted = expression(x.with_derivatives(x * 0.25 + 1.0, x - 3.0));
                    let bits = [wanted.value(), wanted.dx(), wanted.dy()].map(|x| x.0.to_bits());
                    assert_eq!([value[i], dx[i], dy[i]].map(f32::to_bits), bits, "of {}, {level:?}", row[i]);
                }
            }
        }
    }

    #[test]
    fn vectors_derive_as_their_components_do() {
        let x = Vec3::<Scalar>::from([1.0, 2.0, 2.0]).with_derivatives([1.0, 0.0, 0.0].into(), [0.0, 1.0, -1.0].into());
        let length = x.length();
        assert_eq!([length.value(), length.dx(), length.dy()].map(f32::from), [3.0, 1.0 / 3.0, 0.0]);
        let along = x.normalize().dot(x);
        assert!((f32::from(along.value() - length.value())).abs() < 1e-6);
        assert!((f32::from(along.dx() - length.dx())).abs() < 1e-5);
        assert_eq!(<[f32; 3]>::from(x.fwidth()), [1.0, 1.0, 1.0]);
    }
}
