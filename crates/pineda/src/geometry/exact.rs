//! A determinant of floats, exactly: a sum without any rounding (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust
//! geometric predicates").

/// Whether the determinant of three finite rows is 0.
pub(crate) fn determinant_is_zero(rows: [[f32; 3]; 3]) -> bool {
    let [a, b, c] = rows.map(|row| row.map(f64::from));
    let mut sum = Expansion::default();
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        sum.add_product(a[i], b[j], c[k]);
        sum.add_product(-a[i], b[k], c[j]);
    }
    sum.parts[..sum.count].iter().all(|&part| part == 0.0)
}

/// A sum kept as numbers that do not overlap: it is 0 only if they all are.
#[derive(Default)]
struct Expansion {
    parts: [f64; 12],
    count: usize,
}

impl Expansion {
    /// Adds a product of three numbers that f32 can hold.
    fn add_product(&mut self, a: f64, b: f64, c: f64) {
        // 48 bits: exact. Without its low half it has 24 or so, and both halves' products with a third number fit 53.
        let product = a * b;
        let high = f64::from_bits(product.to_bits() & !0x3ff_ffff);
        self.add(high * c);
        self.add((product - high) * c);
    }

    /// Grows the expansion by one number, as in Shewchuk's figure 6.
    fn add(&mut self, number: f64) {
        let mut carry = number;
        for part in &mut self.parts[..self.count] {
            (carry, *part) = two_sum(carry, *part);
        }
        self.parts[self.count] = carry;
        self.count += 1;
    }
}

/// The rounded sum of two numbers and what rounding took from it: together exactly the sum (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    let of_a = sum - of_b;
    (sum, (a - of_a) + (b - of_b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hardly_any_volume_is_told_from_none() {
        assert!(determinant_is_zero([[2.0, 1.0, -2.0], [0.0, -0.5, 0.5], [-1.0, 0.5, 0.0]]));
        // (1 + 2^-23) (1 - 2^-23) - 1 = -2^-46.
        let [up, down] = [1.0 + f32::EPSILON, 1.0 - f32::EPSILON];
        assert!(!determinant_is_zero([[up, 1.0, 0.0], [1.0, down, 0.0], [0.0, 0.0, 3.0]]));
        // The smallest and the largest floats: no underflow, no overflow.
        let (tiny, huge) = (f32::from_bits(1), f32::MAX);
        assert!(!determinant_is_zero([[tiny, 0.0, 0.0], [0.0, tiny, 0.0], [0.0, 0.0, tiny]]));
        assert!(!determinant_is_zero([[huge, 0.0, 0.0], [0.0, huge, tiny], [0.0, tiny, huge]]));
        assert!(determinant_is_zero([[huge, tiny, 1.0], [huge, tiny, 1.0], [3.0, 1.0, 4.0]]));
    }

    #[test]
    fn multiples_of_two_rows_make_no_volume() {
        for k in 1..100 {
            let [p, q] = [[k as f32, 0.3, -7.5], [0.1, k as f32 * 0.7, 1e-3]];
            // Sums and products of a few bits are exact.
            let r = [0, 1, 2].map(|i| 4.0 * p[i]);
            assert!(determinant_is_zero([p, q, r]));
            assert!(!determinant_is_zero([p, q, [r[0], r[1], r[2] + 1.0]]));
        }
    }
}
