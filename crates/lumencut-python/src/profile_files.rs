//! Profiles as words, tables and JSON, and the places on them that readers should review.

use lumencut::measure::profile::stretch::CArm;
use lumencut::measure_words;
use lumencut::profile_json::{self as for_programs, Asked, NOTICE};
use lumencut::profile_marks::{Mark, Measured, marks};
use lumencut::profile_table;
use lumencut::scan_details::ScanDetails;
use lumencut::{not_measured, not_suggested};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::marked::{Grade, MarkedParts};
use crate::measuring::Profile;

pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("MEASURING_NOTICE", NOTICE)
}

/// The measuring request; fields are named like the command-line options.
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

/// Id, name, suggested name, profile and grade of a vessel.
pub(crate) type MeasuredParts = (String, Option<String>, Option<String>, Py<Profile>, Option<Py<Grade>>);

pub(crate) fn row((id, name, suggested, profile, grade): &MeasuredParts) -> Measured<'_> {
    Measured {
        id: id.clone(),
        name: name.clone(),
        suggested_name: suggested.clone(),
        profile: &profile.get().0,
        scan: &profile.get().1,
        grade: grade.as_ref().map(|grade| &grade.get().0),
        is_millimetre_assumed: false,
    }
}

fn rows(measured: &[MeasuredParts]) -> Vec<Measured<'_>> {
    measured.iter().map(row).collect()
}

#[pyfunction]
pub(crate) fn profile_csv(profile: &Profile) -> String {
    profile_table::profile_csv(&profile.0, &profile.1)
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn vessels_csv(measured: Vec<MeasuredParts>) -> String {
    profile_table::vessels_csv(&rows(&measured))
}

#[pyfunction]
pub(crate) fn profile_json(profile: &Profile) -> String {
    for_programs::profile_json(&profile.0, &profile.1)
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn vessels_json(options: Options, measured: Vec<MeasuredParts>) -> String {
    for_programs::vessels_json(&options.into(), &rows(&measured))
}

/// Name, arc length and diameter (mm) of a place to review, whether it is suggested, and the diameter in words.
type MarkParts = (&'static str, f64, f64, bool, String);

fn parts_of(marks: &[Mark]) -> Vec<MarkParts> {
    marks
        .iter()
        .map(|mark| (mark.name, mark.at, mark.diameter, mark.is_suggestion, mark.words.clone()))
        .collect()
}

/// The places to review on a vessel with marks; places without a measurement are omitted.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn marked_places(profile: &Profile, marked: MarkedParts) -> PyResult<Vec<MarkParts>> {
    Ok(parts_of(&marked.marked()?.places(&profile.0)))
}

/// Why no narrowest place or reference is suggested, given the marks (arc lengths, mm): one sentence each.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn not_suggested_places(profile: &Profile, at: Option<f64>, references: Vec<f64>) -> Vec<String> {
    not_suggested::not_suggested(&profile.0, at, &references)
}

#[pyfunction]
pub(crate) fn not_measured_stretches(profile: &Profile) -> Vec<String> {
    not_measured::not_measured(&profile.0).into_iter().map(|stretch| stretch.words).collect()
}

#[pyfunction]
#[pyo3(signature = (profile, at, references))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn profile_marks(
    profile: &Profile,
    at: Option<f64>,
    references: Vec<f64>,
) -> PyResult<Vec<MarkParts>> {
    marks(&profile.0, at, &references).map(|found| parts_of(&found)).map_err(to_python)
}

#[pyfunction]
pub(crate) fn flag_words(flags: u32) -> Vec<String> {
    measure_words::of_flags(flags)
}

/// The angles of a C-arm (radians) in the words that it displays.
#[pyfunction]
pub(crate) fn c_arm_words(lao: f64, cranial: f64) -> String {
    measure_words::of_c_arm(&CArm { lao, cranial })
}

type ScanParts = (Option<String>, Option<String>, Option<String>, Option<f64>, Option<String>);

#[pyfunction]
pub(crate) fn scan_of(profile: &Profile) -> ScanParts {
    let ScanDetails { series_number, series_description, phase, slice_thickness_mm, kernel } =
        profile.1.clone();
    (series_number, series_description, phase, slice_thickness_mm, kernel)
}
