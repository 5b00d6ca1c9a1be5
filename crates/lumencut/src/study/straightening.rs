//! Renders and picks the straightened CPR of a vessel.

use crate::feature_aggregation::{Feature, feature_aggregation, half_circle};
use crate::windows::sample;
use glam::DVec2;
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::pipeline::{self, Request};
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::{Cpr, Roll};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::stop::Stop;
use serde::Serialize;

use crate::study::failure::{Failure, Result};
use crate::study::held_volume::no_volume;
use crate::study::open_study::{Picture, Study, shown_flat};
use crate::study::straightened::{CprMessage, Laid};

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct StraightenedPick {
    pub point: [f64; 3],
    /// The volume's value; none outside.
    pub value: Option<f32>,
    pub vessel: usize,
    /// The arc length (mm).
    pub arc_length: f64,
}

impl Study {
    /// The straightened CPR of a vessel in a window. If rows follow a side of the lumen, the lumen is measured if necessary.
    pub(crate) fn straightened(
        &mut self,
        message: CprMessage,
        (window, stop): ([f64; 2], Stop),
    ) -> Result<Picture> {
        let mut laid = Laid::new(message, self.vessel(message.vessel)?, self.laid.as_ref())?;
        if let Some(followed) = message.roll
            && self.laid.as_ref().is_none_or(|before| !before.is_turned(&message))
        {
            let (path, found) = self.wall_of(message.vessel, stop)?;
            laid = laid.rolled(Roll::following(&found.wall, path.length(), followed.into()))?;
        }
        let picture = match message.feature {
            Some(_) if message.roll.is_some() => return Err(feature_of_roll()),
            Some(feature) => {
                self.aggregated(&laid, (message.pixel_spacing, feature.into()), (window, stop))?
            }
            None => self.shown(Geometry::Curved(laid.cpr.curved(stop)?), (window, None))?,
        };
        self.laid = Some(laid);
        Ok(picture)
    }

    /// What a position in the last straightened CPR shows; for CFA with the largest or smallest value, the place of that value.
    pub(crate) fn pick_straightened(&self, [column, row]: [f64; 2]) -> Result<StraightenedPick> {
        let none = || Failure::of_message("CPR", &"none", "a straightened CPR shown before");
        let laid = self.laid.as_ref().ok_or_else(none)?;
        let on_half_circle = match laid.message.feature {
            Some(feature) => self.aggregated_place(laid, feature.into(), [column, row])?,
            None => None,
        };
        let at = self.at(on_half_circle.unwrap_or_else(|| laid.world([column, row])));
        let (vessel, arc_length) = (laid.message.vessel, laid.arc_length(row));
        Ok(StraightenedPick { point: at.point, value: at.value, vessel, arc_length })
    }

    fn aggregated_place(&self, laid: &Laid, feature: Feature, pixel: [f64; 2]) -> Result<Option<[f64; 3]>> {
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let circle = half_circle(&laid.cpr, laid.message.pixel_spacing, DVec2::from_array(pixel))?;
        let place = feature.place(&sample(&volume, &circle));
        Ok(place.map(|n| circle[n].to_array()))
    }

    /// Column and row of a world point in the last straightened CPR; None if there is none.
    pub(crate) fn on_straightened(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        self.laid.as_ref().map(|laid| laid.pixel(point))
    }

    fn aggregated(
        &self,
        laid: &Laid,
        (spacing, feature): (f64, Feature),
        (window, stop): ([f64; 2], Stop),
    ) -> Result<Picture> {
        let volume = self.scene()?.volume.ok_or_else(no_volume)?;
        let (camera, settings) = shown_flat(window)?;
        let request =
            Request { images: ImageSet::of(&[Image::Value]), stop, ..Request::new(&camera, &settings) };
        let look = |turned: &Cpr| {
            let frame =
                self.cpu.look(&volume, Frame::of(Geometry::Curved(turned.curved(stop)?)), &request)?;
            Ok(frame.value)
        };
        let value = feature_aggregation(&laid.cpr, spacing, feature, look)?;
        let size = laid.cpr.size();
        Ok(Picture { size, bytes: pipeline::picture(&value, size, (&settings, stop))?.into_flattened() })
    }
}

fn feature_of_roll() -> Failure {
    let found = "a CPR whose rows follow a side of the lumen";
    Failure::of_message("feature of the CFA", &found, "a CPR at a constant angle")
}

#[cfg(test)]
#[path = "tests/straightening.rs"]
mod tests;
