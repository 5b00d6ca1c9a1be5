//! Finds the root of each part (connected tracks), and ranks the parts.

use crate::trace::find::scan::Scan;
use crate::trace::find::track::{Track, usual};
use crate::trace::find::whole_vessels::edge_ends::{Outlook, outlook};
use crate::trace::find::whole_vessels::graph::Graph;
use crate::trace::find::whole_vessels::runs::straightest;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Radii above this (voxels) do not increase the rank.
const WIDEST: f64 = 10.0;

/// Intensity levels are similar if they differ by about this fraction of the contrast.
const SIMILAR_LEVEL: f64 = 0.2;

struct Part {
    rank: f64,
    /// The track with the largest lumen, and the size of that lumen (mm³).
    largest: (usize, f64),
    /// Edge and node of the widest free end, and the radius there (mm).
    free: Option<([usize; 2], f64)>,
}

/// Root of each part as edge and node: the free end of its widest run. The most important part is first.
pub(crate) fn roots(scan: &Scan, tracks: &[Track], graph: &Graph, stop: Stop) -> Result<Vec<[usize; 2]>> {
    let (of_node, count) = graph.parts();
    let mut parts: Vec<Part> =
        (0..count).map(|_| Part { rank: 0.0, largest: (0, -1.0), free: None }).collect();
    for (number, track) in tracks.iter().enumerate() {
        go_on(stop)?;
        let [first, _] = graph.of_track[number];
        let part = &mut parts[of_node[graph.edges[first].nodes[0]]];
        part.rank += importance(scan, track);
        let lumen = volume(track);
        if lumen > part.largest.1 {
            part.largest = (number, lumen);
        }
    }
    for node in (0..graph.places.len()).filter(|node| is_free(graph, *node)) {
        let edge = graph.incident[node][0];
        let radius = outlook(graph, edge, node, 0.0).radius;
        let free = &mut parts[of_node[node]].free;
        if free.is_none_or(|(_, widest)| radius > widest) {
            *free = Some(([edge, node], radius));
        }
    }
    // The sort is stable: of equal parts, the one with the first track comes first.
    parts.sort_by(|a, b| b.rank.total_cmp(&a.rank));
    let root = |part| {
        go_on(stop)?;
        Ok(root(graph, part))
    };
    parts.iter().map(root).collect()
}

/// Rank of a track, by its length, confidence, width, contrast, and similarity to the vessel level.
fn importance(scan: &Scan, track: &Track) -> f64 {
    let wide = (track.radius() / scan.side).min(WIDEST);
    let contrast = track.points.iter().map(|point| point.contrast).sum::<f64>() / track.points.len() as f64;
    let away = (usual(&track.points, |point| point.level) - scan.level) / (SIMILAR_LEVEL * scan.contrast);
    track.length() * contrast / scan.contrast * track.confidence * wide * wide * (-away * away).exp()
}

fn volume(track: &Track) -> f64 {
    let piece = |pair: &[crate::trace::find::track::TrackPoint]| {
        pair[0].radius * pair[1].radius * pair[0].place.distance(pair[1].place)
    };
    track.points.windows(2).map(piece).sum()
}

fn is_free(graph: &Graph, node: usize) -> bool {
    graph.incident[node].len() == 1
}

/// The wider free end of the run with the largest track; else the part's widest free end, or any end of a ring.
fn root(graph: &Graph, part: &Part) -> [usize; 2] {
    let [first, after] = graph.of_track[part.largest.0];
    let ways = [
        walk(graph, [first, graph.edges[first].nodes[0]]),
        walk(graph, [after - 1, graph.edges[after - 1].nodes[1]]),
    ];
    let width = |[edge, node]: [usize; 2]| outlook(graph, edge, node, 0.0).radius;
    match ways.map(|[_, node]| is_free(graph, node)) {
        [true, true] => ways[usize::from(width(ways[1]) > width(ways[0]))],
        [true, false] => ways[0],
        [false, true] => ways[1],
        [false, false] => part.free.map_or(ways[0], |(free, _)| free),
    }
}

/// Follows the straightest edges to the last edge and node.
fn walk(graph: &Graph, [mut edge, mut node]: [usize; 2]) -> [usize; 2] {
    let mut walked = vec![edge];
    loop {
        let back = outlook(graph, edge, node, 0.0);
        let before = Outlook { direction: -back.direction, ..back };
        let free: Vec<usize> =
            graph.incident[node].iter().copied().filter(|edge| !walked.contains(edge)).collect();
        let ahead: Vec<Outlook> =
            free.iter().map(|edge| outlook(graph, *edge, node, before.radius)).collect();
        let Some(next) = straightest(&before, &ahead, |_| true) else { return [edge, node] };
        edge = free[next];
        node = graph.far(edge, node);
        walked.push(edge);
    }
}
