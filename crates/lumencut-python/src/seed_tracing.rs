//! Centerlines of all branches that a seed reaches, for `lumencut.seed_tracing`.

use glam::DVec3;
use lumencut::progress::Progress;
use lumencut::trace::seed;
use lumencut::trace::seed::seed_tree::{Doubt, SeedBranch};
use numpy::{PyArray1, PyArray2, ndarray::Array2};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::pool;
use crate::renderer::{SHARES, Watched, interruptible};
use crate::volume::VolumeArgument;

/// Points (n, 3), radii (n,), confidence (n,), and why the branch is doubtful, empty where it is not.
type BranchArrays<'py> =
    (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, &'static str);

/// The branches that a seed (mm, LPS) reaches.
#[pyfunction]
#[pyo3(signature = (volume, seed, smallest_radius, told=None))]
#[allow(clippy::needless_pass_by_value)]
pub fn trace_from<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    seed: [f64; 3],
    smallest_radius: f64,
    told: Option<Py<PyAny>>,
) -> PyResult<Vec<BranchArrays<'py>>> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let progress = Progress::default();
    let watched = told.as_ref().map(|told| Watched { progress: &progress, told });
    let traced = interruptible(py, watched.as_ref(), |stop| {
        let seed = DVec3::from_array(seed);
        let request = seed::SeedRequest { seed, smallest_radius, stop, progress: Some(&progress) };
        pool::install(|| seed::trace_from(&volume, &request))?.map_err(to_python)
    })?;
    if let Some(watched) = watched {
        watched.tell(py, SHARES)?;
    }
    let arrays = |branch: SeedBranch| {
        let line = branch.line;
        let points = Array2::from_shape_fn((line.points.len(), 3), |(n, axis)| line.points[n][axis]);
        let doubt = branch.doubt.map_or("", Doubt::words);
        let [radius, confidence] = [line.radius, line.confidence].map(|v| PyArray1::from_vec(py, v));
        (PyArray2::from_owned_array(py, points), radius, confidence, doubt)
    };
    Ok(traced.into_iter().map(arrays).collect())
}
