//! The layout of a vessel as a CPR, and pictures of values.

use glam::{DVec2, DVec3};
use lumencut::error::{Error, ErrorKind};
use lumencut::math::centerline_path::CenterlinePath;
use lumencut::named::Named;
use lumencut::pipeline;
use lumencut::reformations::cpr::{self, CprMode, Straightened, View};
use lumencut::vessel_tree::Vessel;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::errors::to_python;
use crate::pool;
use crate::settings::Checked;
use crate::tree::points_of;

/// Upwards, an angle, and towards the viewer.
type ViewArgument = ([f64; 3], f64, Option<[f64; 3]>);

/// Where the pixels of a CPR of one vessel look.
#[pyclass(frozen, module = "lumencut._lumencut")]
pub struct Cpr(pub cpr::Cpr);

#[pymethods]
impl Cpr {
    /// The layout of the points (n, 3) of a vessel. A view is upwards, an angle (radians) and towards the viewer; pixels are
    /// the width of the image and the side of each (mm).
    #[new]
    #[pyo3(signature = (points, smoothing, mode, view, pixels))]
    #[allow(clippy::needless_pass_by_value)]
    fn new(
        points: PyReadonlyArray2<'_, f64>,
        smoothing: f64,
        mode: &str,
        view: ViewArgument,
        pixels: (Option<f64>, f64),
    ) -> PyResult<Self> {
        let (up, angle, normal) = view;
        let (width, pixel_spacing) = pixels;
        let view = View { up: DVec3::from_array(up), angle, normal: normal.map(DVec3::from_array) };
        let points = points_of(&points)?;
        let made = CprMode::named("mode of the CPR", mode).and_then(|mode| {
            let path = CenterlinePath::new(&Vessel::new(points, None)?, smoothing)?;
            cpr::Cpr::new(path, mode, view, width, pixel_spacing)
        });
        made.map(Self).map_err(to_python)
    }

    /// The same vessel from another angle (radians).
    fn rotated(&self, angle: f64) -> PyResult<Self> {
        self.0.rotated(angle).map(Self).map_err(to_python)
    }

    /// Width and height in pixels.
    #[getter]
    fn size(&self) -> [usize; 2] {
        self.0.size()
    }

    /// The world point of each pixel (mm, LPS), shape (H, W, 3).
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let curved = py.detach(|| pool::install(|| self.0.curved()))?.map_err(to_python)?;
        let [width, height] = self.0.size();
        numbers_of(py, curved.position()).reshape([height, width, 3])
    }

    /// The arc length of the vessel in each row (mm), shape (H,).
    fn arc_length<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_vec(py, py.detach(|| pool::install(|| self.0.arc_length()))?))
    }

    /// Which pixels are folded, shape (H, W).
    fn folded<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        let [width, height] = self.0.size();
        PyArray1::from_vec(py, py.detach(|| pool::install(|| self.0.folded()))?).reshape([height, width])
    }

    /// The world points (n, 3) (mm, LPS) of places in the image (n, 2): column and row.
    #[allow(clippy::needless_pass_by_value)]
    fn world_from_pixel<'py>(
        &self,
        py: Python<'py>,
        pixels: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let pixels: Vec<_> = pixels.as_array().rows().into_iter().map(|p| DVec2::new(p[0], p[1])).collect();
        let world = |pixel: &DVec2| self.0.world_from_pixel(*pixel);
        let points: Vec<_> = py.detach(|| pool::install(|| pixels.par_iter().map(world).collect()))?;
        numbers_of(py, &points).reshape([points.len(), 3])
    }

    /// Where world points (n, 3) (mm, LPS) lie in the image, column and row, shape (n, 2).
    #[allow(clippy::needless_pass_by_value)]
    fn pixel_from_world<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = points_of(&points)?;
        let pixel = |point: &DVec3| self.0.pixel_from_world(*point);
        let pixels: Vec<_> = py.detach(|| pool::install(|| points.par_iter().map(pixel).collect()))?;
        PyArray1::from_vec(py, pixels.iter().flat_map(DVec2::to_array).collect()).reshape([pixels.len(), 2])
    }

    /// The world points (n, 3) of places in the space around the straightened vessel: across, ahead, along (mm).
    #[allow(clippy::needless_pass_by_value)]
    fn world_from_straightened<'py>(
        &self,
        py: Python<'py>,
        places: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.straightened(py, &places, |space, place| space.world_from_straightened(place))
    }

    /// Where world points (n, 3) lie in the space around the straightened vessel: across, ahead, along (mm).
    #[allow(clippy::needless_pass_by_value)]
    fn straightened_from_world<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.straightened(py, &points, |space, point| space.straightened_from_world(point))
    }
}

impl Cpr {
    fn straightened<'py>(
        &self,
        py: Python<'py>,
        points: &PyReadonlyArray2<'py, f64>,
        map: impl Fn(&Straightened, DVec3) -> DVec3 + Sync,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let Some(space) = self.0.straightened() else {
            let found = "a CPR of another mode";
            let error = Error::new(ErrorKind::Settings, "mode of the CPR", found, "'straightened'");
            return Err(to_python(error));
        };
        let points = points_of(points)?;
        let mapped =
            py.detach(|| pool::install(|| points.par_iter().map(|p| map(space, *p)).collect::<Vec<_>>()))?;
        numbers_of(py, &mapped).reshape([points.len(), 3])
    }
}

/// The numbers of points, one after the other.
fn numbers_of<'py>(py: Python<'py>, points: &[DVec3]) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_vec(py, points.iter().flat_map(DVec3::to_array).collect())
}

/// The picture, shape (H, W, 4), of values (H, W) in the window and opacity of the settings.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn picture<'py>(
    py: Python<'py>,
    value: PyReadonlyArray2<'py, f32>,
    settings: &Bound<'py, Checked>,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let Checked(settings) = settings.get();
    let [height, width] = [0, 1].map(|axis| value.shape()[axis]);
    let value = value.as_slice()?;
    let image = py.detach(|| pool::install(|| pipeline::picture(value, [width, height], settings)))?;
    PyArray1::from_vec(py, image.map_err(to_python)?.into_flattened()).reshape([height, width, 4])
}
