//! The ends of tracks, and what the lumen is there.

use glam::DVec3;

use crate::trace::find::quantiles::median;
use crate::trace::find::track::{Track, TrackPoint};

/// A track with less confidence takes part in no link: bone does not join trees.
const LEAST_CONFIDENCE: f64 = 0.3;

/// Over how many radii an end is directed.
const DIRECTED: f64 = 1.5;

/// How many points say what the lumen is at an end.
const LAST: usize = 5;

/// An end of a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End {
    /// The track, and the number of its point there.
    pub of: [usize; 2],
    /// Where it lies (mm, LPS).
    pub place: DVec3,
    /// Where the track would go on to (unit vector).
    pub direction: DVec3,
    /// The usual radius (mm), level and contrast there, as of a point of a track.
    pub radius: f64,
    /// See `radius`.
    pub level: f64,
    /// See `radius`.
    pub contrast: f64,
}

/// Whether a track takes part in links.
pub(crate) fn may_link(track: &Track) -> bool {
    track.confidence >= LEAST_CONFIDENCE
}

/// Both ends of all tracks that take part in links.
pub(crate) fn ends(tracks: &[Track]) -> Vec<End> {
    let linked = tracks.iter().enumerate().filter(|(_, track)| may_link(track));
    linked.flat_map(|(number, track)| [false, true].map(|at_last| end(number, track, at_last))).collect()
}

fn end(number: usize, track: &Track, at_last: bool) -> End {
    let count = track.points.len();
    let point = |n: usize| &track.points[if at_last { count - 1 - n } else { n }];
    let usual = |of: fn(&TrackPoint) -> f64| {
        let mut last: Vec<f64> = (0..LAST.min(count)).map(|n| of(point(n))).collect();
        median(&mut last).unwrap_or(0.0)
    };
    let (place, radius) = (point(0).place, usual(|point| point.radius));
    let is_away = |n: &usize| point(*n).place.distance(place) >= DIRECTED * radius;
    let before = point((1..count).find(is_away).unwrap_or(count - 1)).place;
    End {
        of: [number, if at_last { count - 1 } else { 0 }],
        place,
        direction: (place - before).normalize_or_zero(),
        radius,
        level: usual(|point| point.level),
        contrast: usual(|point| point.contrast),
    }
}
