//! 4 x 4 matrices of plain `f32`: what carries vertices from one space to the next.

use super::Vec4;
use crate::lanes::Lanes;
use core::ops::Mul;

/// A 4 x 4 matrix: four columns of plain `f32`, the same for every lane. `m * v` maps the column vector `v`, and
/// `a * b` maps by `b` first.
///
/// The constructors and the products compute in `f64` and round each element once, with `libm`'s functions, so a
/// camera has the same bits on every platform. `matrix * vector` is `f32`, from the first column to the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mat4(pub [[f32; 4]; 4]);

impl Mat4 {
    /// Maps every vector to itself.
    pub const IDENTITY: Self =
        Self([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
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
        let [a, b, c, d]: [[f32; 4]; 4] = self.0;
        a * v.x + b * v.y + c * v.z + d * v.w
    }
}

impl Mul for Mat4 {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let mut product = [[0.0; 4]; 4];
        for (column, b) in product.iter_mut().zip(b.0) {
            for (row, element) in column.iter_mut().enumerate() {
                let mut sum = 0.0;
                for (a, b) in self.0.iter().zip(b) {
                    sum += f64::from(a[row]) * f64::from(b);
                }
                *element = sum as f32;
            }
        }
        Self(product)
    }
}
