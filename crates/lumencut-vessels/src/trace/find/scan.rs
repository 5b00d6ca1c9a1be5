//! Properties of a scan that are used to assess its vessels.

use glam::DVec3;

use crate::voxels::Voxels;

pub(crate) struct Scan<'v> {
    pub voxels: &'v Voxels<'v>,
    /// Side of the isotropic voxels (mm).
    pub side: f64,
    /// Values below this are raised to it, so that fat, lung and air do not count as contrast.
    pub lowest: f64,
    /// Intensity that vessels usually have, in the unit of the volume.
    pub level: f64,
    /// Contrast that vessels usually have, in the unit of the volume.
    pub contrast: f64,
    pub noise: f64,
    pub is_hounsfield: bool,
}

impl Scan<'_> {
    /// Trilinear value at a position (mm, LPS), at least `lowest`; NaN outside.
    pub(crate) fn value(&self, place: DVec3) -> f64 {
        let value = f64::from(self.voxels.at(place));
        if value < self.lowest { self.lowest } else { value }
    }
}
