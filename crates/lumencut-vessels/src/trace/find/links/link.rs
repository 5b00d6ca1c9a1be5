//! A link between two tracks, and how much the values on a straight line between two lumens look like lumen.

use crate::trace::find::scan::Scan;
use glam::DVec3;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    /// Index of one track, and index of its point.
    pub from: [usize; 2],
    /// Index of the other track, and index of its point.
    pub to: [usize; 2],
    /// Cost of the link (mm).
    pub cost: f64,
    /// Length of the link outside both lumens (mm).
    pub gap: f64,
    /// Lowest level along the link: 0 is tissue, 1 is lumen.
    pub level: f64,
}

impl Link {
    pub(crate) fn order(&self, other: &Self) -> std::cmp::Ordering {
        let numbers = |link: &Self| (link.from, link.to);
        self.cost.total_cmp(&other.cost).then_with(|| numbers(self).cmp(&numbers(other)))
    }
}

/// Distance between samples on the line (voxels).
const STEP: f64 = 0.5;

/// Standard deviation of the smoothing (voxels).
const SMOOTHED: f64 = 0.6;

#[derive(Clone, Copy, Debug)]
pub(crate) struct WayEnd {
    pub place: DVec3,
    pub level: f64,
    pub contrast: f64,
}

/// Lowest value on the line: 0 is tissue, 1 is the lumen of the darker end (the branch). Outside the volume it is 0.
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

/// Mean with weight 1/4 for the position, and 1/8 for each of six neighbours two standard deviations away.
fn smoothed(scan: &Scan, place: DVec3) -> f64 {
    let away = 2.0 * SMOOTHED * scan.side;
    let around = DVec3::AXES.into_iter().flat_map(|axis| [axis * away, axis * -away]);
    0.25 * scan.value(place) + around.map(|way| 0.125 * scan.value(place + way)).sum::<f64>()
}

#[cfg(test)]
#[path = "tests/link.rs"]
mod tests;
