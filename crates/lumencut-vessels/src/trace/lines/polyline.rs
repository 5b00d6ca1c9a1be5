//! Lines of points: their lengths along the way, smoothing, directions, and points at equal distances.

use glam::DVec3;

use lumencut_core::math::arc_length::arc_lengths;

/// A Gaussian reaches so many standard deviations.
const REACH: f64 = 3.0;

/// A share of a step that rounding can make: it adds no point.
const TINY: f64 = 1e-6;

/// The points smoothed along the line by a Gaussian whose standard deviation at each point is `sigma` (mm), or a third of the
/// way to the nearer end where that is less: ends stay. A closed line, whose last point is its first one, has no ends.
pub fn smoothed(points: &[DVec3], sigma: &[f64], is_closed: bool) -> Vec<DVec3> {
    let ways = arc_lengths(points);
    let whole = ways[ways.len() - 1];
    let count = points.len();
    let mut made: Vec<DVec3> = (0..count)
        .map(|n| {
            let to_end = ways[n].min(whole - ways[n]);
            let most = if is_closed { whole / 6.0 } else { to_end / REACH };
            let sigma = sigma[n].min(most);
            if sigma <= 0.0 {
                return points[n];
            }
            let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
            for turn in if is_closed { -1..=1 } else { 0..=0 } {
                let center = ways[n] - f64::from(turn) * whole;
                let first = ways.partition_point(|way| *way < center - REACH * sigma);
                for m in first..count {
                    let away = (ways[m] - center) / sigma;
                    if away > REACH {
                        break;
                    }
                    // A point stands for half the way to each of its neighbours.
                    let share = (ways[(m + 1).min(count - 1)] - ways[m.saturating_sub(1)]) / 2.0;
                    let weight = share * (-away * away / 2.0).exp();
                    sum += weight * points[m];
                    weights += weight;
                }
            }
            if weights > 0.0 { sum / weights } else { points[n] }
        })
        .collect();
    if is_closed {
        made[count - 1] = made[0];
    }
    made
}

/// The direction of the line at each point, over `reach` (mm) to both sides.
pub fn directions(points: &[DVec3], reach: &[f64], is_closed: bool) -> Vec<DVec3> {
    let ways = arc_lengths(points);
    let whole = ways[ways.len() - 1];
    (0..points.len())
        .map(|n| {
            let at = |way: f64| at(points, &ways, if is_closed { way.rem_euclid(whole) } else { way });
            let chord = at(ways[n] + reach[n]) - at(ways[n] - reach[n]);
            let next = (n + 1).min(points.len() - 1);
            let step = points[next] - points[next - 1];
            chord.try_normalize().or_else(|| step.try_normalize()).unwrap_or(DVec3::Z)
        })
        .collect()
}

/// The place at a way along the line, its nearer end beyond them.
pub fn at(points: &[DVec3], ways: &[f64], way: f64) -> DVec3 {
    let after = ways.partition_point(|known| *known <= way);
    if after == 0 {
        return points[0];
    }
    if after == points.len() {
        return points[points.len() - 1];
    }
    let [a, b] = [ways[after - 1], ways[after]];
    points[after - 1].lerp(points[after], (way - a) / (b - a))
}

/// The points of a smooth curve through `points` at equal distances of at most `step` (mm), with both ends as they are.
///
/// Between two points the curve is a cubic whose slopes are those of the circles, nearly, through three neighbours
/// (Catmull-Rom with its parameter along the line).
pub fn resampled(points: &[DVec3], step: f64) -> Vec<DVec3> {
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
    let inner = (1..count).map(|n| at(&fine, &fine_ways, whole * n as f64 / count as f64));
    let mut made = vec![points[0]];
    made.extend(inner);
    made.push(points[points.len() - 1]);
    made
}

/// The curve between point `n` - 1 and point `n`.
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
