//! Checks the order of a line's points, and finds an unambiguous order.

use glam::DVec3;
use lumencut_core::math::statistics::{median, quantile};

use super::nearby::Nearby;
use super::shortest_tree::ShortestTree;

/// A step is too long if it exceeds this many usual steps, and also [`LONG_STEP_FRACTION`] of the line's extent.
pub(super) const LONG_STEP: f64 = 20.0;
const LONG_STEP_FRACTION: f64 = 0.05;
/// A line is too long if it is this many times as long as a short path through its points.
const MAX_LENGTH_RATIO: f64 = 2.0;
/// The same limit if an unambiguous order of the points exists.
const MAX_LENGTH_RATIO_FOUND: f64 = 1.2;
/// Steps are regular if this factor bounds both the longest step divided by the usual one, and high quantiles divided by low ones.
const MAX_REGULAR_RATIO: f64 = 3.0;
/// A point is a spike if it is more than this many usual steps away from both neighbours.
const SPIKE_STEPS: f64 = 5.0;
/// The steps of an unambiguous order are at most this many usual steps long.
const MAX_FOUND_STEP: f64 = 5.0;
/// An order is ambiguous if another stretch comes nearer to a point than this many times the longest step.
const CLEARANCE_STEPS: f64 = 1.5;
/// A point is on another stretch if the path to it is more than this many times as long as the straight distance.
const OTHER_STRETCH_RATIO: f64 = 4.0;
/// An order is ambiguous if more than this many points are near one point.
const MAX_NEIGHBOURS: usize = 256;
const MIN_POINTS: usize = 5;
const MIN_POINTS_WITH_SPIKE: usize = 8;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum OrderDoubt {
    Disorder(Disorder),
    /// A part of the line seems to be missing at a long step.
    Gap(LongStep),
    /// Stray points, and their smallest distance from the other points (mm).
    Stray(Vec<usize>, f64),
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Disorder {
    /// The longest step, if it is too long.
    pub step: Option<LongStep>,
    /// The lengths of the line and of a short path through its points (mm).
    pub lengths: [f64; 2],
    pub(crate) is_found: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LongStep {
    /// Index of the point before the step.
    pub after: usize,
    pub length: f64,
    pub usual: f64,
}

pub(super) fn order_doubts(points: &[DVec3]) -> Vec<OrderDoubt> {
    if points.len() < MIN_POINTS || is_regular(points) {
        return Vec::new();
    }
    let nearby = Nearby::new(points);
    let tree = ShortestTree::new(points, &nearby);
    let (strays, distance) = strays(points, &tree, &nearby);
    if strays.is_empty() {
        return disorder(points, &tree, &nearby).into_iter().collect();
    }
    let kept: Vec<usize> = (0..points.len()).filter(|n| strays.binary_search(n).is_err()).collect();
    let rest: Vec<DVec3> = kept.iter().map(|n| points[*n]).collect();
    let of_rest = order_doubts(&rest).into_iter().map(|doubt| doubt.among(&kept));
    std::iter::once(OrderDoubt::Stray(strays, distance)).chain(of_rest).collect()
}

impl OrderDoubt {
    /// If only the `kept` points were checked: the same doubt, with point numbers of the whole line.
    fn among(self, kept: &[usize]) -> Self {
        let moved = |step: LongStep| LongStep { after: kept[step.after], ..step };
        match self {
            Self::Disorder(found) => {
                Self::Disorder(Disorder { step: found.step.map(moved), is_found: false, ..found })
            }
            Self::Gap(step) => Self::Gap(moved(step)),
            Self::Stray(points, distance) => {
                Self::Stray(points.into_iter().map(|n| kept[n]).collect(), distance)
            }
        }
    }
}

/// The unambiguous order along the vessel, or None: the shortest path through all points, with regular steps. On both sides of a
/// point, the neighbour on the path must be the nearest point.
pub(crate) fn found_order(points: &[DVec3]) -> Option<Vec<usize>> {
    if points.len() < MIN_POINTS {
        return None;
    }
    let nearby = Nearby::new(points);
    found(points, &ShortestTree::new(points, &nearby), &nearby)
}

fn found(points: &[DVec3], tree: &ShortestTree, nearby: &Nearby) -> Option<Vec<usize>> {
    if !tree.is_path() {
        return None;
    }
    let order = tree.path();
    let mut steps: Vec<f64> =
        order.windows(2).map(|pair| points[pair[0]].distance(points[pair[1]])).collect();
    let along: Vec<f64> = std::iter::once(0.0)
        .chain(steps.iter().scan(0.0, |sum, step| {
            *sum += step;
            Some(*sum)
        }))
        .collect();
    let mut rank = vec![0; points.len()];
    order.iter().enumerate().for_each(|(place, n)| rank[*n] = place);
    let longest = steps.iter().copied().fold(0.0, f64::max);
    let reach = CLEARANCE_STEPS * longest;
    let is_clear =
        (0..order.len()).all(|at| is_clear((points, nearby), (&order, &rank), &along, (at, reach)));
    let is_even = median(&mut steps).is_some_and(|usual| longest <= MAX_FOUND_STEP * usual);
    (is_clear && is_even).then_some(order)
}

/// Whether the neighbours of a point in an order are the nearest points on either side, and no other stretch is near.
fn is_clear(
    (points, nearby): (&[DVec3], &Nearby),
    (order, rank): (&[usize], &[usize]),
    along: &[f64],
    (at, reach): (usize, f64),
) -> bool {
    let place = points[order[at]];
    let step = |to: Option<usize>| to.and_then(|to| order.get(to)).map(|n| place.distance(points[*n]));
    let (before, after) = (step(at.checked_sub(1)), step(Some(at + 1)));
    let (mut is_clear, mut count) = (true, 0);
    nearby.within(place, reach, |n| {
        let (other, distance) = (rank[n], place.distance(points[n]));
        let nearest = if other < at { before } else { after };
        let is_next = other.abs_diff(at) <= 1;
        let is_same_stretch = (along[other] - along[at]).abs() <= OTHER_STRETCH_RATIO * distance;
        count += 1;
        is_clear = is_next || (is_same_stretch && nearest.is_none_or(|step| distance > step));
        is_clear &= count <= MAX_NEIGHBOURS;
        is_clear
    });
    is_clear
}

fn is_regular(points: &[DVec3]) -> bool {
    let mut steps: Vec<f64> = steps(points).filter(|step| *step > 0.0).collect();
    let longest = steps.iter().copied().fold(0.0, f64::max);
    let parts = [0.05, 0.5, 0.95].map(|part| quantile(&mut steps, part).unwrap_or(0.0));
    let [short, usual, long] = parts;
    longest <= MAX_REGULAR_RATIO * usual && long <= MAX_REGULAR_RATIO * short
}

fn steps(points: &[DVec3]) -> impl Iterator<Item = f64> + '_ {
    points.windows(2).map(|pair| pair[0].distance(pair[1]))
}

fn usual_and_long(points: &[DVec3], tree: &ShortestTree) -> (f64, f64) {
    let mut edges: Vec<f64> = tree.edges.iter().map(|edge| edge.2).filter(|length| *length > 0.0).collect();
    let usual = median(&mut edges).unwrap_or(0.0);
    (usual, (LONG_STEP * usual).max(LONG_STEP_FRACTION * extent(points)))
}

fn extent(points: &[DVec3]) -> f64 {
    let corners = points.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(*p), high.max(*p)));
    corners.0.distance(corners.1)
}

