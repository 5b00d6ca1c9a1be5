//! Draws the profile of a vessel as SVG, below the straightened vessel and with the same axis.

use std::f64::consts::PI;
use std::fmt::Write;

use lumencut_core::error::Result;
use lumencut_vessels::measure::profile::Profile;

use super::Strip;
use super::chart::DEVIATIONS;
use super::chart::{Chart, FlagRow};
use super::curves::{Axes, band, line};
use super::frame::{Layout, MARGINS, TICK_DISTANCES};
use super::markup::png_address;
use super::places::ReportPlace;
use super::scale::Axis;
use crate::text::{fixed, rounded};

/// Plot width, height of the chart, and largest height of the straightened vessel (plot pixels).
pub(super) const WIDTH: f64 = 1000.0;
const CHART: f64 = 270.0;
pub(super) const STRIP: f64 = 150.0;

const CURVE: &str = "#1f4e9c";
const LEFT_OUT: &str = "#808080";
pub(super) const QUIET: &str = "#444444";
const OUTLINE: &str = "#222222";

pub(super) struct Plot<'a> {
    pub profile: &'a Profile,
    pub places: &'a [ReportPlace],
    pub strip: Option<&'a Strip>,
    pub has_units: bool,
}

impl Plot<'_> {
    pub(super) fn svg(&self) -> Result<String> {
        let chart = Chart::of(self.profile);
        let layout = Layout::of(&chart, [WIDTH, CHART]);
        let (strip, top) = self.strip_markup(&layout.axes.x)?;
        let mut svg = format!(
            "<svg viewBox=\"0 0 {WIDTH} {}\" role=\"img\" aria-label=\"vessel and its diameter\" \
             font-size=\"11\" font-family=\"system-ui, sans-serif\" fill=\"#111111\">\n{strip}\
             <g transform=\"translate(0 {top:.2})\">\n",
            fixed(top + CHART, 2)
        );
        self.push_grid(&mut svg, &layout);
        self.push_curves(&mut svg, &layout, &chart);
        push_flags(&mut svg, &layout, &chart);
        push_legend(&mut svg);
        svg.push_str("</g>\n");
        for place in self.places {
            self.push_place(&mut svg, &layout, place, top);
        }
        svg.push_str("</svg>\n");
        Ok(svg)
    }

    fn strip_markup(&self, x: &Axis) -> Result<(String, f64)> {
        let Some(strip) = self.strip else { return Ok((String::new(), 0.0)) };
        let per_mm = (x.end - x.start) / (x.high - x.low);
        let [columns, rows] = strip.size.map(|count| count as f64 * strip.spacing * per_mm);
        let height = rows.min(STRIP);
        // The vessel starts in the middle of the first column.
        let left = x.start - strip.spacing * per_mm / 2.0;
        let address = png_address(&strip.picture)?;
        let mut markup = format!(
            "<image href=\"{address}\" x=\"{left:.2}\" y=\"0\" width=\"{columns:.2}\" height=\"{height:.2}\" \
             preserveAspectRatio=\"none\"/>\n"
        );
        if (height / rows - 1.0).abs() > 0.01 {
            let (column, row) = (x.end + 6.0, height / 2.0);
            let words = format!("height × {}", rounded(height / rows, 2));
            push(&mut markup, format_args!("<text x=\"{column}\" y=\"{row:.2}\">{words}</text>\n"));
        }
        Ok((markup, height))
    }

    fn push_grid(&self, svg: &mut String, layout: &Layout) {
        let (Axes { x, y }, bottom) = (layout.axes, layout.bottom);
        let unit = if self.has_units { " (mm)" } else { "" };
        for value in x.ticks(TICK_DISTANCES[0]) {
            let (at, words) = (x.pixel(value), rounded(value, 6));
            push(
                svg,
                format_args!(
                    "<path d=\"M{at:.2} {}V{}\" stroke=\"#00000020\"/><text x=\"{at:.2}\" y=\"{}\" \
                     text-anchor=\"middle\" fill=\"{QUIET}\">{words}</text>\n",
                    y.end,
                    bottom + 4.0,
                    bottom + 15.0
                ),
            );
        }
        for value in y.ticks(TICK_DISTANCES[1]) {
            let (at, words) = (y.pixel(value), rounded(value, 6));
            push(
                svg,
                format_args!(
                    "<path d=\"M{} {at:.2}H{}\" stroke=\"#00000020\"/><text x=\"{}\" y=\"{:.2}\" \
                     text-anchor=\"end\" fill=\"{QUIET}\">{words}</text>\n",
                    x.start - 4.0,
                    x.end,
                    x.start - 7.0,
                    at + 4.0
                ),
            );
        }
        push(
            svg,
            format_args!(
                "<path d=\"M{} {}V{:.2}H{}\" fill=\"none\" stroke=\"{QUIET}\"/>\n\
                 <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">arc length{unit}</text>\n\
                 <text transform=\"translate(12 {:.2}) rotate(-90)\" text-anchor=\"middle\">diameter{unit}</text>\n",
                x.start,
                y.end,
                y.start,
                x.end,
                f64::midpoint(x.start, x.end),
                bottom + 29.0,
                f64::midpoint(y.start, y.end)
            ),
        );
    }

    fn push_curves(&self, svg: &mut String, layout: &Layout, chart: &Chart) {
        let (axes, at) = (&layout.axes, &chart.at);
        let [range, spread] = [&chart.range, &chart.spread].map(|[low, high]| band(axes, at, low, high));
        let curve = line(axes, at, &chart.width);
        push(
            svg,
            format_args!(
                "<path class=\"range\" d=\"{range}\" fill=\"{CURVE}\" fill-opacity=\"0.16\"/>\n\
                 <path class=\"band\" d=\"{spread}\" fill=\"{CURVE}\" fill-opacity=\"0.4\"/>\n\
                 <path class=\"width\" d=\"{curve}\" fill=\"none\" stroke=\"{CURVE}\" stroke-width=\"1.6\"/>\n"
            ),
        );
        for n in &chart.isolated {
            push_dot(svg, axes.point(at[*n], chart.width[*n]), &format!("fill=\"{CURVE}\""));
        }
        for [at, diameter] in &chart.left_out {
            let look = format!("class=\"left-out\" fill=\"none\" stroke=\"{LEFT_OUT}\"");
            push_dot(svg, axes.point(*at, *diameter), &look);
        }
        self.push_limit(svg, axes, chart);
    }

    fn push_limit(&self, svg: &mut String, axes: &Axes, chart: &Chart) {
        let Some((limit, words)) = chart.limit.zip(chart.limit_words()) else { return };
        let (at, unit) = (axes.y.pixel(limit), if self.has_units { " mm" } else { "" });
        push(
            svg,
            format_args!(
                "<path class=\"limit\" d=\"M{} {at:.2}H{}\" stroke=\"{LEFT_OUT}\" \
                 stroke-dasharray=\"1.5 3\"/><text x=\"{}\" y=\"{:.2}\" text-anchor=\"end\" \
                 fill=\"{QUIET}\">{words}{unit}</text>\n",
                axes.x.start,
                axes.x.end,
                axes.x.end - 4.0,
                at - 3.0,
            ),
        );
    }

    fn push_place(&self, svg: &mut String, layout: &Layout, place: &ReportPlace, top: f64) {
        let Axes { x, y } = layout.axes;
        let area = self.profile.area[self.profile.nearest_section(place.at)];
        let diameter = if area.is_finite() { 2.0 * (area / PI).sqrt() } else { 0.0 };
        let (column, row) = (x.pixel(place.at), top + y.pixel_within(diameter));
        let color = place.color();
        let (fill, dashes) =
            if place.is_suggestion { ("#ffffff", " stroke-dasharray=\"4 3\"") } else { (color, "") };
        let symbol = if place.is_reference {
            format!("M{column:.2} {row:.2}m0 -6l5 6l-5 6l-5 -6Z")
        } else {
            format!("M{column:.2} {row:.2}m-5 -5h10l-5 9Z")
        };
        push(
            svg,
            format_args!(
                "<g class=\"place\" stroke=\"{OUTLINE}\" fill=\"{fill}\"><path d=\"M{column:.2} 0V{top:.2}M{column:.2} {:.2}V{:.2}\" \
                 stroke=\"{color}\" stroke-width=\"1.4\"{dashes}/><path d=\"{symbol}\"/></g>\n",
                // This keeps the words between vessel and chart readable.
                top + MARGINS.above,
                top + layout.bottom
            ),
        );
    }
}

