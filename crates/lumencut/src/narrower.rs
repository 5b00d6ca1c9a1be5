//! The place that is narrower than the suggested or marked one, and the reason why it is not suggested.

use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::hindrances::{CHANGE_OF_LUMEN, FLAP, UNSURE};
use lumencut_vessels::measure::stenosis::suggestions::Spot;

use crate::flag_table::FLAGS;

pub(crate) const HINDRANCES: [(u32, &str); 3] = [
    (CHANGE_OF_LUMEN, "change of lumen"),
    (FLAP, "another lumen at an uneven wall"),
    (UNSURE, "unsure diameter"),
];

/// The place that is narrower than the suggested one, and than the marked place `at` (mm), in one sentence.
pub(crate) fn narrower(profile: &Profile, at: Option<f64>) -> Option<String> {
    let diameter = |at: f64| profile.diameter_equivalent()[profile.nearest_section(at)];
    let is_narrower = |spot: Spot| at.is_none_or(|at| diameter(spot.at) < diameter(at));
    let (spot, hindrances) = profile.passed_over().filter(|(spot, _)| is_narrower(*spot))?;
    // The list of places shows the diameter of the section itself.
    Some(passed_over(Spot { diameter: diameter(spot.at), ..spot }, hindrances))
}

fn passed_over(spot: Spot, hindrances: u32) -> String {
    let bits = FLAGS.iter().map(|flag| (flag.bit, flag.word)).chain(HINDRANCES);
    let words: Vec<&str> = bits.filter(|(bit, _)| hindrances & bit != 0).map(|(_, word)| word).collect();
    let why =
        if words.is_empty() { "the vessel tapers towards its end".to_owned() } else { words.join(", ") };
    format!("Narrower, but not suggested: {:.2} mm at {:.1} mm ({why}). Check it.", spot.diameter, spot.at)
}

#[cfg(test)]
#[path = "tests/narrower.rs"]
mod tests;
