//! Attaches the ends of runs (lines of vessels) to bit-identical points of other runs.

use glam::DVec3;

use crate::trace::find::whole_vessels::centered::{Centered, LinePoint, met};
use crate::trace::find::whole_vessels::runs::Runs;
use crate::trace::lines::even_steps::in_even_steps;
use crate::trace::lumen::refine::STEP;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Number of segments of the curve that leads a run out of another lumen.
const BEND: usize = 16;

#[derive(Clone, Debug)]
pub(crate) struct Attached {
    pub points: Vec<LinePoint>,
    /// The run met at the start, and at the end; None at a free end.
    pub met: [Option<usize>; 2],
    /// Number of points, at the start and at the end, between the centre and the wall of the run that is met there.
    pub leads: [usize; 2],
}

pub(crate) fn attached(
    runs: &Runs,
    places: &[DVec3],
    lines: &[Centered],
    stop: Stop,
) -> Result<Vec<Attached>> {
    let mut made: Vec<Attached> = lines
        .iter()
        .map(|line| Attached { points: line.points.clone(), met: [None; 2], leads: [0; 2] })
        .collect();
    for number in 0..made.len() {
        go_on(stop)?;
        let joint = |end: usize| {
            let (owner, knot) = met(runs, number, end)?;
            let knots = &runs.runs[number].knots;
            let (node, _) = knots[if end == 0 { 0 } else { knots.len() - 1 }];
            let last = runs.runs[owner].points.len() - 1;
            Some((owner, joint(&made[owner].points, knot, last, places[node])))
        };
        let [start, end] = [joint(0), joint(1)];
        let joints = [start, end].map(|met| met.map(|(_, point)| point));
        let run = &mut made[number];
        run.met = [start, end].map(|met| met.map(|(owner, _)| owner));
        if lines[number].is_outside {
            lead_out(run, joints[0], 0);
            run.points.reverse();
            lead_out(run, joints[1], 1);
            run.points.reverse();
        } else {
            lie_within(run, joints);
        }
    }
    for number in 0..made.len() {
        go_on(stop)?;
        share_ends(&mut made, number);
    }
    Ok(made)
}

/// The point where another line meets this one: an end if `knot` is 0 or `last`, otherwise the point nearest to `place`.
fn joint(points: &[LinePoint], knot: usize, last: usize, place: DVec3) -> LinePoint {
    let away = |point: &&LinePoint| point.place.distance_squared(place);
    let nearest = points.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    let end = if knot == 0 { points.first() } else { points.last().filter(|_| knot == last) };
    end.or(nearest).copied().unwrap_or(points[0])
}

fn lead_out(run: &mut Attached, joint: Option<LinePoint>, end: usize) {
    let Some(joint) = joint else { return };
    let from = run.points[0];
    let way = from.place.distance(joint.place);
    let outside = run.points[3.min(run.points.len() - 1)].place - from.place;
    // A quadratic Bézier curve that is tangent to the run at the wall.
    let control = from.place - outside.normalize_or_zero() * (way / 2.0);
    let bend = |n: usize| {
        let t = n as f64 / BEND as f64;
        joint.place.lerp(control, t).lerp(control.lerp(from.place, t), t)
    };
    let places = in_even_steps(&(0..=BEND).map(bend).collect::<Vec<_>>(), STEP);
    let count = places.len() - 1;
    let confidence = from.confidence.min(joint.confidence);
    let point =
        |n: usize| LinePoint { place: if n == 0 { joint.place } else { places[n] }, confidence, ..from };
    if way > 0.0 {
        run.points.splice(0..0, (0..count).map(point));
        run.leads[end] = count;
    } else {
        run.points[0].place = joint.place;
    }
}

fn lie_within(run: &mut Attached, joints: [Option<LinePoint>; 2]) {
    let last = run.points.len() - 1;
    for (joint, n) in joints.into_iter().zip([0, last]) {
        if let Some(joint) = joint {
            run.points[n].place = joint.place;
        }
    }
    if let [Some(from), Some(to)] = joints {
        let count = (from.place.distance(to.place) / STEP).ceil().max(1.0) as usize;
        let (first, end) = (run.points[0], run.points[last]);
        let point =
            |n: usize| LinePoint { place: from.place.lerp(to.place, n as f64 / count as f64), ..first };
        run.points = (0..count).map(point).collect();
        run.points.push(end);
        run.points[0].place = from.place;
    }
    // The entire run lies inside another lumen.
    run.leads[usize::from(run.met[0].is_none())] = run.points.len() - 1;
}

/// Inserts the end points of a run into the runs that it meets, because these runs may have moved since.
fn share_ends(runs: &mut [Attached], number: usize) {
    for end in 0..2 {
        let Some(owner) = runs[number].met[end] else { continue };
        let last = runs[number].points.len() - 1;
        let place = runs[number].points[if end == 0 { 0 } else { last }].place;
        let points = &runs[owner].points;
        if points.iter().any(|point| point.place == place) {
            continue;
        }
        let away = |n: &usize| points[*n].place.distance(place) + points[n + 1].place.distance(place);
        let segments = 0..points.len() - 1;
        let Some(before) = segments.min_by(|a, b| away(a).total_cmp(&away(b))) else { continue };
        let inserted = LinePoint { place, ..points[before] };
        runs[owner].points.insert(before + 1, inserted);
        if before < runs[owner].leads[0] {
            runs[owner].leads[0] += 1;
        }
    }
}
