//! Lines through junctions: the two branches that fit best continue each other, and the other branches end there.

use glam::DVec3;

use crate::trace::skeleton::graph::Graph;
use crate::trace::skeleton::mask_lumen::Lumen;
use lumencut_core::math::same_place::ALONG_LINE;

pub(crate) struct ThroughLine {
    /// Points (mm, LPS), which are voxel centres at first.
    pub points: Vec<DVec3>,
    /// Nodes on the line, each with the index of its point.
    pub knots: Vec<Knot>,
    pub(crate) is_closed: bool,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot {
    pub node: usize,
    pub point: usize,
}

/// All branches as lines. At each junction, the two branches that are straightest and most similar in width
/// are joined.
pub(crate) fn through_lines(graph: &Graph, lumen: &Lumen) -> Vec<ThroughLine> {
    let next: Vec<Option<[usize; 2]>> = (0..graph.nodes.len()).map(|node| pair(graph, lumen, node)).collect();
    let mut used = vec![false; graph.branches.len()];
    let mut lines = Vec::new();
    for is_ring in [false, true] {
        for number in 0..graph.branches.len() {
            let Some(branch) = &graph.branches[number] else { continue };
            for [from, to] in [[0, 1], [1, 0]] {
                let goes_on = next[branch.nodes[from]].is_some_and(|pair| pair.contains(&number));
                if !used[number] && (is_ring || !goes_on) {
                    lines.push(line(graph, lumen, &next, &mut used, number, [from, to]));
                }
            }
        }
    }
    lines
}

fn line(
    graph: &Graph,
    lumen: &Lumen,
    next: &[Option<[usize; 2]>],
    used: &mut [bool],
    first: usize,
    [mut from, mut to]: [usize; 2],
) -> ThroughLine {
    let mut made = ThroughLine { points: Vec::new(), knots: Vec::new(), is_closed: false };
    let mut number = first;
    while let Some(branch) = graph.branches[number].as_ref().filter(|_| !used[number]) {
        used[number] = true;
        let mut points = lumen.positions(&branch.cells);
        if from == 1 {
            points.reverse();
        }
        if made.knots.is_empty() {
            made.knots.push(Knot { node: branch.nodes[from], point: 0 });
        }
        let skipped = usize::from(!made.points.is_empty());
        made.points.extend(points.into_iter().skip(skipped));
        let node = branch.nodes[to];
        made.knots.push(Knot { node, point: made.points.len() - 1 });
        let Some(pair) = next[node].filter(|pair| pair.contains(&number)) else { return made };
        let other = if pair[0] == number { pair[1] } else { pair[0] };
        made.is_closed = other == first && node == made.knots[0].node;
        let Some(after) = graph.branches[other].as_ref() else { return made };
        number = other;
        from = usize::from(after.nodes[0] != node);
        to = 1 - from;
    }
    made
}

/// The two branches that are joined at a node; the same branch twice for a ring.
fn pair(graph: &Graph, lumen: &Lumen, node: usize) -> Option<[usize; 2]> {
    let incident = &graph.incident[node];
    if incident.len() < 2 {
        return None;
    }
    let mut outwards = Vec::new();
    for (place, &number) in incident.iter().enumerate() {
        // A loop is listed twice: the first entry leaves by its start, the second by its end.
        let Some(branch) = &graph.branches[number] else { continue };
        let from_end = branch.nodes[0] != node || incident[..place].contains(&number);
        outwards.push((number, outward(lumen, &branch.cells, from_end, graph.nodes[node])));
    }
    let mut best: Option<(f64, [usize; 2])> = None;
    for (b, (second, (direction, radius))) in outwards.iter().enumerate() {
        for (first, (other, width)) in &outwards[..b] {
            if first == second && incident.len() > 2 {
                continue;
            }
            let likeness = radius.min(*width) / radius.max(*width).max(1e-9);
            let score = likeness - direction.dot(*other);
            // With the tolerance, ties depend on the order of the branches and not on rounding.
            if best.is_none_or(|(most, _)| score > most + 1e-6) {
                best = Some((score, [*first, *second]));
            }
        }
    }
    best.map(|(_, pair)| pair)
}

fn outward(lumen: &Lumen, cells: &[u32], from_end: bool, node: u32) -> (DVec3, f64) {
    let mut points = lumen.positions(cells);
    if from_end {
        points.reverse();
    }
    let away = 2.0 * lumen.radius_at_cell(node).max(lumen.side());
    let middle = points.len() / 2;
    let place = points.iter().position(|point| point.distance(points[0]) >= away - ALONG_LINE);
    let place = place.unwrap_or(middle.max(1));
    ((points[place] - points[0]).normalize_or_zero(), lumen.radius(points[place]))
}
