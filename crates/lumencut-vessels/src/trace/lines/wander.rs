//! Detects turns tighter than the vessel is wide, where a line wanders within the lumen.

use lumencut_core::math::arc_length::arc_lengths;

use crate::trace::lines::centerline::Centerline;

/// Chord over arc length, one radius to each side, below which a line wanders. A bend as tight as the vessel
/// has 0.84; 0.6 is a circle of 0.6 radii.
const LEAST_STRAIGHT: f64 = 0.6;

/// Minimum window on each side (mm), because lines of thin vessels are no smoother than voxels.
const LEAST_REACH: f64 = 2.0;

/// Marks points where the line turns more tightly than its vessel is wide. Own criterion: a tube of radius r
/// bends with a radius of at least r, or it would intersect itself.
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
