//! Tracks from a seed that lies in none of those that were found: narrower and fainter tubes are looked for around it alone.

use glam::DVec3;

use crate::trace::find::candidates::{Floors, candidates_near};
use crate::trace::find::choose::REACH;
use crate::trace::find::stages::Stages;
use crate::trace::find::track::Track;
use crate::trace::find::tracking::Tracking;
use lumencut_core::error::Result;

/// Around a seed tubes may have this part of the contrast that is asked of others.
const FAINTER: f64 = 1.0 / 3.0;

/// The tracks through a seed (voxels of the finest level) where it lies in none of those that are known; else none.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub(crate) fn from_seed(tracking: &Tracking, seed: DVec3, known: &[Track]) -> Result<Vec<Track>> {
    if known.iter().any(|track| holds(track, seed)) {
        return Ok(Vec::new());
    }
    let floors = Floors { contrast: FAINTER * tracking.floors.contrast, ..tracking.floors };
    let around =
        Tracking { floors, stages: Stages::default(), looked_at: tracking.looked_at.clone(), ..*tracking };
    let near = candidates_near(tracking.pyramid, &around.looked_at, &floors, seed);
    let found = around.tracks_beside(known, &near)?;
    Ok(found.into_iter().filter(|track| holds(track, seed)).collect())
}

/// Whether a place lies in a track, or as near to it as a seed may.
fn holds(track: &Track, place: DVec3) -> bool {
    track.points.iter().any(|point| point.place.distance(place) <= (REACH * point.radius).max(1.0))
}

#[cfg(test)]
#[path = "tests/from_seed.rs"]
mod tests;
