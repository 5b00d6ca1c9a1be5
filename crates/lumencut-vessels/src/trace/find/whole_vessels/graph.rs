//! Tracks and links as a graph: tracks are cut where links join them.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::trace::find::links::link::Link;
use crate::trace::find::track::{Track, TrackPoint};

/// Points of a link are at most so far apart (mm).
const STEP: f64 = 0.5;

/// A point of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WayPoint {
    /// Where it lies (mm, LPS).
    pub place: DVec3,
    /// The radius (mm), and the level and the contrast of the lumen.
    pub radius: f64,
    /// See `radius`.
    pub level: f64,
    /// See `radius`.
    pub contrast: f64,
    /// How sure it is, 0 to 1.
    pub confidence: f64,
    /// The track that it belongs to: for a link the less sure one of both.
    pub track: usize,
    /// Whether it belongs to a link.
    pub is_link: bool,
}

/// A piece of a track, or a link.
#[derive(Clone, Debug)]
pub(crate) struct Edge {
    /// The nodes at its start and its end.
    pub nodes: [usize; 2],
    /// Its points, those at both nodes included.
    pub points: Vec<WayPoint>,
}

/// Tracks and links as nodes and edges.
pub(crate) struct Graph {
    /// Where each node lies (mm, LPS).
    pub places: Vec<DVec3>,
    /// The numbers of the edges at each node.
    pub incident: Vec<Vec<usize>>,
    /// The edges, the pieces of tracks first and in their order.
    pub edges: Vec<Edge>,
    /// The first edge of each track, and the one after its last.
    pub of_track: Vec<[usize; 2]>,
}

impl Graph {
    /// The graph of linked tracks.
    pub(crate) fn new(tracks: &[Track], links: &[Link]) -> Self {
        let mut cuts: Vec<BTreeSet<usize>> =
            tracks.iter().map(|track| BTreeSet::from([0, track.points.len() - 1])).collect();
        for [track, point] in links.iter().flat_map(|link| [link.from, link.to]) {
            cuts[track].insert(point);
        }
        let mut graph =
            Self { places: Vec::new(), incident: Vec::new(), edges: Vec::new(), of_track: Vec::new() };
        let mut nodes: Vec<Vec<(usize, usize)>> = Vec::new();
        for (number, cuts) in cuts.iter().enumerate() {
            let points = &tracks[number].points;
            nodes.push(cuts.iter().map(|cut| (*cut, graph.add_node(points[*cut].place))).collect());
            let first = graph.edges.len();
            for pair in nodes[number].windows(2) {
                let piece = points[pair[0].0..=pair[1].0].iter();
                let points = piece.map(|point| on_track(tracks, number, point)).collect();
                graph.add_edge(Edge { nodes: [pair[0].1, pair[1].1], points });
            }
            graph.of_track.push([first, graph.edges.len()]);
        }
        let node = |[track, point]: [usize; 2]| {
            nodes[track].binary_search_by_key(&point, |(cut, _)| *cut).map_or(0, |n| nodes[track][n].1)
        };
        for link in links {
            graph
                .add_edge(Edge { nodes: [node(link.from), node(link.to)], points: along_link(tracks, link) });
        }
        graph
    }

    /// The node at the other end of an edge.
    pub(crate) fn far(&self, edge: usize, node: usize) -> usize {
        let [a, b] = self.edges[edge].nodes;
        if a == node { b } else { a }
    }

    /// The points of an edge from a node on.
    pub(crate) fn points_from(&self, edge: usize, node: usize) -> Vec<WayPoint> {
        let mut points = self.edges[edge].points.clone();
        if self.edges[edge].nodes[0] != node {
            points.reverse();
        }
        points
    }

    /// The part that each node belongs to, numbered in the order of their first nodes, and how many there are.
    pub(crate) fn parts(&self) -> (Vec<usize>, usize) {
        let mut parts = vec![usize::MAX; self.places.len()];
        let mut count = 0;
        for first in 0..parts.len() {
            if parts[first] != usize::MAX {
                continue;
            }
            let mut open = vec![first];
            while let Some(node) = open.pop() {
                if parts[node] == usize::MAX {
                    parts[node] = count;
                    open.extend(self.incident[node].iter().map(|edge| self.far(*edge, node)));
                }
            }
            count += 1;
        }
        (parts, count)
    }

    fn add_node(&mut self, place: DVec3) -> usize {
        self.places.push(place);
        self.incident.push(Vec::new());
        self.places.len() - 1
    }

    fn add_edge(&mut self, edge: Edge) {
        for node in edge.nodes {
            self.incident[node].push(self.edges.len());
        }
        self.edges.push(edge);
    }
}

/// A point of a track.
fn on_track(tracks: &[Track], number: usize, point: &TrackPoint) -> WayPoint {
    WayPoint {
        place: point.place,
        radius: point.radius,
        level: point.level,
        contrast: point.contrast,
        confidence: tracks[number].confidence,
        track: number,
        is_link: false,
    }
}

/// The points of a link: as wide as the narrower of both tracks, and as sure as the less sure one where it is bright.
fn along_link(tracks: &[Track], link: &Link) -> Vec<WayPoint> {
    let [from, to] =
        [link.from, link.to].map(|[track, point]| on_track(tracks, track, &tracks[track].points[point]));
    let count = (from.place.distance(to.place) / STEP).ceil().max(1.0);
    let doubtful = if to.confidence < from.confidence { to } else { from };
    let point = |n: usize| {
        let t = n as f64 / count;
        WayPoint {
            place: if n == 0 { from.place } else { from.place.lerp(to.place, t) },
            radius: from.radius.min(to.radius),
            level: from.level + (to.level - from.level) * t,
            contrast: from.contrast + (to.contrast - from.contrast) * t,
            confidence: doubtful.confidence * link.level,
            track: doubtful.track,
            is_link: true,
        }
    };
    let mut points: Vec<WayPoint> = (0..count as usize).map(point).collect();
    points.push(WayPoint { place: to.place, ..point(count as usize) });
    points
}
