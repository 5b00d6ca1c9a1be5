//! Finds vessels automatically or from a seed; used by `lumencut.tracing.vessel_finding` and `lumencut.tracing.seed_tracing`.

use glam::DVec3;
use lumencut::error::Result;
use lumencut::found_vessels::{self, FoundLine, FoundTree, sure_parts};
use lumencut::progress::Progress;
use lumencut::stop::Stop;
use lumencut::trace::find::FindRequest;
use lumencut::volume::Volume;
use numpy::{PyArray1, PyArray2, ndarray::Array2};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::pool;
use crate::volume::VolumeArgument;
use crate::watching::{Reporter, SHARES, interruptible};

/// Points (n, 3), radii (n,), confidence (n,), and the reason for doubt (may be empty).
type FoundArrays<'py> =
    (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, &'static str);

/// Vessels (doubtful ones last), the indices of confident vessels in each connected part, and notes.
type FoundParts<'py> = (Vec<FoundArrays<'py>>, Vec<Vec<usize>>, Vec<String>);

#[pyfunction]
#[pyo3(signature = (volume, smallest_radius, callback=None))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn find_vessels<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    smallest_radius: Option<f64>,
    callback: Option<Py<PyAny>>,
) -> PyResult<FoundParts<'py>> {
    searching(py, &volume, callback.as_ref(), |volume, stop, progress| {
        let request = FindRequest { smallest_radius, stop, progress: Some(progress) };
        found_vessels::find_vessels(volume, &request)
    })
}

/// Finds the vessels connected to a seed (mm, LPS).
#[pyfunction]
#[pyo3(signature = (volume, seed, smallest_radius, callback=None))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn trace_from<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    seed: [f64; 3],
    smallest_radius: Option<f64>,
    callback: Option<Py<PyAny>>,
) -> PyResult<FoundParts<'py>> {
    searching(py, &volume, callback.as_ref(), |volume, stop, progress| {
        let request = FindRequest { smallest_radius, stop, progress: Some(progress) };
        found_vessels::trace_from(volume, DVec3::from_array(seed), &request)
    })
}

/// Runs a search that reports progress to `callback` and stops at Ctrl-C.
fn searching<'py>(
    py: Python<'py>,
    volume: &VolumeArgument<'py>,
    callback: Option<&Py<PyAny>>,
    find: impl FnOnce(&Volume, Stop, &Progress) -> Result<FoundTree> + Send,
) -> PyResult<FoundParts<'py>> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let progress = Progress::default();
    let reporter = callback.map(|callback| Reporter { progress: &progress, callback });
    let tree = interruptible(py, reporter.as_ref(), |stop| {
        pool::install(|| find(&volume, stop, &progress))?.map_err(to_python)
    })?;
    if let Some(reporter) = reporter {
        reporter.report(py, SHARES)?;
    }
    let parts = sure_parts(&tree);
    let vessels = tree.vessels.iter().enumerate();
    let places = vessels.flat_map(|(number, vessel)| vessel.doubts_of(&format!("vessel {number}"))).collect();
    let vessels = tree.vessels.into_iter().map(|vessel| arrays(py, vessel)).collect();
    Ok((vessels, parts, [tree.notes, places, tree.doubts].concat()))
}

fn arrays(py: Python<'_>, FoundLine { line, doubt, .. }: FoundLine) -> FoundArrays<'_> {
    let points = Array2::from_shape_fn((line.points.len(), 3), |(n, axis)| line.points[n][axis]);
    let [radius, confidence] = [line.radius, line.confidence].map(|values| PyArray1::from_vec(py, values));
    (PyArray2::from_owned_array(py, points), radius, confidence, doubt.unwrap_or_default())
}
