//! Measuring the lines that are shown, as `lumencut.measure(volume, vessel, 0.5, fwhm, tree=tree)` of Python does.

use crate::profile_record::{Asked, Measured, vessels_json};
use crate::profile_table::{Labelled, csv_text};
use lumencut_core::stop::Stop;
use lumencut_vessels::measure::measuring::STEP;
use lumencut_vessels::measure::profile::Profile;

use crate::study::failure::Result;
use crate::study::measure_messages::{Graded, VesselMessage};
use crate::study::open_study::Study;
use crate::study::profiles::{Asking, Profiles};

impl Study {
    /// The profile of a line that is shown, under a point spread of this width (mm), or under the one that the tree tells.
    ///
    /// # Errors
    /// `vessel tree` for a line that is not shown, `volume` where none is open, and those of measuring.
    pub fn profile(&mut self, line: usize, fwhm: Option<f64>, stop: Stop) -> Result<&Profile> {
        let found = self.profiles.of(&self.content, line, &Asking { fwhm, stop })?;
        self.profiles.ask_with(line, fwhm);
        Ok(self.profiles.kept(found))
    }

    /// The profile of a line that is shown, as it was asked for last.
    ///
    /// # Errors
    /// As [`Study::profile`].
    pub fn measured(&mut self, line: usize, stop: Stop) -> Result<&Profile> {
        self.profile(line, self.profiles.width(line), stop)
    }

    /// Forgets what was measured.
    pub fn forget_profiles(&mut self) {
        self.profiles = Profiles::default();
    }

    /// Sections of vessels as `lumencut measure -o x.csv` writes them.
    ///
    /// # Errors
    /// As [`Study::profile`].
    pub fn profiles_csv(&mut self, vessels: &[VesselMessage], stop: Stop) -> Result<String> {
        let found = self.all_of(vessels, stop)?;
        let rows = vessels.iter().zip(found).map(|(vessel, n)| {
            let labels = [("vessel", &vessel.id), ("name", &vessel.name)];
            let labels = labels.map(|(name, value)| (name.to_owned(), value.clone())).to_vec();
            Labelled { labels, profile: self.profiles.kept(n) }
        });
        Ok(csv_text(&rows.collect::<Vec<_>>()))
    }

    /// Vessels as `lumencut measure -o x.json` writes them. What was marked stands among the settings where it is one vessel, as
    /// there; each vessel has its stenosis.
    ///
    /// # Errors
    /// As [`Study::profile`], and those of places that cannot be graded.
    pub fn profiles_json(&mut self, vessels: &[VesselMessage], stop: Stop) -> Result<String> {
        let found = self.all_of(vessels, stop)?;
        let profiles: Vec<&Profile> = found.into_iter().map(|n| self.profiles.kept(n)).collect();
        let graded = vessels.iter().zip(&profiles).map(|(vessel, profile)| vessel.marks.graded(profile));
        let graded: Vec<Option<Graded>> = graded.collect::<Result<_>>()?;
        let rows = vessels.iter().zip(profiles).zip(&graded).map(|((vessel, profile), graded)| Measured {
            id: vessel.id.clone(),
            name: Some(vessel.name.clone()).filter(|name| !name.is_empty()),
            profile,
            stenosis: graded.as_ref().map(|graded| &graded.stenosis),
            group: graded.as_ref().and_then(|graded| graded.group.clone()),
        });
        let asked = match (vessels, &graded[..]) {
            ([one], [graded]) => one.marks.asked(graded.is_some()),
            _ => Asked::default(),
        };
        let asked = Asked { step_mm: STEP, fwhm_mm: self.common_width(vessels), ..asked };
        Ok(vessels_json(&asked, &rows.collect::<Vec<_>>()))
    }

    fn all_of(&mut self, vessels: &[VesselMessage], stop: Stop) -> Result<Vec<usize>> {
        let (profiles, content) = (&mut self.profiles, &self.content);
        let of = |one: &VesselMessage| {
            profiles.of(content, one.line, &Asking { fwhm: profiles.width(one.line), stop })
        };
        vessels.iter().map(of).collect()
    }

    /// The width that was given for all of these vessels, where it is one.
    fn common_width(&self, vessels: &[VesselMessage]) -> Option<f64> {
        let first = self.profiles.width(vessels.first()?.line)?;
        vessels.iter().all(|one| self.profiles.width(one.line) == Some(first)).then_some(first)
    }
}

#[cfg(test)]
#[path = "tests/measuring.rs"]
mod tests;
