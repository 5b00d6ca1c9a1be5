//! Checks parts of the settings for Python classes that must not depend on `lumencut.Settings`.

use lumencut::named::Named;
use lumencut::reformations::cr::CrParameters;
use lumencut::settings::{ControlPoint, Focus, Opacity, Slab, SlabMode, TransferFunction, Window};
use pyo3::prelude::*;

use crate::errors::to_python;

#[pyfunction]
pub(crate) fn check_window(level: f64, width: f64) -> PyResult<()> {
    Window { level, width }.check("window").map_err(to_python)
}

#[pyfunction]
pub(crate) fn check_opacity(transparent: f64, opaque: f64) -> PyResult<()> {
    Opacity { transparent, opaque }.check().map_err(to_python)
}

#[pyfunction]
pub(crate) fn check_focus(margin: f64, fade: f64) -> PyResult<()> {
    Focus { margin, fade }.check().map_err(to_python)
}

#[pyfunction]
pub(crate) fn check_slab(thickness: f64, mode: &str) -> PyResult<()> {
    SlabMode::named("slab mode", mode).and_then(|mode| Slab { thickness, mode }.check()).map_err(to_python)
}

/// Checks the control points (intensity, colour, opacity) of a transfer function.
#[pyfunction]
pub(crate) fn check_transfer_function(points: Vec<(f64, [u8; 3], f64)>) -> PyResult<()> {
    let point = |(intensity, color, opacity)| ControlPoint { intensity, color, opacity };
    TransferFunction { points: points.into_iter().map(point).collect() }.check().map_err(to_python)
}

/// Checks the thresholds of Centerline Reformation (pixels).
#[pyfunction]
pub(crate) fn check_cr(radius_offset: f64, arc_threshold: f64) -> PyResult<()> {
    CrParameters { radius_offset, arc_threshold }.check().map_err(to_python)
}
