//! The point of a line nearest to a place.

use glam::DVec3;

/// The number of the point of a line that is nearest to a place, the first of several; 0 for a line without points.
pub fn nearest_point(points: &[DVec3], place: DVec3) -> usize {
    let distance = |i: &usize| points[*i].distance_squared(place);
    (0..points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}
