//! Paths as a graph: shared stretches are the same edges, and chains between junctions are vessels.

use std::collections::HashMap;

use glam::DVec3;

use super::Path;
use crate::centerlines::Line;

/// What an edge goes on as at one of its ends.
#[derive(Clone, Copy, PartialEq)]
enum Partner {
    None,
    One(usize),
    Many,
}

/// A step between two places that at least one path makes.
struct Edge {
    /// The two places, the smaller id first.
    nodes: [usize; 2],
    /// The radius (mm) at both, from the first path that has one.
    radius: Option<[f64; 2]>,
    /// How the edge goes on at either place.
    partners: [Partner; 2],
    /// Whether every path along it has a group.
    grouped: bool,
}

impl Edge {
    fn side(&self, node: usize) -> usize {
        usize::from(self.nodes[1] == node)
    }

    fn other_end(&self, node: usize) -> usize {
        self.nodes[1 - self.side(node)]
    }
}

/// The chains of edges between junctions, as lines, in the order of the paths they come from.
pub fn chains(points: &[DVec3], paths: &[Path]) -> Vec<Line> {
    let mut graph = Graph { edges: Vec::new(), ids: HashMap::new() };
    let steps: Vec<Vec<usize>> = paths.iter().map(|path| graph.add(path)).collect();
    for (path, steps) in paths.iter().zip(&steps) {
        for (i, pair) in steps.windows(2).enumerate() {
            graph.pair(path.nodes[i + 1], pair[0], pair[1]);
        }
    }
    graph.join_groups(points.len());
    let mut done = vec![false; graph.edges.len()];
    let mut out = Vec::new();
    for (path, steps) in paths.iter().zip(&steps) {
        for (i, edge) in steps.iter().enumerate() {
            if !done[*edge] {
                let (start, first) = graph.beginning(path.nodes[i], *edge);
                out.push(graph.chain(points, start, first, &mut done, path));
            }
        }
    }
    out
}

struct Graph {
    edges: Vec<Edge>,
    ids: HashMap<[usize; 2], usize>,
}

impl Graph {
    /// The edges of a path, new ones added.
    fn add(&mut self, path: &Path) -> Vec<usize> {
        let step = |(i, pair): (usize, &[usize])| {
            let swap = usize::from(pair[0] > pair[1]);
            let nodes = [pair[swap], pair[1 - swap]];
            let radius = path.radius.as_ref().map(|r| [r[i + swap], r[i + 1 - swap]]);
            let next = self.edges.len();
            let id = *self.ids.entry(nodes).or_insert(next);
            if id == next {
                self.edges.push(Edge { nodes, radius, partners: [Partner::None; 2], grouped: true });
            }
            let edge = &mut self.edges[id];
            edge.radius = edge.radius.or(radius);
            edge.grouped &= path.group.is_some();
            id
        };
        path.nodes.windows(2).enumerate().map(step).collect()
    }

    /// Notes that a path goes from edge `a` to edge `b` at `node`, in either direction.
    fn pair(&mut self, node: usize, a: usize, b: usize) {
        if a == b {
            return;
        }
        for (from, to) in [(a, b), (b, a)] {
            let side = self.edges[from].side(node);
            let partner = &mut self.edges[from].partners[side];
            *partner = match *partner {
                Partner::None => Partner::One(to),
                Partner::One(known) if known == to => Partner::One(to),
                _ => Partner::Many,
            };
        }
    }

    /// Pairs the edges of places where just two edges of lines with groups end at each other, and forbids to
    /// pass places where an edge ends or goes on in several ways.
    fn join_groups(&mut self, places: usize) {
        let mut at: Vec<Vec<usize>> = vec![Vec::new(); places];
        for (id, edge) in self.edges.iter().enumerate() {
            edge.nodes.iter().for_each(|node| at[*node].push(id));
        }
        for (node, ids) in at.iter().enumerate() {
            let partner = |id: &usize| self.edges[*id].partners[self.edges[*id].side(node)];
            let ends = |id: &usize| partner(id) == Partner::None;
            if ids.len() == 2 && ids.iter().all(|id| ends(id) && self.edges[*id].grouped) {
                self.pair(node, ids[0], ids[1]);
            } else if !ids.iter().all(|id| matches!(partner(id), Partner::One(_))) {
                for id in ids {
                    let side = self.edges[*id].side(node);
                    self.edges[*id].partners[side] = Partner::None;
                }
            }
        }
    }

    fn next(&self, node: usize, edge: usize) -> Option<usize> {
        match self.edges[edge].partners[self.edges[edge].side(node)] {
            Partner::One(next) => Some(next),
            Partner::None | Partner::Many => None,
        }
    }

    /// Where the chain through `edge`, which is walked from `node`, begins: its first place and edge.
    fn beginning(&self, node: usize, edge: usize) -> (usize, usize) {
        let (mut at, mut current) = (node, edge);
        while let Some(before) = self.next(at, current) {
            if before == edge {
                return (node, edge);
            }
            at = self.edges[before].other_end(at);
            current = before;
        }
        (at, current)
    }

    /// The chain from the place `start` along `edge` to the next junction, or around to its first edge.
    fn chain(&self, points: &[DVec3], start: usize, edge: usize, done: &mut [bool], path: &Path) -> Line {
        let mut line = Line { points: vec![points[start]], name: path.name.clone(), ..Line::default() };
        line.group = path.group;
        let mut radius = Some(Vec::new());
        let (mut at, mut current) = (start, Some(edge));
        while let Some(id) = current.filter(|id| !done[*id]) {
            done[id] = true;
            let edge = &self.edges[id];
            let side = edge.side(at);
            radius = radius.zip(edge.radius).map(|(mut known, ends)| {
                if known.is_empty() {
                    known.push(ends[side]);
                }
                known.push(ends[1 - side]);
                known
            });
            at = edge.nodes[1 - side];
            line.points.push(points[at]);
            current = self.next(at, id);
        }
        line.radius = radius;
        line
    }
}
