//! The directions of rows and columns of a slice. Rounded direction cosines are made orthonormal.

use glam::DVec3;

/// Maximum deviation of cosines from those of orthonormal vectors.
pub(crate) const ROUNDING: f64 = 0.01;
/// If no cosine deviates by more than this, only the lengths of the vectors are corrected.
const EXACT: f64 = 1e-4;

#[derive(Debug, Clone, Copy)]
pub(crate) struct Directions {
    pub along_i: DVec3,
    pub along_j: DVec3,
    stated: [DVec3; 2],
    pub is_rounded: bool,
}

impl Directions {
    /// The directions; None if the cosines are too far from orthonormal.
    pub(crate) fn of(cosines: &[f64; 6]) -> Option<Self> {
        let stated = [DVec3::from_slice(&cosines[..3]), DVec3::from_slice(&cosines[3..])];
        let [along_i, along_j] = orthonormal(stated)?;
        let made = Self { along_i, along_j, stated, is_rounded: true };
        if made.correction() > EXACT {
            return Some(made).filter(|made| made.correction() <= ROUNDING);
        }
        Some(Self {
            along_i: stated[0].normalize(),
            along_j: stated[1].normalize(),
            is_rounded: false,
            ..made
        })
    }

    /// Makes rounded directions perpendicular to the line of slices, if rounding explains the difference.
    pub(crate) fn along(self, line: Option<DVec3>) -> Self {
        let line = line.filter(|_| self.is_rounded);
        line.and_then(|line| self.across(line)).unwrap_or(self)
    }

    /// Makes the directions perpendicular to `normal`; None if a cosine changes by more than rounding.
    fn across(&self, normal: DVec3) -> Option<Self> {
        let within = |vector: DVec3| vector - vector.dot(normal) * normal;
        let [along_i, along_j] = orthonormal([within(self.along_i), within(self.along_j)])?;
        Some(Self { along_i, along_j, ..*self }).filter(|made| made.correction() <= ROUNDING)
    }

    pub(crate) fn correction(&self) -> f64 {
        let [row, column] = self.stated;
        (self.along_i - row).abs().max_element().max((self.along_j - column).abs().max_element())
    }

    pub(crate) fn normal(&self) -> DVec3 {
        self.along_i.cross(self.along_j)
    }
}

/// Direction cosines of a stack whose positions lie along `line`; None if too far from orthonormal.
pub fn corrected(cosines: &[f64; 6], line: [f64; 3]) -> Option<[f64; 6]> {
    let made = Directions::of(cosines)?.along(DVec3::from_array(line).try_normalize());
    let ([a, b, c], [d, e, f]) = (made.along_i.to_array(), made.along_j.to_array());
    Some([a, b, c, d, e, f])
}

/// The nearest orthonormal vectors; both vectors turn by the same angle.
fn orthonormal([row, column]: [DVec3; 2]) -> Option<[DVec3; 2]> {
    let (row, column) = (row.try_normalize()?, column.try_normalize()?);
    let (sum, difference) = ((row + column).try_normalize()?, (row - column).try_normalize()?);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    Some([(sum + difference) * half, (sum - difference) * half])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec3, EulerRot};

    fn rounded(vector: DVec3) -> DVec3 {
        (vector * 100.0).round() / 100.0
    }

    #[test]
    fn two_decimals_are_made_orthonormal() {
        for n in 0..500 {
            let angle = |factor: f64| (f64::from(n) * factor) % 3.0;
            let turn = DMat3::from_euler(EulerRot::XYZ, angle(0.7), angle(1.3), angle(2.1));
            let (row, column) = (rounded(turn.x_axis), rounded(turn.y_axis));
            let cosines = [row.x, row.y, row.z, column.x, column.y, column.z];
            let made = Directions::of(&cosines).expect("rounded cosines");
            if !made.is_rounded {
                continue;
            }
            assert!(made.along_i.dot(made.along_j).abs() < 1e-12, "{cosines:?}");
            assert!((made.along_i.length() - 1.0).abs() < 1e-12, "{cosines:?}");
            let upright = made.across(turn.z_axis).expect("within rounding");
            assert!(upright.normal().dot(turn.z_axis) > 1.0 - 1e-12, "{cosines:?}");
            assert!((upright.along_i - turn.x_axis).length() < 0.01, "{cosines:?}");
        }
    }

    #[test]
    fn cosines_that_are_no_rounding_are_none() {
        for cosines in [
            [1.0, 0.0, 0.0, 0.5, 1.0, 0.0],
            [1.0, 0.0, 0.0, 0.03, 1.0, 0.0],
            [1.02, 0.0, 0.0, 0.0, 1.0, 0.0],
            [0.0; 6],
            [1.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            [f64::MAX, 0.0, 0.0, 0.0, 1.0, 0.0],
        ] {
            assert!(Directions::of(&cosines).is_none(), "{cosines:?}");
        }
    }
}
