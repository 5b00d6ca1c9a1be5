//! Centerline files for `lumencut.centerlines`.

use lumencut_io::{Centerlines, Line, Space, junctions};
use numpy::{PyArray1, PyArray2, ndarray::Array2};
use pyo3::prelude::*;

use crate::errors::exception;

type Vessel<'py> = (Bound<'py, PyArray2<f64>>, Option<Bound<'py, PyArray1<f64>>>, Option<String>);

/// The vessels of a centerline file: `(vessels, space, notes)`, each vessel `(points (n, 3), radius (n,) or
/// None, name or None)` in mm in the file's own space, which is `"lps"`, `"ras"` or None where the file
/// states none.
#[pyfunction]
pub fn read_centerlines<'py>(
    py: Python<'py>,
    content: &[u8],
    name: &str,
) -> PyResult<(Vec<Vessel<'py>>, Option<&'static str>, Vec<String>)> {
    let read = py.detach(|| lumencut_io::read(content, name).map(junctions::vessels));
    let Centerlines { lines, space, notes, joined: _ } =
        read.map_err(|e| exception("FormatError", &e.subject, &e.found, &e.expected, &e.mend))?;
    let space = space.map(|space| match space {
        Space::Lps => "lps",
        Space::Ras => "ras",
    });
    let vessels = lines.into_iter().map(|line| vessel(py, line)).collect();
    Ok((vessels, space, notes))
}

fn vessel(py: Python<'_>, line: Line) -> Vessel<'_> {
    let points = Array2::from_shape_fn((line.points.len(), 3), |(i, axis)| line.points[i][axis]);
    let radius = line.radius.map(|radius| PyArray1::from_vec(py, radius));
    (PyArray2::from_owned_array(py, points), radius, line.name)
}
