//! The layout of a diameter chart and of the straightened vessel above it, in plot pixels, for reports, Python and the page.

use serde::Serialize;

use super::chart::Chart;
use super::curves::Axes;
use super::scale::Axis;

/// Margins of the chart (plot pixels).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// For the numbers of diameters.
    pub left: f64,
    /// For the words of flags.
    pub right: f64,
    /// For the legend.
    pub above: f64,
    /// For the arc lengths.
    pub below: f64,
}

/// The margins of every chart.
pub const MARGINS: Margins = Margins { left: 56.0, right: 104.0, above: 38.0, below: 34.0 };

/// Smallest width and height of the axes (plot pixels).
const MIN_AXES: f64 = 20.0;

/// Height of a row of flags (plot pixels), and the largest fraction of the chart for all rows.
const ROW_HEIGHT: f64 = 12.0;
const MAX_ROWS_SHARE: f64 = 0.45;

/// Smallest distance between the words of flags (plot pixels); the words of narrower rows extend upwards.
const WORD_HEIGHT: f64 = 11.0;

/// Smallest distances of the ticks along both axes (plot pixels).
pub const TICK_DISTANCES: [f64; 2] = [60.0, 18.0];

/// Widths of the strip with the straightened vessel (mm), and the smallest fraction of a section picture that it shows.
const STRIP_WIDTHS_MM: [f64; 2] = [12.0, 90.0];
const MIN_STRIP_RATIO: f64 = 0.6;

const MIN_PIXEL_MM: f64 = 0.05;

/// The axis along a vessel of this length (mm), in a chart of this width (plot pixels).
pub(crate) fn axis_along(length: f64, width: f64) -> Axis {
    let start = MARGINS.left;
    Axis { low: 0.0, high: length, start, end: (width - MARGINS.right).max(start + MIN_AXES) }
}

/// Height of one of `count` rows of flags, below axes of this height (plot pixels).
pub fn row_height(count: usize, height: f64) -> f64 {
    ROW_HEIGHT.min(MAX_ROWS_SHARE * height / count.max(1) as f64)
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Layout {
    pub axes: Axes,
    pub row: f64,
    pub word_row: f64,
    pub bottom: f64,
}

impl Layout {
    pub(crate) fn of(chart: &Chart, [width, height]: [f64; 2]) -> Self {
        let bottom = (height - MARGINS.below).max(MARGINS.above + MIN_AXES);
        let row = row_height(chart.flags.len(), bottom - MARGINS.above);
        let start = bottom - row * chart.flags.len() as f64;
        let y = Axis { low: 0.0, high: chart.top, start, end: MARGINS.above };
        let axes = Axes { x: axis_along(chart.length(), width), y };
        Self { axes, row, word_row: row.max(WORD_HEIGHT), bottom }
    }
}

/// The layout of the straightened vessel, which lies above its chart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct StripLayout {
    /// Width across the vessel (mm).
    pub width: f64,
    /// Pixel side of the picture (mm).
    pub spacing: f64,
    /// Height (plot pixels).
    pub height: f64,
    /// Height relative to the scale along the vessel; 1 is true to scale.
    pub stretch: f64,
}

impl StripLayout {
    /// The layout along an axis, at most `height` plot pixels high, with `density` pixels per plot pixel. For a short
    /// vessel the width is less than `section_side`, the side of its section pictures (mm).
    pub fn along(x: &Axis, height: f64, density: f64, section_side: f64) -> Self {
        let pixel = (x.high - x.low) / (x.end - x.start);
        let wished = (height * pixel).min(section_side).max(MIN_STRIP_RATIO * section_side);
        let width = wished.clamp(STRIP_WIDTHS_MM[0], STRIP_WIDTHS_MM[1]);
        let height = height.min(width / pixel);
        let spacing = (pixel / density).max(MIN_PIXEL_MM);
        Self { width, spacing, height, stretch: height * pixel / width }
    }
}

#[cfg(test)]
#[path = "../tests/report_frame.rs"]
mod tests;
