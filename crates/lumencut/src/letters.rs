//! The letters of the patient's sides at the edges of a picture: which of them stand there is decided here for every host.

use glam::DVec3;
use serde::Serialize;

/// A side is named where the direction lies at least this far towards it: the sine of 11.5 degrees.
const LEAST_PART: f64 = 0.2;

/// Parts that agree to this many steps of one are equal; the order of the axes decides between them, not rounding.
const STEPS: f64 = 1e6;

/// Axes whose cosines differ by less are equally near: rounding does not choose between them.
const SAME: f64 = 1e-6;

/// The signed axes of the patient (LPS) in the order in which equally near ones are preferred: along the body first.
pub(crate) const PREFERRED: [DVec3; 6] =
    [DVec3::NEG_Z, DVec3::Z, DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y];

/// The sides of the patient at the low and the high end of each axis (LPS).
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
    /// The letters of a picture whose columns rise along `right` and whose rows rise along `down` (LPS, of any length above 0).
    pub fn new(right: DVec3, down: DVec3) -> Self {
        Self { left: sides(-right), right: sides(right), top: sides(-down), bottom: sides(down) }
    }
}

/// The letters of the sides of the patient that a direction (LPS, of any length above 0) points to, the main one first: R and L
/// are right and left, A and P anterior and posterior, S and I superior and inferior. Parts of the unit vector below 0.2 are not
/// named.
pub fn sides(direction: DVec3) -> String {
    let parts = direction.normalize_or_zero().to_array();
    let size = |axis: usize| (parts[axis].abs() * STEPS).round();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
    let named = order.into_iter().filter(|axis| parts[*axis].abs() >= LEAST_PART);
    named.map(|axis| SIDES[axis][usize::from(parts[axis] > 0.0)]).collect()
}

/// The signed axes of the patient nearest to three directions (LPS, of any length above 0), with their handedness: each axis once.
pub fn nearest_axes(directions: [DVec3; 3]) -> [DVec3; 3] {
    let [first, second, third] = directions.map(DVec3::normalize_or_zero);
    let handedness = if first.cross(second).dot(third) < 0.0 { -1.0 } else { 1.0 };
    let (mut best, mut most) = (directions, f64::NEG_INFINITY);
    for along in PREFERRED {
        for ahead in PREFERRED.into_iter().filter(|axis| axis.dot(along) == 0.0) {
            let across = ahead.cross(along) * handedness;
            let sum = first.dot(across) + second.dot(ahead) + third.dot(along);
            if sum > most + SAME {
                (best, most) = ([across, ahead, along], sum);
            }
        }
    }
    best
}

/// The sides that the axes of a grid run to, a letter each: those of the nearest axes of the patient.
pub fn grid_letters(directions: [DVec3; 3]) -> String {
    nearest_axes(directions).map(sides).concat()
}

#[cfg(test)]
#[path = "tests/letters.rs"]
mod tests;
