//! The report of measured vessels, and what was found on them in sentences, as a viewer asks for both: it gives pictures, and the
//! facade the rest.

use lumencut_core::stop::Stop;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use crate::profile_record::Asked;
use crate::report::{
    Lengths, Plan, ReportMark, Sentence, Shown, Stated, Strip, VesselPage, View, distances, html, plan,
    sentences,
};
use crate::study::failure::Result;
use crate::study::measure_messages::VesselMessage;
use crate::study::open_study::Study;
use crate::study::view::method_word;

/// What was found on a vessel.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Finding {
    /// Its line.
    line: usize,
    /// The same sentences that the report has, in their order.
    sentences: Vec<Sentence>,
}

/// What was found in a scan.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Findings {
    /// On each of the vessels, in their order.
    vessels: Vec<Finding>,
    /// Straight distances, a sentence each.
    distances: Vec<String>,
}

/// A vessel of a report with its pictures, PNGs in base64.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ReportVessel {
    /// The vessel, with its marks.
    vessel: VesselMessage,
    /// A view of all vessels.
    view: View,
    /// The straightened vessel.
    strip: Strip,
    /// A section for each place of the plan.
    sections: Vec<String>,
}

/// A report of some vessels.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportRequest"))]
pub(crate) struct ReportMessage {
    /// A page each, in this order.
    vessels: Vec<ReportVessel>,
    /// The name of the scan, where the user wants it there.
    scan: Option<String>,
    /// When it was saved, in words.
    saved: String,
    /// What is known of the scan's grid.
    stated: Stated,
    /// Whether it is the reader alone who says how far its voxels lie apart.
    is_millimetre_assumed: bool,
    /// Level and width.
    window: [f64; 2],
    /// The settings of the view that differ from the usual ones.
    #[cfg_attr(test, ts(type = "Settings"))]
    settings: Map<String, Json>,
    /// Straight distances (mm), told on the first page.
    distances: Vec<f64>,
}

impl ReportMessage {
    fn shown(&self, asked: Asked) -> Shown {
        let view = |one: &ReportVessel| ["view".to_owned(), method_word(&one.view.method).to_owned()];
        let settings = self.settings.iter().map(|(name, value)| [name.replace('_', " "), words_of(value)]);
        Shown {
            scan: self.scan.clone(),
            saved: Some(self.saved.clone()),
            stated: self.stated,
            asked,
            window: self.window,
            settings: self.vessels.first().map(view).into_iter().chain(settings).collect(),
        }
    }

    /// What else was measured on a vessel of this number; distances belong to the scan, and stand on the first page.
    fn lengths(&self, number: usize) -> Lengths {
        let distances = if number == 0 { self.distances.clone() } else { Vec::new() };
        Lengths { distances, ..lengths_of(&self.vessels[number].vessel) }
    }
}

/// What was measured on a vessel beside a stenosis; the scan's distances are no vessel's.
fn lengths_of(vessel: &VesselMessage) -> Lengths {
    let marks = &vessel.marks;
    Lengths { stretches: marks.stretches(), diameters: marks.diameters().to_vec(), distances: Vec::new() }
}

/// The value of a setting in words.
fn words_of(value: &Json) -> String {
    match value {
        Json::Null => "none".to_owned(),
        Json::String(text) => text.clone(),
        Json::Array(values) => values.iter().map(words_of).collect::<Vec<_>>().join(" "),
        other => other.to_string(),
    }
}

impl Study {
    /// What was found on vessels, and the straight distances (mm) of the scan, in the sentences of the report.
    ///
    /// # Errors
    /// As [`Study::profile`]; `settings` for marks with another method or territory.
    pub(crate) fn findings(
        &mut self,
        vessels: &[VesselMessage],
        straight: &[f64],
        (stated, stop): (Stated, Stop),
    ) -> Result<Findings> {
        let graded = self.graded(vessels, stop)?;
        let rows = self.rows(vessels, &graded, false);
        let found = rows.iter().zip(vessels).map(|(measured, one)| Finding {
            line: one.line,
            sentences: sentences(stated, measured, &lengths_of(one)),
        });
        Ok(Findings { vessels: found.collect(), distances: distances(stated, straight) })
    }

    /// The pictures that the report of a vessel asks for.
    ///
    /// # Errors
    /// As [`Study::findings`].
    pub(crate) fn report_plan(&mut self, vessel: &VesselMessage, stop: Stop) -> Result<Plan> {
        let marked = vessel.marks.marked()?;
        let profile = self.measured(vessel.line, stop)?;
        let marks: Vec<ReportMark> = marked.places(profile).iter().map(ReportMark::from).collect();
        Ok(plan(profile, &marks))
    }

    /// The report of vessels as HTML.
    ///
    /// # Errors
    /// As [`Study::report_plan`], and `settings` for a picture that is not base64.
    pub(crate) fn measured_report(&mut self, message: &ReportMessage, stop: Stop) -> Result<String> {
        let vessels: Vec<VesselMessage> = message.vessels.iter().map(|one| one.vessel.clone()).collect();
        let graded = self.graded(&vessels, stop)?;
        let shown = message.shown(self.asked(&vessels, &graded));
        let rows = self.rows(&vessels, &graded, message.is_millimetre_assumed);
        let pages: Vec<VesselPage> = rows
            .into_iter()
            .zip(&message.vessels)
            .enumerate()
            .map(|(number, (measured, one))| {
                let marked = one.vessel.marks.marked()?;
                Ok(VesselPage {
                    marks: marked.places(measured.profile).iter().map(ReportMark::from).collect(),
                    measured,
                    lengths: message.lengths(number),
                    view: Some(one.view.clone()),
                    strip: Some(one.strip.clone()),
                    sections: one.sections.clone(),
                })
            })
            .collect::<Result<_>>()?;
        Ok(html(&shown, &pages)?)
    }
}

#[cfg(test)]
#[path = "tests/report_messages.rs"]
mod tests;
