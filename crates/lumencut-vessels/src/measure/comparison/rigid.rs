//! The rigid motion that brings points closest to others (Horn 1987, doi:10.1364/JOSAA.4.000629).

use glam::{DMat3, DMat4, DQuat, DVec3, DVec4};
use lumencut_core::error::{Error, ErrorKind, Result};

/// The power iteration takes two to the power of this many steps, which separates even eigenvalues that differ by a millionth.
const SQUARINGS: usize = 32;
/// Points determine a rotation if one of them is at least this far from the line through the two outermost (mm).
const LEAST_TRIANGLE: f64 = 3.0;

/// A rotation and a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The rotation.
    pub rotation: DQuat,
    /// What is added after the rotation (mm).
    pub translation: DVec3,
}

impl Motion {
    /// No motion.
    pub const NONE: Self = Self { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };

    /// The motion for pairs of points that belong together: a shift for one or two pairs, with a rotation for more. Fails with
    /// [`ErrorKind::Measuring`] if three or more points lie on a line, since they determine no rotation.
    pub fn of_pairs(pairs: &[[DVec3; 2]]) -> Result<Self> {
        let [from, to] = [0, 1].map(|which| pairs.iter().map(|pair| pair[which]).collect::<Vec<_>>());
        if pairs.len() < 3 {
            let shift = pairs.iter().map(|[a, b]| *b - *a).sum::<DVec3>() / pairs.len().max(1) as f64;
            return Ok(Self { translation: shift, ..Self::NONE });
        }
        for points in [&from, &to] {
            if away_from_line(points) < LEAST_TRIANGLE {
                let found = format!("{} points on a line", pairs.len());
                let expected =
                    format!("a point at least {LEAST_TRIANGLE} mm away from the line through others");
                let error = Error::new(ErrorKind::Measuring, "pairs of points", found, expected);
                return Err(error.mend("add a pair to the side of the others"));
            }
        }
        Ok(Self::between(&from, &to))
    }

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

/// The largest distance of a point from the line through the two outermost points (mm).
fn away_from_line(points: &[DVec3]) -> f64 {
    let furthest = |from: DVec3| {
        points.iter().copied().max_by(|a, b| a.distance(from).total_cmp(&b.distance(from))).unwrap_or(from)
    };
    let start = furthest(points[0]);
    let along = (furthest(start) - start).normalize_or_zero();
    points.iter().map(|point| (*point - start).reject_from_normalized(along).length()).fold(0.0, f64::max)
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
    if shift == 0.0 {
        return DQuat::IDENTITY;
    }
    let mut power = DMat4::from_cols_array_2d(&rows) + DMat4::from_diagonal(DVec4::splat(shift));
    for _ in 0..SQUARINGS {
        power *= (0..4).map(|n| power.col(n)[n]).sum::<f64>().recip();
        power = power * power;
    }
    // All columns are multiples of the eigenvector; the longest one is the most exact.
    let columns = (0..4).map(|n| power.col(n));
    let longest = columns.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let [w, x, y, z] = longest.unwrap_or(DVec4::X).to_array();
    DQuat::from_xyzw(x, y, z, w).normalize()
}

#[cfg(test)]
#[path = "tests/rigid.rs"]
mod tests;
