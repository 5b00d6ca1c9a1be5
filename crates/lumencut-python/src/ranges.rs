//! Checks of single parts of the settings. The Python class of a part calls its check when it is made, so that it need
//! not know `lumencut.Settings`, which holds the parts.

use lumencut::named::Named;
use lumencut::reformations::cr::CrParameters;
use lumencut::settings::{ControlPoint, Focus, Opacity, Slab, SlabMode, TransferFunction, Window};
use pyo3::prelude::*;

use crate::errors::to_python;

/// Checks the level and the width of a window against their ranges.
#[pyfunction]
pub(crate) fn check_window(level: f64, width: f64) -> PyResult<()> {
    Window { level, width }.check("window").map_err(to_python)
}

/// Checks both ends of an opacity ramp against their ranges.
#[pyfunction]
pub(crate) fn check_opacity(transparent: f64, opaque: f64) -> PyResult<()> {
    Opacity { transparent, opaque }.check().map_err(to_python)
}

/// Checks the margin and the fade of a focus against their ranges.
#[pyfunction]
pub(crate) fn check_focus(margin: f64, fade: f64) -> PyResult<()> {
    Focus { margin, fade }.check().map_err(to_python)
}

/// Checks the thickness of a slab against its range, and its mode.
#[pyfunction]
pub(crate) fn check_slab(thickness: f64, mode: &str) -> PyResult<()> {
    SlabMode::named("slab mode", mode).and_then(|mode| Slab { thickness, mode }.check()).map_err(to_python)
}

/// Checks the control points (intensity, colour, opacity) of a transfer function: their number, ranges and order.
#[pyfunction]
pub(crate) fn check_transfer_function(points: Vec<(f64, [u8; 3], f64)>) -> PyResult<()> {
    let point = |(intensity, color, opacity)| ControlPoint { intensity, color, opacity };
    TransferFunction { points: points.into_iter().map(point).collect() }.check().map_err(to_python)
}

/// Checks the thresholds of CR (pixels).
#[pyfunction]
pub(crate) fn check_cr(radius_offset: f64, arc_threshold: f64) -> PyResult<()> {
    CrParameters { radius_offset, arc_threshold }.check().map_err(to_python)
}
