//! Removes spurs, which are branches that come from bumps of the wall or corners of ends.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use glam::DVec3;

use crate::trace::skeleton::graph::{Branch, Graph};
use crate::trace::skeleton::mask_lumen::Lumen;
use lumencut_core::math::same_place::ALONG_LINE;

/// A branch is kept if it extends this many of its radii beyond the wall of its parent.
const OWN_RADII: f64 = 4.0;

/// Junctions are merged if they are closer than this fraction of the radius, or than two voxels.
const MERGE_RADII: f64 = 0.3;

/// Minimum length of a component, in its diameters.
const ELONGATED: f64 = 1.25;

/// Removes spurs. A branch with a free end is kept if it is at least `parent_radii` parent radii long, from
/// the parent's centerline to its end, or extends far beyond the parent's wall. The least significant spur is
/// removed first, and then its neighbours are checked again.
pub(crate) fn prune(graph: &mut Graph, lumen: &Lumen, parent_radii: f64) {
    let mut waiting: BinaryHeap<Reverse<(u64, usize)>> = BinaryHeap::new();
    let push = |graph: &Graph, waiting: &mut BinaryHeap<Reverse<(u64, usize)>>, number: usize| {
        let rank = significance(graph, lumen, number, parent_radii).map(rank);
        waiting.extend(rank.filter(|rank| *rank < WHOLE).map(|rank| Reverse((rank, number))));
    };
    for number in 0..graph.branches.len() {
        push(graph, &mut waiting, number);
    }
    while let Some(Reverse((before, number))) = waiting.pop() {
        if significance(graph, lumen, number, parent_radii).map(rank) != Some(before) {
            continue;
        }
        let Some(branch) = graph.remove(number) else { continue };
        for node in branch.nodes {
            graph.join_at(node);
            for other in graph.incident[node].clone() {
                push(graph, &mut waiting, other);
            }
        }
        if let Some(joined) = graph.branches.len().checked_sub(1) {
            push(graph, &mut waiting, joined);
        }
    }
}

/// Rank of a branch that is just significant enough to be kept.
const WHOLE: u64 = 1 << 20;

fn rank(significance: f64) -> u64 {
    (significance.max(0.0) * WHOLE as f64).round() as u64
}

/// Significance of a branch with one free end; below 1 it is a spur. None for other branches.
fn significance(graph: &Graph, lumen: &Lumen, number: usize, parent_radii: f64) -> Option<f64> {
    let branch = graph.branches[number].as_ref()?;
    let is_free = branch.nodes.map(|node| graph.incident[node].len() == 1);
    let (junction, end) = match is_free {
        [true, false] => (branch.nodes[1], branch.nodes[0]),
        [false, true] => (branch.nodes[0], branch.nodes[1]),
        _ => return None,
    };
    let mut outwards = lumen.positions(&branch.cells);
    if branch.nodes[0] == end {
        outwards.reverse();
    }
    let side = lumen.side();
    let parent = parent_radius(graph, lumen, number, junction);
    let length = length(&outwards) + lumen.radius_at_cell(graph.nodes[end]);
    let (mut walked, mut outside) = (0.0, Vec::new());
    for (n, point) in outwards.iter().enumerate() {
        walked += if n == 0 { 0.0 } else { point.distance(outwards[n - 1]) };
        if walked >= parent - ALONG_LINE {
            outside.push(lumen.radius(*point));
        }
    }
    outside.sort_unstable_by(f64::total_cmp);
    let median = outside.get(outside.len() / 2).copied().unwrap_or(0.0);
    let by_parent = length / (parent_radii * parent + side);
    let by_itself = (length - parent) / (OWN_RADII * median.max(side));
    Some(by_parent.max(by_itself))
}

/// Radius of the widest other branch, measured one radius away from the junction, where lumens widen.
fn parent_radius(graph: &Graph, lumen: &Lumen, number: usize, junction: usize) -> f64 {
    let at_junction = lumen.radius_at_cell(graph.nodes[junction]);
    let others = graph.incident[junction].iter().filter(|&&other| other != number);
    let along = others.filter_map(|&other| graph.branches[other].as_ref()).map(|branch| {
        let mut points = lumen.positions(&branch.cells);
        if branch.nodes[0] != junction {
            points.reverse();
        }
        let away = points.iter().find(|point| point.distance(points[0]) >= at_junction - ALONG_LINE);
        away.map_or(at_junction, |point| lumen.radius(*point))
    });
    along.fold(0.0, f64::max).min(at_junction)
}

/// Length of a line of voxels. Means of five neighbours first remove its stair steps.
pub(crate) fn length(points: &[DVec3]) -> f64 {
    let mean = |n: usize| {
        let reach = n.min(points.len() - 1 - n).min(2);
        let near = &points[n - reach..=n + reach];
        near.iter().sum::<DVec3>() / near.len() as f64
    };
    (1..points.len()).map(|n| mean(n).distance(mean(n - 1))).sum()
}

pub(crate) fn merge_junctions(graph: &mut Graph, lumen: &Lumen) {
    while let Some(number) = (0..graph.branches.len()).find(|&number| is_near(graph, lumen, number)) {
        let Some(branch) = graph.remove(number) else { return };
        let widest = (0..2).max_by(|&a, &b| {
            let [a, b] = [a, b].map(|n| lumen.radius_at_cell(graph.nodes[branch.nodes[n]]));
            a.total_cmp(&b)
        });
        let [kept, gone] = if widest == Some(0) { branch.nodes } else { [branch.nodes[1], branch.nodes[0]] };
        let way = if branch.nodes[0] == kept { branch } else { turned(branch) };
        let moved: BTreeSet<usize> = graph.incident[gone].iter().copied().collect();
        for other in moved {
            let Some(mut other) = graph.remove(other) else { continue };
            for _ in 0..2 {
                if other.nodes[0] == gone {
                    other.cells.splice(0..0, way.cells[..way.cells.len() - 1].iter().copied());
                    other.nodes[0] = kept;
                }
                other.reverse();
            }
            graph.add(other);
        }
    }
}

fn turned(mut branch: Branch) -> Branch {
    branch.reverse();
    branch
}

fn is_near(graph: &Graph, lumen: &Lumen, number: usize) -> bool {
    let Some(branch) = &graph.branches[number] else { return false };
    let [a, b] = branch.nodes;
    let inner = a != b && graph.incident[a].len() > 2 && graph.incident[b].len() > 2;
    let radius =
        branch.nodes.map(|node| lumen.radius_at_cell(graph.nodes[node])).into_iter().fold(0.0, f64::max);
    inner && length(&lumen.positions(&branch.cells)) < (MERGE_RADII * radius).max(2.0 * lumen.side())
}

pub(crate) fn remove_round_pieces(graph: &mut Graph, lumen: &Lumen) {
    for number in 0..graph.branches.len() {
        let Some(branch) = &graph.branches[number] else { continue };
        let [a, b] = branch.nodes;
        if a == b || graph.incident[a].len() > 1 || graph.incident[b].len() > 1 {
            continue;
        }
        let points = lumen.positions(&branch.cells);
        let widest = points.iter().map(|point| lumen.radius(*point)).fold(0.0, f64::max);
        let whole = length(&points) + lumen.radius(points[0]) + lumen.radius(points[points.len() - 1]);
        if whole < ELONGATED * 2.0 * widest {
            graph.remove(number);
        }
    }
}
