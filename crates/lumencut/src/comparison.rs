//! Comparisons of a vessel in two scans, as words, table and JSON.

use lumencut_io::marked_cell;
use lumencut_vessels::measure::comparison::matching::MatchedBy;
use lumencut_vessels::measure::comparison::{Change, ComparedPlace, Comparison, DEVIATIONS};
use serde::Serialize;

use crate::profile_json::document;
use crate::text::{fixed, rounded};

/// Diameters that differ by less in every section are equal (mm).
const EQUAL_MM: f64 = 0.005;
const SAME: &str = "both profiles are equal in every section: perhaps both are of one scan";

/// Digits of the numbers of a table.
const DIGITS: usize = 7;

/// A compared vessel and the names of both scans.
#[derive(Clone, Debug)]
pub struct Compared<'a> {
    /// The vessel.
    pub vessel: String,
    /// What the earlier and the later scan are called.
    pub scans: [String; 2],
    /// The comparison.
    pub comparison: &'a Comparison,
    /// Doubts about the scans, such as another patient.
    pub doubts: Vec<String>,
    /// Pictures of the earlier and the later scan for the report (PNG in base64); may be empty.
    pub pictures: Vec<String>,
}

impl Compared<'_> {
    /// The comparison in sentences: doubts, changes, the typical difference, and how the vessels were matched.
    pub fn lines(&self) -> Vec<String> {
        let typical = format!("median difference {} mm", signed(self.comparison.typical));
        let doubts = self.all_doubts().into_iter().map(str::to_owned);
        doubts.chain(self.changes()).chain([typical, self.matched()]).collect()
    }

    pub(crate) fn all_doubts(&self) -> Vec<&str> {
        self.doubts.iter().map(String::as_str).chain(self.is_of_one_scan().then_some(SAME)).collect()
    }

    /// Whether both profiles are equal but for the interpolation between sections: the noise of two scans differs.
    fn is_of_one_scan(&self) -> bool {
        let mut differences =
            self.comparison.places.iter().map(|place| place.difference.abs()).filter(|one| one.is_finite());
        differences.next().is_some_and(|first| first < EQUAL_MM) && differences.all(|one| one < EQUAL_MM)
    }

    /// The changes, one sentence each, or that there is none.
    pub fn changes(&self) -> Vec<String> {
        let changes = &self.comparison.changes;
        if changes.is_empty() {
            return vec![format!("no change beyond {DEVIATIONS} standard deviations of both diameters")];
        }
        changes.iter().map(change).collect()
    }

    /// How the vessels were matched.
    pub fn matched(&self) -> String {
        let matching = &self.comparison.matching;
        let by = match matching.by {
            MatchedBy::Shape => "the shape of the lines",
            MatchedBy::Branches => "branches",
            MatchedBy::Places => "given places",
        };
        let way = if matching.is_reversed { "; the second line runs the other way" } else { "" };
        format!(
            "matched by {by}, ± {} mm along the vessel; lines {} mm apart{way}",
            fixed(matching.deviation, 1),
            fixed(matching.apart, 1)
        )
    }

    /// A table with a line for each section of the first vessel; empty means not measured in both scans.
    pub fn csv(&self) -> String {
        let head = "vessel,arc_length_mm,second_arc_length_mm,first_diameter_mm,first_uncertainty_mm,\
                    second_diameter_mm,second_uncertainty_mm,difference_mm,difference_uncertainty_mm,is_change";
        let name = marked_cell(&self.vessel);
        let row = |place: &ComparedPlace| {
            let [a, b] = [0, 1].map(|which| [place.diameter[which], place.uncertainty[which]]);
            let numbers = [place.at, a, b, [place.difference, place.difference_uncertainty]].concat();
            let cells = numbers.iter().map(|value| cell(*value)).collect::<Vec<_>>().join(",");
            format!("{name},{cells},{}\n", u8::from(self.is_change(place.at[0])))
        };
        let rows: String = self.comparison.places.iter().map(row).collect();
        format!("{head}\n{rows}")
    }

    fn is_change(&self, at: f64) -> bool {
        self.comparison.changes.iter().any(|change| (change.range[0]..=change.range[1]).contains(&at))
    }

    /// The comparison as JSON.
    pub fn json(&self) -> String {
        let matching = &self.comparison.matching;
        document(&Record {
            vessel: &self.vessel,
            scans: &self.scans,
            doubts: self.all_doubts(),
            matched: self.matched(),
            along_uncertainty_mm: matching.deviation,
            typical_difference_mm: self.comparison.typical,
            changes: self.comparison.changes.iter().map(ChangeRecord::of).collect(),
            places: self.comparison.places.iter().map(PlaceRecord::of).collect(),
        })
    }
}

fn cell(value: f64) -> String {
    if value.is_finite() { rounded(value, DIGITS) } else { String::new() }
}

/// A difference with its sign.
pub(crate) fn signed(value: f64) -> String {
    let text = fixed(value, 2);
    match text.trim_start_matches('-') {
        "0.00" => "0.00".to_owned(),
        _ if value > 0.0 => format!("+{text}"),
        _ => text,
    }
}

fn change(Change { range, largest }: &Change) -> String {
    let what = if largest.difference < 0.0 { "narrower" } else { "wider" };
    let [from, to, at] = [range[0], range[1], largest.at[0]].map(|mm| fixed(mm, 1));
    let [before, after] = [0, 1]
        .map(|n| format!("{} ± {} mm", fixed(largest.diameter[n], 2), fixed(largest.uncertainty[n], 2)));
    let [difference, unsure] = [signed(largest.difference), fixed(largest.difference_uncertainty, 2)];
    format!(
        "{what} from {from} to {to} mm, most at {at} mm: {before} before, {after} after, \
         difference {difference} ± {unsure} mm"
    )
}

#[derive(Serialize)]
struct Record<'a> {
    vessel: &'a str,
    scans: &'a [String; 2],
    doubts: Vec<&'a str>,
    matched: String,
    along_uncertainty_mm: f64,
    typical_difference_mm: f64,
    changes: Vec<ChangeRecord>,
    places: Vec<PlaceRecord>,
}

#[derive(Serialize)]
struct ChangeRecord {
    from_mm: f64,
    to_mm: f64,
    largest: PlaceRecord,
}

impl ChangeRecord {
    fn of(change: &Change) -> Self {
        let [from_mm, to_mm] = change.range;
        Self { from_mm, to_mm, largest: PlaceRecord::of(&change.largest) }
    }
}

#[derive(Serialize)]
struct PlaceRecord {
    arc_length_mm: [f64; 2],
    diameter_mm: [f64; 2],
    uncertainty_mm: [f64; 2],
    difference_mm: f64,
    difference_uncertainty_mm: f64,
}

impl PlaceRecord {
    fn of(place: &ComparedPlace) -> Self {
        Self {
            arc_length_mm: place.at,
            diameter_mm: place.diameter,
            uncertainty_mm: place.uncertainty,
            difference_mm: place.difference,
            difference_uncertainty_mm: place.difference_uncertainty,
        }
    }
}

#[cfg(test)]
#[path = "tests/comparison.rs"]
mod tests;
