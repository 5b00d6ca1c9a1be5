//! Describes why no place on a vessel is suggested as narrowest place or reference.

use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::suggestions::Spot;

use crate::flag_table::FLAGS;
use crate::narrower::{HINDRANCES, narrower};
use crate::profile_marks::{main_place, offered_references};

/// Why no narrowest place or reference is suggested, or a narrower place is not, a sentence each; `at` and `references` are marked places (mm).
pub fn not_suggested(profile: &Profile, at: Option<f64>, references: &[f64]) -> Vec<String> {
    let throat = profile.throat().filter(|_| at.is_none()).map(no_clear_wall);
    throat.into_iter().chain(narrower(profile, at)).chain(no_place(profile, at, references)).collect()
}

fn no_place(profile: &Profile, at: Option<f64>, references: &[f64]) -> Vec<String> {
    match main_place(profile, at) {
        None => {
            let unsafe_ones = profile.none_safe().map(|_| none_safe(profile));
            unsafe_ones.or_else(|| profile.thin_end().map(only_thinner)).into_iter().collect()
        }
        Some(_) if !references.is_empty() => Vec::new(),
        Some(main) => {
            let is_none =
                offered_references(profile, at, references).is_ok_and(|offered| offered == [None; 2]);
            is_none.then(|| no_reference(main)).into_iter().collect()
        }
    }
}

/// Only this many reasons are reported: those that apply to the most sections.
const MAX_REASONS: usize = 3;

fn none_safe(profile: &Profile) -> String {
    let hindrances = profile.hindrances();
    let counting: Vec<usize> = (0..profile.len()).filter(|n| profile.counts(*n)).collect();
    let all: Vec<usize> = (0..profile.len()).collect();
    let told = if counting.is_empty() { &all } else { &counting };
    let counted = |bit: u32| told.iter().filter(|n| hindrances[**n] & bit != 0).count();
    let bits = FLAGS.iter().map(|flag| (flag.bit, flag.word)).chain(HINDRANCES);
    // Inserting into a short list needs less code than a sort.
    let mut found: Vec<(usize, &str)> = Vec::new();
    for (bit, word) in bits {
        let count = counted(bit);
        let place = found.partition_point(|(other, _)| *other >= count);
        if count > 0 && place < MAX_REASONS {
            found.insert(place, (count, word));
            found.truncate(MAX_REASONS);
        }
    }
    let words: Vec<&str> = found.iter().map(|(_, word)| *word).collect();
    let why = if words.is_empty() { String::new() } else { format!(" ({})", words.join(", ")) };
    let found = match counting.len() {
        0 => "no section counts".to_owned(),
        count => format!("each of the {count} sections that count has a doubt"),
    };
    format!("No narrowest place is suggested: {found}{why}. Mark it yourself.")
}

fn no_clear_wall(throat: Spot) -> String {
    format!(
        "Narrowest place: no clear wall at {:.1} mm, where the lumen is at most {:.2} mm wide. Check the sections there.",
        throat.at, throat.diameter
    )
}

fn only_thinner(end: Spot) -> String {
    format!(
        "No narrowest place is suggested: where sections are sure, the vessel only tapers, to {:.2} mm at {:.1} mm. Mark it yourself.",
        end.diameter, end.at
    )
}

fn no_reference(at: f64) -> String {
    format!(
        "No reference is suggested for {at:.1} mm: no place within 50 mm is reliable, at least as wide, one \
         diameter away and between parallel walls. Mark it yourself where the vessel is normal."
    )
}

#[cfg(test)]
#[path = "tests/not_suggested.rs"]
mod tests;
