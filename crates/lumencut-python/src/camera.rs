//! Converts the attributes of `lumencut.Camera` to a camera.

use glam::DVec3;
use lumencut::camera::Camera;
use pyo3::prelude::*;

use crate::errors::to_python;

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
