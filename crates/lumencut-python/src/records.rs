//! Records of profiles, and stenoses as plain values that Python can pickle.

use std::sync::Arc;

use lumencut::measure::stenosis::{self, Doubts, Method};
use lumencut::named::Named;
use lumencut::profile_record::ProfileRecord;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::measuring::Profile;
use crate::stenosis::Stenosis;

/// All data of a profile as text.
#[pyfunction]
pub(crate) fn profile_record(py: Python<'_>, profile: &Profile) -> String {
    py.detach(|| ProfileRecord::of(&profile.0, &profile.1).text())
}

/// The profile that a record holds, bit-identical.
#[pyfunction]
pub(crate) fn profile_from_record(py: Python<'_>, text: &str) -> PyResult<Profile> {
    let restored = py.detach(|| ProfileRecord::read(text).and_then(ProfileRecord::profile));
    let (profile, scan) = restored.map_err(to_python)?;
    Ok(Profile(Arc::new(profile), scan))
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