fn strays(points: &[DVec3], tree: &ShortestTree, nearby: &Nearby) -> (Vec<usize>, f64) {
    let (usual, long) = usual_and_long(points, tree);
    let piece = tree.pieces(long);
    let mut members = vec![Vec::new(); points.len()];
    piece.iter().enumerate().for_each(|(n, piece)| members[*piece].push(n));
    let largest = members.iter().map(Vec::len).max().unwrap_or(0);
    let is_few =
        |part: &&Vec<usize>| !part.is_empty() && part.len() <= 5 && 10 * part.len() <= largest.max(10);
    let is_run = |part: &&Vec<usize>| part.len() > 1 && part.windows(2).all(|pair| pair[1] == pair[0] + 1);
    let few = members.iter().filter(is_few).filter(|part| !is_run(part) && part.len() < largest);
    let mut strays: Vec<usize> = few.flatten().copied().collect();
    let far = (SPIKE_STEPS * usual).max(LONG_STEP_FRACTION * extent(points));
    strays.extend((0..points.len()).filter(|n| is_spike(points, nearby, [usual, far], *n)));
    strays.sort_unstable();
    strays.dedup();
    if 3 * strays.len() > points.len() {
        return (Vec::new(), 0.0);
    }
    let is_stray = |n: &usize| strays.binary_search(n).is_ok();
    let leaving = tree.edges.iter().filter(|(a, b, _)| is_stray(a) != is_stray(b));
    let distance = leaving.map(|edge| edge.2).fold(f64::INFINITY, f64::min);
    (strays, distance)
}

fn is_spike(points: &[DVec3], nearby: &Nearby, [usual, far]: [f64; 2], n: usize) -> bool {
    if points.len() < MIN_POINTS_WITH_SPIKE || n == 0 || n + 1 == points.len() {
        return false;
    }
    let [before, place, after] = [points[n - 1], points[n], points[n + 1]];
    if before.distance(place) <= far
        || place.distance(after) <= far
        || before.distance(after) > MAX_REGULAR_RATIO * usual
    {
        return false;
    }
    let mut is_alone = true;
    nearby.within(place, far, |other| {
        is_alone = other == n;
        is_alone
    });
    is_alone
}

fn disorder(points: &[DVec3], tree: &ShortestTree, nearby: &Nearby) -> Option<OrderDoubt> {
    let (usual, long) = usual_and_long(points, tree);
    let length: f64 = steps(points).sum();
    let short: f64 = tree.path().windows(2).map(|pair| points[pair[0]].distance(points[pair[1]])).sum();
    let found = found(points, tree, nearby);
    let (after, longest) =
        steps(points).enumerate().fold((0, 0.0), |most, step| if step.1 > most.1 { step } else { most });
    let step = (longest > long).then_some(LongStep { after, length: longest, usual });
    let is_too_long = length > MAX_LENGTH_RATIO * short
        || (found.is_some()
            && longest > MAX_REGULAR_RATIO * usual
            && length > MAX_LENGTH_RATIO_FOUND * short);
    if !is_too_long {
        let step = step?;
        let piece = tree.pieces(long);
        let is_gap = (1..points.len())
            .filter(|n| points[n - 1].distance(points[*n]) > long)
            .all(|n| piece[n - 1] != piece[n]);
        if is_gap {
            return Some(OrderDoubt::Gap(step));
        }
    }
    let disorder = Disorder { step, lengths: [length, short.min(length)], is_found: found.is_some() };
    Some(OrderDoubt::Disorder(disorder))
}
