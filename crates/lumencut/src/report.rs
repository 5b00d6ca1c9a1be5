//! The report of measured vessels: a self-contained web page without scripts or links. It names vessels, and the scan only if the
//! caller passes its name. The caller supplies the pictures.

pub mod chart;
pub mod comparison;
pub(crate) mod curves;
mod findings;
pub mod frame;
mod markup;
mod method_text;
pub mod pictures;
mod places;
mod plot;
pub mod scale;

use lumencut_core::error::Result;
use serde::Deserialize;

use crate::profile_json::{Asked, NOTICE};
use crate::profile_marks::Measured;
use crate::study::view::method_word;
use findings::findings;
pub(crate) use findings::{Sentence, distances, sentences};
use markup::{escaped, figure, paragraph};
pub use method_text::Stated;
use method_text::{EXPLAINED, UNITLESS, method_text};
pub use pictures::{Plan, plan};
pub use places::{ReportMark, ReportPlace};
use places::{places, row, table, widest_row};
use plot::Plot;

const STYLE: &str = include_str!("report/style.css");

/// What all vessels of a report have in common.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The scan's name, if requested.
    pub scan: Option<String>,
    /// When the report was saved, in words.
    pub saved: Option<String>,
    /// What is known about the scan's grid.
    pub stated: Stated,
    /// The measuring request.
    pub asked: Asked,
    /// Level and width of the pictures.
    pub window: [f64; 2],
    /// Other settings of the pictures: names and values.
    pub settings: Vec<[String; 2]>,
}

/// A measured vessel with its pictures (PNG, base64).
#[derive(Clone, Debug)]
pub struct VesselPage<'a> {
    /// The vessel with its profile and its grade.
    pub measured: Measured<'a>,
    /// Marked and suggested places.
    pub marks: Vec<ReportMark>,
    /// Measurements other than the stenosis.
    pub lengths: Lengths,
    /// A view of all vessels.
    pub view: Option<View>,
    /// The straightened vessel.
    pub strip: Option<Strip>,
    /// For each of [`Plan::places`], two pictures of the section: with its contour and without.
    pub sections: Vec<String>,
}

/// Measurements other than the stenosis.
#[derive(Clone, Debug, Default)]
pub struct Lengths {
    /// Places of noted diameters (arc lengths, mm).
    pub diameters: Vec<f64>,
    /// Up to two stretches of the vessel, by arc lengths (mm).
    pub stretches: Vec<[f64; 2]>,
    /// Straight distances (mm).
    pub(crate) distances: Vec<f64>,
}

/// A view of all vessels.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportView"))]
pub struct View {
    /// PNG in base64.
    pub picture: String,
    /// The method of the view, such as `csr`.
    #[cfg_attr(test, ts(type = "Method"))]
    pub method: String,
}

/// The straightened vessel from left to right. The vessel starts in the middle of the first column.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportStrip"))]
pub struct Strip {
    /// PNG in base64.
    pub picture: String,
    /// Columns and rows.
    pub size: [usize; 2],
    /// Pixel side (mm).
    pub spacing: f64,
}

/// The report as HTML. Fails with [`lumencut_core::error::ErrorKind::Settings`] if a picture is not base64.
pub fn html(shown: &Shown, vessels: &[VesselPage]) -> Result<String> {
    let title = match vessels {
        [one] => format!("lumen of {}", name_of(&one.measured)),
        several => format!("lumen of {} vessels", several.len()),
    };
    let pages = vessels.iter().map(|vessel| page(shown, vessel)).collect::<Result<Vec<_>>>()?.concat();
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Lumencut: {}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n{pages}</body>\n</html>\n",
        escaped(&title)
    ))
}

fn name_of(measured: &Measured) -> String {
    measured.name.clone().unwrap_or_else(|| format!("vessel {}", measured.id))
}

