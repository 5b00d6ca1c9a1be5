//! Converts profiles and stenoses to plain values, from which Python's pickle restores them.

use std::sync::Arc;

use lumencut::measure::stenosis::{self, Doubts, Method};
use lumencut::named::Named;
use lumencut::stored_profile::StoredProfile;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::measuring::{Profile, Stenosis};
use crate::scan_details::ScanArgument;

type Stored<'py> = (
    Vec<(String, Bound<'py, PyArray1<f64>>)>,
    Bound<'py, PyArray1<u32>>,
    (String, String),
    (String, Vec<f64>),
);

type Given<'py> = (
    Vec<(String, PyReadonlyArray1<'py, f64>)>,
    PyReadonlyArray1<'py, u32>,
    (String, String),
    (String, Vec<f64>),
);

#[pyfunction]
pub(crate) fn stored_profile<'py>(py: Python<'py>, profile: &Profile) -> Stored<'py> {
    let StoredProfile { columns, flags, fwhm_source, wall_source } = StoredProfile::of(&profile.0);
    let columns = columns.into_iter().map(|(name, numbers)| (name, PyArray1::from_vec(py, numbers)));
    (columns.collect(), PyArray1::from_vec(py, flags), fwhm_source, wall_source)
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn restored_profile(stored: Given<'_>, scan: ScanArgument) -> PyResult<Profile> {
    let (columns, flags, fwhm_source, wall_source) = stored;
    let columns = columns.into_iter().map(|(name, numbers)| (name, numbers.as_array().to_vec()));
    let flags = flags.as_array().to_vec();
    let stored = StoredProfile { columns: columns.collect(), flags, fwhm_source, wall_source };
    Ok(Profile(Arc::new(stored.profile().map_err(to_python)?), scan.details()))
}

/// Percentage and its uncertainty, place, diameter and its uncertainty, reference (mm); references; method; doubts.
type StenosisParts = ([f64; 6], Vec<[f64; 2]>, String, (u32, bool));

#[pyfunction]
pub(crate) fn stored_stenosis(stenosis: &Stenosis) -> StenosisParts {
    let stenosis::Stenosis {
        percent,
        percent_uncertainty,
        at,
        diameter,
        uncertainty,
        reference,
        references,
        method,
        doubts,
    } = stenosis.0.clone();
    let numbers = [percent, percent_uncertainty, at, diameter, uncertainty, reference];
    (numbers, references, method.name().to_owned(), (doubts.flags, doubts.is_branch_between))
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn restored_stenosis(stored: StenosisParts) -> PyResult<Stenosis> {
    let (numbers, references, method, (flags, is_branch_between)) = stored;
    let [percent, percent_uncertainty, at, diameter, uncertainty, reference] = numbers;
    let method = Method::named("method of the stenosis", &method).map_err(to_python)?;
    let doubts = Doubts { flags, is_branch_between };
    Ok(Stenosis(stenosis::Stenosis {
        percent,
        percent_uncertainty,
        at,
        diameter,
        uncertainty,
        reference,
        references,
        method,
        doubts,
    }))
}
