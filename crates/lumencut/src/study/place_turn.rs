//! Views of one vessel of the study: from where most of it is seen, and a turn about a place on it.

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

/// The degrees after which the same places are cut again, from behind.
const HALF_TURN: u32 = 180;

/// A turn about a place on a vessel, which runs upwards through the middle of the picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct PlaceTurn {
    /// The first view: of all views about the place the one that is nearest to that from the front.
    pub camera: CameraMessage,
    /// The diameter (mm) that is cut after each whole degree of the turn, from 0 to 179; from there on they repeat. None where a
    /// view has no two walls.
    pub(crate) diameters: Vec<Option<f64>>,
}

impl Study {
    /// The view from which most of a line is seen, whether it is shown or doubtful, turned least from a camera.
    ///
    /// # Errors
    /// `camera` for one that defines no view, `vessel tree` for a line that there is not or that has no length.
    pub(crate) fn best_view(&self, camera: &CameraMessage, line: usize) -> Result<CameraMessage> {
        Ok((&refocused(&camera.camera()?, &self.lines.get(line)?.vessel()?)?).into())
    }

    /// A turn about a place `at` mm along a vessel, in pictures of a size.
    ///
    /// # Errors
    /// `vessel tree` for a vessel that there is not, `camera` for a place that is not on it, `volume` where none is open, and
    /// `measuring` where the radius of the vessel is neither known nor measured there.
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

    /// The radius of a vessel at a place (mm): that of the nearest section, once it is measured; else its own, and where it has
    /// none, it is measured.
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
