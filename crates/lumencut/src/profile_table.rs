//! Profiles as CSV, one line per section.

use lumencut_io::marked_cell;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::uncertainty::Part;

use crate::measure_words::{of_doubts, of_flags, of_flap, of_outer_wall, of_source, of_stenosis, of_wall};
use crate::profile_marks::{Grade, Measured};
use crate::scan_details::ScanDetails;
use crate::text::rounded;

const DIGITS: usize = 7;

type Same = Vec<(&'static str, String)>;

struct Block<'a> {
    before: Same,
    profile: &'a Profile,
    scan: &'a ScanDetails,
    behind: Same,
}

/// The numbers of all sections, as columns with names that include the unit.
pub(crate) fn columns(profile: &Profile) -> Vec<(&'static str, Vec<f64>)> {
    let centers = |axis: usize| profile.center.iter().map(|point| point[axis]).collect();
    let normals = |axis: usize| profile.normal.iter().map(|normal| normal[axis]).collect();
    let levels = |which: usize| profile.levels.iter().map(|levels| levels[which]).collect();
    let part = |part: Part| profile.uncertainty_parts.iter().map(|parts| part.of(parts).abs()).collect();
    let both = |values: &[[f64; 2]], which: usize| values.iter().map(|both| both[which]).collect();
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
        ("uncertainty_noise_mm", part(Part::Noise)),
        ("uncertainty_point_spread_mm", part(Part::PointSpread)),
        ("uncertainty_wall_mm", part(Part::Wall)),
        ("uncertainty_lumen_level_mm", part(Part::Lumen)),
        ("uncertainty_surroundings_mm", part(Part::Surroundings)),
        ("wall_mm", both(&profile.wall, 0)),
        ("wall_uncertainty_mm", both(&profile.wall, 1)),
        ("diameter_calcium_excluded_mm", both(&profile.bounds, 0)),
        ("diameter_calcium_included_mm", both(&profile.bounds, 1)),
        ("diameter_at_most_mm", profile.at_most.clone()),
        ("diameter_outer_mm", both(&profile.diameter_outer, 0)),
        ("diameter_outer_uncertainty_mm", both(&profile.diameter_outer, 1)),
        ("area_own_lumen_mm2", both(&profile.area_own_lumen, 0)),
        ("area_own_lumen_uncertainty_mm2", both(&profile.area_own_lumen, 1)),
        ("area_other_lumen_mm2", both(&profile.area_other_lumen, 0)),
        ("area_other_lumen_uncertainty_mm2", both(&profile.area_other_lumen, 1)),
        ("area_both_lumens_mm2", both(&profile.area_both_lumens(), 0)),
        ("area_both_lumens_uncertainty_mm2", both(&profile.area_both_lumens(), 1)),
    ]
}

/// A profile as CSV with a header line and seven significant digits; empty means not measured.
pub fn profile_csv(profile: &Profile, scan: &ScanDetails) -> String {
    csv_text(&[Block { before: Same::new(), profile, scan, behind: Same::new() }])
}

/// Vessels as one table. Each row has the columns of the vessel, those of [`profile_csv`], and those of the marked place.
pub fn vessels_csv(vessels: &[Measured]) -> String {
    let blocks: Vec<Block> = vessels
        .iter()
        .map(|one| {
            let name = one.name.clone().unwrap_or_default();
            let before = vec![("vessel", one.id.clone()), ("name", name)];
            Block { before, profile: one.profile, scan: one.scan, behind: grade_columns(one) }
        })
        .collect();
    csv_text(&blocks)
}

/// Columns about the marked place (empty if there is none) and about assumed lengths.
fn grade_columns(one: &Measured) -> Same {
    let grade = one.grade;
    let stenosis = grade.and_then(Grade::stenosis);
    let mut columns = vec![
        ("stenosis", stenosis.map(of_stenosis).unwrap_or_default()),
        ("doubts", stenosis.map(|graded| of_doubts(&graded.doubts).join(" ")).unwrap_or_default()),
        ("not_graded", grade.and_then(Grade::not_graded).unwrap_or_default().to_owned()),
    ];
    columns.extend(one.assumed().map(|words| ("assumed", words.to_owned())));
    columns
}

fn csv_text(blocks: &[Block]) -> String {
    let names = |same: &Same| same.iter().map(|(name, _)| (*name).to_owned()).collect::<Vec<_>>();
    let values = |same: &Same| same.iter().map(|(_, value)| value.clone()).collect::<Vec<_>>();
    let mut text = String::new();
    for (number, Block { before, profile, scan, behind }) in blocks.iter().enumerate() {
        let found = columns(profile);
        if number == 0 {
            let own = found.iter().map(|(name, _)| (*name).to_owned());
            let last = [
                "outer_wall",
                "flap",
                "counts",
                "flags",
                "fwhm_mm",
                "fwhm_uncertainty_mm",
                "fwhm_source",
                "wall_source",
            ]
            .map(str::to_owned);
            let own = own.chain(last).chain(scan.columns().map(|(name, _)| name.to_owned()));
            write_line(&mut text, names(before).into_iter().chain(own).chain(names(behind)));
        }
        for n in 0..profile.len() {
            let numbers = found.iter().map(|(_, values)| written(values[n]));
            let own = numbers.chain(words(profile, n)).chain(scan.columns().map(|(_, value)| value));
            write_line(&mut text, values(before).into_iter().chain(own).chain(values(behind)));
        }
    }
    text
}

fn words(profile: &Profile, n: usize) -> [String; 8] {
    let counts = if profile.counts(n) { "yes" } else { "no" };
    [
        of_outer_wall(profile.outer_wall[n]).to_owned(),
        of_flap(profile.flap[n]).to_owned(),
        counts.to_owned(),
        of_flags(profile.flags[n]).join("; "),
        rounded(profile.fwhm, DIGITS),
        rounded(profile.fwhm_deviation, DIGITS),
        of_source(&profile.fwhm_source),
        of_wall(&profile.wall_source),
    ]
}

fn written(value: f64) -> String {
    if value.is_finite() { rounded(value, DIGITS) } else { String::new() }
}

fn write_line(text: &mut String, fields: impl Iterator<Item = String>) {
    let fields: Vec<String> = fields.map(|text| cell(&text)).collect();
    text.push_str(&fields.join(","));
    text.push('\n');
}

fn cell(text: &str) -> String {
    let field = marked_cell(text);
    if field.contains(['"', ',', '\n', '\r']) {
        return format!("\"{}\"", field.replace('"', "\"\""));
    }
    field.into_owned()
}

#[cfg(test)]
mod tests {
    use super::cell;

    #[test]
    fn fields_that_would_be_parted_are_in_quotes() {
        let cases = [
            ("LAD", "LAD"),
            ("a, b", "\"a, b\""),
            ("5\" wide", "\"5\"\" wide\""),
            ("two\nlines", "\"two\nlines\""),
            ("=A1,2", "\"'=A1,2\""),
            ("-1.5", "-1.5"),
        ];
        for (field, text) in cases {
            assert_eq!(cell(field), text);
        }
    }
}
