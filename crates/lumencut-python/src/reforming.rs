//! Captions, colours and default lengths for pictures of reformations.

use lumencut::axes_words::Axes;
use lumencut::error::{Error, ErrorKind};
use lumencut::named::Named;
use lumencut::spiral_lengths::{self, Room};
use lumencut::value_colours::{self, Colours};
use numpy::{PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors::to_python;

/// The caption of a reformation. `number` is the amount of `uncurled`, the pitch (mm) of `spiral by arc`, the radius (mm) at which
/// a `map` is true to scale, or the place (mm) of an `endoscopy`.
#[pyfunction]
#[pyo3(signature = (reformation, number=0.0))]
pub(crate) fn axes_words(reformation: &str, number: f64) -> PyResult<String> {
    let axes = match reformation {
        "untangled" => Axes::Untangled,
        "network" => Axes::Network,
        "uncurled" => Axes::Uncurled(number),
        "spiral by arc" => Axes::SpiralByArc(number),
        "spiral by angle" => Axes::SpiralByAngle,
        "map" => Axes::Map(number),
        "endoscopy" => Axes::Inside(number),
        other => {
            let expected = "untangled, network, uncurled, spiral by arc, spiral by angle, map or endoscopy";
            let error = Error::new(ErrorKind::Settings, "reformation", format!("'{other}'"), expected);
            return Err(to_python(error));
        }
    };
    Ok(axes.words())
}

/// RGBA colours of values (H, W) between two ends; transparent if not finite.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn coloured<'py>(
    py: Python<'py>,
    value: PyReadonlyArray2<'py, f32>,
    ends: [f64; 2],
    colours: &str,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let value = value.as_array();
    let (height, width) = value.dim();
    let values: Vec<f32> = value.iter().copied().collect();
    let colours = Colours::named("colours", colours).map_err(to_python)?;
    let pixels = value_colours::coloured(&values, ends, colours).into_flattened();
    PyArray1::from_vec(py, pixels).reshape([height, width, 4])
}

/// The upper end (mm) of a colour scale for lengths (H, W).
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn scale_end(value: PyReadonlyArray2<'_, f32>) -> f64 {
    let values: Vec<f32> = value.as_array().iter().copied().collect();
    value_colours::scale_end(&values)
}

/// How far a spiral CPR reaches (mm), for a largest radius (mm).
#[pyfunction]
pub(crate) fn spiral_reach(largest: f64) -> f64 {
    spiral_lengths::spiral_reach(largest)
}

/// The pitch of a spiral CPR (mm) from typical radius, smallest voxel side, reach, pixel side (mm), and largest number of columns.
#[pyfunction]
pub(crate) fn spiral_pitch(
    usual: f64,
    smallest_side: f64,
    radius: f64,
    pixel_spacing: f64,
    columns: f64,
) -> f64 {
    spiral_lengths::spiral_pitch(usual, smallest_side, Room { radius, pixel_spacing, columns })
}
