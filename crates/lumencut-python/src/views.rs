//! Derives views from other views, for `lumencut.Camera`.

use glam::DVec3;
use lumencut::camera::Camera;
use lumencut::stop::go_on;
use lumencut::vessel_tree::Vessel;
use lumencut::views::{self, Axis, VIEWS};
use lumencut::{flight as flights, positions as pixels, turn, vessel_views};
use numpy::{PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::to_python;
use crate::tree::{self, VesselArrays, points_of};
use crate::volume::VolumeArgument;
use crate::watching::computed;

#[derive(FromPyObject)]
pub(crate) struct MadeCamera {
    center: [f64; 3],
    direction: [f64; 3],
    right_axis: [f64; 3],
    up: [f64; 3],
    size: [usize; 2],
    pixel_spacing: f64,
}

impl MadeCamera {
    pub(crate) fn camera(&self) -> PyResult<Camera> {
        let vectors = [self.center, self.direction, self.right_axis, self.up].map(DVec3::from_array);
        let [center, direction, right, up] = vectors;
        let camera = Camera::new(center, direction, up, self.size, self.pixel_spacing);
        camera.and_then(|camera| camera.with_axes(direction, right, up)).map_err(to_python)
    }
}

#[derive(IntoPyObject)]
pub(crate) struct DerivedView {
    center: [f64; 3],
    direction: [f64; 3],
    right_axis: [f64; 3],
    up: [f64; 3],
    pixel_spacing: f64,
}

impl DerivedView {
    fn of(camera: &Camera) -> Self {
        Self {
            center: camera.center().to_array(),
            direction: camera.direction().to_array(),
            right_axis: camera.right().to_array(),
            up: camera.up().to_array(),
            pixel_spacing: camera.pixel_spacing(),
        }
    }
}

pub(crate) fn placed(made: lumencut::error::Result<Camera>) -> PyResult<DerivedView> {
    made.map(|camera| DerivedView::of(&camera)).map_err(to_python)
}

#[derive(FromPyObject)]
pub(crate) enum AxisArgument {
    /// The name of an axis: `"superior"`, `"up"`, `"right"` or `"direction"`.
    Name(String),
    Vector([f64; 3]),
}

impl AxisArgument {
    fn axis(self) -> PyResult<Axis> {
        match self {
            Self::Vector(vector) => Ok(Axis::World(DVec3::from_array(vector))),
            Self::Name(name) => Axis::named(&name).map_err(to_python),
        }
    }
}

/// A view centred on points (n, 3), in which they fit at every amount of uncurling.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn fitted_uncurling(
    camera: MadeCamera,
    points: PyReadonlyArray2<'_, f64>,
    smoothing: f64,
) -> PyResult<DerivedView> {
    let vessel = Vessel::new(points_of(&points)?, None).map_err(to_python)?;
    placed(views::fitted_uncurling(&camera.camera()?, &vessel, smoothing))
}

/// Adds to the module the standard views: direction into the scene, and up (LPS).
pub(crate) fn add_names(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let views = PyDict::new(module.py());
    for view in VIEWS {
        let vectors: [(f64, f64, f64); 2] = [view.direction, view.up].map(Into::into);
        views.set_item(view.name, (vectors[0], vectors[1]))?;
    }
    module.add("VIEWS", views)
}

/// The view that just fits all points (n, 3), with the same direction and up.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn fitted(
    py: Python<'_>,
    camera: MadeCamera,
    points: PyReadonlyArray2<'_, f64>,
) -> PyResult<DerivedView> {
    let (camera, points) = (camera.camera()?, points_of(&points)?);
    placed(py.detach(|| views::fitted(&camera, &points)))
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn fitted_turn(
    py: Python<'_>,
    camera: MadeCamera,
    points: PyReadonlyArray2<'_, f64>,
    degrees: f64,
    axis: AxisArgument,
) -> PyResult<DerivedView> {
    let (camera, points, axis) = (camera.camera()?, points_of(&points)?, axis.axis()?);
    placed(py.detach(|| turn::fitted_turn(&camera, &points, degrees, axis)))
}

/// The view about a place on a vessel: arc length (mm), and rotation about the vessel (radians).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn about(
    vessel: VesselArrays<'_>,
    at: f64,
    angle: f64,
    size: [usize; 2],
) -> PyResult<DerivedView> {
    placed(vessel_views::about(&tree::vessel(&vessel)?, at, angle, size))
}

