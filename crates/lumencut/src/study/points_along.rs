//! Finds the clicks around a point on a line, or generates clicks for a line without clicks.

use std::collections::BTreeSet;

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;

const CLICK_SPACING_MM: f64 = 20.0;
/// Generated clicks are more than this distance away from the ends and from the dragged point (mm).
const MIN_DISTANCE_MM: f64 = 5.0;

pub(super) fn nearest_point(points: &[DVec3], place: DVec3) -> usize {
    let apart = |n: &usize| points[*n].distance(place);
    (0..points.len()).min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(0)
}

/// Number of the next click after a point of the line: at least 1, and the last click for points behind it.
pub(super) fn click_after(clicks: &[DVec3], points: &[DVec3], number: usize) -> usize {
    let last = clicks.len().saturating_sub(1);
    let after = clicks.iter().position(|click| nearest_point(points, *click) > number);
    after.map_or(last, |after| after.max(1))
}

/// Point indices of generated clicks: both ends, the given point, and evenly spaced points between them.
pub(super) fn points_along(points: &[DVec3], number: usize) -> BTreeSet<usize> {
    let lengths = arc_lengths(points);
    let last = points.len() - 1;
    let total = lengths[last];
    let fixed = [0, number, last];
    let pieces = (total / CLICK_SPACING_MM).round().max(1.0) as usize;
    let between = (1..pieces).map(|piece| piece as f64 * total / pieces as f64);
    let far = between.filter(|place| fixed.iter().all(|n| (lengths[*n] - place).abs() > MIN_DISTANCE_MM));
    let chosen = far.map(|place| lengths.partition_point(|length| *length < place));
    fixed.into_iter().chain(chosen).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line along x with a point every mm.
    fn line(length: usize) -> Vec<DVec3> {
        (0..=length).map(|n| DVec3::X * n as f64).collect()
    }

    #[test]
    fn a_line_has_points_at_its_ends_where_it_is_held_and_between() {
        let cases: [(usize, usize, &[usize]); 5] = [
            (60, 30, &[0, 20, 30, 40, 60]),
            // No generated click is near the requested point.
            (60, 22, &[0, 22, 40, 60]),
            // If the point is an end, no click is added for it.
            (60, 60, &[0, 20, 40, 60]),
            (12, 6, &[0, 6, 12]),
            (1, 0, &[0, 1]),
        ];
        for (length, number, expected) in cases {
            let found: Vec<usize> = points_along(&line(length), number).into_iter().collect();
            assert_eq!(found, expected, "{length} mm held at {number} mm");
        }
    }

    #[test]
    fn a_point_of_a_line_lies_between_the_clicks_around_it() {
        let (line, clicks) = (line(60), [2.0, 20.0, 55.0].map(|x| DVec3::new(x, 1.0, 0.0)));
        let after = |number| click_after(&clicks, &line, number);
        assert_eq!([after(0), after(10), after(20), after(40), after(60)], [1, 1, 2, 2, 2]);
    }
}
