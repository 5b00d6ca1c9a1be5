//! Finds lines that wander within a wide lumen (their turns are too tight for its width), smooths them, and centres
//! them again.

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::smoothing::smoothed_by_gaussian;
use crate::trace::lumen::lumen_model::{LumenModel, lower_median};
use crate::trace::lumen::refine::refined_near;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::stop::Stop;

/// Standard deviations of the smoothing that are tried in turn, in radii.
const WIDTHS: [f64; 3] = [0.5, 1.0, 2.0];

/// Returns the line unchanged if it never wanders, otherwise the smoothed and recentred version that wanders least.
/// If a line runs obliquely in a wide lumen, its sections intersect, so their centres move the line back and forth.
pub fn without_wander(
    voxels: &Voxels,
    model: &LumenModel,
    line: Centerline,
    stop: Stop,
) -> Result<Centerline> {
    let mut best = (wandering_points(&line), line);
    let uneven = best.1.clone();
    for width in WIDTHS {
        if best.0 == 0 {
            break;
        }
        let radius = lower_median(uneven.radius.clone());
        let sigma = vec![width * radius; uneven.points.len()];
        let points = smoothed_by_gaussian(&uneven.points, &sigma, false);
        let smooth = Centerline { points, radius: vec![radius; sigma.len()], ..uneven.clone() };
        let line = refined_near(voxels, model, &smooth, stop)?;
        let count = wandering_points(&line);
        if count < best.0 {
            best = (count, line);
        }
    }
    Ok(best.1)
}

fn wandering_points(line: &Centerline) -> usize {
    wandering(line).into_iter().filter(|wanders| *wanders).count()
}

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
