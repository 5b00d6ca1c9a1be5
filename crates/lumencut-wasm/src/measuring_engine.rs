//! Measuring, as the page's worker calls it. All methods throw the JSON of an error: `measuring` for a vessel or a place that
//! cannot be measured, `vessel tree` for a line that is not shown, `interrupted` once the page says stop.

use lumencut::measure::profile::Profile;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::engine::{Answer, Engine, answer, read, told};
use crate::stopping::{LONG, is_asked};
use lumencut::study::failure::Result;
use lumencut::study::measure_messages::{
    ComparedMessage, DiameterMessage, GradeMessage, MarksMessage, ProfileMessage, SectionMessage,
    SpotMessage, StretchMessage, VesselMessage,
};
use lumencut::study::report_messages::ReportMessage;

/// Measuring goes on until the page cancels.
fn stop() -> bool {
    is_asked(LONG)
}

impl Engine {
    fn measured(&mut self, line: usize) -> Result<&Profile> {
        self.study.measured(line, &stop)
    }
}

#[wasm_bindgen]
impl Engine {
    /// The profile of a line that is shown, under a point spread of this width (mm), or under the one that the tree tells, as
    /// JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn profile(&mut self, line: usize, fwhm: Option<f64>) -> Answer<String> {
        told(self.study.profile(line, fwhm, &stop).map(ProfileMessage::from))
    }

    /// What is told of the place that was marked on a line, as JSON: the stenosis, or why it is not graded.
    ///
    /// # Errors
    /// See the module.
    pub fn grade(&mut self, line: usize, marks: &str) -> Answer<String> {
        let grade = read::<MarksMessage>("marks", marks)
            .and_then(|marks| marks.marked())
            .and_then(|marked| self.measured(line).map(|profile| marked.grade(profile)));
        told(grade.map(GradeMessage::from))
    }

    /// What would make a percentage from places doubtful that are given as JSON, as a list of JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn doubts(&mut self, line: usize, compared: &str) -> Answer<String> {
        let doubts = read::<ComparedMessage>("places that are compared", compared)
            .and_then(|compared| self.measured(line).and_then(|profile| compared.doubts(profile)));
        told(doubts)
    }

    /// The references that are offered beside what was marked on a line, before and after the stenosis, as JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn offered_references(&mut self, line: usize, marks: &str) -> Answer<String> {
        let spots =
            read::<MarksMessage>("marks", marks).and_then(|marks| marks.marked()).and_then(|marked| {
                self.measured(line).and_then(|profile| Ok(marked.offered_references(profile)?))
            });
        told(spots.map(|spots| spots.map(|spot| spot.map(SpotMessage::from))))
    }

    /// The diameter at an arc length (mm), as JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn diameter_at(&mut self, line: usize, at: f64) -> Answer<String> {
        let found = self.measured(line).and_then(|profile| Ok(profile.diameter_at(at)?));
        told(found.map(|(diameter, uncertainty)| DiameterMessage { diameter, uncertainty }))
    }

    /// The section that is nearest to an arc length (mm), as JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn measured_section(&mut self, line: usize, at: f64) -> Answer<String> {
        told(self.measured(line).map(|profile| SectionMessage::nearest(profile, at)))
    }

    /// The stretch from one arc length to another (mm), as JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn stretch(&mut self, line: usize, start: f64, end: f64) -> Answer<String> {
        told(self.measured(line).and_then(|profile| StretchMessage::between(profile, [start, end])))
    }

    /// The angle (radians) between two stretches, whose ends (mm) are given as JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn angle_between(&mut self, line: usize, stretches: &str) -> Answer<f64> {
        let angle = read::<[[f64; 2]; 2]>("stretches", stretches).and_then(|[first, second]| {
            self.measured(line).and_then(|profile| Ok(profile.angle_between(first, second)?))
        });
        answer(angle)
    }

    /// The table of vessels that are given as JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn profiles_csv(&mut self, vessels: &str) -> Answer<String> {
        let vessels = read::<Vec<VesselMessage>>("vessels", vessels);
        answer(vessels.and_then(|vessels| self.study.profiles_csv(&vessels, &stop)))
    }

    /// Vessels that are given as JSON, with their stenoses, as a file of JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn profiles_json(&mut self, vessels: &str) -> Answer<String> {
        let vessels = read::<Vec<VesselMessage>>("vessels", vessels);
        answer(vessels.and_then(|vessels| self.study.profiles_json(&vessels, &stop)))
    }

    /// The pictures that the report of a vessel asks for, which is given as JSON, as JSON.
    ///
    /// # Errors
    /// See the module.
    pub fn report_plan(&mut self, vessel: &str) -> Answer<String> {
        let vessel = read::<VesselMessage>("vessel", vessel);
        told(vessel.and_then(|vessel| self.study.report_plan(&vessel, &stop)))
    }

    /// The report of a vessel with its pictures, which are given as JSON, as HTML.
    ///
    /// # Errors
    /// See the module.
    pub fn measured_report(&mut self, message: &str) -> Answer<String> {
        let message = read::<ReportMessage>("report", message);
        answer(message.and_then(|message| self.study.measured_report(&message, &stop)))
    }
}
