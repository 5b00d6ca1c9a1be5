//! Why no place is suggested on a vessel, in words that every host tells.

use lumencut_vessels::measure::hindrances::{CHANGE_OF_LUMEN, FLAP, UNSURE};
use lumencut_vessels::measure::profile::Profile;

use crate::measure_words::of_flags;
use crate::profile_marks::{main_place, offered_references};

/// What hinders a suggestion beside the flags, as words.
pub const HINDRANCES: [(u32, &str); 3] =
    [(CHANGE_OF_LUMEN, "change of lumen"), (FLAP, "flap"), (UNSURE, "unsure diameter")];

/// Why the narrowest place, or any reference, is not suggested beside what a reader marked (arc lengths, mm): a sentence each,
/// none where they are suggested or marked.
pub fn not_suggested(profile: &Profile, at: Option<f64>, references: &[f64]) -> Vec<String> {
    match main_place(profile, at) {
        None => profile.none_safe().map(none_safe).into_iter().collect(),
        Some(_) if !references.is_empty() => Vec::new(),
        Some(main) => {
            let is_none =
                offered_references(profile, at, references).is_ok_and(|offered| offered == [None; 2]);
            is_none.then(|| no_reference(main)).into_iter().collect()
        }
    }
}

fn none_safe(bits: u32) -> String {
    let words = of_hindrances(bits).join(", ");
    format!("No narrowest place is suggested, as no section is safe: {words}. Mark the place yourself.")
}

fn no_reference(at: f64) -> String {
    format!(
        "No reference is suggested for {at:.1} mm: no place within 50 mm has parallel walls, is at least as wide, lies one diameter \
         away, and is safe. Mark it yourself where the vessel is normal."
    )
}

/// Hindrances as words: those of the flags, then the others.
pub fn of_hindrances(bits: u32) -> Vec<String> {
    let others = HINDRANCES.iter().filter(|(bit, _)| bits & bit != 0);
    of_flags(bits).into_iter().chain(others.map(|(_, word)| (*word).to_owned())).collect()
}

#[cfg(test)]
#[path = "tests/not_suggested.rs"]
mod tests;
