//! The findings on a vessel, in sentences. A percentage is always stated with its method, its references and mm.

use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

use super::markup::paragraph;
use super::method_text::Stated;
use super::{Lengths, Shown, VesselPage};
use crate::measure_words::{of_c_arm, of_flags, of_flap_stretch, of_outer_stretch};
use crate::narrower::narrower;
use crate::not_measured::not_measured;
use crate::not_suggested::not_suggested;
use crate::profile_marks::Measured;
use crate::text::fixed;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "SentenceKind"))]
#[serde(rename_all = "snake_case")]
pub(crate) enum Kind {
    /// The percentage of a stenosis, or why there is no percentage.
    Finding,
    Doubt,
    Remark,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Sentence {
    pub kind: Kind,
    pub words: String,
}

/// The stenosis with its doubts and group, or why it is not graded; then noted diameters, unmeasured parts and stretches.
pub(crate) fn sentences(stated: Stated, measured: &Measured, lengths: &Lengths) -> Vec<Sentence> {
    let sentence = |kind, words: &str| Sentence { kind, words: stated.with_units(words) };
    let graded = match measured.grade {
        Some(grade) => {
            let headline = sentence(Kind::Finding, &grade.headline(measured.profile));
            let doubts = grade.doubts(measured.profile);
            let narrower = grade.at().and_then(|at| narrower(measured.profile, Some(at)));
            let doubts = doubts.iter().chain(&narrower).map(|words| sentence(Kind::Doubt, words));
            let group =
                grade.group().map(|group| sentence(Kind::Remark, &format!("Severity group: {group}")));
            [headline].into_iter().chain(doubts).chain(group).collect()
        }
        None if !lengths.diameters.is_empty() => Vec::new(),
        None => not_suggested(measured.profile, None, &[])
            .iter()
            .map(|words| sentence(Kind::Remark, words))
            .collect(),
    };
    let parts = not_measured(measured.profile).into_iter().map(|part| sentence(Kind::Doubt, &part.words));
    let outer = measured.profile.outer_stretch();
    let outer = outer.map(|stretch| sentence(Kind::Remark, &of_outer_stretch(&stretch)));
    let flap = of_flap_stretch(measured.profile).map(|words| sentence(Kind::Remark, &words));
    let noted = lengths.diameters.iter().filter_map(|at| noted(stated, measured.profile, *at));
    let noted = noted.map(|words| Sentence { kind: Kind::Finding, words });
    let stretches = stretch_words(stated, measured.profile, &lengths.stretches).into_iter();
    let stretches = stretches.map(|words| Sentence { kind: Kind::Remark, words });
    graded.into_iter().chain(noted).chain(outer).chain(flap).chain(parts).chain(stretches).collect()
}

/// The sentence for a diameter that the user noted at arc length `at` (mm), with its flags; None if nothing was measured there.
fn noted(stated: Stated, profile: &Profile, at: f64) -> Option<String> {
    let (diameter, uncertainty) = profile.diameter_at(at).ok()?;
    let n = profile.nearest_section(at);
    let [short, long] = [profile.diameter_min[n], profile.diameter_max[n]].map(|mm| fixed(mm, 2));
    let flags = of_flags(profile.flags[n]).join(", ");
    let flags = if flags.is_empty() { flags } else { format!(" ({flags})") };
    let [place, unit] = [stated.length(at, 1), stated.unit().to_owned()];
    Some(format!(
        "Diameter: {} ± {}{unit} at {place}, {short} to {long}{unit}{flags}",
        fixed(diameter, 2),
        fixed(uncertainty, 2)
    ))
}

/// Straight distances (mm), one sentence each.
pub(crate) fn distances(stated: Stated, lengths: &[f64]) -> Vec<String> {
    let numbered = lengths.iter().enumerate();
    numbered
        .map(|(n, length)| format!("Straight distance {}: {}", n + 1, stated.length(*length, 1)))
        .collect()
}

pub(super) fn findings(shown: &Shown, vessel: &VesselPage) -> String {
    let of_vessel = sentences(shown.stated, &vessel.measured, &vessel.lengths);
    let paragraphs = of_vessel.iter().map(|Sentence { kind, words }| match kind {
        Kind::Finding => paragraph("finding", words),
        Kind::Doubt => paragraph("doubt", words),
        Kind::Remark => paragraph("", words),
    });
    let beside = distances(shown.stated, &vessel.lengths.distances);
    paragraphs.chain(beside.iter().map(|words| paragraph("", words))).collect()
}

fn stretch_words(stated: Stated, profile: &Profile, stretches: &[[f64; 2]]) -> Vec<String> {
    let mut words: Vec<String> =
        stretches.iter().filter_map(|ends| stretch(stated, profile, *ends)).collect();
    if let [first, second] = *stretches
        && let Ok(angle) = profile.angle_between(first, second)
    {
        words.push(format!("Angle between both stretches: {}°", fixed(angle.to_degrees(), 0)));
    }
    words
}

/// The sentence about a stretch; None if an end is not on the vessel.
fn stretch(stated: Stated, profile: &Profile, ends: [f64; 2]) -> Option<String> {
    let found = profile.stretch(ends).ok()?;
    let arm = profile.c_arm(ends, None).ok().filter(|_| stated.has_orientation);
    let arm = arm.map_or_else(String::new, |arm| format!(", C-arm {}", of_c_arm(&arm)));
    let tortuosity = found.tortuosity();
    let tortuosity = if tortuosity.is_finite() { fixed(tortuosity, 3) } else { "–".to_owned() };
    let [length, straight] = [found.length, found.straight].map(|mm| stated.length(mm, 1));
    Some(format!("Stretch: length {length}, straight {straight}, tortuosity {tortuosity}{arm}"))
}
