//! From candidates to tracks, the most promising first: each is followed, judged and painted, so that no tube is found twice.

use std::collections::VecDeque;
use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::candidates::{Candidate, Floors, candidates};
use crate::trace::find::paint::{Paint, Painted};
use crate::trace::find::pyramid::Pyramid;
use crate::trace::find::stages::{Stage, Stages};
use crate::trace::find::track::{Track, TrackPoint, length, usual};
use crate::trace::find::tracker::{DARKER, MOST_STEPS, Tracker};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// A track is at least so many radii and so many voxels long, and this share of its sections is good.
const LEAST_RADII: f64 = 3.0;
const LEAST_VOXELS: f64 = 5.0;
const LEAST_GOOD: f64 = 0.6;

/// Tracks of less confidence are left out.
const LEAST_CONFIDENCE: f64 = 0.3;

/// So many steps each way are looked at before a track is followed to its ends; they are as sure as this share of what is asked of a
/// whole track.
const FIRST_STEPS: usize = 16;
const LEAST_OF_FIRST: f64 = 0.5;

/// How far from its middle a track is painted, in its radii: where it is narrower than the first limit (voxels), wider than the
/// second one, and between them.
const PAINTED: [f64; 3] = [0.9, 1.1, 1.0];
const NARROW: f64 = 2.0;
const WIDE: f64 = 4.0;

/// How far from its middle a rejected track is painted (voxels).
const THIN: f64 = 1.0;

/// A candidate in the lumen of a darker track is tried where its contrast is at least this part of the usual one, and its radius
/// less than so many voxels.
const OVER_CONTRAST: f64 = 0.5;
const OVER_RADIUS: f64 = 5.0;

/// How many candidates are tracked beside each other before what they found is painted.
const BATCH: usize = 32;

/// Candidates are tracked one after the other where they are nearer than so many times the sum of their radii and so many voxels more;
/// so many others are looked at for those that are not.
const NEAR_RADII: f64 = 4.0;
const NEAR_VOXELS: f64 = 8.0;
const MOST_LOOKED_AT: usize = 128;

/// How candidates become tracks.
pub(crate) struct Tracking<'a> {
    /// The levels.
    pub pyramid: &'a Pyramid,
    /// The numbers of those that are looked at.
    pub looked_at: Range<usize>,
    /// The least that a tube must have.
    pub floors: Floors,
    /// Asked whether to stop.
    pub stop: Stop<'a>,
    /// How sure a track is.
    pub judge: &'a (dyn Fn(Vec<TrackPoint>) -> Track + Sync),
    /// Told how far it is.
    pub stages: Stages<'a>,
}

/// Candidates that are tracked beside each other.
struct Batch {
    candidates: Vec<Candidate>,
    /// How many of the others were looked at for them.
    looked_at: usize,
}

/// The tracks that are known, their levels, and their lumens.
struct Known {
    paint: Paint,
    found: Vec<Track>,
    levels: Vec<f64>,
}

/// What became of a candidate.
enum Tried {
    /// No track begins there.
    Nothing,
    /// A track that is no vessel.
    Rejected(Vec<TrackPoint>),
    /// A tube.
    Kept(Track),
}

