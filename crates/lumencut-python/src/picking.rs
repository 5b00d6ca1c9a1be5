//! What a pixel of a picture means.

use lumencut::study::brightest::brightest_on_ray;
use pyo3::prelude::*;

use crate::camera::CameraArgument;
use crate::errors::to_python;
use crate::volume::VolumeArgument;

/// The brightest place (mm, LPS) on the ray of a pixel (column, row), between two depths (mm).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub fn brightest(
    py: Python<'_>,
    volume: VolumeArgument<'_>,
    camera: CameraArgument,
    pixel: [f64; 2],
    depths: [f64; 2],
) -> PyResult<[f64; 3]> {
    let borrowed = volume.borrow()?;
    let volume = volume.volume(&borrowed)?;
    let camera = camera.camera()?;
    let place = py.detach(|| brightest_on_ray(&volume, &camera, pixel, depths)).map_err(to_python)?;
    Ok(place.to_array())
}
