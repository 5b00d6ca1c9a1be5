//! Closes rings: a run (line of a vessel) that returns to its start is made to end on its first point.

use crate::trace::find::links::groups::SMALL_LOOP;
use crate::trace::find::whole_vessels::attached::Attached;
use crate::trace::find::whole_vessels::centered::LinePoint;
use crate::trace::lumen::refine::STEP;
use lumencut_core::math::arc_length::arc_lengths;

/// Maximum distance between the ends of a ring, in radii.
const RING_GAP_RADII: f64 = 1.0;

pub(crate) fn closed(mut run: Attached) -> Attached {
    let [first, last] = [run.points[0], run.points[run.points.len() - 1]];
    let gap = first.place.distance(last.place);
    let radius = first.radius.min(last.radius);
    let places: Vec<_> = run.points.iter().map(|point| point.place).collect();
    let length = arc_lengths(&places).last().copied().unwrap_or(0.0);
    let is_ring = run.met == [None; 2] && gap < RING_GAP_RADII * radius && length >= SMALL_LOOP * radius;
    if is_ring && gap > 0.0 {
        let count = (gap / STEP).ceil();
        let between = |n: usize| LinePoint { place: last.place.lerp(first.place, n as f64 / count), ..last };
        run.points.extend((1..count as usize).map(between));
        run.points.push(first);
    }
    run
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// An arc of `turn` radians on a circle with a radius of 10 mm.
    fn circle(turn: f64, radius: f64) -> Attached {
        let point = |n: i32| {
            let (sin, cos) = (turn * f64::from(n) / 200.0).sin_cos();
            LinePoint { place: DVec3::new(10.0 * cos, 10.0 * sin, 0.0), radius, confidence: 0.9, track: 0 }
        };
        Attached { points: (0..=200).map(point).collect(), met: [None; 2], leads: [0; 2] }
    }

    #[test]
    fn a_ring_ends_where_it_began_and_what_is_open_or_ends_on_others_does_not() {
        // The gap between the ends is 1.3 mm.
        let almost = std::f64::consts::TAU - 0.13;
        let ring = closed(circle(almost, 1.5)).points;
        assert_eq!(ring[0], ring[ring.len() - 1]);
        assert!(ring.windows(2).all(|pair| pair[0].place.distance(pair[1].place) <= STEP));
        assert_eq!(closed(circle(almost, 1.2)).points.len(), 201);
        assert_eq!(closed(circle(6.2, 5.5)).points.len(), 201);
        let mut branch = circle(almost, 1.5);
        branch.met = [Some(3), None];
        assert_eq!(closed(branch).points.len(), 201);
    }
}
