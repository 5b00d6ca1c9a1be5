//! The point spread of a scan, found once for all that is measured along a tree.

use lumencut::measure::measuring;
use lumencut::measure::profile;
use lumencut::measure::request::MeasureRequest;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::pool;
use crate::renderer::interruptible;
use crate::tree::{VesselArrays, vessel as vessel_of};
use crate::volume::VolumeArgument;
use crate::wall_request::wall_request;

/// The point spread of a scan, and where it is from.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct PointSpread(pub profile::PointSpread);

/// A point spread that is known before a vessel is measured.
#[derive(FromPyObject)]
pub enum KnownSpread {
    /// Its full width at half maximum (mm).
    Width(f64),
    /// As a tree told it.
    OfTree(Py<PointSpread>),
}

/// The point spread that the vessels of a tree tell for all that is measured along them.
#[pyfunction]
#[pyo3(signature = (volume, tree, step, wall=None))]
#[allow(clippy::needless_pass_by_value)]
pub fn point_spread<'py>(
    py: Python<'py>,
    volume: VolumeArgument<'py>,
    tree: Vec<VesselArrays<'py>>,
    step: f64,
    wall: Option<[f64; 2]>,
) -> PyResult<PointSpread> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let tree = tree.iter().map(vessel_of).collect::<PyResult<Vec<_>>>()?;
    interruptible(py, None, |stop| {
        let request = MeasureRequest { step, fwhm: None, wall: wall_request(wall), tree: &tree, stop };
        pool::install(|| measuring::point_spread_of(&volume, &request))?.map_err(to_python)
    })
    .map(PointSpread)
}
