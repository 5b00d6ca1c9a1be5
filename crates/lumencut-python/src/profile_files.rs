//! What profiles leave behind, as the facade decides it for every host: words, marked places, tables and JSON.

use lumencut::measure::stretch::CArm;
use lumencut::measure_words;
use lumencut::profile_marks::{Mark, Measured, marks};
use lumencut::profile_record::{self, Asked, NOTICE};
use lumencut::profile_table;
use lumencut::scan_details::ScanDetails;
use lumencut::{not_measured, not_suggested};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::marked::{Grade, MarkedParts};
use crate::measuring::Profile;

/// What every file of profiles says of itself.
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
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

/// Id, name and profile of a vessel, and what is told of the place that is marked on it.
pub(crate) type MeasuredParts = (String, Option<String>, Py<Profile>, Option<Py<Grade>>);

/// The vessel of the facade.
pub(crate) fn row((id, name, profile, grade): &MeasuredParts) -> Measured<'_> {
    Measured {
        id: id.clone(),
        name: name.clone(),
        profile: &profile.get().0,
        scan: &profile.get().1,
        grade: grade.as_ref().map(|grade| &grade.get().0),
        is_millimetre_assumed: false,
    }
}

fn rows(measured: &[MeasuredParts]) -> Vec<Measured<'_>> {
    measured.iter().map(row).collect()
}

/// One profile as CSV.
#[pyfunction]
pub(crate) fn profile_csv(profile: &Profile) -> String {
    profile_table::profile_csv(&profile.0, &profile.1)
}

/// Measured vessels as CSV.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn vessels_csv(measured: Vec<MeasuredParts>) -> String {
    profile_table::vessels_csv(&rows(&measured))
}

/// One profile as JSON.
#[pyfunction]
pub(crate) fn profile_json(profile: &Profile) -> String {
    profile_record::profile_json(&profile.0, &profile.1)
}

/// Measured vessels as JSON, with the options that they were measured by.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn vessels_json(options: Options, measured: Vec<MeasuredParts>) -> String {
    profile_record::vessels_json(&options.into(), &rows(&measured))
}

/// The name of a place to look at, its arc length and diameter (mm), and whether it is a suggestion.
type MarkParts = (&'static str, f64, f64, bool);

fn parts_of(marks: &[Mark]) -> Vec<MarkParts> {
    marks.iter().map(|mark| (mark.name, mark.at, mark.diameter, mark.is_suggestion)).collect()
}

/// The places to look at on a vessel on which a reader marked some, without those where nothing was measured.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn marked_places(profile: &Profile, marked: MarkedParts) -> PyResult<Vec<MarkParts>> {
    Ok(parts_of(&marked.marked()?.places(&profile.0)))
}

/// Why the narrowest place, or any reference, is not suggested beside what a reader marked (arc lengths, mm): a sentence each.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn not_suggested_places(profile: &Profile, at: Option<f64>, references: Vec<f64>) -> Vec<String> {
    not_suggested::not_suggested(&profile.0, at, &references)
}

/// What of a vessel was not measured, and why: a sentence for each stretch.
#[pyfunction]
pub(crate) fn not_measured_stretches(profile: &Profile) -> Vec<String> {
    not_measured::not_measured(&profile.0).into_iter().map(|stretch| stretch.words).collect()
}

/// Places to look at.
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

/// The flags that are set as words.
#[pyfunction]
pub(crate) fn flag_words(flags: u32) -> Vec<String> {
    measure_words::of_flags(flags)
}

/// The angles of a C-arm (radians) as they stand on it.
#[pyfunction]
pub(crate) fn c_arm_words(lao: f64, cranial: f64) -> String {
    measure_words::of_c_arm(&CArm { lao, cranial })
}

/// How a scan was made: the attributes of `lumencut.ScanDetails`, in their order.
type ScanParts = (Option<String>, Option<String>, Option<String>, Option<f64>, Option<String>);

/// How the scan was made that a profile was measured in.
#[pyfunction]
pub(crate) fn scan_of(profile: &Profile) -> ScanParts {
    let ScanDetails { series_number, series_description, phase, slice_thickness_mm, kernel } =
        profile.1.clone();
    (series_number, series_description, phase, slice_thickness_mm, kernel)
}
