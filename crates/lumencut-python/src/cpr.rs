//! The CPR (curved planar reformation) of a vessel, and pictures from arrays of values.

use std::sync::Arc;

use glam::DVec3;
use lumencut::error::{Error, ErrorKind};
use lumencut::feature_aggregation::Feature;
use lumencut::math::centerline_path::CenterlinePath;
use lumencut::named::Named;
use lumencut::pipeline;
use lumencut::reformations::cpr::{self, CprMode, Roll, Straightened, View};
use lumencut::stop::go_on;
use lumencut::straightened_sides::StraightenedSides;
use lumencut::vessel_tree::Vessel;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::errors::to_python;
use crate::layout::{Layout, numbers_of};
use crate::settings::Checked;
use crate::tree::points_of;
use crate::watching::computed;

type ViewArgument = ([f64; 3], f64, Option<[f64; 3]>);

/// The sampled positions of a CPR of one vessel.
#[pyclass(frozen, extends = Layout, module = "lumencut._lumencut")]
pub struct Cpr(pub cpr::Cpr);

#[pymethods]
impl Cpr {
    /// The CPR of a vessel with points (n, 3) in a view; `pixels` are image width and pixel side (mm).
    #[new]
    #[pyo3(signature = (points, smoothing, mode, view, pixels))]
    #[allow(clippy::needless_pass_by_value)]
    fn new(
        points: PyReadonlyArray2<'_, f64>,
        smoothing: f64,
        mode: &str,
        view: ViewArgument,
        pixels: (Option<f64>, f64),
    ) -> PyResult<PyClassInitializer<Self>> {
        let (up, angle, normal) = view;
        let (width, pixel_spacing) = pixels;
        let view = View { up: DVec3::from_array(up), angle, normal: normal.map(DVec3::from_array) };
        let points = points_of(&points)?;
        let made = CprMode::named("mode of the CPR", mode).and_then(|mode| {
            let path = CenterlinePath::new(&Vessel::new(points, None)?, smoothing)?;
            cpr::Cpr::new(path, mode, view, width, pixel_spacing)
        });
        made.map(Self::with_layout).map_err(to_python)
    }

    /// The same vessel, seen from another angle (radians).
    fn rotated<'py>(&self, py: Python<'py>, angle: f64) -> PyResult<Bound<'py, Self>> {
        Bound::new(py, self.0.rotated(angle).map(Self::with_layout).map_err(to_python)?)
    }

    /// The same straightened vessel, rotated by the angles `angle` (radians) at the arc lengths `at` (mm).
    fn rolled<'py>(&self, py: Python<'py>, at: Vec<f64>, angle: Vec<f64>) -> PyResult<Bound<'py, Self>> {
        let rolled = Roll::new(at, angle).and_then(|roll| self.0.rolled(roll));
        Bound::new(py, rolled.map(Self::with_layout).map_err(to_python)?)
    }

    /// World points (n, 3) of positions in straightened space: offset to the side, offset away from the viewer, arc length (mm).
    #[allow(clippy::needless_pass_by_value)]
    fn world_from_straightened<'py>(
        &self,
        py: Python<'py>,
        places: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.straightened(py, &places, |space, place| space.world_from_straightened(place))
    }

    /// Positions of world points (n, 3) in straightened space; the coordinates are those of `world_from_straightened` (mm).
    #[allow(clippy::needless_pass_by_value)]
    fn straightened_from_world<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.straightened(py, &points, |space, point| space.straightened_from_world(point))
    }

    /// For a straightened volume with this step (mm): the directions (LPS) that its file states for i, j, k, and its mark.
    fn straightened_sides(&self, step: f64, is_stated: bool) -> PyResult<([[f64; 3]; 3], String)> {
        let sides = StraightenedSides::of(self.space()?, step, is_stated);
        Ok((sides.axes().map(|axis| axis.to_array()), sides.mark()))
    }
}

impl Cpr {
    fn with_layout(cpr: cpr::Cpr) -> PyClassInitializer<Self> {
        PyClassInitializer::from(Layout(Arc::new(cpr.clone()))).add_subclass(Self(cpr))
    }

    fn space(&self) -> PyResult<&Straightened> {
        let wrong =
            || Error::new(ErrorKind::Settings, "mode of the CPR", "a CPR of another mode", "'straightened'");
        self.0.straightened().ok_or_else(|| to_python(wrong()))
    }

    fn straightened<'py>(
        &self,
        py: Python<'py>,
        points: &PyReadonlyArray2<'py, f64>,
        map: impl Fn(&Straightened, DVec3) -> DVec3 + Sync,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let space = self.space()?;
        let points = points_of(points)?;
        let mapped: Vec<_> = computed(py, |stop| {
            points.par_iter().map(|point| go_on(stop).map(|()| map(space, *point))).collect()
        })?;
        numbers_of(py, &mapped).reshape([points.len(), 3])
    }
}

/// The picture (H, W, 4) of values (H, W) with the window and opacity of the settings.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn picture<'py>(
    py: Python<'py>,
    value: PyReadonlyArray2<'py, f32>,
    settings: &Bound<'py, Checked>,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let Checked(settings) = settings.get();
    let [height, width] = [0, 1].map(|axis| value.shape()[axis]);
    let value = value.as_slice()?;
    let image = computed(py, |stop| pipeline::picture(value, [width, height], (settings, stop)))?;
    PyArray1::from_vec(py, image.into_flattened()).reshape([height, width, 4])
}

#[pyfunction]
#[pyo3(signature = (feature, level, window))]
pub(crate) fn feature_window(feature: &str, level: Option<f64>, window: [f64; 2]) -> PyResult<[f64; 2]> {
    Feature::named(feature, level).map(|feature| feature.window(window)).map_err(to_python)
}

/// Finds the mark of a straightened volume in a text: its side letters and warnings; None if there is no mark.
#[pyfunction]
pub(crate) fn straightened_mark(text: &str) -> Option<(String, Vec<String>)> {
    StraightenedSides::read(text).map(|sides| (sides.letters().to_owned(), sides.notes()))
}
