//! Finds the intensity level of the lumen along a vessel. A lumen narrower than two blur widths peaks below its true
//! level, so a single section cannot separate level and width. Wider sections nearby give the level; if there are
//! none, all sections share one level.

use rayon::prelude::*;

use crate::measure::estimation::Level;
use crate::measure::estimation::least;
use crate::measure::fit::Fit;
use crate::measure::fit::sections::{Bench, Known, noise};
use crate::measure::section::SectionPlane;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Sections that give the level: maximum standard deviation (fraction of the contrast), and minimum number.
const LEVEL_SECTIONS: (f64, usize) = (0.05, 3);

/// Maximum number of sections fitted with a common level.
const TOGETHER: usize = 48;

/// Search range of the level, as fractions of the contrast; the first guess is about 1.
const LEVEL_RANGE: [f64; 2] = [0.6, 4.0];

/// Relative standard deviation of a common level.
const DEVIATION: f64 = 0.05;

const ROUNDS: usize = 11;

/// Distance (mm) over which the weight of a section falls to 1/e.
const DISTANCE: f64 = 25.0;

/// Minimum and maximum standard deviation of the pooled level, as fractions of the contrast.
const POOLED_DEVIATION: [f64; 2] = [0.01, 0.08];

/// Larger differences between levels are clamped to this fraction of the contrast.
const MAX_DEVIATION: f64 = 0.3;

const MAX_SECTIONS: usize = 500;

/// Intensity level of the lumen and its standard deviation at each section, as fractions of the contrast.
pub(crate) fn lumen_levels(
    bench: &Bench,
    places: &[SectionPlane],
    fits: &[Option<Fit>],
    stop: Stop,
) -> Result<Vec<Level>> {
    let at: Vec<f64> = places.iter().map(|place| place.at).collect();
    let levels: Vec<Option<Level>> = fits
        .iter()
        .map(|fit| fit.map(|fit| fit.lumen).filter(|level| level[1] <= LEVEL_SECTIONS.0))
        .collect();
    if levels.iter().flatten().count() >= LEVEL_SECTIONS.1 {
        return Ok(pooled(&at, &levels));
    }
    let level = together(bench, places, fits, stop)?;
    Ok(vec![[level, DEVIATION * level]; places.len()])
}

/// The common level with which the sections fit best.
fn together(bench: &Bench, places: &[SectionPlane], fits: &[Option<Fit>], stop: Stop) -> Result<f64> {
    let noise = noise(fits);
    let fitted: Vec<(&SectionPlane, Fit)> =
        places.iter().zip(fits).filter_map(|(place, fit)| fit.map(|fit| (place, fit))).collect();
    let every = fitted.len().div_ceil(TOGETHER).max(1);
    let some: Vec<(&SectionPlane, Fit)> = fitted.into_iter().step_by(every).collect();
    let cost = |level: f64| -> Result<f64> {
        let costs: Vec<f64> = some
            .par_iter()
            .map(|(place, fit)| {
                go_on(stop)?;
                let known =
                    Known { ellipse: fit.ellipse, lumen: [level, 0.005], noise: Some(noise), wall: None };
                let missed = bench.ready(place, &known).and_then(|ready| ready.missed(&bench.blur));
                Ok(missed.map_or(0.0, |missed| missed * missed))
            })
            .collect::<Result<_>>()?;
        Ok(costs.iter().sum())
    };
    Ok(least(LEVEL_RANGE.map(f64::ln), ROUNDS, |level| cost(level.exp()))?.exp())
}

/// Levels pooled at each section. Contrast medium mixes along the vessel, so nearby sections count most.
fn pooled(at: &[f64], levels: &[Option<Level>]) -> Vec<Level> {
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
            (-(there - at).abs() / DISTANCE).exp() / (deviation * deviation + POOLED_DEVIATION[0].powi(2))
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
    let deviation = (POOLED_DEVIATION[0].powi(2) + excess.max(0.0)).sqrt();
    [level, deviation.min(POOLED_DEVIATION[1])]
}
