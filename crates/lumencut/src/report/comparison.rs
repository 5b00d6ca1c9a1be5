//! The report of compared vessels: what changed, and the diameters of both scans along each vessel.

use std::fmt::Write;

use lumencut_core::error::Result;
use lumencut_vessels::measure::comparison::{ComparedPlace, DEVIATIONS};

use super::STYLE;
use super::curves::{Axes, band, line};
use super::frame::{MARGINS, TICK_DISTANCES, axis_along};
use super::markup::{escaped, figure, paragraph};
use super::plot::{QUIET, WIDTH};
use super::scale::Axis;
use crate::comparison::{Compared, signed};
use crate::profile_json::NOTICE;
use crate::text::{fixed, rounded};

/// Height of both charts in a report (plot pixels), and the share of the upper one, which shows the diameters.
const HEIGHT: f64 = 400.0;
const DIAMETERS: f64 = 0.575;
/// The axes reach this much beyond the largest value.
const HEADROOM: f64 = 1.12;
/// Smallest end of the axis of differences (mm).
const LEAST_DIFFERENCE: f64 = 0.5;
/// Colours of the earlier scan, of the later one, of their difference, and of changed parts.
const COLORS: [&str; 2] = ["#1f4e9c", "#b3470b"];
const DIFFERENCE: &str = "#222222";
const CHANGED: &str = "#d7263d";

/// The report as HTML, a page for each vessel. Fails with an error of kind `settings` for pictures that are not base64.
pub fn comparison_html(vessels: &[Compared]) -> Result<String> {
    let pages = vessels.iter().map(page).collect::<Result<String>>()?;
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Lumencut: two scans compared\
         </title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{pages}</body>\n</html>\n"
    ))
}

fn page(vessel: &Compared) -> Result<String> {
    let [before, after] = vessel.scans.each_ref().map(|scan| escaped(scan));
    let doubts: String = vessel.all_doubts().into_iter().map(|words| paragraph("doubt", words)).collect();
    let typical = format!("Median difference: {} mm.", signed(vessel.comparison.typical));
    Ok(format!(
        "<section>\n<h1>{}: before and after</h1>\n{}<p>Before: {before}. After: {after}.</p>\n{doubts}{}{}\
         <figure class=\"plot\">\n{}<figcaption>Diameters of both scans, and the difference, by the arc length on the earlier \
         scan; bands: ± {DEVIATIONS} standard deviations; red: changed</figcaption>\n</figure>\n{}{}{}</section>\n",
        escaped(&vessel.vessel),
        paragraph("notice", NOTICE),
        findings(vessel),
        pictures(vessel)?,
        plot(vessel, [WIDTH, HEIGHT]),
        table(vessel),
        paragraph("small", &typical),
        paragraph("small", &format!("The vessels were {}.", vessel.matched())),
    ))
}

fn pictures(vessel: &Compared) -> Result<String> {
    let both = vessel.pictures.iter().zip(["Before", "After"]);
    let figures = both.map(|(picture, words)| figure(picture, words)).collect::<Result<String>>()?;
    Ok(if figures.is_empty() { figures } else { format!("<div class=\"top both\">\n{figures}</div>\n") })
}

fn findings(vessel: &Compared) -> String {
    let as_sentence = |words: &String| paragraph("finding", &(words[..1].to_uppercase() + &words[1..]));
    vessel.changes().iter().map(as_sentence).collect()
}

fn table(vessel: &Compared) -> String {
    if vessel.comparison.changes.is_empty() {
        return String::new();
    }
    let row = |place: &ComparedPlace| {
        let pair = |n: usize| format!("{} ± {}", fixed(place.diameter[n], 2), fixed(place.uncertainty[n], 2));
        let difference = format!("{} ± {}", signed(place.difference), fixed(place.difference_uncertainty, 2));
        let cells = [fixed(place.at[0], 1), fixed(place.at[1], 1), pair(0), pair(1), difference];
        format!("<tr>{}</tr>\n", cells.map(|cell| format!("<td>{cell}</td>")).concat())
    };
    let rows: String = vessel.comparison.changes.iter().map(|change| row(&change.largest)).collect();
    format!(
        "<h2>Largest differences (mm)</h2>\n<table>\n<tr><th>at, before</th><th>at, after</th><th>diameter before</th>\
         <th>diameter after</th><th>difference</th></tr>\n{rows}</table>\n"
    )
}

/// The charts of diameters and differences as an SVG picture of this size (plot pixels), and their common axis of arc lengths on the
/// earlier vessel.
pub(crate) fn comparison_chart(vessel: &Compared, size: [f64; 2]) -> (String, Axis) {
    let plot = plot(vessel, size).replacen("<svg ", "<svg xmlns=\"http://www.w3.org/2000/svg\" ", 1);
    (plot, axis(vessel, size[0]))
}

fn axis(vessel: &Compared, width: f64) -> Axis {
    axis_along(vessel.comparison.places.last().map_or(0.0, |place| place.at[0]), width)
}

