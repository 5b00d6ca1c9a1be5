//! Views of one vessel: the view that shows most of the vessel, and a turn about a place on it.

use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::stop::Stop;
use serde::Serialize;

use crate::cut_diameter::cut_diameter;
use crate::study::failure::Result;
use crate::study::held_volume::no_volume;
use crate::study::open_study::Study;
use crate::study::view::CameraMessage;
use crate::vessel_views::{Lumen, about_lumen, known_radius_at, refocused};
use crate::views::{Axis, rotated};

/// After this many degrees the same cut appears, seen from behind.
const HALF_TURN: u32 = 180;

/// The views about a place on a vessel, which runs upwards through the middle of the picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct PlaceTurn {
    /// The first view: the one nearest to the anterior view.
    pub camera: CameraMessage,
    /// The cut diameter (mm) after each degree from 0 to 179; then the diameters repeat. None if two walls are not found.
    pub(crate) diameters: Vec<Option<f64>>,
}

impl Study {
    /// The view that shows most of a line, which may be doubtful, with little turning from a camera.
    pub(crate) fn best_view(&self, camera: &CameraMessage, line: usize) -> Result<CameraMessage> {
        Ok((&refocused(&camera.camera()?, &self.lines.get(line)?.vessel()?)?).into())
    }

    /// A turn about the place `at` mm along a vessel.
    pub(crate) fn turn_about(
        &mut self,
        vessel: usize,
        at: f64,
        size: [usize; 2],
        stop: Stop,
    ) -> Result<PlaceTurn> {
        let radius = self.lumen_radius(vessel, at, stop)?;
        let first = about_lumen(self.vessel(vessel)?, Lumen { at, radius }, size)?;
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let cut = |degree: u32| {
            let turned = rotated(&first, f64::from(degree).to_radians(), Axis::Up)?;
            Ok(cut_diameter(&volume, &turned, radius))
        };
        Ok(PlaceTurn { camera: (&first).into(), diameters: (0..HALF_TURN).map(cut).collect::<Result<_>>()? })
    }

    /// The radius at a place (mm): that of the nearest section if the line was measured, else the vessel's own, else measured now.
    fn lumen_radius(&mut self, number: usize, at: f64, stop: Stop) -> Result<f64> {
        let own = known_radius_at(self.vessel(number)?, at);
        let lines = self.content.named.as_ref().map_or(&[][..], |named| &named.lines);
        let line = lines[number];
        let profile = match own {
            Some(_) => self.profiles.any_of(line),
            None => Some(self.measured(line, stop)?),
        };
        let section = profile.map(|profile| profile.diameter_equivalent()[profile.nearest_section(at)] / 2.0);
        if let Some(radius) = section.filter(|radius| radius.is_finite()).or(own) {
            return Ok(radius);
        }
        let expected = "a radius in the file of the vessel, or a lumen that can be measured";
        Err(Error::new(ErrorKind::Measuring, "radius at the place", "none", expected).into())
    }
}

#[cfg(test)]
#[path = "tests/place_turn.rs"]
mod tests;
