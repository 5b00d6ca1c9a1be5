//! The graph of paths. Stretches that paths share become one chain of edges; chains are vessels.

use glam::DVec3;

use super::Path;
use super::ids::{Id, Incidence, Table, id, make_room};
use crate::centerlines::Line;

#[derive(Clone, Copy, PartialEq)]
enum Partner {
    None,
    One(Id),
    Many,
}

struct Edge {
    /// Ids of both ends; the smaller one is first.
    nodes: [Id; 2],
    /// The first path with radii through this edge, and the number of its step that is this edge.
    radius: Option<[Id; 2]>,
    partners: [Partner; 2],
    /// Whether all paths through this edge have a group.
    grouped: bool,
}

impl Edge {
    fn side(&self, node: Id) -> usize {
        usize::from(self.nodes[1] == node)
    }

    fn other_end(&self, node: Id) -> Id {
        self.nodes[1 - self.side(node)]
    }

    fn radius_at(&self, node: Id, paths: &[Path]) -> Option<f64> {
        let [path, step] = self.radius?;
        let (path, step) = (&paths[path as usize], step as usize);
        let at = step + usize::from(path.nodes[step] != node);
        path.radius.as_ref().map(|radius| radius[at])
    }
}

pub(super) fn chains(points: &[DVec3], paths: &[Path]) -> Vec<Line> {
    let (mut graph, steps) = Graph::of(points.len(), paths);
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
            if !done[*edge as usize] {
                let (start, first) = graph.beginning(path.nodes[i], *edge);
                let chain = graph.chain(start, first, &mut done);
                let (points, radius) = graph.along(start, &chain, points, paths);
                out.push(Line {
                    points,
                    radius,
                    group: path.group,
                    name: path.name.clone(),
                    ..Line::default()
                });
            }
        }
    }
    out
}

struct Graph {
    edges: Vec<Edge>,
    left: usize,
}

impl Graph {
    fn of(places: usize, paths: &[Path]) -> (Self, Vec<Vec<Id>>) {
        // A tree has about as many edges as points.
        let expected = places + places / 16;
        let steps: usize = paths.iter().map(|path| path.nodes.len() - 1).sum();
        let mut graph = Self { edges: Vec::with_capacity(expected.min(steps)), left: steps };
        let mut known = Table::default();
        let steps = paths.iter().enumerate().map(|(i, path)| graph.add(path, id(i), &mut known)).collect();
        (graph, steps)
    }

    fn add(&mut self, path: &Path, number: Id, known: &mut Table) -> Vec<Id> {
        let step = |(i, pair): (usize, &[Id])| {
            let nodes = [pair[0].min(pair[1]), pair[0].max(pair[1])];
            let radius = path.radius.is_some().then_some([number, id(i)]);
            let same = known.like(&nodes).find(|edge| self.edges[*edge as usize].nodes == nodes);
            let step = same.unwrap_or_else(|| {
                make_room(&mut self.edges, self.left);
                self.edges.push(Edge { nodes, radius, partners: [Partner::None; 2], grouped: true });
                known.push(&nodes)
            });
            self.left -= 1;
            let edge = &mut self.edges[step as usize];
            edge.radius = edge.radius.or(radius);
            edge.grouped &= path.group.is_some();
            step
        };
        path.nodes.windows(2).enumerate().map(step).collect()
    }

    fn pair(&mut self, node: Id, a: Id, b: Id) {
        if a == b {
            return;
        }
        for (from, to) in [(a, b), (b, a)] {
            let edge = &mut self.edges[from as usize];
            let side = edge.side(node);
            edge.partners[side] = match edge.partners[side] {
                Partner::None => Partner::One(to),
                Partner::One(known) if known == to => Partner::One(to),
                _ => Partner::Many,
            };
        }
    }

    /// Joins two grouped edges that end at a point. At other points, all edges end unless each has one partner.
    fn join_groups(&mut self, places: usize) {
        let incidence = Incidence::new(places, self.edges.len(), |edge| self.edges[edge].nodes);
        for place in 0..places {
            let (node, edges) = (id(place), incidence.at(place));
            let ends = |edge: &Id| self.partner(node, *edge) == Partner::None;
            let grouped = |edge: &Id| self.edges[*edge as usize].grouped;
            if edges.len() == 2 && edges.iter().all(|edge| ends(edge) && grouped(edge)) {
                self.pair(node, edges[0], edges[1]);
            } else if !edges.iter().all(|edge| matches!(self.partner(node, *edge), Partner::One(_))) {
                for edge in edges {
                    let edge = &mut self.edges[*edge as usize];
                    edge.partners[edge.side(node)] = Partner::None;
                }
            }
        }
    }

    fn partner(&self, node: Id, edge: Id) -> Partner {
        let edge = &self.edges[edge as usize];
        edge.partners[edge.side(node)]
    }

    fn next(&self, node: Id, edge: Id) -> Option<Id> {
        match self.partner(node, edge) {
            Partner::One(next) => Some(next),
            Partner::None | Partner::Many => None,
        }
    }

    fn beginning(&self, node: Id, edge: Id) -> (Id, Id) {
        let (mut at, mut current) = (node, edge);
        while let Some(before) = self.next(at, current) {
            if before == edge {
                return (node, edge);
            }
            at = self.edges[before as usize].other_end(at);
            current = before;
        }
        (at, current)
    }

    fn chain(&self, start: Id, first: Id, done: &mut [bool]) -> Vec<Id> {
        let mut out = Vec::new();
        let (mut at, mut current) = (start, Some(first));
        while let Some(edge) = current.filter(|edge| !done[*edge as usize]) {
            done[edge as usize] = true;
            out.push(edge);
            at = self.edges[edge as usize].other_end(at);
            current = self.next(at, edge);
        }
        out
    }

    fn along(
        &self,
        start: Id,
        chain: &[Id],
        places: &[DVec3],
        paths: &[Path],
    ) -> (Vec<DVec3>, Option<Vec<f64>>) {
        let edge = |id: &Id| &self.edges[*id as usize];
        let mut nodes = Vec::with_capacity(chain.len() + 1);
        nodes.push(start);
        nodes.extend(chain.iter().scan(start, |at, id| {
            *at = edge(id).other_end(*at);
            Some(*at)
        }));
        let points = nodes.iter().map(|node| places[*node as usize]).collect();
        // The first point has the radius of the first edge; other points have that of the edge before them.
        let edges = chain.iter().take(1).chain(chain).map(edge);
        let radius = chain.iter().all(|id| edge(id).radius.is_some()).then(|| {
            let mut out = Vec::with_capacity(nodes.len());
            out.extend(nodes.iter().zip(edges).filter_map(|(node, edge)| edge.radius_at(*node, paths)));
            out
        });
        (points, radius)
    }
}
