//! Finds the arc length on the second vessel for each arc length on the first: by the shape of the lines, by branches, or by pairs of
//! places that a reader gives.

use glam::DVec3;

use crate::measure::comparison::rigid::Motion;
use crate::measure::profile::Profile;
use crate::measure::section::flags::BRANCH;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::arc_length::point_at;
use lumencut_core::math::statistics::median;

/// Distance of the points by which lines are compared, and of the tried offsets (mm).
const STEP: f64 = 1.0;
/// The lines overlap by at least this share of the shorter one, and this length (mm).
const OVERLAP: f64 = 0.6;
const LEAST_OVERLAP: f64 = 15.0;
/// Usual deviation of a traced line from the middle of its lumen (mm), and the length over which it is similar (mm).
const LINE_DEVIATION: f64 = 0.3;
const SIMILAR_OVER: f64 = 10.0;
/// The offset is determined if its standard deviation is at most this (mm).
const SURE: f64 = 1.5;
/// The other direction is taken if its cost is below this share: a symmetric vessel fits in both.
const CLEARLY_BETTER: f64 = 0.5;
/// The curvature of the sum of squares is taken over this offset (mm).
const TRIED_OFFSET: f64 = 5.0;
/// Lines of the same vessel lie at most this far apart after the motion (root of the mean square, mm).
const SAME_VESSEL: f64 = 4.0;
/// The nearest point is searched within this length around the expected one (mm).
const NEARBY: f64 = 12.0;
/// Branches match if their places differ by at most this (mm).
const BRANCH_AWAY: f64 = 3.0;
/// Standard deviation of a place that a reader gives, and of a branch (mm).
const PLACE_DEVIATION: f64 = 1.0;
/// Between two pairs, the second vessel is at most this much shorter or longer than the first.
const STRETCH: f64 = 1.5;

/// By what two vessels were matched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatchedBy {
    /// The shape of their lines.
    Shape,
    /// Their branches.
    Branches,
    /// Pairs of places.
    Places,
}

/// Where each section of one vessel lies on another.
#[derive(Clone, Debug, PartialEq)]
pub struct Matching {
    /// By what they were matched.
    pub by: MatchedBy,
    /// For each section of the first vessel, the arc length on the second (mm); None beyond its ends.
    pub at: Vec<Option<f64>>,
    /// Whether the second vessel runs the other way.
    pub is_reversed: bool,
    /// Standard deviation of the places along the vessel (mm).
    pub deviation: f64,
    /// Median distance of the lines after a rigid motion (mm).
    pub apart: f64,
    /// That motion.
    pub motion: Motion,
}

/// An offset between two lines: the place on the second is `offset + sign · place`.
#[derive(Clone, Copy)]
struct Offset {
    offset: f64,
    sign: f64,
}

impl Offset {
    fn place(self, at: f64) -> f64 {
        self.offset + self.sign * at
    }
}

/// The best offset by the shapes with its standard deviation, and how far the lines are apart there (mm).
struct Shape {
    found: (Offset, f64),
    apart: f64,
}

/// Lines with a fit for each offset.
struct Lines<'a> {
    profiles: [&'a Profile; 2],
}

