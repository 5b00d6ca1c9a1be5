//! Interprets and describes DICOM headers, as JSON.

use lumencut_dicom::{Keyword, json};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Adds the required DICOM attributes to the module: each keyword with the functional groups that may contain it.
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let attributes = PyDict::new(module.py());
    for keyword in Keyword::ALL {
        attributes.set_item(keyword.name(), keyword.groups())?;
    }
    module.add("DICOM_ATTRIBUTES", attributes)
}

#[pyfunction]
#[pyo3(signature = (headers, wanted, /))]
pub(crate) fn judge_dicom(py: Python<'_>, headers: &[u8], wanted: &[u8]) -> String {
    py.detach(|| json::judge(headers, wanted))
}

#[pyfunction]
#[pyo3(signature = (headers, /))]
pub(crate) fn describe_dicom(py: Python<'_>, headers: &[u8]) -> String {
    py.detach(|| json::describe(headers))
}

/// Direction cosines corrected so that the slices lie along a line; None if the cosines are far from orthonormal.
#[pyfunction]
#[pyo3(signature = (cosines, line, /))]
pub(crate) fn dicom_directions(cosines: [f64; 6], line: [f64; 3]) -> Option<[f64; 6]> {
    lumencut_dicom::corrected(&cosines, line)
}
