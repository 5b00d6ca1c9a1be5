//! The places that a report shows: marks, and suggestions that are named as suggestions.

use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

use super::Shown;
use super::markup::escaped;
use crate::measure_words::{of_bounds_at, of_flags};
use crate::profile_marks::{Mark, NOTED, REFERENCE};
use crate::text::fixed;

/// Colours of the stenosis, its references and noted diameters; the handles in pictures have the same colours.
const COLORS: [&str; 3] = ["#ff6b6b", "#7ee787", "#79c0ff"];

const MISSING: &str = "–";

/// A place from [`crate::profile_marks::marks`].
#[derive(Clone, Debug, PartialEq)]
pub struct ReportMark {
    /// `marked place`, `narrowest place`, `reference` or `noted diameter`.
    pub name: String,
    /// Arc length (mm).
    pub at: f64,
    /// Whether the place is suggested, and was not marked by a reader.
    pub is_suggestion: bool,
    /// Whether a reader confirmed the suggestion.
    pub is_confirmed: bool,
}

impl From<&Mark> for ReportMark {
    fn from(mark: &Mark) -> Self {
        Self {
            name: mark.name.to_owned(),
            at: mark.at,
            is_suggestion: mark.is_suggestion,
            is_confirmed: mark.is_confirmed,
        }
    }
}

/// A place in a report, with its name and colour.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportPlace"))]
pub struct ReportPlace {
    /// The name, such as `marked place` or `reference before (suggestion)`.
    pub name: String,
    /// Arc length (mm).
    pub at: f64,
    /// Whether the place is suggested, and was not marked by a reader.
    pub is_suggestion: bool,
    pub(crate) is_reference: bool,
}

impl ReportPlace {
    /// The colour as `#rrggbb`.
    pub fn color(&self) -> &'static str {
        COLORS[self.rank()]
    }

    /// Sort key: 0 stenosis, 1 references, 2 noted diameters.
    fn rank(&self) -> usize {
        if self.is_reference { 1 } else { 2 * usize::from(self.name == NOTED) }
    }

    pub(crate) fn caption(&self, unit: &str) -> String {
        format!("{} at {}{unit}", self.name, fixed(self.at, 1))
    }
}

/// The places of the marks. A reference is named by the side of the first place on which it lies.
pub(super) fn places(marks: &[ReportMark]) -> Vec<ReportPlace> {
    let is_main = |mark: &&ReportMark| mark.name != REFERENCE && mark.name != NOTED;
    let main = marks.iter().find(is_main).map(|mark| mark.at);
    let named = |mark: &ReportMark| {
        let is_reference = mark.name == REFERENCE;
        let side = match main {
            Some(main) if is_reference => [" before", " after"][usize::from(mark.at >= main)],
            _ => "",
        };
        let offered = match (mark.is_suggestion, mark.is_confirmed) {
            (true, _) => " (suggestion)",
            (_, true) => " (confirmed suggestion)",
            _ => "",
        };
        let name = format!("{}{side}{offered}", mark.name);
        ReportPlace { name, at: mark.at, is_suggestion: mark.is_suggestion, is_reference }
    };
    // Inserting into a short list needs less code than a sort.
    let order = |place: &ReportPlace| (place.rank(), place.at);
    let mut found: Vec<ReportPlace> = Vec::new();
    for place in marks.iter().map(named) {
        found.insert(found.partition_point(|other| order(other) <= order(&place)), place);
    }
    found
}

pub(super) fn row(profile: &Profile, place: &ReportPlace, shown: &Shown) -> String {
    let dot = format!("<span style=\"color: {}\">●</span> ", place.color());
    numbers(profile, &format!("{dot}{}", escaped(&place.name)), place.at, shown)
}

pub(super) fn widest_row(profile: &Profile, at: f64, shown: &Shown) -> String {
    numbers(profile, "longest diameter (suggestion)", at, shown)
}

fn numbers(profile: &Profile, name: &str, at: f64, shown: &Shown) -> String {
    let n = profile.nearest_section(at);
    let number = |value: f64, decimals| {
        if value.is_finite() { fixed(value, decimals) } else { MISSING.to_owned() }
    };
    let diameter = 2.0 * (profile.area[n] / std::f64::consts::PI).sqrt();
    let cells = [
        number(profile.arc_length[n], 1),
        format!("{} ± {}", number(diameter, 2), number(profile.uncertainty[n], 2)),
        number(profile.diameter_min[n], 2),
        number(profile.diameter_max[n], 2),
        number(profile.area[n], 1),
    ];
    let cells: String = cells.iter().map(|text| format!("<td>{text}</td>")).collect();
    let bounds = of_bounds_at(profile, n).map(|words| shown.stated.with_units(&words));
    let flags = of_flags(profile.flags[n]).into_iter().chain(bounds).collect::<Vec<_>>().join(", ");
    let flags = if flags.is_empty() { "none" } else { &flags };
    format!("<tr><td>{name}</td>{cells}<td class=\"words\">{flags}</td></tr>\n")
}

/// A table; its lengths have no unit if `has_units` is false.
pub(super) fn table(rows: &[String], has_units: bool) -> String {
    let [mm, square] = if has_units { [" (mm)", " (mm²)"] } else { [""; 2] };
    let heads = ["arc length", "diameter ± 1 SD", "shortest", "longest"].map(|name| format!("{name}{mm}"));
    let heads: String =
        heads.iter().chain([&format!("area{square}")]).map(|name| format!("<th>{name}</th>")).collect();
    let rows = rows.concat();
    format!("<table><tr><th>place</th>{heads}<th class=\"words\">flags</th></tr>\n{rows}</table>\n")
}