impl Lines<'_> {
    fn point(&self, which: usize, at: f64) -> DVec3 {
        let profile = self.profiles[which];
        point_at(&profile.on_vessel, &profile.arc_length, at)
    }

    fn length(&self, which: usize) -> f64 {
        self.profiles[which].length()
    }

    /// The places on the first line that have a place on the second one.
    fn shared(&self, offset: Offset) -> Vec<f64> {
        let count = (self.length(0) / STEP) as usize;
        let places = (0..=count).map(|n| n as f64 * STEP);
        places.filter(|at| (0.0..=self.length(1)).contains(&offset.place(*at))).collect()
    }

    fn least_overlap(&self) -> f64 {
        (OVERLAP * self.length(0).min(self.length(1))).max(LEAST_OVERLAP)
    }

    /// The best motion for an offset, and the mean square of the distances (mm²); None if the lines hardly overlap.
    fn fit(&self, offset: Offset) -> Option<(Motion, f64)> {
        let shared = self.shared(offset);
        if (shared.len() as f64) * STEP < self.least_overlap().min(self.length(0)) {
            return None;
        }
        let from: Vec<DVec3> = shared.iter().map(|at| self.point(0, *at)).collect();
        let to: Vec<DVec3> = shared.iter().map(|at| self.point(1, offset.place(*at))).collect();
        let motion = Motion::between(&from, &to);
        let squares = from.iter().zip(&to).map(|(a, b)| motion.of(*a).distance_squared(*b));
        Some((motion, squares.sum::<f64>() / shared.len() as f64))
    }

    /// The mean square, larger where the lines overlap less.
    fn cost(&self, offset: Offset) -> f64 {
        let overlap = self.shared(offset).len() as f64 * STEP / self.length(0).min(self.length(1));
        self.fit(offset).map_or(f64::INFINITY, |(_, square)| {
            (square + LINE_DEVIATION * LINE_DEVIATION) / overlap.min(1.0)
        })
    }

    fn offsets(&self, sign: f64) -> impl Iterator<Item = Offset> {
        let reach = self.length(0) + self.length(1);
        let count = (2.0 * reach / STEP) as usize;
        (0..=count).map(move |n| Offset { offset: n as f64 * STEP - reach, sign })
    }

    /// The offset at which the shapes agree best.
    fn by_shape(&self) -> Option<Shape> {
        let best = |sign: f64| {
            let costs = self.offsets(sign).map(|offset| (offset, self.cost(offset)));
            costs.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, cost)| cost.is_finite())
        };
        let (along, against) = (best(1.0)?, best(-1.0)?);
        let (best, cost) = if against.1 < CLEARLY_BETTER * along.1 { against } else { along };
        let nearby = |away: f64| Offset { offset: best.offset + away, ..best };
        let [before, after] = [-STEP, STEP].map(|away| self.cost(nearby(away)));
        let bend = before + after - 2.0 * cost;
        let fine = if bend > 0.0 && bend.is_finite() { 0.5 * STEP * (before - after) / bend } else { 0.0 };
        let square = self.fit(best)?.1;
        let away = [-TRIED_OFFSET, TRIED_OFFSET].map(|away| self.fit(nearby(away)).map(|(_, square)| square));
        let grown = away.into_iter().flatten().fold(f64::INFINITY, f64::min) - square;
        let rise = (grown / (TRIED_OFFSET * TRIED_OFFSET)).max(0.0);
        let count = (self.shared(best).len() as f64 * STEP / SIMILAR_OVER).max(1.0);
        let deviation = ((square + LINE_DEVIATION * LINE_DEVIATION) / (rise * count)).sqrt();
        Some(Shape { found: (nearby(fine.clamp(-STEP, STEP)), deviation), apart: square.sqrt() })
    }

    /// The offset at which most branches agree: at least two, and more than at any other one.
    fn by_branches(&self) -> Option<(Offset, f64)> {
        let [first, second] = self.profiles.map(branches);
        let mut found: Vec<(usize, Offset)> = Vec::new();
        for sign in [1.0, -1.0] {
            for (a, b) in first.iter().flat_map(|a| second.iter().map(move |b| (a, b))) {
                let offset = Offset { offset: b - sign * a, sign };
                let away: Vec<f64> =
                    first.iter().filter_map(|a| nearest(&second, offset.place(*a))).collect();
                let near: Vec<f64> = away.into_iter().filter(|away| away.abs() <= BRANCH_AWAY).collect();
                let mean = near.iter().sum::<f64>() / near.len() as f64;
                found.push((near.len(), Offset { offset: offset.offset + mean, sign }));
            }
        }
        found.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
        let (count, best) = *found.first().filter(|(count, _)| *count >= 2)?;
        let is_other = |other: &Offset| {
            other.sign != best.sign || (other.offset - best.offset).abs() > 2.0 * BRANCH_AWAY
        };
        let rival = found.iter().find(|(_, other)| is_other(other)).map_or(0, |(count, _)| *count);
        (rival < count).then(|| (best, PLACE_DEVIATION / (count as f64).sqrt()))
    }

    /// The offset of one pair of places, in the direction that fits the shapes better.
    fn by_pair(&self, [a, b]: [f64; 2]) -> (Offset, f64) {
        let offsets = [1.0, -1.0].map(|sign| Offset { offset: b - sign * a, sign });
        let is_reversed = self.cost(offsets[1]) < self.cost(offsets[0]);
        (offsets[usize::from(is_reversed)], PLACE_DEVIATION)
    }

    fn matching(&self, by: MatchedBy, (offset, deviation): (Offset, f64)) -> Result<Matching> {
        let (motion, square) = self.fit(offset).ok_or_else(|| self.no_overlap())?;
        let (mut at, mut apart) = (Vec::new(), Vec::new());
        for (place, point) in self.profiles[0].arc_length.iter().zip(&self.profiles[0].on_vessel) {
            let expected = offset.place(*place);
            let inside = (0.0..=self.length(1)).contains(&expected);
            let found =
                if by == MatchedBy::Shape { self.foot(motion.of(*point), expected) } else { expected };
            apart.extend(inside.then(|| motion.of(*point).distance(self.point(1, found))));
            at.push(inside.then_some(found));
        }
        let apart = median(&mut apart).unwrap_or(square.sqrt());
        Ok(Matching { by, at, is_reversed: offset.sign < 0.0, deviation, apart, motion })
    }

    /// The place on the second line nearest to a point, near an expected place (mm).
    fn foot(&self, point: DVec3, expected: f64) -> f64 {
        let profile = self.profiles[1];
        let near = profile.arc_length.windows(2).zip(profile.on_vessel.windows(2));
        let near = near.filter(|(ends, _)| (ends[0] - expected).abs() <= NEARBY);
        let feet = near.map(|(ends, points)| {
            let along = points[1] - points[0];
            let share = ((point - points[0]).dot(along) / along.length_squared().max(f64::MIN_POSITIVE))
                .clamp(0.0, 1.0);
            (ends[0] + share * (ends[1] - ends[0]), point.distance(points[0] + share * along))
        });
        feet.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(expected, |(place, _)| place)
    }

    fn no_overlap(&self) -> Error {
        let found = format!(
            "vessels of {:.0} and {:.0} mm that share hardly any part",
            self.length(0),
            self.length(1)
        );
        compared(found, "the same vessel in both scans").mend("choose the vessel of the second scan")
    }
}

