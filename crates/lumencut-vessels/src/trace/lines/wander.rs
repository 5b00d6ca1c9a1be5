//! Where a line turns more tightly than its vessel is wide, which no vessel does: there it wanders within the lumen.

use lumencut_core::math::arc_length::arc_lengths;

use crate::trace::lines::centerline::Centerline;

/// A line wanders where the straight way between the points one radius before and after is less than this part of the way along
/// it. Of a bend as tight as the vessel is wide it is 0.84; this part belongs to a circle of 0.6 radii.
const LEAST_STRAIGHT: f64 = 0.6;

/// The least that is looked at on each side (mm): lines of thin vessels are no smoother than voxels.
const LEAST_REACH: f64 = 2.0;

/// Which points of a line lie where it turns more tightly than its vessel is wide.
///
/// # Source
/// Ours: the centerline of a tube of radius r bends with a radius of r at least, or the tube would run through itself.
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
