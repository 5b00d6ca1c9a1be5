//! Reformations other than the straightened CPR: how the page requests them, their layout in a pane, and the last one
//! that a study rendered.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::View;
use lumencut_core::reformations::endoscopy::Endoscopy;
use lumencut_core::reformations::lumen_map::LumenMap;
use lumencut_core::reformations::spiral::{Sampling, Spiral, SpiralParameters};
use lumencut_core::reformations::uncurl::Uncurl;
use lumencut_core::reformations::untangled::{Untangled, UntangledParameters};
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::Volume;
use lumencut_vessels::measure::section::known_radius;
use serde::{Deserialize, Serialize};

use crate::axes_words::Axes;
use crate::defaults::{BAND_END, BAND_START, PIXEL_SIDES};
use crate::endoscopy::Inside;
use crate::lumen_map::{MapRequest, lumen_map};
use crate::lumen_wall::FoundWall;
use crate::spiral_lengths::{Room, spiral_pitch, spiral_reach};
use crate::study::failure::{Failure, Result};
use crate::views::fitted_uncurling;

/// The range of distances beyond the wall that a map samples (mm).
pub(crate) const BAND: [f64; 2] = [BAND_START.default, BAND_END.default];

#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Side {
    direction: [f64; 3],
    up: [f64; 3],
}

