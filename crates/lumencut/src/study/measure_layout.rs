//! The layout of a viewer's measuring pane: the straightened vessel, and below it the chart of its diameters.

use lumencut_core::stop::Stop;
use serde::{Deserialize, Serialize};

use crate::flag_table::FlagLook;
use crate::report::chart::{Chart, FlagRow};
use crate::report::curves::{Axes, band, line};
use crate::report::frame::{Layout, StripLayout, TICK_DISTANCES, axis_along};
use crate::report::pictures::{DEFAULT_SIDE_MM, section_side};
use crate::report::scale::Axis;
use crate::study::failure::Result;
use crate::study::line_facts::length_of;
use crate::study::open_study::Study;
use crate::text::rounded;

/// Largest fraction of the pane for the straightened vessel.
const MAX_STRIP_SHARE: f64 = 0.4;

#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "MeasurePane"))]
pub(crate) struct MeasurePaneMessage {
    line: usize,
    /// Whether the line was measured; otherwise it gets no chart.
    is_measured: bool,
    /// Width and height of the pane (plot pixels).
    size: [f64; 2],
    /// Height between vessel and chart that the viewer uses for other elements (plot pixels).
    between: f64,
    /// Number of pixels of the straightened vessel per plot pixel.
    density: f64,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct MeasureLayout {
    /// The axis of the arc length, common to vessel and chart.
    x: Axis,
    strip: StripLayout,
    chart: Option<ChartLayout>,
}

/// A chart in plot pixels from its upper left corner. Curves are SVG paths.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
struct ChartLayout {
    size: [f64; 2],
    y: Axis,
    /// Height of a row of flags; the first row begins below diameter 0.
    row: f64,
    /// Distance between the words of flags; the last word aligns with the last row.
    word_row: f64,
    /// The end of the last row.
    bottom: f64,
    /// Ticks along x and y.
    ticks: [Vec<Tick>; 2],
    /// The band from the shortest to the longest diameter.
    range: String,
    /// The band of the uncertainty.
    spread: String,
    /// Diameters of the circle of the same area.
    width: String,
    /// Diameters of sections without neighbours.
    isolated: Vec<[f64; 2]>,
    /// Diameters of omitted sections.
    left_out: Vec<[f64; 2]>,
    /// The limit of resolution.
    limit: Option<Tick>,
    flags: Vec<FlagBars>,
}

/// A tick: its pixel on the axis, and its words without unit.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
struct Tick {
    at: f64,
    words: String,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
struct FlagBars {
    look: &'static FlagLook,
    /// First and last column of each bar.
    bars: Vec<[f64; 2]>,
}

impl ChartLayout {
    fn of(chart: &Chart, size: [f64; 2]) -> Self {
        let Layout { axes, row, word_row, bottom } = Layout::of(chart, size);
        let Axes { x, y } = axes;
        let point = |[at, diameter]: &[f64; 2]| axes.point(*at, *diameter);
        let [range, spread] =
            [&chart.range, &chart.spread].map(|[low, high]| band(&axes, &chart.at, low, high));
        Self {
            size,
            y,
            row,
            word_row,
            bottom,
            ticks: [ticks(&x, TICK_DISTANCES[0]), ticks(&y, TICK_DISTANCES[1])],
            range,
            spread,
            width: line(&axes, &chart.at, &chart.width),
            isolated: chart.isolated.iter().map(|n| axes.point(chart.at[*n], chart.width[*n])).collect(),
            left_out: chart.left_out.iter().map(point).collect(),
            limit: chart.limit.zip(chart.limit_words()).map(|(at, words)| Tick { at: y.pixel(at), words }),
            flags: chart.flags.iter().map(|row| FlagBars::of(row, &x)).collect(),
        }
    }
}

impl FlagBars {
    fn of(row: &FlagRow, x: &Axis) -> Self {
        let bars = row.runs.iter().map(|run| run.map(|at| x.pixel_within(at)));
        Self { look: row.look, bars: bars.collect() }
    }
}

fn ticks(axis: &Axis, pixels: f64) -> Vec<Tick> {
    let tick = |value: f64| Tick { at: axis.pixel(value), words: rounded(value, 6) };
    axis.ticks(pixels).into_iter().map(tick).collect()
}

impl Study {
    pub(crate) fn measure_layout(&mut self, pane: &MeasurePaneMessage, stop: Stop) -> Result<MeasureLayout> {
        let [width, height] = pane.size;
        let strip = |length: f64, side: f64| {
            let x = axis_along(length, width);
            (x, StripLayout::along(&x, MAX_STRIP_SHARE * height, pane.density, side))
        };
        if !pane.is_measured {
            let line = self.lines.get(pane.line)?;
            let (x, strip) = strip(length_of(&line), DEFAULT_SIDE_MM);
            return Ok(MeasureLayout { x, strip, chart: None });
        }
        let profile = self.measured(pane.line, stop)?;
        let (x, strip) = strip(profile.length(), section_side(profile));
        let room = height - strip.height.round() - pane.between;
        Ok(MeasureLayout { x, strip, chart: Some(ChartLayout::of(&Chart::of(profile), [width, room])) })
    }
}

#[cfg(test)]
#[path = "tests/measure_layout.rs"]
mod tests;
