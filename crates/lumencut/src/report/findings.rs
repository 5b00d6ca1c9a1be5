//! What was found on a vessel, in words: never a percentage without its method, its references and mm.

use lumencut_vessels::measure::profile::Profile;

use super::markup::paragraph;
use super::{Shown, VesselPage};
use crate::measure_words::{of_c_arm, of_doubts, of_stenosis};
use crate::not_suggested::not_suggested;
use crate::profile_marks::Grade;
use crate::text::fixed;

/// Stenosis with its doubts, or why it is not graded; group, stretches and distances, a paragraph each.
pub fn findings(shown: &Shown, vessel: &VesselPage) -> String {
    let mut text = String::new();
    let paragraphs = |class: &str, words: &[String]| -> String {
        words.iter().map(|words| paragraph(class, &shown.spoken(words))).collect()
    };
    match vessel.measured.grade {
        Some(Grade::NotGraded(reason)) => {
            text += &paragraphs("finding", &[format!("No percentage: {reason}")]);
        }
        Some(Grade::Graded { stenosis, group }) => {
            text += &paragraphs("finding", &[of_stenosis(stenosis)]);
            text += &paragraphs("doubt", &of_doubts(&stenosis.doubts));
            let group = group.iter().map(|group| format!("Group of the field: {group}"));
            text += &paragraphs("", &group.collect::<Vec<_>>());
        }
        None => text += &paragraphs("", &not_suggested(vessel.measured.profile, None, &[])),
    }
    for words in lengths(shown, vessel) {
        text += &paragraph("", &words);
    }
    text
}

/// Stretches with their C-arms, the angle between them, and distances.
fn lengths(shown: &Shown, vessel: &VesselPage) -> Vec<String> {
    let (profile, lengths) = (vessel.measured.profile, &vessel.lengths);
    let stretches = lengths.stretches.iter();
    let mut words: Vec<String> = stretches.filter_map(|ends| stretch(shown, profile, *ends)).collect();
    if let [first, second] = lengths.stretches[..]
        && let Ok(angle) = profile.angle_between(first, second)
    {
        words.push(format!("Angle between both stretches: {}°", fixed(angle.to_degrees(), 0)));
    }
    let distances = lengths.distances.iter().enumerate();
    words.extend(
        distances.map(|(n, distance)| format!("Straight distance {}: {}", n + 1, shown.length(*distance, 1))),
    );
    words
}

/// A stretch in a sentence; None where its ends are not on the vessel.
fn stretch(shown: &Shown, profile: &Profile, ends: [f64; 2]) -> Option<String> {
    let found = profile.stretch(ends).ok()?;
    let arm = profile.c_arm(ends, None).ok().filter(|_| shown.has_orientation);
    let arm = arm.map_or_else(String::new, |arm| format!(", C-arm {}", of_c_arm(&arm)));
    let tortuosity = found.tortuosity();
    let tortuosity = if tortuosity.is_finite() { fixed(tortuosity, 3) } else { "–".to_owned() };
    let [length, straight] = [found.length, found.straight].map(|mm| shown.length(mm, 1));
    Some(format!("Stretch: length {length}, straight {straight}, tortuosity {tortuosity}{arm}"))
}
