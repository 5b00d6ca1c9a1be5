//! Flattened surfaces for Python.

use std::sync::Arc;

use lumencut::math::centerline_path::CenterlinePath;
use lumencut::named::Named;
use lumencut::reformations::flatten::{self, Keep};
use lumencut::vessel_tree::Vessel;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::layout::Layout;
use crate::tree::points_of;

/// The surface through several curves as an image.
#[pyclass(frozen, extends = Layout, module = "lumencut._lumencut")]
pub struct Flattened;

#[pymethods]
impl Flattened {
    /// The surface through curves (n, 3), of pixels of this side (mm).
    #[new]
    #[allow(clippy::needless_pass_by_value)]
    fn new(
        curves: Vec<PyReadonlyArray2<'_, f64>>,
        keep: &str,
        pixel_spacing: f64,
    ) -> PyResult<PyClassInitializer<Self>> {
        let points = curves.iter().map(points_of).collect::<PyResult<Vec<_>>>()?;
        let made = Keep::named("keep of the flattening", keep).and_then(|keep| {
            let path = |points| CenterlinePath::new(&Vessel::new(points, None)?, 0.0);
            let paths = points.into_iter().map(path).collect::<Result<Vec<_>, _>>()?;
            flatten::Flattened::new(&paths, keep, pixel_spacing)
        });
        let layout = Layout(Arc::new(made.map_err(to_python)?));
        Ok(PyClassInitializer::from(layout).add_subclass(Self))
    }
}