impl Side {
    fn camera(&self, size: [usize; 2]) -> Result<Camera> {
        let [direction, up] = [self.direction, self.up].map(DVec3::from_array);
        Ok(Camera::new(DVec3::ZERO, direction, up, size, 1.0)?)
    }
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) enum MapOf {
    Wall,
    Radius,
    /// The thickness of calcium or metal at the wall.
    Thickness,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(tag = "kind", rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Reformation"))]
pub(crate) enum ReformationMessage {
    Untangled {
        side: Side,
    },
    /// The untangled tree as lines, coloured by diameter.
    Network {
        side: Side,
    },
    Uncurl {
        vessel: usize,
        side: Side,
        /// How far the vessel is straightened, from 0 (as seen) to 1 (straight).
        amount: f64,
    },
    /// One vessel, its sections unrolled along a spiral.
    Spiral {
        vessel: usize,
        /// The rotation of sections (radians).
        angle: f64,
    },
    Map {
        vessel: usize,
        of: MapOf,
    },
    /// The inside of a vessel, from a place on it.
    Endoscopy {
        vessel: usize,
        /// Arc length (mm).
        at: f64,
        lens: LensOf,
        /// Whether the eye looks towards the start of the vessel.
        backwards: bool,
    },
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) enum LensOf {
    Perspective,
    Fisheye,
}

impl ReformationMessage {
    pub(crate) fn vessel(&self) -> Option<usize> {
        match self {
            Self::Untangled { .. } | Self::Network { .. } => None,
            Self::Uncurl { vessel, .. }
            | Self::Spiral { vessel, .. }
            | Self::Map { vessel, .. }
            | Self::Endoscopy { vessel, .. } => Some(*vessel),
        }
    }
}

pub(crate) enum Laid {
    Untangled(Untangled),
    Uncurl(Uncurl, f64),
    Spiral(Spiral),
    /// A map, and the lowest value that counts as calcium or metal in it.
    Map(LumenMap, Option<f64>),
    /// A view from inside, and what all views of the vessel share.
    Endoscopy(Endoscopy, Arc<Inside>),
}

impl Laid {
    pub(crate) fn layout(&self) -> &dyn Layout {
        match self {
            Self::Untangled(layout) => layout,
            Self::Uncurl(layout, _) => layout,
            Self::Spiral(layout) => layout,
            Self::Map(layout, _) => layout,
            Self::Endoscopy(layout, _) => layout,
        }
    }

    pub(super) fn axes(&self) -> Axes {
        match self {
            Self::Untangled(_) => Axes::Untangled,
            Self::Uncurl(_, amount) => Axes::Uncurled(*amount),
            Self::Spiral(layout) => Axes::SpiralByArc(layout.parameters().pitch),
            Self::Map(layout, _) => Axes::Map(layout.parameters().mean_radius),
            Self::Endoscopy(layout, _) => Axes::Inside(layout.eye().at),
        }
    }

    /// The arc length at a position (mm), if the row of the position shows a single place along a vessel.
    pub(super) fn arc_length(&self, [_, row]: [f64; 2]) -> Option<f64> {
        match self {
            Self::Untangled(_) | Self::Uncurl(..) | Self::Endoscopy(..) => None,
            Self::Spiral(_) | Self::Map(..) => Some(row * self.layout().pixel_spacing()),
        }
    }
}

/// All vessels untangled, fitted into a pane. If only the pixels differ, the layout `before` is used again.
pub(crate) fn untangled(
    tree: &VesselTree,
    side: &Side,
    size: [usize; 2],
    (before, stop): (Option<&Untangled>, Stop),
) -> Result<Untangled> {
    let found = match before {
        Some(found) => found.clone(),
        None => Untangled::new(tree, &side.camera(size)?, UntangledParameters::new(1.0), stop)?,
    };
    Ok(found.with_pixels(filling(found.extent(), size))?)
}

pub(crate) fn uncurl(vessel: &Vessel, side: &Side, amount: f64, size: [usize; 2]) -> Result<Uncurl> {
    let camera = fitted_uncurling(&side.camera(size)?, vessel, 0.0)?;
    let path = Arc::new(CenterlinePath::new(vessel, 0.0)?);
    Ok(Uncurl::new(path, camera, amount, None)?)
}

/// A spiral CPR with the finest pitch that fits the width of the pane; `smallest_side` is that of a voxel (mm).
pub(crate) fn spiral(vessel: &Vessel, angle: f64, smallest_side: f64, size: [usize; 2]) -> Result<Spiral> {
    let no_radii = || Failure::from(crate::lumen_wall::no_radius());
    let usual = known_radius(vessel).ok_or_else(no_radii)?;
    let largest = vessel.radius().unwrap_or_default().iter().copied().fold(usual, f64::max);
    let path = Arc::new(CenterlinePath::new(vessel, 0.0)?);
    let pixel_spacing = filling(DVec2::new(0.0, path.length()), size);
    let radius = spiral_reach(largest);
    let room = Room { radius, pixel_spacing, columns: size[0] as f64 };
    let mut pitch = spiral_pitch(usual, smallest_side, room);
    loop {
        let parameters = SpiralParameters { pitch, radius, sampling: Sampling::Arc, pixel_spacing, angle };
        let made = Spiral::new(Arc::clone(&path), &head_up(), parameters)?;
        let width = made.size()[0];
        // Windings are slightly longer than section area / pitch, so the pitch may have to grow.
        if width <= size[0].max(1) {
            return Ok(made);
        }
        pitch *= 1.01 * width as f64 / size[0] as f64;
    }
}

pub(super) fn map(
    volume: &Volume,
    (path, found): (&Arc<CenterlinePath>, &FoundWall),
    (of, size): (MapOf, [usize; 2]),
    stop: Stop,
) -> Result<LumenMap> {
    let around = TAU * found.mean_radius;
    let request = MapRequest {
        pixel_spacing: filling(DVec2::new(around, path.length()), size),
        angle: None,
        overlap: 0.0,
        band: band_of(of),
        calcium_level: None,
    };
    Ok(lumen_map(volume, path, &head_up(), found, (&request, stop))?)
}

/// The range of distances beyond the wall that is sampled (mm): only the wall if the map shows its radius.
pub(crate) fn band_of(of: MapOf) -> [f64; 2] {
    if of == MapOf::Radius { [0.0; 2] } else { BAND }
}

pub(crate) fn head_up() -> View {
    View { up: DVec3::Z, angle: 0.0, normal: None }
}

/// The pixel side (mm) at which an extent (mm) just fits a pane.
fn filling(extent: DVec2, size: [usize; 2]) -> f64 {
    let [width, height] = size.map(|side| side.saturating_sub(2).max(1) as f64);
    (extent.x / width).max(extent.y / height).max(PIXEL_SIDES[0])
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ReformedPicture {
    /// Columns and rows.
    pub size: [usize; 2],
    /// One byte per channel.
    #[cfg_attr(test, ts(type = "Bytes"))]
    pub bytes: Vec<u8>,
    /// What rows, columns and colours mean.
    pub words: String,
    /// Pixel side (mm).
    pub pixel_spacing: f64,
    pub(crate) marks: Vec<Mark>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Mark {
    pub words: String,
    pub pixel: [f64; 2],
}

pub(crate) struct Reformed {
    pub(super) message: ReformationMessage,
    pub(super) size: [usize; 2],
    pub(super) laid: Laid,
    /// The value of each pixel: a value of the volume, or a length (mm); NaN if the pixel is empty.
    pub(super) value: Vec<f32>,
}
