//! The straightened CPR of one vessel, and the way between its pixels and the world.

use crate::feature_aggregation::Feature;
use glam::{DVec2, DVec3};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::{Cpr, CprMode, View};
use lumencut_core::vessel_tree::Vessel;
use serde::Deserialize;

use crate::study::failure::Result;

/// A CPR as the page asks for it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Cpr"))]
pub struct CprMessage {
    /// The vessel's number.
    pub vessel: usize,
    /// The rotation about its axis (radians).
    pub angle: f64,
    /// The width of the picture (mm).
    pub width: f64,
    /// The side of a pixel (mm).
    pub pixel_spacing: f64,
    /// Which value of a half circle a pixel shows, by CFA; without one its own.
    #[serde(default)]
    pub feature: Option<Aggregated>,
}

/// The features of CFA by their names.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Feature"))]
pub enum Aggregated {
    /// The largest value.
    Max,
    /// The mean.
    Mean,
    /// The smallest value.
    Min,
}

impl From<Aggregated> for Feature {
    fn from(feature: Aggregated) -> Self {
        match feature {
            Aggregated::Max => Self::Max,
            Aggregated::Mean => Self::Mean,
            Aggregated::Min => Self::Min,
        }
    }
}

/// The layout of the vessel that was straightened last.
#[derive(Clone)]
pub struct Laid {
    /// What was asked for.
    pub message: CprMessage,
    /// From pixels to the world and back.
    pub cpr: Cpr,
}

impl Laid {
    /// The layout that is asked for; that of `before` turned, where it is of the same vessel.
    ///
    /// # Errors
    /// `camera` for an invalid angle, width or spacing.
    pub fn new(message: CprMessage, vessel: &Vessel, before: Option<&Self>) -> Result<Self> {
        let same = |laid: &&Self| {
            CprMessage { angle: message.angle, feature: message.feature, ..laid.message } == message
        };
        if let Some(laid) = before.filter(same) {
            return Ok(Self { message, cpr: laid.cpr.rotated(message.angle)? });
        }
        let view = View { up: DVec3::Z, angle: message.angle, normal: None };
        let path = CenterlinePath::new(vessel, 0.0)?;
        let cpr = Cpr::new(path, CprMode::Straightened, view, Some(message.width), message.pixel_spacing)?;
        Ok(Self { message, cpr })
    }

    /// The world point at a place in the picture, column and row.
    pub fn world(&self, pixel: [f64; 2]) -> [f64; 3] {
        self.cpr.world_from_pixel(DVec2::from_array(pixel)).to_array()
    }

    /// The column and row of a world point.
    pub fn pixel(&self, point: [f64; 3]) -> [f64; 2] {
        self.cpr.pixel_from_world(DVec3::from_array(point)).to_array()
    }

    /// The arc length (mm) of a row.
    pub fn arc_length(&self, row: f64) -> f64 {
        row * self.message.pixel_spacing
    }
}
