//! Trims runs (lines of vessels) where too narrow, and removes runs that are only bumps in the walls of others.

use crate::trace::find::quantiles::median;
use crate::trace::find::whole_vessels::attached::Attached;
use crate::trace::find::whole_vessels::centered::LinePoint;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Runs that are shorter than this outside their parent's lumen are bumps: radii, and mm.
const SHORTEST_RADII: f64 = 2.0;
const SHORTEST: f64 = 2.0;

/// Number of neighbours on each side from which the median radius is taken.
const NEIGHBORS: usize = 4;

/// Trims runs to a minimum radius (mm). Parts to which other runs are attached are always kept.
pub(crate) fn trimmed(
    mut runs: Vec<Attached>,
    smallest_radius: f64,
    stop: Stop,
) -> Result<Vec<Option<Attached>>> {
    let mut stays = vec![true; runs.len()];
    // In reverse order, most branches are handled before their parents.
    for number in (0..runs.len()).rev() {
        go_on(stop)?;
        let needed = needed(&runs, &stays, number);
        stays[number] = trim(&mut runs[number], needed, smallest_radius);
    }
    Ok(runs.into_iter().zip(stays).map(|(run, stays)| stays.then_some(run)).collect())
}

fn needed(runs: &[Attached], stays: &[bool], number: usize) -> Option<[usize; 2]> {
    let mut found: Option<[usize; 2]> = None;
    for other in (0..runs.len()).filter(|other| stays[*other]) {
        let points = &runs[other].points;
        for (met, point) in runs[other].met.into_iter().zip([&points[0], &points[points.len() - 1]]) {
            if met == Some(number) {
                let at = runs[number].points.iter().position(|own| own.place == point.place).unwrap_or(0);
                found = Some(found.map_or([at, at], |[first, last]| [first.min(at), last.max(at)]));
            }
        }
    }
    found
}

/// Trims the free ends of a run; returns whether the run is kept.
fn trim(run: &mut Attached, needed: Option<[usize; 2]>, smallest_radius: f64) -> bool {
    let [start, end] = run.met;
    if start.is_some() && end.is_some() {
        // A run that joins two others is removed only if it returns to the same run within the same lumen.
        let is_outside = run.leads[0] + run.leads[1] + 1 < run.points.len();
        return start != end || is_outside || needed.is_some();
    }
    let last = run.points.len() - 1;
    let mut range = [0, last];
    if end.is_none() {
        let wide = wide_until(run.points.iter(), smallest_radius);
        range[1] = wide.max(needed.map(|[_, last]| last)).unwrap_or(0);
    }
    if start.is_none() {
        let wide = wide_until(run.points.iter().rev(), smallest_radius).map(|n| last - n);
        let first = [wide, needed.map(|[first, _]| first)].into_iter().flatten().min();
        range[0] = first.unwrap_or(last);
    }
    if needed.is_none() && (range[0] >= range[1] || is_bump(run, range)) {
        return false;
    }
    // At least two points are kept.
    let range =
        if range[0] < range[1] { range } else { [range[0].min(last - 1), range[0].min(last - 1) + 1] };
    run.points.truncate(range[1] + 1);
    run.points.drain(..range[0]);
    true
}

/// Index of the last point up to which a line is wide enough.
fn wide_until<'a>(points: impl Iterator<Item = &'a LinePoint>, smallest_radius: f64) -> Option<usize> {
    let radii: Vec<f64> = points.map(|point| point.radius).collect();
    let last = radii.len() - 1;
    let is_wide =
        |n: &usize| usual(&radii[n.saturating_sub(NEIGHBORS)..=(n + NEIGHBORS).min(last)]) >= smallest_radius;
    (0..radii.len()).rev().find(is_wide)
}

fn is_bump(run: &Attached, [first, last]: [usize; 2]) -> bool {
    let from = first.max(run.leads[0]);
    let to = last.min(run.points.len() - 1 - run.leads[1]);
    if from >= to {
        return true;
    }
    let outside = &run.points[from..=to];
    let length: f64 = outside.windows(2).map(|pair| pair[0].place.distance(pair[1].place)).sum();
    let radii: Vec<f64> = outside.iter().map(|point| point.radius).collect();
    length < SHORTEST.max(SHORTEST_RADII * usual(&radii))
}

fn usual(radii: &[f64]) -> f64 {
    median(&mut radii.to_vec()).unwrap_or(0.0)
}
