//! Describes the unmeasured ends of a vessel.

use std::ops::Range;

use lumencut_core::math::statistics::median;
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

/// A stretch of lumen is much darker if its contrast is this share of that of the measured part; below, it may be tissue.
const DARKER: Range<f64> = 0.1..0.6;

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
        let why = if is_bright {
            "the vessel is as bright as its surroundings there.".to_owned()
        } else {
            darker(profile, [from, to]).unwrap_or_else(|| "no wall was found there.".to_owned())
        };
        let on = if side == "from" { " on" } else { "" };
        let words = format!("Not measured {side} {cut:.0} mm{on}: {why}");
        NotMeasured { from_mm: from, to_mm: to, cut_mm: cut, words }
    })
    .collect()
}

/// The reason that the lumen of a stretch (arc lengths, mm) is much darker than that of the measured part; None for another reason.
/// Each part of the vessel has its own levels, so they can be measured separately.
fn darker(profile: &Profile, [from, to]: [f64; 2]) -> Option<String> {
    let within = |n: &usize| (from..=to).contains(&profile.arc_length[*n]) && profile.area[*n].is_nan();
    let middle = |values: &mut dyn Iterator<Item = f64>| median(&mut values.collect::<Vec<f64>>());
    let dark = middle(&mut (0..profile.len()).filter(within).map(|n| profile.line_values[n]))?;
    let measured = || (0..profile.len()).filter(|n| profile.counts(*n));
    let [lumen, around] = [0, 1].map(|side| middle(&mut measured().map(|n| profile.levels[n][side])));
    let (lumen, around) = (lumen?, around?);
    let share = (dark - around) / (lumen - around);
    let words = format!(
        "the lumen is much darker there, about {dark:.0} instead of {lumen:.0}. Cut the vessel there to measure both parts."
    );
    (DARKER.contains(&share)).then_some(words)
}

#[cfg(test)]
#[path = "tests/not_measured.rs"]
mod tests;
