//! Tracks the most promising candidates first and paints the tracks, so that no tube is found twice.

use std::collections::VecDeque;
use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::candidates::{Candidate, Floors, candidates};
use crate::trace::find::one_track::{DARKER, MOST_STEPS, Tracker};
use crate::trace::find::paint::{Paint, Painted};
use crate::trace::find::progress::{Stage, Stages};
use crate::trace::find::pyramid::Pyramid;
use crate::trace::find::track::{Track, TrackPoint, length, usual};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Minimum length of a track in radii and in voxels, and minimum fraction of good sections.
const LEAST_RADII: f64 = 3.0;
const LEAST_VOXELS: f64 = 5.0;
const LEAST_GOOD: f64 = 0.6;

const LEAST_CONFIDENCE: f64 = 0.3;

/// Number of steps of a short first attempt, and its minimum confidence relative to that of a complete track.
const FIRST_STEPS: usize = 16;
const LEAST_OF_FIRST: f64 = 0.5;

/// Radius of the paint, in track radii: for narrow tracks (up to `NARROW_RADIUS` voxels), for wide ones (from
/// `WIDE_RADIUS` voxels on), and for others.
const PAINTED: [f64; 3] = [0.9, 1.1, 1.0];
const NARROW_RADIUS: f64 = 2.0;
const WIDE_RADIUS: f64 = 4.0;

/// Radius of the paint of a rejected track (voxels).
const THIN: f64 = 1.0;

/// A candidate inside a darker track needs this fraction of the vessel contrast, and at most this radius (voxels).
const OVER_CONTRAST: f64 = 0.5;
const OVER_RADIUS: f64 = 5.0;

/// Number of candidates tracked in parallel before painting.
const BATCH: usize = 32;

/// Candidates closer than this (radii plus voxels) are tracked one after the other. For each batch, at most
/// `MAX_EXAMINED` candidates are searched.
const NEAR_RADII: f64 = 4.0;
const NEAR_VOXELS: f64 = 8.0;
const MAX_EXAMINED: usize = 128;

pub(crate) struct Tracking<'a> {
    pub(crate) pyramid: &'a Pyramid,
    pub levels_examined: Range<usize>,
    pub(crate) floors: Floors,
    pub stop: Stop<'a>,
    pub judge: &'a (dyn Fn(Vec<TrackPoint>) -> Track + Sync),
    pub stages: Stages<'a>,
}

struct Batch {
    candidates: Vec<Candidate>,
    /// Number of candidates that were examined.
    levels_examined: usize,
}

struct Known {
    paint: Paint,
    found: Vec<Track>,
    levels: Vec<f64>,
}

enum Tried {
    Nothing,
    Rejected(Vec<TrackPoint>),
    Kept(Track),
}

