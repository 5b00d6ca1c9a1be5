//! Headers of DICOM and what is made of them, as JSON.

use lumencut_dicom::{Keyword, json};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Adds the attributes that headers are asked for: keyword → the functional groups that may have it.
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let attributes = PyDict::new(module.py());
    for keyword in Keyword::ALL {
        attributes.set_item(keyword.name(), keyword.groups())?;
    }
    module.add("DICOM_ATTRIBUTES", attributes)
}

/// How images become one volume, or why they do not.
#[pyfunction]
#[pyo3(signature = (headers, wanted, /))]
pub(crate) fn judge_dicom(py: Python<'_>, headers: &[u8], wanted: &[u8]) -> String {
    py.detach(|| json::judge(headers, wanted))
}

/// Describes all series.
#[pyfunction]
#[pyo3(signature = (headers, /))]
pub(crate) fn describe_dicom(py: Python<'_>, headers: &[u8]) -> String {
    py.detach(|| json::describe(headers))
}

/// Direction cosines of slices whose positions go along a line; none where they are too far from orthogonal unit vectors.
#[pyfunction]
#[pyo3(signature = (cosines, line, /))]
pub(crate) fn dicom_directions(cosines: [f64; 6], line: [f64; 3]) -> Option<[f64; 6]> {
    lumencut_dicom::corrected(&cosines, line)
}
