//! The rigid motion that brings points closest to others (Horn 1987, doi:10.1364/JOSAA.4.000629).

use glam::{DMat3, DQuat, DVec3};

/// Steps of the power iteration; the ratio of the largest eigenvalues decides how many it needs.
const STEPS: usize = 200;

/// A rotation and a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The rotation.
    pub rotation: DQuat,
    /// What is added after the rotation (mm).
    pub translation: DVec3,
}

impl Motion {
    /// The motion with the smallest sum of squared distances from moved points to the others, one by one.
    pub(super) fn between(from: &[DVec3], to: &[DVec3]) -> Self {
        let middle = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len() as f64;
        let middles = [middle(from), middle(to)];
        let mut product = DMat3::ZERO;
        for (a, b) in from.iter().zip(to) {
            let [a, b] = [*a - middles[0], *b - middles[1]];
            product += DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        }
        let rotation = rotation(&product);
        Self { rotation, translation: middles[1] - rotation * middles[0] }
    }

    /// The moved point.
    pub fn of(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }
}

/// The rotation from the sum of products of coordinates: entry (row a, column b) is the sum of `from[a] · to[b]`.
fn rotation(sums: &DMat3) -> DQuat {
    let s = |a: usize, b: usize| sums.col(b)[a];
    let [x, y, z] = [s(0, 0), s(1, 1), s(2, 2)];
    let [a, b, c] = [s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0)];
    let [d, e, f] = [s(0, 1) + s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1)];
    let rows = [[x + y + z, a, b, c], [a, x - y - z, d, e], [b, d, y - x - z, f], [c, e, f, z - x - y]];
    // The shift makes all eigenvalues positive, so that the iteration finds the largest one.
    let shift: f64 = rows.iter().flatten().map(|value| value.abs()).sum();
    let mut vector = [1.0, 0.1, 0.2, 0.3];
    for _ in 0..STEPS {
        let mut next = [0.0; 4];
        for (row, next) in rows.iter().zip(&mut next) {
            *next = row.iter().zip(vector).map(|(value, one)| value * one).sum();
        }
        for (next, one) in next.iter_mut().zip(vector) {
            *next += shift * one;
        }
        let length = next.iter().map(|one| one * one).sum::<f64>().sqrt();
        if length == 0.0 {
            return DQuat::IDENTITY;
        }
        vector = next.map(|one| one / length);
    }
    DQuat::from_xyzw(vector[1], vector[2], vector[3], vector[0]).normalize()
}
