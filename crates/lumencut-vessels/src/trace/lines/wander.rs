//! Finds turns too tight for the width of the vessel: there the line wanders within the lumen.

use lumencut_core::math::arc_length::arc_lengths;

use crate::trace::lines::centerline::Centerline;

/// A line wanders if the chord from one radius before a point to one radius after it is shorter than this fraction of
/// its arc length. In a bend with the vessel's radius the fraction is 0.84; with 0.6 of that radius, 0.6.
const LEAST_STRAIGHT: f64 = 0.6;

/// Minimum half-length of the chord (mm), because lines of thin vessels are no smoother than the voxels.
const LEAST_REACH: f64 = 2.0;

/// Marks points at which the line bends too tightly for the width of its vessel. The criterion is our own: a
/// tube of radius r bends with a radius of at least r, otherwise it would intersect itself.
pub fn wandering(line: &Centerline) -> Vec<bool> {
    let (points, lengths) = (&line.points, arc_lengths(&line.points));
    let last = points.len() - 1;
    let wanders = |n: usize| {
        let reach = line.radius[n].max(LEAST_REACH);
        let from = lengths.partition_point(|length| *length < lengths[n] - reach);
        let to = lengths.partition_point(|length| *length < lengths[n] + reach).min(last);
        let way = lengths[to] - lengths[from];
        way >= reach && points[to].distance(points[from]) < LEAST_STRAIGHT * way
    };
    (0..points.len()).map(wanders).collect()
}
