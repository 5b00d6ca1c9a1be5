//! The tubes of a scan: in a first pass those that tell the usual level of its vessels, in a second one all of them.

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::candidates::{Candidate, Floors, candidates, noise};
use crate::trace::find::confidence::{UsualVessels, confidence};
use crate::trace::find::grid::Grid;
use crate::trace::find::paint::{Paint, Painted};
use crate::trace::find::pyramid::Pyramid;
use crate::trace::find::scan::Scan;
use crate::trace::find::section::median_of;
use crate::trace::find::track::{Track, TrackPoint};
use crate::trace::find::tracker::{DARKER, Tracker};
use crate::trace::find::vessel_level::vessel_level;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// In scans with values below the first one those below the second one tell nothing of vessels: fat, lung and air (HU).
const AIR: f64 = -200.0;
const WATER: f64 = 0.0;

/// The share of the voxels that is not brighter than what is looked at in the first pass, and about how many are looked at for it.
const BRIGHTEST: f64 = 0.999;
const SAMPLES: usize = 400_000;

/// In the second pass nothing is brighter than the usual level by more than this part of the contrast: struts, calcium and bone
/// are no brighter than a vessel can be.
const ABOVE: f64 = 0.25;

/// A track is at least so many radii and so many voxels long, and this share of its sections is good.
const LEAST_RADII: f64 = 3.0;
const LEAST_VOXELS: f64 = 5.0;
const LEAST_GOOD: f64 = 0.6;

/// Tracks of less confidence are left out.
const LEAST_CONFIDENCE: f64 = 0.3;

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

/// What one pass looks at.
struct Pass<'a> {
    pyramid: &'a Pyramid,
    /// The number of the finest level that is looked at.
    first: usize,
    floors: Floors,
    stop: Stop<'a>,
    /// How sure a track is; none where it is left out.
    judge: &'a (dyn Fn(Vec<TrackPoint>) -> Option<Track> + Sync),
}

/// The tubes of a scan and what is known of its vessels; none where nothing is a tube.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn tubes<'v>(
    voxels: &'v Voxels<'v>,
    smallest_radius: f64,
    stop: Stop,
) -> Result<Option<(Scan<'v>, Vec<Track>)>> {
    let range = range(voxels);
    if range[1] <= range[0] {
        return Ok(None);
    }
    let mut pyramid = Pyramid::new(voxels, Grid::over(voxels, smallest_radius), range, stop)?;
    let Some([level, contrast]) = usual(&pyramid, stop)? else { return Ok(None) };
    pyramid.clamp((level + ABOVE * contrast).min(range[1]), stop)?;
    let noise = noise(&pyramid.levels[0]);
    let floors = Floors { noise, contrast };
    let vessels = UsualVessels { level, contrast };
    let judge = |points: Vec<TrackPoint>| {
        let (confidence, doubt) = confidence(&pyramid, voxels, &points, &vessels);
        (confidence >= LEAST_CONFIDENCE).then_some(Track { points, confidence, doubt })
    };
    let pass = Pass { pyramid: &pyramid, first: 0, floors, stop, judge: &judge };
    let tracks = pass.tracks()?.into_iter().map(|track| in_world(&pyramid.grid, track)).collect();
    let scan = Scan { voxels, side: pyramid.grid.side, lowest: range[0], level, contrast, noise };
    Ok(Some((scan, tracks)))
}

/// The range of values that tell something of vessels.
fn range(voxels: &Voxels) -> [f64; 2] {
    let count: usize = voxels.size.iter().product();
    let step = count.div_ceil(SAMPLES) | 1;
    let value = |n: usize| {
        let [nx, ny, _] = voxels.size;
        voxels.voxel([n % nx, n / nx % ny, n / (nx * ny)].map(|c| c as i32))
    };
    let mut values: Vec<f32> =
        (0..count).into_par_iter().step_by(step).map(value).filter(|value| value.is_finite()).collect();
    if values.is_empty() {
        return [0.0; 2];
    }
    values.sort_unstable_by(f32::total_cmp);
    let highest = f64::from(values[((values.len() - 1) as f64 * BRIGHTEST) as usize]);
    let lowest = f64::from(values[0]);
    [if lowest < AIR { WATER } else { lowest }, highest]
}

