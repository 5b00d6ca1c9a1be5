//! Cuts a line in two, and joins two lines.

use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::math::same_place::ALONG_LINE;
use lumencut_vessels::trace::lumen::refine::STEP;

use crate::study::lines::{Line, wrong};

/// Ends within this distance (mm) are one point. It is larger than the rounding of files and much smaller than any lumen.
pub(crate) const MEETING: f64 = 0.1;

/// Ends can be joined up to this distance (mm), or this many radii of the wider one. Tracing without bridging reaches as far.
const MAX_JOIN_MM: f64 = 5.0;
const MAX_JOIN_RADII: f64 = 2.0;

/// The largest distance of points in the gap between joined ends (mm).
const GAP_STEP: f64 = STEP;

#[derive(Clone, Copy)]
pub(super) struct Knot {
    pub point: DVec3,
    radius: f64,
    confidence: f64,
    is_bridged: bool,
    is_by_hand: bool,
}

impl Knot {
    fn between(self, other: Self, share: f64) -> Self {
        let mixed = |from: f64, to: f64| from + (to - from) * share;
        Self {
            point: self.point.lerp(other.point, share),
            radius: mixed(self.radius, other.radius),
            confidence: mixed(self.confidence, other.confidence),
            is_bridged: self.is_bridged && other.is_bridged,
            is_by_hand: self.is_by_hand || other.is_by_hand,
        }
    }
}

/// The two parts of a line cut at an arc length (mm); both contain the cut point. Fails with an error of kind `vessel
/// tree` for a place that is not between the ends.
pub fn cut(line: &Line, at: f64) -> Result<[Line; 2]> {
    let lengths = arc_lengths(&line.points);
    let whole = lengths[lengths.len() - 1];
    if !(at > ALONG_LINE && at < whole - ALONG_LINE) {
        let expected = format!("a place between its ends, more than 0 and less than {whole:.3} mm along it");
        return Err(wrong("cut", format!("a cut at {at:.3} mm"), &expected));
    }
    let knots = knots(line);
    let after = lengths.partition_point(|length| *length < at - ALONG_LINE);
    let (middle, second) = if lengths[after] <= at + ALONG_LINE {
        (knots[after], after + 1)
    } else {
        let share = (at - lengths[after - 1]) / (lengths[after] - lengths[after - 1]);
        (knots[after - 1].between(knots[after], share), after)
    };
    let parts = [[&knots[..after], &[middle]].concat(), [&[middle], &knots[second..]].concat()];
    Ok(parts.map(|part| with_knots(&part, line)))
}

/// Joins two lines at their nearest ends; the result has the direction of the first line. A gap is closed by a
/// straight stretch that is marked as bridged. Fails with an error of kind `vessel tree` if the ends are too far
/// apart.
pub fn join(first: &Line, second: &Line) -> Result<Line> {
    let (mut one, mut other) = (knots(first), knots(second));
    let end = |knots: &[Knot], is_last: bool| knots[if is_last { knots.len() - 1 } else { 0 }];
    let apart = |[a, b]: [bool; 2]| end(&one, a).point.distance(end(&other, b).point);
    let pairs = [[true, false], [true, true], [false, true], [false, false]];
    let nearest = pairs.into_iter().min_by(|a, b| apart(*a).total_cmp(&apart(*b))).unwrap_or_default();
    let distance = apart(nearest);
    let radius = end(&one, nearest[0]).radius.max(end(&other, nearest[1]).radius);
    let farthest = MAX_JOIN_MM.max(MAX_JOIN_RADII * radius);
    if distance > farthest {
        let found = format!("ends that are {distance:.1} mm apart");
        let expected = format!("ends that are at most {farthest:.1} mm apart");
        let error = wrong("join", found, &expected);
        return Err(error.mend("trace the stretch between them first, and join it to both"));
    }
    // The second line follows the end of the first line, or precedes its start.
    let [is_at_end, other_is_at_end] = nearest;
    if is_at_end == other_is_at_end {
        other.reverse();
    }
    if !is_at_end {
        std::mem::swap(&mut one, &mut other);
    }
    let joined = followed(one, &other);
    let has = Line {
        points: Vec::new(),
        radius: first.radius.clone().or_else(|| second.radius.clone()),
        confidence: first.confidence.clone().or_else(|| second.confidence.clone()),
        bridged: first
            .bridged
            .clone()
            .or_else(|| second.bridged.clone())
            .or((distance > GAP_STEP).then(Vec::new)),
        by_hand: first.by_hand.clone().or_else(|| second.by_hand.clone()),
    };
    Ok(with_knots(&joined, &has))
}

/// Concatenates points. A shared point is taken only from the first line; new points fill a gap.
pub(super) fn followed(mut one: Vec<Knot>, other: &[Knot]) -> Vec<Knot> {
    let end = one[one.len() - 1];
    let is_shared = end.point.distance(other[0].point) <= MEETING;
    if !is_shared {
        one.extend(gap(end, other[0]));
    }
    one.extend_from_slice(&other[usize::from(is_shared)..]);
    one
}

fn gap(from: Knot, to: Knot) -> Vec<Knot> {
    let parts = (from.point.distance(to.point) / GAP_STEP).ceil() as usize;
    let unseen =
        |n: usize| Knot { confidence: 0.0, is_bridged: true, ..from.between(to, n as f64 / parts as f64) };
    (1..parts).map(unseen).collect()
}

/// The points of a line with their data; the confidence is full if the line was not traced.
pub(super) fn knots(line: &Line) -> Vec<Knot> {
    let knot = |(n, point): (usize, &DVec3)| Knot {
        point: *point,
        radius: line.radius.as_ref().map_or(f64::NAN, |radius| radius[n]),
        confidence: line.confidence.as_ref().map_or(1.0, |confidence| confidence[n]),
        is_bridged: line.bridged.as_ref().is_some_and(|bridged| bridged[n]),
        is_by_hand: line.by_hand.as_ref().is_some_and(|by_hand| by_hand[n]),
    };
    line.points.iter().enumerate().map(knot).collect()
}

/// A line of these points, with the kinds of data that `like` has.
pub(super) fn with_knots(knots: &[Knot], like: &Line) -> Line {
    Line {
        points: knots.iter().map(|knot| knot.point).collect(),
        radius: like.radius.as_ref().map(|_| knots.iter().map(|knot| knot.radius).collect()),
        confidence: like.confidence.as_ref().map(|_| knots.iter().map(|knot| knot.confidence).collect()),
        bridged: like.bridged.as_ref().map(|_| knots.iter().map(|knot| knot.is_bridged).collect()),
        by_hand: like.by_hand.as_ref().map(|_| knots.iter().map(|knot| knot.is_by_hand).collect()),
    }
}
