//! Finds the tubes of a scan: a first pass estimates the vessel level, a second pass finds all tubes.

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::all_tracks::Tracking;
use crate::trace::find::bone::{self, Shape};
use crate::trace::find::candidates::{Floors, candidates_near, noise};
use crate::trace::find::confidence::{UsualVessels, confidence};
use crate::trace::find::from_seed::SELECT_RADII;
use crate::trace::find::grid::Grid;
use crate::trace::find::inside_wide::hidden;
use crate::trace::find::progress::{Stage, Stages};
use crate::trace::find::pyramid::Pyramid;
use crate::trace::find::scan::Scan;
use crate::trace::find::side_by_side::side_by_side;
use crate::trace::find::track::{Track, TrackPoint};
use crate::trace::find::vessel_level::{Readings, UsualLevel, vessel_level};
use crate::trace::lumen::lumen_model::holds_air;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::polarity::Polarity;
use lumencut_core::stop::Stop;

/// If a scan has values below `AIR` (HU), its values below `WATER` (fat, lung and air) are raised to `WATER`.
const AIR: f64 = -200.0;
const WATER: f64 = 0.0;

/// If the usual lumens hold air (HU), the second pass reads only values up to this: fat and soft tissue look alike.
const AROUND_AIR: f64 = -500.0;

/// Quantile that caps the values of the first pass, and number of samples from which it is taken.
const BRIGHTEST: f64 = 0.999;
const SAMPLES: usize = 400_000;

/// The second pass caps values this far above the vessel level (fraction of the contrast): struts, calcium and bone.
const ABOVE: f64 = 0.25;

/// Contrast that the first pass assumes, as a fraction of the value range.
const FIRST_CONTRAST: f64 = 0.3;

pub(crate) struct Tubes<'v> {
    pub scan: Scan<'v>,
    /// Another level and contrast, if one of two readings is far paler.
    pub other: Option<[f64; 2]>,
    pub tracks: Vec<Track>,
    /// Shape of each track in the raw voxels.
    pub shapes: Vec<Option<Shape>>,
}

/// The tubes of a scan, if any. If no track contains the seed (mm, LPS), fainter tubes are found around it.
pub(crate) fn tubes<'v>(
    voxels: &'v Voxels<'v>,
    grid: Grid,
    seed: Option<DVec3>,
    stop: Stop,
    stages: Stages,
) -> Result<Option<Tubes<'v>>> {
    let Range { values: range, is_hounsfield } = range(voxels);
    if range[1] <= range[0] {
        return Ok(None);
    }
    stages.stage(Stage::Levels, 1);
    let mut pyramid = Pyramid::new(voxels, grid, range, stop)?;
    stages.stage(Stage::FirstPass, 1);
    let Some([level, contrast]) = usual(&pyramid, range[1] - range[0], stop)? else { return Ok(None) };
    let lowest = lowest_beside(voxels.polarity, level).map_or(range[0], |lowest| lowest.max(range[0]));
    let contrast = contrast.min(level - lowest);
    pyramid.clamp([lowest, (level + ABOVE * contrast).min(range[1])], stop)?;
    let noise = noise(&pyramid.levels[0]);
    let side = pyramid.grid.side;
    let scan = Scan { voxels, side, lowest, level, contrast, noise, is_hounsfield };
    let floors = Floors { noise, contrast };
    let vessels = UsualVessels { level, contrast };
    let judge = |points: Vec<TrackPoint>| {
        let (confidence, doubt) = confidence(&pyramid, voxels, &points, &vessels);
        Track { points, confidence, doubt }
    };
    let pass =
        Tracking { pyramid: &pyramid, levels_examined: pyramid.all(), floors, stop, judge: &judge, stages };
    of_pass(&pass, scan, seed.map(|seed| pyramid.grid.grid_from_world.transform_point3(seed))).map(Some)
}