/// The usual level and contrast of the vessels, from the tubes at half the resolution.
fn usual(pyramid: &Pyramid, stop: Stop) -> Result<Option<[f64; 2]>> {
    let first = usize::from(pyramid.levels.len() > 1);
    let noise = noise(&pyramid.levels[first]);
    let floors = Floors { noise, contrast: 0.0 };
    let judge = |points: Vec<TrackPoint>| Some(Track { points, confidence: 1.0, doubt: None });
    let pass = Pass { pyramid, first, floors, stop, judge: &judge };
    let tracks: Vec<Vec<TrackPoint>> = pass.tracks()?.into_iter().map(|track| track.points).collect();
    Ok(vessel_level(&tracks, noise))
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

impl Pass<'_> {
    /// The tracks, in voxels of the finest level. Candidates are tracked in batches, each as if it were alone; they are painted in
    /// their order, and who runs into what was painted meanwhile is tracked anew. So threads change nothing.
    fn tracks(&self) -> Result<Vec<Track>> {
        let candidates = candidates(self.pyramid, self.first, &self.floors, self.stop)?;
        let (mut found, mut levels) = (Vec::new(), Vec::new());
        let mut paint = Paint::default();
        let mut next = 0;
        while next < candidates.len() {
            go_on(self.stop)?;
            let mut batch = Vec::with_capacity(BATCH);
            while next < candidates.len() && batch.len() < BATCH {
                if self.is_open(&paint, &levels, &candidates[next]) {
                    batch.push(candidates[next]);
                }
                next += 1;
            }
            let tried: Vec<Tried> =
                batch.par_iter().map(|candidate| self.tried(&paint, &levels, candidate)).collect();
            let known = found.len();
            for (candidate, tried) in batch.iter().zip(tried) {
                if !self.is_open(&paint, &levels, candidate) {
                    continue;
                }
                let tried = if meets_new(&paint, known, &tried) {
                    self.tried(&paint, &levels, candidate)
                } else {
                    tried
                };
                self.commit(tried, &mut paint, &mut found, &mut levels);
            }
        }
        Ok(found)
    }

    /// Whether a candidate is tried: nothing is painted there, or a darker and narrower lumen.
    fn is_open(&self, paint: &Paint, levels: &[f64], candidate: &Candidate) -> bool {
        match paint.at(candidate.place) {
            Painted::Empty => true,
            Painted::Rejected => false,
            Painted::Lumen(track) => {
                let level = self.pyramid.level_for(candidate.radius, self.first).at(candidate.place);
                let contrast = candidate.response;
                let is_darker = levels[track as usize] < f64::from(level) - DARKER * contrast;
                is_darker
                    && contrast >= OVER_CONTRAST * self.floors.contrast
                    && candidate.radius < OVER_RADIUS * self.pyramid.levels[self.first].side
            }
        }
    }

    /// What becomes of a candidate.
    fn tried(&self, paint: &Paint, levels: &[f64], candidate: &Candidate) -> Tried {
        let tracker =
            Tracker { pyramid: self.pyramid, first: self.first, paint, levels, floors: self.floors };
        let Some(points) = tracker.track(candidate) else { return Tried::Nothing };
        let length: f64 = points.windows(2).map(|pair| pair[0].place.distance(pair[1].place)).sum();
        let radius = median_radius(&points);
        let good = points.iter().filter(|point| point.is_good).count() as f64;
        let side = self.pyramid.levels[self.first].side;
        let is_long = length >= (LEAST_RADII * radius).max(LEAST_VOXELS * side);
        if points.len() < 2 || !is_long || good < LEAST_GOOD * points.len() as f64 {
            return Tried::Rejected(points);
        }
        (self.judge)(points.clone()).map_or(Tried::Rejected(points), Tried::Kept)
    }

    /// Paints a track and keeps it, or paints the middle of what is no vessel.
    fn commit(&self, tried: Tried, paint: &mut Paint, found: &mut Vec<Track>, levels: &mut Vec<f64>) {
        match tried {
            Tried::Nothing => (),
            Tried::Rejected(points) => {
                for point in &points {
                    paint.rejected(point.place, THIN * self.pyramid.levels[self.first].side);
                }
            }
            Tried::Kept(track) => {
                let number = found.len() as u32;
                let level = median_of(&mut track.points.iter().map(|p| p.level).collect::<Vec<_>>());
                let contrast = median_of(&mut track.points.iter().map(|p| p.contrast).collect::<Vec<_>>());
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

fn median_radius(points: &[TrackPoint]) -> f64 {
    median_of(&mut points.iter().map(|point| point.radius).collect::<Vec<_>>())
}

/// A track whose lengths are mm and whose places are those of the world.
fn in_world(grid: &Grid, mut track: Track) -> Track {
    for point in &mut track.points {
        point.place = grid.world(point.place);
        point.direction = grid.world_from_grid.transform_vector3(point.direction).normalize_or_zero();
        point.radius *= grid.side;
    }
    track
}
