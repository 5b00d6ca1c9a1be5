//! What is known of a scan before its vessels are judged: its voxels, the level and contrast of its vessels, its noise.

use glam::DVec3;

use crate::voxels::Voxels;

/// A scan whose vessels are being found.
pub(crate) struct Scan<'v> {
    /// Its voxels, in their own grid and unit.
    pub voxels: &'v Voxels<'v>,
    /// The side of the isotropic voxels in which tubes are found (mm).
    pub side: f64,
    /// Values below count as this one: fat, lung and air add nothing to a contrast.
    pub lowest: f64,
    /// The usual level of its vessels, in the unit of the volume.
    pub level: f64,
    /// How far that lies above their surroundings.
    pub contrast: f64,
    /// The standard deviation of the noise.
    pub noise: f64,
    /// Whether its values are Hounsfield units, as those of a CT with air around or in the patient are.
    pub is_hounsfield: bool,
}

impl Scan<'_> {
    /// The value at a place (mm, LPS), trilinear, not below `lowest`; NaN outside.
    pub(crate) fn value(&self, place: DVec3) -> f64 {
        let value = f64::from(self.voxels.at(place));
        if value < self.lowest { self.lowest } else { value }
    }
}
