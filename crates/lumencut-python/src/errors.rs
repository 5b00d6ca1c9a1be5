//! Rust errors as the exception classes of `lumencut.errors`: one exhaustive match over the causes.

use std::ffi::CString;

use lumencut::error::{Error, ErrorKind};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

/// The exception that stands for `error`.
#[allow(clippy::needless_pass_by_value)]
pub fn to_python(error: Error) -> PyErr {
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
    exception(class, &error.subject, &error.found, &error.expected, &error.mend)
}

/// An instance of the class of `lumencut.errors` with this name.
pub fn exception(class: &str, subject: &str, found: &str, expected: &str, mend: &str) -> PyErr {
    Python::attach(|py| {
        let made = py
            .import("lumencut.errors")
            .and_then(|module| module.getattr(class))
            .and_then(|class| class.call1((subject, found, expected, mend)));
        match made {
            Ok(exception) => PyErr::from_value(exception),
            Err(error) => error,
        }
    })
}

/// Warns whoever called the function of the package that called this module.
pub fn warn(py: Python<'_>, category: &str, text: &str) -> PyResult<()> {
    let category = py.import("lumencut.errors")?.getattr(category)?;
    let text = CString::new(text).map_err(|error| PyValueError::new_err(error.to_string()))?;
    PyErr::warn(py, &category, &text, 2)
}
