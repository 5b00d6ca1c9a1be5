//! Measures the shown lines in the same way as Python's `lumencut.measure(volume, vessel, 0.5, fwhm, tree=tree)`.

use crate::profile_json::{Asked, vessels_json};
use crate::profile_marks::{Grade, Measured};
use crate::profile_record::ProfileRecord;
use crate::profile_table::vessels_csv;
use lumencut_core::stop::Stop;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::measuring::STEP;

use crate::study::failure::Result;
use crate::study::measure_messages::VesselMessage;
use crate::study::open_study::Study;
use crate::study::profiles::{ProfileParameters, Profiles};
use crate::suggested_names::is_nameless;

pub(super) struct GradedVessel {
    number: usize,
    grade: Option<Grade>,
}

impl Study {
    /// The profile of a shown line for a point-spread width (mm); None estimates the width from the tree.
    pub fn profile(&mut self, line: usize, fwhm: Option<f64>, stop: Stop) -> Result<&Profile> {
        let found = self.profiles.of(&self.content, line, &ProfileParameters { fwhm, stop })?;
        self.profiles.ask_with(line, fwhm);
        Ok(self.profiles.kept(found))
    }

    /// The profile of a shown line, with the point-spread width that was last requested for it.
    pub fn measured(&mut self, line: usize, stop: Stop) -> Result<&Profile> {
        self.profile(line, self.profiles.width(line), stop)
    }

    /// The record of a line's profile as text.
    pub(crate) fn profile_record(&mut self, line: usize, stop: Stop) -> Result<String> {
        let number = self.profiles.of(
            &self.content,
            line,
            &ProfileParameters { fwhm: self.profiles.width(line), stop },
        )?;
        Ok(ProfileRecord::of(self.profiles.kept(number), self.content.scan()).text())
    }

    pub(crate) fn forget_profiles(&mut self) {
        self.profiles = Profiles::default();
    }

    /// The CSV of `lumencut measure -o x.csv`; it states whether lengths are assumed.
    pub(crate) fn profiles_csv(
        &mut self,
        vessels: &[VesselMessage],
        is_millimetre_assumed: bool,
        stop: Stop,
    ) -> Result<String> {
        let graded = self.graded(vessels, stop)?;
        Ok(vessels_csv(&self.rows(vessels, &graded, is_millimetre_assumed)))
    }

    /// The JSON of `lumencut measure -o x.json`. As there, the marks of a single vessel are part of the settings.
    pub(crate) fn profiles_json(
        &mut self,
        vessels: &[VesselMessage],
        is_millimetre_assumed: bool,
        stop: Stop,
    ) -> Result<String> {
        let graded = self.graded(vessels, stop)?;
        let asked = self.asked(vessels, &graded);
        Ok(vessels_json(&asked, &self.rows(vessels, &graded, is_millimetre_assumed)))
    }

    /// The request; for a single vessel, it includes the marks.
    pub(super) fn asked(&self, vessels: &[VesselMessage], graded: &[GradedVessel]) -> Asked {
        let asked = match (vessels, graded) {
            ([one], [graded]) => one.marks.asked(graded.grade.as_ref().and_then(Grade::stenosis).is_some()),
            _ => Asked::default(),
        };
        Asked { step_mm: STEP, fwhm_mm: self.common_width(vessels), ..asked }
    }

    pub(super) fn graded(&mut self, vessels: &[VesselMessage], stop: Stop) -> Result<Vec<GradedVessel>> {
        let numbers = self.all_of(vessels, stop)?;
        let graded = |(vessel, number): (&VesselMessage, usize)| {
            let grade = vessel.marks.marked()?.grade(self.profiles.kept(number));
            Ok(GradedVessel { number, grade })
        };
        vessels.iter().zip(numbers).map(graded).collect()
    }

    pub(super) fn rows<'a>(
        &'a self,
        vessels: &[VesselMessage],
        graded: &'a [GradedVessel],
        is_millimetre_assumed: bool,
    ) -> Vec<Measured<'a>> {
        let suggested = self.content.suggested_names();
        let suggested_name =
            |one: &VesselMessage| suggested.get(&one.line).filter(|_| is_nameless(&one.name))?.name.clone();
        let row = |(vessel, graded): (&VesselMessage, &'a GradedVessel)| Measured {
            id: vessel.id.clone(),
            name: Some(vessel.name.clone()).filter(|name| !name.is_empty()),
            suggested_name: suggested_name(vessel),
            profile: self.profiles.kept(graded.number),
            scan: self.content.scan(),
            grade: graded.grade.as_ref(),
            is_millimetre_assumed,
        };
        vessels.iter().zip(graded).map(row).collect()
    }

    fn all_of(&mut self, vessels: &[VesselMessage], stop: Stop) -> Result<Vec<usize>> {
        let (profiles, content) = (&mut self.profiles, &self.content);
        let of = |one: &VesselMessage| {
            profiles.of(content, one.line, &ProfileParameters { fwhm: profiles.width(one.line), stop })
        };
        vessels.iter().map(of).collect()
    }

    fn common_width(&self, vessels: &[VesselMessage]) -> Option<f64> {
        let first = self.profiles.width(vessels.first()?.line)?;
        vessels.iter().all(|one| self.profiles.width(one.line) == Some(first)).then_some(first)
    }
}

#[cfg(test)]
#[path = "tests/measuring.rs"]
mod tests;
