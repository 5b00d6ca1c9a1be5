//! Labels around a picture: letters of the patient's sides, and scale bar.

use glam::DVec3;
use lumencut::letters::{self, EdgeLetters};
use lumencut::scale_bar::ScaleBar;
use pyo3::prelude::*;

/// Letters of the sides to which a direction (LPS) points, the main one first.
#[pyfunction]
pub(crate) fn sides(direction: [f64; 3]) -> String {
    letters::sides(DVec3::from_array(direction))
}

/// The letters at the four edges of a picture, whose columns run along `right` and rows along `down` (LPS).
#[pyfunction]
pub(crate) fn edge_letters(right: [f64; 3], down: [f64; 3]) -> Vec<(&'static str, String)> {
    let found = EdgeLetters::new(DVec3::from_array(right), DVec3::from_array(down));
    vec![("left", found.left), ("right", found.right), ("top", found.top), ("bottom", found.bottom)]
}

/// The patient-side letter of each grid axis, from directions in LPS, and the largest deviation of an axis from its side (radians).
#[pyfunction]
pub(crate) fn grid_letters(directions: [[f64; 3]; 3]) -> (String, f64) {
    let directions = directions.map(DVec3::from_array);
    let sides = letters::nearest_axes(directions);
    let off = directions.iter().zip(sides).map(|(one, side)| one.angle_between(side)).fold(0.0, f64::max);
    (letters::grid_letters(directions), off)
}

/// The length (mm), label and pixels of the scale bar for a picture width (pixels) and pixel side (mm).
#[pyfunction]
pub(crate) fn scale_bar(width: f64, pixel_spacing: f64) -> Option<(f64, String, f64)> {
    ScaleBar::new(width, pixel_spacing).map(|bar| (bar.length, bar.words, bar.pixels))
}
