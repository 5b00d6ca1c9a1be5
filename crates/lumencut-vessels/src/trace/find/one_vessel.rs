//! Finds the complete vessel at a click: back to the nearest existing vessel, and forward to the vessel's end.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::trace::find::found::{NoVessel, Trees};
use crate::trace::find::from_seed::vessel_at;
use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::nearest_point;
use crate::trace::lumen::within::holds;

/// Points less than this far apart (mm) differ only by rounding.
const SAME_POINT_MM: f64 = 1e-6;

/// The vessel that contains a click (mm, LPS): the nearest one in radii, sure ones first. It starts on an
/// existing vessel (`beside`) if its ancestors lead to one, otherwise where it leaves its parent. It ends at
/// its own end, or where it enters an existing vessel. `voxel` is the voxel side (mm). Errors: [`NoVessel`]
/// for a click in no vessel, or in an existing one, or if nothing longer than wide would be added.
pub fn one_vessel(
    trees: &Trees,
    click: DVec3,
    voxel: f64,
    beside: &[Centerline],
) -> Result<Centerline, NoVessel> {
    if beside.iter().any(|vessel| holds(vessel, click)) {
        return Err(NoVessel::Already);
    }
    let number = vessel_at(trees, click, voxel, |vessel| vessel.doubt.is_none())
        .map_err(|(_, distance)| NoVessel::NotHere(distance))?;
    let own = &trees.vessels[number].line;
    let (before, whole) = with_ancestors(trees, number);
    let at = before + nearest_point(&own.points, click);
    let met = |n: &usize| meets(beside, whole.points[*n]);
    let first = (0..at).rev().find(met).or_else(|| meets(beside, whole.points[at]).then_some(at));
    let last = (at + 1..whole.points.len()).find(met);
    let range = first.unwrap_or(before)..=last.unwrap_or(whole.points.len() - 1);
    let is_joined = first.is_some() || last.is_some();
    if is_joined && length_outside(&whole, range.clone(), met) < 2.0 * whole.radius[at] {
        return Err(NoVessel::Already);
    }
    let mut line = Centerline {
        points: whole.points[range.clone()].to_vec(),
        radius: whole.radius[range.clone()].to_vec(),
        confidence: whole.confidence[range].to_vec(),
    };
    let end = line.points.len() - 1;
    for (end, is_met) in [(0, first.is_some()), (end, last.is_some())] {
        if is_met {
            line.points[end] = nearest_of(beside, line.points[end]);
        }
    }
    Ok(line)
}

/// The vessel after its ancestors in one line, and the number of points of the ancestors.
fn with_ancestors(trees: &Trees, number: usize) -> (usize, Centerline) {
    let mut whole = trees.vessels[number].line.clone();
    let (mut before, mut of) = (0, number);
    let mut is_left = vec![false; trees.vessels.len()];
    while let Some((parent, left_at)) = parent(trees, of).filter(|(parent, _)| !is_left[*parent]) {
        is_left[of] = true;
        let line = &trees.vessels[parent].line;
        let mut way = Centerline {
            points: line.points[..left_at].to_vec(),
            radius: line.radius[..left_at].to_vec(),
            confidence: line.confidence[..left_at].to_vec(),
        };
        before += left_at;
        way.append(whole);
        (whole, of) = (way, parent);
    }
    (before, whole)
}

fn parent(trees: &Trees, number: usize) -> Option<(usize, usize)> {
    let child = &trees.vessels[number];
    let start = child.line.points[0];
    let others = trees.vessels.iter().enumerate();
    others.filter(|(n, other)| *n != number && other.part == child.part).find_map(|(n, other)| {
        let points = &other.line.points;
        let at = nearest_point(points, start);
        // If two vessels start at the same point, neither is the parent of the other.
        (at > 0 && points[at].distance(start) <= SAME_POINT_MM).then_some((n, at))
    })
}

/// Whether a position lies in or on a vessel. Its ends do not count, because another vessel may continue there.
fn meets(beside: &[Centerline], place: DVec3) -> bool {
    beside.iter().any(|vessel| {
        let (points, last) = (&vessel.points, vessel.points.len() - 1);
        let near = points[nearest_point(points, place)];
        let is_at = |end: usize| near.distance(points[end]) <= vessel.radius[end].max(SAME_POINT_MM);
        (near.distance(place) <= SAME_POINT_MM || holds(vessel, place)) && !is_at(0) && !is_at(last)
    })
}

/// Length of a part of a line that does not lie in existing vessels (mm). If it is shorter than wide, it is the rim of one.
fn length_outside(line: &Centerline, part: RangeInclusive<usize>, met: impl Fn(&usize) -> bool) -> f64 {
    let steps = part.clone().zip(part.skip(1)).filter(|(a, b)| !(met(a) && met(b)));
    steps.map(|(a, b)| line.points[a].distance(line.points[b])).sum()
}

fn nearest_of(beside: &[Centerline], place: DVec3) -> DVec3 {
    let points = beside.iter().map(|vessel| vessel.points[nearest_point(&vessel.points, place)]);
    points.min_by(|a, b| a.distance(place).total_cmp(&b.distance(place))).unwrap_or(place)
}
