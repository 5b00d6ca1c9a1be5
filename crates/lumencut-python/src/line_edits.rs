//! Cuts a vessel in two, and joins two vessels.

use lumencut::study::line_edits;
use lumencut::study::lines::Line;
use lumencut::study::names;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::tree::{flat_arrays, points_of};

/// A vessel: points (n, 3), radii (n,), confidence (n,), and whether each point is bridged (n,).
#[derive(FromPyObject)]
pub(crate) struct LineArrays<'py>(
    PyReadonlyArray2<'py, f64>,
    Option<PyReadonlyArray1<'py, f64>>,
    Option<PyReadonlyArray1<'py, f64>>,
    Option<PyReadonlyArray1<'py, bool>>,
);

type NewLineArrays<'py> = (
    Bound<'py, PyArray2<f64>>,
    Option<Bound<'py, PyArray1<f64>>>,
    Option<Bound<'py, PyArray1<f64>>>,
    Option<Bound<'py, PyArray1<bool>>>,
);

impl LineArrays<'_> {
    fn line(&self) -> PyResult<Line> {
        let Self(points, radius, confidence, bridged) = self;
        Ok(Line {
            points: points_of(points)?,
            radius: radius.as_ref().map(|radius| radius.as_array().to_vec()),
            confidence: confidence.as_ref().map(|confidence| confidence.as_array().to_vec()),
            bridged: bridged.as_ref().map(|bridged| bridged.as_array().to_vec()),
            by_hand: None,
        })
    }
}

/// Cuts a vessel in two at an arc length (mm).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn cut<'py>(
    py: Python<'py>,
    vessel: LineArrays<'py>,
    at: f64,
) -> PyResult<Vec<NewLineArrays<'py>>> {
    let parts = line_edits::cut(&vessel.line()?, at).map_err(to_python)?;
    parts.iter().map(|part| arrays(py, part)).collect()
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn join<'py>(
    py: Python<'py>,
    first: LineArrays<'py>,
    second: LineArrays<'py>,
) -> PyResult<NewLineArrays<'py>> {
    arrays(py, &line_edits::join(&first.line()?, &second.line()?).map_err(to_python)?)
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn part_name(taken: Vec<String>, whole: &str) -> String {
    names::part_name(&taken, whole)
}

fn arrays<'py>(py: Python<'py>, line: &Line) -> PyResult<NewLineArrays<'py>> {
    let (points, radius) = flat_arrays(py, &line.points, line.known_radius().as_deref())?;
    let confidence = line.confidence.as_ref().map(|confidence| PyArray1::from_slice(py, confidence));
    let bridged = line.bridged.as_ref().map(|bridged| PyArray1::from_slice(py, bridged));
    Ok((points, radius, confidence, bridged))
}
