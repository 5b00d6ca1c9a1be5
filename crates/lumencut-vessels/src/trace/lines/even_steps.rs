//! Points at even steps along a line, either straight between its points or on a smooth curve.

use glam::DVec3;

use lumencut_core::math::arc_length::{LinePlace, arc_lengths, point_at};

/// A remainder below this fraction of a step is a rounding error and adds no point.
const TINY: f64 = 1e-6;

/// Positions at even steps of at most `step` mm, from start to end; at least two.
pub(crate) fn even_places(points: &[DVec3], step: f64) -> Vec<LinePlace> {
    let lengths = arc_lengths(points);
    let total = lengths[lengths.len() - 1];
    let parts = (total / step).ceil().max(1.0) as usize;
    (0..=parts).map(|n| LinePlace::at(&lengths, total * n as f64 / parts as f64)).collect()
}

/// Points in even steps of at most `step` mm along straight lines between `points`; at least two.
pub fn in_even_steps(points: &[DVec3], step: f64) -> Vec<DVec3> {
    even_places(points, step).into_iter().map(|place| place.point(points)).collect()
}

/// A smooth curve through `points` in even steps of at most `step` mm; both ends are kept. The curve is a Catmull-Rom
/// spline by arc length: its slopes are nearly those of circles through three neighbours.
pub fn curve_in_even_steps(points: &[DVec3], step: f64) -> Vec<DVec3> {
    let mut fine = vec![points[0]];
    for n in 1..points.len() {
        let length = points[n].distance(points[n - 1]);
        let parts = (4.0 * length / step - TINY).ceil().max(1.0) as usize;
        for part in 1..=parts {
            fine.push(curve(points, n, part as f64 / parts as f64));
        }
    }
    let fine_ways = arc_lengths(&fine);
    let whole = fine_ways[fine_ways.len() - 1];
    let count = (whole / step - TINY).ceil().max(1.0) as usize;
    let inner = (1..count).map(|n| point_at(&fine, &fine_ways, whole * n as f64 / count as f64));
    let mut made = vec![points[0]];
    made.extend(inner);
    made.push(points[points.len() - 1]);
    made
}

/// A point of the curve between points `n` - 1 and `n`.
fn curve(points: &[DVec3], n: usize, t: f64) -> DVec3 {
    let [a, b] = [points[n - 1], points[n]];
    if t >= 1.0 {
        return b;
    }
    let length = a.distance(b);
    let slope = |m: usize| {
        let (before, after) = (m.saturating_sub(1), (m + 1).min(points.len() - 1));
        let [from, to] = [points[m].distance(points[before]), points[after].distance(points[m])];
        let [into, out] =
            [(points[m] - points[before]) / from.max(1e-12), (points[after] - points[m]) / to.max(1e-12)];
        if from == 0.0 {
            out
        } else if to == 0.0 {
            into
        } else {
            (to * into + from * out) / (from + to)
        }
    };
    let [p, q] = [slope(n - 1) * length, slope(n) * length];
    let [t2, t3] = [t * t, t * t * t];
    a * (2.0 * t3 - 3.0 * t2 + 1.0) + p * (t3 - 2.0 * t2 + t) + b * (3.0 * t2 - 2.0 * t3) + q * (t3 - t2)
}
