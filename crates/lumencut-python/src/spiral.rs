//! Spiral CPRs for Python.

use std::sync::Arc;

use glam::DVec3;
use lumencut::math::centerline_path::CenterlinePath;
use lumencut::named::Named;
use lumencut::reformations::cpr::View;
use lumencut::reformations::spiral::{self, Sampling, SpiralParameters};
use lumencut::vessel_tree::Vessel;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::layout::Layout;
use crate::tree::points_of;

/// A spiral CPR: the sections of a vessel, unrolled along spirals.
#[pyclass(frozen, extends = Layout, module = "lumencut._lumencut")]
pub struct Spiral;

#[pymethods]
impl Spiral {
    /// The spiral CPR of points (n, 3), seen with `up` upwards: pitch, radius and pixel side (mm), sampling, and rotation of
    /// sections (radians).
    #[new]
    #[allow(clippy::needless_pass_by_value)]
    fn new(
        points: PyReadonlyArray2<'_, f64>,
        smoothing: f64,
        up: [f64; 3],
        lengths: [f64; 3],
        sampling: &str,
        angle: f64,
    ) -> PyResult<PyClassInitializer<Self>> {
        let [pitch, radius, pixel_spacing] = lengths;
        let points = points_of(&points)?;
        let view = View { up: DVec3::from_array(up), angle: 0.0, normal: None };
        let made = Sampling::named("sampling of the spiral CPR", sampling).and_then(|sampling| {
            let path = CenterlinePath::new(&Vessel::new(points, None)?, smoothing)?;
            let parameters = SpiralParameters { pitch, radius, sampling, pixel_spacing, angle };
            spiral::Spiral::new(Arc::new(path), &view, parameters)
        });
        let layout = Layout(Arc::new(made.map_err(to_python)?));
        Ok(PyClassInitializer::from(layout).add_subclass(Self))
    }
}
