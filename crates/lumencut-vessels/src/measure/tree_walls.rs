//! What the vessels of a tree tell of each other's walls: they are of one patient in one scan, so that their levels are alike, but
//! not the same.
//!
//! The level of a vessel is that of the tree plus a difference of its own. How large these differences are is not known: several
//! standard deviations of them are tried, and each counts by how likely it makes what the vessels told.

use super::branches::shares_line;
use super::pooled::Level;
use lumencut_core::vessel_tree::Vessel;

/// By how much vessels of a tree may differ from each other, as shares of the standard deviation that is expected beforehand.
const APART: [f64; 6] = [0.16, 0.32, 0.48, 0.64, 0.8, 0.96];

/// What the sections of a vessel tell of the level of its wall, without what is expected beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToldWall {
    /// The number of the vessel in its tree.
    pub vessel: usize,
    /// The level and its standard deviation, in the volume's unit.
    pub level: Level,
}

/// The level of the wall of a vessel that other vessels let expect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PooledWall {
    /// The level and its standard deviation, in the volume's unit.
    pub level: Level,
    /// How many other vessels told it.
    pub vessels: usize,
}

/// The level that the other vessels of a tree let expect of a vessel's wall, where any of them tells something: those that share a
/// part of its line are not asked, as they are of the same voxels.
pub fn wall_beside(
    walls: &[ToldWall],
    tree: &[Vessel],
    vessel: &Vessel,
    expected: Level,
) -> Option<PooledWall> {
    let told: Vec<Level> = walls
        .iter()
        .filter(|wall| tree.get(wall.vessel).is_some_and(|other| !shares_line(other, vessel)))
        .map(|wall| wall.level)
        .collect();
    (!told.is_empty()).then(|| PooledWall { level: by_others(expected, &told), vessels: told.len() })
}

/// The level of a wall that is expected, and its standard deviation, by what is expected beforehand and what others told.
fn by_others(expected: Level, told: &[Level]) -> Level {
    let mut told = told.to_vec();
    // The last digit would else depend on the order of the vessels.
    told.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let tried = APART.map(|share| by_others_apart(expected, share * expected[1], &told));
    let likeliest = tried.iter().map(|(likely, _)| *likely).fold(f64::NEG_INFINITY, f64::max);
    let weights = tried.map(|(likely, _)| (likely - likeliest).exp());
    let mean_of = |of: &dyn Fn(&Level) -> f64| {
        let sum: f64 = weights.iter().zip(&tried).map(|(weight, (_, level))| weight * of(level)).sum();
        sum / weights.iter().sum::<f64>()
    };
    let mean = mean_of(&|level| level[0]);
    [mean, mean_of(&|level| level[1].powi(2) + (level[0] - mean).powi(2)).sqrt()]
}

/// The same where vessels differ by a standard deviation `apart` from their tree, and the logarithm of how likely what the others
/// told is then.
fn by_others_apart([mean, deviation]: Level, apart: f64, told: &[Level]) -> (f64, Level) {
    let between = apart.powi(2);
    let (mut level, mut variance, mut likely) = (mean, deviation.powi(2) - between, 0.0);
    for [there, unsure] in told {
        let all = variance + between + unsure.powi(2);
        likely -= 0.5 * (all.ln() + (there - level).powi(2) / all);
        let gain = variance / all;
        level += gain * (there - level);
        variance *= 1.0 - gain;
    }
    (likely, [level, (variance + between).sqrt()])
}

#[cfg(test)]
#[path = "tests/tree_walls.rs"]
mod tests;
