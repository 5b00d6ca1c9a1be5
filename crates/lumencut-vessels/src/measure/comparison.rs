//! Compares the lumen of a vessel in two scans: the difference of the diameters at places that belong together, with the uncertainties
//! of both.

pub mod matching;
pub mod rigid;

use crate::measure::comparison::matching::{Matching, matching};
use crate::measure::profile::Profile;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::LinePlace;
use lumencut_core::math::statistics::median;

/// A difference counts beyond this many standard deviations.
pub const DEVIATIONS: f64 = 2.0;
/// A change lasts at least this long along the vessel (mm): noise changes single sections.
const SHORTEST_CHANGE: f64 = 2.0;
/// The slope of a diameter is taken over this distance to both sides (mm).
const SLOPE_OVER: f64 = 1.5;

/// A place in both scans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedPlace {
    /// Arc length on the first and on the second vessel (mm); NaN beyond the ends of the second.
    pub at: [f64; 2],
    /// Both diameters (mm); NaN where nothing counts.
    pub diameter: [f64; 2],
    /// Both standard deviations (mm).
    pub uncertainty: [f64; 2],
    /// The second diameter minus the first (mm).
    pub difference: f64,
    /// Its standard deviation (mm), from both diameters and from the places.
    pub difference_uncertainty: f64,
}

impl ComparedPlace {
    /// Whether the difference is beyond the uncertainties.
    pub fn differs(&self) -> bool {
        self.difference.abs() > DEVIATIONS * self.difference_uncertainty
    }
}

/// A part of the vessel that is wider or narrower in the second scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Its ends on the first vessel (arc lengths, mm).
    pub range: [f64; 2],
    /// The place of the largest difference.
    pub largest: ComparedPlace,
}

/// Two profiles of a vessel, compared.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// How the vessels were matched.
    pub matching: Matching,
    /// A place for each section of the first vessel.
    pub places: Vec<ComparedPlace>,
    /// Parts that changed, in order.
    pub changes: Vec<Change>,
    /// The median difference (mm): far from 0 where the scans themselves differ, for example in their blur.
    pub typical: f64,
}

/// Compares the profiles of a vessel in two scans; `pairs` are places that belong together (arc lengths on both, mm). Fails as
/// [`matching`] does.
pub fn compare(first: &Profile, second: &Profile, pairs: &[[f64; 2]]) -> Result<Comparison> {
    let matching = matching(first, second, pairs)?;
    let widths = [first, second].map(counted);
    let place = |n: usize| {
        let at = [first.arc_length[n], matching.at[n].unwrap_or(f64::NAN)];
        let section = |which: usize, profile: &Profile| read(profile, &widths[which], at[which]);
        let [a, b] = [section(0, first), section(1, second)];
        let shift = matching.deviation * f64::midpoint(a.slope.abs(), b.slope.abs());
        ComparedPlace {
            at,
            diameter: [a.diameter, b.diameter],
            uncertainty: [a.uncertainty, b.uncertainty],
            difference: b.diameter - a.diameter,
            difference_uncertainty: a.uncertainty.hypot(b.uncertainty).hypot(shift),
        }
    };
    let places: Vec<ComparedPlace> = (0..first.len()).map(place).collect();
    let mut differences: Vec<f64> =
        places.iter().map(|place| place.difference).filter(|value| value.is_finite()).collect();
    Ok(Comparison {
        changes: changes(&places),
        typical: median(&mut differences).unwrap_or(f64::NAN),
        matching,
        places,
    })
}

/// The diameters of the sections that count, NaN elsewhere.
fn counted(profile: &Profile) -> Vec<f64> {
    let all = profile.diameter_equivalent();
    (0..profile.len()).map(|n| if profile.counts(n) { all[n] } else { f64::NAN }).collect()
}

struct Read {
    diameter: f64,
    uncertainty: f64,
    /// Change of the diameter per mm along the vessel; 0 where it is not known.
    slope: f64,
}

fn read(profile: &Profile, widths: &[f64], at: f64) -> Read {
    if !at.is_finite() {
        return Read { diameter: f64::NAN, uncertainty: f64::NAN, slope: 0.0 };
    }
    let value = |values: &[f64], at: f64| LinePlace::at(&profile.arc_length, at).value(values);
    let slope = (value(widths, at + SLOPE_OVER) - value(widths, at - SLOPE_OVER)) / (2.0 * SLOPE_OVER);
    Read {
        diameter: value(widths, at),
        uncertainty: value(&profile.uncertainty, at),
        slope: if slope.is_finite() { slope } else { 0.0 },
    }
}

fn changes(places: &[ComparedPlace]) -> Vec<Change> {
    let sign = |place: &ComparedPlace| if place.differs() { place.difference.signum() as i8 } else { 0 };
    let runs = places.chunk_by(|a, b| sign(a) == sign(b)).filter(|run| sign(&run[0]) != 0);
    let change = |run: &[ComparedPlace]| {
        let range = [run[0].at[0], run[run.len() - 1].at[0]];
        let sure = |place: &&ComparedPlace| place.difference.abs();
        let largest = run.iter().max_by(|a, b| sure(a).total_cmp(&sure(b)))?;
        (range[1] - range[0] >= SHORTEST_CHANGE).then_some(Change { range, largest: *largest })
    };
    runs.filter_map(change).collect()
}

#[cfg(test)]
#[path = "comparison/tests/comparison.rs"]
mod tests;
