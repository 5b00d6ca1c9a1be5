//! A cache of the measured profiles of one scan, and of the tree-wide estimates that they share.

use std::sync::Arc;

use lumencut_core::error::Result;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::TreeFindings;
use lumencut_vessels::measure::profile::measuring::{measure_with, tree_findings};
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::wall::WallRequest;

/// A volume and its tree. A cache is valid for only one such pair.
#[derive(Clone, Copy)]
pub struct Scan<'a> {
    /// The angiography.
    pub volume: &'a Volume<'a>,
    /// The vessels from which point spread, wall level and branches are determined.
    pub tree: &'a [Vessel],
}

/// Parameters of a measurement.
#[derive(Clone, Copy)]
pub struct MeasureParameters<'a> {
    /// The largest distance between sections (mm).
    pub step: f64,
    /// The width of the point spread (mm); None estimates it from the tree.
    pub fwhm: Option<f64>,
    /// The wall level.
    pub wall: WallRequest,
    /// Called during the work to ask whether to stop.
    pub stop: Stop<'a>,
}

/// The cached profiles, by the key that the caller uses for a vessel.
pub struct KeptProfiles<K> {
    /// Tree-wide estimates, each with the requested wall level and point-spread width.
    estimates: Vec<((WallRequest, Option<f64>), TreeFindings)>,
    kept: Vec<Kept<K>>,
}

/// A cached profile, and the parameters with which it was measured (mm).
struct Kept<K> {
    of: K,
    step: f64,
    fwhm: Option<f64>,
    wall: WallRequest,
    profile: Arc<Profile>,
}

impl<K> Default for KeptProfiles<K> {
    fn default() -> Self {
        Self { estimates: Vec::new(), kept: Vec::new() }
    }
}

impl<K: PartialEq> KeptProfiles<K> {
    /// The index of a vessel's profile in the cache. The vessel is measured if it was not yet measured with these parameters.
    pub fn of(
        &mut self,
        key: K,
        vessel: &Vessel,
        scan: Scan,
        parameters: &MeasureParameters,
    ) -> Result<usize> {
        let MeasureParameters { step, fwhm, wall, stop } = *parameters;
        let is_asked =
            |kept: &Kept<K>| kept.of == key && kept.step == step && kept.fwhm == fwhm && kept.wall == wall;
        if let Some(found) = self.kept.iter().position(is_asked) {
            return Ok(found);
        }
        let request = MeasureRequest { step, fwhm, wall, tree: scan.tree, stop };
        let estimates = self.estimates(scan.volume, &request)?;
        let profile = Arc::new(measure_with(estimates, scan.volume, vessel, &request)?);
        self.kept.push(Kept { of: key, step, fwhm, wall, profile });
        Ok(self.kept.len() - 1)
    }

    /// The profile at an index from [`KeptProfiles::of`].
    pub fn kept(&self, number: usize) -> &Arc<Profile> {
        &self.kept[number].profile
    }

    pub(crate) fn any_of(&self, key: &K) -> Option<&Profile> {
        self.kept.iter().find(|kept| kept.of == *key).map(|kept| &*kept.profile)
    }

    /// The index of the profile of a key that was cached last.
    pub(crate) fn last_of(&self, key: &K) -> Option<usize> {
        self.kept.iter().rposition(|kept| kept.of == *key)
    }

    fn estimates(&mut self, volume: &Volume, request: &MeasureRequest) -> Result<TreeFindings> {
        let asked = (request.wall, request.fwhm);
        if let Some((_, estimates)) = self.estimates.iter().find(|(other, _)| *other == asked) {
            return Ok(estimates.clone());
        }
        let estimates = tree_findings(volume, request)?;
        self.estimates.push((asked, estimates.clone()));
        Ok(estimates)
    }
}

#[cfg(test)]
#[path = "tests/kept_profiles.rs"]
mod tests;
