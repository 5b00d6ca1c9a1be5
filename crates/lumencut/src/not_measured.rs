//! What of a vessel was not measured, in words that every host tells.

use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

/// A stretch of a vessel that was not measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct NotMeasured {
    /// Where it begins (arc length, mm).
    pub from_mm: f64,
    /// Where it ends (arc length, mm).
    pub to_mm: f64,
    /// Where the vessel can be cut so that this stretch is off it (arc length, mm).
    pub cut_mm: f64,
    /// That it was not measured, and why.
    pub words: String,
}

/// The stretches that were not measured as nothing tells lumen from its surroundings there; none of most vessels.
pub fn not_measured(profile: &Profile) -> Vec<NotMeasured> {
    const WHY: &str = "the vessel is as bright as its surroundings there";
    let told = |[from, to]: &[f64; 2]| {
        let (cut, part) = if *from <= 0.0 {
            (*to, format!("up to {to:.0} mm"))
        } else {
            (*from, format!("from {from:.0} mm on"))
        };
        NotMeasured { from_mm: *from, to_mm: *to, cut_mm: cut, words: format!("Not measured {part}: {WHY}.") }
    };
    profile.without_wall.iter().map(told).collect()
}

#[cfg(test)]
#[path = "tests/not_measured.rs"]
mod tests;
