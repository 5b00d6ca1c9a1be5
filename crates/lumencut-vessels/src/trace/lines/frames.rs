//! Computes directions across a line at its points.

use glam::DVec3;

use lumencut_core::math::frames::{MovingFrame, double_reflection};

/// Two directions across the line at each point. They do not rotate about the line from point to point.
pub fn frames(points: &[DVec3], directions: &[DVec3]) -> Vec<[DVec3; 2]> {
    let mut frame = MovingFrame::looking(directions[0], directions[0].any_orthonormal_vector());
    let mut found = vec![[frame.ahead, frame.across]];
    for i in 1..points.len() {
        frame = double_reflection(frame, points[i] - points[i - 1], directions[i]);
        found.push([frame.ahead, frame.across]);
    }
    found
}
