//! Converts Rust errors to the exceptions of `lumencut.errors`.

use std::ffi::CString;

use lumencut::error::{Error, ErrorKind};
use lumencut::mends::{self, Mend};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

#[allow(clippy::needless_pass_by_value)]
pub(crate) fn to_python(error: Error) -> PyErr {
    let class = match error.kind {
        ErrorKind::Volume => "VolumeError",
        ErrorKind::VesselTree => "VesselTreeError",
        ErrorKind::Camera => "CameraError",
        ErrorKind::Settings => "SettingsError",
        ErrorKind::Device => "DeviceError",
        ErrorKind::Tracing => "TracingError",
        ErrorKind::Measuring => "MeasuringError",
        ErrorKind::Interrupted => return PyKeyboardInterrupt::new_err(error.to_string()),
    };
    let Error { subject, found, expected, mend, mended_by, .. } = error;
    mended(class, [&subject, &found, &expected, &mend], mended_by.map(Mend::from).as_ref())
}

pub(crate) fn exception(class: &str, subject: &str, found: &str, expected: &str, advice: &str) -> PyErr {
    mended(class, [subject, found, expected, advice], None)
}

/// The error of segments that overlap, which a caller of a report notes.
pub(crate) fn overlap([subject, found, expected, advice]: [&str; 4]) -> PyErr {
    let made = |py: Python<'_>| {
        let class = py.import("lumencut.base.overlaps")?.getattr("OverlapError")?;
        class.call1((subject, found, expected, advice)).map(PyErr::from_value)
    };
    Python::attach(|py| made(py).unwrap_or_else(|error| error))
}

/// An exception of `class` from the texts subject, finding, expectation and advice, with a remedy for programs.
pub(crate) fn mended(class: &str, texts: [&str; 4], mended_by: Option<&Mend>) -> PyErr {
    Python::attach(|py| made(py, class, texts, mended_by).map_or_else(|error| error, PyErr::from_value))
}

fn made<'py>(
    py: Python<'py>,
    class: &str,
    [subject, found, expected, advice]: [&str; 4],
    mended_by: Option<&Mend>,
) -> PyResult<Bound<'py, PyAny>> {
    let mend = advised(py, advice, mended_by)?;
    py.import("lumencut.errors")?.getattr(class)?.call1((subject, found, expected, mend))
}

pub(crate) fn advised<'py>(
    py: Python<'py>,
    advice: &str,
    mended_by: Option<&Mend>,
) -> PyResult<Bound<'py, PyAny>> {
    let mends: Vec<_> = mended_by.iter().map(|mend| (mend.name(), mend.values())).collect();
    py.import("lumencut.base.mends")?.getattr("advised")?.call1((advice, mends))
}

pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("MENDS", PyTuple::new(module.py(), mends::names())?)
}

pub(crate) fn warn(py: Python<'_>, category: &str, text: &str) -> PyResult<()> {
    let category = py.import("lumencut.errors")?.getattr(category)?;
    let text = CString::new(text).map_err(|error| PyValueError::new_err(error.to_string()))?;
    PyErr::warn(py, &category, &text, 2)
}