fn another(apart: f64) -> Error {
    let found = format!("lines {apart:.1} mm apart after the best rigid motion");
    let expected = format!("the same vessel in both scans, at most {SAME_VESSEL} mm apart");
    compared(found, &expected).mend("choose the vessel of the second scan, or give pairs of places")
}

fn compared(found: String, expected: &str) -> Error {
    Error::new(ErrorKind::Measuring, "vessels to compare", found, expected)
}

/// The middles of the stretches that are flagged as branches (mm).
fn branches(profile: &Profile) -> Vec<f64> {
    let is_branch = |n: &usize| profile.flags[*n] & BRANCH != 0;
    let numbers: Vec<usize> = (0..profile.len()).filter(is_branch).collect();
    let runs = numbers.chunk_by(|a, b| b - a == 1);
    runs.map(|run| f64::midpoint(profile.arc_length[run[0]], profile.arc_length[run[run.len() - 1]]))
        .collect()
}

/// The distance from a place to the nearest of others (mm), with its sign.
fn nearest(places: &[f64], at: f64) -> Option<f64> {
    places.iter().map(|place| place - at).min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Matches two vessels by these pairs of places (arc lengths on the first and on the second, mm); without pairs by their shapes, or by
/// their branches if the shapes do not determine the places. Errors: [`ErrorKind::Measuring`] if nothing does, if the vessels do not
/// match, or for pairs that are not on the vessels or contradict each other.
pub(super) fn matching(first: &Profile, second: &Profile, pairs: &[[f64; 2]]) -> Result<Matching> {
    let lines = Lines { profiles: [first, second] };
    for [a, b] in pairs {
        first.check_place("place on the first vessel", *a)?;
        second.check_place("place on the second vessel", *b)?;
    }
    match pairs {
        [] => match lines.by_shape() {
            None => Err(lines.no_overlap()),
            Some(Shape { apart, .. }) if apart > SAME_VESSEL => Err(another(apart)),
            Some(Shape { found, .. }) if found.1 <= SURE => lines.matching(MatchedBy::Shape, found),
            Some(_) => {
                let branches = lines.by_branches().ok_or_else(unsure)?;
                lines.matching(MatchedBy::Branches, branches)
            }
        },
        [pair] => lines.matching(MatchedBy::Places, lines.by_pair(*pair)),
        several => by_places(&lines, several),
    }
}

fn unsure() -> Error {
    let found = "vessels whose shape does not determine which places belong together".to_owned();
    compared(found, "curved vessels, or at least two branches in both")
        .mend("give a pair of places, such as a branch in both scans")
}

/// Interpolates between pairs; beyond the outermost ones, lengths are equal.
fn by_places(lines: &Lines, pairs: &[[f64; 2]]) -> Result<Matching> {
    let mut pairs = pairs.to_vec();
    pairs.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let ends = [pairs[0], pairs[pairs.len() - 1]];
    let sign = (ends[1][1] - ends[0][1]).signum();
    for two in pairs.windows(2) {
        let [along, other] = [two[1][0] - two[0][0], sign * (two[1][1] - two[0][1])];
        if !(other > along / STRETCH && other < along * STRETCH) {
            let found =
                format!("places {along:.1} mm apart on the first vessel and {other:.1} mm on the second");
            let expected = format!("about the same distance and order on both, up to a factor of {STRETCH}");
            return Err(Error::new(ErrorKind::Measuring, "pairs of places", found, expected));
        }
    }
    let offset = |[a, b]: [f64; 2]| Offset { offset: b - sign * a, sign };
    let place = |at: f64| match pairs.iter().position(|[a, _]| *a >= at) {
        Some(0) => offset(ends[0]).place(at),
        None => offset(ends[1]).place(at),
        Some(next) => {
            let [[a, b], [c, d]] = [pairs[next - 1], pairs[next]];
            b + (d - b) * (at - a) / (c - a)
        }
    };
    let whole = lines.matching(MatchedBy::Places, (offset(ends[0]), PLACE_DEVIATION))?;
    let inside = |at: &f64| Some(place(*at)).filter(|place| (0.0..=lines.length(1)).contains(place));
    Ok(Matching { at: lines.profiles[0].arc_length.iter().map(inside).collect(), ..whole })
}
