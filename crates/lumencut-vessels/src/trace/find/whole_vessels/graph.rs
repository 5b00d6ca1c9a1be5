//! The graph of tracks and links. Tracks are cut where links start or end.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::trace::find::links::link::Link;
use crate::trace::find::track::{Track, TrackPoint};

/// Distance between points on a link (mm).
const STEP: f64 = 0.5;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WayPoint {
    pub place: DVec3,
    pub radius: f64,
    pub level: f64,
    pub contrast: f64,
    pub confidence: f64,
    /// Index of the track; for a link, that of the less sure track.
    pub track: usize,
    pub(crate) is_link: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Edge {
    pub nodes: [usize; 2],
    /// Points of the edge, including those at both nodes.
    pub points: Vec<WayPoint>,
}

pub(crate) struct Graph {
    pub places: Vec<DVec3>,
    pub(crate) incident: Vec<Vec<usize>>,
    /// Edges; the pieces of the tracks come first, in order.
    pub edges: Vec<Edge>,
    /// Index of the first edge of each track, and of the edge after its last one.
    pub(crate) of_track: Vec<[usize; 2]>,
}

impl Graph {
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

    pub(crate) fn far(&self, edge: usize, node: usize) -> usize {
        let [a, b] = self.edges[edge].nodes;
        if a == node { b } else { a }
    }

    pub(crate) fn points_from(&self, edge: usize, node: usize) -> Vec<WayPoint> {
        let mut points = self.edges[edge].points.clone();
        if self.edges[edge].nodes[0] != node {
            points.reverse();
        }
        points
    }

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

/// Points of a link. It is as wide as its narrower track; its confidence is that of the less sure track times
/// its level.
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
