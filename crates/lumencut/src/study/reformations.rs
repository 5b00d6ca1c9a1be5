//! Reformations of the study other than the straightened CPR, as the page asks for them, and how each is laid out in a pane.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::View;
use lumencut_core::reformations::lumen_map::LumenMap;
use lumencut_core::reformations::spiral::{Sampling, Spiral, SpiralParameters};
use lumencut_core::reformations::uncurl::Uncurl;
use lumencut_core::reformations::untangled::{Untangled, UntangledParameters};
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::Volume;
use lumencut_vessels::measure::section_plane::known_radius;
use serde::Deserialize;

use crate::axes_words::Axes;
use crate::lumen_map::{MapRequest, lumen_map};
use crate::lumen_wall::FoundWall;
use crate::spiral_lengths::{Room, spiral_pitch, spiral_reach};
use crate::study::failure::{Failure, Result};
use crate::uncurling::fitted_uncurling;

/// The smallest side of a pixel that a pane is filled with (mm).
const FINEST: f64 = 0.05;

/// From where to where beyond the wall a map looks (mm).
pub const BAND: [f64; 2] = [-1.0, 3.0];

/// From where a view is taken that a reformation begins with.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Side {
    /// From the viewer into the scene.
    direction: [f64; 3],
    /// Upwards.
    up: [f64; 3],
}

impl Side {
    fn camera(&self, size: [usize; 2]) -> Result<Camera> {
        let [direction, up] = [self.direction, self.up].map(DVec3::from_array);
        Ok(Camera::new(DVec3::ZERO, direction, up, size, 1.0)?)
    }
}

/// What a lumen map shows.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub enum MapOf {
    /// The brightest that lies at the wall.
    Wall,
    /// How far the wall is from the middle.
    Radius,
    /// How thick calcium or metal lies at the wall.
    Thickness,
}

/// A reformation as the page asks for it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(tag = "kind", rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Reformation"))]
pub enum ReformationMessage {
    /// All vessels that are shown, none before another.
    Untangled {
        /// From where they are seen.
        side: Side,
    },
    /// One vessel, straightened by degrees.
    Uncurl {
        /// Its number.
        vessel: usize,
        /// From where it is seen.
        side: Side,
        /// From 0, as it is seen, to 1, straightened.
        amount: f64,
    },
    /// One vessel, its sections wound up.
    Spiral {
        /// Its number.
        vessel: usize,
        /// The angle by which sections are turned (radians).
        angle: f64,
    },
    /// The wall of one vessel, unrolled.
    Map {
        /// Its number.
        vessel: usize,
        /// What of the wall.
        of: MapOf,
    },
}

impl ReformationMessage {
    /// The vessel that it is about; none where it is about all.
    pub fn vessel(&self) -> Option<usize> {
        match self {
            Self::Untangled { .. } => None,
            Self::Uncurl { vessel, .. } | Self::Spiral { vessel, .. } | Self::Map { vessel, .. } => {
                Some(*vessel)
            }
        }
    }
}

/// A reformation that is laid out in a pane.
pub enum Laid {
    /// All vessels.
    Untangled(Untangled),
    /// A vessel, and how far it is straightened.
    Uncurl(Uncurl, f64),
    /// A vessel wound up.
    Spiral(Spiral),
    /// A wall, and the level from which on something in it is calcium or metal.
    Map(LumenMap, Option<f64>),
}

impl Laid {
    /// Where its pixels look.
    pub fn layout(&self) -> &dyn Layout {
        match self {
            Self::Untangled(layout) => layout,
            Self::Uncurl(layout, _) => layout,
            Self::Spiral(layout) => layout,
            Self::Map(layout, _) => layout,
        }
    }

    /// What its rows and columns are.
    pub fn axes(&self) -> Axes {
        match self {
            Self::Untangled(_) => Axes::Untangled,
            Self::Uncurl(_, amount) => Axes::Uncurled(*amount),
            Self::Spiral(layout) => Axes::SpiralByArc(layout.parameters().pitch),
            Self::Map(layout, _) => Axes::Map(layout.parameters().mean_radius),
        }
    }

    /// How far along its vessel a place in the picture is (mm), where rows run along one.
    pub fn arc_length(&self, [_, row]: [f64; 2]) -> Option<f64> {
        match self {
            Self::Untangled(_) | Self::Uncurl(..) => None,
            Self::Spiral(_) | Self::Map(..) => Some(row * self.layout().pixel_spacing()),
        }
    }
}

/// All vessels in a pane, untangled; `before` in other pixels, where it is the same.
///
/// # Errors
/// Those of [`Untangled::new`].
pub fn untangled(
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

/// A vessel in a pane, straightened by an amount.
///
/// # Errors
/// Those of [`Uncurl::new`].
pub fn uncurl(vessel: &Vessel, side: &Side, amount: f64, size: [usize; 2]) -> Result<Uncurl> {
    let camera = fitted_uncurling(&side.camera(size)?, vessel, 0.0)?;
    let path = Arc::new(CenterlinePath::new(vessel, 0.0)?);
    Ok(Uncurl::new(path, camera, amount, None)?)
}

/// A vessel in a pane, its sections wound up as finely as the pane is wide; `smallest_side` is that of a voxel (mm).
///
/// # Errors
/// `vessel tree` for a vessel without radii, and those of [`Spiral::new`].
pub fn spiral(vessel: &Vessel, angle: f64, smallest_side: f64, size: [usize; 2]) -> Result<Spiral> {
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
        // Windings are a little longer than their area says.
        if width <= size[0].max(1) {
            return Ok(made);
        }
        pitch *= 1.01 * width as f64 / size[0] as f64;
    }
}

/// The wall of a vessel that was found, unrolled in a pane.
///
/// # Errors
/// Those of [`LumenMap::new`].
pub fn map(
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

/// Where the pixels of a map look beyond the wall (mm): about the wall itself where its radius is shown.
pub fn band_of(of: MapOf) -> [f64; 2] {
    if of == MapOf::Radius { [0.0; 2] } else { BAND }
}

/// How straightened vessels are seen: the head is up.
pub fn head_up() -> View {
    View { up: DVec3::Z, angle: 0.0, normal: None }
}

/// The side of the pixels (mm) in which an extent (mm) fits into a pane.
fn filling(extent: DVec2, size: [usize; 2]) -> f64 {
    let [width, height] = size.map(|side| side.saturating_sub(2).max(1) as f64);
    (extent.x / width).max(extent.y / height).max(FINEST)
}
