//! Separates lumens that lie side by side in a wide tube: the limbs of a stent graft, or true and false lumen.

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::all_tracks::Tracking;
use crate::trace::find::candidates::Candidate;
use crate::trace::find::progress::Stages;
use crate::trace::find::track::{Track, TrackPoint};
use lumencut_core::error::Result;
use lumencut_core::stop::go_on;

/// Minimum radius of a wide tube (finest-level voxels).
const MIN_WIDE_RADIUS: f64 = 4.0;

/// Ranges for a lumen inside a wide tube: distance from its axis, and radius, both in radii of the wide tube.
const OFF_AXIS: [f64; 2] = [0.3, 1.2];
const NARROWER: [f64; 2] = [0.25, 0.7];

/// Minimum closure and fraction of contrasting rays; minimum response as a fraction of the wide tube's contrast.
const LEAST_CLOSURE: f64 = 0.8;
const LEAST_RESPONSE: f64 = 0.5;

/// Number of coarsest levels that are skipped, because they would merge adjacent lumens.
const COARSE_LEVELS: usize = 2;

/// Minimum confidence of the tracks that are added.
const LEAST_CONFIDENCE: f64 = 0.5;

/// Limits of a new part: distance from the wide axis (its radii), length (own radii), fraction in the wide tube.
const MIN_AXIS_DISTANCE: f64 = 0.33;
const LEAST_RADII: f64 = 3.0;
const LEAST_WITHIN: f64 = 0.3;
const WITHIN: f64 = 1.15;

/// Finds tracks of adjacent lumens inside wide tracks, in finest-level voxels.
pub(crate) fn side_by_side(
    tracking: &Tracking,
    candidates: &[Candidate],
    tracks: &[Track],
) -> Result<Vec<Track>> {
    let end =
        tracking.levels_examined.end.saturating_sub(COARSE_LEVELS).max(tracking.levels_examined.start + 1);
    let fine = Tracking {
        levels_examined: tracking.levels_examined.start..end,
        stages: Stages::default(),
        ..*tracking
    };
    let wide: Vec<TrackPoint> = tracks
        .iter()
        .flat_map(|track| track.points.iter().filter(|point| point.is_good && point.radius > MIN_WIDE_RADIUS))
        .copied()
        .collect();
    let is_inner = |candidate: &Candidate| {
        candidate.closure > LEAST_CLOSURE
            && candidate.contrast_share > LEAST_CLOSURE
            && wide.iter().any(|point| is_beside(candidate, point))
    };
    let inner = |candidate: &Candidate| {
        go_on(tracking.stop)?;
        Ok(is_inner(candidate).then_some(*candidate))
    };
    let inner: Vec<Option<Candidate>> = candidates.par_iter().map(inner).collect::<Result<_>>()?;
    let found = fine.tracks(&inner.into_iter().flatten().collect::<Vec<_>>())?;
    let sure: Vec<Track> = found.into_iter().filter(|track| track.confidence >= LEAST_CONFIDENCE).collect();
    let runs = |track| {
        go_on(tracking.stop)?;
        Ok(new_runs(track, &wide))
    };
    let runs: Vec<Vec<Track>> = sure.par_iter().map(runs).collect::<Result<_>>()?;
    Ok(runs.into_iter().flatten().collect())
}

fn is_beside(candidate: &Candidate, point: &TrackPoint) -> bool {
    let off = off_axis(candidate.place, point) / point.radius;
    (OFF_AXIS[0]..OFF_AXIS[1]).contains(&off)
        && (NARROWER[0]..NARROWER[1]).contains(&(candidate.radius / point.radius))
        && candidate.response > LEAST_RESPONSE * point.contrast
}

/// Distance of a position from the axis; the largest number if it does not lie in this section.
fn off_axis(place: DVec3, point: &TrackPoint) -> f64 {
    let way = place - point.place;
    let along = way.dot(point.direction);
    if along.abs() > point.radius { f64::MAX } else { (way - point.direction * along).length() }
}

fn new_runs(track: &Track, wide: &[TrackPoint]) -> Vec<Track> {
    // Distance of each point from the nearest wide axis, in radii of the wide tube.
    let off: Vec<f64> = track
        .points
        .iter()
        .map(|own| {
            let of = |point: &TrackPoint| own.place.distance(point.place) / point.radius;
            wide.iter().map(of).fold(f64::MAX, f64::min)
        })
        .collect();
    let mut runs = Vec::new();
    let mut first = 0;
    while first < off.len() {
        let Some(start) = (first..off.len()).find(|n| off[*n] > MIN_AXIS_DISTANCE) else { break };
        let end = (start..off.len()).find(|n| off[*n] <= MIN_AXIS_DISTANCE).unwrap_or(off.len());
        let within = off[start..end].iter().filter(|off| **off <= WITHIN).count() as f64;
        let run = Track { points: track.points[start..end].to_vec(), ..track.clone() };
        let is_new = run.points.len() > 1
            && run.length() >= LEAST_RADII * run.radius()
            && within >= LEAST_WITHIN * (end - start) as f64;
        if is_new {
            runs.push(run);
        }
        first = end;
    }
    runs
}

#[cfg(test)]
#[path = "tests/side_by_side.rs"]
mod tests;