impl Tracking<'_> {
    /// The candidates, the most promising first.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub(crate) fn candidates(&self) -> Result<Vec<Candidate>> {
        candidates(self.pyramid, &self.looked_at, &self.floors, self.stop, self.stages)
    }

    /// The side of the finest voxels that are looked at.
    fn side(&self) -> f64 {
        self.pyramid.levels[self.looked_at.start].side
    }

    /// The tracks, in voxels of the finest level. Candidates are tracked in batches, each as if it were alone; they are painted in
    /// their order, and who runs into what was painted meanwhile is tracked anew. So threads change nothing.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub(crate) fn tracks(&self, candidates: &[Candidate]) -> Result<Vec<Track>> {
        self.tracks_beside(&[], candidates)
    }

    /// The same, where some tracks are known already: those that are found besides.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Interrupted`].
    pub(crate) fn tracks_beside(&self, known: &[Track], candidates: &[Candidate]) -> Result<Vec<Track>> {
        let Known { mut paint, mut found, mut levels } = self.known(known);
        let (mut next, mut waiting) = (0, VecDeque::new());
        let pieces = self.stages.stage(Stage::Tracks, candidates.len());
        while next < candidates.len() || !waiting.is_empty() {
            go_on(self.stop)?;
            let Batch { candidates: batch, looked_at } =
                self.batch(&paint, &levels, &candidates[next..], &mut waiting);
            next += looked_at;
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
            pieces.done(looked_at);
        }
        found.drain(..known.len());
        Ok(found)
    }

    /// The lumens of some tracks.
    pub(crate) fn painted(&self, tracks: &[Track]) -> Paint {
        self.known(tracks).paint
    }

    /// What is known where some tracks are.
    fn known(&self, tracks: &[Track]) -> Known {
        let mut known = Known { paint: Paint::default(), found: Vec::new(), levels: Vec::new() };
        for track in tracks {
            self.commit(Tried::Kept(track.clone()), &mut known.paint, &mut known.found, &mut known.levels);
        }
        known
    }

    /// The next candidates that are tried beside each other: those that wait, then others. Who lies near one of them waits, as it
    /// may well lie in the same tube.
    fn batch(
        &self,
        paint: &Paint,
        levels: &[f64],
        others: &[Candidate],
        waiting: &mut VecDeque<Candidate>,
    ) -> Batch {
        let mut batch = Batch { candidates: Vec::with_capacity(BATCH), looked_at: 0 };
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
        while batch.candidates.len() < BATCH && batch.looked_at < others.len().min(MOST_LOOKED_AT) {
            let candidate = others[batch.looked_at];
            batch.looked_at += 1;
            take(&mut batch, candidate);
        }
        still.append(waiting);
        *waiting = still;
        batch
    }

    /// Whether a candidate is tried: nothing is painted there, or a darker and narrower lumen.
    fn is_open(&self, paint: &Paint, levels: &[f64], candidate: &Candidate) -> bool {
        match paint.at(candidate.place) {
            Painted::Empty => true,
            Painted::Rejected => false,
            Painted::Lumen(track) => {
                let level = self.pyramid.level_for(candidate.radius, &self.looked_at).at(candidate.place);
                let contrast = candidate.response;
                let is_darker = levels[track as usize] < f64::from(level) - DARKER * contrast;
                is_darker
                    && contrast >= OVER_CONTRAST * self.floors.contrast
                    && candidate.radius < OVER_RADIUS * self.side()
            }
        }
    }

    /// What becomes of a candidate.
    fn tried(&self, paint: &Paint, levels: &[f64], candidate: &Candidate) -> Tried {
        let (looked_at, floors) = (self.looked_at.clone(), self.floors);
        let tracker = Tracker { pyramid: self.pyramid, looked_at, paint, levels, floors };
        // Most candidates are no vessel, which their first steps show.
        let Some(points) = tracker.track(candidate, FIRST_STEPS) else { return Tried::Nothing };
        let Some(first) = self.kept(&points, LEAST_OF_FIRST) else { return Tried::Rejected(points) };
        if points.len() <= FIRST_STEPS {
            // It ended both ways before so many steps: it is whole.
            let is_sure = first.confidence >= LEAST_CONFIDENCE;
            return if is_sure { Tried::Kept(first) } else { Tried::Rejected(points) };
        }
        let Some(points) = tracker.track(candidate, MOST_STEPS) else { return Tried::Nothing };
        self.kept(&points, 1.0).map_or(Tried::Rejected(points), Tried::Kept)
    }

    /// The track of some points, where they are long enough, good, and sure: as sure as `share` of what is asked of a whole track.
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

    /// Paints a track and keeps it, or paints the middle of what is no vessel.
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

/// How far from its middle a track is painted.
fn painted(radius: f64) -> f64 {
    radius
        * match () {
            () if radius < NARROW => PAINTED[0],
            () if radius >= WIDE => PAINTED[1],
            () => PAINTED[2],
        }
}

/// Whether a track lies in the lumen of one that was found after the first `known` ones.
fn meets_new(paint: &Paint, known: usize, tried: &Tried) -> bool {
    let points = match tried {
        Tried::Nothing => return false,
        Tried::Kept(track) => &track.points,
        Tried::Rejected(points) => points,
    };
    let is_new = |place: DVec3| matches!(paint.at(place), Painted::Lumen(n) if n as usize >= known);
    points.iter().any(|point| is_new(point.place))
}
