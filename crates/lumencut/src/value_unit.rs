//! Guesses whether a volume has Hounsfield units and contains metal, if its file does not say.

use lumencut_core::math::statistics::quantile;
use lumencut_core::settings::Window;
use lumencut_core::volume::Volume;
use lumencut_vessels::trace::lumen::surroundings::are_hounsfield;
use lumencut_vessels::voxels::Voxels;

use crate::populations::VoxelSample;

/// The quantile of metal: a stent fills little of a scan.
const METAL_QUANTILE: f64 = 0.9999;
/// Metal is this many times as far above the darkest voxels as the white end of the lumen's window. Ours: 4 in CT with a stent,
/// at most 2.2 in MR and head scans.
const METAL_RATIO: f64 = 3.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ValueUnit {
    /// The values look like Hounsfield units.
    pub(crate) is_hounsfield: bool,
    /// Some values are as far above the lumen as metal.
    pub(crate) has_metal: bool,
}

impl ValueUnit {
    /// Inspects a volume; `lumen` is the window of its lumen.
    pub(crate) fn of(volume: &Volume, lumen: Window) -> Self {
        let mut voxels = VoxelSample::at(volume).voxels;
        voxels.sort_unstable_by(f64::total_cmp);
        let darkest = voxels.first().copied().unwrap_or_default();
        let brightest = quantile(&mut voxels, METAL_QUANTILE).unwrap_or(darkest);
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
