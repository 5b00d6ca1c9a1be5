//! The content of a diameter chart: curves, flags and range of the diameter axis, in mm. The report, Python and the page draw it.

use lumencut_vessels::measure::profile::Profile;

use super::curves::{isolated, runs};
use crate::flag_table::{FLAGS, FlagLook};
use crate::text::fixed;

/// Upper end of the diameter axis, as a multiple of the largest diameter.
const HEADROOM: f64 = 1.12;

/// Half the width of the uncertainty band, in standard deviations.
pub const DEVIATIONS: f64 = 2.0;

/// Diameters smaller than this many times the FWHM are near the resolution limit.
pub(crate) const RESOLUTION_LIMIT_FWHM: f64 = 1.5;

/// The chart of a vessel. Values of sections that are left out are NaN.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Arc length of each section (mm).
    pub at: Vec<f64>,
    /// Diameter of the circle of the same area (mm).
    pub width: Vec<f64>,
    /// Shortest and longest diameters (mm).
    pub range: [Vec<f64>; 2],
    /// Both ends of the uncertainty band (mm).
    pub spread: [Vec<f64>; 2],
    /// Indices of sections between two omitted sections; they are drawn as dots.
    pub isolated: Vec<usize>,
    /// Arc length and diameter (mm) of omitted sections, if they fit in the chart.
    pub left_out: Vec<[f64; 2]>,
    /// Upper end of the diameter axis (mm).
    pub top: f64,
    /// Diameters below this limit are near the resolution of the scan (mm); none above the chart.
    pub limit: Option<f64>,
    /// The flags that occur, in the order of their rows below diameter 0.
    pub flags: Vec<FlagRow>,
}

/// A flag with the stretches of the vessel on which it is set.
#[derive(Clone, Debug)]
pub struct FlagRow {
    /// The flag.
    pub look: &'static FlagLook,
    /// Start and end of each stretch (arc lengths, mm), half a step beyond its sections.
    pub runs: Vec<[f64; 2]>,
}

impl Chart {
    /// The chart of a profile.
    pub fn of(profile: &Profile) -> Self {
        let counted = |values: &[f64]| -> Vec<f64> {
            (0..values.len()).map(|n| if profile.counts(n) { values[n] } else { f64::NAN }).collect()
        };
        let (all, top) = (profile.diameter_equivalent(), top(profile));
        let width = counted(&all);
        let spread = |sign: f64| -> Vec<f64> {
            let away = |n: usize| width[n] + sign * DEVIATIONS * profile.uncertainty[n];
            // The comparison keeps NaN.
            (0..width.len()).map(away).map(|edge| if edge < 0.0 { 0.0 } else { edge }).collect()
        };
        let is_left_out = |n: &usize| !profile.counts(*n) && all[*n] <= top;
        let limit = RESOLUTION_LIMIT_FWHM * profile.fwhm;
        Self {
            at: profile.arc_length.clone(),
            range: [&profile.diameter_min, &profile.diameter_max].map(|values| counted(values)),
            spread: [-1.0, 1.0].map(spread),
            isolated: isolated(&width),
            left_out: (0..all.len()).filter(is_left_out).map(|n| [profile.arc_length[n], all[n]]).collect(),
            limit: (limit < top).then_some(limit),
            flags: flag_rows(profile),
            width,
            top,
        }
    }

    /// Length of the vessel (mm).
    pub fn length(&self) -> f64 {
        self.at.last().copied().unwrap_or(0.0)
    }

    /// The limit in words, without unit.
    pub fn limit_words(&self) -> Option<String> {
        self.limit.map(|limit| format!("{RESOLUTION_LIMIT_FWHM} × FWHM: {}", fixed(limit, 2)))
    }
}

pub(super) fn flag_rows(profile: &Profile) -> Vec<FlagRow> {
    let (at, flags) = (&profile.arc_length, &profile.flags);
    let half = if at.len() > 1 { (at[1] - at[0]) / 2.0 } else { 0.5 };
    let row = |look: &'static FlagLook| FlagRow {
        look,
        runs: runs(flags.len(), |n| flags[n] & look.bit > 0)
            .into_iter()
            .map(|run| [at[run.start] - half, at[run.end - 1] + half])
            .collect(),
    };
    FLAGS.iter().map(row).filter(|row| !row.runs.is_empty()).collect()
}

/// The upper end of the diameter axis: above the largest diameter of reliable sections, else of all sections.
fn top(profile: &Profile) -> f64 {
    let most = longest_diameters(profile).into_iter().fold(0.0, f64::max);
    if most > 0.0 { HEADROOM * most } else { 1.0 }
}

/// The longest diameters of reliable sections, else of all measured sections (mm).
pub(super) fn longest_diameters(profile: &Profile) -> Vec<f64> {
    let among = |is_among: &dyn Fn(usize) -> bool| -> Vec<f64> {
        let among = (0..profile.len()).filter(|n| is_among(*n)).map(|n| profile.diameter_max[n]);
        among.filter(|value| value.is_finite()).collect()
    };
    let reliable = among(&|n| profile.counts(n));
    if reliable.is_empty() { among(&|_| true) } else { reliable }
}

#[cfg(test)]
#[path = "../tests/report_chart.rs"]
mod tests;
