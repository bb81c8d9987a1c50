//! 4 x 4 matrices of plain `f32`: what carries vertices from one space to the next.

use super::Vec4;
use crate::lanes::Lanes;
use core::ops::Mul;

/// A 4 x 4 matrix: four columns of plain `f32`, the same for every lane. `m * v` maps the column vector `v`, and
/// `a * b` maps by `b` first.
///
/// The constructors, the products and the inverse compute in `f64`, with `libm`'s functions, and round each element
/// once, so a camera has the same bits on every platform. `matrix * vector` is `f32`, summed from the first column on.
///
/// The views and projections ([`look_at`](Self::look_at), [`perspective`](Self::perspective),
/// [`orthographic`](Self::orthographic)) are here too:
///
/// ```
/// # use pineda::{Mat4, Vec3, Vec4};
/// let view = Mat4::look_at([0.0, 1.0, 3.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
/// let camera = Mat4::perspective(0.8, 16.0 / 9.0, 0.1, 100.0) * view;
/// let clip = camera * Vec3::from([0.0, 1.0, 0.0]).extend(1.0);
/// assert_eq!((clip.x, clip.y, clip.w), (0.0.into(), 0.0.into(), 3.0.into()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mat4(pub [[f32; 4]; 4]);

impl Mat4 {
    /// Maps every vector to itself.
    pub const IDENTITY: Self =
        Self([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);

    /// Moves points by `by`, and leaves directions (w = 0) alone.
    #[must_use]
    pub const fn translation(by: [f32; 3]) -> Self {
        let [x, y, z] = by;
        Self([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [x, y, z, 1.0]])
    }

    /// Stretches along the axes.
    #[must_use]
    pub const fn scale(by: [f32; 3]) -> Self {
        let [x, y, z] = by;
        Self([[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0], [0.0, 0.0, 0.0, 1.0]])
    }

    /// Turns about the x axis, from y towards z.
    #[must_use]
    pub fn rotation_x(radians: f32) -> Self {
        let (sin, cos) = sin_cos(radians);
        Self([[1.0, 0.0, 0.0, 0.0], [0.0, cos, sin, 0.0], [0.0, -sin, cos, 0.0], [0.0, 0.0, 0.0, 1.0]])
    }

    /// Turns about the y axis, from z towards x.
    #[must_use]
    pub fn rotation_y(radians: f32) -> Self {
        let (sin, cos) = sin_cos(radians);
        Self([[cos, 0.0, -sin, 0.0], [0.0, 1.0, 0.0, 0.0], [sin, 0.0, cos, 0.0], [0.0, 0.0, 0.0, 1.0]])
    }

    /// Turns about the z axis, from x towards y.
    #[must_use]
    pub fn rotation_z(radians: f32) -> Self {
        let (sin, cos) = sin_cos(radians);
        Self([[cos, sin, 0.0, 0.0], [-sin, cos, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
    }

    /// Rows and columns exchanged. `m.inverse()?.transpose()` is the matrix for normals where `m` is the one for points.
    #[must_use]
    pub const fn transpose(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([[a[0], b[0], c[0], d[0]], [a[1], b[1], c[1], d[1]], [a[2], b[2], c[2], d[2]], [a[3], b[3], c[3], d[3]]])
    }

    /// The matrix that undoes this one; `None` where none does (the determinant is 0, or not finite).
    #[must_use]
    pub fn inverse(self) -> Option<Self> {
        let m = self.to_f64();
        // Laplace's expansion by the 2 x 2 minors of the first two columns, and of the last two. (Written for rows, the
        // formula is the same: the inverse of the transpose is the transpose of the inverse.)
        let minor = |a: [f64; 4], b: [f64; 4], [i, k]: [usize; 2]| a[i] * b[k] - a[k] * b[i];
        const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        let s = PAIRS.map(|rows| minor(m[0], m[1], rows));
        let c = PAIRS.map(|rows| minor(m[2], m[3], rows));
        let determinant = s[0] * c[5] - s[1] * c[4] + s[2] * c[3] + s[3] * c[2] - s[4] * c[1] + s[5] * c[0];
        if determinant == 0.0 || !determinant.is_finite() {
            return None;
        }
        let adjugate = [
            [
                m[1][1] * c[5] - m[1][2] * c[4] + m[1][3] * c[3],
                -m[0][1] * c[5] + m[0][2] * c[4] - m[0][3] * c[3],
                m[3][1] * s[5] - m[3][2] * s[4] + m[3][3] * s[3],
                -m[2][1] * s[5] + m[2][2] * s[4] - m[2][3] * s[3],
            ],
            [
                -m[1][0] * c[5] + m[1][2] * c[2] - m[1][3] * c[1],
                m[0][0] * c[5] - m[0][2] * c[2] + m[0][3] * c[1],
                -m[3][0] * s[5] + m[3][2] * s[2] - m[3][3] * s[1],
                m[2][0] * s[5] - m[2][2] * s[2] + m[2][3] * s[1],
            ],
            [
                m[1][0] * c[4] - m[1][1] * c[2] + m[1][3] * c[0],
                -m[0][0] * c[4] + m[0][1] * c[2] - m[0][3] * c[0],
                m[3][0] * s[4] - m[3][1] * s[2] + m[3][3] * s[0],
                -m[2][0] * s[4] + m[2][1] * s[2] - m[2][3] * s[0],
            ],
            [
                -m[1][0] * c[3] + m[1][1] * c[1] - m[1][2] * c[0],
                m[0][0] * c[3] - m[0][1] * c[1] + m[0][2] * c[0],
                -m[3][0] * s[3] + m[3][1] * s[1] - m[3][2] * s[0],
                m[2][0] * s[3] - m[2][1] * s[1] + m[2][2] * s[0],
            ],
        ];
        Some(Self::from_f64(adjugate.map(|column| column.map(|element| element / determinant))))
    }

    /// Each element rounded once.
    pub(crate) fn from_f64(columns: [[f64; 4]; 4]) -> Self {
        Self(columns.map(|column| column.map(|element| element as f32)))
    }

    fn to_f64(self) -> [[f64; 4]; 4] {
        self.0.map(|column| column.map(f64::from))
    }
}

impl Default for Mat4 {
    /// [`IDENTITY`](Self::IDENTITY).
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl<L: Lanes> Mul<Vec4<L>> for Mat4 {
    type Output = Vec4<L>;
    #[inline(always)]
    fn mul(self, v: Vec4<L>) -> Vec4<L> {
        let [a, b, c, d] = self.0;
        a * v.x + b * v.y + c * v.z + d * v.w
    }
}

impl Mul for Mat4 {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let (a, b) = (self.to_f64(), b.to_f64());
        let mut product = [[0.0; 4]; 4];
        for (column, factors) in product.iter_mut().zip(b) {
            for (row, element) in column.iter_mut().enumerate() {
                *element =
                    a[0][row] * factors[0] + a[1][row] * factors[1] + a[2][row] * factors[2] + a[3][row] * factors[3];
            }
        }
        Self::from_f64(product)
    }
}

fn sin_cos(radians: f32) -> (f32, f32) {
    let (sin, cos) = libm::sincos(f64::from(radians));
    (sin as f32, cos as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    fn map(m: Mat4, point: [f32; 3]) -> [f32; 4] {
        (m * Vec3::from(point).extend(1.0)).into()
    }

    #[test]
    fn constructors_map_points_as_their_names_say() {
        assert_eq!(map(Mat4::translation([1.0, 2.0, 3.0]), [4.0, 5.0, 6.0]), [5.0, 7.0, 9.0, 1.0]);
        assert_eq!(map(Mat4::scale([1.0, 2.0, 3.0]), [4.0, 5.0, 6.0]), [4.0, 10.0, 18.0, 1.0]);
        let quarter = core::f32::consts::FRAC_PI_2;
        for (turn, from, to) in [
            (Mat4::rotation_x(quarter), [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
            (Mat4::rotation_y(quarter), [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
            (Mat4::rotation_z(quarter), [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ] {
            let [x, y, z, w] = map(turn, from);
            assert!((x - to[0]).abs() + (y - to[1]).abs() + (z - to[2]).abs() < 1e-6 && w == 1.0);
        }
    }

    #[test]
    fn products_map_by_the_right_factor_first() {
        let (a, b) = (Mat4::translation([1.0, 0.0, 0.0]), Mat4::scale([2.0, 2.0, 2.0]));
        assert_eq!(map(a * b, [1.0, 1.0, 1.0]), [3.0, 2.0, 2.0, 1.0]);
        assert_eq!(map(b * a, [1.0, 1.0, 1.0]), [4.0, 2.0, 2.0, 1.0]);
        assert_eq!(Mat4::IDENTITY * a, a);
    }

    #[test]
    fn inverse_undoes() {
        let m = Mat4([[1.0, 2.0, -3.0, 0.5], [0.0, 3.0, 5.0, -1.0], [7.0, 0.25, 1.0, 2.0], [1.0, -4.0, 2.0, 8.0]]);
        let Mat4(product) = m * m.inverse().expect("its determinant is not 0");
        for (column, expected) in product.iter().zip(Mat4::IDENTITY.0) {
            for (element, expected) in column.iter().zip(expected) {
                assert!((element - expected).abs() < 1e-6, "{product:?}");
            }
        }
        assert_eq!(Mat4::scale([2.0, 4.0, 8.0]).inverse(), Some(Mat4::scale([0.5, 0.25, 0.125])));
    }

    #[test]
    fn inverse_of_a_singular_matrix_is_none() {
        assert_eq!(Mat4::scale([1.0, 0.0, 1.0]).inverse(), None);
        assert_eq!(Mat4::scale([1.0, f32::NAN, 1.0]).inverse(), None);
        assert_eq!(Mat4::scale([1.0, f32::INFINITY, 1.0]).inverse(), None);
    }

    #[test]
    fn transpose_exchanges_rows_and_columns() {
        let m = Mat4([[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0], [9.0, 10.0, 11.0, 12.0], [13.0, 14.0, 15.0, 16.0]]);
        assert_eq!(m.transpose().0[0], [1.0, 5.0, 9.0, 13.0]);
        assert_eq!(m.transpose().transpose(), m);
    }
}