fn push_flags(svg: &mut String, layout: &Layout, chart: &Chart) {
    let (Axes { x, y }, row) = (layout.axes, layout.row);
    for (n, FlagRow { look, runs }) in chart.flags.iter().enumerate() {
        let (color, top) = (look.paper, y.start + n as f64 * row);
        for run in runs {
            let [start, end] = run.map(|at| x.pixel_within(at));
            push(
                svg,
                format_args!(
                    "<rect x=\"{start:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{color}\"/>",
                    top + 0.2 * row,
                    (end - start).max(1.0),
                    0.6 * row
                ),
            );
        }
        push(
            svg,
            format_args!(
                "<text class=\"flag\" x=\"{}\" y=\"{:.2}\" fill=\"{color}\" font-size=\"{:.2}\">\
                 <title>{}</title>{}</text>\n",
                x.end + 6.0,
                top + 0.5 * row + 4.0,
                row.clamp(7.0, 11.0),
                look.meaning,
                look.word
            ),
        );
    }
}

fn push_legend(svg: &mut String) {
    push(
        svg,
        format_args!(
            "<g class=\"legend\" fill=\"{QUIET}\" transform=\"translate({} 12)\">\
             <path d=\"M0 -3H18\" stroke=\"{CURVE}\" stroke-width=\"1.6\"/>\
             <text x=\"23\">diameter of a circle of the same area</text>\
             <rect x=\"238\" y=\"-8\" width=\"18\" height=\"9\" fill=\"{CURVE}\" fill-opacity=\"0.4\"/>\
             <text x=\"261\">± {DEVIATIONS} standard deviations</text>\
             <rect x=\"404\" y=\"-8\" width=\"18\" height=\"9\" fill=\"{CURVE}\" fill-opacity=\"0.16\"/>\
             <text x=\"427\">shortest to longest</text>\
             <circle cx=\"549\" cy=\"-4\" r=\"2.5\" fill=\"none\" stroke=\"{LEFT_OUT}\"/>\
             <text x=\"556\">excluded: see the flags</text></g>\n",
            MARGINS.left
        ),
    );
}

fn push_dot(svg: &mut String, [x, y]: [f64; 2], look: &str) {
    push(svg, format_args!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"1.8\" {look}/>\n"));
}

fn push(svg: &mut String, markup: std::fmt::Arguments) {
    // Writing to memory does not fail.
    let _ = svg.write_fmt(markup);
}
