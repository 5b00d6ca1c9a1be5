//! Checks of single parts of the settings. The Python class of a part calls its check when it is made, so that it need
//! not know `lumencut.Settings`, which holds the parts.

use lumencut::math::transfer::{ControlPoint, TransferFunction};
use lumencut::math::window::{Opacity, Window};
use lumencut::settings::{Context, Settings};
use pyo3::prelude::*;

use crate::errors::to_python;

/// Checks the level and the width of a window against their ranges.
#[pyfunction]
pub fn check_window(level: f64, width: f64) -> PyResult<()> {
    check(&Settings { window: Window { level, width }, ..Settings::default() })
}

/// Checks both ends of an opacity ramp against their ranges.
#[pyfunction]
pub fn check_opacity(transparent: f64, opaque: f64) -> PyResult<()> {
    check(&Settings { opacity: Some(Opacity { transparent, opaque }), ..Settings::default() })
}

/// Checks the control points (intensity, colour, opacity) of a transfer function: their number, ranges and order.
#[pyfunction]
pub fn check_transfer_function(points: Vec<(f64, [u8; 3], f64)>) -> PyResult<()> {
    let point = |(intensity, color, opacity)| ControlPoint { intensity, color, opacity };
    let transfer = TransferFunction { points: points.into_iter().map(point).collect() };
    check(&Settings { context: Some(Context { transfer, ..Context::default() }), ..Settings::default() })
}

fn check(settings: &Settings) -> PyResult<()> {
    settings.check().map_err(to_python)
}
