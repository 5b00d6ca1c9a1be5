//! Combines the wall levels of the vessels of a tree. The level of a vessel is that of the tree plus an individual
//! difference. The spread of these differences is unknown, so several standard deviations are tried, each weighted by
//! its likelihood.

use crate::measure::beside::branches::shares_line;
use crate::measure::estimation::Level;
use lumencut_core::vessel_tree::Vessel;

/// Standard deviations of the differences that are tried, as fractions of the prior standard deviation.
const TRIED_DEVIATIONS: [f64; 6] = [0.16, 0.32, 0.48, 0.64, 0.8, 0.96];

/// Wall level found on the sections of a vessel, without the prior.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct VesselWall {
    /// Index of the vessel in its tree.
    pub vessel: usize,
    /// Level and standard deviation, in the volume's unit.
    pub level: Level,
}

/// Wall level expected from other vessels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PooledWall {
    /// Level and standard deviation, in the volume's unit.
    pub level: Level,
    /// Number of the other vessels that were used.
    pub vessels: usize,
}

/// Wall level expected from the other vessels of the tree, except those that share voxels with this one.
pub(crate) fn wall_beside(
    walls: &[VesselWall],
    tree: &[Vessel],
    vessel: &Vessel,
    expected: Level,
) -> Option<PooledWall> {
    let levels: Vec<Level> = walls
        .iter()
        .filter(|wall| tree.get(wall.vessel).is_some_and(|other| !shares_line(other, vessel)))
        .map(|wall| wall.level)
        .collect();
    (!levels.is_empty()).then(|| PooledWall { level: by_others(expected, &levels), vessels: levels.len() })
}

fn by_others(expected: Level, levels: &[Level]) -> Level {
    let mut levels = levels.to_vec();
    // The sorted order makes the result independent of the order of the vessels.
    levels.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let tried =
        TRIED_DEVIATIONS.map(|share| by_others_with_deviation(expected, share * expected[1], &levels));
    let likeliest = tried.iter().map(|(likely, _)| *likely).fold(f64::NEG_INFINITY, f64::max);
    let weights = tried.map(|(likely, _)| (likely - likeliest).exp());
    let mean_of = |of: &dyn Fn(&Level) -> f64| {
        let sum: f64 = weights.iter().zip(&tried).map(|(weight, (_, level))| weight * of(level)).sum();
        sum / weights.iter().sum::<f64>()
    };
    let mean = mean_of(&|level| level[0]);
    [mean, mean_of(&|level| level[1].powi(2) + (level[0] - mean).powi(2)).sqrt()]
}

/// Log-likelihood that vessels differ from their tree by a standard deviation `apart`, and the level then estimated.
fn by_others_with_deviation([mean, deviation]: Level, apart: f64, levels: &[Level]) -> (f64, Level) {
    let between = apart.powi(2);
    let (mut level, mut variance, mut likely) = (mean, deviation.powi(2) - between, 0.0);
    for [there, unsure] in levels {
        let all = variance + between + unsure.powi(2);
        likely -= 0.5 * (all.ln() + (there - level).powi(2) / all);
        let gain = variance / all;
        level += gain * (there - level);
        variance *= 1.0 - gain;
    }
    (likely, [level, (variance + between).sqrt()])
}

#[cfg(test)]
#[path = "tests/tree.rs"]
mod tests;
