//! Adds products by fused multiply-add, which rounds once per term. So views are bit-identical on every processor.

use glam::{DMat3, DVec3};

/// `a · b`; the terms are added from x to z.
pub(crate) fn dot(a: DVec3, b: DVec3) -> f64 {
    a.z.mul_add(b.z, a.y.mul_add(b.y, a.x * b.x))
}

/// `a x + b y`: the vector with coordinates (x, y) in a plane.
pub(crate) fn combined(a: DVec3, x: f64, b: DVec3, y: f64) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|n| b[n].mul_add(y, a[n] * x)))
}

/// `matrix · vector`; in each row, the term of y is rounded first.
pub(crate) fn product(matrix: &DMat3, vector: DVec3) -> DVec3 {
    let row = |n: usize| {
        let row = matrix.row(n);
        row.z.mul_add(vector.z, row.x.mul_add(vector.x, row.y * vector.y))
    };
    DVec3::new(row(0), row(1), row(2))
}

pub(crate) fn matrices(a: &DMat3, b: &DMat3) -> DMat3 {
    DMat3::from_cols_array_2d(&[0, 1, 2].map(|column| [0, 1, 2].map(|row| dot(a.row(row), b.col(column)))))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The square of this number is 1 + 2⁻²⁹ + 2⁻⁶⁰; a product that is rounded separately loses the last term.
    const NEAR_ONE: f64 = 1.0 + 1.0 / (1u64 << 30) as f64;
    const LOST: f64 = 1.0 / (1u64 << 60) as f64;

    #[test]
    fn a_term_that_is_added_is_not_rounded_before() {
        let rounded = NEAR_ONE * NEAR_ONE;
        let (a, b) = (DVec3::new(-rounded, NEAR_ONE, 0.0), DVec3::new(1.0, NEAR_ONE, 0.0));
        assert_eq!(dot(a, b), LOST);
        assert_eq!(
            combined(DVec3::splat(-rounded), 1.0, DVec3::splat(NEAR_ONE), NEAR_ONE),
            DVec3::splat(LOST)
        );
    }

    #[test]
    fn small_numbers_are_multiplied_exactly() {
        let matrix = DMat3::from_cols_array(&[1.0, 4.0, 7.0, 2.0, 5.0, 8.0, 3.0, 6.0, 10.0]);
        assert_eq!(product(&matrix, DVec3::new(1.0, -2.0, 3.0)), DVec3::new(6.0, 12.0, 21.0));
        assert_eq!(matrices(&matrix, &matrix), matrix * matrix);
        assert_eq!(dot(DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0)), 32.0);
    }

    #[test]
    fn a_product_begins_with_its_middle_term() {
        let rounded = NEAR_ONE * NEAR_ONE;
        let row =
            |x: f64, y: f64| DMat3::from_cols(DVec3::new(x, 0.0, 0.0), DVec3::new(y, 0.0, 0.0), DVec3::ZERO);
        let found = product(&row(NEAR_ONE, -rounded), DVec3::new(NEAR_ONE, 1.0, 0.0));
        assert_eq!(found.x, LOST);
        let found = product(&row(-rounded, NEAR_ONE), DVec3::new(1.0, NEAR_ONE, 0.0));
        assert_eq!(found.x, 0.0);
    }
}
