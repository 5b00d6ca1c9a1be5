//! Reads session files for `lumencut.viewer.session_file`.

use lumencut::centerlines::session_file;
use pyo3::prelude::*;

use crate::centerlines::raised;

#[pyfunction]
pub(crate) fn is_session_file(py: Python<'_>, content: &[u8]) -> bool {
    py.detach(|| session_file::is_session(content))
}

/// Checks the session file `name` and returns its content, without the lines, as JSON.
#[pyfunction]
pub(crate) fn read_session_file(py: Python<'_>, content: &[u8], name: &str) -> PyResult<String> {
    let file = py.detach(|| session_file::read_session(content, name)).map_err(raised)?;
    file.session.json().map_err(raised)
}
