//! Which vessels of a seed are sure: those that are seen well and hang on the seed by others that are.

use std::collections::{BTreeSet, HashMap, VecDeque};

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lumen::tube::median;
use crate::trace::seed::seed_doubts::{Doubtful, worth_a_look};
use crate::trace::skeleton::mask_vessels::MaskVessel;

/// A vessel whose mean confidence is below this is doubtful.
const DOUBTFUL: f64 = 0.3;

/// A vessel between two others is hardly seen where it lies within their lumens: up to this number of its largest radii, and so
/// much (mm).
const WITHIN: f64 = 2.5;
const WITHIN_LENGTH: f64 = 3.0;

/// Why a branch is doubtful.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// Its cross-sections are hardly those of a vessel.
    Unseen,
    /// It hangs on the seed by doubtful branches alone.
    Behind,
}

impl Doubt {
    /// The doubt in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Unseen => {
                "its cross-sections are hardly those of a vessel, or its values are not those of the lumen"
            }
            Self::Behind => "only doubtful branches lead to it",
        }
    }
}

/// A branch that a seed reaches.
#[derive(Clone, Debug)]
pub struct SeedBranch {
    /// Its points, radii and confidence.
    pub line: Centerline,
    /// Why it is doubtful; none where it is not.
    pub doubt: Option<Doubt>,
}

/// A vessel with its confidence.
pub struct SeenVessel {
    /// The vessel.
    pub vessel: MaskVessel,
    /// How sure each of its points is, 0 to 1.
    pub confidence: Vec<f64>,
}

impl SeenVessel {
    /// Whether the vessel is seen well, but for what lies within other lumens at its ends, which are so wide (mm).
    fn is_seen(&self, widths: [f64; 2]) -> bool {
        let points = &self.vessel.points;
        let last = points.len() - 1;
        let is_outside = |n: &usize| {
            points[*n].distance(points[0]) >= widths[0] && points[*n].distance(points[last]) >= widths[1]
        };
        let outside: Vec<f64> = (0..=last).filter(is_outside).map(|n| self.confidence[n]).collect();
        let all = if outside.is_empty() { &self.confidence } else { &outside };
        all.iter().sum::<f64>() >= DOUBTFUL * all.len() as f64
    }

    /// Whether the vessel may lie within the lumens of those that it joins.
    fn is_within(&self) -> bool {
        let widest = self.vessel.radius.iter().copied().fold(0.0, f64::max);
        let is_inner = !self.vessel.is_free.contains(&true);
        is_inner && self.vessel.length() <= WITHIN_LENGTH.max(WITHIN * widest)
    }

    fn distance(&self, place: DVec3) -> f64 {
        self.vessel.points.iter().map(|point| point.distance_squared(place)).fold(f64::MAX, f64::min)
    }
}

/// The branches that the seed reaches, the doubtful ones that are worth a look last. Sure vessels that meet nothing else are
/// joined.
pub fn branches(vessels: Vec<SeenVessel>, seed: DVec3) -> Vec<SeedBranch> {
    let is_seen = seen(&vessels);
    let is_sure = sure(&vessels, &is_seen, seed);
    let (mut doubtful, mut doubts) = (Vec::new(), Vec::new());
    let mut lines = Vec::new();
    for ((vessel, is_seen), is_sure) in vessels.into_iter().zip(is_seen).zip(is_sure) {
        let SeenVessel { vessel, confidence } = vessel;
        let nodes = vessel.nodes;
        let line = Centerline { points: vessel.points, radius: vessel.radius, confidence };
        if is_sure {
            lines.push((nodes, line));
        } else {
            doubtful.push(Doubtful { nodes, line });
            doubts.push(if is_seen { Doubt::Behind } else { Doubt::Unseen });
        }
    }
    let sure_nodes: BTreeSet<usize> = lines.iter().flat_map(|(nodes, _)| *nodes).collect();
    let sure = joined(lines);
    let is_worth = worth_a_look(&doubtful, &sure, &sure_nodes);
    let doubtful = doubtful.into_iter().zip(doubts).zip(is_worth).filter(|(_, is_worth)| *is_worth);
    let doubtful = doubtful.map(|((vessel, doubt), _)| SeedBranch { line: vessel.line, doubt: Some(doubt) });
    sure.into_iter().map(|line| SeedBranch { line, doubt: None }).chain(doubtful).collect()
}

/// The vessels without those at the ends of the tree that are narrower than `least` (mm) on the whole: the median of their
/// radii over the half that leads away.
pub fn wide_enough(mut vessels: Vec<MaskVessel>, least: f64) -> Vec<MaskVessel> {
    loop {
        let mut ends: HashMap<usize, usize> = HashMap::new();
        for node in vessels.iter().flat_map(|vessel| vessel.nodes) {
            *ends.entry(node).or_default() += 1;
        }
        let is_narrow = |vessel: &MaskVessel| {
            let free = vessel.nodes.map(|node| ends[&node] == 1);
            let half = vessel.radius.len() / 2;
            let outer = match free {
                [false, false] => return false,
                [true, true] => &vessel.radius[..],
                [true, false] => &vessel.radius[..=half],
                [false, true] => &vessel.radius[half..],
            };
            median(outer) < least
        };
        let Some(narrow) = vessels.iter().position(is_narrow) else { return vessels };
        vessels.remove(narrow);
    }
}

