//! Named windows, and the default window of each context.

use lumencut_core::error::Result;
use lumencut_core::named::Named;
use lumencut_core::settings::{ContextName, Window};
use lumencut_core::vessel_tree::VesselTree;
use lumencut_core::volume::Volume;

use crate::populations::VoxelSample;
use crate::windows;

/// A window that is computed from the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataWindow {
    /// Separates lumen from surroundings: `windows::along` vessels, or `windows::of_volume` if there are none.
    Auto,
    /// For maximum intensity projections, see `windows::of_mip`.
    Mip,
    /// From the 1st to the 99th percentile, see `windows::whole`.
    Whole,
    /// From the smallest to the largest voxel, see `windows::full`.
    Full,
    /// For MR angiography, see `windows::mra`.
    Mra,
}

impl Named for DataWindow {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("auto", Self::Auto),
        ("mip", Self::Mip),
        ("whole", Self::Whole),
        ("full", Self::Full),
        ("mra", Self::Mra),
    ];
}

impl DataWindow {
    /// Computes the window; only [`DataWindow::Auto`] uses the vessels. Fails with
    /// [`ErrorKind::Volume`](lumencut_core::error::ErrorKind::Volume) for values out of range.
    pub fn find(self, volume: &Volume, tree: Option<&VesselTree>) -> Result<Window> {
        self.find_in(&VoxelSample::at(volume), volume, tree)
    }

    /// As [`DataWindow::find`], with the sample of the volume.
    pub(crate) fn find_in(
        self,
        sampled: &VoxelSample,
        volume: &Volume,
        tree: Option<&VesselTree>,
    ) -> Result<Window> {
        match (self, tree) {
            (Self::Auto, Some(tree)) => windows::along(sampled, volume, tree),
            (Self::Auto, None) => windows::of_volume(sampled),
            (Self::Mip, _) => windows::of_mip(sampled),
            (Self::Whole, _) => windows::whole(sampled),
            (Self::Full, _) => windows::full(volume),
            (Self::Mra, _) => windows::mra(sampled),
        }
    }

    /// The default window of a context.
    pub fn of_context(context: ContextName, has_tree: bool) -> Self {
        match context {
            ContextName::Mip if !has_tree => Self::Mip,
            // Pictures of minima and means along rays are much darker than the vessels.
            ContextName::Minip | ContextName::Average => Self::Whole,
            ContextName::Mida | ContextName::Dvr | ContextName::Mip => Self::Auto,
        }
    }
}

/// The source of a named window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PresetSource {
    /// Constant (HU).
    Fixed(Window),
    /// Computed from the data.
    Data(DataWindow),
}

/// A named window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowPreset {
    /// Name of the window in Python, in files and on the command line.
    pub name: &'static str,
    /// Label of the window.
    pub words: &'static str,
    /// The source of the window.
    pub source: PresetSource,
}

const fn fixed(name: &'static str, words: &'static str, level: f64, width: f64) -> WindowPreset {
    WindowPreset { name, words, source: PresetSource::Fixed(Window { level, width }) }
}

const fn from_data(name: &'static str, words: &'static str, window: DataWindow) -> WindowPreset {
    WindowPreset { name, words, source: PresetSource::Data(window) }
}

/// The named windows in display order; bone and lung have the values of the OHIF viewer.
pub const WINDOW_PRESETS: [WindowPreset; 9] = [
    from_data("auto", "From the data", DataWindow::Auto),
    fixed("cta", "CT angiography", 300.0, 900.0),
    fixed("soft-tissue", "Soft tissue", 40.0, 400.0),
    fixed("bone", "Bone", 480.0, 2500.0),
    fixed("lung", "Lung", -600.0, 1500.0),
    from_data("full", "All values", DataWindow::Full),
    from_data("mra", "MR angiography", DataWindow::Mra),
    // This window separates the struts of a stent from the lumen inside.
    fixed("stent", "Stent", 400.0, 1500.0),
    fixed("sac", "Aneurysm sac", 150.0, 600.0),
];

#[cfg(test)]
#[path = "tests/window_presets.rs"]
mod tests;
