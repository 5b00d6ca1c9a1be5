//! The level of the lumen along a vessel.
//!
//! Where a lumen is narrower than two blurs its peak is lower than its level, and neither the level nor the width can be told
//! from the section alone. What the level is there is told by wider sections around; where the whole vessel is narrow, by all
//! of its sections together: the level with which they fit best.

use rayon::prelude::*;

use super::fit::Fit;
use super::golden::least;
use super::place::Place;
use super::pooled::{Level, pooled};
use super::sections::{Bench, Known, noise};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// A section tells the level where the standard deviation is at most this, as a share; at least this number of sections must.
const TELLS: (f64, usize) = (0.05, 3);

/// The most sections that tell the level together.
const TOGETHER: usize = 48;

/// Where it is looked for, as a share; the first guess is about 1.
const RANGE: [f64; 2] = [0.6, 4.0];

/// How well a level that was found together is known, as a share of it.
const DEVIATION: f64 = 0.05;

/// How often the range is narrowed.
const ROUNDS: usize = 11;

/// The level of the lumen at each section, and its standard deviation, as shares.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn lumen_levels(bench: &Bench, places: &[Place], fits: &[Option<Fit>], stop: Stop) -> Result<Vec<Level>> {
    let at: Vec<f64> = places.iter().map(|place| place.at).collect();
    let told: Vec<Option<Level>> =
        fits.iter().map(|fit| fit.map(|fit| fit.lumen).filter(|level| level[1] <= TELLS.0)).collect();
    if told.iter().flatten().count() >= TELLS.1 {
        return Ok(pooled(&at, &told));
    }
    let level = together(bench, places, fits, stop)?;
    Ok(vec![[level, DEVIATION * level]; places.len()])
}

/// The level with which sections fit best together.
fn together(bench: &Bench, places: &[Place], fits: &[Option<Fit>], stop: Stop) -> Result<f64> {
    let noise = noise(fits);
    let fitted: Vec<(&Place, Fit)> =
        places.iter().zip(fits).filter_map(|(place, fit)| fit.map(|fit| (place, fit))).collect();
    let every = fitted.len().div_ceil(TOGETHER).max(1);
    let some: Vec<(&Place, Fit)> = fitted.into_iter().step_by(every).collect();
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
    Ok(least(RANGE.map(f64::ln), ROUNDS, |level| cost(level.exp()))?.exp())
}
