//! The letters of the patient's sides at the edges of a picture.

use glam::DVec3;
use serde::Serialize;

/// A direction points to a side if its component towards the side is at least this, the sine of 11.5 degrees.
const MIN_COMPONENT: f64 = 0.2;

/// Components are rounded to multiples of 1 divided by this number. Rounding errors then do not decide between equal ones.
const ROUNDING_STEPS: f64 = 1e6;

/// If two sums of cosines differ by less than this, the axes are equally near, so that rounding does not decide.
const COSINE_TOLERANCE: f64 = 1e-6;

/// The patient's signed axes (LPS). Of equally near axes the first wins, so axes along the body are preferred.
pub(crate) const PREFERRED_AXES: [DVec3; 6] =
    [DVec3::NEG_Z, DVec3::Z, DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y];

/// The patient's sides at the low and high end of each axis (LPS).
const SIDES: [[char; 2]; 3] = [['R', 'L'], ['A', 'P'], ['I', 'S']];

/// The letters at the four edges of a picture.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct EdgeLetters {
    /// At the left edge.
    pub left: String,
    /// At the right edge.
    pub right: String,
    /// At the top edge.
    pub top: String,
    /// At the bottom edge.
    pub bottom: String,
}

impl EdgeLetters {
    /// The letters of a picture with columns along `right` and rows along `down` (LPS, any length above 0).
    pub fn new(right: DVec3, down: DVec3) -> Self {
        Self { left: sides(-right), right: sides(right), top: sides(-down), bottom: sides(down) }
    }
}

/// Letters of the sides to which a direction points (LPS, any length above 0), the main one first. They are R, L, A(nterior),
/// P(osterior), S(uperior) and I(nferior). Components below 0.2 are omitted.
pub fn sides(direction: DVec3) -> String {
    let parts = direction.normalize_or_zero().to_array();
    let size = |axis: usize| (parts[axis].abs() * ROUNDING_STEPS).round();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
    let named = order.into_iter().filter(|axis| parts[*axis].abs() >= MIN_COMPONENT);
    named.map(|axis| SIDES[axis][usize::from(parts[axis] > 0.0)]).collect()
}

/// The patient axes nearest to three directions (LPS, any length above 0). Each axis is used once, and handedness is kept.
pub fn nearest_axes(directions: [DVec3; 3]) -> [DVec3; 3] {
    let [first, second, third] = directions.map(DVec3::normalize_or_zero);
    let handedness = if first.cross(second).dot(third) < 0.0 { -1.0 } else { 1.0 };
    let (mut best, mut most) = (directions, f64::NEG_INFINITY);
    for along in PREFERRED_AXES {
        for ahead in PREFERRED_AXES.into_iter().filter(|axis| axis.dot(along) == 0.0) {
            let across = ahead.cross(along) * handedness;
            let sum = first.dot(across) + second.dot(ahead) + third.dot(along);
            if sum > most + COSINE_TOLERANCE {
                (best, most) = ([across, ahead, along], sum);
            }
        }
    }
    best
}

/// One letter for each grid axis: the side to which the nearest patient axis points.
pub fn grid_letters(directions: [DVec3; 3]) -> String {
    nearest_axes(directions).map(sides).concat()
}

#[cfg(test)]
#[path = "tests/letters.rs"]
mod tests;
