//! Lines that wander within a wide lumen, made calm: smoothed over the width of the lumen, and moved to its middle again.

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::smoothing::smoothed_by_gaussian;
use crate::trace::lines::wander::wandering;
use crate::trace::lumen::lumen_model::{LumenModel, lower_median};
use crate::trace::lumen::refine::refined_near;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::Stop;

/// The standard deviations of the smoothing that are tried, one after the other: in radii.
const WIDTHS: [f64; 3] = [0.5, 1.0, 2.0];

/// The line as it is where it turns nowhere more tightly than its vessel is wide; else the one that does so least of those that are
/// smoothed along it and moved to the middle again. Cross-sections of a line that runs obliquely through a wide lumen cut each other,
/// and their middles lead it back and forth.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn calmed(voxels: &Voxels, model: &LumenModel, line: Centerline, stop: Stop) -> Result<Centerline> {
    let mut best = (wandering_points(&line), line);
    let restless = best.1.clone();
    for width in WIDTHS {
        if best.0 == 0 {
            break;
        }
        let radius = lower_median(restless.radius.clone());
        let sigma = vec![width * radius; restless.points.len()];
        let points = smoothed_by_gaussian(&restless.points, &sigma, false);
        let smooth = Centerline { points, radius: vec![radius; sigma.len()], ..restless.clone() };
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
