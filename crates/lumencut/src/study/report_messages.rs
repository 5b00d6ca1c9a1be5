//! The report of a measured vessel, as a viewer asks for it: it gives pictures, and the facade the rest.

use lumencut_core::stop::Stop;
use serde::Deserialize;
use serde_json::{Map, Value as Json};

use crate::profile_record::Asked;
use crate::report::{Lengths, Plan, ReportMark, Shown, Strip, VesselPage, View, html, plan};
use crate::study::failure::Result;
use crate::study::measure_messages::VesselMessage;
use crate::study::open_study::Study;
use crate::study::view::method_word;

/// A report of one vessel.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportRequest"))]
pub struct ReportMessage {
    /// The vessel, with its marks.
    vessel: VesselMessage,
    /// The name of the scan, where the user wants it there.
    scan: Option<String>,
    /// When it was saved, in words.
    saved: String,
    /// Whether the file of the scan states the sizes of its voxels, or the reader took them for 1 mm.
    has_units: bool,
    /// Whether it is the reader alone who says so.
    is_millimetre_assumed: bool,
    /// Whether it states the sides of the patient.
    has_orientation: bool,
    /// Level and width.
    window: [f64; 2],
    /// The settings of the view that differ from the usual ones.
    #[cfg_attr(test, ts(type = "Settings"))]
    settings: Map<String, Json>,
    /// A view of all vessels.
    view: View,
    /// The straightened vessel.
    strip: Strip,
    /// A section for each place of the plan, PNGs in base64.
    sections: Vec<String>,
    /// Stretches from one arc length to another (mm).
    stretches: Vec<[f64; 2]>,
    /// Straight distances (mm).
    distances: Vec<f64>,
}

impl ReportMessage {
    fn shown(&self, asked: Asked) -> Shown {
        let view = ["view".to_owned(), method_word(&self.view.method).to_owned()];
        let settings = self.settings.iter().map(|(name, value)| [name.replace('_', " "), words_of(value)]);
        Shown {
            scan: self.scan.clone(),
            saved: Some(self.saved.clone()),
            has_units: self.has_units,
            has_orientation: self.has_orientation,
            asked,
            window: self.window,
            settings: [view].into_iter().chain(settings).collect(),
        }
    }
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
    /// The pictures that the report of a vessel asks for.
    ///
    /// # Errors
    /// As [`Study::profile`]; `settings` for marks with another method or territory.
    pub fn report_plan(&mut self, vessel: &VesselMessage, stop: Stop) -> Result<Plan> {
        let marked = vessel.marks.marked()?;
        let profile = self.measured(vessel.line, stop)?;
        let marks: Vec<ReportMark> = marked.places(profile).iter().map(ReportMark::from).collect();
        Ok(plan(profile, &marks))
    }

    /// The report of a vessel as HTML.
    ///
    /// # Errors
    /// As [`Study::report_plan`], and `settings` for a picture that is not base64.
    pub fn measured_report(&mut self, message: &ReportMessage, stop: Stop) -> Result<String> {
        let vessels = std::slice::from_ref(&message.vessel);
        let graded = self.graded(vessels, stop)?;
        let shown = message.shown(self.asked(vessels, &graded));
        let marked = message.vessel.marks.marked()?;
        let lengths = Lengths { stretches: message.stretches.clone(), distances: message.distances.clone() };
        let pages: Vec<VesselPage> = self
            .rows(vessels, &graded, message.is_millimetre_assumed)
            .into_iter()
            .map(|measured| VesselPage {
                marks: marked.places(measured.profile).iter().map(ReportMark::from).collect(),
                measured,
                lengths: lengths.clone(),
                view: Some(message.view.clone()),
                strip: Some(message.strip.clone()),
                sections: message.sections.clone(),
            })
            .collect();
        Ok(html(&shown, &pages)?)
    }
}