fn page(shown: &Shown, vessel: &VesselPage) -> Result<String> {
    let (profile, places) = (vessel.measured.profile, places(&vessel.marks));
    let plot =
        Plot { profile, places: &places, strip: vessel.strip.as_ref(), has_units: shown.stated.has_units };
    let units = if shown.stated.has_units { vessel.measured.assumed() } else { Some(UNITLESS) };
    let units = units.map(|words| paragraph("small", words)).unwrap_or_default();
    Ok(format!(
        "<section>\n{}{}<figure class=\"plot\">\n{}<figcaption>Straightened CPR and diameter along the vessel, on \
         one axis</figcaption>\n</figure>\n{}{}{units}{}</section>\n",
        head(shown, vessel),
        top(shown, vessel)?,
        plot.svg()?,
        tables(shown, vessel, &places)?,
        paragraph("small", EXPLAINED),
        paragraph("small", &method_text(shown, vessel)),
    ))
}

fn head(shown: &Shown, vessel: &VesselPage) -> String {
    let length = shown.stated.length(vessel.measured.profile.length(), 1);
    let name = vessel.measured.name.clone().unwrap_or_else(|| format!("Vessel {}", vessel.measured.id));
    let scan = shown.scan.as_ref().map(|scan| format!("{scan} – ")).unwrap_or_default();
    let saved = shown.saved.as_ref().map(|words| paragraph("", &format!("Saved on {words}")));
    let head = format!("<h1>{}, {length}</h1>\n", escaped(&format!("{scan}{name}")));
    let suggested = vessel.measured.suggested_name.as_ref();
    let suggested = suggested.map(|name| paragraph("", &format!("Suggested name, not confirmed: {name}?")));
    head + &suggested.unwrap_or_default() + &saved.unwrap_or_default() + &paragraph("notice", NOTICE)
}

fn top(shown: &Shown, vessel: &VesselPage) -> Result<String> {
    let found = findings(shown, vessel);
    let Some(view) = &vessel.view else { return Ok(found) };
    let words = format!("{} of the vessels, as shown", method_word(&view.method));
    Ok(format!("<div class=\"top\">\n{}<div>\n{found}</div>\n</div>\n", figure(&view.picture, &words)?))
}

fn tables(shown: &Shown, vessel: &VesselPage, places: &[ReportPlace]) -> Result<String> {
    let profile = vessel.measured.profile;
    let rows = |is_suggestion: bool| {
        let these = places.iter().filter(move |place| place.is_suggestion == is_suggestion);
        these.map(|place| row(profile, place, shown)).collect::<Vec<_>>()
    };
    let (marked, mut offered) = (rows(false), rows(true));
    offered.extend(profile.offered_widest().map(|spot| widest_row(profile, spot.at, shown)));
    let mut text = "<h2>Places</h2>\n".to_owned();
    if marked.is_empty() && offered.is_empty() {
        text += &paragraph(
            "",
            "No place is marked, and no section is reliable enough to suggest: see the flags.",
        );
        return Ok(text);
    }
    text += &if marked.is_empty() {
        paragraph("", "No place is marked.")
    } else {
        table(&marked, shown.stated.has_units)
    };
    text += &sections(shown, vessel, places, false)?;
    if !offered.is_empty() {
        text += "<h2>Suggestions, not confirmed</h2>\n";
        text += &table(&offered, shown.stated.has_units);
        text += &sections(shown, vessel, places, true)?;
    }
    Ok(text)
}

fn sections(
    shown: &Shown,
    vessel: &VesselPage,
    places: &[ReportPlace],
    is_suggestion: bool,
) -> Result<String> {
    let with_pictures = places.iter().zip(&vessel.sections);
    let these = with_pictures.filter(|(place, _)| place.is_suggestion == is_suggestion);
    let figures = these.map(|(place, picture)| figure(picture, &place.caption(shown.stated.unit())));
    let figures = figures.collect::<Result<Vec<_>>>()?.concat();
    if figures.is_empty() {
        return Ok(figures);
    }
    let head = "<h2>Sections at these places, with the contour and without</h2>";
    Ok(format!("{head}\n<div class=\"sections\">\n{figures}</div>\n"))
}

#[cfg(test)]
#[path = "tests/report.rs"]
mod tests;
