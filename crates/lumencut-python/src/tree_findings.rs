//! Computes the tree-wide estimates of a measurement once.

use pyo3::prelude::*;

use crate::errors::to_python;
use crate::pool;
use crate::tree::{VesselArrays, vessel as vessel_of};
use crate::volume::VolumeArgument;
use crate::watching::interruptible;
use lumencut::measure::profile::measuring;
use lumencut::measure::profile::request::MeasureRequest;
use lumencut::measure::wall::WallRequest;

#[pyclass(frozen, module = "lumencut._lumencut")]
pub(crate) struct TreeFindings(pub lumencut::measure::profile::TreeFindings);

#[pyfunction]
#[pyo3(signature = (volume, tree, step, fwhm=None, wall=None))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn tree_findings<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    tree: Vec<VesselArrays<'py>>,
    step: f64,
    fwhm: Option<f64>,
    wall: Option<[f64; 2]>,
) -> PyResult<TreeFindings> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let tree = tree.iter().map(vessel_of).collect::<PyResult<Vec<_>>>()?;
    interruptible(py, None, |stop| {
        let request = MeasureRequest { step, fwhm, wall: wall_request(wall), tree: &tree, stop };
        pool::install(|| measuring::tree_findings(&volume, &request))?.map_err(to_python)
    })
    .map(TreeFindings)
}

/// Converts a wall level and its standard deviation; a standard deviation of 0 means that no walls are separated.
pub(crate) fn wall_request(wall: Option<[f64; 2]>) -> WallRequest {
    match wall {
        None => WallRequest::Automatic,
        Some([_, 0.0]) => WallRequest::Off,
        Some(level) => WallRequest::Level(level),
    }
}
