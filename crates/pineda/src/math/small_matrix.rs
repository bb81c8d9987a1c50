//! Matrices that differ from lane to lane: tangent frames, turned texture coordinates, Jacobians.

use super::{Mat4, Real, Splat, Vec2, Vec3};
use crate::lanes::{Lanes, Scalar};
use core::ops::{Add, Mul, Sub};

/// A 2 x 2 matrix per lane, by its columns. `m * v` maps the column vector `v`, and `a * b` maps by `b` first.
pub struct Mat2<L: Lanes = Scalar> {
    /// Where (1, 0) goes.
    pub x: Vec2<L>,
    /// Where (0, 1) goes.
    pub y: Vec2<L>,
}

/// A 3 x 3 matrix per lane, by its columns. `m * v` maps the column vector `v`, and `a * b` maps by `b` first.
///
/// A tangent frame, say, whose columns are tangent, bitangent and normal: it maps what a normal map holds to the space that they are in. A matrix that
/// is a uniform is spread over the lanes: `f.splat(self.turn)` of a `[[f32; 3]; 3]`.
///
/// ```
/// use pineda::*;
/// let frame = Mat3::<Scalar>::from([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
/// assert_eq!(frame * Vec3::from([1.0, 2.0, 3.0]), Vec3::from([3.0, 1.0, 2.0]));
/// assert_eq!(frame.transpose() * (frame * Vec3::from([1.0, 2.0, 3.0])), Vec3::from([1.0, 2.0, 3.0]));
/// ```
pub struct Mat3<L: Lanes = Scalar> {
    /// Where (1, 0, 0) goes.
    pub x: Vec3<L>,
    /// Where (0, 1, 0) goes.
    pub y: Vec3<L>,
    /// Where (0, 0, 1) goes.
    pub z: Vec3<L>,
}

macro_rules! matrices {
    ($($matrix:ident $vector:ident $n:literal: $first:ident $($rest:ident)+;)+) => {$(
        impl<L: Lanes> $matrix<L> {
            /// From the columns.
            #[inline(always)]
            pub fn new($first: $vector<L>, $($rest: $vector<L>),+) -> Self {
                Self { $first, $($rest),+ }
            }

            /// The width of these numbers.
            #[inline(always)]
            pub fn lanes(self) -> L {
                self.$first.lanes()
            }

            /// The matrix that undoes this one: the adjugate over the determinant. Infinities and NaN where that is 0.
            #[inline(always)]
            pub fn inverse(self) -> Self {
                self.adjugate() * (1.0 / self.determinant())
            }
        }

        impl<L: Lanes> Clone for $matrix<L> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }
        impl<L: Lanes> Copy for $matrix<L> {}

        impl<L: Lanes> core::fmt::Debug for $matrix<L> {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_list().entry(&self.$first)$(.entry(&self.$rest))+.finish()
            }
        }
        impl PartialEq for $matrix<Scalar> {
            fn eq(&self, b: &Self) -> bool {
                self.$first == b.$first $(&& self.$rest == b.$rest)+
            }
        }

        impl From<[[f32; $n]; $n]> for $matrix<Scalar> {
            #[inline(always)]
            fn from(columns: [[f32; $n]; $n]) -> Self {
                columns.splat(Scalar)
            }
        }
        impl From<$matrix<Scalar>> for [[f32; $n]; $n] {
            #[inline(always)]
            fn from(m: $matrix<Scalar>) -> Self {
                [m.$first.into(), $(m.$rest.into()),+]
            }
        }
        impl<L: Lanes> Splat<L> for [[f32; $n]; $n] {
            type Output = $matrix<L>;
            #[inline(always)]
            fn splat(self, lanes: L) -> $matrix<L> {
                let [$first, $($rest),+] = self;
                $matrix { $first: $first.splat(lanes), $($rest: $rest.splat(lanes)),+ }
            }
        }

        impl<L: Lanes> Mul<$vector<L>> for $matrix<L> {
            type Output = $vector<L>;
            #[inline(always)]
            fn mul(self, v: $vector<L>) -> $vector<L> {
                self.$first * v.$first $(+ self.$rest * v.$rest)+
            }
        }
        impl<L: Lanes> Mul for $matrix<L> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, b: Self) -> Self {
                Self { $first: self * b.$first, $($rest: self * b.$rest),+ }
            }
        }
        impl<L: Lanes> Mul<Real<L>> for $matrix<L> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, b: Real<L>) -> Self {
                Self { $first: self.$first * b, $($rest: self.$rest * b),+ }
            }
        }
        impl<L: Lanes> Mul<f32> for $matrix<L> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, b: f32) -> Self {
                Self { $first: self.$first * b, $($rest: self.$rest * b),+ }
            }
        }
        impl<L: Lanes> Add for $matrix<L> {
            type Output = Self;
            #[inline(always)]
            fn add(self, b: Self) -> Self {
                Self { $first: self.$first + b.$first, $($rest: self.$rest + b.$rest),+ }
            }
        }
        impl<L: Lanes> Sub for $matrix<L> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, b: Self) -> Self {
                Self { $first: self.$first - b.$first, $($rest: self.$rest - b.$rest),+ }
            }
        }
    )+};
}

