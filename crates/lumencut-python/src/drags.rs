//! Changes a camera or a window after drags and turns of the wheel, for the notebook.

use glam::DVec3;
use lumencut::drags;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::views::{DerivedView, MadeCamera, placed};

/// A camera after a drag (pixels right and down) over a ball that fills the view, about a point (mm, LPS).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn trackballed(camera: MadeCamera, pivot: [f64; 3], drag: [f64; 2]) -> PyResult<DerivedView> {
    placed(drags::trackballed(&camera.camera()?, DVec3::from_array(pivot), drag))
}

/// A camera after a drag to the right (pixels) about an axis (LPS) through a point (mm, LPS).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn spun(camera: MadeCamera, pivot: [f64; 3], axis: [f64; 3], right: f64) -> PyResult<DerivedView> {
    let [pivot, axis] = [pivot, axis].map(DVec3::from_array);
    placed(drags::spun(&camera.camera()?, pivot, axis, right))
}

/// A camera after a drag (pixels right and down) that moves the scene.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn dragged(camera: MadeCamera, drag: [f64; 2]) -> PyResult<DerivedView> {
    placed(drags::dragged(&camera.camera()?, drag))
}

/// A camera magnified by a factor; the point under the pixel (column, row) stays there.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn zoomed_at(camera: MadeCamera, factor: f64, pixel: [f64; 2]) -> PyResult<DerivedView> {
    placed(drags::zoomed_at(&camera.camera()?, factor, pixel))
}

/// Size (pixels) and pixel spacing (mm) of the same view with fewer pixels; `share` is the fraction along each side.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn sampled(camera: MadeCamera, share: f64) -> PyResult<((usize, usize), f64)> {
    let found = drags::sampled(&camera.camera()?, share).map_err(to_python)?;
    Ok((found.size().into(), found.pixel_spacing()))
}

/// Level and width of a window after a drag (pixels right and down).
#[pyfunction]
pub(crate) fn dragged_window(window: [f64; 2], drag: [f64; 2]) -> (f64, f64) {
    drags::dragged_window(window, drag).into()
}
