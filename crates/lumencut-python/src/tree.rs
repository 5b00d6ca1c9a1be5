//! Converts vessel trees from and to arrays.

use glam::DVec3;
use lumencut::math::centerline_smoothing::smooth_centerlines;
use lumencut::parts as lines_in_parts;
use lumencut::settings::Settings;
use lumencut::stages;
use lumencut::study::line_path;
use lumencut::study::lines::Line;
use lumencut::vessel_tree::{Vessel, VesselTree};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::errors::{exception, to_python};
use crate::pool;

/// Points (n, 3) and radii (n,) of a vessel.
pub(crate) type VesselArrays<'py> = (PyReadonlyArray2<'py, f64>, Option<PyReadonlyArray1<'py, f64>>);

pub(crate) type NewVesselArrays<'py> = (Bound<'py, PyArray2<f64>>, Option<Bound<'py, PyArray1<f64>>>);

/// The rows of points (n, 3).
pub(crate) fn points_of(points: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<DVec3>> {
    let shape = points.shape();
    if shape[1] != 3 {
        let found = format!("shape {shape:?}");
        return Err(exception("VesselTreeError", "points of the vessel", &found, "shape (n, 3)", ""));
    }
    Ok(points.as_array().rows().into_iter().map(|p| DVec3::new(p[0], p[1], p[2])).collect())
}

pub(crate) fn vessel((points, radius): &VesselArrays) -> PyResult<Vessel> {
    let points = points_of(points)?;
    let radius = radius.as_ref().map(|r| r.as_array().to_vec());
    Vessel::new(points, radius).map_err(to_python)
}

pub(crate) fn tree(vessels: &[VesselArrays]) -> PyResult<VesselTree> {
    let vessels = vessels.iter().map(vessel).collect::<PyResult<Vec<_>>>()?;
    VesselTree::new(vessels).map_err(to_python)
}

/// Checks points (n, 3) and radii (n,).
#[pyfunction]
#[pyo3(signature = (points, radius=None))]
pub(crate) fn check_vessel(
    points: PyReadonlyArray2<'_, f64>,
    radius: Option<PyReadonlyArray1<'_, f64>>,
) -> PyResult<()> {
    vessel(&(points, radius)).map(drop)
}

/// The levels of detail of a tree, `count` in all and finest first, each as a list of (points, radius).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn levels<'py>(
    py: Python<'py>,
    vessels: Vec<VesselArrays<'py>>,
    count: usize,
) -> PyResult<Vec<Vec<NewVesselArrays<'py>>>> {
    let tree = tree(&vessels)?;
    let levels = py.detach(|| stages::levels::levels(&tree, count));
    levels.iter().map(|level| level.vessels().iter().map(|v| arrays(py, v)).collect()).collect()
}

/// The points of each vessel after Gaussian smoothing; the standard deviation is in radii.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn smoothed<'py>(
    py: Python<'py>,
    vessels: Vec<VesselArrays<'py>>,
    radii: f64,
) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
    Settings { centerline_smoothing: radii, ..Settings::default() }.check().map_err(to_python)?;
    let tree = tree(&vessels)?;
    let smoothed = py.detach(|| pool::install(|| smooth_centerlines(&tree, radii)))?;
    smoothed.vessels().iter().map(|v| arrays(py, v).map(|(points, _)| points)).collect()
}

/// Joins connected vessels to one path with points (n, 3) and radii (n,). Errors name the vessels by `words`.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn path<'py>(
    py: Python<'py>,
    vessels: Vec<VesselArrays<'py>>,
    words: Vec<String>,
) -> PyResult<NewVesselArrays<'py>> {
    let line = |(points, radius): &VesselArrays| {
        let radius = radius.as_ref().map(|r| r.as_array().to_vec());
        Ok(Line { points: points_of(points)?, radius, ..Line::default() })
    };
    let lines = vessels.iter().map(line).collect::<PyResult<Vec<_>>>()?;
    let joined = line_path::path(&lines, &words).map_err(to_python)?;
    flat_arrays(py, &joined.points, joined.radius.as_deref())
}

/// The indices of connected lines with points (n, 3), one list for each part; the longest part comes first.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn parts(py: Python<'_>, lines: Vec<PyReadonlyArray2<'_, f64>>) -> PyResult<Vec<Vec<usize>>> {
    let lines = lines.iter().map(points_of).collect::<PyResult<Vec<_>>>()?;
    let lines: Vec<&[DVec3]> = lines.iter().map(Vec::as_slice).collect();
    Ok(py.detach(|| lines_in_parts::parts(&lines)))
}

fn arrays<'py>(py: Python<'py>, vessel: &Vessel) -> PyResult<NewVesselArrays<'py>> {
    flat_arrays(py, vessel.points(), vessel.radius())
}

pub(crate) fn flat_arrays<'py>(
    py: Python<'py>,
    points: &[DVec3],
    radius: Option<&[f64]>,
) -> PyResult<NewVesselArrays<'py>> {
    let flat: Vec<f64> = points.iter().flat_map(DVec3::to_array).collect();
    let rows = PyArray1::from_vec(py, flat).reshape([points.len(), 3])?;
    Ok((rows, radius.map(|r| PyArray1::from_slice(py, r))))
}
