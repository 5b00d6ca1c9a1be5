//! Guesses whether the values of a volume are Hounsfield units and whether it contains metal, if its file does not say so.

use lumencut_core::math::statistics::rising_quantile;
use lumencut_core::settings::Window;
use lumencut_core::volume::Volume;
use lumencut_vessels::trace::lumen::surroundings::are_hounsfield;
use lumencut_vessels::voxels::Voxels;

use crate::populations::VoxelSample;

/// The quantile that stands for metal, since a stent fills only a small part of a scan.
const METAL_QUANTILE: f64 = 0.9999;
/// Metal is this many times as far above the darkest voxel as the white end of the lumen's window. Our measurements: 4 in CT with a
/// stent, at most 2.2 in MR and in head scans.
const METAL_RATIO: f64 = 3.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ValueUnit {
    pub(crate) is_hounsfield: bool,
    pub(crate) has_metal: bool,
}

impl ValueUnit {
    /// Examines a volume; `lumen` is the window that shows its lumen.
    pub(crate) fn of(sampled: &VoxelSample, volume: &Volume, lumen: Window) -> Self {
        let darkest = sampled.voxels.first().copied().unwrap_or_default();
        let brightest = rising_quantile(&sampled.voxels, METAL_QUANTILE).unwrap_or(darkest);
        let white = lumen.level + lumen.width / 2.0 - darkest;
        Self {
            is_hounsfield: are_hounsfield(&Voxels::new(volume)),
            has_metal: white > 0.0 && brightest - darkest >= METAL_RATIO * white,
        }
    }
}

#[cfg(test)]
#[path = "tests/value_unit.rs"]
mod tests;
