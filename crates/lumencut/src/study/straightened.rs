//! The straightened CPR of one vessel, and the way between its pixels and the world.

use crate::feature_aggregation::Feature;
use glam::{DVec2, DVec3};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::{Cpr, CprMode, Roll, Side, View};
use lumencut_core::vessel_tree::Vessel;
use serde::Deserialize;

use crate::study::failure::Result;

/// A CPR as the page asks for it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Cpr"))]
pub(crate) struct CprMessage {
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
    pub(crate) feature: Option<Aggregated>,
    /// Which side of the lumen each row follows; without one all rows have the same angle.
    #[serde(default)]
    pub(crate) roll: Option<Followed>,
}

/// The sides that a roll follows, by their names.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Roll"))]
pub(crate) enum Followed {
    /// The narrowest one.
    Narrowest,
    /// The widest one.
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

/// The features of CFA by their names.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Feature"))]
pub(crate) enum Aggregated {
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
pub(crate) struct Laid {
    /// What was asked for.
    pub message: CprMessage,
    /// From pixels to the world and back.
    pub(crate) cpr: Cpr,
}

impl Laid {
    /// The layout that is asked for; that of `before` turned, where [`Laid::is_turned`] says so.
    ///
    /// # Errors
    /// `camera` for an invalid angle, width or spacing.
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

    /// The same with rows that follow a roll.
    ///
    /// # Errors
    /// As [`Cpr::rolled`].
    pub(crate) fn rolled(self, roll: Roll) -> Result<Self> {
        Ok(Self { cpr: self.cpr.rolled(roll)?, ..self })
    }

    /// Whether a message asks for this layout, but for the angle and what a pixel shows.
    pub(crate) fn is_turned(&self, message: &CprMessage) -> bool {
        CprMessage { angle: message.angle, feature: message.feature, ..self.message } == *message
    }

    /// The world point at a place in the picture, column and row.
    pub(crate) fn world(&self, pixel: [f64; 2]) -> [f64; 3] {
        self.cpr.world_from_pixel(DVec2::from_array(pixel)).to_array()
    }

    /// The column and row of a world point.
    pub(crate) fn pixel(&self, point: [f64; 3]) -> [f64; 2] {
        self.cpr.pixel_from_world(DVec3::from_array(point)).to_array()
    }

    /// The arc length (mm) of a row.
    pub(crate) fn arc_length(&self, row: f64) -> f64 {
        row * self.message.pixel_spacing
    }
}
