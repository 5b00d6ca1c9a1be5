//! The content and layout of diameter charts for matplotlib, and the size of section pictures.

use lumencut::report::chart::DEVIATIONS;
use lumencut::report::chart::{Chart, FlagRow};
use lumencut::report::frame::{MARGINS, TICK_DISTANCES, row_height};
use lumencut::report::pictures::{self, REPORT_PIXELS, SHEET_PIXELS};
use lumencut::report::scale::Axis;
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

use crate::measuring::Profile;

/// Adds to the module the frame of charts (plot pixels, standard deviations) and the sides of section pictures
/// (pixels).
pub(crate) fn add_layouts(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let frame = [
        ("left", MARGINS.left),
        ("right", MARGINS.right),
        ("above", MARGINS.above),
        ("below", MARGINS.below),
        ("deviations", DEVIATIONS),
    ];
    module.add("CHART_FRAME", frame.into_py_dict(module.py())?)?;
    let sides = [("report", REPORT_PIXELS), ("sheet", SHEET_PIXELS)];
    module.add("SECTION_PIXELS", sides.into_py_dict(module.py())?)
}

/// A chart; omitted sections are NaN.
#[derive(IntoPyObject)]
pub(crate) struct ChartParts {
    /// Diameter of the circle of the same area (mm); then the shortest and longest diameter and both ends of the
    /// uncertainty band.
    width: Vec<f64>,
    range: [Vec<f64>; 2],
    spread: [Vec<f64>; 2],
    /// Indices of the sections that are drawn as dots.
    isolated: Vec<usize>,
    /// Arc length and diameter (mm) of each omitted section.
    left_out: Vec<[f64; 2]>,
    /// Upper end of the diameter axis (mm).
    top: f64,
    /// Limit of resolution (mm), as a number and in words without unit.
    limit: Option<(f64, String)>,
    /// Words and paper colour of each flag, and the stretches (mm) on which it is set.
    flags: Vec<(&'static str, &'static str, Vec<[f64; 2]>)>,
    /// Height of a row of flags, as a fraction of the axes.
    row: f64,
}

/// The chart of a profile in axes of this height (plot pixels).
#[pyfunction]
pub(crate) fn diameter_chart(profile: &Profile, height: f64) -> ChartParts {
    let chart = Chart::of(&profile.0);
    let limit = chart.limit.zip(chart.limit_words());
    let flag = |FlagRow { look, runs }: FlagRow| (look.word, look.paper, runs);
    let row = row_height(chart.flags.len(), height) / height;
    let Chart { width, range, spread, isolated, left_out, top, flags, .. } = chart;
    let flags = flags.into_iter().map(flag).collect();
    ChartParts { width, range, spread, isolated, left_out, top, limit, flags, row }
}

/// The ticks of an axis of this length (plot pixels) between two values; `is_along` is the axis of arc lengths.
#[pyfunction]
pub(crate) fn chart_ticks(low: f64, high: f64, length: f64, is_along: bool) -> Vec<f64> {
    let [along, across] = TICK_DISTANCES;
    Axis { low, high, start: 0.0, end: length }.ticks(if is_along { along } else { across })
}

/// The pixel side (mm) of section pictures with this many pixels on each side.
#[pyfunction]
pub(crate) fn section_spacing(profile: &Profile, pixels: usize) -> f64 {
    pictures::section_spacing(&profile.0, pixels)
}
