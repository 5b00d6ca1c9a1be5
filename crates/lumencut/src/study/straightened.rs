//! The straightened CPR of a vessel: its layout, and conversions between its pixels and the world.

use crate::feature_aggregation::Feature;
use glam::{DVec2, DVec3};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::{Cpr, CprMode, Roll, Side, View};
use lumencut_core::vessel_tree::Vessel;
use serde::Deserialize;

use crate::study::failure::Result;

#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Cpr"))]
pub(crate) struct CprMessage {
    pub vessel: usize,
    /// Rotation about the axis of the vessel (radians).
    pub angle: f64,
    /// Width of the picture (mm).
    pub width: f64,
    /// Pixel side (mm).
    pub pixel_spacing: f64,
    /// The CFA feature of a half circle; none to show the values of the scan.
    #[serde(default)]
    pub(crate) feature: Option<Aggregated>,
    /// The side of the lumen that rows follow; none for a constant angle.
    #[serde(default)]
    pub(crate) roll: Option<Followed>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Roll"))]
pub(crate) enum Followed {
    Narrowest,
    Widest,
}

impl From<Followed> for Side {
    fn from(followed: Followed) -> Self {
        match followed {
            Followed::Narrowest => Self::Narrowest,
            Followed::Widest => Self::Widest,
        }
    }
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Feature"))]
pub(crate) enum Aggregated {
    Max,
    Mean,
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

#[derive(Clone)]
pub(crate) struct Laid {
    pub message: CprMessage,
    pub(crate) cpr: Cpr,
}

impl Laid {
    /// The requested layout; `before` is used again if only angle and feature differ.
    pub(crate) fn new(message: CprMessage, vessel: &Vessel, before: Option<&Self>) -> Result<Self> {
        if let Some(laid) = before.filter(|laid| laid.is_turned(&message)) {
            let is_rolled = message.roll.is_some();
            let cpr = if is_rolled { laid.cpr.clone() } else { laid.cpr.rotated(message.angle)? };
            return Ok(Self { message, cpr });
        }
        let view = View { up: DVec3::Z, angle: message.angle, normal: None };
        let path = CenterlinePath::new(vessel, 0.0)?;
        let cpr = Cpr::new(path, CprMode::Straightened, view, Some(message.width), message.pixel_spacing)?;
        Ok(Self { message, cpr })
    }

    pub(crate) fn rolled(self, roll: Roll) -> Result<Self> {
        Ok(Self { cpr: self.cpr.rolled(roll)?, ..self })
    }

    pub(crate) fn is_turned(&self, message: &CprMessage) -> bool {
        CprMessage { angle: message.angle, feature: message.feature, ..self.message } == *message
    }

    pub(crate) fn world(&self, pixel: [f64; 2]) -> [f64; 3] {
        self.cpr.world_from_pixel(DVec2::from_array(pixel)).to_array()
    }

    pub(crate) fn pixel(&self, point: [f64; 3]) -> [f64; 2] {
        self.cpr.pixel_from_world(DVec3::from_array(point)).to_array()
    }

    /// The arc length (mm) that a row shows.
    pub(crate) fn arc_length(&self, row: f64) -> f64 {
        row * self.message.pixel_spacing
    }
}
