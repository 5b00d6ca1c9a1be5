//! Finds the intensity level of the lumen along a vessel. A lumen narrower than two blur widths peaks below its true
//! level, so a single section cannot separate level and width. Wider sections nearby give the level; if there are
//! none, all sections share one level.

use rayon::prelude::*;

use crate::measure::estimation::golden::least;
use crate::measure::estimation::pooled::{Level, pooled};
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
