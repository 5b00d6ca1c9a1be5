//! What profiles leave behind, as the facade decides it for every host: words, marked places, tables and JSON.

use lumencut::measure::stretch::CArm;
use lumencut::measure_words;
use lumencut::profile_marks::marks;
use lumencut::profile_record::{self, Asked, Measured, NOTICE};
use lumencut::profile_table::{self, Labelled};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::measuring::{Profile, Stenosis};

/// What every file of profiles says of itself.
pub fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("MEASURING_NOTICE", NOTICE)
}

/// What was asked for, as the options of the command line have it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Options {
    step: f64,
    fwhm: Option<f64>,
    at: Option<f64>,
    reference: Option<Vec<f64>>,
    method: Option<String>,
    original: Option<f64>,
    comparison: Option<f64>,
    group: Option<String>,
}

impl From<Options> for Asked {
    fn from(options: Options) -> Self {
        Self {
            step_mm: options.step,
            fwhm_mm: options.fwhm,
            at_mm: options.at,
            reference_mm: options.reference,
            method: options.method,
            original_mm: options.original,
            comparison_mm: options.comparison,
            group: options.group,
        }
    }
}

/// Profiles, each with names and values of the columns that stand before its own.
type LabelledParts = Vec<(Vec<(String, String)>, Py<Profile>)>;

/// Id, name and profile of a vessel, its stenosis, and the group of that.
type MeasuredParts = (String, Option<String>, Py<Profile>, Option<Py<Stenosis>>, Option<String>);

/// Profiles as CSV.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn profiles_csv(profiles: LabelledParts) -> String {
    let rows = profiles
        .iter()
        .map(|(labels, profile)| Labelled { labels: labels.clone(), profile: &profile.get().0 });
    profile_table::csv_text(&rows.collect::<Vec<_>>())
}

/// One profile as JSON.
#[pyfunction]
pub fn profile_json(profile: &Profile) -> String {
    profile_record::profile_json(&profile.0)
}

/// Measured vessels as JSON, with the options that they were measured by.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn vessels_json(options: Options, measured: Vec<MeasuredParts>) -> String {
    let rows = measured.iter().map(|(id, name, profile, stenosis, group)| Measured {
        id: id.clone(),
        name: name.clone(),
        profile: &profile.get().0,
        stenosis: stenosis.as_ref().map(|graded| &graded.get().0),
        group: group.clone(),
    });
    profile_record::vessels_json(&options.into(), &rows.collect::<Vec<_>>())
}

/// Places to look at: the name of each, its arc length and diameter (mm), and whether it is a suggestion.
#[pyfunction]
#[pyo3(signature = (profile, at, references))]
#[allow(clippy::needless_pass_by_value)]
pub fn profile_marks(
    profile: &Profile,
    at: Option<f64>,
    references: Vec<f64>,
) -> PyResult<Vec<(&'static str, f64, f64, bool)>> {
    let found = marks(&profile.0, at, &references).map_err(to_python)?;
    Ok(found.iter().map(|mark| (mark.name, mark.at, mark.diameter, mark.is_suggestion)).collect())
}

/// The flags that are set as words.
#[pyfunction]
pub fn flag_words(flags: u32) -> Vec<String> {
    measure_words::of_flags(flags)
}

/// The angles of a C-arm (radians) as they stand on it.
#[pyfunction]
pub fn c_arm_words(lao: f64, cranial: f64) -> String {
    measure_words::of_c_arm(&CArm { lao, cranial })
}
