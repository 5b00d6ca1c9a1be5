//! How much like lumen the values are along a straight way from one lumen to another.

use glam::DVec3;

use crate::trace::find::scan::Scan;

/// The distance of the values that are looked at (voxels).
const STEP: f64 = 0.5;

/// Each value is a mean over its neighbours, as a Gaussian with this standard deviation makes (voxels).
const SMOOTHED: f64 = 0.6;

/// An end of a way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WayEnd {
    /// Where it lies (mm, LPS).
    pub place: DVec3,
    /// The level of the lumen there, and how far that lies above the tissue around.
    pub level: f64,
    /// See `level`.
    pub contrast: f64,
}

/// The lowest value along a straight way, as a share of the way from the tissue (0) to the lumen (1) of the darker end, which is
/// the branch of the other one; 0 for a way that leaves the volume.
pub(crate) fn lowest_level(scan: &Scan, from: WayEnd, to: WayEnd) -> f64 {
    let count = (from.place.distance(to.place) / (STEP * scan.side)).ceil().max(1.0);
    let darker = if to.level < from.level { to } else { from };
    let share = |n: usize| {
        let value = smoothed(scan, from.place.lerp(to.place, n as f64 / count));
        let share = 1.0 - (darker.level - value) / darker.contrast;
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    };
    (0..=count as usize).map(share).fold(1.0, f64::min)
}

/// The mean value around a place: a quarter of it, and an eighth of each of six neighbours at twice the standard deviation.
fn smoothed(scan: &Scan, place: DVec3) -> f64 {
    let away = 2.0 * SMOOTHED * scan.side;
    let around = DVec3::AXES.into_iter().flat_map(|axis| [axis * away, axis * -away]);
    0.25 * scan.value(place) + around.map(|way| 0.125 * scan.value(place + way)).sum::<f64>()
}

#[cfg(test)]
#[path = "tests/way_level.rs"]
mod tests;
