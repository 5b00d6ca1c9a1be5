//! Profiles of vessels of one scan: each is measured when it is first asked for and kept, all with what their tree tells.

use std::sync::Arc;

use lumencut_core::error::Result;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;
use lumencut_vessels::measure::measuring::{measure_with, tree_findings};
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::request::MeasureRequest;
use lumencut_vessels::measure::tree_findings::TreeFindings;
use lumencut_vessels::measure::wall_level::WallRequest;

/// A volume and the tree in it. Both decide what is measured: profiles that were kept are those of other ones no longer.
#[derive(Clone, Copy)]
pub struct Scan<'a> {
    /// The angiography.
    pub volume: &'a Volume<'a>,
    /// The vessels that tell the point spread, the level of walls and where branches are.
    pub tree: &'a [Vessel],
}

/// How a vessel is asked for.
#[derive(Clone, Copy)]
pub struct Asking<'a> {
    /// The distance of sections (mm), at most.
    pub step: f64,
    /// The width of the point spread (mm), where it is given; without it the tree tells it.
    pub fwhm: Option<f64>,
    /// The level of walls.
    pub wall: WallRequest,
    /// Asked whether to stop.
    pub stop: Stop<'a>,
}

/// The profiles that are kept, by what their host calls a vessel.
pub struct KeptProfiles<K> {
    /// What the tree tells for all of its vessels, by the level of walls and the point spread that were asked for.
    told: Vec<((WallRequest, Option<f64>), TreeFindings)>,
    kept: Vec<Kept<K>>,
}

/// The profile of a vessel, and how it was asked for (mm).
struct Kept<K> {
    of: K,
    step: f64,
    fwhm: Option<f64>,
    wall: WallRequest,
    profile: Arc<Profile>,
}

impl<K> Default for KeptProfiles<K> {
    fn default() -> Self {
        Self { told: Vec::new(), kept: Vec::new() }
    }
}

impl<K: PartialEq> KeptProfiles<K> {
    /// The number among those kept of a vessel's profile, which is measured where it was not asked for like this before.
    ///
    /// # Errors
    /// Those of [`lumencut_vessels::measure::measuring::measure`].
    pub fn of(&mut self, key: K, vessel: &Vessel, scan: Scan, asking: &Asking) -> Result<usize> {
        let Asking { step, fwhm, wall, stop } = *asking;
        let is_asked =
            |kept: &Kept<K>| kept.of == key && kept.step == step && kept.fwhm == fwhm && kept.wall == wall;
        if let Some(found) = self.kept.iter().position(is_asked) {
            return Ok(found);
        }
        let request = MeasureRequest { step, fwhm, wall, tree: scan.tree, stop };
        let told = self.told(scan.volume, &request)?;
        let profile = Arc::new(measure_with(told, scan.volume, vessel, &request)?);
        self.kept.push(Kept { of: key, step, fwhm, wall, profile });
        Ok(self.kept.len() - 1)
    }

    /// The profile of a number that [`KeptProfiles::of`] gave.
    pub fn kept(&self, number: usize) -> &Arc<Profile> {
        &self.kept[number].profile
    }

    /// A profile of a vessel, however it was asked for; none where it was not measured.
    pub fn any_of(&self, key: &K) -> Option<&Profile> {
        self.kept.iter().find(|kept| kept.of == *key).map(|kept| &*kept.profile)
    }

    /// What the tree tells, which is found once.
    fn told(&mut self, volume: &Volume, request: &MeasureRequest) -> Result<TreeFindings> {
        let asked = (request.wall, request.fwhm);
        if let Some((_, told)) = self.told.iter().find(|(other, _)| *other == asked) {
            return Ok(told.clone());
        }
        let told = tree_findings(volume, request)?;
        self.told.push((asked, told.clone()));
        Ok(told)
    }
}

#[cfg(test)]
#[path = "tests/kept_profiles.rs"]
mod tests;
