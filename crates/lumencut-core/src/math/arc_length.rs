//! Arc length: how far along a line of points each of them lies.

use glam::DVec3;

/// The length of a line from its first point to each of its points (in their unit).
pub fn arc_lengths(points: &[DVec3]) -> Vec<f64> {
    let mut lengths = vec![0.0; points.len()];
    for i in 1..points.len() {
        lengths[i] = lengths[i - 1] + points[i].distance(points[i - 1]);
    }
    lengths
}
