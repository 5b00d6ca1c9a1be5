//! Uncurling and the tangential CPR for Python, in the pixels of a camera.

use std::sync::Arc;

use lumencut::error::Result;
use lumencut::math::centerline_path::CenterlinePath;
use lumencut::reformations::{tangential, uncurl};
use lumencut::vessel_tree::Vessel;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::layout::Layout;
use crate::tree::points_of;
use crate::views::CameraArgument;

/// The tangential CPR of points (n, 3).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn tangential_layout(
    points: PyReadonlyArray2<'_, f64>,
    smoothing: f64,
    camera: CameraArgument,
) -> PyResult<Layout> {
    let (path, camera) = (path(&points, smoothing)?, camera.camera()?);
    let made = tangential::Tangential::new(path, camera).map_err(to_python)?;
    Ok(Layout(Arc::new(made)))
}

/// A partly straightened vessel.
#[pyclass(frozen, extends = Layout, module = "lumencut._lumencut")]
pub struct Uncurl;

#[pymethods]
impl Uncurl {
    /// Straightens points (n, 3), as a camera sees them, by an amount (0 to 1), with surroundings up to half a width (mm) away.
    #[new]
    #[pyo3(signature = (points, smoothing, camera, amount, width=None))]
    #[allow(clippy::needless_pass_by_value)]
    fn new(
        points: PyReadonlyArray2<'_, f64>,
        smoothing: f64,
        camera: CameraArgument,
        amount: f64,
        width: Option<f64>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let (path, camera) = (path(&points, smoothing)?, camera.camera()?);
        let made = uncurl::Uncurl::new(path, camera, amount, width).map_err(to_python)?;
        Ok(PyClassInitializer::from(Layout(Arc::new(made))).add_subclass(Self))
    }
}

fn path(points: &PyReadonlyArray2<'_, f64>, smoothing: f64) -> PyResult<Arc<CenterlinePath>> {
    let points = points_of(points)?;
    let path = || -> Result<_> { CenterlinePath::new(&Vessel::new(points, None)?, smoothing) };
    path().map(Arc::new).map_err(to_python)
}
