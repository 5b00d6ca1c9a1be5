//! Centres the part of each run (line of a vessel) that lies outside the lumens of the runs that it meets.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::trace::find::quantiles::quantile;
use crate::trace::find::scan::Scan;
use crate::trace::find::whole_vessels::graph::WayPoint;
use crate::trace::find::whole_vessels::run_path::Way;
use crate::trace::find::whole_vessels::runs::{Run, Runs};
use crate::trace::lines::nearest_point;
use crate::trace::lumen::lumen_model::{LumenModel, tissue_beside};
use crate::trace::lumen::refine::{STEP, refined_near};
use crate::trace::lumen::ridge::on_ridge;
use lumencut_core::error::Result;
use lumencut_core::stop::Stop;

/// Number of points of a run that is met, on each side of the meeting point, whose lumens are checked.
const NEAR_POINTS: usize = 200;

/// Minimum length of a part that is centred (mm).
const SHORTEST: f64 = 1.0;

/// The refined radius differs from the tracked one by at most this factor.
const OTHER_RADIUS: f64 = 2.0;

/// Quantiles of the levels along a run; they bound the lumen values.
const LEVELS: [f64; 2] = [0.1, 0.9];

/// Minimum contrast of a lumen value, relative to the median contrast.
const LEAST_CONTRAST: f64 = 0.3;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LinePoint {
    pub place: DVec3,
    pub radius: f64,
    pub confidence: f64,
    pub track: usize,
}

#[derive(Clone, Debug)]
pub(crate) struct Centered {
    pub points: Vec<LinePoint>,
    /// Whether part of the run lies outside the lumens that it meets. If not, the points are those of the tracks.
    pub is_outside: bool,
}

pub(crate) fn centered(scan: &Scan, runs: &Runs, number: usize, stop: Stop) -> Result<Centered> {
    let way = &runs.runs[number].points;
    let outside = outside(runs, number);
    let is_outside = outside.is_some();
    let way = Way::along(&way[outside.unwrap_or(0..=way.len() - 1)]);
    let line = if is_outside && way.length() >= SHORTEST {
        let model = model(scan, &way.points);
        let line = way.guarded(&refined_near(scan.voxels, &model, &way.line, stop)?);
        on_ridge(scan.voxels, model.tissue, line, stop)?
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

/// The run met at the start (`end` 0) or end (1), and the index of its point; None at a free end.
pub(crate) fn met(runs: &Runs, number: usize, end: usize) -> Option<(usize, usize)> {
    let run = &runs.runs[number];
    let (node, _) = run.knots[if end == 0 { 0 } else { run.knots.len() - 1 }];
    let owner = runs.owners[node];
    let knot = runs.runs[owner].knots.iter().find(|(known, _)| *known == node)?;
    (owner != number).then_some((owner, knot.1))
}

/// The points of a run outside the lumens of the runs that its ends meet; None if there are fewer than two.
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

fn lies_within(place: DVec3, run: &Run, knot: usize) -> bool {
    let last = (knot + NEAR_POINTS).min(run.points.len() - 1);
    let near = &run.points[knot.saturating_sub(NEAR_POINTS)..=last];
    near.iter().any(|point| point.place.distance_squared(place) < point.radius * point.radius)
}

fn model(scan: &Scan, way: &[WayPoint]) -> LumenModel {
    let of = |value: fn(&WayPoint) -> f64, share: f64| {
        quantile(&mut way.iter().map(value).collect::<Vec<f64>>(), share).unwrap_or(0.0)
    };
    let tissue = of(|point| point.level - point.contrast, 0.5);
    let tissue = tissue_beside(scan.voxels.polarity, scan.level, tissue);
    let least = tissue + LEAST_CONTRAST * of(|point| point.contrast, 0.5);
    let [low, high] = LEVELS.map(|share| of(|point| point.level, share).max(least));
    let (is_hounsfield, polarity) = (scan.voxels.has_negative(), scan.voxels.polarity);
    LumenModel { tissue, low, high, noise: scan.noise, is_hounsfield, polarity }
}
