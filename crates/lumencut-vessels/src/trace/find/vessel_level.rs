//! Estimates the level and contrast that vessels usually have, from tubes.

use crate::trace::find::track::{TrackPoint, length, usual};

/// Limits of a tube: radius (finest-level voxels), closure, contrast (times the noise), length (radii). If no
/// tube meets all limits, only the limit of the closure applies.
const LEAST_RADIUS: f64 = 2.0;
const LEAST_CLOSURE: f64 = 0.85;
const NOISES: f64 = 6.0;
const LEAST_LENGTH: f64 = 4.0;

/// Half the resolution dims no lumen from this radius on (finest-level voxels).
const WIDE: f64 = 4.0;

/// Intensity levels are similar if they differ by about this fraction of the contrast.
const KERNEL: f64 = 0.2;

/// Pale organs are round and even too. Their reading has less contrast than this fraction of the first one's, and
/// their tubes weigh less than this fraction of all.
const PALE: f64 = 0.35;
const RARE: f64 = 0.25;

/// Radii above this (finest-level voxels) do not increase the weight of a tube.
const WIDEST: f64 = 10.0;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct UsualLevel {
    /// Level and contrast.
    pub level: [f64; 2],
    /// Whether a tube that meets all limits is so wide that half the resolution does not dim it.
    pub is_wide: bool,
}

#[derive(Clone, Copy, Debug)]
struct Tube {
    level: f64,
    contrast: f64,
    radius: f64,
    weight: f64,
}

/// The first reading [level, contrast] and the one of round, even tubes alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Readings {
    /// The reading that holds.
    pub usual: [f64; 2],
    /// The other one, if one of them is far paler.
    pub other: Option<[f64; 2]>,
}

impl Readings {
    /// The second reading holds, unless it is that of organs among all tracks.
    pub(crate) fn of(first: [f64; 2], second: [f64; 2], tracks: &[Vec<TrackPoint>], noise: f64) -> Self {
        if second[1] >= PALE * first[1] {
            return Self { usual: second, other: None };
        }
        let tubes: Vec<Tube> = tracks.iter().filter_map(|points| tube(points, noise, true)).collect();
        let is_near = |tube: &&Tube| (tube.level - second[0]).abs() <= KERNEL * first[1];
        let weight = |tubes: &mut dyn Iterator<Item = &Tube>| tubes.map(|tube| tube.weight).sum::<f64>();
        let is_rare = weight(&mut tubes.iter().filter(is_near)) < RARE * weight(&mut tubes.iter());
        let [usual, other] = if is_rare { [first, second] } else { [second, first] };
        Self { usual, other: Some(other) }
    }
}

/// The most frequent level, and its contrast, with tubes weighted by length, width and contrast. None without tubes.
pub(crate) fn vessel_level(tracks: &[Vec<TrackPoint>], noise: f64) -> Option<UsualLevel> {
    let strict: Vec<Tube> = tracks.iter().filter_map(|points| tube(points, noise, true)).collect();
    let is_wide = strict.iter().any(|tube| tube.radius >= WIDE);
    let tubes = if strict.is_empty() {
        tracks.iter().filter_map(|points| tube(points, noise, false)).collect()
    } else {
        strict
    };
    let density = |center: &Tube| -> f64 {
        let alike = |other: &Tube| {
            let away = (other.level - center.level) / (KERNEL * center.contrast);
            other.weight * (-0.5 * away * away).exp()
        };
        tubes.iter().map(alike).sum()
    };
    let densities: Vec<f64> = tubes.iter().map(density).collect();
    let best = (0..tubes.len()).max_by(|&a, &b| densities[a].total_cmp(&densities[b]).then(b.cmp(&a)))?;
    let near = |tube: &&Tube| (tube.level - tubes[best].level).abs() <= KERNEL * tubes[best].contrast;
    let alike: Vec<Tube> = tubes.iter().filter(near).copied().collect();
    let weight: f64 = alike.iter().map(|tube| tube.weight).sum();
    let mean = |of: fn(&Tube) -> f64| alike.iter().map(|tube| of(tube) * tube.weight).sum::<f64>() / weight;
    Some(UsualLevel { level: [mean(|tube| tube.level), mean(|tube| tube.contrast)], is_wide })
}

/// The tube of a track; None if the track is too short, too narrow or too open.
fn tube(points: &[TrackPoint], noise: f64, is_strict: bool) -> Option<Tube> {
    let good = || points.iter().filter(|point| point.is_good);
    good().next()?;
    let median = |of: fn(&TrackPoint) -> f64| usual(good(), of);
    let (radius, level, contrast) = (median(|p| p.radius), median(|p| p.level), median(|p| p.contrast));
    let closure = good().map(|point| point.closure).sum::<f64>() / good().count() as f64;
    let length = length(points);
    let is_clear = radius >= LEAST_RADIUS && length >= LEAST_LENGTH * radius && contrast >= NOISES * noise;
    let tells = closure >= LEAST_CLOSURE && (is_clear || !is_strict);
    tells.then(|| Tube { level, contrast, radius, weight: length * radius.min(WIDEST) * contrast })
}

#[cfg(test)]
#[path = "tests/vessel_level.rs"]
mod tests;
