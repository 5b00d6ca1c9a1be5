//! What the values of a volume may stand for, where its file does not say: Hounsfield units, and metal among them.

use lumencut_core::math::statistics::quantile;
use lumencut_core::settings::Window;
use lumencut_core::volume::Volume;
use lumencut_vessels::trace::lumen::surroundings::are_hounsfield;
use lumencut_vessels::voxels::Voxels;

use crate::populations::Looked;

/// Which part of the voxels is darker than metal: a stent fills little of a scan.
const BELOW_METAL: f64 = 0.9999;
/// Metal is so many times as far above the darkest voxels as the white end of the window for the lumen. Ours: in CT with a
/// stent it was 4, in MR and in scans of the head at most 2.2.
const METAL: f64 = 3.0;

/// What the values may stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ValueUnit {
    /// Whether they are Hounsfield units by what they are.
    pub(crate) is_hounsfield: bool,
    /// Whether some are as far above the lumen as metal is.
    pub(crate) has_metal: bool,
}

impl ValueUnit {
    /// Looks at a volume; `lumen` is the window that shows its lumen.
    pub(crate) fn of(volume: &Volume, lumen: Window) -> Self {
        let mut voxels = Looked::at(volume).voxels;
        voxels.sort_unstable_by(f64::total_cmp);
        let darkest = voxels.first().copied().unwrap_or_default();
        let brightest = quantile(&mut voxels, BELOW_METAL).unwrap_or(darkest);
        let white = lumen.level + lumen.width / 2.0 - darkest;
        Self {
            is_hounsfield: are_hounsfield(&Voxels::new(volume)),
            has_metal: white > 0.0 && brightest - darkest >= METAL * white,
        }
    }
}

#[cfg(test)]
#[path = "tests/value_unit.rs"]
mod tests;