fn plot(vessel: &Compared, [width, height]: [f64; 2]) -> String {
    let places = &vessel.comparison.places;
    let at: Vec<f64> = places.iter().map(|place| place.at[0]).collect();
    let x = axis(vessel, width);
    let border = DIAMETERS * height;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"diameters in both scans\" font-size=\"11\" \
         font-family=\"system-ui, sans-serif\" fill=\"#111111\">\n"
    );
    let spread = |value: &dyn Fn(&ComparedPlace) -> [f64; 2], sign: f64| -> Vec<f64> {
        places.iter().map(|place| value(place)[0] + sign * DEVIATIONS * value(place)[1]).collect()
    };
    let widest = |n: usize| spread(&move |place| [place.diameter[n], place.uncertainty[n]], 1.0);
    let top = [widest(0), widest(1)].concat().into_iter().filter(|value| value.is_finite());
    let top = HEADROOM * top.fold(1.0, f64::max);
    let axes = Axes { x, y: Axis { low: 0.0, high: top, start: border - 8.0, end: MARGINS.above } };
    push_axes(&mut svg, &axes, "diameter (mm)");
    for n in 0..2 {
        let of = move |place: &ComparedPlace| [place.diameter[n], place.uncertainty[n]];
        push_curve(
            &mut svg,
            &axes,
            &at,
            [&spread(&of, -1.0), &spread(&of, 0.0), &spread(&of, 1.0)],
            COLORS[n],
        );
    }
    let of = |place: &ComparedPlace| [place.difference, place.difference_uncertainty];
    let [low, middle, high] = [-1.0, 0.0, 1.0].map(|sign| spread(&of, sign));
    let far = low.iter().chain(&high).filter(|value| value.is_finite());
    let far = HEADROOM * far.fold(LEAST_DIFFERENCE, |far: f64, value| far.max(value.abs()));
    let y = Axis { low: -far, high: far, start: height - MARGINS.below, end: border + 12.0 };
    let axes = Axes { x, y };
    push_axes(&mut svg, &axes, "difference (mm)");
    push_changes(&mut svg, vessel, &axes);
    push_curve(&mut svg, &axes, &at, [&low, &middle, &high], DIFFERENCE);
    push_legend(&mut svg, &vessel.scans, width);
    svg.push_str("</svg>\n");
    svg
}

fn push_axes(svg: &mut String, Axes { x, y }: &Axes, words: &str) {
    for value in x.ticks(TICK_DISTANCES[0]) {
        let (at, below) = (x.pixel(value), y.start + 13.0);
        let words = rounded(value, 6);
        push(
            svg,
            format_args!(
                "<path d=\"M{at:.2} {}V{}\" stroke=\"#00000020\"/><text x=\"{at:.2}\" y=\"{below:.2}\" \
             text-anchor=\"middle\" fill=\"{QUIET}\">{words}</text>\n",
                y.end, y.start
            ),
        );
    }
    for value in y.ticks(TICK_DISTANCES[1]) {
        let (at, words) = (y.pixel(value), rounded(value, 6));
        push(
            svg,
            format_args!(
                "<path d=\"M{} {at:.2}H{}\" stroke=\"#00000020\"/><text x=\"{}\" y=\"{:.2}\" text-anchor=\"end\" \
             fill=\"{QUIET}\">{words}</text>\n",
                x.start - 4.0,
                x.end,
                x.start - 7.0,
                at + 4.0
            ),
        );
    }
    let middle = f64::midpoint(y.start, y.end);
    push(
        svg,
        format_args!(
            "<path d=\"M{} {}V{:.2}H{}\" fill=\"none\" stroke=\"{QUIET}\"/>\n<text transform=\"translate(12 {middle:.2}) \
         rotate(-90)\" text-anchor=\"middle\">{words}</text>\n",
            x.start, y.end, y.start, x.end
        ),
    );
}

fn push_curve(svg: &mut String, axes: &Axes, at: &[f64], [low, middle, high]: [&[f64]; 3], color: &str) {
    let (band, curve) = (band(axes, at, low, high), line(axes, at, middle));
    push(
        svg,
        format_args!(
            "<path d=\"{band}\" fill=\"{color}\" fill-opacity=\"0.25\"/>\n<path d=\"{curve}\" fill=\"none\" \
         stroke=\"{color}\" stroke-width=\"1.6\"/>\n"
        ),
    );
}

fn push_changes(svg: &mut String, vessel: &Compared, Axes { x, y }: &Axes) {
    for change in &vessel.comparison.changes {
        let [from, to] = change.range.map(|at| x.pixel(at));
        push(
            svg,
            format_args!(
                "<rect class=\"change\" x=\"{from:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{CHANGED}\" \
             fill-opacity=\"0.2\"/>\n",
                y.end,
                (to - from).max(1.0),
                y.start - y.end
            ),
        );
    }
}

fn push_legend(svg: &mut String, scans: &[String; 2], width: f64) {
    let apart = (width - MARGINS.left) / 2.0;
    for (n, (scan, color)) in scans.iter().zip(COLORS).enumerate() {
        let (left, words) = (MARGINS.left + apart * n as f64, escaped(scan));
        let name = ["before", "after"][n];
        push(
            svg,
            format_args!(
                "<g transform=\"translate({left} 14)\"><path d=\"M0 -3H18\" stroke=\"{color}\" stroke-width=\"1.6\"/>\
             <text x=\"23\" fill=\"{QUIET}\">{name}: {words}</text></g>\n"
            ),
        );
    }
}

fn push(svg: &mut String, markup: std::fmt::Arguments) {
    // Writing to memory does not fail.
    let _ = svg.write_fmt(markup);
}
