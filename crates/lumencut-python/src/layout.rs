//! The sampled positions of reformations as images, for Python.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use lumencut::reformations;
use lumencut::stop::go_on;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::tree::points_of;
use crate::watching::computed;

/// The sampled positions of a reformation; base class for the layout of each kind of reformation.
#[pyclass(frozen, subclass, module = "lumencut._lumencut")]
pub struct Layout(pub Arc<dyn reformations::Layout>);

#[pymethods]
impl Layout {
    #[getter]
    fn size(&self) -> [usize; 2] {
        self.0.size()
    }

    #[getter]
    fn pixel_spacing(&self) -> f64 {
        self.0.pixel_spacing()
    }

    /// World point of each pixel (mm, LPS), shape (H, W, 3).
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let curved = computed(py, |stop| self.0.curved(stop))?;
        let [width, height] = self.0.size();
        numbers_of(py, curved.position()).reshape([height, width, 3])
    }

    /// Arc length (mm): shape (H,) if each row shows one position along a single vessel, else (H * W,).
    fn arc_length<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_vec(py, computed(py, |stop| self.0.arc_length(stop))?))
    }

    /// Whether each pixel is unreliable because the reformation is folded there, shape (H, W).
    fn folded<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        let [width, height] = self.0.size();
        PyArray1::from_vec(py, computed(py, |stop| self.0.folded(stop))?).reshape([height, width])
    }

    /// World points (n, 3) (mm, LPS) at image positions (n, 2), given as column and row.
    #[allow(clippy::needless_pass_by_value)]
    fn world_from_pixel<'py>(
        &self,
        py: Python<'py>,
        pixels: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let pixels: Vec<_> = pixels.as_array().rows().into_iter().map(|p| DVec2::new(p[0], p[1])).collect();
        let world = |pixel: &DVec2| self.0.world_from_pixel(*pixel);
        let points: Vec<_> =
            computed(py, |stop| pixels.par_iter().map(|pixel| go_on(stop).map(|()| world(pixel))).collect())?;
        numbers_of(py, &points).reshape([points.len(), 3])
    }

    /// Column and row (n, 2) of world points (n, 3) (mm, LPS).
    #[allow(clippy::needless_pass_by_value)]
    fn pixel_from_world<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = points_of(&points)?;
        let pixel = |point: &DVec3| self.0.pixel_from_world(*point);
        let pixels: Vec<_> =
            computed(py, |stop| points.par_iter().map(|point| go_on(stop).map(|()| pixel(point))).collect())?;
        PyArray1::from_vec(py, pixels.iter().flat_map(DVec2::to_array).collect()).reshape([pixels.len(), 2])
    }
}

pub(crate) fn numbers_of<'py>(py: Python<'py>, points: &[DVec3]) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_vec(py, points.iter().flat_map(DVec3::to_array).collect())
}
