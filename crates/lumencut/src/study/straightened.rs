//! The straightened CPR of one vessel, and the way between its pixels and the world.

use crate::feature_aggregation::{Feature, feature_aggregation};
use glam::{DVec2, DVec3};
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::math::path::Path;
use lumencut_core::pipeline::{self, Request};
use lumencut_core::reformations::cpr::{Cpr, CprMode, View};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::Vessel;
use serde::{Deserialize, Serialize};

use crate::study::failure::{Failure, Result};
use crate::study::open_study::{Picture, Study, no_volume, shown_flat};

/// A CPR as the page asks for it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
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
    message: CprMessage,
    /// From pixels to the world and back.
    pub cpr: Cpr,
}

impl Laid {
    /// The layout that is asked for; that of `before` turned, where it is of the same vessel.
    ///
    /// # Errors
    /// `camera` for an angle, a width or a spacing that is none.
    pub fn new(message: CprMessage, vessel: &Vessel, before: Option<&Self>) -> Result<Self> {
        let same = |laid: &&Self| {
            CprMessage { angle: message.angle, feature: message.feature, ..laid.message } == message
        };
        if let Some(laid) = before.filter(same) {
            return Ok(Self { message, cpr: laid.cpr.rotated(message.angle)? });
        }
        let view = View { up: DVec3::Z, angle: message.angle, normal: None };
        let path = Path::new(vessel, 0.0)?;
        let cpr = Cpr::new(path, CprMode::Straightened, view, Some(message.width), message.pixel_spacing)?;
        Ok(Self { message, cpr })
    }

    /// The world point at a place in the picture, column and row.
    fn world(&self, pixel: [f64; 2]) -> [f64; 3] {
        self.cpr.world_from_pixel(DVec2::from_array(pixel)).to_array()
    }

    /// The column and row of a world point.
    pub fn pixel(&self, point: [f64; 3]) -> [f64; 2] {
        self.cpr.pixel_from_world(DVec3::from_array(point)).to_array()
    }

    /// The arc length (mm) of a row.
    fn arc_length(&self, row: f64) -> f64 {
        row * self.message.pixel_spacing
    }
}

/// What a place in the straightened CPR shows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StraightenedPick {
    /// The world point.
    pub point: [f64; 3],
    /// The volume there; none outside.
    pub value: Option<f32>,
    /// The vessel that is straightened.
    pub vessel: usize,
    /// The place along it (mm).
    pub arc_length: f64,
}

impl Study {
    /// The straightened CPR of a vessel in a window.
    ///
    /// # Errors
    /// `vessel tree` for a vessel that there is not, and those of the layout.
    pub fn straightened(&mut self, message: CprMessage, window: [f64; 2]) -> Result<Picture> {
        let laid = Laid::new(message, self.vessel(message.vessel)?, self.laid.as_ref())?;
        let picture = match message.feature {
            Some(feature) => self.aggregated(&laid, message.pixel_spacing, feature.into(), window)?,
            None => self.shown(Geometry::Curved(laid.cpr.curved()?), window)?,
        };
        self.laid = Some(laid);
        Ok(picture)
    }

    /// What a place in the straightened CPR that was shown last shows.
    ///
    /// # Errors
    /// `settings` where none was shown.
    pub fn pick_straightened(&self, [column, row]: [f64; 2]) -> Result<StraightenedPick> {
        let none = || Failure::of_message("CPR", &"none", "one that is shown");
        let laid = self.laid.as_ref().ok_or_else(none)?;
        let at = self.at(laid.world([column, row]));
        let (vessel, arc_length) = (laid.message.vessel, laid.arc_length(row));
        Ok(StraightenedPick { point: at.point, value: at.value, vessel, arc_length })
    }

    /// Column and row of a world point in the straightened CPR that was shown last; none where none was.
    pub fn on_straightened(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        self.laid.as_ref().map(|laid| laid.pixel(point))
    }

    fn aggregated(&self, laid: &Laid, spacing: f64, feature: Feature, window: [f64; 2]) -> Result<Picture> {
        let volume = self.scene()?.volume.ok_or_else(no_volume)?;
        let (camera, settings) = shown_flat(window)?;
        let request = Request { images: ImageSet::of(&[Image::Value]), ..Request::new(&camera, &settings) };
        let look = |turned: &Cpr| {
            let frame = self.cpu.look(&volume, Frame::of(Geometry::Curved(turned.curved()?)), &request)?;
            Ok(frame.value)
        };
        let value = feature_aggregation(&laid.cpr, spacing, feature, look)?;
        let size = laid.cpr.size();
        Ok(Picture { size, bytes: pipeline::picture(&value, size, &settings)?.into_flattened() })
    }
}
