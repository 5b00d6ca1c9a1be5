//! Tracks narrow tubes inside wide tracks that are not vessels, such as arteries next to bone.

use glam::DVec3;

use crate::trace::find::all_tracks::Tracking;
use crate::trace::find::candidates::Candidate;
use crate::trace::find::paint::Painted;
use crate::trace::find::progress::Stages;
use crate::trace::find::track::{Track, TrackPoint};
use lumencut_core::error::Result;

/// Tracks with at least this confidence may be vessels, so no tubes are searched inside them.
const DISMISSED: f64 = 0.3;

/// Maximum radius of a hidden tube, relative to the radius of the track.
const NARROWER: f64 = 0.5;

/// Finds tubes inside dismissed tracks. `judged` are the same `tracks` (finest-level voxels), with final confidence.
pub(crate) fn hidden(
    tracking: &Tracking,
    candidates: &[Candidate],
    tracks: &[Track],
    judged: &[Track],
) -> Result<Vec<Track>> {
    let those = |are_dismissed: bool| -> Vec<Track> {
        let of = tracks.iter().zip(judged);
        of.filter(|(_, judged)| (judged.confidence < DISMISSED) == are_dismissed)
            .map(|(track, _)| track.clone())
            .collect()
    };
    let dismissed = those(true);
    let radii: Vec<f64> = dismissed.iter().map(Track::radius).collect();
    let paint = tracking.painted(&dismissed);
    // Maximum radius of a hidden tube at a position; None if no track hides it.
    let most = |place: DVec3| match paint.at(place) {
        Painted::Lumen(number) => Some(NARROWER * radii[number as usize]),
        Painted::Empty | Painted::Rejected => None,
    };
    let is_hidden =
        |candidate: &&Candidate| most(candidate.place).is_some_and(|most| candidate.radius < most);
    let within: Vec<Candidate> = candidates.iter().filter(is_hidden).copied().collect();
    let judge = |points: Vec<TrackPoint>| {
        let is_wide = |point: &&TrackPoint| most(point.place).is_some_and(|most| point.radius >= most);
        // The dismissed track itself must not be found again.
        let is_known = 2 * points.iter().filter(is_wide).count() > points.len();
        let track = (tracking.judge)(points);
        if is_known { Track { confidence: 0.0, ..track } } else { track }
    };
    let levels_examined = tracking.levels_examined.clone();
    Tracking { judge: &judge, levels_examined, stages: Stages::default(), ..*tracking }
        .tracks_beside(&those(false), &within)
}

#[cfg(test)]
#[path = "tests/inside_wide.rs"]
mod tests;
