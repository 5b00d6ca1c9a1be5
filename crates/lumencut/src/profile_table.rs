//! Profiles as a table: CSV with one line for each section.

use lumencut_vessels::measure::profile::Profile;

use crate::measure_words::{of_flags, of_source};
use crate::text::rounded;

/// Significant digits of a number in a table.
const DIGITS: usize = 7;

/// A profile with columns that stand before its own and are the same in all its lines, such as the vessel's name.
#[derive(Clone, Debug)]
pub struct Labelled<'a> {
    /// Names and values of these columns.
    pub labels: Vec<(String, String)>,
    /// The profile.
    pub profile: &'a Profile,
}

/// The numbers of all sections by their names with units.
pub fn columns(profile: &Profile) -> Vec<(&'static str, Vec<f64>)> {
    let centers = |axis: usize| profile.center.iter().map(|point| point[axis]).collect();
    let normals = |axis: usize| profile.normal.iter().map(|normal| normal[axis]).collect();
    let levels = |which: usize| profile.levels.iter().map(|levels| levels[which]).collect();
    vec![
        ("arc_length_mm", profile.arc_length.clone()),
        ("diameter_equivalent_mm", profile.diameter_equivalent()),
        ("uncertainty_mm", profile.uncertainty.clone()),
        ("diameter_min_mm", profile.diameter_min.clone()),
        ("diameter_max_mm", profile.diameter_max.clone()),
        ("diameter_mean_mm", profile.diameter_mean()),
        ("area_mm2", profile.area.clone()),
        ("inscribed_radius_mm", profile.inscribed_radius.clone()),
        ("center_x_lps_mm", centers(0)),
        ("center_y_lps_mm", centers(1)),
        ("center_z_lps_mm", centers(2)),
        ("normal_x_lps", normals(0)),
        ("normal_y_lps", normals(1)),
        ("normal_z_lps", normals(2)),
        ("lumen_level", levels(0)),
        ("background_level", levels(1)),
    ]
}

/// Profiles as one table, a line for each section after the line of the names; all profiles have the same labels. Numbers have
/// seven digits, and what could not be measured is empty.
pub fn csv_text(profiles: &[Labelled]) -> String {
    let mut text = String::new();
    for (number, Labelled { labels, profile }) in profiles.iter().enumerate() {
        let found = columns(profile);
        if number == 0 {
            let names = labels.iter().map(|(name, _)| name.clone());
            let own = found.iter().map(|(name, _)| (*name).to_owned());
            let last = ["counts", "flags", "fwhm_mm", "fwhm_source"].map(str::to_owned);
            write_line(&mut text, names.chain(own).chain(last));
        }
        for n in 0..profile.len() {
            let labels = labels.iter().map(|(_, value)| value.clone());
            let numbers = found.iter().map(|(_, values)| written(values[n]));
            write_line(&mut text, labels.chain(numbers).chain(words(profile, n)));
        }
    }
    text
}

/// What stands behind the numbers of a section.
fn words(profile: &Profile, n: usize) -> [String; 4] {
    let counts = if profile.counts(n) { "yes" } else { "no" };
    [
        counts.to_owned(),
        of_flags(profile.flags[n]).join("; "),
        rounded(profile.fwhm, DIGITS),
        of_source(&profile.fwhm_source),
    ]
}

fn written(value: f64) -> String {
    if value.is_finite() { rounded(value, DIGITS) } else { String::new() }
}

fn write_line(text: &mut String, fields: impl Iterator<Item = String>) {
    let fields: Vec<String> = fields.map(quoted).collect();
    text.push_str(&fields.join(","));
    text.push('\n');
}

/// A field in quotes where it would not be read as one without.
fn quoted(field: String) -> String {
    if field.contains(['"', ',', '\n', '\r']) {
        return format!("\"{}\"", field.replace('"', "\"\""));
    }
    field
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn fields_that_would_be_parted_are_in_quotes() {
        let cases = [
            ("LAD", "LAD"),
            ("a, b", "\"a, b\""),
            ("5\" wide", "\"5\"\" wide\""),
            ("two\nlines", "\"two\nlines\""),
        ];
        for (field, text) in cases {
            assert_eq!(quoted(field.to_owned()), text);
        }
    }
}
