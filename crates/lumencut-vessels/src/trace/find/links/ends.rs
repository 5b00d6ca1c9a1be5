//! The ends of tracks.

use glam::DVec3;

use crate::trace::find::quantiles::median;
use crate::trace::find::track::{Track, TrackPoint};

/// Tracks with less confidence than this are not linked, because bone must not join trees.
const LEAST_CONFIDENCE: f64 = 0.3;

/// Length of the part that gives the direction of an end (radii).
const DIRECTED: f64 = 1.5;

/// Number of points at an end from which its radius and level are taken.
const LAST: usize = 5;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End {
    /// Index of the track, and index of its point.
    pub of: [usize; 2],
    pub place: DVec3,
    /// Unit vector that points out of the track.
    pub direction: DVec3,
    pub radius: f64,
    pub level: f64,
    pub contrast: f64,
}

pub(crate) fn may_link(track: &Track) -> bool {
    track.confidence >= LEAST_CONFIDENCE
}

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
