//! Picks points in pictures.

use glam::DVec3;
use lumencut::clicked_vessel;
use lumencut::cut_at::cut_at;
use lumencut::method::Method;
use lumencut::pipeline::CpuRenderer;
use lumencut::study::brightest::brightest_on_ray;
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::renderer::Renderer;
use crate::settings::Checked;
use crate::tree::{self, VesselArrays};
use crate::views::CameraArgument;
use crate::volume::VolumeArgument;

/// The brightest place (mm, LPS) on the ray of a pixel (column, row) between two depths (mm).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn brightest(
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

/// The arc length (mm) on a vessel nearest to a point, and whether a click there selects the vessel at this pixel side (mm).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn meant_place(
    vessel: VesselArrays<'_>,
    point: [f64; 3],
    pixel_spacing: f64,
) -> PyResult<(f64, bool)> {
    let (vessel, point) = (tree::vessel(&vessel)?, DVec3::from_array(point));
    let at = clicked_vessel::nearest_arc_length(&vessel, point);
    Ok((at, clicked_vessel::is_clicked(&vessel, point, pixel_spacing)))
}

/// Whether a pixel (column, row) shows the cut surface, and not what lies around the focus.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn shows_cut(
    renderer: &Bound<'_, Renderer>,
    volume: VolumeArgument<'_>,
    camera: CameraArgument,
    settings: &Bound<'_, Checked>,
    pixel: [f64; 2],
) -> PyResult<bool> {
    let (camera, Checked(settings)) = (camera.camera()?, settings.get());
    let borrowed = volume.borrow()?;
    let scene = renderer.get().scene(volume.volume(&borrowed)?);
    let how = (&mut CpuRenderer::default(), Method::CutSurface);
    cut_at(how, &scene, (&camera, settings), pixel).map(|cut| cut.is_shown).map_err(to_python)
}
