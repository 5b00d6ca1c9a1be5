//! Estimates the point spread of the scanner from wide sections of vessels.

use glam::DVec3;
use rayon::prelude::*;

use crate::measure::estimation::Level;
use crate::measure::estimation::least;
use crate::measure::fit::Fit;
use crate::measure::fit::sections::{Bench, Known, noise};
use crate::measure::section::SectionPlane;
use crate::measure::section::blur::Blur;
use lumencut_core::error::Result;
use lumencut_core::math::statistics::median;
use lumencut_core::stop::{Stop, go_on};

/// Maximum and minimum number of sections from which the point spread is estimated.
const SECTIONS: (usize, usize) = (16, 3);

/// Minimum diameter of a section, in widths of the point spread.
pub(crate) const MIN_WIDTH: f64 = 3.0;

/// Limits of suitable sections: unobstructed fraction of directions, residual (times the noise), ratio of the axes.
const FREE: f64 = 0.95;
const LEAST_MISSED: f64 = 1.5;
const ROUND: f64 = 1.35;

/// The width is searched from 0.3 smallest voxel sides to 3 largest ones, and up to `SHARE` of a section's diameter.
const SEARCH_RANGE: [f64; 2] = [0.3, 3.0];
const SHARE: f64 = 0.5;

/// Estimates agree if their median deviation is at most this fraction of their median.
const AGREED: f64 = 0.15;

/// Minimum relative standard deviation, because errors of walls and noise are common to all sections.
const LEAST_SPREAD: f64 = 0.03;

/// Minimum length of the part that is used, in point spread widths, because neighbouring sections share voxels.
const MIN_EXTENT: f64 = 3.0;

const ROUNDS: usize = 14;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SharpEdges {
    pub fwhm: f64,
    pub deviation: f64,
    pub count: usize,
    /// Arc lengths of the first and last section (mm).
    pub ends: [f64; 2],
    /// In lung, the FWHM that the same sections show if their wall is too thin to be seen.
    pub(crate) without_wall: Option<f64>,
}

impl SharpEdges {
    pub(crate) fn on(&self) -> String {
        let [low, high] = self.ends;
        format!("{} wide sections from {low:.0} to {high:.0} mm", self.count)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SpreadEstimate {
    Width(SharpEdges),
    Nothing(&'static str),
}

/// Reason why nothing is estimated if the vessels are too narrow.
pub(crate) const TOO_NARROW: &str = "no vessel is wide enough to estimate it";

/// Reason why nothing is estimated if blur is too little to be seen.
pub(crate) const TOO_SHARP: &str = "the walls of wide vessels are sharper than the voxels can show";

/// Reason why nothing is estimated if the wide part is too short.
const TOO_SHORT: &str = "free, round stretches of wide vessels are too short to estimate it";

/// Estimates the point spread with which the widest sections fit best, given the lumen level visible in each section.
pub(crate) fn estimated(
    bench: &Bench,
    min_width: f64,
    places: &[SectionPlane],
    fits: &[Option<Fit>],
    stop: Stop,
) -> Result<SpreadEstimate> {
    let sides = bench.rays.voxels.world_from_index.matrix3;
    let noise = noise(fits);
    let wide = wide_sections(bench, min_width, fits, noise);
    if wide.len() < SECTIONS.1 {
        return Ok(SpreadEstimate::Nothing(TOO_NARROW));
    }
    let largest =
        [sides.x_axis, sides.y_axis, sides.z_axis].map(DVec3::length).into_iter().fold(0.0, f64::max);
    let [low, high] = [SEARCH_RANGE[0] * bench.rays.voxels.smallest_side, SEARCH_RANGE[1] * largest];
    let found: Vec<Result<Option<f64>>> = wide
        .par_iter()
        .map(|n| {
            go_on(stop)?;
            let Some(fit) = fits[*n] else { return Ok(None) };
            let known =
                Known { ellipse: fit.ellipse, lumen: [fit.lumen[0], 0.5], noise: Some(noise), wall: None };
            let Some(ready) = bench.ready(&places[*n], &known) else { return Ok(None) };
            let cost = |fwhm: f64| ready.missed(&Blur::new(fwhm, sides)).ok_or(());
            let widest = high.min(SHARE * 2.0 * fit.ellipse.semi_axes()[0]);
            Ok(least([low, widest], ROUNDS, cost).ok())
        })
        .collect();
    let mut best = Vec::new();
    for one in found {
        best.extend(one?);
    }
    let [fwhm, deviation] = match agreed(&mut best, [low, high]) {
        Ok(agreed) => agreed,
        Err(reason) => return Ok(SpreadEstimate::Nothing(reason)),
    };
    let short = |n: &usize| fits[*n].map(|fit| 2.0 * fit.ellipse.semi_axes()[0]);
    // The widths were chosen by an assumption: what came out decides whether they were wide enough.
    if median(&mut wide.iter().filter_map(short).collect::<Vec<f64>>())
        .is_none_or(|short| short < min_width * fwhm)
    {
        return Ok(SpreadEstimate::Nothing(TOO_NARROW));
    }
    let [first, last] = [wide.iter().min(), wide.iter().max()].map(|n| n.map_or(0.0, |n| places[*n].at));
    if last - first < MIN_EXTENT * fwhm {
        return Ok(SpreadEstimate::Nothing(TOO_SHORT));
    }
    let ends = [first, last];
    Ok(SpreadEstimate::Width(SharpEdges { fwhm, deviation, count: best.len(), ends, without_wall: None }))
}

/// Median and standard deviation of estimates that agree and lie inside the range, otherwise the reason why not.
fn agreed(best: &mut [f64], [low, high]: [f64; 2]) -> std::result::Result<Level, &'static str> {
    let Some(fwhm) = median(best).filter(|_| best.len() >= SECTIONS.1) else { return Err(TOO_NARROW) };
    let margin = 0.02 * (high - low);
    if fwhm < low + margin {
        return Err(TOO_SHARP);
    }
    let away: Vec<f64> = best.iter().map(|one| (one - fwhm).abs()).collect();
    match median(&mut { away }) {
        Some(away) if fwhm <= high - margin && away <= AGREED * fwhm => {
            // The deviation is not divided by √n, because errors of walls and noise are common to all sections.
            Ok([fwhm, (1.4826 * away).max(LEAST_SPREAD * fwhm)])
        }
        _ => Err("the walls of wide vessels give different widths"),
    }
}

fn wide_sections(bench: &Bench, min_width: f64, fits: &[Option<Fit>], noise: f64) -> Vec<usize> {
    let side = bench.rays.voxels.smallest_side;
    let mut wide: Vec<(f64, usize)> = (0..fits.len())
        .filter_map(|n| {
            let fit = fits[n]?;
            let [short, long] = fit.ellipse.semi_axes();
            let is_good = fit.free > FREE && fit.missed <= LEAST_MISSED * noise && long < ROUND * short;
            (is_good && 2.0 * short > min_width * bench.fwhm.max(1.2 * side)).then_some((2.0 * short, n))
        })
        .collect();
    wide.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    // Takes the wider half of the sections, then evenly spaced sections among them.
    wide.truncate(wide.len().div_ceil(2).max(SECTIONS.0));
    let every = wide.len().div_ceil(SECTIONS.0).max(1);
    wide.into_iter().step_by(every).map(|(_, n)| n).collect()
}

#[cfg(test)]
#[path = "tests/point_spread.rs"]
mod tests;
