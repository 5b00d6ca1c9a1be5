//! The point spread of the scanner, estimated where the vessel is wide.

use glam::DMat3;
use rayon::prelude::*;

use super::blur::Blur;
use super::fit::Fit;
use super::golden::least;
use super::place::Place;
use super::rays::Rays;
use super::sections::{Bench, Known, noise};
use crate::error::Result;
use crate::math::statistics::median;
use crate::stop::{Stop, go_on};

/// At most so many sections tell the point spread, and at least so many.
const SECTIONS: (usize, usize) = (16, 3);

/// A section tells the point spread from so many times its width on.
const WIDE: f64 = 3.0;

/// It must be free of other things in this share of all directions, miss at most so many times what others do, and its longer
/// axis be at most so many times the shorter one.
const FREE: f64 = 0.95;
const LEAST_MISSED: f64 = 1.5;
const ROUND: f64 = 1.35;

/// What is looked for, in the smallest side of a voxel.
const RANGE: [f64; 2] = [0.4, 5.0];

/// How often the range is narrowed.
const ROUNDS: usize = 14;

/// A point spread and what it was estimated on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharpEdges {
    /// Its full width at half maximum (mm).
    pub fwhm: f64,
    /// How many sections told it.
    pub count: usize,
    /// The arc lengths of the first and the last of them (mm).
    pub ends: [f64; 2],
}

impl SharpEdges {
    /// What it was estimated on, in words.
    pub fn on(&self) -> String {
        let [low, high] = self.ends;
        format!("{} wide sections from {low:.0} to {high:.0} mm", self.count)
    }
}

/// The point spread with which the widest of the sections fit best, and what it was estimated on; None where the
/// vessel is nowhere wide.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn estimated(
    bench: &Bench,
    sides: DMat3,
    places: &[Place],
    fits: &[Option<Fit>],
    stop: Stop,
) -> Result<Option<SharpEdges>> {
    let side = bench.rays.voxels.smallest_side;
    let noise = noise(fits);
    let mut wide: Vec<(f64, usize)> = (0..fits.len())
        .filter_map(|n| {
            let fit = fits[n]?;
            let [short, long] = fit.ellipse.semi_axes();
            let is_good = fit.free > FREE && fit.missed <= LEAST_MISSED * noise && long < ROUND * short;
            (is_good && 2.0 * short > WIDE * bench.fwhm.max(1.2 * side)).then_some((2.0 * short, n))
        })
        .collect();
    wide.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    // The wider half of what is wide, evenly along the vessel.
    wide.truncate(wide.len().div_ceil(2).max(SECTIONS.0));
    let every = wide.len().div_ceil(SECTIONS.0).max(1);
    let wide: Vec<usize> = wide.into_iter().step_by(every).map(|(_, n)| n).collect();
    if wide.len() < SECTIONS.1 {
        return Ok(None);
    }
    let cost = |fwhm: f64, n: usize| {
        let bench = Bench {
            rays: Rays { voxels: bench.rays.voxels, scale: bench.rays.scale },
            blur: Blur::new(fwhm, sides),
            fwhm,
        };
        let fit = fits[n]?;
        let known = Known { ellipse: fit.ellipse, lumen: [fit.lumen[0], 0.5], noise: Some(noise) };
        bench.fit(&places[n], &known).map(|fit| fit.missed)
    };
    let found: Vec<Result<Option<f64>>> = wide
        .par_iter()
        .map(|n| {
            go_on(stop)?;
            Ok(within(RANGE.map(|share| share * side), |fwhm| cost(fwhm, *n)))
        })
        .collect();
    let mut best = Vec::new();
    for one in found {
        best.extend(one?);
    }
    let count = best.len();
    let Some(fwhm) = median(&mut best).filter(|_| count >= SECTIONS.1) else { return Ok(None) };
    let [low, high] = [wide.iter().min(), wide.iter().max()].map(|n| n.map_or(0.0, |n| places[*n].at));
    Ok(Some(SharpEdges { fwhm, count, ends: [low, high] }))
}

/// Where a function of one valley is least; None where it is not given, or least at an end.
fn within(ends: [f64; 2], function: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let found = least(ends, ROUNDS, |x| function(x).ok_or(())).ok()?;
    let margin = 0.02 * (ends[1] - ends[0]);
    (found > ends[0] + margin && found < ends[1] - margin).then_some(found)
}
