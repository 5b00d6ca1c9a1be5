//! Describes the unmeasured ends of a vessel.

use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

/// A stretch of a vessel where nothing was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct NotMeasured {
    pub(crate) from_mm: f64,
    pub(crate) to_mm: f64,
    /// Where to cut the vessel to remove the unmeasured stretch (arc length, mm).
    pub(crate) cut_mm: f64,
    /// A sentence that states the reason.
    pub words: String,
}

/// Unmeasured ends shorter than this (mm) are not reported, since many vessels have them.
const MIN_LENGTH_MM: f64 = 10.0;

/// The unmeasured ends of a vessel.
pub fn not_measured(profile: &Profile) -> Vec<NotMeasured> {
    let mut measured = (0..profile.len()).filter(|n| profile.area[*n].is_finite());
    let Some(first) = measured.next() else { return Vec::new() };
    let last = measured.next_back().unwrap_or(first);
    let [low, high] = [first, last].map(|n| profile.arc_length[n]);
    let ends = [(low, [0.0, low], "up to"), (high, [high, profile.length()], "from")];
    let long = ends.into_iter().filter(|(_, [from, to], _)| to - from >= MIN_LENGTH_MM);
    long.map(|(cut, [from, to], side)| {
        let is_bright = profile.without_wall.iter().any(|[begin, end]| *begin < to && *end > from);
        let why = if is_bright { "the vessel is as bright as its surroundings" } else { "no wall was found" };
        let on = if side == "from" { " on" } else { "" };
        let words = format!("Not measured {side} {cut:.0} mm{on}: {why} there.");
        NotMeasured { from_mm: from, to_mm: to, cut_mm: cut, words }
    })
    .collect()
}

#[cfg(test)]
#[path = "tests/not_measured.rs"]
mod tests;