impl Tracking<'_> {
    pub(crate) fn candidates(&self) -> Result<Vec<Candidate>> {
        candidates(self.pyramid, &self.levels_examined, &self.floors, self.stop, self.stages)
    }

    fn side(&self) -> f64 {
        self.pyramid.levels[self.levels_examined.start].side
    }

    /// Finds tracks in finest-level voxels. Candidates are tracked in independent batches and painted in order.
    /// Candidates that meet new paint are tracked again, so the result does not depend on the number of threads.
    pub(crate) fn tracks(&self, candidates: &[Candidate]) -> Result<Vec<Track>> {
        self.tracks_beside(&[], candidates)
    }

    pub(crate) fn tracks_beside(&self, known: &[Track], candidates: &[Candidate]) -> Result<Vec<Track>> {
        let Known { mut paint, mut found, mut levels } = self.known(known);
        let (mut next, mut waiting) = (0, VecDeque::new());
        let pieces = self.stages.stage(Stage::Tracks, candidates.len());
        while next < candidates.len() || !waiting.is_empty() {
            go_on(self.stop)?;
            let Batch { candidates: batch, levels_examined } =
                self.batch(&paint, &levels, &candidates[next..], &mut waiting);
            next += levels_examined;
            let tried: Vec<Tried> =
                batch.par_iter().map(|candidate| self.tried(&paint, &levels, candidate)).collect();
            let before = found.len();
            for (candidate, tried) in batch.iter().zip(tried) {
                if !self.is_open(&paint, &levels, candidate) {
                    continue;
                }
                let tried = if meets_new(&paint, before, &tried) {
                    self.tried(&paint, &levels, candidate)
                } else {
                    tried
                };
                self.commit(tried, &mut paint, &mut found, &mut levels);
            }
            pieces.done(levels_examined);
        }
        found.drain(..known.len());
        Ok(found)
    }

    pub(crate) fn painted(&self, tracks: &[Track]) -> Paint {
        self.known(tracks).paint
    }

    fn known(&self, tracks: &[Track]) -> Known {
        let mut known = Known { paint: Paint::default(), found: Vec::new(), levels: Vec::new() };
        for track in tracks {
            self.commit(Tried::Kept(track.clone()), &mut known.paint, &mut known.found, &mut known.levels);
        }
        known
    }

    /// The next independent candidates. A candidate near another one waits, because both may lie in the same tube.
    fn batch(
        &self,
        paint: &Paint,
        levels: &[f64],
        others: &[Candidate],
        waiting: &mut VecDeque<Candidate>,
    ) -> Batch {
        let mut batch = Batch { candidates: Vec::with_capacity(BATCH), levels_examined: 0 };
        let mut still = VecDeque::new();
        let mut take = |batch: &mut Batch, candidate: Candidate| {
            let is_near = |other: &Candidate| {
                let radii = candidate.radius + other.radius;
                candidate.place.distance(other.place) < NEAR_RADII * radii + NEAR_VOXELS
            };
            if !self.is_open(paint, levels, &candidate) {
                return;
            }
            if batch.candidates.iter().any(is_near) {
                still.push_back(candidate);
            } else {
                batch.candidates.push(candidate);
            }
        };
        while batch.candidates.len() < BATCH
            && let Some(candidate) = waiting.pop_front()
        {
            take(&mut batch, candidate);
        }
        while batch.candidates.len() < BATCH && batch.levels_examined < others.len().min(MAX_EXAMINED) {
            let candidate = others[batch.levels_examined];
            batch.levels_examined += 1;
            take(&mut batch, candidate);
        }
        still.append(waiting);
        *waiting = still;
        batch
    }

    /// Whether the candidate's position is unpainted, or the candidate is a narrow one inside a darker lumen.
    fn is_open(&self, paint: &Paint, levels: &[f64], candidate: &Candidate) -> bool {
        match paint.at(candidate.place) {
            Painted::Empty => true,
            Painted::Rejected => false,
            Painted::Lumen(track) => {
                let level =
                    self.pyramid.level_for(candidate.radius, &self.levels_examined).at(candidate.place);
                let contrast = candidate.response;
                let is_darker = levels[track as usize] < f64::from(level) - DARKER * contrast;
                is_darker
                    && contrast >= OVER_CONTRAST * self.floors.contrast
                    && candidate.radius < OVER_RADIUS * self.side()
            }
        }
    }

    fn tried(&self, paint: &Paint, levels: &[f64], candidate: &Candidate) -> Tried {
        let (levels_examined, floors) = (self.levels_examined.clone(), self.floors);
        let tracker = Tracker { pyramid: self.pyramid, levels_examined, paint, levels, floors };
        // The first steps are enough to reject most positions outside vessels.
        let Some(points) = tracker.track(candidate, FIRST_STEPS) else { return Tried::Nothing };
        let Some(first) = self.kept(&points, LEAST_OF_FIRST) else { return Tried::Rejected(points) };
        if points.len() <= FIRST_STEPS {
            // The track ended early, so it is complete.
            let is_sure = first.confidence >= LEAST_CONFIDENCE;
            return if is_sure { Tried::Kept(first) } else { Tried::Rejected(points) };
        }
        let Some(points) = tracker.track(candidate, MOST_STEPS) else { return Tried::Nothing };
        self.kept(&points, 1.0).map_or(Tried::Rejected(points), Tried::Kept)
    }

    /// The track if it is long and good enough, and has at least `share` of the minimum confidence.
    fn kept(&self, points: &[TrackPoint], share: f64) -> Option<Track> {
        let radius = usual(points, |point| point.radius);
        let good = points.iter().filter(|point| point.is_good).count() as f64;
        let side = self.side();
        let is_long = length(points) >= (LEAST_RADII * radius).max(LEAST_VOXELS * side);
        if points.len() < 2 || !is_long || good < LEAST_GOOD * points.len() as f64 {
            return None;
        }
        let track = (self.judge)(points.to_vec());
        (track.confidence >= share * LEAST_CONFIDENCE).then_some(track)
    }

    /// Paints and stores a track, or paints only the centerline of a rejected one.
    fn commit(&self, tried: Tried, paint: &mut Paint, found: &mut Vec<Track>, levels: &mut Vec<f64>) {
        match tried {
            Tried::Nothing => (),
            Tried::Rejected(points) => {
                for point in &points {
                    paint.rejected(point.place, THIN * self.side());
                }
            }
            Tried::Kept(track) => {
                let number = found.len() as u32;
                let level = usual(&track.points, |point| point.level);
                let contrast = usual(&track.points, |point| point.contrast);
                let gives_way = |other: u32| levels[other as usize] < level - DARKER * contrast;
                for point in &track.points {
                    paint.lumen(number, point.place, painted(point.radius), &gives_way);
                }
                levels.push(level);
                found.push(track);
            }
        }
    }
}

fn painted(radius: f64) -> f64 {
    radius
        * match () {
            () if radius < NARROW_RADIUS => PAINTED[0],
            () if radius >= WIDE_RADIUS => PAINTED[1],
            () => PAINTED[2],
        }
}

fn meets_new(paint: &Paint, known: usize, tried: &Tried) -> bool {
    let points = match tried {
        Tried::Nothing => return false,
        Tried::Kept(track) => &track.points,
        Tried::Rejected(points) => points,
    };
    let is_new = |place: DVec3| matches!(paint.at(place), Painted::Lumen(n) if n as usize >= known);
    points.iter().any(|point| is_new(point.place))
}
