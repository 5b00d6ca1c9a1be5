//! Each run in the middle of its lumen, outside the lumens of the runs that it begins and ends on.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::trace::find::quantiles::quantile;
use crate::trace::find::scan::Scan;
use crate::trace::find::whole_vessels::graph::WayPoint;
use crate::trace::find::whole_vessels::runs::{Run, Runs};
use crate::trace::find::whole_vessels::way::Way;
use crate::trace::lines::nearest_point::nearest_point;
use crate::trace::lumen::lumen_model::LumenModel;
use crate::trace::lumen::refine::{STEP, refined_near};
use lumencut_core::error::Result;
use lumencut_core::stop::Stop;

/// How many points of another run before and behind a common node may have that run's lumen around them.
const NEAR_POINTS: usize = 200;

/// What is shorter is not centred (mm).
const SHORTEST: f64 = 1.0;

/// By which factor a radius may differ from that of the track.
const OTHER_RADIUS: f64 = 2.0;

/// The shares of the levels along a run below which its lowest and its highest level lie.
const LEVELS: [f64; 2] = [0.1, 0.9];

/// The least contrast of a run, as a share of its usual one.
const LEAST_CONTRAST: f64 = 0.3;

/// A point of a centred run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LinePoint {
    /// Where it lies (mm, LPS).
    pub place: DVec3,
    /// The radius of the lumen (mm).
    pub radius: f64,
    /// How sure it is, 0 to 1.
    pub confidence: f64,
    /// The track that it belongs to.
    pub track: usize,
}

/// A centred run.
#[derive(Clone, Debug)]
pub(crate) struct Centered {
    /// Its points.
    pub points: Vec<LinePoint>,
    /// Whether any of it lies outside the lumens of the runs at its ends; where none does, the points are those of its tracks.
    pub is_outside: bool,
}

/// The run `number` in the middle of its lumen.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub(crate) fn centered(scan: &Scan, runs: &Runs, number: usize, stop: Stop) -> Result<Centered> {
    let way = &runs.runs[number].points;
    let outside = outside(runs, number);
    let is_outside = outside.is_some();
    let way = Way::along(&way[outside.unwrap_or(0..=way.len() - 1)]);
    let line = if is_outside && way.length() >= SHORTEST {
        way.guarded(&refined_near(scan.voxels, &model(scan, &way.points), &way.line, stop)?)
    } else {
        way.line.clone()
    };
    let line = line.resampled(STEP);
    let point = |n: usize| {
        let known = &way.points[nearest_point(&way.line.points, line.points[n])];
        let radius = line.radius[n].clamp(known.radius / OTHER_RADIUS, known.radius * OTHER_RADIUS);
        LinePoint { place: line.points[n], radius, confidence: known.confidence, track: known.track }
    };
    Ok(Centered { points: (0..line.points.len()).map(point).collect(), is_outside })
}

/// The run that a run begins on (0) or ends on (1), and the number of the point there; none at a free end.
pub(crate) fn met(runs: &Runs, number: usize, end: usize) -> Option<(usize, usize)> {
    let run = &runs.runs[number];
    let (node, _) = run.knots[if end == 0 { 0 } else { run.knots.len() - 1 }];
    let owner = runs.owners[node];
    let knot = runs.runs[owner].knots.iter().find(|(known, _)| *known == node)?;
    (owner != number).then_some((owner, knot.1))
}

/// The points of a run outside the lumens of the runs at its ends; none where there are not two.
fn outside(runs: &Runs, number: usize) -> Option<RangeInclusive<usize>> {
    let points = &runs.runs[number].points;
    let is_within = |n: usize, end: usize| {
        met(runs, number, end)
            .is_some_and(|(owner, knot)| lies_within(points[n].place, &runs.runs[owner], knot))
    };
    let first = (0..points.len()).find(|n| !is_within(*n, 0))?;
    let last = (first..points.len()).rev().find(|n| !is_within(*n, 1))?;
    (first < last).then_some(first..=last)
}

/// Whether a place lies in the lumen of a run near one of its points.
fn lies_within(place: DVec3, run: &Run, knot: usize) -> bool {
    let last = (knot + NEAR_POINTS).min(run.points.len() - 1);
    let near = &run.points[knot.saturating_sub(NEAR_POINTS)..=last];
    near.iter().any(|point| point.place.distance_squared(place) < point.radius * point.radius)
}

/// What the lumen looks like along a way.
fn model(scan: &Scan, way: &[WayPoint]) -> LumenModel {
    let of = |value: fn(&WayPoint) -> f64, share: f64| {
        quantile(&mut way.iter().map(value).collect::<Vec<f64>>(), share).unwrap_or(0.0)
    };
    let tissue = of(|point| point.level - point.contrast, 0.5);
    let least = tissue + LEAST_CONTRAST * of(|point| point.contrast, 0.5);
    let [low, high] = LEVELS.map(|share| of(|point| point.level, share).max(least));
    LumenModel { tissue, low, high, noise: scan.noise, is_hounsfield: scan.voxels.has_negative() }
}
