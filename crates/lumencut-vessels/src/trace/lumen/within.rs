//! Tests whether a position lies within the lumen of a known vessel.

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::nearest_point;
use crate::trace::lumen::refine::STEP;

/// Distance by which the lumen extends beyond an end of the line, in radii.
const ENDS: f64 = 0.3;

pub(crate) fn holds(vessel: &Centerline, place: DVec3) -> bool {
    let points = &vessel.points;
    let near = nearest_point(points, place);
    let across = place - points[near];
    let last = points.len() - 1;
    let slack = (ENDS * vessel.radius[near]).max(STEP);
    let beyond = |end: usize, next: usize| {
        near == end && across.dot((points[end] - points[next]).normalize_or_zero()) > slack
    };
    let is_beyond = beyond(0, 1) || beyond(last, last - 1);
    across.length() < vessel.radius[near] && !is_beyond
}
