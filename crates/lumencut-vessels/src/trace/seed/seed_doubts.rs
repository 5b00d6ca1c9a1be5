//! Which doubtful vessels are worth a look: those that leave the lumens of the sure ones, and what leads to them.

use std::collections::{BTreeSet, HashMap, VecDeque};

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;

/// A doubtful vessel that runs less far outside the lumens of sure ones is a bump of a wall, or a way between the struts of a
/// stent (mm).
const SHORTEST: f64 = 3.0;

/// A doubtful vessel.
pub struct Doubtful {
    /// The nodes at its ends.
    pub nodes: [usize; 2],
    /// Its line.
    pub line: Centerline,
}

/// Which doubtful vessels are worth a look, in their order; `sure_nodes` are the nodes that sure vessels meet.
pub fn worth_a_look(doubtful: &[Doubtful], sure: &[Centerline], sure_nodes: &BTreeSet<usize>) -> Vec<bool> {
    let leaves = |vessel: &Doubtful| length_outside(&vessel.line, sure) >= SHORTEST;
    let mut is_worth: Vec<bool> = doubtful.iter().map(leaves).collect();
    let before = ways_from(doubtful, sure_nodes);
    for number in 0..doubtful.len() {
        if is_worth[number] {
            let mut here = nearer_end(&doubtful[number], number, &before, sure_nodes);
            while let Some(&(vessel, node)) = here.and_then(|node| before.get(&node)) {
                is_worth[vessel] = true;
                here = Some(node);
            }
        }
    }
    is_worth
}

/// For each node that doubtful vessels reach from sure ones, the last vessel on a shortest way there and the node before.
fn ways_from(doubtful: &[Doubtful], sure_nodes: &BTreeSet<usize>) -> HashMap<usize, (usize, usize)> {
    let mut at_node: HashMap<usize, Vec<usize>> = HashMap::new();
    for (number, vessel) in doubtful.iter().enumerate() {
        for node in vessel.nodes {
            at_node.entry(node).or_default().push(number);
        }
    }
    let mut before = HashMap::new();
    let mut nodes: VecDeque<usize> = sure_nodes.iter().copied().collect();
    while let Some(node) = nodes.pop_front() {
        for &number in at_node.get(&node).into_iter().flatten() {
            let [a, b] = doubtful[number].nodes;
            let other = if a == node { b } else { a };
            if !sure_nodes.contains(&other) && !before.contains_key(&other) {
                before.insert(other, (number, node));
                nodes.push_back(other);
            }
        }
    }
    before
}

/// The end of a vessel from which a way leads to sure ones without it; none where it meets one itself.
fn nearer_end(
    vessel: &Doubtful,
    number: usize,
    before: &HashMap<usize, (usize, usize)>,
    sure_nodes: &BTreeSet<usize>,
) -> Option<usize> {
    let is_beside = vessel.nodes.iter().any(|node| sure_nodes.contains(node));
    let leads = |node: &usize| before.get(node).is_some_and(|(last, _)| *last != number);
    if is_beside { None } else { vessel.nodes.into_iter().find(leads) }
}

/// How long a line runs outside the lumens of others (mm).
fn length_outside(line: &Centerline, others: &[Centerline]) -> f64 {
    let is_outside: Vec<bool> = line.points.iter().map(|point| !is_within(*point, others)).collect();
    let pairs = line.points.windows(2).zip(is_outside.windows(2));
    pairs.filter(|(_, outside)| outside[0] && outside[1]).map(|(pair, _)| pair[0].distance(pair[1])).sum()
}

fn is_within(place: DVec3, lines: &[Centerline]) -> bool {
    lines.iter().any(|line| {
        let mut lumen = line.points.iter().zip(&line.radius);
        lumen.any(|(point, radius)| point.distance_squared(place) <= radius * radius)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(from: [f64; 3], to: [f64; 3], radius: f64) -> Centerline {
        let (from, to) = (DVec3::from_array(from), DVec3::from_array(to));
        let points: Vec<DVec3> = (0..=40).map(|n| from.lerp(to, f64::from(n) / 40.0)).collect();
        Centerline { radius: vec![radius; 41], confidence: vec![0.1; 41], points }
    }

    /// Doubtful vessels beside a sure one along x with a radius of 4 mm, whose nodes are 0 and 1.
    fn worth(doubtful: Vec<([usize; 2], Centerline)>) -> Vec<bool> {
        let sure = [line([-20.0, 0.0, 0.0], [20.0, 0.0, 0.0], 4.0)];
        let doubtful: Vec<Doubtful> =
            doubtful.into_iter().map(|(nodes, line)| Doubtful { nodes, line }).collect();
        worth_a_look(&doubtful, &sure, &BTreeSet::from([0, 1]))
    }

    #[test]
    fn a_stub_is_left_out_by_its_length_beyond_the_wall() {
        let stub = ([0, 2], line([0.0, 0.0, 0.0], [0.0, 6.5, 0.0], 1.0));
        let branch = ([0, 3], line([0.0, 0.0, 0.0], [0.0, 7.5, 0.0], 1.0));
        let within = ([0, 1], line([-15.0, 2.0, 0.0], [15.0, 2.0, 0.0], 1.0));
        assert_eq!(worth(vec![stub, branch, within]), [false, true, false]);
    }

    #[test]
    fn what_leads_to_a_long_branch_stays_however_short_it_is() {
        let first = ([0, 2], line([0.0, 0.0, 0.0], [0.0, 5.0, 0.0], 1.0));
        let second = ([2, 3], line([0.0, 5.0, 0.0], [0.0, 6.0, 0.0], 1.0));
        let far = ([4, 3], line([0.0, 30.0, 0.0], [0.0, 6.0, 0.0], 1.0));
        let stub = ([2, 5], line([0.0, 5.0, 0.0], [1.0, 5.0, 0.0], 1.0));
        assert_eq!(worth(vec![far, first, second, stub]), [true, true, true, false]);
    }
}