/// Which vessels are seen well outside the lumens of those that they meet.
fn seen(vessels: &[SeenVessel]) -> Vec<bool> {
    let mut width: HashMap<usize, [f64; 2]> = HashMap::new();
    let ends = |vessel: &MaskVessel| [(vessel.nodes[0], 0), (vessel.nodes[1], vessel.radius.len() - 1)];
    // The two largest radii at each node: a vessel is not measured by its own.
    for SeenVessel { vessel, .. } in vessels {
        for (node, end) in ends(vessel) {
            let [first, second] = width.entry(node).or_default();
            let radius = vessel.radius[end];
            (*first, *second) = if radius > *first { (radius, *first) } else { (*first, second.max(radius)) };
        }
    }
    let beside = |vessel: &MaskVessel| {
        ends(vessel).map(|(node, end)| {
            let [first, second] = width[&node];
            if vessel.radius[end] < first { first } else { second }
        })
    };
    vessels.iter().map(|seen| seen.is_seen(beside(&seen.vessel))).collect()
}

/// Which vessels are sure.
fn sure(vessels: &[SeenVessel], is_seen: &[bool], seed: DVec3) -> Vec<bool> {
    let nearest = (0..vessels.len())
        .filter(|n| is_seen[*n])
        .min_by(|a, b| vessels[*a].distance(seed).total_cmp(&vessels[*b].distance(seed)));
    let Some(root) = nearest else { return vec![true; vessels.len()] };
    let mut at_node: HashMap<usize, Vec<usize>> = HashMap::new();
    for (number, vessel) in vessels.iter().enumerate() {
        for node in vessel.vessel.nodes {
            at_node.entry(node).or_default().push(number);
        }
    }
    let mut is_sure = vec![false; vessels.len()];
    is_sure[root] = true;
    let mut reached: HashMap<usize, ()> = HashMap::new();
    // Vessels that are seen first; one within others only where no other way leads on.
    let mut nodes: VecDeque<(usize, Option<usize>)> = VecDeque::new();
    nodes.extend(vessels[root].vessel.nodes.map(|node| (node, None)));
    while let Some((node, by)) = nodes.pop_front() {
        if reached.insert(node, ()).is_some() {
            continue;
        }
        if let Some(by) = by {
            is_sure[by] = true;
        }
        for &number in &at_node[&node] {
            let [a, b] = vessels[number].vessel.nodes;
            let other = if a == node { b } else { a };
            if is_seen[number] {
                is_sure[number] = true;
                nodes.push_front((other, None));
            } else if vessels[number].is_within() {
                nodes.push_back((other, Some(number)));
            }
        }
    }
    without_loose_ends(vessels, is_seen, &at_node, is_sure)
}

/// Those that are sure without vessels within others that lead to nothing.
fn without_loose_ends(
    vessels: &[SeenVessel],
    is_seen: &[bool],
    at_node: &HashMap<usize, Vec<usize>>,
    mut is_sure: Vec<bool>,
) -> Vec<bool> {
    let ends_alone = |is_sure: &[bool], number: usize| {
        vessels[number]
            .vessel
            .nodes
            .iter()
            .any(|node| at_node[node].iter().filter(|n| is_sure[**n]).count() == 1)
    };
    while let Some(loose) =
        (0..vessels.len()).find(|n| is_sure[*n] && !is_seen[*n] && ends_alone(&is_sure, *n))
    {
        is_sure[loose] = false;
    }
    is_sure
}

/// The lines, two that meet in a node where no other ends made one.
fn joined(lines: Vec<([usize; 2], Centerline)>) -> Vec<Centerline> {
    let mut ends: HashMap<usize, usize> = HashMap::new();
    for node in lines.iter().flat_map(|(nodes, _)| *nodes) {
        *ends.entry(node).or_default() += 1;
    }
    let mut left: Vec<Option<([usize; 2], Centerline)>> = lines.into_iter().map(Some).collect();
    let mut whole = Vec::new();
    for n in 0..left.len() {
        let Some((mut nodes, mut line)) = left[n].take() else { continue };
        for end in [1, 0] {
            while ends[&nodes[end]] == 2 && nodes[0] != nodes[1] {
                let meets = |other: &&mut Option<([usize; 2], Centerline)>| {
                    other.as_ref().is_some_and(|(other, _)| other.contains(&nodes[end]))
                };
                let Some((other, next)) = left.iter_mut().find(meets).and_then(Option::take) else { break };
                let far = if other[0] == nodes[end] { other[1] } else { other[0] };
                line = chained(line, end, next, usize::from(other[0] != nodes[end]));
                nodes[end] = far;
            }
        }
        whole.push(line);
    }
    whole
}

/// A line with another one at its end `end`, which that meets with its own end `other_end`.
fn chained(line: Centerline, end: usize, other: Centerline, other_end: usize) -> Centerline {
    let [first, second] = match (end, other_end) {
        (1, 0) => [line, other],
        (1, _) => [line, other.reversed()],
        (_, 1) => [other, line],
        _ => [other.reversed(), line],
    };
    Centerline {
        points: [&first.points[..], &second.points[1..]].concat(),
        radius: [&first.radius[..], &second.radius[1..]].concat(),
        confidence: [&first.confidence[..], &second.confidence[1..]].concat(),
    }
}