/// The tubes that the second pass finds; `seed` is in finest-level voxels.
fn of_pass<'v>(pass: &Tracking, scan: Scan<'v>, seed: Option<DVec3>) -> Result<Tubes<'v>> {
    let candidates = pass.candidates()?;
    let mut tracks = pass.tracks(&candidates)?;
    tracks.extend(side_by_side(pass, &candidates, &tracks)?);
    let mut found = Tubes { scan, other: None, tracks: Vec::new(), shapes: Vec::new() };
    found.add(pass, &tracks, pass.stages)?;
    let Readings { usual, other } = bone::readings(&found.scan, &found.tracks, &found.shapes);
    [found.scan.level, found.scan.contrast] = usual;
    found.other = other;
    let judged = bone::judged(&found.scan, found.tracks.clone(), &found.shapes, pass.stop)?;
    let hidden = hidden(pass, &candidates, &tracks, &judged)?;
    found.add(pass, &hidden, Stages::default())?;
    tracks.extend(hidden);
    if let Some(seed) = seed {
        found.add(pass, &from_seed(pass, seed, &tracks)?, Stages::default())?;
    }
    Ok(found)
}

impl Tubes<'_> {
    fn add(&mut self, pass: &Tracking, tracks: &[Track], stages: Stages) -> Result<()> {
        let tracks: Vec<Track> =
            tracks.iter().map(|track| in_world(&pass.pyramid.grid, track.clone())).collect();
        self.shapes.extend(bone::shapes(&self.scan, &tracks, pass.stop, stages)?);
        self.tracks.extend(tracks);
        Ok(())
    }
}

/// The lowest value that counts beside lumens of a level, both as they are traced; None for all values.
fn lowest_beside(polarity: Polarity, level: f64) -> Option<f64> {
    holds_air(polarity, level).then(|| polarity.turned(AROUND_AIR))
}

struct Range {
    values: [f64; 2],
    /// Whether some values are as low as those of air.
    is_hounsfield: bool,
}

fn range(voxels: &Voxels) -> Range {
    let count: usize = voxels.size.iter().product();
    let step = count.div_ceil(SAMPLES) | 1;
    let value = |n: usize| {
        let [nx, ny, _] = voxels.size;
        voxels.voxel([n % nx, n / nx % ny, n / (nx * ny)].map(|c| c as i32))
    };
    let mut values: Vec<f32> =
        (0..count).into_par_iter().step_by(step).map(value).filter(|value| value.is_finite()).collect();
    if values.is_empty() {
        return Range { values: [0.0; 2], is_hounsfield: false };
    }
    values.sort_unstable_by(f32::total_cmp);
    let highest = f64::from(values[((values.len() - 1) as f64 * BRIGHTEST) as usize]);
    let lowest = f64::from(values[0]);
    let is_hounsfield = lowest < AIR;
    Range { values: [if is_hounsfield { WATER } else { lowest }, highest], is_hounsfield }
}

fn usual(pyramid: &Pyramid, range: f64, stop: Stop) -> Result<Option<[f64; 2]>> {
    let half = usize::from(pyramid.levels.len() > 1);
    let of_half = usual_from(pyramid, half, range, stop)?;
    if half == 0 || of_half.is_none_or(|found| found.is_wide) {
        return Ok(of_half.map(|found| found.level));
    }
    // Half the resolution dims narrow vessels.
    Ok(usual_from(pyramid, 0, range, stop)?.or(of_half).map(|found| found.level))
}

fn usual_from(pyramid: &Pyramid, first: usize, range: f64, stop: Stop) -> Result<Option<UsualLevel>> {
    let noise = noise(&pyramid.levels[first]);
    let floors = Floors { noise, contrast: FIRST_CONTRAST * range };
    let judge = |points: Vec<TrackPoint>| Track { points, confidence: 1.0, doubt: None };
    let levels_examined = first..pyramid.levels.len();
    let pass = Tracking { pyramid, levels_examined, floors, stop, judge: &judge, stages: Stages::default() };
    let found = pass.tracks(&pass.candidates()?)?;
    let tracks: Vec<Vec<TrackPoint>> = found.into_iter().map(|track| track.points).collect();
    Ok(vessel_level(&tracks, noise))
}

fn in_world(grid: &Grid, mut track: Track) -> Track {
    for point in &mut track.points {
        point.place = grid.world(point.place);
        point.direction = grid.world_from_grid.transform_vector3(point.direction).normalize_or_zero();
        point.radius *= grid.side;
    }
    track
}

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
#[path = "tests/tubes.rs"]
mod tests;

#[cfg(test)]
#[path = "tests/tubes_at_seed.rs"]
mod from_seed_tests;
