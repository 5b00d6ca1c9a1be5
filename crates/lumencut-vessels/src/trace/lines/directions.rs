//! Computes the directions along and across a line at its points.

use glam::DVec3;

use lumencut_core::math::arc_length::{arc_lengths, point_at};
use lumencut_core::math::frames::{MovingFrame, double_reflection};

/// Direction at each point: from the first to the last point that is within `reach` mm of it along the line.
pub fn point_directions(points: &[DVec3], reach: f64) -> Vec<DVec3> {
    let lengths = arc_lengths(points);
    let last = points.len() - 1;
    let mut found = Vec::with_capacity(points.len());
    for (i, length) in lengths.iter().enumerate() {
        let before = lengths.partition_point(|l| *l < length - reach).min(i.saturating_sub(1));
        let after = (lengths.partition_point(|l| *l <= length + reach) - 1).max((i + 1).min(last));
        let across = points[after] - points[before];
        let fallback = found.last().copied().unwrap_or(DVec3::Z);
        found.push(across.try_normalize().unwrap_or(fallback));
    }
    found
}

/// Direction at each point: the chord from `reach` mm before it to `reach` mm after it, with interpolated
/// ends. On a closed line (whose last point equals the first), chords continue across the start.
pub fn chord_directions(points: &[DVec3], reach: &[f64], is_closed: bool) -> Vec<DVec3> {
    let ways = arc_lengths(points);
    let whole = ways[ways.len() - 1];
    (0..points.len())
        .map(|n| {
            let at = |way: f64| point_at(points, &ways, if is_closed { way.rem_euclid(whole) } else { way });
            let chord = at(ways[n] + reach[n]) - at(ways[n] - reach[n]);
            let next = (n + 1).min(points.len() - 1);
            let step = points[next] - points[next - 1];
            chord.try_normalize().or_else(|| step.try_normalize()).unwrap_or(DVec3::Z)
        })
        .collect()
}

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
