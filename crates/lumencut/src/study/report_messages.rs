//! Findings and reports of measured vessels, as a viewer requests them. The viewer supplies the pictures.

use lumencut_core::stop::Stop;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use crate::profile_json::Asked;
use crate::report::pictures::PAGE_PIXELS;
use crate::report::{
    Lengths, Plan, ReportMark, Sentence, Shown, Stated, Strip, VesselPage, View, distances, html, plan,
    sentences,
};
use crate::study::failure::Result;
use crate::study::measure_messages::VesselMessage;
use crate::study::open_study::Study;
use crate::study::view::method_word;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Finding {
    line: usize,
    sentences: Vec<Sentence>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Findings {
    vessels: Vec<Finding>,
    distances: Vec<String>,
}

/// A vessel with its report pictures (PNG, base64).
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ReportVessel {
    vessel: VesselMessage,
    view: View,
    strip: Strip,
    sections: Vec<String>,
}

#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportRequest"))]
pub(crate) struct ReportMessage {
    vessels: Vec<ReportVessel>,
    scan: Option<String>,
    saved: String,
    stated: Stated,
    /// Whether the reader assumed the voxel spacing.
    is_millimetre_assumed: bool,
    window: [f64; 2],
    /// View settings that differ from the defaults.
    #[cfg_attr(test, ts(type = "Settings"))]
    settings: Map<String, Json>,
    /// Straight distances (mm), shown on the first page.
    distances: Vec<f64>,
}

impl ReportMessage {
    fn shown(&self, asked: Asked) -> Shown {
        let view = |one: &ReportVessel| ["view".to_owned(), method_word(&one.view.method).to_owned()];
        // Their names and values mean little on paper; the session file keeps them.
        let changed = self.settings.len();
        let settings = (changed > 0).then(|| ["changed view settings".to_owned(), changed.to_string()]);
        Shown {
            scan: self.scan.clone(),
            saved: Some(self.saved.clone()),
            stated: self.stated,
            asked,
            window: self.window,
            settings: self.vessels.first().map(view).into_iter().chain(settings).collect(),
        }
    }

    /// Other measurements of the vessel with this index; the straight distances belong to the first vessel's page.
    fn lengths(&self, number: usize) -> Lengths {
        let distances = if number == 0 { self.distances.clone() } else { Vec::new() };
        Lengths { distances, ..lengths_of(&self.vessels[number].vessel) }
    }
}

fn lengths_of(vessel: &VesselMessage) -> Lengths {
    let marks = &vessel.marks;
    Lengths { stretches: marks.stretches(), diameters: marks.diameters().to_vec(), distances: Vec::new() }
}

impl Study {
    /// The sentences of the report for vessels, and for straight distances (mm).
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

    pub(crate) fn report_plan(&mut self, vessel: &VesselMessage, stop: Stop) -> Result<Plan> {
        let marked = vessel.marks.marked()?;
        let profile = self.measured(vessel.line, stop)?;
        let marks: Vec<ReportMark> = marked.places(profile).iter().map(ReportMark::from).collect();
        Ok(plan(profile, &marks, PAGE_PIXELS))
    }

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
