//! Searches for fainter tubes around a seed that no track contains.

use glam::DVec3;

use crate::trace::find::candidates::{Floors, candidates_near};
use crate::trace::find::choose::SELECT_RADII;
use crate::trace::find::stages::Stages;
use crate::trace::find::track::Track;
use crate::trace::find::tracking::Tracking;
use lumencut_core::error::Result;

/// Contrast threshold around a seed, as a fraction of the normal threshold.
const FAINTER: f64 = 1.0 / 3.0;

/// Tracks through a seed (finest-level voxels); none if a known track already contains the seed.
pub(crate) fn from_seed(tracking: &Tracking, seed: DVec3, known: &[Track]) -> Result<Vec<Track>> {
    if known.iter().any(|track| holds(track, seed)) {
        return Ok(Vec::new());
    }
    let floors = Floors { contrast: FAINTER * tracking.floors.contrast, ..tracking.floors };
    let around = Tracking {
        floors,
        stages: Stages::default(),
        levels_examined: tracking.levels_examined.clone(),
        ..*tracking
    };
    let near = candidates_near(tracking.pyramid, &around.levels_examined, &floors, seed);
    let found = around.tracks_beside(known, &near)?;
    Ok(found.into_iter().filter(|track| holds(track, seed)).collect())
}

fn holds(track: &Track, place: DVec3) -> bool {
    track.points.iter().any(|point| point.place.distance(place) <= (SELECT_RADII * point.radius).max(1.0))
}

#[cfg(test)]
#[path = "tests/from_seed.rs"]
mod tests;
