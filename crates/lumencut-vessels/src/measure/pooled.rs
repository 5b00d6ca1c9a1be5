//! The level of the lumen along a vessel, from the sections that tell it well.
//!
//! Where a lumen is narrower than two blurs its peak is lower than its level, and neither the level nor the width can be told
//! from the section alone. Contrast medium mixes: what the lumen's level is there is told by wider sections around.

/// How far along the vessel levels count (mm): by 1/e less with each.
const DISTANCE: f64 = 25.0;

/// The least uncertainty of a level, as a share, and the largest difference from the pooled level.
const DEVIATION: [f64; 2] = [0.01, 0.08];

/// A level as far off as that is wrong, as a share.
const WRONG: f64 = 0.3;

/// The largest number of sections that are pooled.
const MOST: usize = 500;

/// A level and its standard deviation, as shares.
pub type Level = [f64; 2];

/// The level of the lumen at each section, from those of all sections by their arc lengths (mm).
pub fn pooled(at: &[f64], levels: &[Option<Level>]) -> Vec<Level> {
    let every = levels.len().div_ceil(MOST).max(1);
    let mut told: Vec<(f64, Level)> =
        at.iter().zip(levels).step_by(every).filter_map(|(at, level)| level.map(|l| (*at, l))).collect();
    told.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]).then(a.0.total_cmp(&b.0)));
    at.iter().map(|at| level(*at, &told)).collect()
}

/// The weighted median of levels that are sorted, and how far those around it differ beyond what they are unsure by.
fn level(at: f64, told: &[(f64, Level)]) -> Level {
    let weights: Vec<f64> = told
        .iter()
        .map(|(there, [_, deviation])| {
            (-(there - at).abs() / DISTANCE).exp() / (deviation * deviation + DEVIATION[0].powi(2))
        })
        .collect();
    let all: f64 = weights.iter().sum();
    let mut below = 0.0;
    let middle = weights.iter().position(|weight| {
        below += weight;
        below >= 0.5 * all
    });
    let Some(level) = middle.map(|n| told[n].1[0]) else { return [1.0, WRONG] };
    let mut excess = 0.0;
    for (weight, (_, [there, deviation])) in weights.iter().zip(told) {
        let off = (there - level).abs().min(WRONG);
        excess += weight / all * (off * off - deviation * deviation);
    }
    let deviation = (DEVIATION[0].powi(2) + excess.max(0.0)).sqrt();
    [level, deviation.min(DEVIATION[1])]
}
