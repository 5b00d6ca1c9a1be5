//! Smooths lines that wander within a wide lumen, and centres them again.

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::smoothing::smoothed_by_gaussian;
use crate::trace::lines::wander::wandering;
use crate::trace::lumen::lumen_model::{LumenModel, lower_median};
use crate::trace::lumen::refine::refined_near;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
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
