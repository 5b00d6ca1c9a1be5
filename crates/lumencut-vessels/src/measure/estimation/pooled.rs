//! Estimates the lumen level along a vessel from the sections that show it well. Contrast medium mixes along the
//! vessel, so nearby sections count most.

/// Distance (mm) over which the weight of a section falls to 1/e.
const DISTANCE: f64 = 25.0;

/// Minimum and maximum standard deviation of the pooled level, as fractions of the contrast.
const DEVIATION: [f64; 2] = [0.01, 0.08];

/// Larger differences between levels are clamped to this fraction of the contrast.
const MAX_DEVIATION: f64 = 0.3;

const MAX_SECTIONS: usize = 500;

pub(crate) type Level = [f64; 2];

pub(crate) fn pooled(at: &[f64], levels: &[Option<Level>]) -> Vec<Level> {
    let every = levels.len().div_ceil(MAX_SECTIONS).max(1);
    let mut levels: Vec<(f64, Level)> =
        at.iter().zip(levels).step_by(every).filter_map(|(at, level)| level.map(|l| (*at, l))).collect();
    levels.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]).then(a.0.total_cmp(&b.0)));
    at.iter().map(|at| level(*at, &levels)).collect()
}

/// Weighted median of the sorted levels; its deviation is their scatter beyond their own standard deviations.
fn level(at: f64, levels: &[(f64, Level)]) -> Level {
    let weights: Vec<f64> = levels
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
    let Some(level) = middle.map(|n| levels[n].1[0]) else { return [1.0, MAX_DEVIATION] };
    let mut excess = 0.0;
    for (weight, (_, [there, deviation])) in weights.iter().zip(levels) {
        let off = (there - level).abs().min(MAX_DEVIATION);
        excess += weight / all * (off * off - deviation * deviation);
    }
    let deviation = (DEVIATION[0].powi(2) + excess.max(0.0)).sqrt();
    [level, deviation.min(DEVIATION[1])]
}