matrices! {
    Mat2 Vec2 2: x y;
    Mat3 Vec3 3: x y z;
}

impl<L: Lanes> Mat2<L> {
    /// Turns by `angle` radians, from x towards y.
    #[inline(always)]
    pub fn rotation(angle: Real<L>) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { x: Vec2::new(cos, sin), y: Vec2::new(-sin, cos) }
    }

    /// Rows and columns exchanged.
    #[inline(always)]
    pub fn transpose(self) -> Self {
        Self { x: Vec2::new(self.x.x, self.y.x), y: Vec2::new(self.x.y, self.y.y) }
    }

    /// How much larger areas become; negative where it mirrors.
    #[inline(always)]
    pub fn determinant(self) -> Real<L> {
        self.x.cross(self.y)
    }

    /// The inverse times the determinant.
    #[inline(always)]
    pub fn adjugate(self) -> Self {
        Self { x: Vec2::new(self.y.y, -self.x.y), y: Vec2::new(-self.y.x, self.x.x) }
    }
}

impl<L: Lanes> Mat3<L> {
    /// Rows and columns exchanged; of a rotation, the inverse.
    #[inline(always)]
    pub fn transpose(self) -> Self {
        let Self { x, y, z } = self;
        Self { x: Vec3::new(x.x, y.x, z.x), y: Vec3::new(x.y, y.y, z.y), z: Vec3::new(x.z, y.z, z.z) }
    }

    /// How much larger volumes become; negative where it mirrors.
    #[inline(always)]
    pub fn determinant(self) -> Real<L> {
        self.x.dot(self.y.cross(self.z))
    }

    /// The inverse times the determinant. Transposed, it maps normals where the matrix itself maps points (to other lengths).
    #[inline(always)]
    pub fn adjugate(self) -> Self {
        Self { x: self.y.cross(self.z), y: self.z.cross(self.x), z: self.x.cross(self.y) }.transpose()
    }
}

impl From<Mat4> for Mat3 {
    /// What it does to directions: the upper left 3 x 3.
    fn from(m: Mat4) -> Self {
        let [x, y, z, _] = m.0.map(|[x, y, z, _]| [x, y, z]);
        [x, y, z].into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const M: [[f32; 3]; 3] = [[2.0, 0.0, 1.0], [-1.0, 4.0, 0.5], [0.0, 8.0, -2.0]];

    #[test]
    fn products_and_transposes() {
        let m = Mat3::from(M);
        let v = Vec3::from([1.0, 2.0, 4.0]);
        assert_eq!(m * v, Vec3::from([0.0, 40.0, -6.0]));
        assert_eq!((m * m) * v, m * (m * v));
        assert_eq!((m * m).transpose(), m.transpose() * m.transpose());
        assert_eq!((m + m) - m, m * 1.0);
        let turn = Mat2::rotation(Real::from(core::f32::consts::FRAC_PI_2));
        assert_eq!((turn * Vec2::from([0.0, 1.0])).x, (-1.0).into());
    }

    #[test]
    fn inverses_undo() {
        let m = Mat3::from(M);
        assert_eq!(m.determinant(), (-32.0).into());
        assert_eq!(m.inverse() * m, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into());
        let m = Mat2::<Scalar>::from([[2.0, 1.0], [4.0, 4.0]]);
        assert_eq!(m.determinant(), 4.0.into());
        assert_eq!(m.inverse() * m, [[1.0, 0.0], [0.0, 1.0]].into());
    }

    #[test]
    fn a_normal_stays_at_right_angles() {
        let m = Mat3::from(M);
        let (a, b) = (Vec3::<Scalar>::from([1.0, 2.0, -1.0]), Vec3::from([3.0, -1.0, 1.0]));
        let normal = m.adjugate().transpose() * a.cross(b);
        assert_eq!([normal.dot(m * a), normal.dot(m * b)], [Real::default(); 2]);
    }
}
