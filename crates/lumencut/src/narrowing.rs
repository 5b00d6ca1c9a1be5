//! Measured diameters at places of a vessel; local narrowing, and deviation from the reference, around graded stenoses.

use std::ops::RangeInclusive;

use lumencut_core::math::arc_length::LinePlace;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::{Method, Stenosis};

/// A stenosis without a reference place extends over at most this many reference diameters on each side.
const REACH: f64 = 3.0;

/// By how much the vessel is narrower than its reference (%), in the measure of the stenosis, so that the value at its place is its
/// percentage; NaN beyond it. It ends at a reference, or where the vessel is as wide as the reference.
pub(crate) fn narrowings(profile: &Profile, stenoses: &[Stenosis], places: &[f64]) -> Vec<f64> {
    let mut values = vec![f64::NAN; places.len()];
    for stenosis in stenoses {
        let reach = reach(stenosis);
        let middle = places.partition_point(|at| *at < stenosis.at);
        let narrowing = |n: usize| {
            let percent = percent(stenosis, measured(profile, places[n])[0], places[n]);
            (n, percent)
        };
        let goes_on = |(n, percent): &(usize, f64)| *percent > 0.0 && reach.contains(&places[*n]);
        let before = (0..middle).rev().map(narrowing).take_while(goes_on);
        let after = (middle..places.len()).map(narrowing).take_while(goes_on);
        for (n, percent) in before.chain(after) {
            values[n] = percent.max(values[n]);
        }
    }
    values
}

/// The diameter minus the reference of the nearest stenosis (mm); NaN without a stenosis.
pub(crate) fn deviations(profile: &Profile, stenoses: &[Stenosis], places: &[f64]) -> Vec<f64> {
    let away = |stenosis: &Stenosis, at: f64| (stenosis.at - at).abs();
    let deviation = |at: &f64| {
        let nearest = stenoses.iter().min_by(|a, b| away(a, *at).total_cmp(&away(b, *at)));
        nearest.map_or(f64::NAN, |stenosis| measured(profile, *at)[0] - reference(stenosis, *at))
    };
    places.iter().map(deviation).collect()
}

/// Diameter and its standard deviation (mm); NaN if the nearest section does not count.
pub(crate) fn measured(profile: &Profile, at: f64) -> [f64; 2] {
    let at = at.clamp(profile.arc_length[0], profile.arc_length[profile.len() - 1]);
    let LinePlace { segment, share } = LinePlace::at(&profile.arc_length, at);
    let nearest = (segment + usize::from(share > 0.5)).min(profile.len() - 1);
    let known = profile.diameter_at(at).ok().filter(|_| profile.counts(nearest));
    known.map_or([f64::NAN; 2], <[f64; 2]>::from)
}

fn percent(stenosis: &Stenosis, diameter: f64, at: f64) -> f64 {
    let share = diameter / reference(stenosis, at);
    let left = if stenosis.method == Method::Area { share * share } else { share };
    100.0 * (1.0 - left)
}

/// The reference diameter (mm) at an arc length: linear between two references, beyond them that of the nearer one.
fn reference(stenosis: &Stenosis, at: f64) -> f64 {
    match (stenosis.method, &stenosis.references[..]) {
        (Method::Nascet | Method::Area, [[a, first], [b, second]]) => {
            first + (second - first) * ((at - a) / (b - a)).clamp(0.0, 1.0)
        }
        _ => stenosis.reference,
    }
}

/// The arc lengths (mm) between which a stenosis can extend: to its references, equally far on a side without one.
fn reach(stenosis: &Stenosis) -> RangeInclusive<f64> {
    let at = stenosis.at;
    let known = if stenosis.method == Method::Ecst { &[][..] } else { &stenosis.references };
    let away = known.iter().map(|[place, _]| (place - at).abs()).reduce(f64::max);
    let usual = away.unwrap_or(REACH * stenosis.reference);
    let beside =
        |is_side: &dyn Fn(f64) -> bool| known.iter().map(|[place, _]| *place).find(|place| is_side(*place));
    let from = beside(&|place| place < at).unwrap_or(at - usual);
    let to = beside(&|place| place > at).unwrap_or(at + usual);
    from..=to
}
