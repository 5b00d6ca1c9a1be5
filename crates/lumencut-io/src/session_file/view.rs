//! The view of a scan in a session file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::Point;

/// The view of a scan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedView"))]
#[serde(deny_unknown_fields)]
pub struct View {
    /// Camera of the 3D view.
    pub camera: Camera,
    /// Reformation: `csr`, `csr-paper`, `mpcpr` or `cr`.
    pub method: String,
    /// Values of settings that differ from the default, by name; a window is level and width.
    #[cfg_attr(feature = "types", ts(type = "Settings"))]
    pub settings: BTreeMap<String, Value>,
    /// Layout of the page.
    pub layout: String,
    /// Position of the cross-hair, if it is shown.
    pub cross_hair: Option<Point>,
    /// The vessel that is shown straightened, and the place whose cross-section is shown.
    pub picked: Option<Picked>,
    /// The planes of the slices, if they were turned or are thick; exist since version 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "types", ts(optional))]
    pub slices: Option<Slices>,
}

/// The planes of the slices; all go through the cross-hair.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct Slices {
    /// The plane that is axial at first.
    pub axial: SliceAxes,
    /// The plane that is coronal at first.
    pub coronal: SliceAxes,
    /// The plane that is sagittal at first.
    pub sagittal: SliceAxes,
    /// Thickness (mm) and mode of a slab centred on each plane: `max`, `mean` or `min`.
    pub slab: Option<(f64, String)>,
}

/// Unit vectors of a slice, to the right and down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct SliceAxes {
    /// To the right in the slice.
    pub right: Point,
    /// Down in the slice.
    pub down: Point,
}

/// A place on a vessel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedPlace"))]
#[serde(deny_unknown_fields)]
pub struct Picked {
    /// Number of the vessel, from 0.
    pub vessel: usize,
    /// Arc length (mm).
    pub at_mm: f64,
}

/// An orthographic camera; its axes are unit vectors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedCamera"))]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// Centre of the image.
    pub center: Point,
    /// Direction from the viewer into the scene.
    pub direction: Point,
    /// Direction that is up in the image.
    pub up: Point,
    /// Number of columns and rows.
    pub size: [usize; 2],
    /// Side of a pixel (mm).
    pub pixel_spacing: f64,
}
