//! Endoscopies for Python.

use std::sync::Arc;

use lumencut::endoscopy::{self, BEHIND_MM, EndoscopyRequest};
use lumencut::named::Named;
use lumencut::reformations::Layout as _;
use lumencut::reformations::endoscopy::{self as views, Lens};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::layout::Layout;
use crate::tree::{VesselArrays, vessel as vessel_of};
use crate::volume::VolumeArgument;
use crate::watching::computed;

/// An ostium: vessel id, arc length (mm), point (mm, LPS), column and row (NaN if it is not seen).
type OstiumRow = (usize, f64, [f64; 3], [f64; 2]);

/// The inside of a vessel; all endoscopies of the vessel share it.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct Inside(pub endoscopy::Inside);

#[pymethods]
impl Inside {
    #[getter]
    fn length(&self) -> f64 {
        self.0.length()
    }

    /// What an eye sees: its arc length (mm), lens and field of view (radians), columns and rows, and its roll (radians).
    #[allow(clippy::needless_pass_by_value)]
    fn seen<'py>(
        &self,
        py: Python<'py>,
        volume: VolumeArgument<'py>,
        at: f64,
        lens: (&str, Option<f64>),
        size: [usize; 2],
        turned: (f64, bool),
    ) -> PyResult<Bound<'py, Endoscopy>> {
        let borrowed = volume.borrow()?;
        let volume = volume.volume(&borrowed)?;
        let ((name, field_of_view), (roll, is_backwards)) = (lens, turned);
        let lens = Lens::named("lens of the endoscopy", name).map_err(to_python)?;
        let request = EndoscopyRequest { at, lens, field_of_view, size, roll, is_backwards };
        let made = computed(py, |stop| self.0.seen(&volume, &request, stop))?;
        let layout = Layout(Arc::new(made.clone()));
        Bound::new(py, PyClassInitializer::from(layout).add_subclass(Endoscopy(made)))
    }

    /// The places (mm) of the frames of a flight between two places, at a speed (mm/s).
    fn flight(&self, ends: [f64; 2], speed: f64, fps: f64) -> PyResult<Vec<f64>> {
        self.0.flight(ends, speed, fps).map_err(to_python)
    }

    /// Why the picture from a place may be wrong.
    #[allow(clippy::needless_pass_by_value)]
    fn doubts<'py>(&self, volume: VolumeArgument<'py>, made: Bound<'py, Endoscopy>) -> PyResult<Vec<String>> {
        let borrowed = volume.borrow()?;
        let volume = volume.volume(&borrowed)?;
        Ok(self.0.doubts(&volume, made.get().0.eye()))
    }

    /// The picture (H, W, 4), from brightness (H, W) and the values behind the wall (H, W).
    #[allow(clippy::needless_pass_by_value)]
    fn picture<'py>(
        &self,
        py: Python<'py>,
        shades: PyReadonlyArray2<'py, f32>,
        values: PyReadonlyArray2<'py, f32>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (height, width) = shades.as_array().dim();
        let [shades, values] =
            [shades, values].map(|image| image.as_array().iter().copied().collect::<Vec<_>>());
        let pixels = py.detach(|| self.0.picture(&shades, &values)).into_flattened();
        PyArray1::from_vec(py, pixels).reshape([height, width, 4])
    }

    #[allow(clippy::needless_pass_by_value)]
    fn ostia(&self, made: Bound<'_, Endoscopy>, tree: Vec<VesselArrays<'_>>) -> PyResult<Vec<OstiumRow>> {
        let vessels = tree.iter().map(vessel_of).collect::<PyResult<Vec<_>>>()?;
        let row = |ostium: lumencut::lumen_map::Ostium| {
            let mouth = self.0.mouth(&made.get().0, &ostium).map_or([f64::NAN; 2], |pixel| pixel.to_array());
            (ostium.vessel, ostium.at, ostium.point.to_array(), mouth)
        };
        Ok(self.0.ostia(&vessels).into_iter().map(row).collect())
    }
}

/// A vessel seen from inside.
#[pyclass(frozen, extends = Layout, module = "lumencut._lumencut")]
pub struct Endoscopy(views::Endoscopy);

#[pymethods]
impl Endoscopy {
    /// Where the eye is (mm, LPS), and unit vectors to the right, upwards and ahead.
    fn eye(&self) -> [[f64; 3]; 4] {
        let eye = self.0.eye();
        let [right, up, ahead] = eye.axes;
        [eye.position, right, up, ahead].map(|vector| vector.to_array())
    }

    /// Positions at which the volume is shown.
    fn behind(&self) -> Layout {
        Layout(Arc::new(self.0.behind(BEHIND_MM)))
    }

    /// Distance from the eye to the wall (mm), shape (H, W).
    fn depth<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        self.shaped(py, self.0.depth())
    }

    fn open<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        self.shaped(py, self.0.open())
    }

    /// Distance of the wall from the centerline (mm), shape (H, W).
    fn radius<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.shaped(py, computed(py, |stop| self.0.radius(stop))?)
    }

    /// Brightness of the wall in the light of the eye (0 to 1), shape (H, W).
    #[allow(clippy::needless_pass_by_value)]
    fn shades<'py>(
        &self,
        py: Python<'py>,
        volume: VolumeArgument<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let borrowed = volume.borrow()?;
        let volume = volume.volume(&borrowed)?;
        self.shaped(py, computed(py, |stop| endoscopy::shades(&self.0, &volume, stop))?)
    }
}

impl Endoscopy {
    fn shaped<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        image: Vec<T>,
    ) -> PyResult<Bound<'py, PyArray2<T>>> {
        let [width, height] = self.0.size();
        PyArray1::from_vec(py, image).reshape([height, width])
    }
}
