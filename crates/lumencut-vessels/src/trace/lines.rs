//! Computations along lines: steps, directions, frames, smoothing and correspondence.

pub mod centerline;
pub mod correspondence;
pub mod directions;
pub mod even_steps;
pub mod smoothing;

use glam::DVec3;

/// Index of the point nearest to a position; of equally near ones the first, for an empty line 0.
pub fn nearest_point(points: &[DVec3], place: DVec3) -> usize {
    let distance = |i: &usize| points[*i].distance_squared(place);
    (0..points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}