/// The radius at an arc length (mm).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn radius_at(vessel: VesselArrays<'_>, at: f64) -> PyResult<f64> {
    Ok(vessel_views::radius_at(&tree::vessel(&vessel)?, at))
}

/// The diameter (mm) that a view about a place cuts; NaN if the view does not cut two walls.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn cut_diameter(volume: VolumeArgument<'_>, camera: MadeCamera, radius: f64) -> PyResult<f64> {
    let borrowed = volume.borrow()?;
    let found = lumencut::cut_diameter::cut_diameter(&volume.volume(&borrowed)?, &camera.camera()?, radius);
    Ok(found.unwrap_or(f64::NAN))
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn refocused(
    py: Python<'_>,
    camera: MadeCamera,
    vessel: VesselArrays<'_>,
) -> PyResult<DerivedView> {
    let (camera, vessel) = (camera.camera()?, tree::vessel(&vessel)?);
    placed(py.detach(|| vessel_views::refocused(&camera, &vessel)))
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn flight(start: MadeCamera, end: MadeCamera, frames: usize) -> PyResult<Vec<DerivedView>> {
    let views = flights::flight(&start.camera()?, &end.camera()?, frames).map_err(to_python)?;
    Ok(views[1..views.len() - 1].iter().map(DerivedView::of).collect())
}

/// The angle of each frame of a turntable (radians).
#[pyfunction]
pub(crate) fn frame_angles(frames: usize, degrees: f64) -> PyResult<Vec<f64>> {
    turn::frame_angles(frames, degrees).map_err(to_python)
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn rotated(camera: MadeCamera, angle: f64, axis: AxisArgument) -> PyResult<DerivedView> {
    placed(views::rotated(&camera.camera()?, angle, axis.axis()?))
}

#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn zoomed(camera: MadeCamera, factor: f64) -> PyResult<DerivedView> {
    placed(views::zoomed(&camera.camera()?, factor))
}

/// World points (mm, LPS) of a picture's pixels at the given depths (mm), shape (H, W, 3).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn positions<'py>(
    py: Python<'py>,
    camera: MadeCamera,
    depth: PyReadonlyArray2<'py, f32>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let camera = camera.camera()?;
    let [width, height] = camera.size();
    let depth = depth.as_slice()?;
    let points = computed(py, |stop| {
        let mut numbers = Vec::with_capacity(3 * depth.len());
        for (n, point) in pixels::positions(&camera, depth).enumerate() {
            if n % width == 0 {
                go_on(stop)?;
            }
            numbers.extend(point.to_array());
        }
        Ok(numbers)
    })?;
    PyArray1::from_vec(py, points).reshape([height, width, 3])
}

/// A camera moved to the right and up in its plane (mm).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn panned(camera: MadeCamera, right: f64, up: f64) -> PyResult<DerivedView> {
    placed(views::panned(&camera.camera()?, right, up))
}

/// The attributes of `lumencut.Camera`.
#[derive(FromPyObject)]
pub(crate) struct CameraArgument {
    center: [f64; 3],
    direction: [f64; 3],
    up: [f64; 3],
    size: [usize; 2],
    pixel_spacing: f64,
}

impl CameraArgument {
    pub(crate) fn camera(&self) -> PyResult<Camera> {
        let [center, direction, up] = [self.center, self.direction, self.up].map(DVec3::from_array);
        Camera::new(center, direction, up, self.size, self.pixel_spacing).map_err(to_python)
    }
}

/// Checks a camera; returns its unit vectors (direction, right, up).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn check_camera(camera: CameraArgument) -> PyResult<[[f64; 3]; 3]> {
    let camera = camera.camera()?;
    Ok([camera.direction(), camera.right(), camera.up()].map(|v| v.to_array()))
}
